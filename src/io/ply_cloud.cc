#include "io/cloud_points.h"
#include "io/ply_vertices.h"

namespace clearway {

absl::StatusOr<CloudPoints> ReadPlyCloud(const std::filesystem::path& path,
                                         const std::string& label_field) {
  CloudPoints cloud;
  constexpr bool kNoIndex = false, kMayBeNan = true;
  std::vector<PlyProperty> properties = {
      {"x", kNoIndex, kMayBeNan}, {"y", kNoIndex, kMayBeNan}, {"z", kNoIndex, kMayBeNan}};
  const bool labelled = !label_field.empty();
  if (labelled) properties.push_back({label_field.c_str(), kNoIndex, kMayBeNan});
  const auto values = ReadPlyVertices(path, properties, &cloud.fields);
  if (!values.ok()) return values.status();
  const std::size_t width = properties.size(), count = values->size() / width;
  cloud.points_S.reserve(count);
  cloud.labels.reserve(count);
  LabelReader labels;
  for (std::size_t i = 0; i < count; ++i) {
    const double* const row = values->data() + i * width;
    cloud.points_S.push_back(Eigen::Vector3d(row[0], row[1], row[2]).cast<float>());
    cloud.labels.push_back(labelled ? labels.LabelOf(row[3], path.string(), i) : kStaticLabel);
  }
  if (!labels.status().ok()) return labels.status();
  return cloud;
}

}  // namespace clearway
