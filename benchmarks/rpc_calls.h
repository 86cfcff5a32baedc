// Calls to a server, and to a service that answers them without work.
#pragma once

#include <memory>
#include <string>

#include "load/load.h"
#include "load/questions.h"

namespace clearway::bench {

// Answers GetPointOccupancy with as many constants as points were asked for, and GetServerInfo with
// an empty message: what the transport, parsing and serializing cost alone.
class EchoServer {
 public:
  EchoServer();
  ~EchoServer();
  const std::string& address() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Each over a connection of its own, with requests made beforehand; the answer is parsed.
//
// Occupancy of `points` random points, each at its own time.
LoadCall PointsCall(const std::string& address, const QuestionSpace& space, std::size_t points,
                    std::uint64_t seed);
// A call whose request is empty.
LoadCall EmptyCall(const std::string& address);

}  // namespace clearway::bench
