// What every benchmark program does: run, print, and add its numbers to one summary.
#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <string>
#include <vector>

namespace clearway::bench {

// How much is measured.
struct Effort {
  bool quick = false;
  int repetitions = 7;
};

// Registers a benchmark that measures by itself: run(state) is called once for each repetition, and
// loops over the state, which goes on for `iterations`. Its time is real time, in ms, of one.
void Add(const std::string& name, const Effort& effort,
         const std::function<void(benchmark::State&)>& run, int iterations = 1);

// A number of the summary that is made of two others, divided: the median times of benchmarks, or
// the medians of their counters.
struct Ratio {
  std::string name;
  std::string over;
  std::string under;
};

// Whether all repetitions of a benchmark run before those of another, or in a random order with
// theirs, so that a machine that is slow for a while is so to all of them. Benchmarks that
// run in turns must not depend on their order.
enum class Order { kOneByOne, kInTurns };

// Reads --quick and --out DIR (by default benchmarks/out in the source tree) and Google Benchmark's
// own flags; calls `register_all`, runs the benchmarks in turn, prints them and the ratios, and
// writes the ratios, and the medians of the benchmarks' own counters under the counters' names,
// into DIR/summary.json, a flat object that keeps other programs' numbers. Returns the program's
// exit code: 1 if a benchmark failed.
int Main(int argc, char** argv, const std::function<void(const Effort&)>& register_all,
         const std::vector<Ratio>& ratios, Order order = Order::kOneByOne);

}  // namespace clearway::bench
