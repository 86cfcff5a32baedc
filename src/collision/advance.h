// Going on by what is certainly free.
#pragma once

#include <Eigen/Core>
#include <limits>

#include "collision/separation.h"
#include "collision/touching.h"

namespace clearway {

inline constexpr double kNever = std::numeric_limits<double>::infinity();
inline constexpr int kMostAdvances = 24;

// From one share of a way to another, by gaps: gap_m(share) is at most the gap at that share of the
// way. Returns where there is none left, or kNever. (Mirtich, "Impulse-based Dynamic Simulation of
// Rigid Body Systems", 1996: conservative advancement.)
template <class Gap>
double Advance(double length_m, double from, double until, Gap&& gap_m) {
  double share = from;
  for (int step = 0; step < kMostAdvances; ++step) {
    if (share > until) return kNever;
    const double gap = gap_m(share);
    if (!(gap > kTouching_m)) return share;       // not a number: as bad as none
    if (gap - kKept_m > length_m) return kNever;  // more than is left
    share += (gap - kKept_m) / length_m;
  }
  return share > until ? kNever : share;
}

// The same by directions: apart(share) tells one along which what is met lies at least gap_m beyond
// what moves by way_F, so that both stay apart until that is used up along it.
template <class Apart>
double AdvanceAlong(const Eigen::Vector3d& way_F, double margin_m, double from, double until,
                    Apart&& apart) {
  double share = from;
  for (int step = 0; step < kMostAdvances && share <= until; ++step) {
    const Separation here = apart(share);
    const double gap_m = here.gap_m - margin_m, used_m = here.direction.dot(way_F);
    const double left_m = gap_m - kKept_m;
    if (left_m > 0 && left_m > (until - share) * used_m) return kNever;
    if (!(gap_m > kTouching_m)) return share;  // not a number: as bad as none
    share += (gap_m - kKept_m) / used_m;
  }
  return share > until ? kNever : share;
}

}  // namespace clearway
