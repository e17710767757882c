#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>

namespace graspd {
namespace {

const std::string unit_path = std::string(GRASPD_SOURCE_DIR) + "/configs/graspd.service";

TEST(ServiceUnit, AsksForWhatTheDaemonReliesOn) {
  std::ifstream file(unit_path);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  for (const char* line :
       {"Type=notify", "WatchdogSec=", "Restart=on-failure", "LimitMEMLOCK=infinity",
        "AmbientCapabilities=CAP_NET_BIND_SERVICE", "After=network-online.target", "SystemCallFilter=sched_setattr"}) {
    EXPECT_NE(text.find(std::string("\n") + line), std::string::npos) << line;
  }
}

TEST(ServiceUnit, StaysHardened) {
  if (std::system("systemd-analyze --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "systemd-analyze is missing";
  // The threshold is in tenths of systemd's exposure level.
  const std::string command = "systemd-analyze security --offline=true --threshold=20 " + unit_path + " > /dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0) << "the exposure level is above 2.0: " << command;
}

}  // namespace
}  // namespace graspd
