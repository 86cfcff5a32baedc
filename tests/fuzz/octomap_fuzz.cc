// Maps of OctoMap: what is read can be written, is then read as the same, and can be resampled.
#include "clearway/io/octomap_file.h"
#include "fuzz/fuzz.h"

namespace clearway::fuzz {
namespace {

constexpr OctomapLimits kLimits = {.max_bytes = 1 << 20, .max_voxels = 1 << 20};

void Run(std::string_view input) {
  const auto file = ParseOctomap("map", input, {}, kLimits);
  RequireForeseen(file.status());
  if (!file.ok()) return;
  Require(file->map.observed_count() <= kLimits.max_voxels, "more voxels than may be");
  const auto written = SerializeOctomap(file->map, file->format);
  RequireForeseen(written.status());
  Require(written.ok(), "a map that was read cannot be written");
  const auto again = ParseOctomap("map", *written, {}, kLimits);
  Require(again.ok(), "what was written cannot be read: " + again.status().ToString());
  const auto second = SerializeOctomap(again->map, again->format);
  Require(second.ok() && *second == *written, "what was written is read as another map");
  RequireForeseen(Resample(file->map, 1.7 * file->map.grid().resolution_m(), 1 << 20).status());
}

}  // namespace
}  // namespace clearway::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  clearway::fuzz::Run(clearway::fuzz::TextOf(data, size));
  return 0;
}
