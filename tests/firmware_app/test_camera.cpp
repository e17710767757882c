#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <string>

#include "drivers/files/atomic_file.hpp"
#include "drivers/files/bop_dataset.hpp"
#include "drivers/plc/modbus_client.hpp"
#include "tests/drivers/camera/private_network.hpp"
#include "tests/firmware_app/graspd_process.hpp"
#include "tests/firmware_app/pick_cycle_fixture.hpp"

namespace graspd {
namespace {

using testing::HasSubstr;

constexpr std::chrono::seconds patience{60};

/// The built binary as a camera, as its client, and as both.
class CameraCommands : public testing::Test {
 protected:
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

  ResultBlock ask() const {
    Result<ModbusClient> client = ModbusClient::connect("127.0.0.1", port_, BlockFormat{});
    EXPECT_TRUE(client.ok()) << client.status().message();
    if (!client.ok()) return {};
    const Result<ResultBlock> block = client.value().request_pick({}, patience);
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

TEST_F(CameraCommands, PicksOverTheWireEqualThoseFromFiles) {
  start_daemon("source = \"recorded\"\npath = \"" + scene_.string() + "\"");
  const ResultBlock expected = ask();
  EXPECT_EQ(expected.code, ResultCode::ok);
  daemon_.reset();
  for (const char* format : {"Coord3D_C16", "Coord3D_ABC32f"}) {
    switch_camera_on({"--format", format});
    start_daemon_on_camera();
    ASSERT_TRUE(daemon_->wait_for("code=N203", patience)) << daemon_->errors();
    const ResultBlock block = ask();
    EXPECT_EQ(block.code, ResultCode::ok);
    EXPECT_EQ(block.instances_found, expected.instances_found);
    EXPECT_EQ(block.score, expected.score);
    EXPECT_EQ(block.pick.translation, expected.pick.translation);
    EXPECT_EQ(block.pick.rotation, expected.pick.rotation);
    EXPECT_EQ(block.part_pose.translation, expected.part_pose.translation);
    daemon_->terminate();
    EXPECT_EQ(daemon_->wait(), 0) << daemon_->errors();
    daemon_.reset();
    camera_.reset();
  }
}

TEST_F(CameraCommands, DaemonOutlivesItsCamera) {
  start_daemon_on_camera();
  EXPECT_EQ(ask().code, ResultCode::camera_lost) << "there is none yet";
  switch_camera_on();
  ASSERT_TRUE(daemon_->wait_for("code=N203", patience)) << daemon_->errors();
  EXPECT_EQ(ask().code, ResultCode::ok);
  camera_.reset();  // Killed.
  EXPECT_EQ(ask().code, ResultCode::camera_lost);
  switch_camera_on();
  ResultCode code = ResultCode::camera_lost;
  for (int i = 0; i < 30 && code != ResultCode::ok; ++i) {
    code = ask().code;
    EXPECT_TRUE(code == ResultCode::ok || code == ResultCode::camera_lost) << result_code_name(code);
  }
  EXPECT_EQ(code, ResultCode::ok);
  daemon_->terminate();
  EXPECT_EQ(daemon_->wait(), 0) << daemon_->errors();
}

TEST_F(CameraCommands, ShowsAndSavesWhatTheCameraSends) {
  switch_camera_on();
  const TemporaryFolder client;
  const GraspdOutcome show = run_graspd(client, {"camera", "show", "--device", "127.0.0.1"});
  EXPECT_EQ(show.exit_code, 0) << show.errors;
  EXPECT_THAT(show.output, HasSubstr("DeviceSerialNumber               BAR1\n"));
  EXPECT_THAT(show.output, HasSubstr("Scan3dFocalLength                400\n"));
  EXPECT_THAT(show.output, HasSubstr("Mono16, Coord3D_C16, Coord3D_C32f, Coord3D_ABC16, Coord3D_ABC32f"));

  const std::string saved = client.path("saved");
  const GraspdOutcome grab = run_graspd(client, {"camera", "grab", "--device", "127.0.0.1", "-o", saved});
  EXPECT_EQ(grab.exit_code, 0) << grab.errors;
  const Result<BopScene> original_scene = read_bop_scene(scene_);
  const Result<BopScene> saved_scene = read_bop_scene(saved);
  ASSERT_TRUE(original_scene.ok() && saved_scene.ok());
  const Result<LoadedFrame> original = load_bop_frame(original_scene.value(), 0);
  const Result<LoadedFrame> back = load_bop_frame(saved_scene.value(), 0);
  ASSERT_TRUE(original.ok() && back.ok());
  EXPECT_EQ(original.value().depth, back.value().depth);
  EXPECT_EQ(original.value().camera.fx, back.value().camera.fx);
  EXPECT_EQ(original.value().camera.cy, back.value().camera.cy);

  camera_.reset();
  const GraspdOutcome gone = run_graspd(client, {"camera", "show", "--device", "127.0.0.1"});
  EXPECT_EQ(gone.exit_code, 10);
  EXPECT_THAT(gone.errors, HasSubstr("graspd: camera 127.0.0.1"));
}

TEST_F(CameraCommands, ObeysAClientThatIsNotOurs) {
  if (std::system("arv-tool-0.8 --help > /dev/null 2>&1") != 0) GTEST_SKIP() << "arv-tool-0.8 is not installed";
  switch_camera_on({"--format", "Coord3D_ABC16"});
  const std::string output = folder_.path("arv.txt");
  const std::string command =
      "arv-tool-0.8 -a 127.0.0.1 control PixelFormat Width Scan3dFocalLength ExposureTime=1234 > " + output + " 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::ifstream file(output);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  EXPECT_THAT(text, HasSubstr("PixelFormat = Coord3D_ABC16"));
  EXPECT_THAT(text, HasSubstr("Width = 320"));
  EXPECT_THAT(text, HasSubstr("Scan3dFocalLength = 400"));
  EXPECT_THAT(text, HasSubstr("ExposureTime = 1234"));
}

}  // namespace
}  // namespace graspd
