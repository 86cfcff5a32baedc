#include "cli/check_flags.h"

#include <istream>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "cli/json_file.h"
#include "cli/message.h"

namespace clearway::cli {
namespace {

// "LINK:OBJECT".
absl::StatusOr<std::pair<int, ObjectId>> ContactOf(const std::string& text, const Robot& robot) {
  const std::size_t colon = text.rfind(':');
  ObjectId object = 0;
  if (colon == std::string::npos || !absl::SimpleAtoi(text.substr(colon + 1), &object)) {
    return UsageError("--allow: expected LINK:OBJECT, not '" + text + "'");
  }
  for (std::size_t link = 0; link < robot.links.size(); ++link) {
    if (robot.links[link].name == text.substr(0, colon)) {
      return std::pair(static_cast<int>(link), object);
    }
  }
  return UsageError(
      absl::StrCat("--allow: robot ", robot.name, " has no link '", text.substr(0, colon), "'"));
}

}  // namespace

absl::StatusOr<UnknownArgument> ParseUnknown(const std::string& text) {
  if (text == "blocked") return UnknownArgument{UnknownPolicy::kBlocked, 0};
  if (text == "free") return UnknownArgument{UnknownPolicy::kFree, 0};
  const auto fraction = ParseFinite(text);
  if (!fraction.ok() || *fraction < 0 || *fraction > 1) {
    return absl::InvalidArgumentError(
        absl::StrCat("expected blocked, free, or a share from 0 to 1, not '", text, "'"));
  }
  return UnknownArgument{UnknownPolicy::kTolerated, *fraction};
}

namespace {

// By how much moving objects are grown.
void AddGrowthFlags(CLI::App* command, CheckFlags* flags) {
  command
      ->add_option("--inflation", flags->inflation_mps,
                   "Metres added round each moving object per second\nof prediction")
      ->check(Between(0, 1e3));
  command
      ->add_option(
          "--bounds", flags->bound_multiple,
          "Added likewise: so many times how far from its\nprediction each object is in 95 "
          "of 100 cases")
      ->check(Between(0, 100));
  command->add_flag("--inflate-moving-only", flags->inflate_moving_only,
                    "Objects known to be at rest are not grown");
}

}  // namespace

void AddCheckFlags(CLI::App* command, CheckFlags* flags) {
  command
      ->add_option("--robot", flags->robot,
                   "A robot file (docs/formats.md), or one shape:\nbox:x,y,z  sphere:radius  "
                   "cylinder:radius,length\ncapsule:radius,length")
      ->required();
  AddParsedList(command, "--state", &flags->states, ParseState,
                "Pose of the robot's base, in metres and radians; T as\n+1.5 after the newest "
                "stamp, or absolute\n(may be repeated)")
      ->type_name("X,Y,Z,YAW[,T]");
  command
      ->add_option("--states", flags->states_file,
                   "A CSV file of states with the columns x,y,z,yaw\n(or qx,qy,qz,qw) and t; - is "
                   "stdin")
      ->type_name("FILE");
  AddParsed(command, "--unknown", &flags->unknown, ParseUnknown,
            "Unknown space is blocked, free, or tolerated up to\na share of the robot's volume, as "
            "0.1\n(default: blocked)")
      ->type_name("POLICY");
  AddParsedList(command, "--known-free", &flags->known_free, ParseBox,
                "A box where unknown space is free (may be repeated)")
      ->type_name("X,Y,Z,X,Y,Z");
  command->add_option("--padding", flags->padding_m, "Metres added all round the robot")
      ->check(Between(0, 1e5));
  AddGrowthFlags(command, flags);
  command
      ->add_option("--clearance", flags->clearance_m,
                   "Also the distance to what blocks, up to this many\nmetres")
      ->check(Between(0, 1e5));
  command->add_option("--ignore", flags->ignore, "Leave this object out (may be repeated)")
      ->take_all()
      ->allow_extra_args(false);
  command
      ->add_option("--allow", flags->allow,
                   "LINK:OBJECT may touch; object 0 is the static map\n(may be repeated)")
      ->take_all()
      ->allow_extra_args(false);
  command->add_flag("--require-free", flags->require_free,
                    "Exit with 1 unless every state is free");
  command->add_flag("--json", flags->json, "Print JSON");
  AddServerFlags(command, &flags->server);
}

absl::StatusOr<std::vector<TimedBase>> StatesOf(const CheckFlags& flags, std::istream& in) {
  std::vector<TimedBase> states = flags.states;
  if (!flags.states_file.empty()) {
    const bool standard = flags.states_file == "-";
    const auto text = standard ? ReadStream("stdin", in) : ReadTextFile(flags.states_file, "table");
    if (!text.ok()) return text.status();
    auto read = ReadStates(standard ? "stdin" : flags.states_file, *text);
    if (!read.ok()) return read.status();
    states.insert(states.end(), read->begin(), read->end());
  }
  if (states.empty()) return UsageError("give --state or --states");
  return states;
}

absl::StatusOr<CheckOptions> CheckOptionsOf(const CheckFlags& flags, const Robot& robot) {
  CheckOptions options;
  options.unknown = flags.unknown.policy;
  options.max_unknown_fraction = flags.unknown.max_fraction;
  options.with_unknown_fraction = true;
  options.known_free_W = flags.known_free;
  options.padding_m = flags.padding_m;
  options.inflation_mps = flags.inflation_mps;
  options.bound_multiple = flags.bound_multiple;
  options.inflate_moving_only = flags.inflate_moving_only;
  options.ignored_objects = flags.ignore;
  options.clearance_up_to_m = flags.clearance_m;
  for (const std::string& text : flags.allow) {
    const auto contact = ContactOf(text, robot);
    if (!contact.ok()) return contact.status();
    options.allowed_contacts.push_back(*contact);
  }
  return options;
}

}  // namespace clearway::cli
