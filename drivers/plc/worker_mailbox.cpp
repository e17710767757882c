#include "drivers/plc/worker_mailbox.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

namespace graspd {

WorkerMailbox::WorkerMailbox() : wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

WorkerMailbox::~WorkerMailbox() {
  if (wake_ >= 0) ::close(wake_);
}

void WorkerMailbox::post(const PlcRequest& request) {
  {
    const std::lock_guard lock(mutex_);
    request_ = request;
    has_request_ = true;
  }
  posted_.notify_one();
}

WorkerNews WorkerMailbox::take() {
  // Unset before the news is taken: what arrives in between wakes the thread once more.
  eventfd_t ignored = 0;
  eventfd_read(wake_, &ignored);
  const std::lock_guard lock(mutex_);
  const WorkerNews news = news_;
  news_.capture_done = 0;
  news_.has_answer = false;
  return news;
}

void WorkerMailbox::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  posted_.notify_all();
  wake();
}

bool WorkerMailbox::wait(PlcRequest& request, std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  posted_.wait_for(lock, timeout, [this] { return has_request_ || closed_; });
  if (!has_request_ || closed_) return false;
  request = request_;
  has_request_ = false;
  return true;
}

void WorkerMailbox::capture_done(std::uint16_t sequence) {
  {
    const std::lock_guard lock(mutex_);
    news_.capture_done = sequence;
  }
  wake();
}

void WorkerMailbox::answer(const ResultBlock& result) {
  {
    const std::lock_guard lock(mutex_);
    news_.answer = result;
    news_.has_answer = true;
  }
  wake();
}

void WorkerMailbox::set_camera_ok(bool ok) {
  {
    const std::lock_guard lock(mutex_);
    if (news_.camera_ok == ok) return;
    news_.camera_ok = ok;
  }
  wake();
}

void WorkerMailbox::set_model_loaded(bool loaded) {
  {
    const std::lock_guard lock(mutex_);
    if (news_.model_loaded == loaded) return;
    news_.model_loaded = loaded;
  }
  wake();
}

void WorkerMailbox::wake() const { eventfd_write(wake_, 1); }

}  // namespace graspd
