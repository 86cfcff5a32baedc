// What became of the frames of a replay.
#pragma once

#include <cstdint>
#include <ostream>

#include "clearway/io/frame_source.h"
#include "cli/ack_tally.h"
#include "cli/json.h"

namespace clearway::cli {

Json SummaryJson(const AckTally::Counts& counts, const FrameSource& source,
                 std::uint64_t reconnects, double seconds);

void PrintSummary(std::ostream& out, const AckTally::Counts& counts);

}  // namespace clearway::cli
