// Point clouds that are one file. The first line is "text" or "graph".
#include "clearway/io/point_cloud_file.h"
#include "fuzz/fuzz.h"

namespace clearway::fuzz {
namespace {

void RequireFinite(const PosedCloud& cloud) {
  for (const Eigen::Vector3f& point : cloud.points_S) {
    Require(point.allFinite(), "a point is not finite");
  }
}

void Run(std::string_view input) {
  const std::string_view kind = TakeLine(input);
  if (kind == "text") {
    const auto cloud = ParseTextCloud("cloud", input);
    RequireForeseen(cloud.status());
    if (cloud.ok()) RequireFinite(*cloud);
  } else if (kind == "graph") {
    RequireForeseen(ParseScanGraph("graph", input).status());
  }
}

}  // namespace
}  // namespace clearway::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  clearway::fuzz::Run(clearway::fuzz::TextOf(data, size));
  return 0;
}
