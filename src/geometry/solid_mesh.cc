#include "clearway/geometry/solid_mesh.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "absl/container/flat_hash_set.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "clearway/geometry/hull.h"
#include "geometry/face_edges.h"
#include "geometry/outer_shells.h"
#include "geometry/split_edges.h"
#include "geometry/weld.h"

namespace clearway {
namespace {

constexpr double kTolerance = 1e-6;  // of the mesh's size and distance from its frame's origin

using Points = std::vector<Eigen::Vector3d>;

// The faces of a mesh, sorted out.
struct Draft {
  std::vector<Face> closed;  // may bound a solid
  std::vector<Face> loose;   // with an area, but part of no closed surface
  std::size_t doubled = 0;
};

bool HasArea(const Face& face, const Points& points, double tolerance_m) {
  const Eigen::Vector3d ab = points[face[1]] - points[face[0]],
                        ac = points[face[2]] - points[face[0]];
  const double longest_m = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
  return ab.cross(ac).norm() > tolerance_m * longest_m;
}

// Faces between corners of their own, no three corners twice.
Draft Sorted(const std::vector<Face>& faces, const Points& points, double tolerance_m) {
  Draft draft;
  std::vector<Face> distinct;
  absl::flat_hash_set<Face> seen;
  for (const Face& face : faces) {
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
    Face corners = face;
    std::sort(corners.begin(), corners.end());
    if (seen.insert(corners).second) {
      distinct.push_back(face);
    } else {
      ++draft.doubled;
    }
  }
  const std::vector<bool> kept = WithoutLooseFaces(distinct);
  for (std::size_t f = 0; f < distinct.size(); ++f) {
    if (kept[f]) {
      draft.closed.push_back(distinct[f]);
    } else if (HasArea(distinct[f], points, tolerance_m)) {
      draft.loose.push_back(distinct[f]);
    }
  }
  return draft;
}

std::vector<Face> Welded(const Mesh& mesh, const std::vector<std::uint32_t>& standing) {
  std::vector<Face> faces;
  for (const auto& [a, b, c] : mesh.triangles) {
    faces.push_back({standing[a], standing[b], standing[c]});
  }
  return faces;
}

// Collects the faces of the solid and what was done to get them.
class SolidBuilder {
 public:
  SolidBuilder(const Mesh& given, double tolerance_m)
      : given_(given), tolerance_m_(tolerance_m), points_(given.vertices) {}

  SolidMesh Build(std::shared_ptr<const Mesh> given) {
    const Draft draft = Prepare();
    // Splitting makes several of one.
    face_count_ = std::max(given_.triangles.size(), draft.closed.size() + draft.loose.size());
    AddClosed(draft.closed);
    AddLoose(draft.loose, draft.closed.empty());
    if (draft.doubled > 0) notes_.push_back(absl::StrCat(draft.doubled, " doubled faces dropped"));
    if (turned_ > 0) {
      notes_.push_back(absl::StrCat(turned_, " of ", face_count_, " faces turned"));
    }
    if (inner_ > 0) notes_.push_back(absl::StrCat(inner_, " faces inside the solid dropped"));
    if (faces_.empty() || (notes_.empty() && !changed_)) return {std::move(given), open_};
    if (!open_.empty()) notes_.push_back(open_);
    return {std::make_shared<const Mesh>(Compact()), absl::StrJoin(notes_, "; ")};
  }

 private:
  // Welds and splits no more than it takes to close the surface.
  Draft Prepare() {
    std::vector<Face> faces = Welded(given_, WeldEqual(points_));
    Draft draft = Sorted(faces, points_, tolerance_m_);
    if (draft.loose.empty()) return draft;
    const auto take_if_better = [&](std::vector<Face> others, const char* note) {
      Draft other = Sorted(others, points_, tolerance_m_);
      if (other.loose.size() >= draft.loose.size()) return;
      draft = std::move(other);
      faces = std::move(others);
      notes_.push_back(note);
    };
    take_if_better(Welded(given_, WeldNear(points_, tolerance_m_)), "close vertices welded");
    if (draft.loose.empty()) return draft;
    take_if_better(SplitAtVerticesOnEdges(faces, points_, tolerance_m_),
                   "edges split at vertices on them");
    return draft;
  }

