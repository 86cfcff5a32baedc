// Logs that are incomplete or damaged.
#include <gmock/gmock.h>

#include "io/dynosam_example.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

class DynosamRefusal : public Dynosam {
 protected:
  // Of the logs with that in one of them, which is then as it was.
  std::string ErrorWith(const std::string& log, const std::string& text) {
    const std::string before = BytesOf(folder_ / Name(log));
    folder_.Write(Name(log), text);
    const absl::Status status = Open().status();
    folder_.Write(Name(log), before);
    EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr(Name(log)));
    return std::string(status.message());
  }
  // Of the one row that is left out of the logs with that in one of them.
  std::string LeftOutWith(const std::string& log, const std::string& bytes) {
    const std::string before = BytesOf(folder_ / Name(log));
    folder_.Write(Name(log), bytes);
    const auto opened = Open();
    folder_.Write(Name(log), before);
    EXPECT_TRUE(opened.ok()) << opened.status();
    if (!opened.ok()) return "";
    EXPECT_EQ(opened->frames.left_out->rows, 1u);
    return opened->frames.left_out->reasons.empty() ? "" : opened->frames.left_out->reasons[0];
  }
  std::string LeftOutOfCamera(const std::string& row) {
    return LeftOutWith("camera_pose", DynosamCameraLog({"1,0,0,0.1,0,0,0,1", row}));
  }
  std::string LeftOutOfMotions(const std::string& row) {
    return LeftOutWith("object_motion", DynosamObjectLog({"2,7,0,0,0.1,0,0,0,1", row}));
  }
  std::string LeftOutOfPoints(const std::string& row) {
    return LeftOutWith("map_points", DynosamLog(kDynosamPoints, {"1,7,21,1,0.5,5.1", row}));
  }
};

TEST_F(DynosamRefusal, SaysWhatIsMissing) {
  for (const char* log : {"map_points", "object_motion", "object_pose"}) {
    const std::string before = BytesOf(folder_ / Name(log));
    std::filesystem::remove(folder_ / Name(log));
    const absl::Status status = Open().status();
    EXPECT_TRUE(absl::IsNotFound(status)) << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr(Name(log)));
    folder_.Write(Name(log), before);
  }
  std::filesystem::remove(folder_ / Name("map_points"));
  const auto dut = Open({.allow_missing_points = true});
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_TRUE(dut->frames.read(0)->points_S.empty());
  std::filesystem::remove(folder_ / Name("camera_pose"));
  EXPECT_THAT(std::string(Open().status().message()), HasSubstr("no *_camera_pose_log.csv"));
}

TEST_F(DynosamRefusal, SaysWhatIsWrongWithTheCamera) {
  EXPECT_THAT(ErrorWith("camera_pose", ""),
              HasSubstr("the file is empty; a header line is expected"));
  EXPECT_THAT(ErrorWith("camera_pose", std::string(kDynosamCamera) + "\n"),
              HasSubstr("no pose under the header"));
  EXPECT_THAT(ErrorWith("camera_pose", DynosamLog("frame_id,x,y,z,roll,pitch,yaw", {})),
              HasSubstr("line 1: no column tx; there are frame_id, x, y, z, roll, pitch, yaw"));
  EXPECT_THAT(LeftOutOfCamera("2,0,0,0.2,0,0"), HasSubstr("line 3: 13 fields; the header has 15"));
  EXPECT_THAT(LeftOutOfCamera("1,0,0,0.2,0,0,0,1"),
              HasSubstr("line 3: a second row of frame 1; the first: line 2"));
  EXPECT_THAT(LeftOutOfCamera("-2,0,0,0,0,0,0,1"),
              HasSubstr("line 3, column frame_id: '-2' is not an integer from 0 to 99999999"));
  EXPECT_THAT(LeftOutOfCamera("2,nan,0,0,0,0,0,1"),
              HasSubstr("line 3, column tx: 'nan' is not a finite number"));
  EXPECT_THAT(LeftOutOfCamera("2,0,2e8,0,0,0,0,1"),
              HasSubstr("column ty: '2e8' is not a number from -1e+08 to 1e+08"));
  EXPECT_THAT(LeftOutOfCamera("2,0,0,,0,0,0,1"), HasSubstr("column tz: '' is not"));
  EXPECT_THAT(LeftOutOfCamera("2,0,0,0,0,0,0,0.9"),
              HasSubstr("line 3: columns qx to qw: the quaternion has length 0.9"));
  EXPECT_THAT(LeftOutOfCamera(absl::StrCat("2,0,0,0,0,0,0,", std::string(100, 'x'))),
              HasSubstr(absl::StrCat("'", std::string(40, 'x'), "...'")));
}

