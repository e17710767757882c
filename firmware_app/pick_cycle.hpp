#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/detect/detector.hpp"
#include "core/grasp/planner.hpp"
#include "core/status.hpp"
#include "drivers/camera/frame_source.hpp"
#include "drivers/plc/plc_link.hpp"
#include "firmware_app/memory_plan.hpp"

namespace graspd {

/// What a pick cycle goes by; fixed before the first trigger.
struct PickSettings {
  DetectParameters detect;
  GraspParameters grasp;
  std::vector<RequestBox> regions;    ///< That a request may name, from number 1 on.
  bool calibrated = false;            ///< Poses are in the robot's frame.
  bool camera_on_flange = false;      ///< Each request must bring the flange's pose.
  RigidTransform flange_from_camera;  ///< Only with camera_on_flange.
  RigidTransform robot_from_box;      ///< The box of BackgroundMode::box.
  bool keeps_snapshots = false;       ///< A request may ask to keep the frame.
  bool count_all = false;             ///< Ask every instance for a grasp before answering.
  float minimum_score = -1.0F;        ///< When the PLC asks for none; negative: the bank's own.
  std::int64_t deadline_ns = 0;       ///< After the trigger; 0: none.
  std::int64_t maximum_age_ns = 0;
  std::int64_t (*now_ns)() = nullptr;  ///< Monotonic clock.
};

/// What became of the last capture; `next` draws on it, and goes on with the choice of grasps that lies in
/// WorkingMemory::grasp.
struct Capture {
  bool answered = false;  ///< Everything below belongs to one frame and is verified.
  DepthFrame frame;
  RigidTransform robot_from_camera;  ///< At the exposure.
  std::span<const Bank> banks;
  Detections detections;
  PickResult picks;       ///< As far as the choice has come.
  std::size_t given = 0;  ///< Picks that the PLC has been told of.
};

/// What a pick cycle works with.
struct PickCycle {
  PickSettings settings;
  std::span<const Bank> banks;
  FrameSource* source = nullptr;
  WorkingMemory memory;
  Capture capture;
  std::optional<Vector3> last_place;  ///< Of the pick that the PLC was told of last, robot frame, until it is avoided.
};

/// The answer to a request, and for the journal what went wrong.
struct Answer {
  ResultBlock block;
  Status status;
};

/// Answers one request: grabs a frame (the PLC is told when it is taken), finds the parts, chooses a
/// pick; or takes the next pick of the last capture. Never allocates. The block carries a pick only
/// when the instance passed verification in the frame of this very capture.
[[nodiscard]] Answer answer_request(PickCycle& cycle, const PlcRequest& request, PlcLink& plc);

/// Runs one detection and choice on a rendered frame, so that whatever is set up at first use (the threads of OpenMP,
/// above all, and what is kept of the empty bin) is there before the first trigger. Call it on the worker's thread.
[[nodiscard]] Status warm_up(PickCycle& cycle);

}  // namespace graspd
