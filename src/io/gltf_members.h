// Members of a glTF file's objects.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/first_error.h"

namespace clearway {

// Reads members of JSON objects that must be there, or may be left out, and be of a type and size.
// What is wrong goes to the error, and reads as 0 or as empty.
class GltfMembers {
 public:
  using Json = nlohmann::json;

  // Both must outlive it.
  GltfMembers(const Json& file, FirstError& error) : file_(file), error_(error) {}

  // Null if the value is no object or has no such member.
  static const Json& Get(const Json& object, const char* key);
  const Json& List(const Json& object, const std::string& place, const char* key) const;
  const Json& Object(const Json& object, const std::string& place, const char* key) const;
  // A whole number below 2^32.
  std::uint64_t Whole(const Json& object, const std::string& place, const char* key) const;
  std::uint64_t WholeOr(const Json& object, const std::string& place, const char* key,
                        std::uint64_t otherwise) const;
  // As many numbers.
  std::vector<double> Numbers(const Json& object, const std::string& place, const char* key,
                              std::size_t count) const;
  // Which element of the file's list the number names; 0 if it is wrong.
  std::uint64_t Index(const Json& number, const std::string& place, const char* list) const;
  // The element itself.
  const Json& Element(std::uint64_t index, const char* list) const;
  // T_parent_node, from its matrix or from its translation, rotation and scale.
  Eigen::Matrix4d Transform(const Json& node, const std::string& place) const;

 private:
  const Json& file_;
  FirstError& error_;
};

}  // namespace clearway
