// Flags of `clearway check`, and the options and states that they make.
#pragma once

#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "cli/cli.h"
#include "cli/robot_file.h"
#include "cli/server_flags.h"
#include "cli/state_list.h"

namespace clearway::cli {

// How unknown space counts.
struct UnknownArgument {
  UnknownPolicy policy = UnknownPolicy::kBlocked;
  double max_fraction = 0;
};

struct CheckFlags {
  ServerFlags server;
  std::string robot;
  std::vector<TimedBase> states;
  std::string states_file;
  UnknownArgument unknown;
  std::vector<Aabb> known_free;
  double padding_m = 0;
  double inflation_mps = 0, bound_multiple = 0;
  bool inflate_moving_only = false;
  std::optional<double> clearance_m;
  std::vector<ObjectId> ignore;
  std::vector<std::string> allow;
  bool require_free = false;
  bool json = false;
};

void AddCheckFlags(CLI::App* command, CheckFlags* flags);

// "blocked", "free", or the share of the robot's volume that may be unknown ("0.1").
absl::StatusOr<UnknownArgument> ParseUnknown(const std::string& text);

// --state and --states together; "-" is `in`.
absl::StatusOr<std::vector<TimedBase>> StatesOf(const CheckFlags& flags, std::istream& in);
// A usage error names --allow's link that the robot does not have.
absl::StatusOr<CheckOptions> CheckOptionsOf(const CheckFlags& flags, const Robot& robot);

}  // namespace clearway::cli
