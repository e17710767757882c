#include "firmware_app/pick_cycle.hpp"

#include <algorithm>
#include <limits>

#include "firmware_app/request_resolution.hpp"

namespace graspd {
namespace {

float seconds(std::int64_t nanoseconds) { return static_cast<float>(static_cast<double>(nanoseconds) * 1e-9); }

std::uint16_t register_value(std::size_t value) {
  return static_cast<std::uint16_t>(std::min<std::size_t>(value, std::numeric_limits<std::uint16_t>::max()));
}

Status grab(PickCycle& cycle, DepthFrame& frame) {
  if (Status grabbed = cycle.source->grab(cycle.memory.frame, frame); !grabbed.ok()) return grabbed;
  const std::int64_t age = frame.captured_ns == 0 ? 0 : cycle.settings.now_ns() - frame.captured_ns;
  if (age <= cycle.settings.maximum_age_ns) return {};
  return Status::format(StatusCode::stale_frame, "the frame is %.2f s old, %.2f s are allowed",
                        static_cast<double>(seconds(age)), static_cast<double>(seconds(cycle.settings.maximum_age_ns)));
}

/// Lets the robot move as soon as the frame is exposed.
class MoveAllowed final : public ExposureListener {
 public:
  MoveAllowed(FrameSource& source, PlcLink& plc, std::uint16_t sequence)
      : source_(source), plc_(plc), sequence_(sequence) {
    source_.set_exposure_listener(this);
  }
  ~MoveAllowed() override { source_.set_exposure_listener(nullptr); }
  MoveAllowed(const MoveAllowed&) = delete;
  MoveAllowed& operator=(const MoveAllowed&) = delete;

  void exposure_over() override { plc_.capture_done(sequence_); }

