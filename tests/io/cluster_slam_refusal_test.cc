// Sequences that are incomplete or damaged.
#include <gmock/gmock.h>

#include <random>

#include "absl/strings/str_replace.h"
#include "io/cluster_slam_example.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

class ClusterSlamRefusal : public ClusterSlam {
 protected:
  // Of the sequence with that in one of its files, which is then as it was.
  absl::Status StatusWith(const std::string& file, const std::string& bytes) {
    const std::string before = BytesOf(folder_ / file);
    folder_.Write(file, bytes);
    const auto opened = Open();
    const absl::Status status = opened.ok() ? opened->frames.read(0).status() : opened.status();
    folder_.Write(file, before);
    return status;
  }
  std::string ErrorWith(const std::string& file, const std::string& bytes) {
    const absl::Status status = StatusWith(file, bytes);
    EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr(file));
    return std::string(status.message());
  }
  // Of what is left out of the sequence with that in one of its files.
  std::string LeftOutWith(const std::string& file, const std::string& bytes) {
    const std::string before = BytesOf(folder_ / file);
    folder_.Write(file, bytes);
    const auto opened = Open();
    if (opened.ok()) {
      EXPECT_TRUE(opened->frames.read(0).ok());
    }
    folder_.Write(file, before);
    EXPECT_TRUE(opened.ok()) << opened.status();
    if (!opened.ok() || opened->frames.left_out->Empty()) return "";
    EXPECT_EQ(opened->frames.left_out->rows + opened->frames.left_out->frames, 1u);
    EXPECT_THAT(opened->frames.left_out->reasons[0], HasSubstr(file));
    return opened->frames.left_out->reasons[0];
  }
};

TEST_F(ClusterSlamRefusal, SaysWhatIsWrongWhere) {
  EXPECT_THAT(ErrorWith("landmark_mapping.txt", ""), HasSubstr("no landmark has a cluster"));
  EXPECT_THAT(ErrorWith("landmark_mapping.txt", "1 -2\n"), HasSubstr("line 1, word 2: '-2'"));
  EXPECT_THAT(ErrorWith("landmark_mapping.txt", "1 2 3\n"), HasSubstr("line 1: 3 words"));
  EXPECT_THAT(ErrorWith("landmarks/left/0000.txt", "1 2\n"), HasSubstr("line 1: 2 words"));
  EXPECT_THAT(ErrorWith("landmarks/right/0000.txt", "1 2 x\n"), HasSubstr("word 3: 'x'"));
  EXPECT_THAT(ErrorWith("intrinsic.txt", "1 0 0 0\n"), HasSubstr("1 lines of numbers, expected"));
  EXPECT_THAT(ErrorWith("intrinsic.txt", std::string("0") + kClusterCameras + "1 2 3"),
              HasSubstr("7 lines"));
  const std::string cameras = kClusterCameras;
  EXPECT_THAT(ErrorWith("intrinsic.txt", absl::StrReplaceAll(cameras, {{"-250", "0"}})),
              HasSubstr("the cameras are 0 m apart"));
  EXPECT_THAT(ErrorWith("intrinsic.txt", absl::StrReplaceAll(cameras, {{"0 0 1", "0 1 1"}})),
              HasSubstr("the first matrix is no pinhole's"));
  EXPECT_THAT(ErrorWith("intrinsic.txt", absl::StrReplaceAll(cameras, {{"500", "-500"}})),
              HasSubstr("the first matrix is no pinhole's"));
  EXPECT_THAT(ErrorWith("intrinsic.txt", absl::StrReplaceAll(cameras, {{"500", "1e-320"}})),
              HasSubstr("with f x and f y from 1 to 1000000"));
  EXPECT_THAT(ErrorWith("intrinsic.txt", absl::StrReplaceAll(cameras, {{"320 0", "320"}})),
              HasSubstr("line 1: 3 words, expected 4 numbers"));
}

