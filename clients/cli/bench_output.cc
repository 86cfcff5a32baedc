#include "cli/bench_output.h"

#include "cli/json.h"
#include "cli/text.h"

namespace clearway::cli {

void PrintBenchText(std::ostream& out, const BenchOutput& output) {
  const LoadReport& report = output.report;
  out << Plural(output.connections, "connection") << ", batches of " << Grouped(output.batch) << " "
      << output.items << ", from " << Point(output.box_W.min, 1) << " to "
      << Point(output.box_W.max, 1) << " m\n"
      << Grouped(report.calls()) << " calls in " << Fixed(report.seconds, 2)
      << " s: " << Scaled(report.CallsPerSecond()) << " calls/s, "
      << Scaled(output.ItemsPerSecond()) << " " << output.items << "/s\n"
      << "latency ms  p50 " << Fixed(report.LatencyMs(0.5), 3) << "  p90 "
      << Fixed(report.LatencyMs(0.9), 3) << "  p99 " << Fixed(report.LatencyMs(0.99), 3) << "  max "
      << Fixed(report.LatencyMs(1), 3) << "\n";
}

void PrintBenchJson(std::ostream& out, const BenchOutput& output) {
  const LoadReport& report = output.report;
  Print(out, {{"connections", output.connections},
              {"batch", output.batch},
              {"items", output.items},
              {"box_world", ToJson(output.box_W)},
              {"seconds", report.seconds},
              {"calls", report.calls()},
              {"calls_per_s", report.CallsPerSecond()},
              {output.items + "_per_s", output.ItemsPerSecond()},
              {"latency_ms",
               {{"p50", report.LatencyMs(0.5)},
                {"p90", report.LatencyMs(0.9)},
                {"p99", report.LatencyMs(0.99)},
                {"max", report.LatencyMs(1)}}}});
}

}  // namespace clearway::cli
