// The text files of a folder in the layout of the TUM RGB-D benchmark.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/base/time.h"
#include "clearway/geometry/pose.h"
#include "clearway/io/left_out.h"
#include "clearway/scene/depth_image.h"

namespace clearway {

struct TumImage {
  Time stamp;
  std::filesystem::path path;
  int line = 0;  // of the list
};
// By ascending stamps, of which no two are alike.
using TumImages = std::vector<TumImage>;

struct TumPose {
  Time stamp;
  Pose T_W_X;    // of the camera's optical frame, or of an object's box
  int line = 0;  // of the table
};
// By ascending stamps, of which no two are alike.
using TumTrack = std::vector<TumPose>;

// Rows may come in any order and have commas or tabs between their words. Bad rows, and second ones
// of a stamp, are left out.

// "timestamp filename": depth.txt, mask.txt. Paths begin at the list's folder.
absl::StatusOr<TumImages> ReadTumImages(const std::filesystem::path& path, LeftOut& left_out);
// Of mask.txt likewise, but rows whose file is not there are left out. NOT_FOUND if none is.
absl::StatusOr<TumImages> ReadTumMasks(const std::filesystem::path& list, LeftOut& left_out);
// "timestamp tx ty tz qx qy qz qw".
absl::StatusOr<TumTrack> ReadTumTrack(const std::filesystem::path& path, LeftOut& left_out);
// "timestamp id tx ty tz qx qy qz qw".
absl::StatusOr<std::map<ObjectId, TumTrack>> ReadTumObjects(const std::filesystem::path& path,
                                                            LeftOut& left_out);

// An image without pixels: the intrinsics in the folder's camera.txt, else those published for what
// the folder is called, with the size that they are for. NOT_FOUND if neither tells.
absl::StatusOr<DepthImage> ReadTumCamera(const std::filesystem::path& folder);

// Sorts by stamps. Of the poses with one stamp the first of the file at `path` stays.
void SortByStamp(const std::filesystem::path& path, TumTrack& track, LeftOut& left_out);

// The image within 0.02 s, the nearest one.
const TumImage* ImageAt(const TumImages& images, Time t);
// The pose at that time, if one is within 0.02 s: interpolated if that one and the next beyond t
// are at most 0.1 s apart.
std::optional<Pose> PoseAt(const TumTrack& track, Time t);

}  // namespace clearway
