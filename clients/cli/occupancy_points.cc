#include <cmath>

#include "absl/strings/str_cat.h"
#include "clearway/map/occupancy_model.h"
#include "clearway/report/table.h"
#include "cli/json.h"
#include "cli/occupancy_answers.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

// Each point at each time, point-major.
struct PointQuestion {
  std::vector<Eigen::Vector3f> points_W;
  std::vector<Time> times;
};

PointQuestion CrossProduct(std::span<const Eigen::Vector3d> points, std::span<const Time> times) {
  PointQuestion question;
  for (const Eigen::Vector3d& point : points) {
    for (const Time time : times) {
      question.points_W.push_back(point.cast<float>());
      question.times.push_back(time);
    }
  }
  return question;
}

// What is there, in words: "object 3", "static map", nothing where nothing is known to be.
std::string What(const PointOccupancy& answer) {
  if (answer.object != kStaticLabel) return absl::StrCat("object ", answer.object);
  if (answer.dynamic) return "dynamic space";
  return answer.status == SpaceStatus::kOccupied ? "static map" : "";
}

Json AsJson(const PointQuestion& question, const PointAnswers& answers) {
  Json json = ToJson(static_cast<const Versioned&>(answers));
  json["points"] = Json::array();
  for (std::size_t i = 0; i < answers.points.size(); ++i) {
    const PointOccupancy& answer = answers.points[i];
    json["points"].push_back(
        {{"point_m", ToJson(question.points_W[i].cast<double>())},
         {"time_ns", ToNanoseconds(question.times[i])},
         {"status", ToJson(answer.status)},
         {"object_id", answer.object},
         {"dynamic", answer.dynamic},
         {"fused_log_odds", answer.fused_log_odds ? Json(*answer.fused_log_odds) : Json(nullptr)}});
  }
  return json;
}

}  // namespace

absl::Status AnswerPoints(const OccupancyFlags& flags, const SceneClient& client,
                          std::span<const Time> times, const Terminal& terminal) {
  const PointQuestion question = CrossProduct(flags.points, times);
  const auto answers = client.OccupancyOfPoints(question.points_W, question.times);
  if (!answers.ok()) return answers.status();
  if (answers->points.size() != question.points_W.size()) {
    return absl::InternalError("the server answered another number of points");
  }
  if (flags.json) {
    Print(terminal.out, AsJson(question, *answers));
    return absl::OkStatus();
  }
  Table table({"point", "time", "status", "by", "P(occupied)"});
  for (std::size_t i = 0; i < answers->points.size(); ++i) {
    const PointOccupancy& answer = answers->points[i];
    table.AddRow({Point(question.points_W[i].cast<double>()), Seconds(question.times[i]),
                  ToString(answer.status), What(answer),
                  answer.fused_log_odds ? Fixed(ProbabilityOf(*answer.fused_log_odds), 3) : "-"});
  }
  terminal.out << "scene version " << answers->version << ", newest stamp "
               << Seconds(answers->stamp) << "\n"
               << table.ToString();
  return absl::OkStatus();
}

}  // namespace clearway::cli
