#pragma once

#include <string>

#include "firmware_app/bench.hpp"

namespace graspd {

/// What was measured, as tables for a person,
[[nodiscard]] std::string bench_as_text(const BenchInput& input, const Bench& bench);

/// and as JSON: seconds, bytes and counts.
[[nodiscard]] std::string bench_as_json(const BenchInput& input, const Bench& bench);

/// The share of the instances found without a deadline; 1 when there were none.
[[nodiscard]] double share_found(const Bench& bench, const BenchRun& run);

}  // namespace graspd
