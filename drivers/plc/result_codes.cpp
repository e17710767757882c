#include "drivers/plc/result_codes.hpp"

namespace graspd {

std::string_view result_code_name(ResultCode code) {
  for (const ResultCodeEntry& entry : result_code_table) {
    if (entry.code == code) return entry.name;
  }
  return "unknown";
}

ResultCode result_code(StatusCode code) {
  switch (code) {
    case StatusCode::ok:
      return ResultCode::ok;
    case StatusCode::bad_configuration:
      return ResultCode::bad_configuration;
    case StatusCode::bad_file:
      return ResultCode::bad_file;
    case StatusCode::bad_bank:
      return ResultCode::bad_model;
    case StatusCode::memory_limit:
      return ResultCode::memory_limit;
    case StatusCode::bad_request:
      return ResultCode::bad_request;
    case StatusCode::camera_lost:
      return ResultCode::camera_lost;
    case StatusCode::stale_frame:
      return ResultCode::stale_frame;
    case StatusCode::bad_frame:
      return ResultCode::bad_frame;
    case StatusCode::deadline:
      return ResultCode::deadline;
    case StatusCode::internal:
    case StatusCode::usage:
    case StatusCode::cannot_write:
    case StatusCode::address_in_use:
      break;
  }
  return ResultCode::internal;
}

std::string_view result_reason_name(ResultReason reason) {
  for (const ResultReasonEntry& entry : result_reason_table) {
    if (entry.reason == reason) return entry.name;
  }
  return "unknown";
}

ResultReason result_reason(Rejection rejection) {
  switch (rejection) {
    case Rejection::none:
      return ResultReason::none;
    case Rejection::weak:
      return ResultReason::weak;
    case Rejection::overlap:
      return ResultReason::overlap;
    case Rejection::boundary:
      return ResultReason::boundary;
    case Rejection::edge:
      return ResultReason::edge;
    case Rejection::below_plane:
      return ResultReason::below_plane;
    case Rejection::ambiguous:
      return ResultReason::ambiguous;
    case Rejection::intersecting:
      return ResultReason::intersecting;
    case Rejection::duplicate:
      return ResultReason::duplicate;
    case Rejection::score:
      return ResultReason::score;
  }
  return ResultReason::none;
}

ResultReason result_reason(GraspRejection rejection) {
  switch (rejection) {
    case GraspRejection::none:
      return ResultReason::none;
    case GraspRejection::no_grasp:
      return ResultReason::no_grasp;
    case GraspRejection::tilt:
      return ResultReason::tilt;
    case GraspRejection::reach:
      return ResultReason::reach;
    case GraspRejection::collision:
      return ResultReason::collision;
    case GraspRejection::opening:
      return ResultReason::opening;
    case GraspRejection::tool:
      return ResultReason::tool;
    case GraspRejection::avoided:
      return ResultReason::avoided;
    case GraspRejection::wall:
      return ResultReason::wall;
    case GraspRejection::unseen:
      return ResultReason::unseen;
    case GraspRejection::neighbour:
      return ResultReason::neighbour;
    case GraspRejection::closing:
      return ResultReason::closing;
    case GraspRejection::retreat:
      return ResultReason::retreat;
    case GraspRejection::no_bin:
      return ResultReason::no_bin;
  }
  return ResultReason::none;
}

}  // namespace graspd
