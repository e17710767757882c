#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "drivers/camera/depth_decoding.hpp"
#include "drivers/files/depth_image.hpp"

namespace graspd {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// An image of one row, and bytes that stay.
template <class Value>
struct Row {
  Row(PixelFormat row_format, std::vector<Value> row_values) : format(row_format), values(std::move(row_values)) {}

  [[nodiscard]] PixelBlock block() const {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(values));
    return {format, static_cast<int>(bytes.size() / bytes_per_pixel(format)), 1, 0, bytes};
  }

  PixelFormat format;
  std::vector<Value> values;
};

template <class Value>
std::vector<float> decode(const Row<Value>& row, DepthDecoding decoding) {
  decoding.format = row.format;
  std::vector<float> depth(static_cast<std::size_t>(row.block().width), -1.0F);
  const Status decoded = decode_depth(decoding, row.block(), depth);
  EXPECT_TRUE(decoded.ok()) << decoded.message();
  return depth;
}

DepthDecoding millimetres(double step = 1.0, double offset = 0.0) {
  DepthDecoding decoding;
  decoding.scale = step / 1000.0;
  decoding.offset = offset / 1000.0;
  return decoding;
}

TEST(DepthDecoding, ScalesSixteenBitDepth) {
  const Row<std::uint16_t> row(PixelFormat::coordinate_c16, {0, 1, 5000, 65535});
  EXPECT_THAT(decode(row, millimetres(0.1)), ElementsAre(0.0F, 0.0001F, 0.5F, 6.5535F));
  EXPECT_THAT(decode(row, millimetres(0.1, 250)), ElementsAre(0.25F, 0.2501F, 0.75F, 6.8035F));
}

TEST(DepthDecoding, EqualsTheSameImageFromAFile) {
  std::vector<std::uint16_t> values(65536);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::uint16_t>(i);
  for (const float depth_scale : {1.0F, 0.1F, 0.05F, 0.12345F}) {
    DepthImage image{256, 256, {values.begin(), values.end()}};
    std::vector<float> from_file(values.size());
    scale_depth(image, depth_scale, from_file);
    const std::vector<float> decoded =
        decode(Row<std::uint16_t>(PixelFormat::coordinate_c16, values), millimetres(static_cast<double>(depth_scale)));
    EXPECT_EQ(std::memcmp(decoded.data(), from_file.data(), decoded.size() * sizeof(float)), 0) << depth_scale;
  }
}

TEST(DepthDecoding, TakesFloatDepthAsItIs) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinite = std::numeric_limits<float>::infinity();
  const Row<float> row(PixelFormat::coordinate_c32f, {0.75F, -0.5F, nan, infinite, -infinite, 1e6F, 0.123456F});
  DepthDecoding decoding;
  EXPECT_THAT(decode(row, decoding), ElementsAre(0.75F, 0, 0, 0, 0, 0, 0.123456F));
}

TEST(DepthDecoding, TakesTheThirdOfThreeCoordinates) {
  const Row<std::uint16_t> integers(PixelFormat::coordinate_abc16, {9, 9, 400, 7, 7, 500});
  EXPECT_THAT(decode(integers, millimetres()), ElementsAre(0.4F, 0.5F));
  const Row<float> floats(PixelFormat::coordinate_abc32f, {9, 9, 400, -7, -7, 500});
  EXPECT_THAT(decode(floats, millimetres()), ElementsAre(0.4F, 0.5F));
}

TEST(DepthDecoding, TurnsDisparitiesIntoDepth) {
  DepthDecoding decoding;
  decoding.scale = 1.0 / 16;
  decoding.offset = 2.0;
  decoding.focal_baseline = 1000.0 * 0.08;
  // 80 / (1264 / 16 + 2) and 80 / (480 / 16 + 2); a disparity of nothing is infinitely far.
  const Row<std::uint16_t> row(PixelFormat::coordinate_c16, {1264, 480});
  EXPECT_THAT(decode(row, decoding), ElementsAre(80.0F / 81.0F, 2.5F));
  decoding.offset = 0.0;
  const Row<std::uint16_t> nothing(PixelFormat::coordinate_c16, {0, 1280});
  EXPECT_THAT(decode(nothing, decoding), ElementsAre(0.0F, 1.0F));
}

