// Which faces of a mesh share an edge.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace clearway {

using Face = std::array<std::uint32_t, 3>;  // its corners

// An edge of a face, between two corners.
struct FaceEdge {
  std::uint32_t low, high;
  std::uint32_t face;
  bool upward;  // the face runs from low to high
};

// The corner opposite to an edge of the face.
inline std::uint32_t ApexOf(const Face& face, const FaceEdge& edge) {
  for (const std::uint32_t corner : face) {
    if (corner != edge.low && corner != edge.high) return corner;
  }
  return face[0];
}

// The edges of the faces, those between the same corners next to each other, by face.
std::vector<FaceEdge> EdgesOf(const std::vector<Face>& faces);

// Calls visit(std::span<const FaceEdge>) for all faces of each edge.
template <class Visit>
void ForEachEdge(std::span<const FaceEdge> edges, Visit&& visit) {
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].low == edges[begin].low &&
           edges[end].high == edges[begin].high) {
      ++end;
    }
    visit(edges.subspan(begin, end - begin));
  }
}

// Sets of numbers below a size, at first one each.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size);
  // The least number of the set.
  std::uint32_t Of(std::uint32_t i);
  void Join(std::uint32_t a, std::uint32_t b);

 private:
  std::vector<std::uint32_t> parent_;
};

// For each face whether it is left when faces that have an edge alone are taken away until there is
// none: whether it may be part of a closed surface.
std::vector<bool> WithoutLooseFaces(const std::vector<Face>& faces);

}  // namespace clearway
