// Points with properties out of PLY files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace clearway {

struct PlyProperty {
  const char* name;
  bool is_index = false;    // an integer of 32 bits without sign, else a finite number
  bool may_be_nan = false;  // or any number
};

// Reads these properties of the vertices of a file that holds nothing else: a row of numbers a
// vertex, in the order of `properties`, one after another. In ascii files a vertex is a line, as
// point clouds are written. `names`, unless it is null, gets the names of all properties of the
// file. NOT_FOUND; RESOURCE_EXHAUSTED above 1 GB or 20 million vertices; INVALID_ARGUMENT names the
// line: other elements or lists, a property that is not there, a line with more or fewer numbers
// than properties, fewer or more vertices than the header says, a last line that does not end. Any
// thread.
absl::StatusOr<std::vector<double>> ReadPlyVertices(const std::filesystem::path& path,
                                                    std::span<const PlyProperty> properties,
                                                    std::vector<std::string>* names = nullptr);

}  // namespace clearway
