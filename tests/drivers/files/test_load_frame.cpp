#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/files/load_frame.hpp"
#include "tests/drivers/files/bop_scene.hpp"

namespace graspd {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class LoadFrame : public ::testing::Test {
 protected:
  static std::string refusal(const fs::path& path, const FrameFileOptions& options = {},
                             StatusCode code = StatusCode::bad_file) {
    const Result<LoadedFrame> frame = load_frame(path, options);
    EXPECT_EQ(frame.status().code(), code);
    return std::string(frame.status().message());
  }

  BopFolder folder_;
};

constexpr const char* camera_json =
    R"({"fx": 600, "fy": 601, "cx": 4, "cy": 3, "width": 8, "height": 6, "depth_scale": 0.2})";

TEST_F(LoadFrame, ImageInABopSceneNeedsNoCameraFile) {
  const Result<LoadedFrame> frame = load_frame(folder_.scene() / "depth" / "000007.png", {});
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_FLOAT_EQ(frame.value().camera.fx, 500.0F);
  EXPECT_FLOAT_EQ(frame.value().depth[1], 0.7F);
  EXPECT_FLOAT_EQ(frame.value().empty_depth[1], 0.8F);
  EXPECT_THAT(frame.value().name, HasSubstr("000007.png"));
}

TEST_F(LoadFrame, CameraFileOverridesTheScene) {
  FrameFileOptions options;
  options.camera_file = folder_.write("mine.json", camera_json);
  options.empty_file = folder_.scene() / "empty" / "000000.png";
  const Result<LoadedFrame> frame = load_frame(folder_.scene() / "depth" / "000007.png", options);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_FLOAT_EQ(frame.value().camera.fx, 600.0F);
  EXPECT_FLOAT_EQ(frame.value().depth[1], 1.4F);
  EXPECT_FLOAT_EQ(frame.value().empty_depth[1], 1.6F);
}

TEST_F(LoadFrame, LooseImageTakesTheCameraFileBesideIt) {
  folder_.write_depth("loose/a.png", 5000);
  EXPECT_THAT(refusal(folder_.root() / "loose" / "a.png"), HasSubstr("a.png: no intrinsics"));
  folder_.write("loose/camera.json", camera_json);
  const Result<LoadedFrame> frame = load_frame(folder_.root() / "loose" / "a.png", {});
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_FLOAT_EQ(frame.value().depth[1], 1.0F);
  EXPECT_TRUE(frame.value().empty_depth.empty());
}

TEST_F(LoadFrame, BadCameraFileNamesTheField) {
  folder_.write_depth("loose/a.png", 5000);
  const fs::path image = folder_.root() / "loose" / "a.png";
  const auto with_camera = [&](const std::string& text, StatusCode code = StatusCode::bad_file) {
    FrameFileOptions options;
    options.camera_file = folder_.write("loose/other.json", text);
    return refusal(image, options, code);
  };
  EXPECT_THAT(with_camera(R"({"fx": 600, "fy": 600, "cx": 4})"), HasSubstr("other.json: no cy"));
  EXPECT_THAT(with_camera(R"({"fx": 0, "fy": 600, "cx": 4, "cy": 3})"), HasSubstr("other.json: fx must be greater"));
  EXPECT_THAT(with_camera(R"({"fx": 6, "fy": 6, "cx": 4, "cy": 3, "width": 8})"), HasSubstr("no height"));
  EXPECT_THAT(with_camera(R"({"fx": 6, "fy": 6, "cx": 4, "cy": 3, "width": 16, "height": 12})", StatusCode::bad_frame),
              HasSubstr("a.png: 8 x 6 pixels, but the camera has 16 x 12"));
  EXPECT_THAT(with_camera(R"({"fx": 6, "fy": 6, "cx": 4, "cy": 3, "depth_scale": -1})"), HasSubstr("depth_scale"));
  EXPECT_THAT(with_camera("{\n\"fx\": 6,\n}"), HasSubstr("other.json:3: not JSON"));
}

TEST_F(LoadFrame, CloudWithUnitsAxesAndEmptyBin) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  FrameFileOptions options;
  options.cloud_axes = CameraAxes::opengl;
  options.empty_file = folder_.write("empty.ply", header + "0 0 -600\n100 0 -600\n");
  const Result<LoadedFrame> frame = load_frame(folder_.write("a.ply", header + "0 0 -500\n100 0 -600\n"), options);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  ASSERT_EQ(frame.value().empty_depth.size(), frame.value().depth.size());
  EXPECT_FLOAT_EQ(*std::max_element(frame.value().depth.begin(), frame.value().depth.end()), 0.6F);
  EXPECT_EQ(std::count(frame.value().empty_depth.begin(), frame.value().empty_depth.end(), 0.6F), 2);
  EXPECT_THAT(refusal(folder_.root() / "a.ply", {}, StatusCode::bad_frame), HasSubstr("a.ply: the cloud lies behind"));
}

TEST_F(LoadFrame, BadFramesAreRefused) {
  EXPECT_THAT(refusal(folder_.root() / "none.png"), HasSubstr("none.png: No such file"));
  EXPECT_THAT(refusal(folder_.write("frame.bin", "x")), HasSubstr("use .png or .tif"));
  folder_.write("loose/camera.json", camera_json);
  folder_.write_depth("loose/dark.png", 0);
  EXPECT_THAT(refusal(folder_.root() / "loose" / "dark.png", {}, StatusCode::bad_frame),
              HasSubstr("dark.png: no pixel is measured"));
}

TEST_F(LoadFrame, AScaleThatPutsTheBinOutOfReachIsRefused) {
  folder_.write_depth("loose/a.png", 5000);
  const fs::path image = folder_.root() / "loose" / "a.png";
  const auto with_scale = [&](const std::string& scale) {
    folder_.write("loose/camera.json", R"({"fx": 6, "fy": 6, "cx": 4, "cy": 3, "depth_scale": )" + scale + "}");
    return refusal(image, {}, StatusCode::bad_frame);
  };
  EXPECT_THAT(with_scale("100"), HasSubstr("a.png: what it shows lies 500 metres away: is depth_scale"));
  EXPECT_THAT(with_scale("0.001"), HasSubstr("a.png: what it shows lies 0.005 metres away"));
}

TEST_F(LoadFrame, EmptyBinThatShowsNothingOrIsOutOfReachIsRefused) {
  FrameFileOptions options;
  options.camera_file = folder_.write("mine.json", camera_json);
  const fs::path image = folder_.scene() / "depth" / "000007.png";
  folder_.write_depth("dark.png", 0);
  options.empty_file = folder_.root() / "dark.png";
  EXPECT_THAT(refusal(image, options, StatusCode::bad_frame), HasSubstr("dark.png: no pixel is measured"));
  folder_.write_depth("near.png", 50);
  options.empty_file = folder_.root() / "near.png";
  EXPECT_THAT(refusal(image, options, StatusCode::bad_frame), HasSubstr("near.png: what it shows lies 0.01 metres"));

  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  options.empty_file = folder_.write("behind.ply", header + "0 0 -600\n100 0 -600\n");
  EXPECT_THAT(refusal(folder_.write("a.ply", header + "0 0 500\n100 0 600\n"), options, StatusCode::bad_frame),
              HasSubstr("behind.ply: no point of the empty bin"));
}

}  // namespace
}  // namespace graspd
