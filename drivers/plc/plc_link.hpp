#pragma once

#include <chrono>
#include <cstdint>

#include "drivers/plc/orientation.hpp"
#include "drivers/plc/result_block.hpp"

namespace graspd {

enum class RequestKind : std::uint8_t {
  capture,  ///< Take a frame, find the parts, choose a pick.
  next,     ///< The next pick of the last capture; code nothing_left when there is none.
};

/// What the PLC asked for: a copy of the request registers as they stood at the rising edge.
struct PlcRequest {
  RequestKind kind = RequestKind::capture;
  std::uint16_t sequence = 0;    ///< Names this request to every call below; never 0.
  std::uint16_t request_id = 0;  ///< The PLC's own number, to be echoed.
  std::uint16_t part = 0;        ///< 0: any part that is loaded.
  float minimum_score = -1.0F;   ///< In [0, 1]; negative: every bank's own threshold.
  std::int64_t received_ns = 0;  ///< When the edge was seen (monotonic clock).
};

/// The line to the PLC as the worker sees it. One worker thread calls these; none of them allocates,
/// and only wait_for_request waits.
class PlcLink {
 public:
  PlcLink() = default;
  PlcLink(const PlcLink&) = delete;
  PlcLink& operator=(const PlcLink&) = delete;
  virtual ~PlcLink() = default;

  /// Waits for a request. False when none came within `timeout` or the link was stopped.
  [[nodiscard]] virtual bool wait_for_request(PlcRequest& request, std::chrono::milliseconds timeout) = 0;
  /// False once the PLC gave the request up: the worker may stop early, but commits something all the same.
  [[nodiscard]] virtual bool is_wanted(std::uint16_t sequence) const = 0;
  /// The frame of this request is taken: the robot may move.
  virtual void capture_done(std::uint16_t sequence) = 0;
  /// Hands over the answer. Every request that was received must be answered once: until then the PLC
  /// sees `busy`. An answer to a request that was given up is dropped.
  virtual void commit(const ResultBlock& result) = 0;
  virtual void set_camera_ok(bool ok) = 0;
  virtual void set_model_loaded(bool loaded) = 0;
  /// Grows as long as the link's own thread is alive.
  [[nodiscard]] virtual std::uint64_t progress_count() const = 0;
  /// Ends the link's thread and closes its connections. May be called more than once.
  virtual void stop() = 0;
};

}  // namespace graspd