TEST(DepthDecoding, ComparesTheInvalidValueBeforeScaling) {
  DepthDecoding decoding = millimetres(1.0, 1000.0);
  decoding.has_invalid_value = true;
  const Row<std::uint16_t> row(PixelFormat::coordinate_c16, {0, 1, 65535});
  EXPECT_THAT(decode(row, decoding), ElementsAre(0.0F, 1.001F, 66.535F));
  decoding.invalid_value = 65535;
  EXPECT_THAT(decode(row, decoding), ElementsAre(1.0F, 1.001F, 0.0F));
  decoding.invalid_value = 0.5;
  EXPECT_THAT(decode(row, decoding), ElementsAre(1.0F, 1.001F, 66.535F)) << "no stored value is one half";
  decoding.has_invalid_value = false;
  decoding.invalid_value = 0;
  EXPECT_THAT(decode(row, decoding), ElementsAre(1.0F, 1.001F, 66.535F));

  decoding = {};
  decoding.has_invalid_value = true;
  decoding.invalid_value = 2.5;
  const Row<float> floats(PixelFormat::coordinate_c32f, {2.5F, 2.25F});
  EXPECT_THAT(decode(floats, decoding), ElementsAre(0.0F, 2.25F));
  decoding.invalid_value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(decode(floats, decoding), ElementsAre(2.5F, 2.25F));
}

TEST(DepthDecoding, SkipsWhatPadsTheRows) {
  const std::vector<std::uint16_t> values{100, 200, 9999, 300, 400};
  PixelBlock block{PixelFormat::mono16, 2, 2, 2, std::as_bytes(std::span(values))};
  DepthDecoding decoding = millimetres();
  decoding.format = PixelFormat::mono16;
  std::vector<float> depth(4);
  ASSERT_TRUE(decode_depth(decoding, block, depth).ok()) << "the last row may lack its padding";
  EXPECT_THAT(depth, ElementsAre(0.1F, 0.2F, 0.3F, 0.4F));
}

TEST(DepthDecoding, RefusesWhatItCannotRead) {
  const std::vector<std::uint16_t> values(6);
  const auto refusal = [&](PixelBlock block, PixelFormat expected, std::size_t room = 6) {
    DepthDecoding decoding;
    decoding.format = expected;
    block.bytes = std::as_bytes(std::span(values));
    std::vector<float> depth(room);
    const Status decoded = decode_depth(decoding, block, depth);
    EXPECT_EQ(decoded.code(), StatusCode::bad_frame);
    return std::string(decoded.message());
  };
  constexpr PixelFormat c16 = PixelFormat::coordinate_c16;
  EXPECT_THAT(refusal({c16, 3, 3, 0, {}}, c16), HasSubstr("12 bytes for 3 x 3 pixels of Coord3D_C16, which need 18"));
  EXPECT_THAT(refusal({c16, 3, 2, 0, {}}, c16, 5), HasSubstr("3 x 2 pixels do not fit into room for 5"));
  EXPECT_THAT(refusal({PixelFormat::mono16, 3, 2, 0, {}}, c16), HasSubstr("sent Mono16 (0x01100007), but"));
  EXPECT_THAT(refusal({c16, 0, 2, 0, {}}, c16), HasSubstr("without pixels"));
  for (const PixelFormat profile :
       {PixelFormat::coordinate_ac8, PixelFormat::coordinate_ac16, PixelFormat::coordinate_ac32f}) {
    EXPECT_THAT(refusal({profile, 1, 1, 0, {}}, profile), HasSubstr("profiles of a line scanner"));
  }
  EXPECT_THAT(refusal({PixelFormat::mono8, 1, 1, 0, {}}, PixelFormat::mono8), HasSubstr("carries no depth"));
}

TEST(DepthDecoding, ClearsWhatTheSensorIsNotSureOf) {
  const Camera camera{4, 1, 1, 1, 0, 0};
  const auto masked = [&](PixelFormat format, std::span<const std::byte> bytes) {
    std::vector<float> depth{1, 2, 3, 4};
    const Status applied = apply_confidence({format, 4, 1, 0, bytes}, camera, depth);
    EXPECT_TRUE(applied.ok()) << applied.message();
    return depth;
  };
  const std::vector<std::uint8_t> bytes{0, 1, 0, 255};
  EXPECT_THAT(masked(PixelFormat::confidence8, std::as_bytes(std::span(bytes))), ElementsAre(0, 2, 0, 4));
  EXPECT_THAT(masked(PixelFormat::mono8, std::as_bytes(std::span(bytes))), ElementsAre(0, 2, 0, 4));
  const std::vector<std::uint16_t> words{256, 0, 1, 0};
  EXPECT_THAT(masked(PixelFormat::confidence16, std::as_bytes(std::span(words))), ElementsAre(1, 0, 3, 0));
  const std::vector<float> floats{0.5F, 0, std::numeric_limits<float>::quiet_NaN(), 1};
  EXPECT_THAT(masked(PixelFormat::confidence32f, std::as_bytes(std::span(floats))), ElementsAre(1, 0, 0, 4));

  std::vector<float> depth(4);
  EXPECT_EQ(
      apply_confidence({PixelFormat::confidence8, 2, 2, 0, std::as_bytes(std::span(bytes))}, camera, depth).code(),
      StatusCode::bad_frame);
  EXPECT_EQ(
      apply_confidence({PixelFormat::coordinate_c16, 4, 1, 0, std::as_bytes(std::span(words))}, camera, depth).code(),
      StatusCode::bad_frame);
}

}  // namespace
}  // namespace graspd
