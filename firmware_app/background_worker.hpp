#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>

#include "core/status.hpp"

namespace graspd {

/// A thread that does one job at a time for somebody who must not wait for it. What the job works on belongs to the
/// one who offers while nothing is taken, and to the thread from then on until the job is done.
class BackgroundWorker {
 public:
  using Job = std::function<Status()>;
  using Told = std::function<void(const Status&)>;

  /// `told` hears, on the thread, how each job went, once the next may be offered: it must not read what offering
  /// writes. An exception out of the job counts as cannot_write.
  BackgroundWorker(Job job, Told told);
  /// Does what was taken before it ends.
  ~BackgroundWorker();
  BackgroundWorker(const BackgroundWorker&) = delete;
  BackgroundWorker& operator=(const BackgroundWorker&) = delete;

  /// Calls `prepare`, which puts together what the job works on, and has the job done. False, without calling it, while
  /// the last one is not done. Waits for nothing and allocates nothing; to be called from one thread.
  template <class Prepare>
  [[nodiscard]] bool offer(const Prepare& prepare) {
    if ((state_.load(std::memory_order_acquire) & taken) != 0) return false;
    prepare();
    set(taken);
    return true;
  }

 private:
  static constexpr std::uint32_t taken = 1U << 0U;
  static constexpr std::uint32_t ending = 1U << 1U;

  void set(std::uint32_t bit);
  void work();

  Job job_;
  Told told_;
  std::atomic<std::uint32_t> state_{0};
  std::thread thread_;
};

}  // namespace graspd
