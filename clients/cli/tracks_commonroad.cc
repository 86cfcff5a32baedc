// CommonRoad 2018b and 2020a (commonroad.in.tum.de): times are steps, lengths metres, angles
// radians; what a file leaves uncertain (areas, intervals, sets of occupancies) is refused.
#include <cmath>

#include "absl/strings/str_cat.h"
#include "cli/commonroad_road.h"
#include "cli/tracks.h"
#include "cli/xml_file.h"

namespace clearway::cli {
namespace {

struct FileFacts {
  double step_s, height_m;
};

Pose OnThePlane(const Eigen::Vector2d& p_m, double yaw_rad) {
  Pose pose = Pose::Translation(p_m.x(), p_m.y(), 0);
  pose.rotation = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ());
  return pose;
}

// A shape, and where its middle is in the obstacle's own frame.
struct PlacedShape {
  Shape shape;
  Pose T_O_S;
};

absl::StatusOr<PlacedShape> ShapeOf(const XmlElement& obstacle, double height_m) {
  const auto element = obstacle.Child("shape");
  if (!element.ok()) return element.status();
  const auto parts = element->Children();
  if (parts.size() != 1 || (parts[0].name() != "rectangle" && parts[0].name() != "circle")) {
    return element->Error("expected one rectangle or circle");
  }
  const bool round = parts[0].name() == "circle";
  const auto a = parts[0].Number(round ? "radius" : "length");
  if (!a.ok()) return a.status();
  const auto b = parts[0].Number(round ? "radius" : "width");
  if (!b.ok()) return b.status();
  if (*a <= 0 || *b <= 0) return parts[0].Error("expected lengths above 0");
  const auto yaw = parts[0].NumberOr("orientation", 0);
  if (!yaw.ok()) return yaw.status();
  absl::StatusOr<Eigen::Vector2d> center = Eigen::Vector2d(0, 0);
  if (parts[0].Has("center")) center = PointOf(*parts[0].Child("center"));
  if (!center.ok()) return center.status();
  PlacedShape placed{Box{{*a, *b, height_m}}, OnThePlane(*center, *yaw)};
  if (round) placed.shape = Cylinder{*a, height_m};
  placed.T_O_S.translation.z() = height_m / 2;
  return placed;
}

absl::StatusOr<double> Exact(const XmlElement& state, const char* name) {
  const auto element = state.Child(name);
  if (!element.ok()) return element.status();
  if (element->Has("intervalStart")) return element->Error("expected an exact value, no interval");
  return element->Number("exact");
}

absl::StatusOr<Eigen::Vector2d> PositionOf(const XmlElement& state) {
  const auto position = state.Child("position");
  if (!position.ok()) return position.status();
  if (!position->Has("point")) return position->Error("expected a point");
  return PointOf(*position->Child("point"));
}

absl::StatusOr<Sighting> SightingOf(const XmlElement& state, const FileFacts& facts) {
  const auto position = PositionOf(state);
  if (!position.ok()) return position.status();
  const auto yaw_rad = Exact(state, "orientation"), time = Exact(state, "time");
  if (!yaw_rad.ok()) return yaw_rad.status();
  if (!time.ok()) return time.status();
  if (*time < 0 || *time != std::floor(*time)) return state.Error("time: expected a whole number");
  const auto speed_mps =
      state.Has("velocity") ? Exact(state, "velocity") : absl::StatusOr<double>(0.0);
  if (!speed_mps.ok()) return speed_mps.status();
  return Sighting{*time * facts.step_s, OnThePlane(*position, *yaw_rad),
                  *speed_mps * Eigen::Vector3d(std::cos(*yaw_rad), std::sin(*yaw_rad), 0)};
}

absl::Status ReadStates(const XmlElement& obstacle, const FileFacts& facts, Track& track) {
  const auto initial = obstacle.Child("initialState");
  if (!initial.ok()) return initial.status();
  std::vector<XmlElement> states = {*initial};
  if (track.moves) {
    const auto trajectory = obstacle.Child("trajectory");
    if (!trajectory.ok()) return trajectory.status();
    for (XmlElement& state : trajectory->Children("state")) states.push_back(std::move(state));
  }
  for (const XmlElement& state : states) {
    const auto seen = SightingOf(state, facts);
    if (!seen.ok()) return seen.status();
    if (!track.seen.empty() && seen->t_s <= track.seen.back().t_s) {
      return state.Error("time: not after the state before it");
    }
    track.seen.push_back(*seen);
  }
  const bool told = states.front().Has("velocity") && states.back().Has("velocity");
  if (!told) GuessVelocities(facts.step_s, track);
  return absl::OkStatus();
}

absl::StatusOr<Track> TrackOf(const XmlElement& obstacle, const FileFacts& facts) {
  Track track;
  std::string role = obstacle.name() == "staticObstacle" ? "static" : "dynamic";
  if (obstacle.name() == "obstacle") {  // 2018b
    const auto element = obstacle.Child("role");
    if (!element.ok()) return element.status();
    role = element->Text();
    if (role != "static" && role != "dynamic") return element->Error("expected static or dynamic");
  }
  track.moves = role == "dynamic";
  track.name = absl::StrCat(role, " obstacle ", obstacle.Attribute("id"));
  const auto placed = ShapeOf(obstacle, facts.height_m);
  if (!placed.ok()) return placed.status();
  track.shape = placed->shape;
  if (auto status = ReadStates(obstacle, facts, track); !status.ok()) return status;
  for (Sighting& seen : track.seen) seen.T_W_O = seen.T_W_O * placed->T_O_S;
  return track;
}

absl::StatusOr<std::vector<Track>> TracksOf(const XmlElement& root, const FileFacts& facts) {
  std::vector<Track> tracks;
  for (const XmlElement& element : root.Children()) {
    const std::string name = element.name();
    if (name == "environmentObstacle" || name == "phantomObstacle") {
      return element.Error("is not supported");
    }
    if (name != "obstacle" && name != "dynamicObstacle" && name != "staticObstacle") continue;
    auto track = TrackOf(element, facts);
    if (!track.ok()) return track.status();
    tracks.push_back(*std::move(track));
  }
  return tracks;
}

absl::StatusOr<XmlElement> LoadCommonRoad(const std::filesystem::path& file) {
  auto root = XmlElement::Load(file, "commonRoad");
  if (!root.ok()) return root.status();
  const std::string version = root->Attribute("commonRoadVersion");
  if (version == "2018b" || version == "2020a") return root;
  return root->Error(
      absl::StrCat("commonRoadVersion: expected 2018b or 2020a, not \"", version, "\""));
}

}  // namespace

