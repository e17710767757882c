#pragma once

#include <chrono>
#include <cstdint>

#include "core/geometry/rigid_transform.hpp"
#include "drivers/plc/result_block.hpp"

namespace graspd {

enum class RequestKind : std::uint8_t {
  capture,  ///< Take a frame, find the parts, choose a pick.
  next,     ///< The next pick of the last capture; code nothing_left when there is none.
};

/// An upright box in which alone parts are looked for.
struct RequestBox {
  RigidTransform reference_from_box;  ///< The reference is the robot's frame if it is calibrated, else the camera's.
  Vector3 half_size = Vector3::Zero();
};

/// What the PLC asked for: a copy of the request registers as they stood at the rising edge.
struct PlcRequest {
  RequestKind kind = RequestKind::capture;
  std::uint16_t sequence = 0;        ///< Names this request to every call below; never 0.
  std::uint16_t request_id = 0;      ///< The PLC's own number, to be echoed.
  std::uint16_t part = 0;            ///< 0: any part that is loaded.
  std::uint16_t tool = 0;            ///< Number of the one tool to pick with; 0: any.
  float minimum_score = -1.0F;       ///< In [0, 1]; negative: every bank's own threshold.
  std::uint16_t results_wanted = 1;  ///< Picks in one answer, 1 to pick_list::entries.
  bool dry_run = false;              ///< Answer with code dry_run instead of ok, and count nothing as picked.
  bool save_snapshot = false;        ///< Keep the frame for the vision engineer.
  bool avoid_last_place = false;     ///< The last pick failed: do not go there again for a while.
  std::uint16_t region = 0;          ///< Number of the configured region to look in; request_region::box: `box`.
  RequestBox box;                    ///< As in the registers, finite or not.
  bool has_flange_pose = false;      ///< For a camera on the flange.
  RigidTransform robot_from_flange;  ///< At the exposure, as in the registers: finite and a rotation, or not.
  bool well_formed = true;       ///< False when a register holds what has no meaning: to be answered with bad_request.
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
  /// False once the PLC gave the request up, or fell silent, so that it will not be told of a pick: the worker may stop
  /// early, but commits something all the same.
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
