// Converters of delta.proto's DynamicVoxels.
#pragma once

#include <span>
#include <vector>

#include "clearway/scene/dynamic_space.h"
#include "clearway/v1/delta.pb.h"
#include "wire/geometry_wire.h"

namespace clearway {

// Of a version with that stamp.
void Write(std::span<const DynamicVoxel> voxels, Time stamp, v1::DynamicVoxels* proto);

// Adds them to `voxels`; what is wrong is `read`'s error.
void ReadDynamic(const v1::DynamicVoxels& proto, Time stamp, FieldReader& read,
                 std::vector<DynamicVoxel>& voxels);

}  // namespace clearway
