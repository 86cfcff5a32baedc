#include "closed_loop/course.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace clearway::closed_loop {
namespace {

using Eigen::Vector2d;

constexpr double kLength_m = 12, kHalfWidth_m = 7, kBehindEnds_m = 3;
constexpr double kLasts_s = 30, kFastest_mps = 1.5;
// Between whatever stands, and between that and what passes: the robot is 0.6 m wide.
constexpr double kApart_m = 2.0, kPassageBesideWalls_m = 1.0, kBetweenObjects_m = 0.3;
constexpr double kRoomAtStart_m = 2.0, kQuietAtStart_s = 3;
constexpr double kStep_s = 0.1;  // of the check of all that

// Random numbers that are the same with every standard library.
class Dice {
 public:
  Dice(std::uint64_t seed, Traffic traffic) : engine_(2 * seed + (traffic == Traffic::kTurning)) {}
  double Between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  int Below(int count) { return static_cast<int>(Between(0, count)); }
  double Sign() { return Below(2) == 0 ? -1 : 1; }

 private:
  std::mt19937_64 engine_;
};

// What stands, from above: all points within a radius of a segment.
struct Footprint {
  Vector2d from_W, to_W;
  double radius_m;

  double GapTo(const Vector2d& p_W) const {
    const Vector2d along = to_W - from_W;
    const double length2 = along.squaredNorm();
    const double share =
        length2 > 0 ? std::clamp((p_W - from_W).dot(along) / length2, 0.0, 1.0) : 0;
    return (from_W + share * along - p_W).norm() - radius_m;
  }
};

// How big a body is from above, and how it moves.
struct Mover {
  Shape shape;
  double radius_m;
  Trajectory trajectory;

  Vector2d At(double seconds) const {
    return PoseAt(trajectory, Time(FromSeconds(seconds))).translation.head<2>();
  }
};

// What has been placed.
struct Track {
  double radius_m;
  std::vector<Vector2d> points_W = {};  // every kStep_s
};

Pose OnGround(const Vector2d& p_W, double yaw_rad, double height_m) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ())),
          {p_W.x(), p_W.y(), 0.5 * height_m}};
}

// Makes one course.
class CourseMaker {
 public:
  CourseMaker(std::uint64_t seed, Traffic traffic) : dice_(seed, traffic), traffic_(traffic) {
    course_.errand.goal_W = {kLength_m, 0};
    course_.errand.area_W = {{-kBehindEnds_m, -kHalfWidth_m, -1},
                             {kLength_m + kBehindEnds_m, kHalfWidth_m, 3}};
  }

  Course Make() {
    const int walls = 2, pillars = 2 + dice_.Below(2);
    const int objects = traffic_ == Traffic::kSteady ? 4 + dice_.Below(5) : 8 + dice_.Below(7);
    for (int i = 0; i < walls; ++i) AddStanding(dice_.Between(2, 3.5));
    for (int i = 0; i < pillars; ++i) AddStanding(0);
    for (int i = 0; i < objects; ++i) AddMoving();
    return std::move(course_);
  }

 private:
  static constexpr int kTries = 1000;  // what does not fit by then is left out

  // A wall of that length, or a pillar.
  void AddStanding(double length_m) {
    constexpr double kHeight_m = 2, kThick_m = 0.2;
    for (int i = 0; i < kTries; ++i) {
      const Vector2d p_W(dice_.Between(3, kLength_m - 3), dice_.Between(-5, 5));
      const double yaw_rad = dice_.Between(0, std::numbers::pi);
      const double radius_m = length_m > 0 ? 0.5 * kThick_m : dice_.Between(0.15, 0.35);
      const Vector2d half_W = 0.5 * length_m * Vector2d(std::cos(yaw_rad), std::sin(yaw_rad));
      const Footprint footprint{p_W - half_W, p_W + half_W, radius_m};
      const bool room = std::ranges::all_of(standing_, [&](const Footprint& other) {
        return other.GapTo(p_W) > 0.5 * length_m + radius_m + kApart_m;
      });
      if (!room) continue;
      standing_.push_back(footprint);
      const Shape shape = length_m > 0 ? Shape(Box{{length_m, kThick_m, kHeight_m}})
                                       : Shape(Cylinder{radius_m, kHeight_m});
      course_.world.Add(Body::Single(kStaticLabel, length_m > 0 ? "wall" : "pillar", shape,
                                     FixedPose{OnGround(p_W, yaw_rad, kHeight_m)}));
      return;
    }
  }

  void AddMoving() {
    for (int i = 0; i < kTries; ++i) {
      const Mover mover = RandomMover();
      std::optional<Track> track = TrackOf(mover);
      if (!track) continue;
      const auto id = static_cast<ObjectId>(moving_.size() + 1);
      const char* const kind = std::holds_alternative<Box>(mover.shape) ? "cart " : "person ";
      course_.world.Add(Body::Single(id, kind + std::to_string(id), mover.shape, mover.trajectory));
      moving_.push_back(*std::move(track));
      return;
    }
  }

