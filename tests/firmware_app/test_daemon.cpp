#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "drivers/files/atomic_file.hpp"
#include "drivers/files/load_frame.hpp"
#include "drivers/plc/modbus_client.hpp"
#include "tests/drivers/plc/plc_stand_in.hpp"
#include "tests/firmware_app/graspd_process.hpp"
#include "tests/firmware_app/pick_cycle_fixture.hpp"

namespace graspd {
namespace {

using testing::HasSubstr;

constexpr std::chrono::seconds patience{60};

/// `graspd run` on a recorded scene of two angle bars.
class Daemon : public testing::Test {
 protected:
  void start(const std::string& more = "", const std::string& role = "server") {
    ASSERT_TRUE(write_file(folder_.path("bar.bank"), shared_angle_bar_bank()).ok());
    const std::filesystem::path scene = write_bop_scene(folder_.path("data"), angle_bar_scene());
    const std::string configuration =
        folder_.write("graspd.toml", "banks = [\"bar.bank\"]\n[camera]\nsource = \"recorded\"\npath = \"" +
                                         scene.string() + "\"\n[memory]\nlock = false\n[modbus]\nrole = \"" + role +
                                         "\"\naddress = \"127.0.0.1\"\nport = 0\n" + more);
    process_.emplace(folder_, std::vector<std::string>{"run", "--config", configuration});
    const std::optional<std::string> port = process_->wait_for(" port=", patience);
    ASSERT_TRUE(port) << process_->errors();
    port_ = static_cast<std::uint16_t>(std::stoi(*port));
  }

  Result<ModbusClient> connect() const { return ModbusClient::connect("127.0.0.1", port_, BlockFormat{}); }

