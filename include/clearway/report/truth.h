// What really happened, whatever a SLAM system or a map says of it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clearway/geometry/shape.h"
#include "clearway/io/lidar_folder.h"
#include "clearway/report/top_view.h"
#include "clearway/scene/world_corrections.h"
#include "clearway/sim/world.h"

namespace clearway {

// A box of an object at one time: B at its centre, x along its length. Of size 0 if nobody told.
struct TrueBox {
  ObjectId id = 0;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  Pose T_W_B;
};

// The truth of a whole sequence. A value; any thread may ask.
struct Truth {
  std::string description;  // for people: "the recorded boxes"
  Time end;                 // nothing is known of later times
  // The stamps for which boxes were told, ascending: between two that lie more than a second apart
  // there are none. Empty: there are some at any time.
  std::vector<Time> told;
  // The boxes of what is there at that time, by ascending ids.
  std::function<std::vector<TrueBox>(Time)> boxes;
  // What the shape touches: the lowest id of an object, else 0 for the static world (where it is
  // known), else none.
  std::function<std::optional<ObjectId>(const Shape&, const Pose& T_W_G, Time)> touched;
};

// Of a simulated world: exact shapes, the static ones included.
Truth TruthOf(std::shared_ptr<const World> world, Time end);
// Of a recording: its boxes, between two frames moved along the screw from the one to the other.
// The static world is not recorded.
Truth TruthOf(const LidarFolder& folder);

// The truth as a source's world V tells it, in the scene's world W: what is at a place of V at t is
// where that place was taken to be at t. Of a recording whose boxes were measured from the sensor.
Truth CarriedBy(WorldCorrections corrections, Truth truth_V);

std::optional<TrueBox> BoxOf(const Truth& truth, ObjectId id, Time t);

// The outlines from above of the boxes at that time, for a picture.
std::vector<TopViewOutline> OutlinesAt(const Truth& truth, Time t);

}  // namespace clearway
