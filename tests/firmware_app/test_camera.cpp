#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <string>

#include "drivers/files/bop_dataset.hpp"
#include "tests/firmware_app/camera_and_daemon.hpp"

namespace graspd {
namespace {

using testing::HasSubstr;

/// The built binary as a camera, as its client, and as both.
class CameraCommands : public CameraAndDaemon {};

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

TEST_F(CameraCommands, RecordsForReplayWhatCameOverTheWire) {
  switch_camera_on({"--format", "Coord3D_ABC16"});
  start_daemon_on_camera("[record]\nfolder = \"records\"\nwhen = \"always\"\n");
  ASSERT_TRUE(daemon_->wait_for("code=N203", patience)) << daemon_->errors();
  EXPECT_EQ(ask().code, ResultCode::ok);
  ASSERT_TRUE(daemon_->wait_for("code=I017 recorded ", patience)) << daemon_->errors();
  const std::filesystem::path recording = folder_.path("records/recorded/000001");
  const TemporaryFolder client;
  const GraspdOutcome replay =
      run_graspd(client, {"detect", (recording / "depth" / "000000.tiff").string(), "--bank", folder_.path("bar.bank"),
                          "--config", folder_.path("graspd.toml"), "--rejected", "--replayable", "--json", "-"});
  EXPECT_EQ(replay.exit_code, 0) << replay.errors;
  std::ifstream file(recording / "detections.json");
  EXPECT_EQ(replay.output, std::string(std::istreambuf_iterator<char>(file), {}));
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

  const GraspdOutcome list = run_graspd(client, {"camera", "list"});
  EXPECT_EQ(list.exit_code, 0) << list.errors;
  EXPECT_THAT(list.output, testing::ContainsRegex("BAR1 +127\\.0\\.0\\.1 +graspd +Simulated3DCamera"));
  for (const char* name : {"BAR1", "first"}) {
    EXPECT_EQ(run_graspd(client, {"camera", "show", "--device", name}).output, show.output) << name;
  }
  const GraspdOutcome stranger = run_graspd(client, {"camera", "show", "--device", "BAR2"});
  EXPECT_EQ(stranger.exit_code, 10);
  EXPECT_THAT(stranger.errors, HasSubstr("no camera with serial number BAR2"));

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

TEST_F(CameraCommands, StreamsToAClientThatIsNotOurs) {
  if (std::system("arv-camera-test-0.8 --help > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "arv-camera-test is not installed";
  switch_camera_on();
  const std::string output = folder_.path("arv.txt");
  EXPECT_EQ(std::system(("arv-camera-test-0.8 --duration=2 > " + output + " 2>&1").c_str()), 0);
  std::ifstream file(output);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  EXPECT_THAT(text, testing::ContainsRegex("n_completed_buffers +=.*[1-9]"));
  EXPECT_THAT(text, testing::ContainsRegex("n_failures +=.* 0\n"));
}

}  // namespace
}  // namespace graspd
