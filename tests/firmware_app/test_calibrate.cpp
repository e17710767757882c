#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "drivers/files/atomic_file.hpp"
#include "firmware_app/calibration_file.hpp"
#include "tests/firmware_app/graspd_process.hpp"
#include "tests/firmware_app/shared_bank.hpp"
#include "tests/firmware_app/temporary_folder.hpp"

namespace graspd {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

class CalibrationText : public testing::Test {
 protected:
  std::string complaint(const std::string& text) {
    const Result<CalibrationFile> result = read_calibration_file(folder_.write("pairs.toml", text));
    if (result.ok()) return "(accepted)";
    EXPECT_EQ(result.status().code(), StatusCode::bad_configuration);
    const std::string message(result.status().message());
    return message.substr(std::min(message.size(), folder_.path("").size()));
  }
  TemporaryFolder folder_;
};

std::string pair(const std::string& flange, const std::string& target) {
  return "[[pair]]\nrobot_from_flange = [" + flange + "]\ncamera_from_target = [" + target + "]\n";
}

TEST_F(CalibrationText, PosesMayBeWrittenInThreeWays) {
  const std::string matrix = "0, -1, 0, 100, 1, 0, 0, 200, 0, 0, 1, 300, 0, 0, 0, 1";
  const std::string quaternion = "100, 200, 300, 0, 0, 0.70710678, 0.70710678";
  const Result<CalibrationFile> result = read_calibration_file(folder_.write(
      "pairs.toml", "setup = \"eye_in_hand\"\norientation = \"zyx_euler\"\n" + pair("100, 200, 300, 90, 0, 0", matrix) +
                        pair(quaternion, quaternion) + pair(matrix, "100, 200, 300, 90, 0, 0")));
  ASSERT_TRUE(result.ok()) << result.status().message();
  ASSERT_EQ(result.value().pairs.size(), 3U);
  EXPECT_EQ(result.value().setup, HandEyeSetup::eye_in_hand);
  const Eigen::Isometry3d& first = result.value().pairs[0].robot_from_flange;
  EXPECT_TRUE((first * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(0.1, 1.2, 0.3), 1e-6));
  for (const HandEyePair& each : result.value().pairs) {
    EXPECT_TRUE(each.robot_from_flange.isApprox(first, 1e-6));
    EXPECT_TRUE(each.camera_from_target.isApprox(first, 1e-6));
  }
}

TEST_F(CalibrationText, WhatIsWrongIsNamedWithItsLine) {
  const std::string fine = pair("0, 0, 0, 0, 0, 0", "0, 0, 500, 0, 0, 0");
  EXPECT_THAT(complaint(fine), StartsWith("pairs.toml:1: setup is missing: say where the camera is"));
  EXPECT_EQ(complaint("setup = \"eye_in_hand\"\n" + fine + fine),
            "pairs.toml: has 2 [[pair]], but must have between 3 and 1000");
  EXPECT_THAT(complaint("setup = \"hand\"\n" + fine),
              HasSubstr("pairs.toml:1: setup must be one of \"eye_in_hand\", \"eye_to_hand\", but is \"hand\""));
  EXPECT_THAT(complaint("setup = \"eye_in_hand\"\n[[pair]]\nrobot_from_flange = [0, 0, 0, 0, 0, 0]\n"),
              StartsWith("pairs.toml:2: pair.camera_from_target is missing"));
  EXPECT_EQ(complaint("setup = \"eye_in_hand\"\n" + pair("0, 0, 0", "0, 0, 500, 0, 0, 0")),
            "pairs.toml:3: pair.robot_from_flange must be a list of 16 numbers, but has 3");
  EXPECT_THAT(complaint("setup = \"eye_in_hand\"\n" + pair("0, 0, 0, 1, 1, 0, 0", "0, 0, 500, 0, 0, 0")),
              EndsWith("must hold a quaternion (x, y, z, w) of length 1"));
  EXPECT_THAT(complaint("setup = \"eye_in_hand\"\n" + pair("0, 0, 0, nan, 0, 0", "0, 0, 500, 0, 0, 0")),
              HasSubstr("pairs.toml:3: pair.robot_from_flange must be a list of 6 numbers"));
  EXPECT_EQ(complaint("setup = \"eye_in_hand\"\n" + fine + "camera_from_part = [1]\n"),
            "pairs.toml:5: unknown key pair.camera_from_part; did you mean pair.camera_from_target?");
}

TEST(Calibrate, ExampleGivesBackTheCameraItWasMadeWith) {
  TemporaryFolder folder;
  const GraspdOutcome outcome =
      run_graspd(folder, {"calibrate", std::string(GRASPD_SOURCE_DIR) + "/configs/calibration.toml"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("rms"));
  EXPECT_THAT(outcome.output, testing::Not(HasSubstr("warning")));
  const std::size_t start = outcome.output.find("robot_from_camera = [");
  ASSERT_NE(start, std::string::npos) << outcome.output;
  std::array<double, 3> place{};
  ASSERT_EQ(std::sscanf(outcome.output.c_str() + start, "robot_from_camera = [%lf, %lf, %lf,", &place[0], &place[1],
                        &place[2]),
            3);
  EXPECT_NEAR(place[0], 400.0, 3.0);
  EXPECT_NEAR(place[1], 0.0, 3.0);
  EXPECT_NEAR(place[2], 900.0, 3.0);
}

TEST(Calibrate, SaysWhatTheMotionsLeaveOpen) {
  TemporaryFolder folder;
  std::string text = "setup = \"eye_in_hand\"\n";
  for (const char* turn : {"0", "20", "40", "60", "80"}) {
    text += pair(std::string("0, 0, 500, 0, 0, ") + turn, std::string("0, 0, 500, 0, 0, -") + turn);
  }
  const GraspdOutcome outcome = run_graspd(folder, {"calibrate", folder.write("pairs.toml", text)});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("warning: all turns are about one axis"));
}

TEST(Calibrate, TakesThePosesThatDetectPrints) {
  TemporaryFolder folder;
  ASSERT_TRUE(write_file(folder.path("bar.bank"), shared_angle_bar_bank()).ok());
  const RenderedScene scene = angle_bar_scene();
  const std::filesystem::path frame = write_bop_scene(folder.path("data"), scene) / "depth" / "000000.png";
  const GraspdOutcome outcome =
      run_graspd(folder, {"detect", frame.string(), "--bank", folder.path("bar.bank"), "--json", "-"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  std::string pairs = "setup = \"eye_to_hand\"\n";
  const nlohmann::json instances = nlohmann::json::parse(outcome.output)["instances"];
  ASSERT_EQ(instances.size(), scene.poses.size());
  for (const nlohmann::json& instance : instances) {
    const std::string pose = instance["camera_from_part"].dump();
    pairs += pair("0, 0, 0, 0, 0, 0", pose.substr(1, pose.size() - 2));
  }
  pairs += pair("0, 0, 0, 0, 0, 0", "0, 0, 0, 0, 0, 0");
  const Result<CalibrationFile> read = read_calibration_file(folder.write("pairs.toml", pairs));
  ASSERT_TRUE(read.ok()) << read.status().message();
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const Eigen::Isometry3d& seen = read.value().pairs[i].camera_from_target;
    EXPECT_TRUE(std::any_of(scene.poses.begin(), scene.poses.end(), [&](const RigidTransform& truth) {
      return (seen.translation().cast<float>() - truth.translation).norm() < 0.002F &&
             rotation_angle(truth.rotation.transpose() * seen.linear().cast<float>()) < 0.03F;
    })) << seen.matrix();
  }
}

TEST(Calibrate, MissingFileIsOneLine) {
  TemporaryFolder folder;
  const GraspdOutcome outcome = run_graspd(folder, {"calibrate", folder.path("none.toml")});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.errors, HasSubstr("none.toml"));
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1);
}

}  // namespace
}  // namespace graspd
