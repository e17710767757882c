#pragma once

#include <chrono>
#include <cstdint>

#include "core/status.hpp"

namespace graspd {

enum class Signal : std::uint8_t {
  none,    ///< Nothing came in time.
  stop,    ///< SIGTERM or SIGINT.
  reload,  ///< SIGHUP.
};

/// Turns signals into something to wait for. Make one before any thread is started: threads inherit
/// that the signals are blocked. SIGPIPE is ignored from then on.
class SignalWaiter {
 public:
  /// Fails with internal when the kernel gives no descriptor.
  [[nodiscard]] static Result<SignalWaiter> make();
  SignalWaiter(SignalWaiter&& other) noexcept;
  SignalWaiter& operator=(SignalWaiter&&) = delete;
  ~SignalWaiter();

  [[nodiscard]] Signal wait(std::chrono::milliseconds timeout);

 private:
  explicit SignalWaiter(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

}  // namespace graspd