 private:
  FrameSource& source_;
  PlcLink& plc_;
  std::uint16_t sequence_;
};

DetectRequest detect_request(const PickCycle& cycle, const PlcRequest& request) {
  DetectRequest detect;
  detect.banks = cycle.capture.banks;
  detect.empty_bin = cycle.source->empty_bin();
  detect.minimum_score = request.minimum_score >= 0 ? request.minimum_score : cycle.settings.minimum_score;
  detect.now_ns = cycle.settings.now_ns;
  if (cycle.settings.deadline_ns > 0) detect.deadline_ns = request.received_ns + cycle.settings.deadline_ns;
  return detect;
}

/// The test at which most hypotheses fell. Those that were weak from the start or repeat an instance
/// say nothing of why the others are missing, so they count only when there is no other reason. Parts that were
/// recognised but for their pose come first.
Rejection main_rejection(const Detections& detections) {
  const auto count = [&](Rejection reason) { return detections.rejections[static_cast<std::size_t>(reason)]; };
  if (count(Rejection::ambiguous) > 0) return Rejection::ambiguous;
  Rejection main = count(Rejection::weak) > 0 ? Rejection::weak : Rejection::none;
  std::uint32_t most = 0;
  for (std::size_t i = 0; i < rejection_count; ++i) {
    const auto reason = static_cast<Rejection>(i);
    if (reason == Rejection::none || reason == Rejection::weak || reason == Rejection::duplicate) continue;
    if (detections.rejections[i] <= most) continue;
    most = detections.rejections[i];
    main = reason;
  }
  return main;
}

void put_verdict(const Capture& capture, ResultBlock& block) {
  const Detections& detections = capture.detections;
  block.flags = result_flags(detections.flags, capture.picks.flags);
  block.instances_found = register_value(detections.instances.size());
  block.pickable = register_value(capture.picks.pickable);
  if (capture.picks.found) {
    block.code = ResultCode::ok;
  } else if (!detections.instances.empty()) {
    block.code = ResultCode::not_pickable;
    block.reason = result_reason(capture.picks.main_reason);
  } else if ((detections.flags & flag_deadline) != 0) {
    block.code = ResultCode::deadline;
  } else if (detections.foreground_pixels == 0) {
    block.code = ResultCode::empty_bin;
  } else {
    block.code = ResultCode::no_match;
    block.reason = result_reason(main_rejection(detections));
  }
}

ListedPick listed_pick(const Capture& capture, const Pick& pick) {
  const Instance& instance = capture.detections.instances[pick.instance];
  ListedPick entry;
  entry.part = register_value(capture.banks[instance.bank].part->part_id);
  entry.grasp = register_value(pick.grasp);
  entry.tool = register_value(pick.tool);
  entry.score = pick.score;
  entry.opening = pick.opening;
  entry.pick = pick.robot_from_tool;
  return entry;
}

/// How far the choice must come to answer a request when `given` picks were given before.
std::size_t picks_needed(const PickSettings& settings, const PlcRequest& request, std::size_t given) {
  return settings.count_all ? std::numeric_limits<std::size_t>::max() : given + request.results_wanted;
}

/// Puts the picks that are next in line into the block, as many as are wanted but at most `usable`, and counts them as
/// given unless this is a dry run.
void put_picks(PickCycle& cycle, const PlcRequest& request, std::size_t usable, ResultBlock& block) {
  Capture& capture = cycle.capture;
  const std::span<const Pick> left = capture.picks.picks.subspan(capture.given);
  const std::size_t count = std::min<std::size_t>({usable, request.results_wanted, block.listed.size()});
  const Pick& pick = left.front();
  block.verified = true;
  for (std::size_t i = 0; i < count; ++i) {
    block.verified = block.verified && capture.detections.instances[left[i].instance].rejection == Rejection::none;
    block.listed[i] = listed_pick(capture, left[i]);
  }
  block.listed_count = register_value(count);
  const ListedPick& first = block.listed.front();
  block.code = request.dry_run ? ResultCode::dry_run : ResultCode::ok;
  block.part = first.part;
  block.view = register_value(capture.detections.instances[pick.instance].view);
  block.grasp = first.grasp;
  block.tool = first.tool;
  block.score = first.score;
  block.remaining = register_value(left.size() - count + capture.picks.unlisted);
  block.result_index = register_value(capture.given + 1);
  block.opening = first.opening;
  block.pick = first.pick;
  block.approach = pick.robot_from_approach;
  block.part_pose = pick.robot_from_part;
  block.approach_distance = cycle.settings.grasp.approach_distance;
  if (request.dry_run) return;
  capture.given += count;
  cycle.last_place = left[count - 1].robot_from_tool.translation;
}

/// The PLC says that the pick it was told of last has failed.
void avoid_last_place(PickCycle& cycle) {
  if (!cycle.last_place) return;
  const AvoidParameters& avoid = cycle.settings.grasp.avoid;
  cycle.memory.avoided.add(*cycle.last_place, avoid.radius, avoid.runs);
  cycle.last_place.reset();
}

/// Takes what is too near to avoided places out of the picks that the PLC was not told of yet; every instance is asked
/// for its pick before.
void drop_avoided_picks(PickCycle& cycle) {
  Capture& capture = cycle.capture;
  capture.picks = find_picks(cycle.memory.grasp, std::numeric_limits<std::size_t>::max());
  FixedVector<Pick>& picks = cycle.memory.grasp.picks;
  auto* const end = std::remove_if(picks.begin() + capture.given, picks.end(), [&](const Pick& pick) {
    return is_avoided(cycle.memory.avoided.places(), pick.robot_from_tool.translation,
                      cycle.settings.grasp.avoid.radius);
  });
  picks.truncate(static_cast<std::size_t>(end - picks.begin()));
}

/// Brings the picks of the tool and the part that the request names in front of the others that the PLC was not told
/// of yet, each kind in its order; how many they are.
std::size_t bring_forward(PickCycle& cycle, const PlcRequest& request) {
  const Capture& capture = cycle.capture;
  FixedVector<Pick>& picks = cycle.memory.grasp.picks;
  Pick* const first = picks.begin() + capture.given;
  Pick* front = first;
  for (Pick* pick = first; pick != picks.end(); ++pick) {
    const std::uint32_t part = capture.banks[capture.detections.instances[pick->instance].bank].part->part_id;
    if (request.tool != 0 && pick->tool != request.tool) continue;
    if (request.part != 0 && part != request.part) continue;
    // std::stable_partition would allocate.
    std::rotate(front, pick, pick + 1);
    ++front;
  }
  return static_cast<std::size_t>(front - first);
}

/// Goes on with the choice until the request has the picks that it asks for, or every instance was asked; how many of
/// those that are next in line it can use.
std::size_t find_next_picks(PickCycle& cycle, const PlcRequest& request) {
  Capture& capture = cycle.capture;
  if (request.avoid_last_place) drop_avoided_picks(cycle);
  for (std::size_t needed = picks_needed(cycle.settings, request, capture.given);; ++needed) {
    capture.picks = find_picks(cycle.memory.grasp, needed);
    const std::size_t usable = bring_forward(cycle, request);
    if (usable >= request.results_wanted || capture.picks.picks.size() < needed) return usable;
  }
}

ResultBlock begin_block(const PickCycle& cycle, const PlcRequest& request) {
  ResultBlock block;
  block.frame = cycle.settings.calibrated ? PoseFrame::robot : PoseFrame::camera;
  block.sequence = request.sequence;
  block.request_id = request.request_id;
  return block;
}

void set_time(ResultBlock& block, BlockStage stage, std::int64_t nanoseconds) {
  block.stage_time[static_cast<std::size_t>(stage)] = seconds(nanoseconds);
}

void finish_times(const PickCycle& cycle, const PlcRequest& request, ResultBlock& block) {
  const std::int64_t now = cycle.settings.now_ns();
  set_time(block, BlockStage::total, now - request.received_ns);
  const std::int64_t captured = cycle.capture.frame.captured_ns;
  if (captured != 0) block.frame_age = seconds(now - captured);
}

Answer failed(const PickCycle& cycle, const PlcRequest& request, const Status& status) {
  Answer answer{begin_block(cycle, request), status};
  answer.block.code = result_code(status.code());
  finish_times(cycle, request, answer.block);
  return answer;
}

Answer given_up(const PickCycle& cycle, const PlcRequest& request) {
  Answer answer{begin_block(cycle, request), {}};
  answer.block.code = ResultCode::given_up;
  finish_times(cycle, request, answer.block);
  return answer;
}

Answer answer_capture(PickCycle& cycle, const PlcRequest& request, PlcLink& plc) {
  const auto now = cycle.settings.now_ns;
  Capture& capture = cycle.capture;
  // From here on nothing of an earlier frame can reach the registers.
  capture = {};
  ResolvedRequest resolved;
  if (Status sound = resolve_request(request, cycle.settings, cycle.banks, resolved); !sound.ok()) {
    return failed(cycle, request, sound);
  }
  capture.banks = resolved.banks;
  capture.robot_from_camera = resolved.grasp.robot_from_camera;
  if (request.avoid_last_place) avoid_last_place(cycle);

  const std::int64_t start = now();
  const MoveAllowed move_allowed(*cycle.source, plc, request.sequence);
  const Status grabbed = grab(cycle, capture.frame);
  // A camera that cannot even be connected fails with other codes than camera_lost, too.
  plc.set_camera_ok(grabbed.ok() || (grabbed.code() != StatusCode::camera_lost && cycle.source->connected()));
  if (!grabbed.ok()) return failed(cycle, request, grabbed);
  plc.capture_done(request.sequence);
  const std::int64_t taken = now();
  if (!plc.is_wanted(request.sequence)) return given_up(cycle, request);

  const Status detected =
      detect(capture.frame, detect_request(cycle, request), resolved.detect, cycle.memory.detect, capture.detections);
  if (!detected.ok()) return failed(cycle, request, detected);
  const std::int64_t found = now();
  begin_choice(capture.frame, capture.detections, capture.banks, resolved.grasp, cycle.memory.grasp,
               cycle.memory.avoided.places());
  capture.picks = find_picks(cycle.memory.grasp, picks_needed(cycle.settings, request, 0));
  // What the PLC will not be told of must not count as told: neither for `next` nor as the last place.
  if (!plc.is_wanted(request.sequence)) return given_up(cycle, request);
  cycle.memory.avoided.age();
  capture.answered = true;

  Answer answer{begin_block(cycle, request), {}};
  put_verdict(capture, answer.block);
  if (capture.picks.found) put_picks(cycle, request, capture.picks.picks.size(), answer.block);
  set_time(answer.block, BlockStage::capture, taken - start);
  for (std::size_t i = 0; i < stage_count; ++i) {
    const auto stage = static_cast<BlockStage>(static_cast<std::size_t>(BlockStage::preprocess) + i);
    set_time(answer.block, stage, capture.detections.stage_ns[i]);
  }
  set_time(answer.block, BlockStage::grasp, now() - found);
  finish_times(cycle, request, answer.block);
  return answer;
}

Answer answer_next(PickCycle& cycle, const PlcRequest& request, const PlcLink& plc) {
  Capture& capture = cycle.capture;
  if (Status served = check_served(request, cycle.settings, cycle.banks); !served.ok()) {
    return failed(cycle, request, served);
  }
  if (request.avoid_last_place) avoid_last_place(cycle);
  Answer answer{begin_block(cycle, request), {}};
  std::size_t usable = 0;
  if (capture.answered) {
    const std::int64_t start = cycle.settings.now_ns();
    usable = find_next_picks(cycle, request);
    set_time(answer.block, BlockStage::grasp, cycle.settings.now_ns() - start);
    put_verdict(capture, answer.block);
  }
  if (!plc.is_wanted(request.sequence)) return given_up(cycle, request);
  if (usable > 0) {
    put_picks(cycle, request, usable, answer.block);
  } else {
    answer.block.code = ResultCode::nothing_left;
    answer.block.reason = ResultReason::none;
  }
  finish_times(cycle, request, answer.block);
  return answer;
}

}  // namespace

Answer answer_request(PickCycle& cycle, const PlcRequest& request, PlcLink& plc) {
  return request.kind == RequestKind::next ? answer_next(cycle, request, plc) : answer_capture(cycle, request, plc);
}

}  // namespace graspd
