#include "clearway/io/tum_rgbd.h"

#include <map>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "io/lidar_frames.h"
#include "io/pfm.h"
#include "io/png.h"
#include "io/tum_tables.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

constexpr std::size_t kMaxPixels = 20'000'000;
constexpr double kResolution_m = 0.05;

// All that is read when a folder is opened.
struct Tables {
  DepthImage camera;  // without pixels
  TumImages depth, masks;
  TumTrack track;
  std::map<ObjectId, TumTrack> objects;
  bool masked = false;
  LeftOut left_out;
};

// The images that become frames.
struct Images {
  std::map<int, Path> depth, masks;  // by the frame's number
  std::size_t without_pose = 0, without_mask = 0;
  LeftOut left_out;  // images without a pose or a mask
};

std::string Sized(const Path& path, const GrayImage& image) {
  return absl::StrCat(path.string(), ": ", image.width, " x ", image.height, " pixels");
}

absl::StatusOr<DepthImage> ReadDepth(const Path& path, DepthImage camera) {
  if (path.extension() == ".pfm") {
    absl::StatusOr<FloatImage> metres = ReadPfm(path);
    if (!metres.ok()) return metres.status();
    camera.width = metres->width;
    camera.height = metres->height;
    camera.depth_m = std::move(metres->pixels);
    return camera;
  }
  absl::StatusOr<GrayImage> image = ReadGrayPng(path);
  if (!image.ok()) return image.status();
  if (image->bits != 16) {
    return absl::InvalidArgumentError(
        absl::StrCat(path.string(), ": ", image->bits, " bits a pixel; depth images have 16"));
  }
  camera.width = image->width;
  camera.height = image->height;
  camera.depth = std::move(image->pixels);
  return camera;
}

absl::Status ReadMask(const Path& path, const Path& depth_path, DepthImage& image) {
  absl::StatusOr<GrayImage> mask = ReadGrayPng(path);
  if (!mask.ok()) return mask.status();
  if (mask->width != image.width || mask->height != image.height) {
    return absl::InvalidArgumentError(absl::StrCat(Sized(path, *mask), "; ", depth_path.string(),
                                                   " has ", image.width, " x ", image.height));
  }
  image.instance_mask = std::move(mask->pixels);
  return absl::OkStatus();
}

// The first image that can be read: of its size are the others, since they have one camera.
struct Sample {
  Path path;
  std::uint32_t width = 0, height = 0;  // 0 if there is none
};

// Published intrinsics are of images of one size.
absl::Status CheckSize(const Path& folder, const Sample& sample, const DepthImage& camera) {
  const bool is_published = camera.width > 0;
  const bool fits = sample.width == camera.width && sample.height == camera.height;
  if (!is_published || fits || sample.width == 0) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(
      sample.path.string(), ": ", sample.width, " x ", sample.height,
      " pixels; the intrinsics published for ", folder.filename().string(), " are for ",
      camera.width, " x ", camera.height, "; write those of these images to ",
      (folder / "camera.txt").string(), " ('fx fy cx cy' in pixels)"));
}

Sample FirstOf(const Images& images, const DepthImage& camera) {
  for (const auto& [number, path] : images.depth) {
    const absl::StatusOr<DepthImage> image = ReadDepth(path, camera);
    if (image.ok()) return {path, image->width, image->height};
  }
  return {};
}

// Sets points and labels.
absl::Status ReadPoints(const Path& depth_path, const Path* mask_path, const Sample& sample,
                        const DepthImage& camera, Frame& frame) {
  absl::StatusOr<DepthImage> image = ReadDepth(depth_path, camera);
  if (!image.ok()) return image.status();
  if (image->width != sample.width || image->height != sample.height) {
    return absl::InvalidArgumentError(absl::StrCat(
        depth_path.string(), ": ", image->width, " x ", image->height, " pixels; ",
        sample.path.string(), ", of the same camera, has ", sample.width, " x ", sample.height));
  }
  if (mask_path != nullptr) {
    if (auto status = ReadMask(*mask_path, depth_path, *image); !status.ok()) return status;
  }
  if (auto status = Validate(*image, kMaxPixels); !status.ok()) {
    return absl::Status(status.code(), absl::StrCat(depth_path.string(), ": ", status.message()));
  }
  SetPoints(*image, frame);
  return absl::OkStatus();
}

// What of the options becomes part of the camera.
absl::Status CheckOptions(const Path& folder, DepthImage camera) {
  camera.width = camera.height = 1;
  const absl::Status status = ValidateCamera(camera, kMaxPixels);
  return status.ok()
             ? status
             : absl::Status(status.code(), absl::StrCat(folder.string(), ": ", status.message()));
}

