#include "drivers/system/memory_lock.hpp"

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace graspd {

Status lock_memory() {
  mallopt(M_TRIM_THRESHOLD, -1);
  mallopt(M_MMAP_MAX, 0);
  if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return {};
  const int reason = errno;
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  return Status::format(StatusCode::memory_limit,
                        "memory cannot be locked: %s; the limit is %llu bytes: set LimitMEMLOCK=infinity in the unit, "
                        "or `ulimit -l unlimited`",
                        strerrordesc_np(reason), static_cast<unsigned long long>(limit.rlim_cur));
}

void prefault(std::span<std::byte> memory) {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const auto touch = [](std::byte& byte) {
    volatile std::byte* place = &byte;
    const std::byte value = *place;
    *place = value;
  };
  for (std::size_t i = 0; i < memory.size(); i += page) touch(memory[i]);
  if (!memory.empty()) touch(memory.back());
}

void prefault_stack(std::size_t bytes) {
  constexpr std::size_t limit = std::size_t{1} << 20U;
  std::array<std::byte, limit> stack;
  prefault(std::span(stack).last(std::min(bytes, limit)));
}

}  // namespace graspd
