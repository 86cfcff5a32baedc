#include "wire/dynamic_wire.h"

namespace clearway {

void Write(std::span<const DynamicVoxel> voxels, Time stamp, v1::DynamicVoxels* proto) {
  for (const auto& [key, first_hit, last_hit] : voxels) {
    for (const std::int32_t i : {key.x, key.y, key.z}) proto->add_keys(i);
    proto->add_first_hit_ago_ns((stamp - first_hit).count());
    proto->add_last_hit_ago_ns((stamp - last_hit).count());
  }
}

void ReadDynamic(const v1::DynamicVoxels& proto, Time stamp, FieldReader& read,
                 std::vector<DynamicVoxel>& voxels) {
  const int size = proto.first_hit_ago_ns_size();
  read.Require(proto.keys_size() == 3 * size && proto.last_hit_ago_ns_size() == size, "dynamic",
               "has arrays of different lengths");
  const auto before = [&](const char* field, std::uint64_t ago_ns) {
    read.Require(ago_ns <= kFarthest_ns, field, "is too long");
    return read.ok() ? stamp - Duration(static_cast<std::int64_t>(ago_ns)) : stamp;
  };
  for (int i = 0; i < size && read.ok(); ++i) {
    voxels.push_back({{proto.keys(3 * i), proto.keys(3 * i + 1), proto.keys(3 * i + 2)},
                      before("dynamic.first_hit_ago_ns", proto.first_hit_ago_ns(i)),
                      before("dynamic.last_hit_ago_ns", proto.last_hit_ago_ns(i))});
  }
}

}  // namespace clearway
