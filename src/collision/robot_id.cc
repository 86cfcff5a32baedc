#include <xxhash.h>

#include <bit>
#include <cstring>

#include "absl/strings/str_format.h"
#include "clearway/collision/robot.h"

namespace clearway {
namespace {

// A robot as bytes, the same on every machine: 64-bit little-endian words, strings and lists after
// their length. Zero has one sign.
class CanonicalBytes {
 public:
  void Add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) bytes_.push_back(static_cast<char>(word >> (8 * byte)));
  }
  void Add(double value) { Add(std::bit_cast<std::uint64_t>(value + 0.0)); }
  void Add(const std::string& text) {
    Add(std::uint64_t{text.size()});
    bytes_ += text;
  }
  void Add(const Eigen::Vector3d& v) {
    for (int axis = 0; axis < 3; ++axis) Add(v[axis]);
  }
  void Add(const Pose& pose) {
    for (int i = 0; i < 4; ++i) Add(pose.rotation.coeffs()[i]);
    Add(pose.translation);
  }
  void Add(const Shape& shape) {
    Add(std::uint64_t{shape.index()});
    std::visit([this](const auto& s) { AddContent(s); }, shape);
  }

  const std::string& bytes() const { return bytes_; }

 private:
  void AddContent(const Sphere& s) { Add(s.radius_m); }
  void AddContent(const Box& b) { Add(b.size_m); }
  void AddContent(const Capsule& c) {
    Add(c.radius_m);
    Add(c.length_m);
  }
  void AddContent(const Cylinder& c) {
    Add(c.radius_m);
    Add(c.length_m);
  }
  void AddContent(const ConvexPolytope& c) { AddMesh(*c.mesh); }
  void AddContent(const TriangleMesh& t) { AddMesh(*t.mesh); }
  void AddMesh(const Mesh& mesh) {
    Add(std::uint64_t{mesh.vertices.size()});
    for (const Eigen::Vector3d& vertex : mesh.vertices) Add(vertex);
    Add(std::uint64_t{mesh.triangles.size()});
    for (const auto& triangle : mesh.triangles) {
      for (std::uint32_t index : triangle) Add(std::uint64_t{index});
    }
  }

  std::string bytes_;
};

}  // namespace

std::string RobotId(const Robot& robot) {
  CanonicalBytes content;
  content.Add(robot.name);
  content.Add(std::uint64_t{robot.links.size()});
  for (const Link& link : robot.links) {
    content.Add(link.name);
    content.Add(std::uint64_t{link.shapes.size()});
    for (const LinkShape& part : link.shapes) {
      content.Add(part.T_L_G);
      content.Add(part.shape);
    }
  }
  const XXH128_hash_t hash = XXH3_128bits(content.bytes().data(), content.bytes().size());
  return absl::StrFormat("%016x%016x", hash.high64, hash.low64);
}

}  // namespace clearway
