#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "drivers/plc/pick_list.hpp"

namespace graspd {
namespace {

using Words = std::array<std::uint16_t, pick_list::count>;

[[nodiscard]] ResultBlock five_picks() {
  ResultBlock result;
  result.sequence = 12;
  result.request_id = 34;
  result.code = ResultCode::ok;
  result.verified = true;
  result.remaining = 5;
  result.frame = PoseFrame::robot;
  result.approach_distance = 0.1F;
  result.listed_count = pick_list::entries;
  for (std::size_t i = 0; i < result.listed.size(); ++i) {
    const auto n = static_cast<float>(i + 1);
    ListedPick& entry = result.listed[i];
    entry.part = static_cast<std::uint16_t>(i + 1);
    entry.grasp = static_cast<std::uint16_t>(10 + i);
    entry.tool = static_cast<std::uint16_t>(20 + i);
    entry.score = n / 10;
    entry.opening = n / 100;
    entry.pick = {Eigen::AngleAxisf(n / 3, Vector3(1, n, 2).normalized()).toRotationMatrix(), {n / 10, -n / 7, 0.8F}};
  }
  return result;
}

[[nodiscard]] Words encoded(const ResultBlock& result, NumberKind kind = NumberKind::floating) {
  Words words;
  words.fill(0xDEAD);
  encode_list(result, kind, {}, words);
  return words;
}

TEST(PickList, ReadsBackInEveryFormat) {
  const ResultBlock result = five_picks();
  for (const NumberKind kind : {NumberKind::floating, NumberKind::scaled}) {
    for (const WordOrder order : {WordOrder::abcd, WordOrder::cdab, WordOrder::badc, WordOrder::dcba}) {
      for (std::uint16_t convention = 1; convention <= pose_convention_count; ++convention) {
        const BlockFormat format{order, static_cast<PoseConvention>(convention), PositionUnit::millimetre,
                                 AngleUnit::degree};
        Words words{};
        encode_list(result, kind, format, words);
        const Result<ResultBlock> back = decode_list(words, kind, {order});
        ASSERT_TRUE(back.ok()) << back.status().message();
        EXPECT_EQ(back.value().sequence, 12);
        EXPECT_EQ(back.value().request_id, 34);
        EXPECT_EQ(back.value().remaining, 5);
        EXPECT_EQ(back.value().frame, PoseFrame::robot);
        EXPECT_FLOAT_EQ(back.value().approach_distance, 0.1F);
        ASSERT_EQ(back.value().listed_count, 5);
        for (std::size_t i = 0; i < 5; ++i) {
          const ListedPick& entry = back.value().listed[i];
          EXPECT_EQ(entry.part, i + 1);
          EXPECT_EQ(entry.grasp, 10 + i);
          EXPECT_EQ(entry.tool, 20 + i);
          EXPECT_NEAR(entry.score, result.listed[i].score, 1e-4F);
          EXPECT_NEAR(entry.opening, result.listed[i].opening, 1e-6F);
          EXPECT_LT((entry.pick.translation - result.listed[i].pick.translation).norm(), 2e-6F);
          EXPECT_LT((entry.pick.rotation - result.listed[i].pick.rotation).norm(), 5e-5F);
        }
      }
    }
  }
}

TEST(PickList, IsEmptyWithoutAVerifiedPick) {
  ResultBlock failed = five_picks();
  failed.code = ResultCode::not_pickable;
  ResultBlock unverified = five_picks();
  unverified.verified = false;
  for (const ResultBlock& bad : {failed, unverified}) {
    const Words words = encoded(bad);
    EXPECT_EQ(words[pick_list::picks], 0);
    for (std::size_t i = pick_list::first_entry; i < pick_list::checksum; ++i) EXPECT_EQ(words[i], 0) << i;
    EXPECT_TRUE(decode_list(words, NumberKind::floating, {}).ok());
  }
}

TEST(PickList, EndsBeforeWhatIsNotFinite) {
  ResultBlock result = five_picks();
  result.listed[3].pick.translation.y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(encoded(result)[pick_list::picks], 3);
}

TEST(PickList, RefusesTornAndDamagedLists) {
  const Words good = encoded(five_picks(), NumberKind::scaled);
  ASSERT_TRUE(decode_list(good, NumberKind::scaled, {}).ok());
  for (std::size_t i = 0; i < good.size(); ++i) {
    Words bad = good;
    bad[i] = static_cast<std::uint16_t>(bad[i] ^ 0x0100U);
    EXPECT_FALSE(decode_list(bad, NumberKind::scaled, {}).ok()) << i;
  }
  EXPECT_FALSE(decode_list(std::span(good).first(pick_list::count - 1), NumberKind::scaled, {}).ok());
}

}  // namespace
}  // namespace graspd
