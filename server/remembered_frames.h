// The names of accepted frames, and what became of them.
#pragma once

#include <compare>
#include <cstdint>
#include <deque>
#include <future>
#include <map>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/base/time.h"
#include "clearway/wire/push_ack.h"

namespace clearway {

struct FrameName {
  std::string sensor_id;
  std::uint64_t sensor_run = 0;
  std::uint64_t sequence = 0;
  auto operator<=>(const FrameName&) const = default;
};

// What tells a repeat of a frame from another one of its name.
struct FrameContent {
  Time stamp;
  std::uint64_t hash = 0;  // of all that was sent
  bool operator==(const FrameContent&) const = default;
};

// The newest `max` names. One thread at a time.
class RememberedFrames {
 public:
  struct Entry {
    FrameContent content;
    bool allow_stamp_jump = false;
    std::shared_future<absl::StatusOr<PushAck>> answer;
  };

  explicit RememberedFrames(std::size_t max) : max_(max) {}

  // The entry whose answer the frame gets: that of an identical one. Null if the name is new, or if
  // the frame was refused and may now jump ahead. ALREADY_EXISTS (FRAME_NAME_TAKEN) for the name of
  // another frame, naming what differs.
  absl::StatusOr<const Entry*> Find(const FrameName& name, const FrameContent& content,
                                    bool allow_stamp_jump) const;
  // Instead of an entry of that name. Forgets the oldest name if there are too many.
  void Add(const FrameName& name, Entry entry);
  void Forget(const FrameName& name);
  void Clear();

 private:
  const std::size_t max_;
  std::map<FrameName, Entry> entries_;
  std::deque<FrameName> order_;  // oldest first
};

}  // namespace clearway
