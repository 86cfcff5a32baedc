// clearway replay: what becomes of objects whose motion is missing or cannot be right.
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clients/cli_server.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

std::string Point(double x, double y, double z, std::int16_t label) {
  const float p[3] = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
  std::string bytes(14, '\0');
  std::memcpy(bytes.data(), p, 12);
  std::memcpy(bytes.data() + 12, &label, 2);
  return bytes;
}

// Where the thing is in a frame of a folder.
struct Place {
  double x, y;
  bool labelled = true, in_table = true;
  int id_in_table = 2;
};

// 24 frames of a thing of 1 x 1 m in the plane, label 2, before a wall.
void WriteTrack(const TemporaryFolder& folder, const std::function<Place(int)>& place) {
  std::string poses = "frame,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n";
  std::string boxes =
      "frame,track,type,l,w,h,n_points,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n";
  for (int k = 0; k < 24; ++k) {
    absl::StrAppend(&poses, k, ",1,0,0,0,0,1,0,0,0,0,1,0\n");
    std::string points;
    for (int i = 0; i < 100; ++i) points += Point(20, -5 + 0.1 * i, 0.5, 0);
    const Place at = place(k);
    for (int i = 0; at.labelled && i < 121; ++i) {
      points += Point(at.x - 0.5 + 0.1 * (i / 11), at.y - 0.5 + 0.1 * (i % 11), 0.5, 2);
    }
    if (at.in_table) {
      absl::StrAppend(&boxes, k, ",", at.id_in_table, ",Car,1,1,1,121,1,0,0,", at.x, ",0,1,0,",
                      at.y, ",0,0,1,0.5\n");
    }
    folder.Write(absl::StrFormat("points/%04d.bin", k), points);
  }
  folder.Write("poses.csv", poses);
  folder.Write("objects.csv", boxes);
}

// Along x at 1 m/s, hidden in frames 6 to 15, then on at (back_x, back_y).
Place Hidden(int k, double back_x, double back_y) {
  if (k < 6) return {8 + 0.1 * k, 0};
  const bool back = k >= 16;
  return {back_x + 0.1 * (k - 16), back_y, back, back};
}

class ReplayObjects : public CliServer {
 protected:
  // The one object after a replay of the folder: its box in the world.
  json Object() {
    const json objects = Ask({"objects"})["objects"];
    EXPECT_EQ(objects.size(), 1u) << objects;
    return objects.empty() ? json() : objects[0];
  }
  void ExpectAt(double x, double y) {
    const json object = Object();
    const json& box = object["box_world"];
    const double center[2] = {(box["min_m"][0].get<double>() + box["max_m"][0].get<double>()) / 2,
                              (box["min_m"][1].get<double>() + box["max_m"][1].get<double>()) / 2};
    EXPECT_NEAR(center[0], x, 0.15) << object;
    EXPECT_NEAR(center[1], y, 0.15) << object;
    EXPECT_NEAR(object["size_m"][0].get<double>(), 1.0, 0.25) << object;
    EXPECT_NEAR(object["size_m"][1].get<double>(), 1.0, 0.25) << object;
  }
};

TEST_F(ReplayObjects, AfterAGapTheyAreWhereTheirBoxesAre) {
  for (const auto& [back_x, back_y] : {std::pair{9.6, 0.0}, {9.6, 3.0}, {30.0, 10.0}, {9.6, 1.5}}) {
    for (const char* how : {"motions", "poses"}) {
      TemporaryFolder folder;
      WriteTrack(folder, [&](int k) { return Hidden(k, back_x, back_y); });
      ASSERT_EQ(Clearway({"reset"}).exit_code, 0);
      const json summary = Ask({"replay", folder.path().string(), "--objects", how});
      EXPECT_EQ(summary["reports"]["objects_restarted"], 0);
      ExpectAt(back_x + 0.7, back_y);
      EXPECT_NEAR(Object()["speed_mps"].get<double>(), 1, 1e-6);
    }
  }
}

