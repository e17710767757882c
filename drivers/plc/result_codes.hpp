#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/detect/detections.hpp"
#include "core/grasp/pick.hpp"
#include "core/status.hpp"

namespace graspd {

/// What became of a request, as the PLC reads it. Below 20 the number is that of the StatusCode and
/// something is at fault; from 20 on the answer is sound, but there is nothing to pick; from 30 on a
/// request was not accepted, or was given up. configs/register-map.md names cause and remedy of each.
enum class ResultCode : std::uint16_t {
  ok = 0,
  internal = 1,
  bad_configuration = 3,
  bad_file = 4,
  bad_model = 5,
  memory_limit = 7,
  bad_request = 9,
  camera_lost = 10,
  stale_frame = 11,
  bad_frame = 12,
  deadline = 13,
  empty_bin = 20,     ///< Nothing lies in the bin.
  no_match = 21,      ///< Something lies there, but no instance of the part was recognised.
  not_pickable = 22,  ///< Instances were found; none can be gripped.
  nothing_left = 23,  ///< `next`, but the last capture holds no further pick.
  dry_run = 24,       ///< There is a pick, but it was asked for without meaning to go there.
  busy = 30,
  not_acknowledged = 31,
  plc_silent = 32,
  given_up = 33,   ///< The request was reset before it had an answer.
  no_answer = 34,  ///< Nothing was asked for since the start.
};

struct ResultCodeEntry {
  ResultCode code;
  std::string_view name;
};
inline constexpr std::array<ResultCodeEntry, 21> result_code_table{{
    {ResultCode::ok, "ok"},
    {ResultCode::internal, "internal"},
    {ResultCode::bad_configuration, "bad_configuration"},
    {ResultCode::bad_file, "bad_file"},
    {ResultCode::bad_model, "bad_model"},
    {ResultCode::memory_limit, "memory_limit"},
    {ResultCode::bad_request, "bad_request"},
    {ResultCode::camera_lost, "camera_lost"},
    {ResultCode::stale_frame, "stale_frame"},
    {ResultCode::bad_frame, "bad_frame"},
    {ResultCode::deadline, "deadline"},
    {ResultCode::empty_bin, "empty_bin"},
    {ResultCode::no_match, "no_match"},
    {ResultCode::not_pickable, "not_pickable"},
    {ResultCode::nothing_left, "nothing_left"},
    {ResultCode::dry_run, "dry_run"},
    {ResultCode::busy, "busy"},
    {ResultCode::not_acknowledged, "not_acknowledged"},
    {ResultCode::plc_silent, "plc_silent"},
    {ResultCode::given_up, "given_up"},
    {ResultCode::no_answer, "no_answer"},
}};

/// A name for logs and tables; "unknown" for a number that is not in the table.
[[nodiscard]] std::string_view result_code_name(ResultCode code);
/// True for the codes that set the discrete input `error`: graspd or the camera is at fault.
[[nodiscard]] constexpr bool is_fault(ResultCode code) {
  return code != ResultCode::ok && static_cast<std::uint16_t>(code) < 20;
}
/// The code under which a failure is told to the PLC.
[[nodiscard]] ResultCode result_code(StatusCode code);

/// The main reason behind no_match (1 to 99: the test that rejected most hypotheses) and
/// not_pickable (from 100: why most instances could not be gripped).
enum class ResultReason : std::uint16_t {
  none = 0,
  weak = 1,
  overlap = 2,
  boundary = 3,
  edge = 4,
  below_plane = 5,
  ambiguous = 6,
  intersecting = 7,
  duplicate = 8,
  score = 9,
  no_grasp = 101,
  tilt = 102,
  reach = 103,
  collision = 104,
  opening = 105,
  tool = 106,
  avoided = 107,
  wall = 108,
  unseen = 109,
  neighbour = 110,
  closing = 111,
  retreat = 112,
  no_bin = 113,
};

struct ResultReasonEntry {
  ResultReason reason;
  std::string_view name;
};
inline constexpr std::array<ResultReasonEntry, 23> result_reason_table{{
    {ResultReason::none, "none"},           {ResultReason::weak, "weak"},
    {ResultReason::overlap, "overlap"},     {ResultReason::boundary, "boundary"},
    {ResultReason::edge, "edge"},           {ResultReason::below_plane, "below_plane"},
    {ResultReason::ambiguous, "ambiguous"}, {ResultReason::intersecting, "intersecting"},
    {ResultReason::duplicate, "duplicate"}, {ResultReason::score, "score"},
    {ResultReason::no_grasp, "no_grasp"},   {ResultReason::tilt, "tilt"},
    {ResultReason::reach, "reach"},         {ResultReason::collision, "collision"},
    {ResultReason::opening, "opening"},     {ResultReason::tool, "tool"},
    {ResultReason::avoided, "avoided"},     {ResultReason::wall, "wall"},
    {ResultReason::unseen, "unseen"},       {ResultReason::neighbour, "neighbour"},
    {ResultReason::closing, "closing"},     {ResultReason::retreat, "retreat"},
    {ResultReason::no_bin, "no_bin"},
}};

/// A name for logs and tables; "unknown" for a number that is not in the table.
[[nodiscard]] std::string_view result_reason_name(ResultReason reason);
[[nodiscard]] ResultReason result_reason(Rejection rejection);
[[nodiscard]] ResultReason result_reason(GraspRejection rejection);

/// The bits of the register `flags`: DetectionFlag in bits 0 to 3, PickFlag in bits 4, 5 and 7, flag_voting_cut in bit
/// 6.
[[nodiscard]] constexpr std::uint16_t result_flags(std::uint32_t detection_flags, std::uint32_t pick_flags) {
  return static_cast<std::uint16_t>((detection_flags & 0xFU) | (pick_flags & 3U) << 4U |
                                    (detection_flags & flag_voting_cut) << 2U |
                                    (pick_flags & flag_not_all_asked) << 5U);
}

}  // namespace graspd
