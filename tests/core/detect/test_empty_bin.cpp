#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

#include "core/detect/empty_bin.hpp"
#include "tests/core/detect/counting_clock.hpp"
#include "tests/core/memory/carved.hpp"

namespace graspd {
namespace {

class KeptEmptyBin : public testing::Test {
 protected:
  KeptEmptyBin() {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> metres(0.70F, 0.72F);
    for (float& z : depth_) z = random() % 9 == 0 ? 0.0F : metres(random);
    bin_ = carved_into(bytes_, [](Arena& arena) { return carve_empty_bin(arena, cells); });
  }
  DepthFrame frame() { return {camera_, depth_, 0, 0}; }
  void keep(int stride, const Execution& execution = {}) { keep_empty_bin(frame(), stride, execution, scratch_, bin_); }
  /// The same, made of nothing.
  std::vector<float> made_anew(int stride, bool nearest) {
    std::unique_ptr<std::byte[]> bytes;
    EmptyBin bin = carved_into(bytes, [](Arena& arena) { return carve_empty_bin(arena, cells); });
    keep_empty_bin(frame(), stride, {}, scratch_, bin);
    const std::span<float> values = nearest ? bin.nearest : bin.depths;
    return {values.begin(), values.end()};
  }
  void expect_as_made_anew(int stride) {
    EXPECT_TRUE(std::ranges::equal(bin_.depths, made_anew(stride, false)));
    EXPECT_TRUE(std::ranges::equal(bin_.nearest, made_anew(stride, true)));
  }

  static constexpr std::size_t cells = 61 * 37;
  Camera camera_{61, 37, 80.0F, 80.0F, 30.0F, 18.0F};
  std::vector<float> depth_ = std::vector<float>(camera_.pixel_count());
  std::vector<float> scratch_ = std::vector<float>(cells);
  std::unique_ptr<std::byte[]> bytes_;
  EmptyBin bin_;
};

TEST_F(KeptEmptyBin, IsMadeOnceOfAFrame) {
  keep(1);
  expect_as_made_anew(1);
  bin_.depths[77] = 5.0F;
  keep(1);
  EXPECT_EQ(bin_.depths[77], 5.0F);
}

TEST_F(KeptEmptyBin, IsMadeAnewWhenAPixelOrTheCameraOrTheStrideIsAnother) {
  keep(1);
  for (const std::size_t pixel : {std::size_t{0}, std::size_t{900}, depth_.size() - 1}) {
    depth_[pixel] += 0.001F;
    bin_.depths[77] = 5.0F;
    keep(1);
    expect_as_made_anew(1);
  }
  bin_.depths[77] = 5.0F;
  camera_.fx = 81.0F;
  keep(1);
  expect_as_made_anew(1);
  keep(2);
  EXPECT_EQ(bin_.origin.front().stride, 2);
  EXPECT_TRUE(std::equal(bin_.depths.begin(), bin_.depths.begin() + 31 * 19, made_anew(2, false).begin()));
}

TEST_F(KeptEmptyBin, IsNotTakenForMadeWhenItWasLate) {
  for (const std::int64_t deadline : {1, 10, 40, 80, 110}) {
    depth_[5] += 0.001F;
    readings = 0;
    keep(1, {1, read_clock, deadline});
    EXPECT_EQ(bin_.origin.front().stride, 0) << deadline;
  }
  keep(1);
  expect_as_made_anew(1);
}

TEST_F(KeptEmptyBin, DigestsTellFramesApart) {
  const FrameDigest digest = digest_of(frame());
  EXPECT_EQ(digest, digest_of(frame()));
  std::vector<float> other = depth_;
  // Each pixel by its last bit, by its sign, and exchanged with the one that is mixed into the same word next.
  for (std::size_t i = 0; i < other.size(); ++i) {
    for (const float changed : {std::nextafter(depth_[i], 1.0F), -depth_[i] - 0.1F}) {
      other[i] = changed;
      ASSERT_NE(digest, digest_of({camera_, other, 0, 0})) << i;
      other[i] = depth_[i];
    }
    if (i + 16 < other.size() && other[i] != other[i + 16]) {
      std::swap(other[i], other[i + 16]);
      ASSERT_NE(digest, digest_of({camera_, other, 0, 0})) << i;
      std::swap(other[i], other[i + 16]);
    }
  }
}

}  // namespace
}  // namespace graspd
