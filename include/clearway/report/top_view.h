// A picture of a scene from above, with what is going to happen in it.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "clearway/geometry/timed_pose.h"
#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// A path to draw, by ascending times.
struct TopViewPath {
  std::string name;
  std::vector<TimedPose> poses;
  // Drawn thin and dashed, without footprints: what the other paths are compared with.
  bool reference = false;
};

// An outline that was recorded at a time: where an object really was.
struct TopViewOutline {
  Time time;
  std::vector<Eigen::Vector2d> polygon_W;  // metres
};

// What the picture shows, beside the scene. A plain value.
struct TopViewOptions {
  std::string title;
  std::string subtitle;
  int width_px = 1600;

  // The area shown; by default what the paths need, else the objects, else the whole static map.
  std::optional<Aabb> area_W;
  // Voxels higher above the ground are left out: crowns and bridges hide nothing below them.
  double max_height_m = 3.0;

  std::vector<Duration> predicted_after;      // from the scene's stamp
  std::map<ObjectId, std::string> names;      // labels of objects; by default their ids
  std::vector<Eigen::Vector2d> footprint_L;   // convex, in the link; drawn along the paths
  Duration footprint_every = FromSeconds(1);  // and at each path's end
  std::vector<TopViewPath> paths;
  std::vector<TopViewOutline> recorded;
};

// Writes a PNG: the static map (white: free, grey: unknown, else the highest occupied voxel by its
// height over the ground around it), every moving object's hull now, and in the colour of their
// time its predicted hulls, the paths and the recorded outlines. INTERNAL if the file cannot be
// written.
absl::Status WriteTopView(const SceneSnapshot& scene, const TopViewOptions& options,
                          const std::string& png_file);

}  // namespace clearway
