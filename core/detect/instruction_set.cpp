#include "core/detect/instruction_set.hpp"

namespace graspd {

bool is_supported(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx2) return __builtin_cpu_supports("avx2") != 0;
  if (set == InstructionSet::avx512)
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
           __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512vl") != 0;
#endif
  return set == InstructionSet::baseline;
}

InstructionSet widest_instruction_set() {
  InstructionSet widest = InstructionSet::baseline;
  for (const InstructionSet set : every_instruction_set) widest = is_supported(set) ? set : widest;
  return widest;
}

}  // namespace graspd