// Boxes are missing in the first frame back, or altogether from then on.
TEST_F(ReplayObjects, WithoutABoxAfterAGapTheModelBeginsAnewAndReplaySaysSo) {
  for (const int first_row : {17, 24}) {
    TemporaryFolder folder;
    WriteTrack(folder, [&](int k) {
      Place place = Hidden(k, 9.6, 3);
      if (k >= 6) place.in_table = k >= first_row;
      return place;
    });
    ASSERT_EQ(Clearway({"reset"}).exit_code, 0);
    if (first_row == 17) {  // the motion of frame 17 is one over the gap; only frame 16 has none
      const Finished dut = Clearway({"replay", folder.path().string()});
      EXPECT_EQ(dut.exit_code, 0) << dut.err;
      EXPECT_THAT(dut.out, HasSubstr("object 2: model restarted at 1.6 s: points "));
      EXPECT_THAT(dut.out, HasSubstr(" m from where it should be (limit "));
      ExpectAt(10.3, 3);
    } else {
      const json summary = Ask({"replay", folder.path().string()});
      ASSERT_EQ(summary["reports"]["issues"].size(), 1u) << summary;
      const json& issue = summary["reports"]["issues"][0];
      EXPECT_EQ(issue["object_id"], 2);
      EXPECT_EQ(issue["kind"], "RESTARTED");
      EXPECT_EQ(issue["first_stamp_ns"], 1'600'000'000);
      EXPECT_NEAR(issue["value"].get<double>(), 3, 0.15);
      EXPECT_GT(summary["reports"]["objects_estimated"], 0);
      ExpectAt(10.3, 3);
      EXPECT_NEAR(Object()["speed_mps"].get<double>(), 1, 0.3);
    }
  }
}

TEST_F(ReplayObjects, AHeadingThatFlipsLeavesTheMotionOutAndNamesTheObject) {
  TemporaryFolder folder;
  folder.Write("poses.csv",
               "frame,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n"
               "0,1,0,0,0,0,1,0,0,0,0,1,1.5\n1,1,0,0,1,0,1,0,0,0,0,1,1.5\n");
  folder.Write("objects.csv",
               "frame,track,type,l,w,h,n_points,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n"
               "0,2,Van,4,2,2,1,1,0,0,9,0,1,0,3,0,0,1,1\n"
               "1,2,Van,4,2,2,1,-1,0,0,10,0,-1,0,3,0,0,1,1\n");
  folder.Write("points/0000.bin", Point(4, 5, 0, 0) + Point(9, 3, 0, 2));
  folder.Write("points/0001.bin", Point(4, 5, 0, 0) + Point(9, 3, 0, 2));
  const Finished dut = Clearway({"replay", folder.path().string()});
  EXPECT_EQ(dut.exit_code, 0) << dut.err;
  EXPECT_THAT(dut.out, HasSubstr("object 2: motion or pose left out at 0.1 s: turns by 3.14 rad "
                                 "(limit 2.83 rad)"));
  EXPECT_EQ(Ask({"status"})["frames_applied"], 2);
}

TEST_F(ReplayObjects, WithoutMotionsTheyAreEstimatedAndReplaySaysSo) {
  const Finished dut =
      Clearway({"replay", "--objects", "none", "sim:crossing", "--frames", "60", "--quiet"});
  EXPECT_EQ(dut.exit_code, 0) << dut.err;
  EXPECT_THAT(dut.out, HasSubstr("objects came without a motion or pose "));
  const json objects = Ask({"objects"})["objects"];
  EXPECT_FALSE(objects.empty());
  for (const json& object : objects) {
    EXPECT_LT(object["size_m"][0].get<double>(), 6) << object;
  }
}

// Its box of frame 5 lies before the range, and the motion from there is none of the range's.
TEST_F(ReplayObjects, InARangeNoMotionStartsBeforeIt) {
  TemporaryFolder folder;
  WriteTrack(folder, [](int k) { return Hidden(k, 9.6, 0); });
  const json summary = Ask({"replay", folder.path().string(), "--from", "9"});
  EXPECT_EQ(summary["reports"]["motions_implausible"], 0) << summary;
  ExpectAt(10.3, 0);
  EXPECT_NEAR(Object()["speed_mps"].get<double>(), 1, 1e-6);
}

// Labels and tables that number objects differently, or a recording whose labels are missing.
TEST_F(ReplayObjects, IdsThatNoPointHasAreNamed) {
  for (const bool labelled : {true, false}) {
    TemporaryFolder folder;
    WriteTrack(folder, [&](int k) { return Place{8 + 0.1 * k, 0, labelled, true, 1002}; });
    ASSERT_EQ(Clearway({"reset"}).exit_code, 0);
    const Finished dut = Clearway({"replay", folder.path().string()});
    EXPECT_EQ(dut.exit_code, 0) << dut.err;
    EXPECT_THAT(dut.out, HasSubstr("warning: motions and poses are of objects without points (ids "
                                   "1002), "));
    EXPECT_THAT(dut.out, HasSubstr(labelled ? "points of others (labels 2): none was used"
                                            : "and no point has an object's label: none was used"));
    ASSERT_EQ(Clearway({"reset"}).exit_code, 0);
    const json summary = Ask({"replay", folder.path().string()});
    EXPECT_EQ(summary["reports"]["objects_without_points"], json({1002}));
  }
}

TEST_F(ReplayObjects, WithMotionsThereIsNothingToSay) {
  const Finished dut = Clearway({"replay", "sim:small", "--frames", "8", "--quiet"});
  EXPECT_THAT(dut.out, Not(HasSubstr("object")));
}

}  // namespace
}  // namespace clearway
