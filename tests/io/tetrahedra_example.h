// Mesh files in the simple formats, of three tetrahedra or of one.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"

namespace clearway {

// A tetrahedron before two others, so that indices have two digits.
inline constexpr char kObj[] =
    "# two tetrahedra\no first\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n"
    "f 3 1 4\no second\nv 2 0 0\nv 3 0 0\nv 2 1 0\nv 2 0 1\nv 2 0 2\nv 3 0 2\nv 2 1 2\nv 2 0 3\n"
    "f 5 7 6\nf 5 6 8\nf 6 7 8\nf 7 5 8\nf 9 11 10\nf 9 10 12\nf 10 11 12\nf 11 9 12\n";
inline constexpr char kVertices[] =
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n2 0 0\n3 0 0\n2 1 0\n2 0 1\n2 0 2\n3 0 2\n2 1 2\n2 0 3\n";
inline constexpr char kFaces[] =
    "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 4 6 5\n3 4 5 7\n3 5 6 7\n3 6 4 7\n3 8 10 9\n3 8 9 11\n"
    "3 9 10 11\n3 8 11 10\n";
inline constexpr char kPlyHeader[] =
    "ply\nformat ascii 1.0\ncomment x\nelement vertex 12\nproperty float x\nproperty float y\n"
    "property float z\nelement face 12\nproperty list uchar int vertex_indices\nend_header\n";

inline std::string AsciiPly() { return absl::StrCat(kPlyHeader, kVertices, kFaces); }
inline std::string Off() { return absl::StrCat("OFF\n12 12 0\n", kVertices, kFaces); }

// Little endian, unless asked.
template <class T>
void Put(std::string& out, T value, bool big_endian = false) {
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  out += bytes;
}

// One tetrahedron.
inline std::string BinaryPly(bool big_endian = false) {
  std::string ply = absl::StrReplaceAll(
      kPlyHeader, {{"ascii", big_endian ? "binary_big_endian" : "binary_little_endian"},
                   {"vertex 12", "vertex 4"},
                   {"face 12", "face 4"}});
  for (const float x : {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) Put(ply, x, big_endian);
  for (const std::array<int, 3>& face :
       {std::array{0, 2, 1}, std::array{0, 1, 3}, std::array{1, 2, 3}, std::array{2, 0, 3}}) {
    ply += '\3';
    for (const int corner : face) Put(ply, static_cast<std::int32_t>(corner), big_endian);
  }
  return ply;
}

// An ascii PLY file of one face with these corners.
inline std::string PlyFace(const std::vector<Eigen::Vector3d>& corners) {
  std::string ply = absl::StrCat("ply\nformat ascii 1.0\nelement vertex ", corners.size(),
                                 "\nproperty double x\nproperty double y\nproperty double z\n"
                                 "element face 1\nproperty list int int vertex_index\n"
                                 "end_header\n");
  std::string face = absl::StrCat(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    absl::StrAppend(&ply, corners[i].x(), " ", corners[i].y(), " ", corners[i].z(), "\n");
    absl::StrAppend(&face, " ", i);
  }
  return ply + face + "\n";
}

using Corners = std::array<float, 9>;
inline constexpr std::array<Corners, 4> kTriangles = {
    Corners{0, 0, 0, 0, 1, 0, 1, 0, 0}, Corners{0, 0, 0, 1, 0, 0, 0, 0, 1},
    Corners{1, 0, 0, 0, 1, 0, 0, 0, 1}, Corners{0, 1, 0, 0, 0, 0, 0, 0, 1}};

inline std::string AsciiStl() {
  std::string stl = "solid a b\n";
  for (const Corners& c : kTriangles) {
    stl += " facet normal 0 0 nan\n  outer loop\n";
    for (int i = 0; i < 9; i += 3) {
      absl::StrAppend(&stl, "   vertex ", c[i], " ", c[i + 1], " ", c[i + 2], "\n");
    }
    stl += "  endloop\n endfacet\n";
  }
  return stl + "endsolid a b\n";
}

inline std::string BinaryStl() {
  std::string stl = "solid, though it is binary";
  stl.resize(80, ' ');
  Put(stl, static_cast<std::uint32_t>(kTriangles.size()));
  for (const Corners& corners : kTriangles) {
    stl.append(12, '\0');
    for (const float x : corners) Put(stl, x);
    stl.append(2, '\0');
  }
  return stl;
}

}  // namespace clearway
