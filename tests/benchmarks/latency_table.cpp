#include "tests/benchmarks/latency_table.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <vector>

namespace graspd {
namespace {

void print_row(const char* name, std::span<const LatencySample> samples, double LatencySample::*figure) {
  std::vector<double> sorted;
  for (const LatencySample& sample : samples) sorted.push_back(sample.*figure);
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  };
  std::printf("| %s | %.3f | %.3f | %.3f | %.3f |\n", name, at(0.5), at(0.99), at(0.999), sorted.back());
}

}  // namespace

void print_latencies(std::span<const LatencySample> samples, bool knows_processor) {
  std::printf("| milliseconds, %zu triggers | median | 99%% | 99.9%% | most |\n|---|---|---|---|---|\n",
              samples.size());
  print_row("trigger sent until the client has read `done`", samples, &LatencySample::client);
  print_row("trigger seen until the registers are written", samples, &LatencySample::daemon);
  print_row("of these: until the worker has the request", samples, &LatencySample::waking);
  print_row("until it has the answer", samples, &LatencySample::answering);
  print_row("until that is written", samples, &LatencySample::writing);
  if (knows_processor) print_row("processor time of the worker", samples, &LatencySample::processor);
}

}  // namespace graspd
