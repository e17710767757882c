#pragma once

#include <cstdint>
#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"
#include "core/detect/parameters.hpp"
#include "core/detect/trace.hpp"
#include "core/detect/workspace.hpp"
#include "core/geometry/depth_frame.hpp"

namespace graspd {

/// What one detection is asked for.
struct DetectRequest {
  std::span<const Bank> banks;         ///< Parts to look for; instances of all of them are kept consistent.
  DepthFrame empty_bin;                ///< The bin without parts, same camera; empty `depth`: none.
  float minimum_score = -1.0F;         ///< Overrides every bank's threshold when not negative.
  std::int64_t (*now_ns)() = nullptr;  ///< Monotonic clock for the stage times and the deadline; null: neither.
  std::int64_t deadline_ns = 0;        ///< In the clock's time; 0: none.
  DetectTrace* trace = nullptr;        ///< Filled for offline tools; null on the line.
};

/// Finds every instance of the parts of `request` in `frame` (paper 2.4). The result lies in
/// `workspace` and is valid until the next call. It is the same, byte for byte, for any number of
/// threads. Fails with bad_frame when the frame or the empty bin exceeds or contradicts the capacity
/// or each other, and with memory_limit when a bank exceeds it.
[[nodiscard]] Status detect(const DepthFrame& frame, const DetectRequest& request, const DetectParameters& parameters,
                            DetectWorkspace& workspace, Detections& detections);

}  // namespace graspd