TEST_F(ClusterSlamRefusal, NamesWhatIsLeftOut) {
  const std::string poses = BytesOf(folder_ / "pose/0001.txt");
  EXPECT_THAT(LeftOutWith("pose/0001.txt", ""), HasSubstr("no pose of the camera"));
  EXPECT_THAT(LeftOutWith("pose/0001.txt", poses + "0 0 0 1 0 0 0\n"),
              HasSubstr("0001.txt: 4 poses; most frames have 3"));
  const std::string others = poses.substr(poses.find('\n') + 1);
  EXPECT_THAT(LeftOutWith("pose/0001.txt", "0 0 0 1 0 0\n" + others),
              HasSubstr("line 1: 6 words, expected"));
  EXPECT_THAT(LeftOutWith("pose/0001.txt", "0 0 0 1 0 0 1\n" + others),
              HasSubstr("line 1: words 4 to 7: the quaternion has length 1.41"));
  EXPECT_THAT(LeftOutWith("pose/0001.txt", "0 nan 0 1 0 0 0\n" + others),
              HasSubstr("line 1, word 2: 'nan'"));
  const std::string clusters = BytesOf(folder_ / "landmark_mapping.txt");
  EXPECT_THAT(
      LeftOutWith("landmark_mapping.txt", clusters + clusters.substr(0, clusters.find('\n') + 1)),
      HasSubstr("occurs twice"));
  const std::string pixels = BytesOf(folder_ / "landmarks/right/0000.txt");
  EXPECT_THAT(
      LeftOutWith("landmarks/right/0000.txt", pixels + pixels.substr(0, pixels.find('\n') + 1)),
      HasSubstr("occurs twice"));
}

TEST_F(ClusterSlamRefusal, CamerasThatAreSwapped) {
  const std::string negative = absl::StrReplaceAll(kClusterCameras, {{"-250", "250"}});
  EXPECT_THAT(ErrorWith("intrinsic.txt", negative),
              HasSubstr("of the 256 landmarks that both cameras see in 8 frames none lies before "
                        "them, with a disparity of a pixel or more"));
  std::filesystem::rename(folder_ / "landmarks/left", folder_ / "landmarks/other");
  std::filesystem::rename(folder_ / "landmarks/right", folder_ / "landmarks/left");
  std::filesystem::rename(folder_ / "landmarks/other", folder_ / "landmarks/right");
  const absl::Status dut = Open().status();
  EXPECT_TRUE(absl::IsInvalidArgument(dut)) << dut;
  EXPECT_THAT(std::string(dut.message()), HasSubstr("are left and right swapped"));
}

TEST_F(ClusterSlamRefusal, SaysWhatIsMissing) {
  for (const char* name : {"landmarks/left/0002.txt", "landmark_mapping.txt", "intrinsic.txt"}) {
    const std::string before = BytesOf(folder_ / name);
    std::filesystem::remove(folder_ / name);
    const absl::Status status = Open().status();
    EXPECT_TRUE(absl::IsNotFound(status)) << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr(name));
    folder_.Write(name, before);
  }
  std::filesystem::remove_all(folder_ / "pose");
  EXPECT_TRUE(absl::IsNotFound(Open().status())) << Open().status();
}

TEST_F(ClusterSlamRefusal, GarbageDoesNoHarm) {
  std::mt19937 random(3);
  for (const char* name : {"landmarks/left/0000.txt", "landmark_mapping.txt", "intrinsic.txt",
                           "pose/0000.txt", "landmarks/right/0000.txt"}) {
    const std::string whole = BytesOf(folder_ / name);
    for (int i = 0; i < 50; ++i) {
      std::string damaged = whole.substr(0, random() % whole.size() + 1);
      for (int k = 0; k < 3; ++k) damaged[random() % damaged.size()] = static_cast<char>(random());
      const absl::Status status = StatusWith(name, damaged);
      EXPECT_TRUE(status.ok() || absl::IsInvalidArgument(status)) << status;
    }
  }
}

}  // namespace
}  // namespace clearway
