#include "cli/borrowed_objects.h"

#include <utility>

#include "absl/strings/str_cat.h"

namespace clearway::cli {

BorrowedObjects::BorrowedObjects(SceneClient client)
    : client_(std::move(client)), watch_([this] { GiveBack(); }) {}

BorrowedObjects::~BorrowedObjects() { GiveBack(); }

absl::StatusOr<std::uint64_t> BorrowedObjects::Add(const std::vector<GivenObject>& objects) {
  if (objects.empty()) return 0;
  std::lock_guard lock(mutex_);
  const auto added = client_.AddObjects(objects);
  if (absl::IsAlreadyExists(added.status())) {
    return absl::AlreadyExistsError(
        absl::StrCat(added.status().message(),
                     "; frames may have brought it ('clearway reset' empties the scene), another "
                     "plan may be using it, or have left it there when it was killed ('clearway "
                     "objects --remove ID' takes it away)"));
  }
  if (!added.ok()) return added.status();
  for (const GivenObject& object : objects) ids_.push_back(object.id);
  return added->version;
}

// If the server is gone, so are the objects; if somebody has removed one, the others go.
void BorrowedObjects::GiveBack() {
  std::lock_guard lock(mutex_);
  const std::vector<ObjectId> ids = std::exchange(ids_, {});
  if (ids.empty() || !absl::IsNotFound(client_.RemoveObjects(ids).status())) return;
  for (const ObjectId id : ids) (void)client_.RemoveObjects({&id, 1});
}

}  // namespace clearway::cli
