#include "drivers/plc/coherent_words.hpp"

#include <algorithm>
#include <cmath>

#include "drivers/plc/register_map.hpp"

namespace graspd {
namespace {

static_assert(block::map_version == coherent::map_version && pick_list::map_version == coherent::map_version);
static_assert(block::sequence_first == coherent::sequence_first &&
              pick_list::sequence_first == coherent::sequence_first);
static_assert(block::checksum == block::count - coherent::tail && block::sequence_last == block::checksum + 1);
static_assert(pick_list::checksum == pick_list::count - coherent::tail &&
              pick_list::sequence_last == pick_list::checksum + 1);

}  // namespace

void begin_coherent(std::span<std::uint16_t> words, std::uint16_t sequence) {
  std::ranges::fill(words, std::uint16_t{0});
  words[coherent::map_version] = register_map_version;
  words[coherent::sequence_first] = sequence;
}

void end_coherent(std::span<std::uint16_t> words) {
  const std::span<std::uint16_t> last = words.last(coherent::tail);
  last[0] = block_checksum(words.first(words.size() - coherent::tail));
  last[1] = words[coherent::sequence_first];
}

Status check_coherent(std::span<const std::uint16_t> words, std::size_t count, const char* what) {
  if (words.size() < count) {
    return Status::format(StatusCode::bad_file, "%s: %zu registers read, %zu are needed", what, words.size(), count);
  }
  const std::span<const std::uint16_t> last = words.first(count).last(coherent::tail);
  if (words[coherent::map_version] != register_map_version) {
    return Status::format(StatusCode::bad_file, "%s: map version %u, expected %u", what,
                          unsigned{words[coherent::map_version]}, unsigned{register_map_version});
  }
  if (words[coherent::sequence_first] != last[1]) {
    return Status::format(StatusCode::bad_file, "%s: torn: sequence %u at the start, %u at the end", what,
                          unsigned{words[coherent::sequence_first]}, unsigned{last[1]});
  }
  if (block_checksum(words.first(count - coherent::tail)) != last[0]) {
    return Status::format(StatusCode::bad_file, "%s: the checksum does not fit the contents", what);
  }
  return {};
}

std::uint16_t block_checksum(std::span<const std::uint16_t> words) {
  unsigned crc = 0xFFFF;
  const auto add = [&crc](unsigned byte) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? (crc >> 1U) ^ 0xA001U : crc >> 1U;
  };
  for (const std::uint16_t word : words) {
    add(static_cast<unsigned>(word) >> 8U);
    add(static_cast<unsigned>(word) & 0xFFU);
  }
  return static_cast<std::uint16_t>(crc);
}

std::uint16_t rounded_word(double value) {
  if (!(value > 0)) return 0;
  return static_cast<std::uint16_t>(std::lround(std::min(value, 65535.0)));
}

}  // namespace graspd
