#include "geometry/face_edges.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace clearway {

std::vector<FaceEdge> EdgesOf(const std::vector<Face>& faces) {
  std::vector<FaceEdge> edges;
  edges.reserve(3 * faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t from = faces[f][k], to = faces[f][(k + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), f, from < to});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const FaceEdge& l, const FaceEdge& r) {
    return std::tie(l.low, l.high, l.face) < std::tie(r.low, r.high, r.face);
  });
  return edges;
}

DisjointSets::DisjointSets(std::size_t size) : parent_(size) {
  std::iota(parent_.begin(), parent_.end(), 0u);
}

std::uint32_t DisjointSets::Of(std::uint32_t i) {
  while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
  return i;
}

void DisjointSets::Join(std::uint32_t a, std::uint32_t b) {
  a = Of(a);
  b = Of(b);
  parent_[std::max(a, b)] = std::min(a, b);
}

std::vector<bool> WithoutLooseFaces(const std::vector<Face>& faces) {
  const std::vector<FaceEdge> edges = EdgesOf(faces);
  std::vector<std::uint32_t> edge_of, first, left;  // of each face's corner; of each edge
  edge_of.resize(3 * faces.size());
  std::vector<std::uint32_t> edges_seen(faces.size());
  ForEachEdge(edges, [&](std::span<const FaceEdge> sharing) {
    for (const FaceEdge& edge : sharing) {
      edge_of[3 * edge.face + edges_seen[edge.face]++] = static_cast<std::uint32_t>(left.size());
    }
    first.push_back(static_cast<std::uint32_t>(sharing.data() - edges.data()));
    left.push_back(static_cast<std::uint32_t>(sharing.size()));
  });
  first.push_back(static_cast<std::uint32_t>(edges.size()));
  std::vector<bool> kept(faces.size(), true);
  std::vector<std::uint32_t> alone;
  for (std::uint32_t e = 0; e < left.size(); ++e) {
    if (left[e] == 1) alone.push_back(e);
  }
  while (!alone.empty()) {
    const std::uint32_t e = alone.back();
    alone.pop_back();
    for (std::uint32_t i = first[e]; i < first[e + 1]; ++i) {
      const std::uint32_t face = edges[i].face;
      if (!kept[face]) continue;
      kept[face] = false;
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t other = edge_of[3 * face + k];
        if (--left[other] == 1) alone.push_back(other);
      }
    }
  }
  return kept;
}

}  // namespace clearway
