#include "cli/check_output.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "clearway/report/table.h"
#include "cli/json.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

std::string LinkName(const Robot& robot, int link) {
  if (link < 0 || link >= static_cast<int>(robot.links.size())) return "";
  return robot.links[link].name;
}

// Whom to blame: an object, or the static map where it is occupied.
std::string What(const StateAnswer& answer) {
  if (answer.status == SpaceStatus::kFree) return "";
  if (answer.object != kStaticLabel) return absl::StrCat("object ", answer.object);
  return answer.status == SpaceStatus::kOccupied ? "static map" : "";
}

double YawOf(const Pose& pose) {
  const Eigen::Vector3d forward = pose.rotation * Eigen::Vector3d::UnitX();
  return std::atan2(forward.y(), forward.x());
}

}  // namespace

std::size_t NotFree(const CheckReply& reply) {
  return std::count_if(reply.answers.begin(), reply.answers.end(), [](const StateAnswer& answer) {
    return answer.status != SpaceStatus::kFree;
  });
}

void PrintCheckJson(std::ostream& out, const CheckedStates& checked) {
  Json states = Json::array();
  for (std::size_t i = 0; i < checked.reply.answers.size(); ++i) {
    const StateAnswer& answer = checked.reply.answers[i];
    const bool free = answer.status == SpaceStatus::kFree;
    Json state = {{"time_ns", ToNanoseconds(checked.batch.times[i])},
                  {"world_from_base", ToJson(checked.T_W_R[i])},
                  {"status", ToJson(answer.status)},
                  {"link", free ? Json(nullptr) : Json(LinkName(checked.robot, answer.link))},
                  {"object_id", free ? Json(nullptr) : Json(answer.object)}};
    if (answer.unknown_fraction) state["unknown_fraction"] = *answer.unknown_fraction;
    if (answer.clearance_m) state["clearance_m"] = *answer.clearance_m;
    states.push_back(std::move(state));
  }
  Print(out, {{"version", checked.reply.version},
              {"stamp_ns", ToNanoseconds(checked.reply.stamp)},
              {"robot", checked.robot.name},
              {"not_free", NotFree(checked.reply)},
              {"states", std::move(states)}});
}

void PrintCheckText(std::ostream& out, const CheckedStates& checked) {
  out << "scene version " << checked.reply.version << ", newest stamp "
      << Seconds(checked.reply.stamp) << ", robot " << checked.robot.name << "\n";
  std::vector<std::string> header = {"time", "position", "yaw rad", "status",
                                     "link", "by",       "unknown"};
  const bool clearance =
      std::any_of(checked.reply.answers.begin(), checked.reply.answers.end(),
                  [](const StateAnswer& answer) { return answer.clearance_m.has_value(); });
  if (clearance) header.push_back("clearance m");
  Table table(header);
  for (std::size_t i = 0; i < checked.reply.answers.size(); ++i) {
    const StateAnswer& answer = checked.reply.answers[i];
    table.AddRow({Seconds(checked.batch.times[i]), Point(checked.T_W_R[i].translation),
                  Fixed(YawOf(checked.T_W_R[i]), 2), ToString(answer.status),
                  LinkName(checked.robot, answer.link), What(answer),
                  answer.unknown_fraction ? Fixed(100 * *answer.unknown_fraction, 1) + " %" : "",
                  answer.clearance_m ? Fixed(*answer.clearance_m, 2) : ""});
  }
  out << table.ToString();
}

}  // namespace clearway::cli
