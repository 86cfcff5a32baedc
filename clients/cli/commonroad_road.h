// Points and the outer edges of the road of a CommonRoad file.
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "cli/tracks.h"
#include "cli/xml_file.h"

namespace clearway::cli {

// Its x and y; INVALID_ARGUMENT if they are no numbers, or too far away for any map.
absl::StatusOr<Eigen::Vector2d> PointOf(const XmlElement& point);

// The bounds of lanelets without a neighbour on that side, as thin boxes that stand on the ground.
// Where roads cross, lanelets overlap without being neighbours, and edges lie across the way.
absl::StatusOr<std::vector<Track>> RoadEdgesOf(const XmlElement& road, double height_m);

}  // namespace clearway::cli