absl::StatusOr<Tracks> ReadCommonRoadTracks(const Json& value, const std::string& path) {
  const auto fields = JsonFields::Of(
      value, path, {"format", "file", "from_s", "for_s", "height_m", "road_edges", "origin_m"});
  if (!fields.ok()) return fields.status();
  const auto height_m = fields->Positive("height_m");
  if (!height_m.ok()) return height_m.status();
  const auto with_edges = fields->FlagOr("road_edges", false);
  if (!with_edges.ok()) return with_edges.status();
  const auto file = RecordedFile(*fields);
  if (!file.ok()) return file.status();
  const auto root = LoadCommonRoad(*file);
  if (!root.ok()) return root.status();
  const auto step_s = root->NumberAttribute("timeStepSize");
  if (!step_s.ok()) return step_s.status();
  if (*step_s <= 0) return root->Error("timeStepSize: expected a number above 0");
  auto tracks = TracksOf(*root, {*step_s, *height_m});
  if (!tracks.ok()) return tracks.status();
  if (*with_edges) {
    const auto edges = RoadEdgesOf(*root, *height_m);
    if (!edges.ok()) return edges.status();
    tracks->insert(tracks->end(), edges->begin(), edges->end());
  }
  return Tracks{*std::move(tracks), {}};
}

}  // namespace clearway::cli
