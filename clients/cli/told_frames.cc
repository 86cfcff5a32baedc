#include "cli/told_frames.h"

#include <numbers>

#include "clearway/report/true_ids.h"
#include "clearway/sim/bleeding_masks.h"
#include "clearway/sim/missed_objects.h"
#include "clearway/sim/wrong_labels.h"
#include "cli/cli.h"

namespace clearway::cli {

void AddErrorFlags(CLI::App* command, ErrorFlags* flags) {
  const char* const group = "Errors of the source";
  CLI::Option* const wrong_labels = command
                                        ->add_option("--wrong-labels", flags->wrong_labels,
                                                     "Give this share of the points a wrong label")
                                        ->check(Between(0, 1))
                                        ->capture_default_str()
                                        ->group(group);
  command
      ->add_option("--wrong-labels-seed", flags->wrong_labels_seed,
                   "Which points get a wrong label, and which one")
      ->needs(wrong_labels)
      ->check(NotNegative())
      ->capture_default_str()
      ->group(group);
  command
      ->add_option("--mask-bleed", flags->mask_bleed_deg,
                   "Give what is seen within so many degrees of an object its\nlabel")
      ->check(Between(0, 20))
      ->capture_default_str()
      ->group(group);
  command
      ->add_option("--forget", flags->forget_s,
                   "Give objects that were out of sight for so many seconds\na new id")
      ->check(Between(0, 1000))
      ->group(group);
  command
      ->add_option("--unlabelled", flags->unlabelled,
                   "Take the objects of these ids for a part of the static\nworld")
      ->check(CLI::Range(1, 1'000'000'000).description(""))
      ->delimiter(',')
      ->type_name("ID,...")
      ->group(group);
  command
      ->add_option("--parts", flags->parts,
                   "Tell objects that consist of parts as such (told), as an\nobject for each part "
                   "(apart), or as one rigid object (one)")
      ->check(CLI::IsMember({"told", "apart", "one"}).description(""))
      ->capture_default_str()
      ->group(group);
}

FrameTeller::FrameTeller(const ErrorFlags& flags)
    : wrong_labels_(flags.wrong_labels),
      wrong_labels_seed_(flags.wrong_labels_seed),
      mask_bleed_rad_(flags.mask_bleed_deg * std::numbers::pi / 180),
      parts_(flags.parts),
      unlabelled_(flags.unlabelled.begin(), flags.unlabelled.end()) {
  if (flags.forget_s) tracker_.emplace(FromSeconds(*flags.forget_s));
}

Frame FrameTeller::Tell(const Frame& frame) {
  Frame told = WithBleedingMasks(WithoutObjects(frame, unlabelled_), mask_bleed_rad_);
  if (parts_ == "one") told = WithoutParts(std::move(told));
  if (parts_ == "apart") told.parts.clear();
  if (tracker_) told = tracker_->Retold(std::move(told));
  return WithWrongLabels(std::move(told), wrong_labels_, wrong_labels_seed_);
}

ScenePtr FrameTeller::WithTrueNames(const Frame& told, const ScenePtr& scene) {
  if (!tracker_) return scene;
  identities_.Add(told, *scene, tracker_->true_ids());
  return WithTrueIds(*scene, tracker_->true_ids());
}

std::optional<Identities> FrameTeller::identities() const {
  return tracker_ ? std::optional(identities_.Result()) : std::nullopt;
}

}  // namespace clearway::cli
