#pragma once

#include <cstdint>
#include <span>

#include "drivers/plc/result_block.hpp"

namespace graspd {

/// Writes the list of picks of `result` to the first pick_list::count of `words`. Without has_poses() the
/// list is empty. What is not finite ends the list.
void encode_list(const ResultBlock& result, NumberKind kind, const BlockFormat& format, std::span<std::uint16_t> words);

/// Reads a list back: of the block only what a list holds, its picks in `listed`. The convention is taken
/// from the list, the rest from `format`. Fails with bad_file as decode() does.
[[nodiscard]] Result<ResultBlock> decode_list(std::span<const std::uint16_t> words, NumberKind kind,
                                              const BlockFormat& format);

}  // namespace graspd