  TemporaryFolder folder_;
  std::optional<GraspdProcess> process_;
  std::uint16_t port_ = 0;
};

TEST_F(Daemon, PicksOnATriggerAndStopsOnASignal) {
  start();
  Result<ModbusClient> client = connect();
  ASSERT_TRUE(client.ok()) << client.status().message();
  ClientRequest request;
  request.request_id = 4711;
  request.part = 7;
  const Result<ResultBlock> block = client.value().request_pick(request, patience);
  ASSERT_TRUE(block.ok()) << block.status().message() << process_->errors();
  EXPECT_EQ(block.value().code, ResultCode::ok);
  EXPECT_TRUE(block.value().verified);
  EXPECT_EQ(block.value().request_id, 4711);
  EXPECT_EQ(block.value().instances_found, 2);
  float nearest = 1e9F;
  for (const RigidTransform& pose : angle_bar_scene().poses) {
    nearest = std::min(nearest, (pose.translation - block.value().part_pose.translation).norm());
  }
  EXPECT_LT(nearest, 0.001F);
  EXPECT_TRUE(process_->wait_for("code=I010 pick 1 of part 7", patience)) << process_->errors();

  request.part = 8;
  const Result<ResultBlock> unknown = client.value().request_pick(request, patience);
  ASSERT_TRUE(unknown.ok()) << unknown.status().message();
  EXPECT_EQ(unknown.value().code, ResultCode::bad_request);
  EXPECT_TRUE(process_->wait_for("code=E012 no pick: no bank of part number 8 is loaded", patience));

  process_->terminate();
  EXPECT_EQ(process_->wait(), 0);
  EXPECT_THAT(process_->errors(), HasSubstr("code=N002 stopped"));
}

TEST_F(Daemon, RefusesACameraTimeoutThatTheWatchdogDoesNotBear) {
  const std::string configuration =
      folder_.write("graspd.toml", "banks = [\"bar.bank\"]\n[camera]\nsource = \"genicam\"\ntimeout = 1.6\n");
  setenv("WATCHDOG_USEC", "3000000", 1);
  const GraspdOutcome outcome = run_graspd(folder_, {"run", "--config", configuration});
  unsetenv("WATCHDOG_USEC");
  EXPECT_EQ(outcome.exit_code, static_cast<int>(StatusCode::bad_configuration));
  EXPECT_THAT(outcome.errors, HasSubstr("camera.timeout is 1.6 s, but the service's WatchdogSec 3.0 s"));
}

TEST_F(Daemon, LeavesAPictureOfTheLatestAnswer) {
  start("[output]\npicture = \"latest.png\"\n");
  Result<ModbusClient> client = connect();
  ASSERT_TRUE(client.ok()) << client.status().message();
  ASSERT_TRUE(client.value().request_pick({}, patience).ok());
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!std::filesystem::exists(folder_.path("latest.png")) && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_GT(std::filesystem::file_size(folder_.path("latest.png")), 1000U);
  process_->terminate();
  EXPECT_EQ(process_->wait(), 0) << process_->errors();
}

TEST_F(Daemon, GoesOnWithItsBankWhenTheFileIsWrittenOver) {
  start();
  Result<ModbusClient> client = connect();
  ASSERT_TRUE(client.ok()) << client.status().message();
  std::filesystem::resize_file(folder_.path("bar.bank"), 0);
  const Result<ResultBlock> block = client.value().request_pick({}, patience);
  ASSERT_TRUE(block.ok()) << block.status().message() << process_->errors();
  EXPECT_EQ(block.value().code, ResultCode::ok);
  process_->terminate();
  EXPECT_EQ(process_->wait(), 0) << process_->errors();
}

TEST_F(Daemon, KeepsTheFramesThatThePlcAsksFor) {
  start("[output]\nsnapshots = \"kept\"\nsnapshots_kept = 2\n");
  Result<ModbusClient> client = connect();
  ASSERT_TRUE(client.ok()) << client.status().message();
  ClientRequest request;
  for (request.request_id = 1; request.request_id <= 4; ++request.request_id) {
    request.options = request.request_id == 2 ? std::uint16_t{0} : request_option::save_snapshot;
    const Result<ResultBlock> block = client.value().request_pick(request, patience);
    ASSERT_TRUE(block.ok()) << block.status().message();
    EXPECT_EQ(block.value().code, ResultCode::ok);
    if (request.options == 0) continue;
    const std::string kept = "code=N015 snapshot kept request_id=" + std::to_string(request.request_id);
    ASSERT_TRUE(process_->wait_for(kept, patience)) << process_->errors();
  }
  process_->terminate();
  EXPECT_EQ(process_->wait(), 0) << process_->errors();
  std::vector<std::filesystem::path> folders;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path("kept"))) folders.push_back(entry.path());
  std::ranges::sort(folders);
  ASSERT_EQ(folders.size(), 2U) << "of three the oldest gave way";
  EXPECT_THAT(folders[0].string(), testing::EndsWith("_request_3"));
  EXPECT_THAT(folders[1].string(), testing::EndsWith("_request_4"));
  const Result<LoadedFrame> frame = load_frame(folders[0] / "depth.png", {});
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_EQ(frame.value().camera.width, angle_bar_scene().camera.width);
}

TEST_F(Daemon, PollsAPlcThatIsAServer) {
  PlcStandIn plc;
  plc.set_register(request_register::request_id, 815);
  start("[modbus.client]\naddress = \"127.0.0.1\"\nport = " + std::to_string(plc.port()) + "\n", "client");
  const auto comes = [&](std::uint16_t input) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!plc.has(input) && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return plc.has(input);
  };
  ASSERT_TRUE(comes(discrete_input::ready)) << process_->errors();
  plc.set_coil(coil::trigger, true);
  ASSERT_TRUE(comes(discrete_input::done)) << process_->errors();
  EXPECT_TRUE(plc.has(discrete_input::result_valid));
  const Result<ResultBlock> block = decode(plc.results(0, block::count), {});
  ASSERT_TRUE(block.ok()) << block.status().message();
  EXPECT_EQ(block.value().code, ResultCode::ok);
  EXPECT_EQ(block.value().request_id, 815);
  EXPECT_EQ(block.value().instances_found, 2);
  process_->terminate();
  EXPECT_EQ(process_->wait(), 0) << process_->errors();
}

}  // namespace
}  // namespace graspd
