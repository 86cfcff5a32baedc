#include "io/ply_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "io/mesh_builder.h"
#include "io/ply_header.h"
#include "io/ply_rows.h"
#include "io/polygon_cutter.h"

namespace clearway {
namespace {

bool IsCornerList(const PlyElement::Property& property) {
  return property.count && (property.name == "vertex_indices" || property.name == "vertex_index");
}

class MeshReader {
 public:
  MeshReader(const std::string& name, std::string_view bytes, const MeshFileOptions& options)
      : options_(options),
        reader_(name, bytes),
        header_(TakePlyHeader(reader_, PlyContent::kAny)),
        rows_(header_.format, reader_),
        builder_(options.max_triangles) {}

  absl::StatusOr<Mesh> Read() {
    if (reader_.ok()) CheckElements();
    if (reader_.ok()) CheckVertexProperties();
    if (!reader_.ok()) return reader_.status();
    if (header_.format != PlyFormat::kAscii) reader_.EndLines();
    for (const PlyElement& element : header_.elements) {
      if (&element == vertex_) {
        ReadVertices();
      } else if (&element == face_) {
        ReadFaces();
      } else {
        SkipElement(element);
      }
      if (!reader_.ok()) return reader_.status();
    }
    rows_.CheckEnd();
    if (!reader_.ok()) return reader_.status();
    absl::StatusOr<Mesh> mesh = builder_.Finish();
    if (mesh.ok()) return mesh;
    reader_.FailWhole(std::string(mesh.status().message()));
    return reader_.status();
  }

 private:
  void CheckElements() {
    for (const PlyElement& element : header_.elements) {
      const auto lists = std::ranges::count_if(element.properties, IsCornerList);
      if (element.name == "vertex") vertex_ = &element;
      if (element.name == "face") {
        face_ = &element;
        if (vertex_ == nullptr) reader_.Fail("element face stands before element vertex");
        if (lists != 1) {
          reader_.Fail("element face must have one list vertex_indices or vertex_index");
        }
      } else if (lists > 0 && element.count > 0) {
        reader_.Fail(absl::StrCat("element ", PlyExcerpt(element.name),
                                  " lists vertices; only element face is read: export triangles"));
      }
    }
    if (face_ == nullptr) return reader_.Fail("no element face: a cloud of points is no mesh");
    if (face_->count > options_.max_triangles || vertex_->count / 3 > options_.max_triangles) {
      reader_.FailExhausted(absl::StrCat(vertex_->count, " vertices and ", face_->count,
                                         " faces; the limit is ", options_.max_triangles,
                                         " triangles and three times as many vertices"));
    }
  }

  void CheckVertexProperties() {
    axes_.resize(vertex_->properties.size());
    for (int axis = 0; axis < 3; ++axis) {
      const std::string name(1, "xyz"[axis]);
      const auto place = PlyPropertyNamed(name, *vertex_, reader_);
      if (!place) return;
      if (vertex_->properties[*place].count) reader_.Fail(absl::StrCat(name, " is a list"));
      axes_[*place] = axis;
    }
  }

  void ReadVertices() {
    // A header that promises more than the file can hold takes no memory.
    vertices_.reserve(std::min(vertex_->count, rows_.MaxRows(*vertex_)));
    for (std::uint64_t i = 0; i < vertex_->count; ++i) {
      Eigen::Vector3d vertex = Eigen::Vector3d::Zero();
      const auto put = [&](std::size_t property, double number) {
        if (axes_[property]) vertex[*axes_[property]] = options_.scale * number;
      };
      if (!rows_.Read(*vertex_, i, put)) return;
      if (!vertex.allFinite()) return reader_.Fail(absl::StrCat("vertex ", i, " is not finite"));
      vertices_.push_back(vertex);
    }
  }

  void ReadFaces() {
    const auto list = static_cast<std::size_t>(
        std::ranges::find_if(face_->properties, IsCornerList) - face_->properties.begin());
    for (std::uint64_t i = 0; i < face_->count; ++i) {
      corners_.clear();
      listed_ = 0;
      const auto put = [&](std::size_t property, double number) {
        if (property == list) AddCorner(i, number);
      };
      if (!rows_.Read(*face_, i, put)) return;
      AddFace(i);
      if (!reader_.ok()) return;
    }
  }

  void SkipElement(const PlyElement& element) {
    if (element.properties.empty()) return;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (!rows_.Read(element, i, [](std::size_t, double) {})) return;
    }
  }

  void AddCorner(std::uint64_t face, double number) {
    const auto count = static_cast<double>(vertices_.size());
    if (!(number >= 0 && number < count) || number != std::floor(number)) {
      return reader_.Fail(absl::StrCat("face ", face, " names vertex ", NumberText(number), " of ",
                                       vertices_.size(), " (the first is 0)"));
    }
    if (++listed_ > PolygonCutter::kMaxCorners) return;  // is refused below
    corners_.push_back(vertices_[static_cast<std::size_t>(number)]);
  }

  void AddFace(std::uint64_t i) {
    if (listed_ < 3 || listed_ > PolygonCutter::kMaxCorners) {
      return reader_.Fail(absl::StrCat("face ", i, " has a list of ", listed_,
                                       " vertices; a face has 3 to ", PolygonCutter::kMaxCorners));
    }
    if (listed_ == 3) return AddTriangle(i, {0, 1, 2});
    if (const auto status = cutter_.Cut(corners_); !status.ok()) {
      return FailAt(absl::StrCat("face ", i, " "), status);
    }
    for (const auto& triangle : cutter_.triangles()) AddTriangle(i, triangle);
  }

  void AddTriangle(std::uint64_t face, const std::array<std::uint32_t, 3>& triangle) {
    const auto& [a, b, c] = triangle;
    const auto added = builder_.Add(corners_[a], corners_[b], corners_[c]);
    if (!added.ok()) FailAt(absl::StrCat("face ", face, ": "), added.status());
  }

  void FailAt(const std::string& place, const absl::Status& error) {
    reader_.FailWith(absl::Status(error.code(), absl::StrCat(place, std::string(error.message()))));
  }

  const MeshFileOptions& options_;
  PlyReader reader_;
  PlyHeader header_;
  PlyRows rows_;
  const PlyElement* vertex_ = nullptr;
  const PlyElement* face_ = nullptr;
  std::vector<std::optional<int>> axes_;             // of the properties of a vertex
  std::vector<Eigen::Vector3d> vertices_, corners_;  // corners of the face that is read
  std::uint64_t listed_ = 0;                         // corners that its list states
  PolygonCutter cutter_;
  MeshBuilder builder_;
};

}  // namespace

absl::StatusOr<Mesh> ReadPlyMesh(const std::string& name, std::string_view bytes,
                                 const MeshFileOptions& options) {
  return MeshReader(name, bytes, options).Read();
}

}  // namespace clearway
