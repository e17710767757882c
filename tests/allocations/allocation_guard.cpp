#include "tests/allocations/allocation_guard.hpp"

#include <cxxabi.h>
#include <dlfcn.h>
#include <execinfo.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <new>

// What the C library calls its allocator when a program brings another.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void* __libc_valloc(std::size_t size);
void* __libc_pvalloc(std::size_t size);
void __libc_free(void* block);
}

namespace {

struct CallStack {
  std::array<void*, 24> frames;
  int depth;
};

std::atomic<bool> armed{false};
std::atomic<std::size_t> allocations{0};
std::atomic<std::size_t> allocations_by_new{0};
thread_local std::size_t own_allocations = 0;
std::array<CallStack, 8> stacks{};
thread_local bool inside_recorder = false;

void record() {
  if (!armed.load(std::memory_order_relaxed) || inside_recorder) return;
  ++own_allocations;
  const std::size_t index = allocations.fetch_add(1);
  if (index >= stacks.size()) return;
  inside_recorder = true;
  stacks[index].depth = backtrace(stacks[index].frames.data(), static_cast<int>(stacks[index].frames.size()));
  inside_recorder = false;
}

void record_new() {
  if (armed.load(std::memory_order_relaxed) && !inside_recorder) ++allocations_by_new;
}

void* made_or_thrown(void* block) {
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

std::string name_of(void* address) {
  Dl_info info{};
  if (dladdr(address, &info) == 0 || info.dli_sname == nullptr) return info.dli_fname ? info.dli_fname : "?";
  int failed = 0;
  char* readable = abi::__cxa_demangle(info.dli_sname, nullptr, nullptr, &failed);
  std::string name = failed == 0 ? readable : info.dli_sname;
  std::free(readable);
  return name;
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
  record();
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  record();
  return __libc_calloc(count, size);
}

void* realloc(void* block, std::size_t size) {
  record();
  return __libc_realloc(block, size);
}

void* reallocarray(void* block, std::size_t count, std::size_t size) {
  std::size_t bytes = 0;
  if (__builtin_mul_overflow(count, size, &bytes)) {
    errno = ENOMEM;
    return nullptr;
  }
  record();
  return __libc_realloc(block, bytes);
}

void* memalign(std::size_t alignment, std::size_t size) {
  record();
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  record();
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  if (alignment % sizeof(void*) != 0 || (alignment & (alignment - 1)) != 0 || alignment == 0) return EINVAL;
  record();
  void* const made = __libc_memalign(alignment, size);
  if (made == nullptr) return ENOMEM;
  *block = made;
  return 0;
}

void* valloc(std::size_t size) {
  record();
  return __libc_valloc(size);
}

void* pvalloc(std::size_t size) {
  record();
  return __libc_pvalloc(size);
}

void free(void* block) { __libc_free(block); }

}  // extern "C"

// The other forms of new end in these.
void* operator new(std::size_t size) {
  record_new();
  return made_or_thrown(std::malloc(size == 0 ? 1 : size));
}

void* operator new(std::size_t size, std::align_val_t alignment) {
  record_new();
  return made_or_thrown(memalign(static_cast<std::size_t>(alignment), size == 0 ? 1 : size));
}

void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
void operator delete(void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }

namespace graspd::testing {

AllocationGuard::AllocationGuard() {
  // The first backtrace loads libgcc, which allocates.
  std::array<void*, 2> unused{};
  static_cast<void>(backtrace(unused.data(), static_cast<int>(unused.size())));
  allocations = 0;
  allocations_by_new = 0;
  own_allocations = 0;
  armed = true;
}

AllocationGuard::~AllocationGuard() { armed = false; }

std::size_t AllocationGuard::stop() {
  armed = false;
  return allocations;
}

std::size_t AllocationGuard::by_new() const { return allocations_by_new; }

std::size_t AllocationGuard::on_this_thread() const { return own_allocations; }

std::string AllocationGuard::report() const {
  std::string text = std::to_string(allocations.load()) + " allocations\n";
  const std::size_t shown = std::min(allocations.load(), stacks.size());
  constexpr int own_frames = 2;
  for (std::size_t i = 0; i < shown; ++i) {
    text += "allocation " + std::to_string(i + 1) + ":\n";
    const auto depth = static_cast<std::size_t>(std::max(stacks[i].depth, own_frames));
    for (std::size_t f = own_frames; f < depth; ++f) text += "    " + name_of(stacks[i].frames[f]) + "\n";
  }
  return text;
}

}  // namespace graspd::testing
