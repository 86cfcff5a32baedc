// A bounding volume hierarchy over triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "absl/functional/function_ref.h"
#include "clearway/geometry/shape.h"
#include "collision/triangle_box.h"

namespace clearway {

// A mesh's triangles, sorted into a binary tree of axis-aligned boxes in the mesh's frame G.
// Immutable; any number of threads may read it.
class TriangleTree {
 public:
  // A box around some triangles: [first, first + count) of triangles() if it is a leaf, else those
  // of the nodes `first` and `first + 1`.
  struct Node {
    Eigen::Vector3d center_G;
    Eigen::Vector3d half_m;
    std::uint32_t first;
    std::uint32_t count;  // 0: not a leaf
    bool Outside(const Eigen::Vector3d& p_G) const {
      return ((p_G - center_G).cwiseAbs().array() > half_m.array()).any();
    }
  };

  // The mesh must not be empty.
  explicit TriangleTree(const Mesh& mesh);

  const std::vector<Node>& nodes() const { return nodes_; }  // the root first
  const std::vector<Triangle>& triangles() const { return triangles_; }
  // Which of the mesh's triangles each of triangles() is.
  const std::vector<std::uint32_t>& order() const { return order_; }

  static constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

  // The distance in metres from the surface, and which of triangles() is that near; infinite if the
  // surface is farther than up_to_m. A search that ends at most_visits, to boxes and triangles, has
  // the nearest triangle that it met.
  struct Nearest {
    double distance_m;
    std::uint32_t triangle;
    double at_least_m;  // the surface is this far or farther; less than the distance only if ended
    std::uint64_t visits;
  };
  Nearest NearestTo(const Eigen::Vector3d& p_G, double up_to_m,
                    std::uint64_t most_visits = kNoLimit) const;
  Nearest NearestTo(const OrientedBox& box, double up_to_m) const;
  bool Meets(const OrientedBox& box) const;

  // The least of what `measure` gives for the triangles, infinite if none gives up to `limit`.
  // `bound` gives no more than that for any triangle in a node's box. Both need not tell values
  // above the limit they are given.
  double Least(double limit, absl::FunctionRef<double(const Node&, double limit)> bound,
               absl::FunctionRef<double(const Triangle&, double limit)> measure) const;

 private:
  static constexpr std::uint32_t kLeafSize = 4;
  static constexpr int kMaxDepth = 40;  // halves of 2^32 triangles, and some to spare

  void Build(std::uint32_t node, std::uint32_t first, std::uint32_t last,
             const std::vector<Triangle>& all);
  template <class Bound, class Measure>
  Nearest Search(double up_to_m, const Bound& bound, const Measure& measure,
                 std::uint64_t most_visits = kNoLimit) const;

  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> order_;
};

}  // namespace clearway
