#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>

#include "drivers/plc/plc_link.hpp"
#include "drivers/plc/result_block.hpp"

namespace graspd {

/// What the worker had to say since the link's thread looked last.
struct WorkerNews {
  std::uint16_t capture_done = 0;  ///< Sequence of the request whose frame is taken; 0: none.
  bool has_answer = false;
  ResultBlock answer;
  bool camera_ok = false;
  bool model_loaded = false;
};

/// Carries requests from the link's thread to the worker and news back, one place for each. The lock is
/// held only while one of them is copied; nothing allocates.
class WorkerMailbox {
 public:
  WorkerMailbox();
  WorkerMailbox(const WorkerMailbox&) = delete;
  WorkerMailbox& operator=(const WorkerMailbox&) = delete;
  ~WorkerMailbox();

  /// False when the kernel gives no descriptor to wake the link's thread with.
  [[nodiscard]] bool is_usable() const { return wake_ >= 0; }

  /// @name The link's side
  /// @{
  /// Hands a request to the worker; there is never more than one at a time.
  void post(const PlcRequest& request);
  /// Names the request that the PLC still wants; 0: none.
  void set_wanted(std::uint16_t sequence) { wanted_.store(sequence, std::memory_order_relaxed); }
  /// Becomes readable when there is news.
  [[nodiscard]] int wake_descriptor() const { return wake_; }
  /// Takes the news and makes the descriptor unreadable again.
  [[nodiscard]] WorkerNews take();
  /// Wakes both sides for good.
  void close();
  /// @}

  /// @name The worker's side
  /// @{
  [[nodiscard]] bool wait(PlcRequest& request, std::chrono::milliseconds timeout);
  [[nodiscard]] bool is_wanted(std::uint16_t sequence) const {
    return wanted_.load(std::memory_order_relaxed) == sequence;
  }
  void capture_done(std::uint16_t sequence);
  void answer(const ResultBlock& result);
  void set_camera_ok(bool ok);
  void set_model_loaded(bool loaded);
  /// @}

 private:
  void wake() const;

  std::mutex mutex_;
  std::condition_variable posted_;
  PlcRequest request_;
  bool has_request_ = false;
  bool closed_ = false;
  WorkerNews news_;
  std::atomic<std::uint16_t> wanted_{0};
  int wake_ = -1;
};

}  // namespace graspd
