#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace graspd {

/// The addresses that a PLC sees (protocol addresses, from 0). configs/register-map.md says what each
/// means; a test holds that page against these tables.
inline constexpr std::uint16_t register_map_version = 1;

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

/// Coils, written by the PLC; only their rising edges count.
namespace coil {
inline constexpr std::uint16_t trigger = 0;
inline constexpr std::uint16_t acknowledge = 1;
inline constexpr std::uint16_t reset = 2;
inline constexpr std::uint16_t next = 3;
inline constexpr std::uint16_t count = 4;
}  // namespace coil
inline constexpr std::array<BitEntry, coil::count> coil_table{{
    {coil::trigger, "trigger"},
    {coil::acknowledge, "acknowledge"},
    {coil::reset, "reset"},
    {coil::next, "next"},
}};

/// Discrete inputs, read by the PLC.
namespace discrete_input {
inline constexpr std::uint16_t ready = 0;
inline constexpr std::uint16_t busy = 1;
inline constexpr std::uint16_t capture_done = 2;
inline constexpr std::uint16_t done = 3;
inline constexpr std::uint16_t error = 4;
inline constexpr std::uint16_t result_valid = 5;
inline constexpr std::uint16_t camera_ok = 6;
inline constexpr std::uint16_t model_loaded = 7;
inline constexpr std::uint16_t plc_alive = 8;
inline constexpr std::uint16_t count = 9;
}  // namespace discrete_input
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

/// Holding registers that the PLC writes. The rising edge of `trigger` takes a copy of them.
namespace request_register {
inline constexpr std::uint16_t request_id = 0;
inline constexpr std::uint16_t part = 1;
inline constexpr std::uint16_t minimum_score = 2;
inline constexpr std::uint16_t pose_convention = 3;
inline constexpr std::uint16_t plc_heartbeat = 4;
inline constexpr std::uint16_t count = 5;
}  // namespace request_register
inline constexpr std::array<RegisterEntry, request_register::count> request_table{{
    {request_register::request_id, 1, "request_id", "uint16"},
    {request_register::part, 1, "part", "uint16"},
    {request_register::minimum_score, 1, "minimum_score", "uint16"},
    {request_register::pose_convention, 1, "pose_convention", "uint16"},
    {request_register::plc_heartbeat, 1, "plc_heartbeat", "uint16"},
}};

/// Offsets in the result block, which is committed and read as one.
namespace block {
inline constexpr std::uint16_t map_version = 0;
inline constexpr std::uint16_t sequence_first = 1;
inline constexpr std::uint16_t request_id = 2;
inline constexpr std::uint16_t result_code = 3;
inline constexpr std::uint16_t reason = 4;
inline constexpr std::uint16_t flags = 5;
inline constexpr std::uint16_t part = 6;
inline constexpr std::uint16_t view = 7;
inline constexpr std::uint16_t grasp = 8;
inline constexpr std::uint16_t score = 9;
inline constexpr std::uint16_t instances_found = 10;
inline constexpr std::uint16_t pickable = 11;
inline constexpr std::uint16_t remaining = 12;
inline constexpr std::uint16_t result_index = 13;
inline constexpr std::uint16_t pose_convention = 14;
inline constexpr std::uint16_t pose_frame = 15;
inline constexpr std::uint16_t frame_age = 16;
inline constexpr std::uint16_t time_total = 17;
inline constexpr std::uint16_t time_capture = 18;
inline constexpr std::uint16_t time_preprocess = 19;
inline constexpr std::uint16_t time_match = 20;
inline constexpr std::uint16_t time_cluster = 21;
inline constexpr std::uint16_t time_refine = 22;
inline constexpr std::uint16_t time_verify = 23;
inline constexpr std::uint16_t time_grasp = 24;
inline constexpr std::uint16_t test_word = 25;
inline constexpr std::uint16_t test_float = 26;
inline constexpr std::uint16_t test_int = 28;
inline constexpr std::uint16_t opening = 30;
inline constexpr std::uint16_t opening_scaled = 32;
inline constexpr std::uint16_t pick_pose = 34;
inline constexpr std::uint16_t pick_pose_scaled = 48;
inline constexpr std::uint16_t approach_pose = 62;
inline constexpr std::uint16_t approach_pose_scaled = 76;
inline constexpr std::uint16_t part_pose = 90;
inline constexpr std::uint16_t part_pose_scaled = 104;
inline constexpr std::uint16_t checksum = 118;
inline constexpr std::uint16_t sequence_last = 119;
inline constexpr std::uint16_t count = 120;

inline constexpr std::uint16_t test_word_value = 0x1234;
inline constexpr float test_float_value = 123.456F;
inline constexpr std::int32_t test_int_value = 123456;
}  // namespace block
static_assert(block::count <= 125, "the block must be readable in one request");

inline constexpr std::array<RegisterEntry, 38> block_table{{
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
    {block::checksum, 1, "checksum", "uint16"},
    {block::sequence_last, 1, "sequence_last", "uint16"},
}};

/// Input registers that change at any time, outside the block.
namespace live_register {
inline constexpr std::uint16_t first = 200;
inline constexpr std::uint16_t heartbeat = 200;
inline constexpr std::uint16_t phase = 201;
inline constexpr std::uint16_t status_word = 202;
inline constexpr std::uint16_t sequence = 203;
inline constexpr std::uint16_t triggers_accepted = 204;
inline constexpr std::uint16_t triggers_refused = 205;
inline constexpr std::uint16_t last_refusal = 206;
inline constexpr std::uint16_t clients = 207;
inline constexpr std::uint16_t count = 8;
}  // namespace live_register
inline constexpr std::array<RegisterEntry, live_register::count> live_table{{
    {live_register::heartbeat, 1, "heartbeat", "uint16"},
    {live_register::phase, 1, "phase", "uint16"},
    {live_register::status_word, 1, "status_word", "uint16"},
    {live_register::sequence, 1, "sequence", "uint16"},
    {live_register::triggers_accepted, 1, "triggers_accepted", "uint16"},
    {live_register::triggers_refused, 1, "triggers_refused", "uint16"},
    {live_register::last_refusal, 1, "last_refusal", "uint16"},
    {live_register::clients, 1, "clients", "uint16"},
}};

/// Input registers lie at their own addresses; a PLC that reads holding registers only finds the same
/// contents this much higher among them.
inline constexpr std::uint16_t holding_mirror = 1000;

inline constexpr std::uint16_t input_register_space = live_register::first + live_register::count;
inline constexpr std::uint16_t holding_register_space = holding_mirror + input_register_space;

}  // namespace graspd
