// Frames as sources with errors tell them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "CLI/CLI.hpp"
#include "clearway/report/identity_score.h"
#include "clearway/sim/forgetful_tracker.h"

namespace clearway::cli {

struct ErrorFlags {
  double wrong_labels = 0;
  std::uint64_t wrong_labels_seed = 1;
  double mask_bleed_deg = 0;
  std::optional<double> forget_s;
  std::vector<ObjectId> unlabelled;
  std::string parts = "told";
};
void AddErrorFlags(CLI::App* command, ErrorFlags* flags);

// Retells frames with the errors of a segmentation and a tracker. One thread.
class FrameTeller {
 public:
  explicit FrameTeller(const ErrorFlags& flags);

  Frame Tell(const Frame& frame);
  // After Apply: the version with objects under their true ids.
  ScenePtr WithTrueNames(const Frame& told, const ScenePtr& scene);

  // Where objects came back under new ids.
  std::optional<Identities> identities() const;

 private:
  double wrong_labels_;
  std::uint64_t wrong_labels_seed_;
  double mask_bleed_rad_;
  std::string parts_;
  std::set<ObjectId> unlabelled_;
  std::optional<ForgetfulTracker> tracker_;
  IdentityScore identities_;
};

}  // namespace clearway::cli
