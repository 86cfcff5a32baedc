// Comparing voxel sizes.
#pragma once

namespace clearway {

// Whether two voxel sizes in metres are the same as far as six significant digits tell, which is
// what OctoMap writes: 0.333333 is a third.
bool SameResolution(double one_m, double other_m);

}  // namespace clearway
