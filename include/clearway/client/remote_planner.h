// Plans made by a server, and motions that it watches.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "clearway/client/connection.h"
#include "clearway/client/stream_state.h"
#include "clearway/collision/plan_task.h"
#include "clearway/wire/answers.h"

namespace clearway {

// One robot's planner on a server. Any thread may call any method; each call is a stream of its
// own.
class RemotePlanner {
 public:
  // Registers the robot.
  static absl::StatusOr<std::unique_ptr<RemotePlanner>> For(std::shared_ptr<Connection> connection,
                                                            Robot robot);
  ~RemotePlanner();

  // As Solve of solve_task.h, on the scene that the query asks for. Each plan goes to `found` as it
  // comes; if that says false it is good enough, and the search ends there. Errors are Solve's and
  // the transport's, and RESOURCE_EXHAUSTED for a budget above max_planning_s or too many plans at
  // once.
  absl::StatusOr<PlanOutcome> Plan(const PlanTask& task, Duration budget,
                                   const std::function<bool(const clearway::Plan&)>& found,
                                   const SceneQuery& query = {}) const;

  // What a watch says.
  struct News {
    MotionReply reply;  // all motions, what was in the version's past as free
    // Which of them were free before (or are asked about for the first time) and are not, and the
    // other way round.
    std::vector<std::size_t> broken, mended;
    // Not OK when the connection was lost: nothing is known of any motion until the next news, and
    // all of them are kUnresolved in a reply of version 0.
    absl::Status connection;
  };
  // Tells of the motions on the newest version at once, and then whenever a version makes one free
  // or not, until `tell` says false (then OK), the server refuses the watch, or the connection has
  // been lost for longer than `reconnect` allows. A lost connection is told once, and the motions
  // anew when it is back; a server that restarted gets the robot again. Blocks meanwhile.
  absl::Status Watch(const MotionBatch& motions, const MotionOptions& options,
                     const std::function<bool(const News&)>& tell,
                     const ReconnectOptions& reconnect = {}) const;

 private:
  struct Impl;
  explicit RemotePlanner(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace clearway
