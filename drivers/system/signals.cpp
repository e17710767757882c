#include "drivers/system/signals.hpp"

#include <poll.h>
#include <pthread.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

namespace graspd {

Result<SignalWaiter> SignalWaiter::make() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  const int descriptor = signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
  if (descriptor < 0) {
    return Status::format(StatusCode::internal, "signals cannot be waited for: %s", strerrordesc_np(errno));
  }
  return SignalWaiter(descriptor);
}

SignalWaiter::SignalWaiter(SignalWaiter&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

SignalWaiter::~SignalWaiter() {
  if (descriptor_ >= 0) close(descriptor_);
}

Signal SignalWaiter::wait(std::chrono::milliseconds timeout) {
  pollfd waiting{descriptor_, POLLIN, 0};
  if (poll(&waiting, 1, static_cast<int>(timeout.count())) <= 0) return Signal::none;
  signalfd_siginfo info{};
  if (read(descriptor_, &info, sizeof(info)) != static_cast<ssize_t>(sizeof(info))) return Signal::none;
  return info.ssi_signo == SIGHUP ? Signal::reload : Signal::stop;
}

}  // namespace graspd
