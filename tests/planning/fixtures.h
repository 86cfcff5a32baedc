// Spaces and checkers that several planning tests use.
#pragma once

#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <memory>
#include <vector>

#include "clearway/planning/space_time.h"
#include "planning/disc_world.h"

namespace clearway {

// Silences OMPL's log and seeds its random numbers for the program that includes this.
inline const bool kOmplSilenced = (ompl::msg::noOutputHandler(), true);
inline const bool kOmplSeeded = (ompl::RNG::setSeed(20240928), true);

constexpr double kHalfTurn = 3.14159265358979323846;

inline ompl::base::RealVectorBounds Bounds(unsigned int dimension, double low, double high) {
  ompl::base::RealVectorBounds bounds(dimension);
  bounds.setLow(low);
  bounds.setHigh(high);
  return bounds;
}

inline std::shared_ptr<ompl::base::RealVectorStateSpace> MakeRn(unsigned int n, double reach = 10) {
  auto space = std::make_shared<ompl::base::RealVectorStateSpace>(n);
  space->setBounds(Bounds(n, -reach, reach));
  return space;
}

inline std::shared_ptr<ompl::base::SE2StateSpace> MakeSe2(double reach = 10) {
  auto space = std::make_shared<ompl::base::SE2StateSpace>();
  space->setBounds(Bounds(2, -reach, reach));
  return space;
}

inline std::shared_ptr<ompl::base::SE3StateSpace> MakeSe3(double reach = 10) {
  auto space = std::make_shared<ompl::base::SE3StateSpace>();
  space->setBounds(Bounds(3, -reach, reach));
  return space;
}

// Up to 2 m/s and 1 rad/s, 20 s.
inline std::shared_ptr<SpaceTimeStateSpace> WithTime(ompl::base::StateSpacePtr space) {
  return std::make_shared<SpaceTimeStateSpace>(std::move(space), SpeedLimits{2.0, 1.0},
                                               std::chrono::seconds(20));
}

// A state of its real values, in the order of getValueAddressAtIndex.
inline ompl::base::ScopedState<> MakeState(const ompl::base::StateSpacePtr& space,
                                           const std::vector<double>& values) {
  ompl::base::ScopedState<> state(space);
  for (std::size_t i = 0; i < values.size(); ++i) {
    *space->getValueAddressAtIndex(state.get(), static_cast<unsigned int>(i)) = values[i];
  }
  return state;
}

// Answers every call with an error.
class FailingChecker : public StateChecker {
 public:
  explicit FailingChecker(absl::Status status) : status_(std::move(status)) {}
  absl::StatusOr<CheckReply> Check(const StateBatch&, const CheckOptions&) const override {
    return status_;
  }
  absl::StatusOr<MotionReply> CheckMotions(const MotionBatch&,
                                           const MotionOptions&) const override {
    return status_;
  }
  const Robot& robot() const override { return robot_; }
  std::uint64_t version() const override { return 7; }
  Time stamp() const override { return Time(); }

 private:
  Robot robot_ = DeliveryRobot();
  absl::Status status_;
};

}  // namespace clearway
