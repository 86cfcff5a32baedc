// Which pose belongs to which point cloud, by the clouds' names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/base/time.h"

namespace clearway {

// Names in their natural order: runs of digits compare as numbers, so that "scan_9" comes before
// "scan_10".
bool NaturallyBefore(const std::string& a, const std::string& b);

// What the names of a folder's clouds have in common.
enum class CloudNaming {
  kStamps,   // all end in a stamp, behind the same text
  kNumbers,  // all end in a whole number, likewise
  kOther
};

struct NamedCloud {
  std::filesystem::path path;
  std::int64_t number = -1;  // kNumbers, and kStamps if it is whole
  Time stamp = Time();       // kStamps
};

struct NamedClouds {
  CloudNaming naming = CloudNaming::kOther;
  std::vector<NamedCloud> clouds;  // ascending stamps or numbers, else in the natural order
};

// A stamp is a number with a decimal point, in seconds, or a whole number of 10, 13, 16 or 19
// digits, in seconds, milli-, micro- or nanoseconds; but whole numbers with zeros in front that
// ascend by two at most, on average, are numbers (KITTI's 0000000000). INVALID_ARGUMENT if two
// clouds have the same stamp or number.
absl::StatusOr<NamedClouds> NameClouds(std::vector<std::filesystem::path> paths);

// The row of a table that each cloud belongs to; none for those that it has no row for.
struct CloudRows {
  bool by_number = false;  // else in the clouds' order
  std::vector<std::optional<std::size_t>> of_clouds;
};

// Of a table of `rows` poses, numbers and other names alike. INVALID_ARGUMENT, naming the folder,
// if it is not clear which row is whose.
absl::StatusOr<CloudRows> RowsOf(const NamedClouds& clouds, std::size_t rows,
                                 const std::string& folder);

}  // namespace clearway
