#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "drivers/plc/register_map.hpp"
#include "drivers/plc/request_words.hpp"

namespace graspd {
namespace {

using Words = std::array<std::uint16_t, request_register::count>;

TEST(RequestWords, ZerosAskForNothingSpecial) {
  const PlcRequest request = read_request(Words{}, {});
  EXPECT_TRUE(request.well_formed);
  EXPECT_EQ(request.part, 0);
  EXPECT_EQ(request.tool, 0);
  EXPECT_LT(request.minimum_score, 0);
  EXPECT_EQ(request.results_wanted, 1);
  EXPECT_FALSE(request.dry_run);
  EXPECT_FALSE(request.save_snapshot);
  EXPECT_FALSE(request.avoid_last_place);
  EXPECT_EQ(request.region, 0);
  EXPECT_FALSE(request.has_flange_pose);
}

TEST(RequestWords, EachOptionHasItsBit) {
  Words words{};
  const auto with = [&words](unsigned option) {
    words[request_register::options] = static_cast<std::uint16_t>(option);
    return read_request(words, {});
  };
  EXPECT_TRUE(with(request_option::dry_run).dry_run);
  EXPECT_TRUE(with(request_option::save_snapshot).save_snapshot);
  EXPECT_TRUE(with(request_option::avoid_last_place).avoid_last_place);
  EXPECT_TRUE(with(request_option::flange_pose_given).has_flange_pose);
  const PlcRequest all_but_one = with(request_option::all & ~unsigned{request_option::dry_run});
  EXPECT_FALSE(all_but_one.dry_run);
  EXPECT_TRUE(all_but_one.save_snapshot && all_but_one.avoid_last_place && all_but_one.has_flange_pose);
}

TEST(RequestWords, FlangePoseIsReadInEveryFormat) {
  const RigidTransform pose{Eigen::AngleAxisf(0.8F, Vector3(1, -2, 0.5F).normalized()).toRotationMatrix(),
                            {0.4F, -0.3F, 1.1F}};
  for (const WordOrder order : {WordOrder::abcd, WordOrder::cdab, WordOrder::badc, WordOrder::dcba}) {
    for (std::uint16_t convention = 1; convention <= pose_convention_count; ++convention) {
      for (const NumberKind kind : {NumberKind::floating, NumberKind::scaled}) {
        const BlockFormat format{order, static_cast<PoseConvention>(convention), PositionUnit::metre,
                                 AngleUnit::radian};
        Words words{};
        words[request_register::pose_convention] = convention;
        words[request_register::options] = request_option::flange_pose_given;
        if (kind == NumberKind::scaled) words[request_register::options] |= request_option::scaled_numbers;
        put_pose(std::span(words).subspan(request_register::flange_pose), pose, kind, format);
        BlockFormat configured = format;
        configured.convention = PoseConvention::rotation_vector;
        const PlcRequest request = read_request(words, configured);
        EXPECT_LT((request.robot_from_flange.translation - pose.translation).norm(), 2e-6F);
        EXPECT_LT((request.robot_from_flange.rotation - pose.rotation).norm(), 1e-5F);
      }
    }
  }
}

TEST(RequestWords, QuaternionOfZerosIsNoPose) {
  Words words{};
  words[request_register::options] = request_option::flange_pose_given;
  words[request_register::pose_convention] = static_cast<std::uint16_t>(PoseConvention::quaternion);
  EXPECT_FALSE(read_request(words, {}).robot_from_flange.rotation.allFinite());
  words[request_register::pose_convention] = static_cast<std::uint16_t>(PoseConvention::zyx_euler);
  EXPECT_TRUE(read_request(words, {}).robot_from_flange.rotation.isIdentity());
}

TEST(RequestWords, RegionBoxHasMiddleLengthsAndTurn) {
  Words words{};
  const auto numbers = std::span(words).subspan(request_register::region_box);
  constexpr std::array<float, 7> values{100, -200, 700, 400, 300, 150, 90};
  for (std::size_t i = 0; i < values.size(); ++i) put_float(numbers.subspan(2 * i), values[i], WordOrder::abcd);
  EXPECT_TRUE(read_request(words, {}).box.half_size.isZero()) << "not asked for";
  words[request_register::region] = request_region::box;
  const RequestBox box = read_request(words, {}).box;
  EXPECT_LT((box.reference_from_box.translation - Vector3(0.1F, -0.2F, 0.7F)).norm(), 1e-6F);
  EXPECT_LT((box.half_size - Vector3(0.2F, 0.15F, 0.075F)).norm(), 1e-6F);
  EXPECT_LT((box.reference_from_box.rotation * Vector3::UnitX() - Vector3::UnitY()).norm(), 1e-6F);

  words[request_register::options] = request_option::scaled_numbers;
  for (std::size_t i = 0; i < values.size(); ++i) {
    put_int32(numbers.subspan(2 * i), static_cast<std::int32_t>(1000 * values[i]), WordOrder::abcd);
  }
  EXPECT_LT((read_request(words, {}).box.half_size - box.half_size).norm(), 1e-6F);
  EXPECT_LT((read_request(words, {}).box.reference_from_box.rotation - box.reference_from_box.rotation).norm(), 1e-5F);
}

TEST(RequestWords, MeaninglessValuesAreNoticedAndDoNoHarm) {
  for (const std::size_t address :
       {request_register::minimum_score, request_register::pose_convention, request_register::options,
        request_register::results_wanted, request_register::region}) {
    Words words{};
    words[address] = 0xFFFF;
    EXPECT_FALSE(read_request(words, {}).well_formed) << address;
    EXPECT_EQ(request_convention(words, {}), PoseConvention::rotation_vector);
  }
}

}  // namespace
}  // namespace graspd
