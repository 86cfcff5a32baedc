// Counts the server's answers to a stream of frames.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <string>

#include "clearway/client/frame_sender.h"
#include "cli/object_notes.h"
#include "cli/point_notes.h"

namespace clearway::cli {

// Any thread may call any method; it must outlive the stream that it listens to.
class AckTally {
 public:
  // A plain value.
  struct Counts {
    std::size_t answered = 0;  // with whatever answer
    std::size_t refused = 0;
    std::size_t repeated = 0;  // remembered answers to an earlier push
    std::size_t late = 0;      // older than a frame of another sensor
    Duration max_late_by{};    // of those
    std::uint64_t points = 0;  // of the answered frames
    PushAck last;              // of the newest version that was named
    std::size_t lost = 0;      // applied by a server that has restarted since
    ObjectNotes objects;
    PointNotes of_points;
    absl::Status first_refusal;  // OK if there is none
    std::string first_refused_sensor;
    std::uint64_t first_refused_sequence = 0;
  };

  // To be called before each frame is sent; answers come in the order sent.
  void Sent(const Frame& frame);
  FrameSender::OnAck OnAck();
  // The answers to come are those of a server with another scene.
  void ServerRestarted();
  Counts counts() const;

 private:
  mutable std::mutex mutex_;
  struct InFlight {
    std::uint64_t points;
    Time stamp;
  };
  std::deque<InFlight> in_flight_;
  Counts counts_;
};

}  // namespace clearway::cli
