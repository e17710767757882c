#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/detect/edge_blur.hpp"

namespace graspd {
namespace {

constexpr float detail = 0.0024F;

/// Plateaus 20 mm high and 40 mm apart, their flanks `flank` pixels wide in the image.
struct Plateaus {
  Camera camera{320, 240, 500, 500, 160, 120};
  std::vector<float> depth = std::vector<float>(camera.pixel_count());

  explicit Plateaus(int flank, float height = 0.02F) {
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const int phase = u % 80;
        const int rise = std::min(std::max(phase - 20, 0), flank);
        const int fall = std::min(std::max(phase - 60, 0), flank);
        const float up = flank > 0 ? static_cast<float>(rise - fall) / static_cast<float>(flank)
                                   : (phase > 20 && phase <= 60 ? 1.0F : 0.0F);
        depth[camera.index(u, v)] = 0.5F - height * up;
      }
    }
  }
  [[nodiscard]] DepthFrame frame() { return {camera, depth, 0, 0}; }
};

TEST(EdgeBlur, IsNothingForStepsFromPixelToPixel) { EXPECT_EQ(measure_edge_blur(Plateaus(0).frame(), detail), 0.0F); }

TEST(EdgeBlur, IsTheWidthBetweenTheSurfaces) {
  // Six tenths of ten pixels of one millimetre lie between a fifth and four fifths of the step.
  EXPECT_NEAR(measure_edge_blur(Plateaus(10).frame(), detail), 0.006F, 0.0012F);
  EXPECT_NEAR(measure_edge_blur(Plateaus(5).frame(), detail), 0.003F, 0.0012F);
}

TEST(EdgeBlur, LooksAtStepsOfThePartsSizeOnly) {
  EXPECT_EQ(measure_edge_blur(Plateaus(10, 0.005F).frame(), detail), 0.0F);
  EXPECT_EQ(measure_edge_blur(Plateaus(10, 0.1F).frame(), detail), 0.0F);
}

TEST(EdgeBlur, IsKnownAtTheScaleOfEachPart) {
  constexpr float small = 0.0006F;
  Plateaus plateaus(10);
  EdgeBlurs blurs;
  know_edge_blur(plateaus.frame(), small, {}, blurs);
  EXPECT_EQ(blurs.width(detail), 0.0F) << "the only scale so far";
  know_edge_blur(plateaus.frame(), detail, {}, blurs);
  EXPECT_EQ(blurs.count, 2U);
  EXPECT_EQ(blurs.width(detail), measure_edge_blur(plateaus.frame(), detail));
  EXPECT_EQ(blurs.width(small), 0.0F);
  EXPECT_GT(blurs.width(detail), 0.0F);
  know_edge_blur(plateaus.frame(), 1.05F * detail, {}, blurs);
  EXPECT_EQ(blurs.count, 2U) << "nearly the same";
}

TEST(EdgeBlur, IsNothingWhereNothingWasMeasuredBetweenTheSurfaces) {
  Plateaus plateaus(10);
  for (float& z : plateaus.depth) z = z > 0.4801F && z < 0.4999F ? 0.0F : z;
  EXPECT_EQ(measure_edge_blur(plateaus.frame(), detail), 0.0F);
}

TEST(EdgeBlur, IsNotLedAstrayByWhatIsNoDepth) {
  const float undisturbed = measure_edge_blur(Plateaus(10).frame(), detail);
  // So near that what is looked at around it would exceed an integer, with these intrinsics or with those of a larger
  // detail; and what no sensor measures.
  for (const float depth :
       {2e-9F, 1e-6F, 1e-30F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1.0F}) {
    Plateaus plateaus(10);
    plateaus.depth[plateaus.camera.index(160, 120)] = depth;
    EXPECT_NEAR(measure_edge_blur(plateaus.frame(), detail), undisturbed, 1e-4F) << depth;
    EXPECT_EQ(measure_edge_blur(plateaus.frame(), 1.0F), 0.0F) << depth;
  }
}

TEST(EdgeBlur, DoesNotGuessFromAFewSteps) {
  Plateaus plateaus(10);
  for (int v = 4; v < plateaus.camera.height; ++v) {
    for (int u = 0; u < plateaus.camera.width; ++u) plateaus.depth[plateaus.camera.index(u, v)] = 0;
  }
  EXPECT_EQ(measure_edge_blur(plateaus.frame(), detail), 0.0F);
}

}  // namespace
}  // namespace graspd
