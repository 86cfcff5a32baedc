// Sequences that are incomplete or damaged.
#include <gmock/gmock.h>

#include <vector>

#include "io/tum_rgbd_example.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

class TumRgbdRefusal : public TumRgbd {
 protected:
  // Of the sequence with that in one of its files, which is then as it was.
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
    const auto opened = Open();
    folder_.Write(file, before);
    EXPECT_TRUE(opened.ok()) << opened.status();
    if (!opened.ok()) return "";
    EXPECT_EQ(opened->frames.left_out->rows, 1u);
    return opened->frames.left_out->reasons.empty() ? "" : opened->frames.left_out->reasons[0];
  }
};

TEST_F(TumRgbdRefusal, SaysWhatIsMissing) {
  WriteObjects();
  for (const char* name : {"depth/b.png", "groundtruth.txt", "depth.txt"}) {
    std::filesystem::remove(folder_ / name);
    const absl::Status status = Open().status();
    EXPECT_TRUE(absl::IsNotFound(status)) << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr(name));
  }
}

TEST_F(TumRgbdRefusal, SaysThatMasksAreMissing) {
  WriteObjects();
  for (const char* name : {"mask/a.png", "mask/b.png", "mask/c.png"}) {
    std::filesystem::remove(folder_ / name);
  }
  const absl::Status status = Open().status();
  EXPECT_TRUE(absl::IsNotFound(status)) << status;
  EXPECT_THAT(std::string(status.message()),
              HasSubstr("mask.txt: none of its 3 images is there; the first is "));
}

TEST_F(TumRgbdRefusal, SaysWhatIsWrongWhere) {
  WriteObjects();
  const std::string track = kTumTrack;
  EXPECT_THAT(ErrorWith("depth.txt", "# none\n"), HasSubstr("depth.txt: lists no image"));
  EXPECT_THAT(ErrorWith("depth.txt", "noon depth/a.png\n"),
              HasSubstr("line 1, word 1: 'noon' is not a time from 0 to"));
  EXPECT_THAT(ErrorWith("depth.txt", "1e10 depth/a.png\n"), HasSubstr("word 1: '1e10'"));
  EXPECT_THAT(ErrorWith("depth.txt", "nan depth/a.png\n"), HasSubstr("word 1: 'nan'"));
  EXPECT_THAT(ErrorWith("groundtruth.txt", ""), HasSubstr("groundtruth.txt: holds no pose"));
  EXPECT_THAT(ErrorWith("groundtruth.txt", "1305031103 0 0 0 0 0 0\n" + track),
              HasSubstr("line 1: 7 words, expected timestamp tx ty tz qx qy qz qw"));
  EXPECT_THAT(ErrorWith("groundtruth.txt", "1305031103 nan nan nan nan nan nan nan\n"),
              HasSubstr("no row of the table can be used"));
  EXPECT_THAT(ErrorWith("groundtruth.txt", track.substr(0, track.size() - 1)),
              HasSubstr("seems cut off"));
  EXPECT_THAT(ErrorWith("camera.txt", "1 2 3\n"), HasSubstr("line 1: 3 words"));
  EXPECT_THAT(ErrorWith("camera.txt", "1 0 3 4\n"),
              HasSubstr("word 2: '0' is not a number from 1 to"));
  EXPECT_THAT(ErrorWith("camera.txt", "1e-320 1 3 4\n"), HasSubstr("word 1: '1e-320'"));
  EXPECT_THAT(ErrorWith("camera.txt", "1 1e7 3 4\n"), HasSubstr("word 2: '1e7'"));
  EXPECT_THAT(ErrorWith("camera.txt", "1 1 3 4 1e-320\n"), HasSubstr("word 5: '1e-320'"));
  EXPECT_THAT(ErrorWith("camera.txt", "1 1 3 4\n1 1 3 4\n"), HasSubstr("2 lines, expected one"));
  EXPECT_THAT(ErrorWith("depth/a.png", DepthPng(1).substr(0, 60)), HasSubstr("a.png: damaged"));
  EXPECT_THAT(ErrorWith("depth/a.png", PngBytes(1, 1, {1}, {.bits = 8})),
              HasSubstr("8 bits a pixel; depth images have 16"));
  EXPECT_THAT(ErrorWith("mask/a.png", PngBytes(3, 4, std::vector<int>(12, 0))),
              HasSubstr("mask/a.png: 3 x 4 pixels;"));
  EXPECT_THAT(ErrorWith("mask.txt", "1305031102.1 \n"), HasSubstr("mask.txt, line 1: 1 words"));
}

TEST_F(TumRgbdRefusal, AnImageOfAnotherSizeIsNamed) {
  folder_.Write("depth/b.png", PngBytes(2, 2, {1, 1, 1, 1}));
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_TRUE(dut->frames.read(0).ok());
  EXPECT_THAT(std::string(dut->frames.read(1).status().message()),
              AllOf(HasSubstr("depth/b.png: 2 x 2 pixels; "),
                    HasSubstr("depth/a.png, of the same camera, has 4 x 3")));
}

TEST_F(TumRgbdRefusal, NamesTheRowsThatAreLeftOut) {
  WriteObjects();
  const std::string depth = kTumDepth, track = kTumTrack, objects = kTumObjects;
  EXPECT_THAT(LeftOutWith("depth.txt", depth + "1305031103 \n"), HasSubstr("line 7: 1 words"));
  EXPECT_THAT(LeftOutWith("depth.txt", depth + "1305031102.166 depth/a.png\n"),
              HasSubstr("line 7: a second row of stamp 1305031102166000000 ns; the first: line 6"));
  EXPECT_THAT(LeftOutWith("groundtruth.txt", track + "1305031103 0 0 0 0 0 0\n"),
              HasSubstr("line 8: 7 words, expected timestamp tx ty tz qx qy qz qw"));
  EXPECT_THAT(LeftOutWith("groundtruth.txt", track + "1305031102.1100 0 0 0 0 0 0 1\n"),
              HasSubstr("line 8: a second row of stamp"));
  EXPECT_THAT(LeftOutWith("groundtruth.txt", track + "1305031103 0 x 0 0 0 0 1\n"),
              HasSubstr("line 8, word 3: 'x' is not a finite number"));
  EXPECT_THAT(LeftOutWith("groundtruth.txt", track + "1305031103 0 0 0 0 0 0 0.9\n"),
              HasSubstr("line 8: words 5 to 8: the quaternion has length 0.9; a unit quaternion is "
                        "needed, to within 0.01"));
  EXPECT_THAT(LeftOutWith("object_poses.txt", objects + "1305031103 0 0 0 0 0 0 0 1\n"),
              HasSubstr("line 7, word 2: '0' is not an integer from 1 to 65535"));
  EXPECT_THAT(LeftOutWith("object_poses.txt", objects + "1305031102.1 7 0 0 0 0 0 0 1\n"),
              HasSubstr("line 7: a second row of stamp"));
  EXPECT_THAT(LeftOutWith("object_poses.txt", objects + "1305031103 65536 0 0 0 0 0 0 1\n"),
              HasSubstr("object_poses.txt, line 7, word 2: '65536' is not an integer from 1 to"));
}

}  // namespace
}  // namespace clearway