TEST_F(DynosamRefusal, SaysWhatIsWrongWithStamps) {
  const std::string row = "5,1,0,0,0,0,0,0,1";
  EXPECT_THAT(LeftOutWith("camera_pose", DynosamLog(kDynosamStampedCamera,
                                                    {row, "5,2,0,0,0,0,0,0,1"}, kDynosamTruth)),
              HasSubstr("at 5 ns: stamps must ascend with the frames"));
  EXPECT_THAT(ErrorWith("camera_pose",
                        DynosamLog(kDynosamStampedCamera, {"1.5,1,0,0,0,0,0,0,1"}, kDynosamTruth)),
              HasSubstr("line 2, column timestamp: '1.5' is not an integer"));
  folder_.Write("frame_id_timestamp.csv", "frame_id,timestamp [ns]\n1,7\n2,8");
  const auto unlisted = Open();
  ASSERT_TRUE(unlisted.ok()) << unlisted.status();
  EXPECT_EQ(unlisted->poses.size(), 2u);
  EXPECT_THAT(unlisted->frames.left_out->reasons.front(),
              HasSubstr("line 4: frame 3 has no row in "));
  folder_.Write("frame_id_timestamp.csv", "frame_id,timestamp\n1,7\n2,8");
  EXPECT_THAT(std::string(Open().status().message()), HasSubstr("no column timestamp [ns]"));
  EXPECT_THAT(std::string(Open({.frame_period = Duration::zero()}).status().message()),
              HasSubstr("frame_period: is 0 ns"));
}

TEST_F(DynosamRefusal, SaysWhatIsWrongWithObjects) {
  EXPECT_THAT(LeftOutOfMotions("2,0,0,0,0,0,0,0,1"),
              HasSubstr("line 3, column object_id: '0' is not an integer from 1"));
  EXPECT_THAT(LeftOutOfMotions("2,99999999999,0,0,0,0,0,0,1"), HasSubstr("column object_id"));
  EXPECT_THAT(LeftOutOfMotions("2,7,0,0,0,0,0,0,1"),
              HasSubstr("line 3: a second row of object 7 in frame 2"));
  EXPECT_THAT(LeftOutOfMotions("3,7,0,0,inf,0,0,0,1"), HasSubstr("column tz: 'inf'"));
  EXPECT_THAT(ErrorWith("object_pose", DynosamObjectLog({"3,7,0,0,0,0,0,0,2"})),
              HasSubstr("line 2: columns qx to qw"));
}

TEST_F(DynosamRefusal, SaysWhatIsWrongWithPoints) {
  EXPECT_THAT(ErrorWith("map_points", DynosamLog("frame_id,object_id,x,y,z", {})),
              HasSubstr("line 1: no column x_world"));
  EXPECT_THAT(LeftOutOfPoints("1,7,22,1,0.5"), HasSubstr("line 3: 5 fields; the header has 6"));
  EXPECT_THAT(LeftOutOfPoints("1,-1,22,1,2,3"), HasSubstr("column object_id: '-1'"));
  EXPECT_THAT(LeftOutOfPoints("1,7,22,1,2,-nan"), HasSubstr("column z_world: '-nan'"));
  EXPECT_THAT(LeftOutOfPoints(absl::StrCat(kDynosamNoFrame, ",7,22,1,2,3")),
              HasSubstr("line 3, column frame_id: '18446744073709551615' is not an integer"));
  EXPECT_THAT(LeftOutOfPoints(absl::StrCat(kDynosamNoFrame, ",0,22,1,2,x")),
              HasSubstr("column z_world: 'x'"));
}

TEST_F(DynosamRefusal, LogsMayBeCutOffAnywhere) {
  for (const char* log : {"camera_pose", "object_pose", "object_motion", "map_points"}) {
    const std::string whole = BytesOf(folder_ / Name(log));
    for (std::size_t size = 0; size < whole.size(); ++size) {
      folder_.Write(Name(log), whole.substr(0, size));
      const auto opened = Open();
      EXPECT_TRUE(opened.ok() || absl::IsInvalidArgument(opened.status())) << opened.status();
    }
    folder_.Write(Name(log), whole);
  }
}

TEST_F(DynosamRefusal, SaysThatTheRangeIsEmpty) {
  EXPECT_THAT(std::string(Open({.first_frame = 4}).status().message()),
              HasSubstr("no frame from 4"));
}

}  // namespace
}  // namespace clearway
