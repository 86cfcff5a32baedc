#include "clearway/planning/arm.h"

#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace clearway {
namespace {

using RState = ompl::base::RealVectorStateSpace::StateType;

class ArmKinematics {
 public:
  ArmKinematics(const Robot& robot, const ArmSpace& arm) : arm_(arm) {
    const std::size_t joints = arm.joints.size();
    for (const Link& link : robot.links) reaches_m_.push_back(ReachOf(link));
    // From a joint's axis, which passes through its frame's origin, to a link beyond it: by way of
    // the origins of the joints between.
    from_joint_m_.assign(joints, std::vector<double>(robot.links.size(), 0));
    for (std::size_t i = 0; i < joints; ++i) {
      double between_m = 0;
      for (std::size_t link = i + 1; link < robot.links.size(); ++link) {
        from_joint_m_[i][link] = between_m + reaches_m_[link];
        if (link < joints) between_m += arm.joints[link].T_P_J.translation.norm();
      }
    }
  }

  void LinkPoses(const RState& angles, std::span<Pose> T_W_L) const {
    T_W_L[0] = arm_.T_W_B;
    for (std::size_t i = 0; i < arm_.joints.size(); ++i) {
      const Joint& joint = arm_.joints[i];
      const Eigen::AngleAxisd turn(angles[i], joint.axis_J.normalized());
      T_W_L[i + 1] =
          T_W_L[i] * joint.T_P_J * Pose{Eigen::Quaterniond(turn), Eigen::Vector3d::Zero()};
    }
  }

  // The farthest that any point goes.
  double PathBound(const RState& from, const RState& to) const {
    double most_m = 0;
    for (std::size_t link = 1; link < reaches_m_.size(); ++link) {
      double path_m = 0;
      for (std::size_t i = 0; i < link; ++i) {
        path_m += std::abs(to[i] - from[i]) * from_joint_m_[i][link];
      }
      most_m = std::max(most_m, path_m);
    }
    return most_m;
  }

  // With all joints at constant speed, d2p / dq_i dq_j = a_j x (a_i x (p - c_i)) for the joint i
  // farther out: no longer than p's distance from it. A curve whose second derivative is no longer
  // than A strays from its chord by no more than A / 8. The link that turns evenly between the same
  // ends has its own curve about its origin, of angle^2 * reach.
  void Deviations(const RState& from, const RState& to, std::span<double> deviations_m) const {
    for (std::size_t link = 0; link < reaches_m_.size(); ++link) {
      double bend_m = 0, turn_rad = 0;
      for (std::size_t i = 0; i < link; ++i) {
        const double angle_rad = std::abs(to[i] - from[i]);
        // This joint with itself, and twice with each of those before it.
        bend_m += angle_rad * (angle_rad + 2 * turn_rad) * from_joint_m_[i][link];
        turn_rad += angle_rad;
      }
      deviations_m[link] = (bend_m + turn_rad * turn_rad * reaches_m_[link]) / 8;
    }
  }

 private:
  // How far a link's shapes reach from its origin.
  static double ReachOf(const Link& link) {
    double reach_m = 0;
    for (const LinkShape& part : link.shapes) {
      const Aabb box = BoundingBox(part.shape);
      const Eigen::Vector3d corner = box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs());
      reach_m = std::max(reach_m, part.T_L_G.translation.norm() + corner.norm());
    }
    return reach_m;
  }

  ArmSpace arm_;
  std::vector<double> reaches_m_;                  // of the links
  std::vector<std::vector<double>> from_joint_m_;  // from a joint to a link's farthest point
};

const RState& AsAngles(const ompl::base::State* state) { return *state->as<RState>(); }

}  // namespace

StateMapping ArmMapping(const Robot& robot, const ArmSpace& arm, TimeSource time) {
  const auto kinematics = std::make_shared<const ArmKinematics>(robot, arm);
  return StateMapping::FromKinematics(
      robot,
      [=](const ompl::base::State* state, std::span<Pose> T_W_L) {
        kinematics->LinkPoses(AsAngles(state), T_W_L);
      },
      time,
      [=](const ompl::base::State* from, const ompl::base::State* to) {
        return kinematics->PathBound(AsAngles(from), AsAngles(to));
      },
      [=](const ompl::base::State* from, const ompl::base::State* to,
          std::span<double> deviations_m) {
        kinematics->Deviations(AsAngles(from), AsAngles(to), deviations_m);
      });
}

}  // namespace clearway