absl::StatusOr<Tables> ReadTables(const Path& folder, const TumRgbdOptions& options) {
  Tables tables;
  std::error_code error;
  auto depth = ReadTumImages(folder / "depth.txt", tables.left_out);
  if (!depth.ok()) return depth.status();
  auto track = ReadTumTrack(folder / "groundtruth.txt", tables.left_out);
  if (!track.ok()) return track.status();
  auto camera = ReadTumCamera(folder);
  if (!camera.ok()) return camera.status();
  tables.depth = *std::move(depth);
  tables.track = *std::move(track);
  tables.camera = *std::move(camera);
  tables.camera.stride = options.stride;
  tables.camera.max_depth_m = options.max_depth_m;
  if (auto status = CheckOptions(folder, tables.camera); !status.ok()) return status;
  tables.masked = std::filesystem::exists(folder / "mask.txt", error);
  if (tables.masked) {
    auto masks = ReadTumMasks(folder / "mask.txt", tables.left_out);
    if (!masks.ok()) return masks.status();
    tables.masks = *std::move(masks);
  }
  if (std::filesystem::exists(folder / "object_poses.txt", error)) {
    auto objects = ReadTumObjects(folder / "object_poses.txt", tables.left_out);
    if (!objects.ok()) return objects.status();
    tables.objects = *std::move(objects);
  }
  return tables;
}

void AddBoxes(const Tables& tables, const RecordedPose& pose, std::vector<RecordedBox>& boxes) {
  constexpr int kNotSaid = -1;
  for (const auto& [id, track] : tables.objects) {
    const std::optional<Pose> T_W_B = PoseAt(track, pose.stamp);
    if (!T_W_B) continue;
    boxes.push_back({pose.frame, id, "object", Eigen::Vector3d::Zero(), *T_W_B, kNotSaid});
  }
}

// Fills in poses and boxes of the images that have what they need.
Images Associate(const Tables& tables, LidarScans& scans) {
  Images images;
  for (std::size_t k = 0; k < tables.depth.size(); ++k) {
    const TumImage& depth = tables.depth[k];
    const std::optional<Pose> T_W_S = PoseAt(tables.track, depth.stamp);
    const TumImage* const mask = ImageAt(tables.masks, depth.stamp);
    const bool needs_mask = tables.masked && mask == nullptr;
    images.without_pose += T_W_S ? 0 : 1;
    images.without_mask += T_W_S && needs_mask ? 1 : 0;
    if (!T_W_S || needs_mask) {
      images.left_out.AddFrame(
          absl::StrCat(depth.path.string(), ": no ", T_W_S ? "mask" : "pose", " within 0.02 s"));
      continue;
    }
    const int number = static_cast<int>(k);
    images.depth[number] = depth.path;
    if (mask != nullptr) images.masks[number] = mask->path;
    scans.poses.push_back({number, depth.stamp, *T_W_S});
    AddBoxes(tables, scans.poses.back(), scans.boxes);
  }
  return images;
}

std::string Described(const std::string& name, const Tables& tables, const Images& images) {
  std::string text = name;
  if (images.without_pose + images.without_mask > 0) {
    absl::StrAppend(&text, "; of ", tables.depth.size(),
                    " depth images left out: ", images.without_pose,
                    " without a pose within 0.02 s");
    if (tables.masked) absl::StrAppend(&text, ", ", images.without_mask, " without a mask");
  }
  if (!tables.masked) absl::StrAppend(&text, "; no mask.txt: all points are static");
  return text;
}

}  // namespace

bool IsTumRgbd(const Path& folder) {
  std::error_code error;
  return std::filesystem::is_regular_file(folder / "depth.txt", error);
}

absl::StatusOr<LidarFolder> OpenTumRgbd(const Path& given, const TumRgbdOptions& options) {
  std::error_code error;
  Path folder = std::filesystem::absolute(given, error).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  const auto tables = ReadTables(folder, options);
  if (!tables.ok()) return tables.status();
  LidarScans scans;
  scans.name = absl::StrCat("TUM RGB-D sequence ", folder.string());
  scans.options = {.objects = options.objects,
                   .motions_over = options.motions_over,
                   .first_frame = options.first_frame,
                   .last_frame = options.last_frame,
                   .allow_missing_points = options.allow_missing_points,
                   .sensor_id = options.sensor_id};
  const auto images = std::make_shared<const Images>(Associate(*tables, scans));
  if (scans.poses.empty()) {
    return absl::InvalidArgumentError(
        absl::StrCat(folder.string(), ": no frame: of ", tables->depth.size(), " depth images ",
                     images->without_pose, " have no pose within 0.02 s in groundtruth.txt, ",
                     images->without_mask, " no mask in mask.txt"));
  }
  const Sample sample = FirstOf(*images, tables->camera);
  if (auto status = CheckSize(folder, sample, tables->camera); !status.ok()) return status;
  *scans.left_out = tables->left_out;
  scans.left_out->Add(images->left_out);
  scans.points_of = [images](int frame) { return images->depth.at(frame); };
  scans.read = [images, camera = tables->camera, sample](
                   const Path& points, std::span<const RecordedBox>, Frame& frame) {
    const auto mask = images->masks.find(static_cast<int>(frame.sequence));
    return ReadPoints(points, mask == images->masks.end() ? nullptr : &mask->second, sample, camera,
                      frame);
  };
  const std::string description = Described(scans.name, *tables, *images);
  absl::StatusOr<LidarFolder> result = FramesOf(std::move(scans));
  if (!result.ok()) return result.status();
  result->frames.description = description;
  result->frames.resolution_m = kResolution_m;
  return result;
}

}  // namespace clearway
