#include "server/remembered_frames.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "absl/strings/str_cat.h"
#include "wire/status.h"

namespace clearway {
namespace {

absl::Status NameTaken(const FrameName& name, const FrameContent& first,
                       const FrameContent& second) {
  const std::string run =
      name.sensor_run == 0 ? "without sensor_run" : absl::StrCat("of sensor_run ", name.sensor_run);
  const std::string difference =
      first.stamp == second.stamp
          ? absl::StrCat("both have stamp_ns ", ToNanoseconds(first.stamp),
                         ", but their content differs")
          : absl::StrCat("that one has stamp_ns ", ToNanoseconds(first.stamp), ", this one ",
                         ToNanoseconds(second.stamp));
  return WithReason(
      absl::AlreadyExistsError(absl::StrCat(
          "frame.sequence: ", name.sequence, " of sensor \"", name.sensor_id, "\" ", run,
          " names another frame: ", difference,
          "; a sensor that restarts and counts from 0 again must choose a new sensor_run")),
      "FRAME_NAME_TAKEN");
}

bool WasRefused(const RememberedFrames::Entry& entry) {
  return entry.answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready &&
         !entry.answer.get().ok();
}

}  // namespace

absl::StatusOr<const RememberedFrames::Entry*> RememberedFrames::Find(const FrameName& name,
                                                                      const FrameContent& content,
                                                                      bool allow_stamp_jump) const {
  const auto found = entries_.find(name);
  if (found == entries_.end()) return nullptr;
  const Entry& entry = found->second;
  if (entry.content != content) return NameTaken(name, entry.content, content);
  if (allow_stamp_jump && !entry.allow_stamp_jump && WasRefused(entry)) return nullptr;
  return &entry;
}

void RememberedFrames::Add(const FrameName& name, Entry entry) {
  Forget(name);
  entries_[name] = std::move(entry);
  order_.push_back(name);
  if (order_.size() <= max_) return;
  entries_.erase(order_.front());
  order_.pop_front();
}

void RememberedFrames::Forget(const FrameName& name) {
  if (entries_.erase(name) > 0) order_.erase(std::ranges::find(order_, name));
}

void RememberedFrames::Clear() {
  entries_.clear();
  order_.clear();
}

}  // namespace clearway
