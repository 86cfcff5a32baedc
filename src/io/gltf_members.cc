#include "io/gltf_members.h"

#include <Eigen/Geometry>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "io/mesh_lines.h"

namespace clearway {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kMaxWhole = 0xffffffff;
constexpr double kMaxNormError = 1e-3;  // of a rotation's quaternion

}  // namespace

const Json& GltfMembers::Get(const Json& object, const char* key) {
  static const Json* const null = new Json();
  const auto member = object.find(key);
  return member == object.end() ? *null : *member;
}

const Json& GltfMembers::List(const Json& object, const std::string& place, const char* key) const {
  static const Json* const empty = new Json(Json::array());
  const auto member = object.find(key);
  if (member == object.end()) return *empty;
  if (member->is_array()) return *member;
  error_.Set(place, absl::StrCat(key, " must be a list"));
  return *empty;
}

const Json& GltfMembers::Object(const Json& object, const std::string& place,
                                const char* key) const {
  static const Json* const empty = new Json(Json::object());
  const auto member = object.find(key);
  if (member == object.end()) return *empty;
  if (member->is_object()) return *member;
  error_.Set(place, absl::StrCat(key, " must be an object"));
  return *empty;
}

std::uint64_t GltfMembers::Whole(const Json& object, const std::string& place,
                                 const char* key) const {
  if (!object.contains(key)) error_.Set(place, absl::StrCat(key, " is missing"));
  return WholeOr(object, place, key, 0);
}

std::uint64_t GltfMembers::WholeOr(const Json& object, const std::string& place, const char* key,
                                   std::uint64_t otherwise) const {
  const auto member = object.find(key);
  if (member == object.end()) return otherwise;
  if (member->is_number_unsigned() && member->get<std::uint64_t>() <= kMaxWhole) {
    return member->get<std::uint64_t>();
  }
  error_.Set(place, absl::StrCat(key, " is ", Quoted(member->dump()),
                                 "; it must be a whole number from 0 to ", kMaxWhole));
  return 0;
}

std::vector<double> GltfMembers::Numbers(const Json& object, const std::string& place,
                                         const char* key, std::size_t count) const {
  std::vector<double> numbers;
  for (const Json& number : List(object, place, key)) {
    if (number.is_number() && std::isfinite(number.get<double>())) {
      numbers.push_back(number.get<double>());
    }
  }
  if (numbers.size() == count && List(object, place, key).size() == count) return numbers;
  error_.Set(place, absl::StrCat(key, " must be ", count, " numbers"));
  return std::vector<double>(count);
}

std::uint64_t GltfMembers::Index(const Json& number, const std::string& place,
                                 const char* list) const {
  const std::uint64_t count = List(file_, "", list).size();
  if (number.is_number_unsigned() && number.get<std::uint64_t>() < count) {
    return number.get<std::uint64_t>();
  }
  error_.Set(place, absl::StrCat("names ", list, "[", number.dump().substr(0, 40), "] of ", count,
                                 " (the first is 0)"));
  return 0;
}

const Json& GltfMembers::Element(std::uint64_t index, const char* list) const {
  static const Json* const empty = new Json(Json::object());
  const Json& elements = List(file_, "", list);
  if (index < elements.size() && elements[index].is_object()) return elements[index];
  error_.Set(absl::StrCat(list, "[", index, "]"), "must be an object");
  return *empty;
}

Eigen::Matrix4d GltfMembers::Transform(const Json& node, const std::string& place) const {
  if (node.contains("matrix")) {
    const Eigen::Matrix4d matrix(Numbers(node, place, "matrix", 16).data());
    if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1) || node.contains("translation") ||
        node.contains("rotation") || node.contains("scale")) {
      error_.Set(place,
                 "its matrix must be alone and end, row by row, with 0, 0, 0, 1 "
                 "(glTF lists columns)");
    }
    return matrix;
  }
  Eigen::Affine3d T_parent_node = Eigen::Affine3d::Identity();
  if (node.contains("translation")) {
    T_parent_node.translate(Eigen::Vector3d(Numbers(node, place, "translation", 3).data()));
  }
  if (node.contains("rotation")) {
    const Eigen::Quaterniond rotation(Numbers(node, place, "rotation", 4).data());
    if (!(std::abs(rotation.norm() - 1) <= kMaxNormError)) {
      error_.Set(place, "its rotation is not a unit quaternion");
    }
    T_parent_node.rotate(rotation.normalized());
  }
  if (node.contains("scale")) {
    T_parent_node.scale(Eigen::Vector3d(Numbers(node, place, "scale", 3).data()));
  }
  return T_parent_node.matrix();
}

}  // namespace clearway
