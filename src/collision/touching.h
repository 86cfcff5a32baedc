// What touching is, for states and for motions.
#pragma once

namespace clearway {

// A robot whose distance from an obstacle is at most kContact_m is in contact: so states that touch
// exactly are in contact whichever way their distance is rounded. Bounds are the other way round:
// a robot is inside as long as it exceeds them by at most kContact_m.
//
// What proves a motion free keeps kKept_m, so that times and poses may be rounded: a state of a
// motion that is proved free is free, to within rounding of some 1e-9 m. A motion that comes closer
// than kTouching_m stops there. States that are free closer than that are proved free where nothing
// moves; where something does, a motion may be unresolved.
inline constexpr double kContact_m = 2e-7, kKept_m = 3e-7, kTouching_m = 4e-7;

}  // namespace clearway
