// Answers of `clearway check`, printed.
#pragma once

#include <ostream>

#include "clearway/collision/state_checker.h"

namespace clearway::cli {

// What was asked, as the answers need it. Arrays are parallel.
struct CheckedStates {
  const Robot& robot;
  const std::vector<Pose>& T_W_R;
  const StateBatch& batch;
  const CheckReply& reply;
};

void PrintCheckJson(std::ostream& out, const CheckedStates& checked);
void PrintCheckText(std::ostream& out, const CheckedStates& checked);

// States that are anything but free.
std::size_t NotFree(const CheckReply& reply);

}  // namespace clearway::cli