  void AddClosed(const std::vector<Face>& faces) {
    const std::vector<Surface> surfaces = SurfacesOf(faces);
    const std::vector<Side> sides = OuterSidesOf(faces, surfaces, points_);
    for (const Surface& surface : surfaces) {
      if (sides[surface.faces[0]] != Side::kUnknown) {
        for (const std::uint32_t f : surface.faces) AddOutward(faces[f], sides[f]);
        continue;
      }
      std::vector<Face> unclear;
      for (const std::uint32_t f : surface.faces) unclear.push_back(faces[f]);
      AddHull(unclear, "their outer sides are ambiguous");
    }
  }

  // One open surface keeps its shape. Several may bound one solid, whatever their sides.
  void AddLoose(const std::vector<Face>& faces, bool alone) {
    if (faces.empty()) return;
    const std::vector<Surface> surfaces = SurfacesOf(faces);
    const std::vector<Side> sides = OuterSidesOf(faces, surfaces, points_);
    if (!alone || surfaces.size() > 1 || sides[0] == Side::kUnknown) {
      AddHull(faces, surfaces.size() > 1 ? "they are several open surfaces"
                                         : "their outer sides are ambiguous");
      return;
    }
    for (std::size_t f = 0; f < faces.size(); ++f) AddOutward(faces[f], sides[f]);
    open_ = "the surface is open; it is solid where it winds more than half round a point";
  }

  void AddOutward(const Face& face, Side outside) {
    if (outside == Side::kNone) {
      ++inner_;
    } else if (outside == Side::kFront) {
      faces_.push_back(face);
    } else {
      faces_.push_back({face[0], face[2], face[1]});
      ++turned_;
    }
  }

  // Faces in a plane bound nothing: they stay, and wind round no point.
  void AddHull(const std::vector<Face>& faces, const char* why) {
    Points corners;
    std::vector<std::uint32_t> used;
    for (const Face& face : faces) used.insert(used.end(), face.begin(), face.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const std::uint32_t vertex : used) corners.push_back(points_[vertex]);
    const Mesh hull = ConvexHullOf(corners);
    changed_ = true;
    if (hull.triangles.empty()) {
      notes_.push_back(
          absl::StrCat(faces.size(), " faces lie in a plane: they have a surface, but no inside"));
      for (const Face& face : faces) {
        faces_.push_back(face);
        faces_.push_back({face[0], face[2], face[1]});
      }
      return;
    }
    const auto first = static_cast<std::uint32_t>(points_.size());
    points_.insert(points_.end(), hull.vertices.begin(), hull.vertices.end());
    for (const auto& [a, b, c] : hull.triangles) {
      faces_.push_back({first + a, first + b, first + c});
    }
    notes_.push_back(absl::StrCat(faces.size(), " faces replaced by their convex hull, as ", why));
  }

  // Without vertices of no face.
  Mesh Compact() const {
    constexpr std::uint32_t kUnused = 0xffffffff;
    std::vector<std::uint32_t> index(points_.size(), kUnused);
    Mesh mesh;
    for (Face face : faces_) {
      for (std::uint32_t& corner : face) {
        std::uint32_t& at = index[corner];
        if (at == kUnused) {
          at = static_cast<std::uint32_t>(mesh.vertices.size());
          mesh.vertices.push_back(points_[corner]);
        }
        corner = at;
      }
      mesh.triangles.push_back(face);
    }
    return mesh;
  }

  const Mesh& given_;
  const double tolerance_m_;
  Points points_;
  std::vector<Face> faces_;
  std::vector<std::string> notes_;
  std::string open_;
  std::size_t face_count_ = 0, turned_ = 0, inner_ = 0;
  bool changed_ = false;
};

}  // namespace

SolidMesh SolidMeshOf(std::shared_ptr<const Mesh> mesh) {
  if (mesh == nullptr || mesh->triangles.empty()) return {std::move(mesh), ""};
  const Aabb box = BoundingBox(TriangleMesh{mesh});
  const double size_m =
      box.Size().norm() + box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).maxCoeff();
  SolidBuilder builder(*mesh, kTolerance * size_m);
  return builder.Build(std::move(mesh));
}

}  // namespace clearway
