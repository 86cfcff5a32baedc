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
    auto opened = Open();
    if (opened.ok()) opened = absl::StatusOr<LidarFolder>(opened->frames.read(0).status());
    folder_.Write(file, before);
    EXPECT_TRUE(absl::IsInvalidArgument(opened.status())) << opened.status();
    return std::string(opened.status().message());
  }
};

TEST_F(TumRgbdRefusal, SaysWhatIsMissing) {
  WriteObjects();
  for (const char* name : {"mask/b.png", "depth/b.png", "groundtruth.txt", "depth.txt"}) {
    std::filesystem::remove(folder_ / name);
    const absl::Status status = Open().status();
    EXPECT_TRUE(absl::IsNotFound(status)) << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr(name));
    if (name == std::string("mask/b.png")) folder_.Write(name, BytesOf(folder_ / "mask/a.png"));
  }
}

TEST_F(TumRgbdRefusal, SaysWhatIsWrongWhere) {
  WriteObjects();
  const std::string depth = kTumDepth, track = kTumTrack, objects = kTumObjects;
  EXPECT_THAT(ErrorWith("depth.txt", "# none\n"), HasSubstr("depth.txt: lists no image"));
  EXPECT_THAT(ErrorWith("depth.txt", depth + "1305031103 \n"), HasSubstr("line 7: 1 words"));
  EXPECT_THAT(ErrorWith("depth.txt", depth + "1305031102.166 depth/a.png\n"),
              HasSubstr("line 7: the stamp 1305031102166000000 ns does not come after"));
  EXPECT_THAT(ErrorWith("depth.txt", "noon depth/a.png\n"),
              HasSubstr("line 1, word 1: 'noon', expected seconds"));
  EXPECT_THAT(ErrorWith("depth.txt", "1e10 depth/a.png\n"), HasSubstr("word 1: '1e10'"));
  EXPECT_THAT(ErrorWith("depth.txt", "nan depth/a.png\n"), HasSubstr("word 1: 'nan'"));
  EXPECT_THAT(ErrorWith("groundtruth.txt", ""), HasSubstr("groundtruth.txt: holds no pose"));
  EXPECT_THAT(ErrorWith("groundtruth.txt", track + "1305031103 0 0 0 0 0 0\n"),
              HasSubstr("line 8: 7 words, expected timestamp tx ty tz qx qy qz qw"));
  EXPECT_THAT(ErrorWith("groundtruth.txt", track + "1305031101 0 0 0 0 0 0 1\n"),
              HasSubstr("line 8: the stamp"));
  EXPECT_THAT(ErrorWith("groundtruth.txt", track + "1305031103 0 x 0 0 0 0 1\n"),
              HasSubstr("line 8, word 3: 'x'"));
  EXPECT_THAT(ErrorWith("groundtruth.txt", track + "1305031103 0 0 0 0 0 0 0.9\n"),
              HasSubstr("line 8, words 5 to 8: no unit quaternion"));
  EXPECT_THAT(ErrorWith("groundtruth.txt", track.substr(0, track.size() - 1)),
              HasSubstr("seems cut off"));
  EXPECT_THAT(ErrorWith("object_poses.txt", objects + "1305031103 0 0 0 0 0 0 0 1\n"),
              HasSubstr("line 7, word 2: '0', expected an integer from 1"));
  EXPECT_THAT(ErrorWith("object_poses.txt", objects + "1305031102.1 7 0 0 0 0 0 0 1\n"),
              HasSubstr("line 7: the stamp"));
  EXPECT_THAT(ErrorWith("object_poses.txt", objects + "1305031103 65536 0 0 0 0 0 0 1\n"),
              HasSubstr("object_poses.txt, line 7, word 2: '65536', expected an integer from 1 to "
                        "65535"));
  EXPECT_THAT(ErrorWith("camera.txt", "1 2 3\n"), HasSubstr("line 1: 3 words"));
  EXPECT_THAT(ErrorWith("camera.txt", "1 0 3 4\n"),
              HasSubstr("word 2: '0', expected a number above"));
  EXPECT_THAT(ErrorWith("camera.txt", "1 1 3 4\n1 1 3 4\n"), HasSubstr("2 lines, expected one"));
  EXPECT_THAT(ErrorWith("depth/a.png", DepthPng(1).substr(0, 60)), HasSubstr("a.png: damaged"));
  EXPECT_THAT(ErrorWith("depth/a.png", PngBytes(1, 1, {1}, {.bits = 8})),
              HasSubstr("8 bits a pixel; depth images have 16"));
  EXPECT_THAT(ErrorWith("mask/a.png", PngBytes(3, 4, std::vector<int>(12, 0))),
              HasSubstr("mask/a.png: 3 x 4 pixels;"));
  EXPECT_THAT(ErrorWith("mask.txt", "1305031102.1 \n"), HasSubstr("mask.txt, line 1: 1 words"));
}

}  // namespace
}  // namespace clearway
