// The numbers that a glTF file keeps in its buffers: where they are, not what they are.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/first_error.h"
#include "io/gltf_file.h"
#include "io/gltf_members.h"

namespace clearway {

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
  // Numbers of a used view that no accessor has may be lost vertices or faces.
  void CheckViewsCovered();
  // Those that the used buffers name.
  const std::vector<std::string>& files() const { return files_; }

 private:
  void UseView(std::uint64_t view, std::uint64_t end, const Kind& kind, const std::string& place);
  void UseBuffer(std::uint64_t buffer, std::uint64_t end, const std::string& place);
  std::uint64_t EndOf(const Json& accessor, std::uint64_t stride) const;
  std::string Uri(const Json& buffer, std::uint64_t bytes, const std::string& place);

  const GltfFile& file_;
  FirstError& error_;
  GltfMembers members_;
  Json& reduced_;
  std::vector<bool> marked_;
  std::vector<std::string> files_;
};

}  // namespace clearway
