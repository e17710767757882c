#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drivers/files/atomic_file.hpp"
#include "drivers/plc/modbus_client.hpp"
#include "tests/drivers/camera/private_network.hpp"
#include "tests/firmware_app/graspd_process.hpp"
#include "tests/firmware_app/pick_cycle_fixture.hpp"

namespace graspd {

/// `graspd run`, and `graspd simulate` with a scene of angle bars as its camera, alone on a loopback.
class CameraAndDaemon : public testing::Test {
 protected:
  static constexpr std::chrono::seconds patience{60};

  void SetUp() override {
    enter_private_network();
    scene_ = write_bop_scene(folder_.path("data"), angle_bar_scene());
    ASSERT_TRUE(write_file(folder_.path("bar.bank"), shared_angle_bar_bank()).ok());
  }

  void switch_camera_on(std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"simulate", scene_.string(), "--serial", "BAR1"});
    camera_.emplace(camera_folder_, std::move(more));
    ASSERT_TRUE(camera_->wait_for("plays ", patience)) << camera_->errors();
  }

  /// Starts `graspd run` with these lines in [camera].
  void start_daemon(const std::string& camera, const std::string& more = "") {
    const std::string configuration = folder_.write(
        "graspd.toml", "banks = [\"bar.bank\"]\n[camera]\n" + camera +
                           "\n[modbus]\naddress = \"127.0.0.1\"\nport = 0\n" + "[memory]\nlock = false\n" + more);
    daemon_.emplace(daemon_folder_, std::vector<std::string>{"run", "--config", configuration});
    const std::optional<std::string> port = daemon_->wait_for(" port=", patience);
    ASSERT_TRUE(port) << daemon_->errors();
    port_ = static_cast<std::uint16_t>(std::stoi(*port));
  }
  void start_daemon_on_camera(const std::string& more = "") {
    start_daemon("source = \"genicam\"\ndevice = \"127.0.0.1\"\ntimeout = 1.0\nempty_bin = \"" +
                     (scene_ / "empty" / "000000.png").string() + "\"",
                 more);
  }

  ResultBlock ask(const ClientRequest& request = {}) const {
    Result<ModbusClient> client = ModbusClient::connect("127.0.0.1", port_, BlockFormat{});
    EXPECT_TRUE(client.ok()) << client.status().message();
    if (!client.ok()) return {};
    const Result<ResultBlock> block = client.value().request_pick(request, patience);
    EXPECT_TRUE(block.ok()) << block.status().message() << daemon_->errors();
    return block.ok() ? block.value() : ResultBlock{};
  }

  TemporaryFolder folder_;
  TemporaryFolder camera_folder_;
  TemporaryFolder daemon_folder_;
  std::filesystem::path scene_;
  std::optional<GraspdProcess> camera_;
  std::optional<GraspdProcess> daemon_;
  std::uint16_t port_ = 0;
};

}  // namespace graspd
