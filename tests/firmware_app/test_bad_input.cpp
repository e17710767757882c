#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "drivers/files/atomic_file.hpp"
#include "drivers/files/picture.hpp"
#include "tests/drivers/plc/loopback_listener.hpp"
#include "tests/firmware_app/graspd_process.hpp"
#include "tests/firmware_app/pick_cycle_fixture.hpp"

namespace graspd {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// Everything that can be wrong is tried on the built binary, as a user would meet it.
class BadInput : public testing::Test {
 protected:
  void SetUp() override {
    bank_ = folder_.path("bar.bank");
    ASSERT_TRUE(write_file(bank_, shared_angle_bar_bank()).ok());
    scene_ = write_bop_scene(folder_.path("data"), angle_bar_scene());
    frame_ = (scene_ / "depth" / "000000.png").string();
  }

  /// Runs graspd and expects this exit code, and one line on stderr that holds every one of `words`.
  void expect_refusal(const std::vector<std::string>& arguments, int exit_code, const std::vector<std::string>& words) {
    const GraspdOutcome outcome = run_graspd(folder_, arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.errors;
    EXPECT_THAT(outcome.errors, StartsWith("graspd: "));
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
    for (const std::string& word : words) EXPECT_THAT(outcome.errors, HasSubstr(word));
  }

  std::string configuration(const std::string& more) {
    return folder_.write("graspd.toml", "banks = [\"bar.bank\"]\n[camera]\nsource = \"recorded\"\npath = \"" +
                                            scene_.string() + "\"\n" + more);
  }

  void expect_bank_refused(const std::vector<std::byte>& bytes, const std::string& word) {
    const std::string damaged = folder_.path("damaged.bank");
    ASSERT_TRUE(write_file(damaged, bytes).ok());
    expect_refusal({"bank", "show", damaged}, 5, {"damaged.bank", word});
  }

  TemporaryFolder folder_;
  std::string bank_;
  std::filesystem::path scene_;
  std::string frame_;
};

TEST_F(BadInput, CommandLine) {
  expect_refusal({}, 2, {"subcommand", "--help"});
  expect_refusal({"detct"}, 2, {"detct", "did you mean detect?"});
  expect_refusal({"bank", "shw"}, 2, {"no subcommand bank shw", "did you mean bank show?"});
  expect_refusal({"bank"}, 2, {"see graspd bank --help"});
  expect_refusal({"detect", frame_}, 2, {"--bank"});
  expect_refusal({"detect", frame_, "--bank", bank_, "--thread", "1"}, 2, {"--thread"});
  expect_refusal({"detect", frame_, "--bank", bank_, "--minimum-score", "7"}, 2, {"--minimum-score"});
  expect_refusal({"bank", "compile", "-o", "x.bank"}, 2, {"part file"});
}

TEST_F(BadInput, Cameras) {
  expect_refusal({"camera"}, 2, {"subcommand"});
  expect_refusal({"camera", "grab"}, 2, {"--output"});
  expect_refusal({"camera", "show", "--device", "a", "--config", "b"}, 2, {"--device", "--config"});
  expect_refusal({"camera", "show", "--config", folder_.path("none.toml")}, 3, {"none.toml", "No such file"});
  expect_refusal({"simulate"}, 2, {"FRAMES", "--parts"});
  expect_refusal({"simulate", scene_.string(), "--parts", bank_}, 2, {"FRAMES", "--parts"});
  expect_refusal({"simulate", scene_.string(), "--scenes", "3"}, 2, {"--scenes", "--parts"});
  expect_refusal({"simulate", "--parts", bank_, "--strain", "much"}, 2, {"--strain", "medium"});
  expect_refusal({"simulate", "--parts", folder_.path("none.ply")}, 4, {"none.ply"});
  expect_refusal({"simulate", "--parts", folder_.path("none.toml")}, 3, {"none.toml"});
  expect_refusal({"simulate", "--parts", folder_.path("none.bank")}, 5, {"none.bank"});
  expect_refusal({"simulate", folder_.path("none")}, 4, {"none", "No such file"});
  expect_refusal({"simulate", bank_}, 4, {"bar.bank", "not a kind of frame"});
  expect_refusal({"simulate", scene_.string(), "--format", "RGB8"}, 2, {"--format", "Coord3D_C32f"});
  expect_refusal({"simulate", scene_.string(), "--address", "here"}, 2, {"here", "--address"});
  // An address for documentation, which no machine has.
  expect_refusal({"simulate", scene_.string(), "--address", "192.0.2.7"}, 8, {"192.0.2.7", "cannot listen"});
}

TEST_F(BadInput, Bench) {
  expect_refusal({"bench", "--bank", bank_}, 2, {"FRAMES"});
  expect_refusal({"bench", frame_}, 2, {"--bank"});
  expect_refusal({"bench", frame_, "--bank", bank_, "--detections", "0"}, 2, {"--detections"});
  expect_refusal({"bench", folder_.path("none"), "--bank", bank_}, 4, {"none", "No such file"});
  expect_refusal({"bench", frame_, "--bank", folder_.path("none.bank")}, 5, {"none.bank"});
}

TEST_F(BadInput, CameraKeys) {
  const auto refused = [this](const std::string& keys, const std::string& words) {
    const std::string file =
        folder_.write("graspd.toml", "banks = [\"bar.bank\"]\n[camera]\nsource = \"genicam\"\n" + keys + "\n");
    expect_refusal({"check", "--config", file}, 3, {"graspd.toml:", words});
  };
  refused("device = \"\"", "camera.device must be a serial number");
  refused("trigger = \"sometimes\"", "camera.trigger must be one of \"software\"");
  refused("timeout = -1", "camera.timeout");
  refused("packet_size = 5", "camera.packet_size");
  refused("focal_length = [0.0, 1.0]", "camera.focal_length must hold two positive numbers");
  refused("scale = \"x\"", "camera.scale");
  refused("[camera.features]\nExposureTime = [1]", "camera.features.ExposureTime must be a number");
}

TEST_F(BadInput, Recording) {
  const std::string place = folder_.path("bar.bank") + "/records";
  expect_refusal({"record", "-o", place, "--config", folder_.path("none.toml")}, 3, {"none.toml"});
  expect_refusal({"record", "--config", configuration("")}, 2, {"--output"});
  expect_refusal({"check", "--config", configuration("[record]\nwhen = \"now\"\n")}, 3, {"record.when"});
  expect_refusal({"check", "--config", configuration("[record]\nmaximum_frames = 0\n")}, 3, {"record.maximum_frames"});
}

TEST_F(BadInput, ConfigurationMissing) {
  expect_refusal({"check", "--config", folder_.path("none.toml")}, 3, {"none.toml", "No such file"});
  expect_refusal({"run", "--config", folder_.path("none.toml")}, 3, {"none.toml", "No such file"});
}

TEST_F(BadInput, ConfigurationMalformed) {
  expect_refusal({"check", "--config", configuration("[modbus\n")}, 3, {"graspd.toml:5: not valid TOML"});
  expect_refusal({"check", "--config", configuration("[modbus]\nport = \"x\"\n")}, 3,
                 {"graspd.toml:6: modbus.port must be a whole number"});
}

TEST_F(BadInput, ConfigurationUnknownKey) {
  expect_refusal({"check", "--config", configuration("[modbus]\nprot = 502\n")}, 3,
                 {"graspd.toml:6: unknown key modbus.prot; did you mean modbus.port?"});
}

TEST_F(BadInput, PartFile) {
  expect_refusal({"bank", "compile", folder_.path("none.toml"), "-o", folder_.path("x.bank")}, 3, {"none.toml"});
  const std::string part = folder_.write("part.toml", "name = \"a\"\nid = 1\nmesh = \"a.stl\"\nunit = \"mm\"\n");
  expect_refusal({"bank", "compile", part, "-o", folder_.path("x.bank")}, 3,
                 {"part.toml:4: unknown key unit; did you mean units?"});
}

TEST_F(BadInput, BankMissing) {
  expect_refusal({"bank", "show", folder_.path("none.bank")}, 5, {"none.bank", "No such file"});
  expect_refusal({"detect", frame_, "--bank", folder_.path("none.bank")}, 5, {"none.bank"});
  expect_refusal({"bank", "show", folder_.path("")}, 5, {folder_.path("")});
}

TEST_F(BadInput, BankTruncated) {
  std::vector<std::byte> bytes = shared_angle_bar_bank();
  bytes.resize(bytes.size() / 2);
  expect_bank_refused(bytes, "truncated");
  bytes.resize(20);
  expect_bank_refused(bytes, "truncated");
}

TEST_F(BadInput, BankBitFlipped) {
  std::vector<std::byte> bytes = shared_angle_bar_bank();
  bytes[bytes.size() * 2 / 3] ^= std::byte{0x10};
  expect_bank_refused(bytes, "checksum");
}

TEST_F(BadInput, BankOfForeignVersionOrKind) {
  std::vector<std::byte> bytes = shared_angle_bar_bank();
  // The version stands behind the eight letters of the magic word and the byte order mark.
  bytes[12] = std::byte{0x7F};
  expect_bank_refused(bytes, "version");
  bytes = shared_angle_bar_bank();
  bytes[0] = std::byte{'X'};
  expect_bank_refused(bytes, "not a graspd bank");
}

TEST_F(BadInput, TwoBanksOfOnePart) {
  const std::string copy = folder_.path("copy.bank");
  ASSERT_TRUE(write_file(copy, shared_angle_bar_bank()).ok());
  expect_refusal({"detect", frame_, "--bank", bank_, copy}, 5, {"copy.bank", "part number 7", "bar.bank"});
}

TEST_F(BadInput, Mesh) {
  const auto compile = [&](const std::string& mesh, const std::string& word) {
    const std::string part = folder_.write("part.toml", "name = \"a\"\nid = 1\nmesh = \"" + mesh + "\"\n");
    expect_refusal({"bank", "compile", part, "-o", folder_.path("x.bank")}, 4, {mesh, word});
    EXPECT_FALSE(std::filesystem::exists(folder_.path("x.bank")));
  };
  static_cast<void>(folder_.write("faceless.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"));
  compile("faceless.obj", "face");
  static_cast<void>(folder_.write("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"));
  compile("nan.obj", ":2");
  compile("none.stl", "No such file");
}

TEST_F(BadInput, DepthImageOfTheWrongSizeOrDepth) {
  const std::string camera =
      folder_.write("camera.json", R"({"fx": 400, "fy": 400, "cx": 160, "cy": 120, "width": 640, "height": 480})");
  expect_refusal({"detect", frame_, "--bank", bank_, "--camera", camera}, 12, {"320", "640"});
  const std::string picture = folder_.path("eight_bit.png");
  ASSERT_TRUE(write_picture(picture, Picture(320, 240, {})).ok());
  expect_refusal({"detect", picture, "--bank", bank_, "--camera", camera}, 4, {"eight_bit.png", "16"});
}

TEST_F(BadInput, SceneCameraWithoutIntrinsics) {
  static_cast<void>(std::ofstream(scene_ / "scene_camera.json") << R"({"0": {"depth_scale": 0.1}})");
  expect_refusal({"detect", frame_, "--bank", bank_}, 4, {"scene_camera.json", "cam_K"});
}

TEST_F(BadInput, FrameThatIsAllInvalid) {
  RenderedScene blind = angle_bar_scene();
  std::fill(blind.depth.begin(), blind.depth.end(), 0.0F);
  write_bop_scene(folder_.path("data"), blind);
  expect_refusal({"detect", frame_, "--bank", bank_}, 12, {"000000.png"});
}

TEST_F(BadInput, PortInUse) {
  const LoopbackListener listener;
  const std::string port = std::to_string(listener.port());
  expect_refusal({"run", "--config",
                  configuration("[modbus]\naddress = \"127.0.0.1\"\nport = " + port + "\n[memory]\nlock = false\n")},
                 8, {"127.0.0.1", port});
}

TEST_F(BadInput, BudgetTooSmall) {
  const std::string file = configuration("[memory]\nbudget = \"3 MiB\"\nlock = false\n");
  expect_refusal({"check", "--config", file}, 7, {"graspd.toml", "memory.budget is 3.0 MiB", "are needed"});
  expect_refusal({"run", "--config", file}, 7, {"memory.budget is 3.0 MiB"});
}

TEST_F(BadInput, OutputThatCannotBeWritten) {
  // Below a regular file nobody can write, not even root.
  const std::string place = bank_ + "/below";
  const std::string part = folder_.write("part.toml", "name = \"a\"\nid = 1\nmesh = \"bar.stl\"\n");
  write_angle_bar_stl(folder_.path("bar.stl"));
  expect_refusal({"bank", "compile", part, "-o", place}, 6, {place});
  expect_refusal({"detect", frame_, "--bank", bank_, "--picture", place}, 6, {place});
  expect_refusal({"detect", frame_, "--bank", bank_, "--json", place}, 6, {place});
  expect_refusal({"bench", frame_, "--bank", bank_, "--picture", place}, 6, {place});
  expect_refusal({"bench", frame_, "--bank", bank_, "--json", place}, 6, {place});
  expect_refusal({"bank", "show", bank_, "--picture", place}, 6, {place});
  expect_refusal({"run", "--config", configuration("[output]\npicture = \"" + place + "\"\n[memory]\nlock = false\n")},
                 6, {place});
  expect_refusal({"validate", "--bop", folder_.path("data"), "--banks", folder_.path(""), "-o", place}, 6, {place});
}

TEST_F(BadInput, DataSet) {
  expect_refusal({"validate", "--bop", folder_.path("data"), "--banks", folder_.path(""), "-o", folder_.path("r.csv")},
                 4, {"test_targets_bop19.json"});
  expect_refusal({"bank", "compile", "--bop", folder_.path("data"), "-o", folder_.path("banks")}, 4,
                 {"models_info.json"});
}

TEST_F(BadInput, OnePictureForManyBanks) {
  expect_refusal({"bank", "compile", "--bop", folder_.path("data"), "-o", folder_.path("banks"), "--picture", "a.png"},
                 2, {"--bop", "--picture"});
  expect_refusal({"bank", "learn", "--bop", folder_.path("data"), "--frames", scene_.string(), "-o",
                  folder_.path("banks"), "--picture", "a.png"},
                 2, {"--bop", "--picture"});
}

TEST_F(BadInput, OutputThatDoesNotReachItsReaderIsAFailure) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "the system has no /dev/full";
  const std::string errors = folder_.path("errors.txt");
  const std::string command = std::string(GRASPD_BINARY) + " bank show " + bank_ + " >/dev/full 2>" + errors;
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 6);
  std::ifstream file(errors);
  std::string line;
  std::getline(file, line);
  EXPECT_THAT(line, HasSubstr("graspd: standard output took only a part"));
}

}  // namespace
}  // namespace graspd
