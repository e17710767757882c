#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>

#include "drivers/plc/coherent_words.hpp"
#include "drivers/plc/register_tables.hpp"
#include "drivers/plc/result_block.hpp"

namespace graspd {
namespace {

using Words = std::array<std::uint16_t, block::count>;

[[nodiscard]] RigidTransform pose(float angle, const Vector3& axis, const Vector3& translation) {
  return {Eigen::AngleAxisf(angle, axis.normalized()).toRotationMatrix(), translation};
}

[[nodiscard]] ResultBlock sample() {
  ResultBlock result;
  result.sequence = 41;
  result.request_id = 7;
  result.code = ResultCode::ok;
  result.flags = 5;
  result.part = 3;
  result.view = 12;
  result.grasp = 2;
  result.tool = 4;
  result.score = 0.8765F;
  result.instances_found = 6;
  result.pickable = 4;
  result.remaining = 3;
  result.result_index = 1;
  result.frame = PoseFrame::robot;
  result.frame_age = 0.321F;
  result.stage_time = {0.3F, 0.02F, 0.01F, 0.1F, 0.002F, 0.05F, 0.1F, 0.003F};
  result.opening = 0.0425F;
  result.pick = pose(0.5F, {1, 2, 3}, {0.1F, -0.2F, 0.75F});
  result.approach = pose(0.5F, {1, 2, 3}, {0.1F, -0.2F, 0.65F});
  result.part_pose = pose(-2.5F, {0, 1, 1}, {-1.5F, 0.25F, 0.8F});
  result.verified = true;
  return result;
}

[[nodiscard]] Words encoded(const ResultBlock& result, const BlockFormat& format = {}) {
  Words words;
  words.fill(0xDEAD);
  encode(result, format, words);
  return words;
}

void expect_near(const RigidTransform& a, const RigidTransform& b) {
  EXPECT_LT((a.translation - b.translation).norm(), 1e-6F);
  EXPECT_LT((a.rotation - b.rotation).norm(), 1e-5F);
}

TEST(ResultBlock, ReadsBackInEveryFormat) {
  const ResultBlock result = sample();
  for (const WordOrder order : {WordOrder::abcd, WordOrder::cdab, WordOrder::badc, WordOrder::dcba}) {
    for (std::uint16_t convention = 1; convention <= pose_convention_count; ++convention) {
      for (const PositionUnit length : {PositionUnit::millimetre, PositionUnit::metre}) {
        for (const AngleUnit angle : {AngleUnit::degree, AngleUnit::radian}) {
          const BlockFormat format{order, static_cast<PoseConvention>(convention), length, angle};
          const Words words = encoded(result, format);
          BlockFormat reading = format;
          reading.convention = PoseConvention::quaternion;  // The block itself says which one it is in.
          const Result<ResultBlock> back = decode(words, reading);
          ASSERT_TRUE(back.ok()) << back.status().message();
          expect_near(back.value().pick, result.pick);
          expect_near(back.value().approach, result.approach);
          expect_near(back.value().part_pose, result.part_pose);
          EXPECT_NEAR(back.value().opening, result.opening, 1e-7F);
          EXPECT_EQ(back.value().sequence, result.sequence);
          EXPECT_EQ(back.value().request_id, result.request_id);
          EXPECT_EQ(back.value().flags, result.flags);
          EXPECT_EQ(back.value().tool, result.tool);
          EXPECT_EQ(back.value().remaining, result.remaining);
          EXPECT_EQ(back.value().frame, PoseFrame::robot);
          EXPECT_NEAR(back.value().score, result.score, 1e-4F);
          EXPECT_TRUE(back.value().verified);
        }
      }
    }
  }
}

TEST(ResultBlock, WritesMillimetresAndDegreesUnlessToldOtherwise) {
  ResultBlock result = sample();
  result.pick = pose(std::numbers::pi_v<float> / 2, {0, 0, 1}, {0.1F, -0.2F, 0.75F});
  const Words words = encoded(result);
  const auto at = std::span(words);
  EXPECT_FLOAT_EQ(get_float(at.subspan(block::pick_pose), WordOrder::abcd), 100.0F);
  EXPECT_FLOAT_EQ(get_float(at.subspan(block::pick_pose + 2), WordOrder::abcd), -200.0F);
  EXPECT_FLOAT_EQ(get_float(at.subspan(block::pick_pose + 10), WordOrder::abcd), 90.0F);
  EXPECT_EQ(get_int32(at.subspan(block::pick_pose_scaled), WordOrder::abcd), 100'000);
  EXPECT_EQ(get_int32(at.subspan(block::pick_pose_scaled + 2), WordOrder::abcd), -200'000);
  EXPECT_EQ(get_int32(at.subspan(block::pick_pose_scaled + 10), WordOrder::abcd), 90'000);
  EXPECT_FLOAT_EQ(get_float(at.subspan(block::opening), WordOrder::abcd), 42.5F);
  EXPECT_EQ(get_int32(at.subspan(block::opening_scaled), WordOrder::abcd), 42'500);
  EXPECT_EQ(words[block::score], 8765);
  EXPECT_EQ(words[block::frame_age], 321);
  EXPECT_EQ(words[block::time_total], 300);
  EXPECT_EQ(words[block::time_grasp], 3);

  BlockFormat radians;
  radians.angle = AngleUnit::radian;
  radians.length = PositionUnit::metre;
  const Words other = encoded(result, radians);
  EXPECT_FLOAT_EQ(get_float(std::span(other).subspan(block::pick_pose), WordOrder::abcd), 0.1F);
  EXPECT_EQ(get_int32(std::span(other).subspan(block::pick_pose_scaled), WordOrder::abcd), 100'000);
  EXPECT_EQ(get_int32(std::span(other).subspan(block::pick_pose_scaled + 10), WordOrder::abcd), 1'570'796);
}

TEST(ResultBlock, CarriesNoPoseUnlessItIsVerified) {
  ResultBlock result = sample();
  result.verified = false;
  ResultBlock failed = sample();
  failed.code = ResultCode::not_pickable;
  ResultBlock infinite = sample();
  infinite.approach.translation.x() = std::numeric_limits<float>::quiet_NaN();
  for (const ResultBlock& bad : {result, failed, infinite}) {
    EXPECT_FALSE(has_pick(bad));
    const Words words = encoded(bad);
    for (std::size_t i = block::opening; i < block::tool; ++i) EXPECT_EQ(words[i], 0) << i;
  }
}

TEST(ResultBlock, ShowsThePosesOfADryRunWithoutAPick) {
  ResultBlock result = sample();
  result.code = ResultCode::dry_run;
  EXPECT_FALSE(has_pick(result));
  const Result<ResultBlock> back = decode(encoded(result), {});
  ASSERT_TRUE(back.ok()) << back.status().message();
  expect_near(back.value().pick, result.pick);
  EXPECT_FALSE(has_pick(back.value()));
}

TEST(ResultBlock, CutsWhatARegisterCannotHold) {
  ResultBlock result = sample();
  result.stage_time.fill(1e9F);
  result.frame_age = -1.0F;
  result.score = std::numeric_limits<float>::quiet_NaN();
  result.pick.translation = {1e6F, -1e6F, 0};
  const Words words = encoded(result);
  EXPECT_EQ(words[block::time_total], 65535);
  EXPECT_EQ(words[block::frame_age], 0);
  EXPECT_EQ(words[block::score], 0);
  EXPECT_EQ(get_int32(std::span(words).subspan(block::pick_pose_scaled), WordOrder::abcd), 2147483647);
  EXPECT_EQ(get_int32(std::span(words).subspan(block::pick_pose_scaled + 2), WordOrder::abcd), -2147483647);
}

TEST(ResultBlock, RefusesTornDamagedAndForeignBlocks) {
  const Words good = encoded(sample());
  ASSERT_TRUE(decode(good, {}).ok());
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const unsigned bit : {0U, 7U, 15U}) {
      Words bad = good;
      bad[i] = static_cast<std::uint16_t>(bad[i] ^ (1U << bit));
      EXPECT_FALSE(decode(bad, {}).ok()) << "register " << i << " bit " << bit;
    }
  }
  EXPECT_FALSE(decode(std::span(good).first(block::count - 1), {}).ok());
  BlockFormat wrong_order;
  wrong_order.word_order = WordOrder::cdab;
  const Result<ResultBlock> wrong = decode(good, wrong_order);
  ASSERT_FALSE(wrong.ok());
  EXPECT_NE(wrong.status().message().find("test pattern"), std::string_view::npos);
}

TEST(ResultBlock, ChecksumIsTheOneOfModbus) {
  // The serial request 01 03 00 00 00 0A ends in C5 CD, low byte first.
  const std::array<std::uint16_t, 3> words{0x0103, 0x0000, 0x000A};
  EXPECT_EQ(block_checksum(words), 0xCDC5);
}

TEST(ResultBlock, TableCoversTheBlockWithoutGaps) {
  std::size_t next = 0;
  for (const RegisterEntry& entry : block_table) {
    EXPECT_EQ(entry.address, next) << entry.name;
    next = std::size_t{entry.address} + entry.words;
  }
  EXPECT_EQ(next, std::size_t{block::count});
}

TEST(ResultCodes, AreUniqueAndFollowTheStatusCodes) {
  std::set<ResultCode> codes;
  for (const ResultCodeEntry& entry : result_code_table) EXPECT_TRUE(codes.insert(entry.code).second) << entry.name;
  for (std::int16_t i = 0; i <= 13; ++i) {
    const ResultCode code = result_code(static_cast<StatusCode>(i));
    EXPECT_TRUE(code == ResultCode::internal || static_cast<std::int16_t>(code) == i) << i;
  }
  EXPECT_EQ(result_code_name(static_cast<ResultCode>(999)), "unknown");
}

TEST(ResultReasons, CoverEveryRejection) {
  for (std::size_t i = 1; i < rejection_count; ++i) {
    const auto rejection = static_cast<Rejection>(i);
    const ResultReason reason = result_reason(rejection);
    EXPECT_LT(static_cast<int>(reason), 100);
    std::string name = rejection_name(rejection);
    std::replace(name.begin(), name.end(), ' ', '_');
    EXPECT_EQ(result_reason_name(reason), name);
  }
  for (std::size_t i = 1; i < grasp_rejection_count; ++i) {
    const ResultReason reason = result_reason(static_cast<GraspRejection>(i));
    EXPECT_GT(static_cast<int>(reason), 100);
    EXPECT_NE(result_reason_name(reason), "unknown");
  }
}

TEST(ResultFlags, KeepDetectionAndPickApart) {
  EXPECT_EQ(result_flags(flag_scene_points_cut, 0), 1U);
  EXPECT_EQ(result_flags(flag_hypotheses_cut, 0), 2U);
  EXPECT_EQ(result_flags(flag_instances_cut, 0), 4U);
  EXPECT_EQ(result_flags(flag_deadline, 0), 8U);
  EXPECT_EQ(result_flags(0, flag_grasps_cut), 16U);
  EXPECT_EQ(result_flags(flag_deadline, flag_picks_cut), 40U);
  EXPECT_EQ(result_flags(flag_voting_cut, flag_grasps_cut), 80U);
  EXPECT_EQ(result_flags(0, flag_not_all_asked), 128U);
}

}  // namespace
}  // namespace graspd
