#pragma once

#include <array>
#include <string_view>

#include "drivers/plc/register_map.hpp"

namespace graspd {

/// A coil or a discrete input.
struct BitEntry {
  std::uint16_t address;
  std::string_view name;
};

/// A register, or the first of several: `words` registers from `address`.
struct RegisterEntry {
  std::uint16_t address;
  std::uint16_t words;
  std::string_view name;
  std::string_view type;
};

inline constexpr std::array<BitEntry, coil::count> coil_table{{
    {coil::trigger, "trigger"},
    {coil::acknowledge, "acknowledge"},
    {coil::reset, "reset"},
    {coil::next, "next"},
}};

inline constexpr std::array<BitEntry, discrete_input::count> discrete_input_table{{
    {discrete_input::ready, "ready"},
    {discrete_input::busy, "busy"},
    {discrete_input::capture_done, "capture_done"},
    {discrete_input::done, "done"},
    {discrete_input::error, "error"},
    {discrete_input::result_valid, "result_valid"},
    {discrete_input::camera_ok, "camera_ok"},
    {discrete_input::model_loaded, "model_loaded"},
    {discrete_input::plc_alive, "plc_alive"},
}};

inline constexpr std::array<RegisterEntry, 11> request_table{{
    {request_register::request_id, 1, "request_id", "uint16"},
    {request_register::part, 1, "part", "uint16"},
    {request_register::minimum_score, 1, "minimum_score", "uint16"},
    {request_register::pose_convention, 1, "pose_convention", "uint16"},
    {request_register::plc_heartbeat, 1, "plc_heartbeat", "uint16"},
    {request_register::options, 1, "options", "uint16"},
    {request_register::results_wanted, 1, "results_wanted", "uint16"},
    {request_register::region, 1, "region", "uint16"},
    {request_register::region_box, 14, "region_box", "number[7]"},
    {request_register::flange_pose, 14, "flange_pose", "number[7]"},
    {request_register::tool, 1, "tool", "uint16"},
}};

inline constexpr std::array<RegisterEntry, 39> block_table{{
    {block::map_version, 1, "map_version", "uint16"},
    {block::sequence_first, 1, "sequence_first", "uint16"},
    {block::request_id, 1, "request_id", "uint16"},
    {block::result_code, 1, "result_code", "uint16"},
    {block::reason, 1, "reason", "uint16"},
    {block::flags, 1, "flags", "uint16"},
    {block::part, 1, "part", "uint16"},
    {block::view, 1, "view", "uint16"},
    {block::grasp, 1, "grasp", "uint16"},
    {block::score, 1, "score", "uint16"},
    {block::instances_found, 1, "instances_found", "uint16"},
    {block::pickable, 1, "pickable", "uint16"},
    {block::remaining, 1, "remaining", "uint16"},
    {block::result_index, 1, "result_index", "uint16"},
    {block::pose_convention, 1, "pose_convention", "uint16"},
    {block::pose_frame, 1, "pose_frame", "uint16"},
    {block::frame_age, 1, "frame_age", "uint16"},
    {block::time_total, 1, "time_total", "uint16"},
    {block::time_capture, 1, "time_capture", "uint16"},
    {block::time_preprocess, 1, "time_preprocess", "uint16"},
    {block::time_match, 1, "time_match", "uint16"},
    {block::time_cluster, 1, "time_cluster", "uint16"},
    {block::time_refine, 1, "time_refine", "uint16"},
    {block::time_verify, 1, "time_verify", "uint16"},
    {block::time_grasp, 1, "time_grasp", "uint16"},
    {block::test_word, 1, "test_word", "uint16"},
    {block::test_float, 2, "test_float", "float32"},
    {block::test_int, 2, "test_int", "int32"},
    {block::opening, 2, "opening", "float32"},
    {block::opening_scaled, 2, "opening_scaled", "int32"},
    {block::pick_pose, 14, "pick_pose", "float32[7]"},
    {block::pick_pose_scaled, 14, "pick_pose_scaled", "int32[7]"},
    {block::approach_pose, 14, "approach_pose", "float32[7]"},
    {block::approach_pose_scaled, 14, "approach_pose_scaled", "int32[7]"},
    {block::part_pose, 14, "part_pose", "float32[7]"},
    {block::part_pose_scaled, 14, "part_pose_scaled", "int32[7]"},
    {block::tool, 1, "tool", "uint16"},
    {block::checksum, 1, "checksum", "uint16"},
    {block::sequence_last, 1, "sequence_last", "uint16"},
}};

inline constexpr std::array<RegisterEntry, live_register::count> live_table{{
    {live_register::heartbeat, 1, "heartbeat", "uint16"},
    {live_register::phase, 1, "phase", "uint16"},
    {live_register::status_word, 1, "status_word", "uint16"},
    {live_register::sequence, 1, "sequence", "uint16"},
    {live_register::triggers_accepted, 1, "triggers_accepted", "uint16"},
    {live_register::triggers_refused, 1, "triggers_refused", "uint16"},
    {live_register::last_refusal, 1, "last_refusal", "uint16"},
    {live_register::clients, 1, "clients", "uint16"},
    {live_register::answer_overhead, 1, "answer_overhead", "uint16"},
}};

/// Offsets in a list; `type` is that of the floating-point list.
inline constexpr std::array<RegisterEntry, 12> pick_list_table{{
    {pick_list::map_version, 1, "map_version", "uint16"},
    {pick_list::sequence_first, 1, "sequence_first", "uint16"},
    {pick_list::request_id, 1, "request_id", "uint16"},
    {pick_list::result_code, 1, "result_code", "uint16"},
    {pick_list::picks, 1, "picks", "uint16"},
    {pick_list::remaining, 1, "remaining", "uint16"},
    {pick_list::pose_convention, 1, "pose_convention", "uint16"},
    {pick_list::pose_frame, 1, "pose_frame", "uint16"},
    {pick_list::approach_distance, 1, "approach_distance", "uint16"},
    {pick_list::first_entry, pick_list::entries* pick_list::entry_size, "entries", "entry[5]"},
    {pick_list::checksum, 1, "checksum", "uint16"},
    {pick_list::sequence_last, 1, "sequence_last", "uint16"},
}};
inline constexpr std::array<RegisterEntry, 6> pick_entry_table{{
    {pick_entry::part, 1, "part", "uint16"},
    {pick_entry::grasp, 1, "grasp", "uint16"},
    {pick_entry::tool, 1, "tool", "uint16"},
    {pick_entry::score, 1, "score", "uint16"},
    {pick_entry::opening, 2, "opening", "number"},
    {pick_entry::pick_pose, 14, "pick_pose", "number[7]"},
}};

}  // namespace graspd
