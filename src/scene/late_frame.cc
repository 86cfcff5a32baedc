#include "scene/late_frame.h"

#include <algorithm>
#include <utility>

#include "scene/object_points.h"

namespace clearway {

bool IsNewerThan(const MovingObject& object, Time stamp) {
  return !object.given() && stamp < object.t_k();
}

Pose PoseBefore(const MovingObject& object, const ObjectClue& clue, Time stamp,
                const SceneParams& params) {
  const StampedPose& first = object.history.front();
  if (stamp >= first.stamp) return PredictPose(object, stamp, params.horizon).T_W_O;
  if (clue.pose != nullptr && object.T_B_O) return clue.pose->T_W_B * *object.T_B_O;
  return first.T_W_O * Exp(ToSeconds(stamp - first.stamp) * object.velocity_O.value_or(Twist{}));
}

MovingObject WithLatePoints(const MovingObject& object, const LabelledCloud& cloud,
                            const ObjectClue& clue, Time stamp, const SceneParams& params,
                            ThreadPool& pool) {
  MovingObject then = object;  // as of the frame's stamp
  std::erase_if(then.history, [&](const StampedPose& pose) { return pose.stamp >= stamp; });
  then.history.push_back({stamp, PoseBefore(object, clue, stamp, params)});
  AddPoints(then, cloud, clue.points, stamp, params, pool);
  NoteIds(then, clue.named_as, stamp);
  then.history = object.history;
  then.last_view = object.last_view;
  then.last_seen = std::max(then.last_seen, object.last_seen);
  return then;
}

}  // namespace clearway
