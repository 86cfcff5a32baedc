// What `clearway bench` prints.
#pragma once

#include <ostream>
#include <string>

#include "clearway/geometry/aabb.h"
#include "load/load.h"

namespace clearway::cli {

struct BenchOutput {
  std::string items;  // "points"
  std::size_t batch = 0;
  std::size_t connections = 0;
  Aabb box_W;  // that was asked within
  LoadReport report;

  double ItemsPerSecond() const { return static_cast<double>(batch) * report.CallsPerSecond(); }
};

void PrintBenchText(std::ostream& out, const BenchOutput& output);
void PrintBenchJson(std::ostream& out, const BenchOutput& output);

}  // namespace clearway::cli
