#pragma once

#include <array>
#include <cstdint>

namespace graspd {

/// The vector instructions for which the voting is compiled; its results are the same with all of them.
enum class InstructionSet : std::uint8_t {
  baseline,  ///< What the whole program asks of the processor.
  avx2,
  avx512,  ///< F, BW, DQ and VL.
};
inline constexpr std::array every_instruction_set{InstructionSet::baseline, InstructionSet::avx2,
                                                  InstructionSet::avx512};

/// Whether this processor, and its operating system, can run them.
[[nodiscard]] bool is_supported(InstructionSet set);

/// The widest that is supported.
[[nodiscard]] InstructionSet widest_instruction_set();

}  // namespace graspd
