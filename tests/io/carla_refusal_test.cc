// Recordings that are incomplete or damaged.
#include <gmock/gmock.h>

#include "absl/strings/str_replace.h"
#include "io/carla_example.h"

namespace clearway {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class CarlaRefusal : public Carla {
 protected:
  // Of the recording with that in one of its files, which is then as it was.
  std::string ErrorWith(const std::string& file, const std::string& bytes) {
    const std::string before = BytesOf(folder_ / file);
    folder_.Write(file, bytes);
    const auto opened = Open();
    const absl::Status status = opened.ok() ? opened->frames.read(0).status() : opened.status();
    folder_.Write(file, before);
    EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
    return std::string(status.message());
  }
  // Of the one row that is left out of the sequence with that in one of its files.
  std::string LeftOutWith(const std::string& file, const std::string& bytes) {
    const std::string before = BytesOf(folder_ / file);
    folder_.Write(file, bytes);
    const auto opened = Open({.allow_missing_points = true});
    folder_.Write(file, before);
    EXPECT_TRUE(opened.ok()) << opened.status();
    if (!opened.ok()) return "";
    EXPECT_EQ(opened->frames.left_out->rows, 1u);
    return opened->frames.left_out->reasons.empty() ? "" : opened->frames.left_out->reasons[0];
  }
  std::string SensorLeftOut(const std::string& row) {
    return LeftOutWith("carla_sensor.csv", BytesOf(folder_ / "carla_sensor.csv") + row);
  }
  std::string ActorLeftOut(const std::string& row) {
    return LeftOutWith("carla_actors.csv", BytesOf(folder_ / "carla_actors.csv") + row);
  }
  std::string BoxError(const std::string& row) {
    return ErrorWith("carla_actors.csv", kCarlaBoxes + row);
  }
  // With one part of the scan replaced.
  std::string ScanError(const std::string& from, const std::string& to) {
    const std::string ply = BytesOf(folder_ / "000120.ply");
    EXPECT_THAT(ply, HasSubstr(from));
    return ErrorWith("000120.ply", absl::StrReplaceAll(ply, {{from, to}}));
  }
};

TEST_F(CarlaRefusal, TableOfTheSensor) {
  EXPECT_THAT(ErrorWith("carla_sensor.csv", ""), HasSubstr("carla_sensor.csv, line 1"));
  EXPECT_THAT(ErrorWith("carla_sensor.csv", "frame,x\n"), HasSubstr("no column timestamp"));
  EXPECT_THAT(ErrorWith("carla_sensor.csv", kCarlaSensor), HasSubstr("no row under the header"));
  EXPECT_THAT(SensorLeftOut("121,13,0,0,0,0,0,0\n"),
              HasSubstr("line 4: a second row of frame 121; the first: line 3"));
  EXPECT_THAT(SensorLeftOut("122,12.1,0,0,0,0,0,0\n"), HasSubstr("stamps must ascend"));
  EXPECT_THAT(SensorLeftOut("-1,13,0,0,0,0,0,0\n"), HasSubstr("column frame: '-1' is not"));
  EXPECT_THAT(SensorLeftOut("122,5e9,0,0,0,0,0,0\n"),
              HasSubstr("column timestamp: '5e9' is not a number from 0 to 4e+09"));
  EXPECT_THAT(SensorLeftOut("122,-13,0,0,0,0,0,0\n"),
              HasSubstr("column timestamp: '-13' is not a number from 0 to 4e+09"));
  EXPECT_THAT(SensorLeftOut("122,13,0,nan,0,0,0,0\n"), HasSubstr("column y: 'nan'"));
  EXPECT_THAT(SensorLeftOut("122,13,1e9,0,0,0,0,0\n"),
              HasSubstr("column x: '1e9' is not a number from -1e+08 to 1e+08"));
  EXPECT_THAT(SensorLeftOut("122,13,0,0,0,0,0,361\n"),
              HasSubstr("line 4, column yaw: '361' is not a number from -360 to 360"));
  EXPECT_THAT(ErrorWith("carla_sensor.csv", BytesOf(folder_ / "carla_sensor.csv") + "122,13,0"),
              HasSubstr("seems cut off"));
}

TEST_F(CarlaRefusal, TableOfActors) {
  EXPECT_THAT(ErrorWith("carla_actors.csv", "frame,id\n"), HasSubstr("no column type"));
  EXPECT_THAT(ActorLeftOut("121,0,car,0,0,0,0,0,0\n"),
              HasSubstr("line 4, column id: '0' is not an integer from 1 to 2147483647"));
  EXPECT_THAT(ActorLeftOut("121,4294967295,car,0,0,0,0,0,0\n"),
              HasSubstr("column id: '4294967295'"));
  EXPECT_THAT(ActorLeftOut("121,31,car,0,0,0,0,0,0\n"),
              HasSubstr("line 4: a second box of track 31 in frame 121; the first: line "));
  EXPECT_THAT(ErrorWith("carla_actors.csv",
                        BytesOf(folder_ / "carla_actors.csv") + "120,31,ego,0,0,0,0,0,0\n"),
              HasSubstr("actor 31 is of type ego in some"));
  EXPECT_THAT(ActorLeftOut("121,5,car,0,0,0,x,0,0\n"), HasSubstr("column roll: 'x'"));
  EXPECT_THAT(BoxError("120,31,car,0,0,0,0,0,0,0,0,0,-1,1,1\n"),
              HasSubstr("line 2: columns extent_x, extent_y, extent_z: -1, 1, 1; none may"));
  EXPECT_THAT(BoxError("120,31,car,0,0,0,0,0,0,0,0,x,1,1,1\n"), HasSubstr("column box_z: 'x'"));
  EXPECT_THAT(ErrorWith("carla_actors.csv", "frame,id,type,x,y,z,roll,pitch,yaw,extent_x\n"),
              HasSubstr("no column box_x"));
}

TEST_F(CarlaRefusal, Scans) {
  EXPECT_THAT(ScanError("property uint32 ObjIdx\n", ""),
              HasSubstr("line 9: the header ends without a property ObjIdx"));
  EXPECT_THAT(ScanError("31 14", "-1 14"),
              HasSubstr("000120.ply, line 11: property ObjIdx: '-1' is not an integer from 0 to"));
  EXPECT_THAT(ScanError("31 14", "4294967296 14"), HasSubstr("property ObjIdx: '4294967296'"));
  folder_.Write("120.ply", CarlaPly({}));
  const absl::Status status = Open().status();
  EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
  EXPECT_THAT(std::string(status.message()),
              AllOf(HasSubstr("000120.ply and "), HasSubstr("/120.ply: two files of frame 120")));
}

TEST_F(CarlaRefusal, SaysWhatIsMissing) {
  std::filesystem::remove(folder_ / "carla_sensor.csv");
  const absl::Status status = Open().status();
  EXPECT_TRUE(absl::IsNotFound(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("carla_sensor.csv"));
}

}  // namespace
}  // namespace clearway
