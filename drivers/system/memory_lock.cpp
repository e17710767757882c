#include "drivers/system/memory_lock.hpp"

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>

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

}  // namespace graspd
