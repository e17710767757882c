#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <net/if.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>

namespace graspd {

/// Gives the calling thread, and what it starts, a network with nothing in it but a loopback, so that cameras of
/// tests that run at the same time do not meet on GigE Vision's one port. Where the system does not allow that,
/// waits until no other test uses the machine's own loopback. Once for a process.
inline void enter_private_network() {
  static bool entered = false;
  if (entered) return;
  entered = true;
  if (unshare(CLONE_NEWNET) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) {
    const std::filesystem::path lock = std::filesystem::temp_directory_path() / "graspd_test_camera.lock";
    const int file = open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    // Held until the process ends.
    if (file >= 0) flock(file, LOCK_EX);
    return;
  }
  const int socket_number = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ifreq loopback{};
  std::strncpy(loopback.ifr_name, "lo", IFNAMSIZ - 1);
  ASSERT_EQ(ioctl(socket_number, SIOCGIFFLAGS, &loopback), 0);
  loopback.ifr_flags = static_cast<short>(loopback.ifr_flags | IFF_UP);
  ASSERT_EQ(ioctl(socket_number, SIOCSIFFLAGS, &loopback), 0);
  close(socket_number);
}

}  // namespace graspd
