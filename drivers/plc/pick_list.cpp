#include "drivers/plc/pick_list.hpp"

#include <algorithm>
#include <cmath>

#include "drivers/plc/coherent_words.hpp"

namespace graspd {
namespace {

constexpr double steps_per_metre = 1e4;

[[nodiscard]] bool is_finite(const ListedPick& entry) {
  return entry.pick.rotation.allFinite() && entry.pick.translation.allFinite() && std::isfinite(entry.opening);
}

/// Of the listed picks, how many may go out.
[[nodiscard]] std::uint16_t sound_entries(const ResultBlock& result) {
  if (!has_poses(result)) return 0;
  std::uint16_t sound = 0;
  while (sound < std::min(result.listed_count, pick_list::entries) && is_finite(result.listed[sound])) ++sound;
  return sound;
}

[[nodiscard]] std::size_t entry_at(std::size_t index) {
  return pick_list::first_entry + index * std::size_t{pick_list::entry_size};
}

[[nodiscard]] Status check(std::span<const std::uint16_t> words) {
  if (Status whole = check_coherent(words, pick_list::count, "list of picks"); !whole.ok()) return whole;
  const std::uint16_t convention = words[pick_list::pose_convention];
  if (convention < 1 || convention > pose_convention_count || words[pick_list::picks] > pick_list::entries) {
    return {StatusCode::bad_file, "list of picks: unknown pose convention, or more picks than a list holds"};
  }
  return {};
}

}  // namespace

void encode_list(const ResultBlock& result, NumberKind kind, const BlockFormat& format,
                 std::span<std::uint16_t> words) {
  begin_coherent(words.first(pick_list::count), result.sequence);
  words[pick_list::request_id] = result.request_id;
  words[pick_list::result_code] = static_cast<std::uint16_t>(result.code);
  words[pick_list::picks] = sound_entries(result);
  words[pick_list::remaining] = result.remaining;
  words[pick_list::pose_convention] = static_cast<std::uint16_t>(format.convention);
  words[pick_list::pose_frame] = static_cast<std::uint16_t>(result.frame);
  words[pick_list::approach_distance] = rounded_word(steps_per_metre * static_cast<double>(result.approach_distance));
  for (std::size_t i = 0; i < words[pick_list::picks]; ++i) {
    const ListedPick& entry = result.listed[i];
    const std::span<std::uint16_t> at = words.subspan(entry_at(i));
    at[pick_entry::part] = entry.part;
    at[pick_entry::grasp] = entry.grasp;
    at[pick_entry::tool] = entry.tool;
    at[pick_entry::score] = rounded_word(1e4 * static_cast<double>(entry.score));
    put_length(at.subspan(pick_entry::opening), static_cast<double>(entry.opening), kind, format);
    put_pose(at.subspan(pick_entry::pick_pose), entry.pick, kind, format);
  }
  end_coherent(words.first(pick_list::count));
}

Result<ResultBlock> decode_list(std::span<const std::uint16_t> words, NumberKind kind, const BlockFormat& format) {
  if (Status sound = check(words); !sound.ok()) return sound;
  BlockFormat own = format;
  own.convention = static_cast<PoseConvention>(words[pick_list::pose_convention]);
  ResultBlock result;
  result.sequence = words[pick_list::sequence_first];
  result.request_id = words[pick_list::request_id];
  result.code = static_cast<ResultCode>(words[pick_list::result_code]);
  result.listed_count = words[pick_list::picks];
  result.remaining = words[pick_list::remaining];
  result.frame = static_cast<PoseFrame>(words[pick_list::pose_frame]);
  result.approach_distance =
      static_cast<float>(static_cast<double>(words[pick_list::approach_distance]) / steps_per_metre);
  result.verified = result.listed_count > 0;
  for (std::size_t i = 0; i < result.listed_count; ++i) {
    const std::span<const std::uint16_t> at = words.subspan(entry_at(i));
    ListedPick& entry = result.listed[i];
    entry.part = at[pick_entry::part];
    entry.grasp = at[pick_entry::grasp];
    entry.tool = at[pick_entry::tool];
    entry.score = static_cast<float>(at[pick_entry::score]) / 1e4F;
    entry.opening = static_cast<float>(get_length(at.subspan(pick_entry::opening), kind, own));
    entry.pick = get_pose(at.subspan(pick_entry::pick_pose), kind, own);
  }
  return result;
}

}  // namespace graspd