  // Somebody who would be on the straight way about when the robot is.
  Mover RandomMover() {
    constexpr double kRobotSpeed_mps = 1.5, kApartInTime_s = 4;
    const bool cart = dice_.Below(2) == 0;
    const Eigen::Vector3d size_m(dice_.Between(0.8, 1.8), dice_.Between(0.5, 0.9),
                                 dice_.Between(1.0, 1.6));
    const double radius_m = cart ? 0.5 * size_m.head<2>().norm() : dice_.Between(0.2, 0.35);
    const double speed_mps = dice_.Between(traffic_ == Traffic::kSteady ? 0.3 : 0.7, kFastest_mps);
    const double yaw_rad = dice_.Sign() * (0.5 * std::numbers::pi + dice_.Between(-0.7, 0.7));
    const double meets_x_m = dice_.Between(2.5, kLength_m - 2.5);
    const double meets_s =
        meets_x_m / kRobotSpeed_mps + dice_.Between(-kApartInTime_s, 2 * kApartInTime_s);
    const Vector2d heading(std::cos(yaw_rad), std::sin(yaw_rad));
    const double height_m = cart ? size_m.z() : 1.7;
    const Pose T_W_B =
        OnGround(Vector2d(meets_x_m, 0) - speed_mps * meets_s * heading, yaw_rad, height_m);
    return {cart ? Shape(Box{size_m}) : Shape(Cylinder{radius_m, height_m}), radius_m,
            traffic_ == Traffic::kSteady ? Trajectory(Steady(T_W_B, speed_mps))
                                         : Trajectory(Turning(T_W_B, speed_mps))};
  }

  static ConstantTwist Steady(const Pose& T_W_B, double speed_mps) {
    return {T_W_B, {.linear = {speed_mps, 0, 0}}, Time()};
  }

  // Legs of all kinds, one after the other. Turns lead back to the middle, so that nobody is gone
  // soon.
  Drive Turning(const Pose& T_W_B, double speed_mps) {
    Drive drive{.T_W_B = T_W_B, .start_speed_mps = speed_mps};
    Time now;
    const auto add = [&](double lasts_s, double end_speed_mps, double turn_rad) {
      drive.legs.push_back({FromSeconds(lasts_s), end_speed_mps, turn_rad});
      now += drive.legs.back().duration;
    };
    while (now < Time(FromSeconds(kLasts_s))) {
      const double changes_s = dice_.Between(0.3, 0.8);
      add(dice_.Between(0.3, 2), speed_mps, 0);
      if (dice_.Below(3) > 0) {
        const Eigen::Vector3d middle_B =
            Inverse(PoseAt(drive, now)) * Eigen::Vector3d(0.5 * kLength_m, 0, 0);
        add(changes_s, speed_mps, std::copysign(dice_.Between(0.8, 2.4), middle_B.y()));
      } else {
        add(0.5 * changes_s, 0, 0);
        add(dice_.Between(0.3, 2.5), 0, 0);
        add(0.5 * changes_s, speed_mps, 0);
      }
    }
    return drive;
  }

  // Where its middle is every kStep_s, if there is room for it all the way.
  std::optional<Track> TrackOf(const Mover& mover) const {
    Track track{.radius_m = mover.radius_m};
    for (std::size_t i = 0; i * kStep_s <= kLasts_s; ++i) {
      const Vector2d p_W = mover.At(i * kStep_s);
      if (!HasRoom(mover.radius_m, p_W, i)) return std::nullopt;
      track.points_W.push_back(p_W);
    }
    return track;
  }

  bool HasRoom(double radius_m, const Vector2d& p_W, std::size_t step) const {
    const bool at_start = (p_W - course_.errand.start_W).norm() < radius_m + kRoomAtStart_m;
    if (at_start && step * kStep_s <= kQuietAtStart_s) return false;
    return std::ranges::all_of(standing_,
                               [&](const Footprint& other) {
                                 return other.GapTo(p_W) > radius_m + kPassageBesideWalls_m;
                               }) &&
           std::ranges::all_of(moving_, [&](const Track& other) {
             return (other.points_W[step] - p_W).norm() >
                    other.radius_m + radius_m + kBetweenObjects_m;
           });
  }

  Dice dice_;
  Traffic traffic_;
  Course course_;
  std::vector<Footprint> standing_;
  std::vector<Track> moving_;
};

}  // namespace

Course MakeCourse(std::uint64_t seed, Traffic traffic) { return CourseMaker(seed, traffic).Make(); }

}  // namespace clearway::closed_loop
