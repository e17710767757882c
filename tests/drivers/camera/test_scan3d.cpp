#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/camera/scan3d.hpp"
#include "tests/core/geometry/expect_camera.hpp"

namespace graspd {
namespace {

using testing::HasSubstr;

Scan3dNodes complete_nodes() {
  Scan3dNodes nodes;
  nodes.width = 640;
  nodes.height = 480;
  nodes.output_mode = "CalibratedC";
  nodes.distance_unit = "Millimeter";
  nodes.scale = 0.1;
  nodes.offset = 20.0;
  nodes.focal_length = 900.0;
  nodes.principal_point_u = 320.5;
  nodes.principal_point_v = 240.25;
  nodes.baseline = 0.08;
  return nodes;
}

/// The line that says what is wrong.
std::string refusal(const Scan3dNodes& nodes, const Scan3dSettings& settings = {}) {
  const Result<Scan3dInterpretation> made = interpret_scan3d(nodes, settings);
  EXPECT_FALSE(made.ok());
  EXPECT_EQ(made.status().code(), StatusCode::bad_frame);
  return std::string(made.status().message());
}

Scan3dInterpretation interpret(const Scan3dNodes& nodes, const Scan3dSettings& settings = {}) {
  const Result<Scan3dInterpretation> made = interpret_scan3d(nodes, settings);
  EXPECT_TRUE(made.ok()) << made.status().message();
  return made.ok() ? made.value() : Scan3dInterpretation{};
}

TEST(Scan3d, TakesAllFromTheCamera) {
  const Scan3dInterpretation made = interpret(complete_nodes());
  EXPECT_DOUBLE_EQ(made.decoding.scale, 0.0001);
  EXPECT_DOUBLE_EQ(made.decoding.offset, 0.02);
  EXPECT_EQ(made.decoding.focal_baseline, 0.0);
  EXPECT_FALSE(made.decoding.has_invalid_value);
  expect_same_camera(made.camera, {640, 480, 900.0F, 900.0F, 320.5F, 240.25F});
}

TEST(Scan3d, KnowsUnits) {
  Scan3dNodes nodes = complete_nodes();
  nodes.distance_unit = "Inch";
  EXPECT_DOUBLE_EQ(interpret(nodes).decoding.scale, 0.1 * 0.0254);
  nodes.distance_unit = "Meter";
  EXPECT_DOUBLE_EQ(interpret(nodes).decoding.scale, 0.1);
  nodes.distance_unit.reset();
  EXPECT_DOUBLE_EQ(interpret(nodes).decoding.scale, 0.0001) << "millimetres are the standard's default";
  nodes.distance_unit = "DeviceSpecific";
  EXPECT_THAT(refusal(nodes), HasSubstr("Scan3dDistanceUnit is DeviceSpecific"));
  Scan3dSettings settings;
  settings.scale = 2.0;
  EXPECT_DOUBLE_EQ(interpret(nodes, settings).decoding.scale, 0.002);
}

TEST(Scan3d, LetsTheConfigurationStandIn) {
  Scan3dNodes bare;
  bare.format = PixelFormat::mono16;
  bare.width = 320;
  bare.height = 240;
  Scan3dSettings settings;
  EXPECT_THAT(refusal(bare, settings),
              HasSubstr("no Scan3dFocalLength, and the configuration gives no camera.focal_l"));
  settings.focal_length_u = 500.0;
  settings.focal_length_v = 510.0;
  EXPECT_THAT(refusal(bare, settings), HasSubstr("Scan3dPrincipalPointU"));
  settings.principal_point_u = 160.0;
  EXPECT_THAT(refusal(bare, settings), HasSubstr("Scan3dPrincipalPointV"));
  settings.principal_point_v = 120.0;
  EXPECT_THAT(refusal(bare, settings),
              HasSubstr("no Scan3dCoordinateScale, and the configuration gives no camera.scale"));
  settings.scale = 1.0;
  const Scan3dInterpretation made = interpret(bare, settings);
  EXPECT_EQ(made.camera.fx, 500.0F);
  EXPECT_EQ(made.camera.fy, 510.0F);
  EXPECT_DOUBLE_EQ(made.decoding.scale, 0.001);
  EXPECT_TRUE(made.decoding.has_invalid_value) << "0 is invalid in a plain depth image";
  EXPECT_EQ(made.decoding.invalid_value, 0.0);

  const Scan3dInterpretation overruled = interpret(complete_nodes(), settings);
  EXPECT_EQ(overruled.camera.fx, 500.0F) << "the configuration goes before the camera";
  EXPECT_DOUBLE_EQ(overruled.decoding.offset, 0.0) << "an offset belongs to its scale";
}

TEST(Scan3d, ReadsDisparities) {
  Scan3dNodes nodes = complete_nodes();
  nodes.output_mode = "DisparityC";
  nodes.distance_unit = "Pixel";
  nodes.scale = 0.0625;
  nodes.offset = 0.0;
  Scan3dInterpretation made = interpret(nodes);
  EXPECT_DOUBLE_EQ(made.decoding.scale, 0.0625);
  EXPECT_DOUBLE_EQ(made.decoding.focal_baseline, 900.0 * 0.08) << "in metres where distances are pixels";
  nodes.distance_unit = "Millimeter";
  EXPECT_THAT(refusal(nodes), HasSubstr("Scan3dBaseline makes 8e-05 m"));
  nodes.baseline = 80.0;
  EXPECT_DOUBLE_EQ(interpret(nodes).decoding.focal_baseline, 900.0 * 0.08);
  nodes.distance_unit.reset();
  EXPECT_THAT(refusal(nodes), HasSubstr("Scan3dBaseline makes 80 m"));
  nodes.baseline.reset();
  EXPECT_THAT(refusal(nodes), HasSubstr("no Scan3dBaseline, and the configuration gives no camera.baseline"));
  Scan3dSettings settings;
  settings.baseline = 0.06;
  EXPECT_DOUBLE_EQ(interpret(nodes, settings).decoding.focal_baseline, 900.0 * 0.06);
}

TEST(Scan3d, MindsTheInvalidFlag) {
  Scan3dNodes nodes = complete_nodes();
  nodes.invalid_value = 7.0;
  EXPECT_FALSE(interpret(nodes).decoding.has_invalid_value) << "without the flag, every value is measured";
  nodes.invalid_flag = true;
  EXPECT_TRUE(interpret(nodes).decoding.has_invalid_value);
  EXPECT_EQ(interpret(nodes).decoding.invalid_value, 7.0);
  Scan3dSettings settings;
  settings.invalid_value = 3.0;
  EXPECT_EQ(interpret(nodes, settings).decoding.invalid_value, 3.0);
  nodes.invalid_value.reset();
  EXPECT_THAT(refusal(nodes), HasSubstr("no Scan3dInvalidDataValue"));
}

TEST(Scan3d, RefusesWhatIsNoDepthImage) {
  const auto with = [](auto change) {
    Scan3dNodes nodes = complete_nodes();
    change(nodes);
    return refusal(nodes);
  };
  EXPECT_THAT(with([](auto& n) { n.format = PixelFormat::coordinate_ac16; }), HasSubstr("profiles of a line scanner"));
  EXPECT_THAT(with([](auto& n) { n.output_mode = "CalibratedC_Linescan"; }), HasSubstr("profiles of a line scanner"));
  EXPECT_THAT(with([](auto& n) { n.output_mode = "UncalibratedC"; }), HasSubstr("choose CalibratedC"));
  EXPECT_THAT(with([](auto& n) { n.output_mode = "CalibratedABC_PointCloud"; }), HasSubstr("CalibratedABC_Grid"));
  EXPECT_THAT(with([](auto& n) { n.coordinate_system = "Spherical"; }), HasSubstr("choose Cartesian"));
  EXPECT_THAT(with([](auto& n) { n.coordinate_system_reference = "Transformed"; }), HasSubstr("choose Anchor"));
  EXPECT_THAT(with([](auto& n) { n.width = 0; }), HasSubstr("Width or Height is 0"));
  EXPECT_THAT(with([](auto& n) { n.focal_length = -1.0; }), HasSubstr("Scan3dFocalLength is -1 pixels"));
  EXPECT_THAT(with([](auto& n) { n.scale = 0.0; }), HasSubstr("Scan3dCoordinateScale is 0"));
}

}  // namespace
}  // namespace graspd
