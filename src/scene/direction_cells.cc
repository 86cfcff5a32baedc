#include "scene/direction_cells.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/lanes.h"
#include "base/multiversion.h"

namespace clearway {
namespace {

constexpr int kRow = DirectionCells::kRow;
constexpr float kLeast_m = 1e-30f;
// Of a slope from the face's middle along an axis of it, 4 / pi times its arcus tangent, about.
constexpr float kSteepest = 1.2f, kBend = 0.3476f;

// Where a slope leads, in cells from -1 to `across`.
int PlaceAlong(float slope, int across) {
  slope = std::min(std::max(slope, -kSteepest), kSteepest);
  const float angle = slope + kBend * slope * (1 - std::abs(slope));
  const int place = static_cast<int>((angle + 1) * (0.5f * across) + 1) - 1;  // rounded down
  return std::min(std::max(place, -1), across);
}

// The same of eight, but not into the rim.
inline void LanePlaces(const LaneFloats& any_slope, int across, LaneInts& places) {
  const LaneFloats above = any_slope < -kSteepest ? LaneFloats{} - kSteepest : any_slope;
  const LaneFloats slope = above > kSteepest ? LaneFloats{} + kSteepest : above;
  const LaneFloats angle = slope + kBend * slope * (1 - (slope < 0 ? -slope : slope));
  places = __builtin_convertvector((angle + 1) * (0.5f * across) + 1, LaneInts) - 1;
  places = places < 0 ? LaneInts{} : places;
  places = places > across - 1 ? LaneInts{} + (across - 1) : places;
}

// Of eight directions.
inline void LaneCells(const LaneFloats (&d)[3], int across, LaneInts& cells) {
  const auto& [x, y, z] = d;
  const LaneFloats size_x = x < 0 ? -x : x, size_y = y < 0 ? -y : y, size_z = z < 0 ? -z : z;
  const LaneInts not_x = size_y > size_x;
  const LaneInts on_z = size_z > (not_x ? size_y : size_x);
  const LaneFloats main = on_z ? z : not_x ? y : x;
  const LaneFloats along_u = on_z ? x : not_x ? z : y, along_v = on_z ? y : not_x ? x : z;
  const LaneFloats depth = main < 0 ? -main : main;
  const LaneFloats along = depth > kLeast_m ? depth : LaneFloats{} + kLeast_m;
  const LaneInts axis = on_z ? LaneInts{} + 2 : -not_x;
  const LaneInts face = 2 * axis - LaneInts(main < 0);
  LaneInts u, v;
  LanePlaces(along_u / along, across, u);
  LanePlaces(along_v / along, across, v);
  cells = DirectionCells::kBefore + (face * kRow + v + 1) * kRow + u + 1;
}

constexpr std::size_t kTogether = 32 * kLanes;

// Of kTogether points at most.
CLEARWAY_MULTIVERSION void FindCells(const Eigen::Vector3f* points_W, std::size_t size,
                                     const Eigen::Vector3f& from_W, int across,
                                     std::uint32_t* cells) {
  alignas(LaneFloats) float directions[3][kTogether];
  for (std::size_t i = 0; i < size; ++i) {  // many at a time
    const float* p = points_W[i].data();
    directions[0][i] = p[0] - from_W[0];
    directions[1][i] = p[1] - from_W[1];
    directions[2][i] = p[2] - from_W[2];
  }
  alignas(LaneInts) std::uint32_t found[kTogether];
  const std::size_t rounded_up = (size + kLanes - 1) / kLanes * kLanes;
  for (auto& along : directions) std::fill(along + size, along + rounded_up, 0.F);
  for (std::size_t i = 0; i < rounded_up; i += kLanes) {
    LaneFloats direction[3];
    for (int axis = 0; axis < 3; ++axis) {
      std::memcpy(&direction[axis], &directions[axis][i], sizeof(LaneFloats));
    }
    LaneInts eight;
    LaneCells(direction, across, eight);
    std::memcpy(&found[i], &eight, sizeof(LaneInts));
  }
  std::copy_n(found, size, cells);
}

}  // namespace

void DirectionCells::Find(std::span<const Eigen::Vector3f> points_W, const Eigen::Vector3f& from_W,
                          std::uint32_t* cells) const {
  for (std::size_t i = 0; i < points_W.size(); i += kTogether) {
    const std::size_t count = std::min(kTogether, points_W.size() - i);
    FindCells(&points_W[i], count, from_W, across_, &cells[i]);
  }
}

std::uint32_t DirectionCells::InRim(int axis, bool negative, const Eigen::Vector3f& d) const {
  const float along = std::max(std::abs(d[axis]), kLeast_m);
  const int u = PlaceAlong(d[(axis + 1) % 3] / along, across_);
  const int v = PlaceAlong(d[(axis + 2) % 3] / along, across_);
  const int face = 2 * axis + static_cast<int>(negative);
  return static_cast<std::uint32_t>(kBefore + (face * kRow + v + 1) * kRow + u + 1);
}

}  // namespace clearway
