// Objects that a server has for as long as a command runs.
#pragma once

#include <mutex>
#include <vector>

#include "clearway/client/scene_client.h"
#include "cli/interrupts.h"

namespace clearway::cli {

// Adds objects to a server's scene, and takes them away again: when it goes, or when a signal ends
// the tool, which SignalsBlocked must hold back.
class BorrowedObjects {
 public:
  explicit BorrowedObjects(SceneClient client);
  ~BorrowedObjects();

  // The version that has them. To be called once.
  absl::StatusOr<std::uint64_t> Add(const std::vector<GivenObject>& objects);

 private:
  void GiveBack();

  SceneClient client_;
  std::mutex mutex_;  // of ids_
  std::vector<ObjectId> ids_;
  SignalWatch watch_;  // last: it uses the others
};

}  // namespace clearway::cli
