// The numbers that a glTF file keeps in its buffers: where they are, not what they are.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/first_error.h"
#include "io/gltf_file.h"

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

 private:
  const Json& file_;
  FirstError& error_;
};

// Checks accessors, their buffer views and their buffers, and puts those that are used into the
// reduced file, under their old numbers.
class GltfAccessors {
 public:
  using Json = nlohmann::json;
  struct Kind {
    const char* type;
    std::vector<std::uint64_t> component_types;
    std::uint64_t components;
    bool has_stride;
  };
  static const Kind& Positions();
  static const Kind& Indices();

  // All must outlive it.
  GltfAccessors(const GltfFile& file, FirstError& error, Json& reduced);

  // Returns the number of its elements.
  std::uint64_t Use(std::uint64_t accessor, const Kind& kind);
  // Says that something refers to it: nothing about the shape, so a wrong number does not matter.
  void Mark(const Json& number);
  void CheckAllMarked();
  // Those that the used buffers name.
  const std::vector<std::string>& files() const { return files_; }

 private:
  void UseView(std::uint64_t view, std::uint64_t end, const Kind& kind, const std::string& place);
  void UseBuffer(std::uint64_t buffer, std::uint64_t end, const std::string& place);
  std::string Uri(const Json& buffer, std::uint64_t bytes, const std::string& place);

  const GltfFile& file_;
  FirstError& error_;
  GltfMembers members_;
  Json& reduced_;
  std::vector<bool> marked_;
  std::vector<std::string> files_;
};

}  // namespace clearway
