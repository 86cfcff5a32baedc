#include "wire/robot_wire.h"

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

void WriteMesh(const Mesh& mesh, v1::Mesh* proto) {
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    for (int i = 0; i < 3; ++i) proto->add_vertices_m(vertex[i]);
  }
  for (const auto& triangle : mesh.triangles) {
    for (std::uint32_t vertex : triangle) proto->add_triangles(vertex);
  }
}

void WriteTriangles(const TriangleMesh& s, v1::LinkShape* proto) {
  WriteMesh(*s.mesh, proto->mutable_mesh());
}
void WriteTriangles(const TriangleMesh& s, v1::ConvexShape* proto) {
  WriteMesh(*s.mesh, proto->mutable_convex());
}

// Of a LinkShape or a ConvexShape.
template <class Proto>
struct ShapeWriter {
  Proto* proto;
  void operator()(const Sphere& s) const { proto->mutable_sphere()->set_radius_m(s.radius_m); }
  void operator()(const Box& s) const { Write(s.size_m, proto->mutable_box()->mutable_size_m()); }
  void operator()(const Capsule& s) const {
    proto->mutable_capsule()->set_radius_m(s.radius_m);
    proto->mutable_capsule()->set_length_m(s.length_m);
  }
  void operator()(const Cylinder& s) const {
    proto->mutable_cylinder()->set_radius_m(s.radius_m);
    proto->mutable_cylinder()->set_length_m(s.length_m);
  }
  void operator()(const ConvexPolytope& s) const { WriteMesh(*s.mesh, proto->mutable_convex()); }
  void operator()(const TriangleMesh& s) const { WriteTriangles(s, proto); }
};

std::shared_ptr<const Mesh> ReadMesh(const std::string& field, const v1::Mesh& proto,
                                     FieldReader& read) {
  auto mesh = std::make_shared<Mesh>();
  mesh->vertices = read.Triples<double>(field + ".vertices_m", proto.vertices_m(), true);
  if (proto.triangles_size() % 3 != 0) {
    read.Fail(field + ".triangles", "its length is not a multiple of 3");
  }
  if (!read.ok()) return mesh;
  for (int i = 0; i < proto.triangles_size(); i += 3) {
    mesh->triangles.push_back({proto.triangles(i), proto.triangles(i + 1), proto.triangles(i + 2)});
  }
  return mesh;
}

// Of a LinkShape or a ConvexShape: what they have in common.
template <class Proto>
Shape ReadShape(const std::string& field, const Proto& proto, FieldReader& read) {
  switch (proto.shape_case()) {
    case Proto::kSphere:
      return Sphere{proto.sphere().radius_m()};
    case Proto::kBox:
      return Box{
          read.Vector(field + ".box.size_m", proto.box().has_size_m(), proto.box().size_m())};
    case Proto::kCapsule:
      return Capsule{proto.capsule().radius_m(), proto.capsule().length_m()};
    case Proto::kCylinder:
      return Cylinder{proto.cylinder().radius_m(), proto.cylinder().length_m()};
    case Proto::kConvex:
      return ConvexPolytope{ReadMesh(field + ".convex", proto.convex(), read)};
    default:
      break;
  }
  read.Fail(field + ".shape", "is missing or of a kind that this server does not know");
  return Sphere{};
}

Shape ReadLinkShape(const std::string& field, const v1::LinkShape& proto, FieldReader& read) {
  if (proto.has_mesh()) return TriangleMesh{ReadMesh(field + ".mesh", proto.mesh(), read)};
  return ReadShape(field, proto, read);
}

std::uint64_t TriangleCount(const v1::Robot& proto) {
  std::uint64_t corners = 0;
  for (const v1::Link& link : proto.links()) {
    for (const v1::LinkShape& shape : link.shapes()) {
      corners += shape.mesh().triangles_size() + shape.convex().triangles_size();
    }
  }
  return corners / 3;
}

}  // namespace

void Write(const Robot& robot, v1::Robot* proto) {
  proto->set_name(robot.name);
  for (const Link& link : robot.links) {
    v1::Link* out = proto->add_links();
    out->set_name(link.name);
    for (const LinkShape& shape : link.shapes) {
      v1::LinkShape* shape_out = out->add_shapes();
      std::visit(ShapeWriter<v1::LinkShape>{shape_out}, shape.shape);
      Write(shape.T_L_G, shape_out->mutable_link_from_shape());
    }
  }
}

void Write(const Shape& shape, v1::ConvexShape* proto) {
  std::visit(ShapeWriter<v1::ConvexShape>{proto}, shape);
}

Shape ReadConvexShape(const std::string& field, const v1::ConvexShape& proto, FieldReader& read) {
  return ReadShape(field, proto, read);
}

absl::StatusOr<Robot> ReadRobot(const std::string& field, const v1::Robot& proto,
                                const ServerLimits& limits) {
  FieldReader read(field + ".");
  read.AtMost("links", proto.links_size(), limits.max_links_per_robot);
  read.AtMost("links", TriangleCount(proto), limits.max_triangles_per_robot);
  Robot robot;
  robot.name = proto.name();
  for (int l = 0; l < proto.links_size() && read.ok(); ++l) {
    Link link;
    link.name = proto.links(l).name();
    const auto& shapes = proto.links(l).shapes();
    for (int s = 0; s < shapes.size() && read.ok(); ++s) {
      const std::string path = absl::StrCat("links[", l, "].shapes[", s, "]");
      link.shapes.push_back(
          {ReadLinkShape(path, shapes[s], read),
           read.ReadPose(path + ".link_from_shape", shapes[s].has_link_from_shape(),
                         shapes[s].link_from_shape())});
    }
    robot.links.push_back(std::move(link));
  }
  if (!read.ok()) return read.status();
  return robot;
}

}  // namespace clearway
