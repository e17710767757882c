#pragma once

#include <span>

namespace graspd {

/// What is known of an answer, milliseconds; all but `processor` without capture and detection.
struct LatencySample {
  double client = 0;     ///< From before the trigger is sent until the client has read `done`.
  double daemon = 0;     ///< From the trigger seen to the registers written.
  double waking = 0;     ///< Of these, until the worker had the request,
  double answering = 0;  ///< until it had the answer,
  double writing = 0;    ///< and until that stood in the registers.
  double processor = 0;  ///< Of the worker's thread, without what stood for the detection.
};

/// Prints medians, high percentiles and the most as a table; `knows_processor`: whether LatencySample::processor is
/// known. At least one sample.
void print_latencies(std::span<const LatencySample> samples, bool knows_processor);

}  // namespace graspd
