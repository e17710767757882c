#include "firmware_app/background_worker.hpp"

#include <exception>
#include <utility>

namespace graspd {

BackgroundWorker::BackgroundWorker(Job job, Told told) : job_(std::move(job)), told_(std::move(told)) {
  thread_ = std::thread([this] { work(); });
}

BackgroundWorker::~BackgroundWorker() {
  set(ending);
  thread_.join();
}

void BackgroundWorker::set(std::uint32_t bit) {
  state_.fetch_or(bit, std::memory_order_release);
  state_.notify_one();
}

void BackgroundWorker::work() {
  while (true) {
    const std::uint32_t state = state_.load(std::memory_order_acquire);
    if (state == 0) {
      state_.wait(state, std::memory_order_acquire);
      continue;
    }
    if ((state & taken) == 0) return;
    Status done;
    try {
      done = job_();
    } catch (const std::exception& problem) {
      done = Status::format(StatusCode::cannot_write, "%s", problem.what());
    }
    state_.fetch_and(~taken, std::memory_order_release);
    told_(done);
  }
}

}  // namespace graspd
