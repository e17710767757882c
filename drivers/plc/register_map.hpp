#pragma once

#include <cstddef>
#include <cstdint>

namespace graspd {

/// The addresses that a PLC sees (protocol addresses, from 0). configs/register-map.md says what each
/// means; a test holds that page against these tables.
inline constexpr std::uint16_t register_map_version = 2;

/// Coils, written by the PLC; only their rising edges count.
namespace coil {
inline constexpr std::uint16_t trigger = 0;
inline constexpr std::uint16_t acknowledge = 1;
inline constexpr std::uint16_t reset = 2;
inline constexpr std::uint16_t next = 3;
inline constexpr std::uint16_t count = 4;
}  // namespace coil

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

/// Holding registers that the PLC writes. The rising edge of `trigger` takes a copy of them.
namespace request_register {
inline constexpr std::uint16_t request_id = 0;
inline constexpr std::uint16_t part = 1;
inline constexpr std::uint16_t minimum_score = 2;
inline constexpr std::uint16_t pose_convention = 3;
inline constexpr std::uint16_t plc_heartbeat = 4;
inline constexpr std::uint16_t options = 5;
inline constexpr std::uint16_t results_wanted = 6;
inline constexpr std::uint16_t region = 7;
inline constexpr std::uint16_t region_box = 8;
inline constexpr std::uint16_t flange_pose = 22;
inline constexpr std::uint16_t tool = 36;
inline constexpr std::uint16_t count = 37;
}  // namespace request_register

/// The bits of the request register `options`.
namespace request_option {
inline constexpr std::uint16_t dry_run = 1U << 0U;
inline constexpr std::uint16_t save_snapshot = 1U << 1U;
inline constexpr std::uint16_t avoid_last_place = 1U << 2U;
inline constexpr std::uint16_t flange_pose_given = 1U << 3U;
inline constexpr std::uint16_t scaled_numbers = 1U << 4U;
inline constexpr std::uint16_t all = 0x1F;
}  // namespace request_option

/// Values of the request register `region` beside 0, which means none.
namespace request_region {
inline constexpr std::uint16_t most_numbers = 16;  ///< 1 to 16: regions of the configuration.
inline constexpr std::uint16_t box = 100;          ///< The box in the request registers.
}  // namespace request_region

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
inline constexpr std::uint16_t tool = 118;
inline constexpr std::uint16_t checksum = 119;
inline constexpr std::uint16_t sequence_last = 120;
inline constexpr std::uint16_t count = 121;

inline constexpr std::uint16_t test_word_value = 0x1234;
inline constexpr float test_float_value = 123.456F;
inline constexpr std::int32_t test_int_value = 123456;
}  // namespace block
static_assert(block::count <= 125, "the block must be readable in one request");

/// Offsets in a list of picks. There are two, of the same form: one with float32, one with scaled int32.
namespace pick_list {
inline constexpr std::uint16_t floats_first = 300;
inline constexpr std::uint16_t scaled_first = 500;

inline constexpr std::uint16_t map_version = 0;
inline constexpr std::uint16_t sequence_first = 1;
inline constexpr std::uint16_t request_id = 2;
inline constexpr std::uint16_t result_code = 3;
inline constexpr std::uint16_t picks = 4;
inline constexpr std::uint16_t remaining = 5;
inline constexpr std::uint16_t pose_convention = 6;
inline constexpr std::uint16_t pose_frame = 7;
inline constexpr std::uint16_t approach_distance = 8;
inline constexpr std::uint16_t first_entry = 9;
inline constexpr std::uint16_t entry_size = 20;
inline constexpr std::uint16_t entries = 5;
inline constexpr std::uint16_t checksum = first_entry + entries * entry_size;
inline constexpr std::uint16_t sequence_last = checksum + 1;
inline constexpr std::uint16_t count = sequence_last + 1;
}  // namespace pick_list
static_assert(pick_list::count <= 125, "a list must be readable in one request");

/// Offsets in an entry of a list.
namespace pick_entry {
inline constexpr std::uint16_t part = 0;
inline constexpr std::uint16_t grasp = 1;
inline constexpr std::uint16_t tool = 2;
inline constexpr std::uint16_t score = 3;
inline constexpr std::uint16_t opening = 4;
inline constexpr std::uint16_t pick_pose = 6;
}  // namespace pick_entry

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
inline constexpr std::uint16_t answer_overhead = 208;
inline constexpr std::uint16_t count = 9;
}  // namespace live_register

/// Input registers lie at their own addresses; a PLC that reads holding registers only finds the same
/// contents this much higher among them.
inline constexpr std::uint16_t holding_mirror = 1000;

inline constexpr std::uint16_t input_register_space = pick_list::scaled_first + pick_list::count;
inline constexpr std::uint16_t holding_register_space = holding_mirror + input_register_space;

}  // namespace graspd
