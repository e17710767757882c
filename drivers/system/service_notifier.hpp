#pragma once

#include <cstdint>

namespace graspd {

/// Tells systemd how the service is (sd_notify's protocol: a datagram to the socket NOTIFY_SOCKET names).
/// Where there is no such socket, every call does nothing. Nothing allocates.
class ServiceNotifier {
 public:
  /// Reads NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID from the environment.
  ServiceNotifier();
  ServiceNotifier(const ServiceNotifier&) = delete;
  ServiceNotifier& operator=(const ServiceNotifier&) = delete;
  ~ServiceNotifier();

  /// True when somebody listens.
  [[nodiscard]] bool is_connected() const { return socket_ >= 0; }

  void ready();
  void stopping();
  void watchdog();
  /// One line for `systemctl status`; printf-style.
  [[gnu::format(printf, 2, 3)]] void status(const char* format, ...);

  /// How often systemd wants to hear watchdog(); half of it is a good period. 0: it does not.
  [[nodiscard]] std::int64_t watchdog_interval_ns() const { return watchdog_interval_ns_; }

 private:
  void send(const char* message);
  int socket_ = -1;
  std::int64_t watchdog_interval_ns_ = 0;
};

}  // namespace graspd
