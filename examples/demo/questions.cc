#include "demo/questions.h"

#include <array>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/report/table.h"

namespace clearway::demo {
namespace {

constexpr double kMovingMps = 0.5;
constexpr std::array kOffsetsS{0.0, 0.5, 1.0, 1.5, 2.0, 3.0};
constexpr double kLaterS = 1.5;

std::string NameOf(const Names& names, ObjectId id) {
  const auto name = names.find(id);
  return name != names.end() ? name->second : absl::StrCat("object ", id);
}

// A point that is asked about, and why.
struct Place {
  std::string name;
  Eigen::Vector3f p_W;
};

// Where moving objects' middles are now, and where they are predicted to be.
absl::StatusOr<std::vector<Place>> PlacesOf(const SceneClient& client, const ObjectList& list,
                                            const Names& names, const SceneQuery& query) {
  std::vector<const ObjectInfo*> moving;
  std::vector<ObjectId> ids;
  for (const ObjectInfo& object : list.objects) {
    if (object.speed_mps < kMovingMps || object.last_seen < list.stamp) continue;
    moving.push_back(&object);
    ids.push_back(object.id);
  }
  std::vector<Place> places;
  if (ids.empty()) return places;  // no ids would mean all
  const std::array times{list.stamp, list.stamp + FromSeconds(kLaterS)};
  const auto poses = client.PredictPoses(ids, times, query);
  if (!poses.ok()) return poses.status();
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const std::string name = NameOf(names, moving[i]->id);
    const Eigen::Vector3d middle_O = moving[i]->box_O.Center();
    const Pose& now = poses->poses[i * times.size()].T_W_O;
    const Pose& later = poses->poses[i * times.size() + 1].T_W_O;
    places.push_back({absl::StrCat("where ", name, " is now"), (now * middle_O).cast<float>()});
    places.push_back({absl::StrFormat("where %s will be in %g s", name, kLaterS),
                      (later * middle_O).cast<float>()});
  }
  return places;
}

std::string TextOf(const PointOccupancy& point, const Names& names) {
  if (point.status != SpaceStatus::kOccupied) return ToString(point.status);
  return point.object == kStaticLabel ? "static" : NameOf(names, point.object);
}

}  // namespace

absl::StatusOr<Answer> AskObjects(const SceneClient& client, const SceneSnapshot& scene,
                                  const Names& names) {
  const auto list = client.ListObjects({.min_version = scene.version, .lease_id = {}});
  if (!list.ok()) return list.status();
  Table table({"object", "frames seen", "voxels", "size (m)", "speed (m/s)", "last seen (s)"});
  Answer answer;
  answer.json = nlohmann::ordered_json::array();
  for (const ObjectInfo& info : list->objects) {
    const Eigen::Vector3d& size = info.extent.size_m;
    const std::string name = NameOf(names, info.id);
    table.AddRow({name, absl::StrCat(info.frames_seen), absl::StrCat(info.occupied_voxels),
                  absl::StrFormat("%.1f x %.1f x %.1f", size.x(), size.y(), size.z()),
                  absl::StrFormat("%.1f", info.speed_mps),
                  absl::StrFormat("%.1f", ToSeconds(info.last_seen.time_since_epoch()))});
    answer.json.push_back({{"id", info.id},
                           {"name", name},
                           {"frames_seen", info.frames_seen},
                           {"occupied_voxels", info.occupied_voxels},
                           {"size_m", {size.x(), size.y(), size.z()}},
                           {"speed_mps", info.speed_mps},
                           {"last_seen_ns", ToNanoseconds(info.last_seen)}});
  }
  answer.table = table.ToString();
  return answer;
}

absl::StatusOr<Answer> AskOccupancy(const SceneClient& client, const SceneSnapshot& scene,
                                    const Names& names) {
  const SceneQuery query{.min_version = scene.version, .lease_id = {}};
  const auto list = client.ListObjects(query);
  if (!list.ok()) return list.status();
  const auto places = PlacesOf(client, *list, names, query);
  if (!places.ok()) return places.status();
  std::vector<Eigen::Vector3f> points_W;
  std::vector<Time> times;
  for (const Place& place : *places) {
    for (const double offset_s : kOffsetsS) {
      points_W.push_back(place.p_W);
      times.push_back(list->stamp + FromSeconds(offset_s));
    }
  }
  const auto reply = client.OccupancyOfPoints(points_W, times, query);
  if (!reply.ok()) return reply.status();

  std::vector<std::string> header{"occupied by"};
  for (const double offset_s : kOffsetsS) {
    header.push_back(offset_s == 0 ? "now" : absl::StrFormat("+%g s", offset_s));
  }
  Table table(header);
  Answer answer;
  answer.json = nlohmann::ordered_json::array();
  auto point = reply->points.begin();
  for (const Place& place : *places) {
    std::vector<std::string> row{place.name};
    nlohmann::ordered_json answers = nlohmann::ordered_json::array();
    for (const double offset_s : kOffsetsS) {
      row.push_back(TextOf(*point, names));
      answers.push_back(
          {{"after_s", offset_s}, {"status", ToString(point->status)}, {"object", point->object}});
      ++point;
    }
    table.AddRow(row);
    answer.json.push_back({{"place", place.name},
                           {"point_world_m", {place.p_W.x(), place.p_W.y(), place.p_W.z()}},
                           {"answers", answers}});
  }
  answer.table = table.ToString();
  return answer;
}

}  // namespace clearway::demo
