#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/files/bitmap_font.hpp"
#include "drivers/files/depth_image.hpp"
#include "drivers/files/picture.hpp"
#include "tests/drivers/files/temporary_folder.hpp"

namespace graspd {
namespace {

constexpr Colour white{255, 255, 255};

int lit_pixels(const Picture& picture) {
  return static_cast<int>(
      std::count_if(picture.pixels.begin(), picture.pixels.end(), [](Colour c) { return c.g > 127; }));
}

TEST(Picture, LineConnectsItsEnds) {
  Picture picture(40, 20, {});
  draw_line(picture, 2, 3, 35, 15, white, 2.0F);
  EXPECT_EQ(picture.at(2, 3).r, 255);
  EXPECT_EQ(picture.at(35, 15).r, 255);
  EXPECT_GT(picture.at(18, 9).r, 200);
  EXPECT_EQ(picture.at(35, 3).r, 0);
  EXPECT_NEAR(lit_pixels(picture), 70, 15);
}

TEST(Picture, DrawingBesideThePictureIsHarmless) {
  Picture picture(10, 10, {});
  draw_line(picture, -1e9F, -1e9F, -5, -5, white, 3.0F);
  draw_line(picture, 50, 0, 60, 1e9F, white, 3.0F);
  draw_line(picture, 0, std::nanf(""), 5, 5, white);
  draw_arrow(picture, 5, -20, 5, -15, white);
  draw_circle(picture, 30, 30, 4, white);
  draw_circle(picture, 5, 5, 1e9F, white);
  draw_text(picture, -100, 3, "left", white);
  draw_text(picture, 3, 100, "below", white);
  fill_rectangle(picture, -5, -5, 3, 3, white);
  EXPECT_EQ(lit_pixels(picture), 0);
}

TEST(Picture, TextIsAsWideAsItSays) {
  Picture picture(200, 40, {});
  draw_text(picture, 0, 0, "MMM", white, 2);
  int rightmost = 0;
  for (int v = 0; v < picture.height; ++v) {
    for (int u = 0; u < picture.width; ++u) {
      if (picture.at(u, v).r != 0) rightmost = std::max(rightmost, u);
    }
  }
  EXPECT_EQ(rightmost + 1, text_width("MMM", 2));
  EXPECT_EQ(text_width(""), 0);
}

TEST(Picture, EveryPrintableCharacterHasItsOwnGlyph) {
  for (char a = ' '; a < '~'; ++a) {
    for (char b = static_cast<char>(a + 1); b <= '~'; ++b) EXPECT_NE(glyph_of(a), glyph_of(b)) << a << " and " << b;
  }
  EXPECT_EQ(glyph_of('\n'), glyph_of(static_cast<char>(200)));
}

TEST(Picture, FileIsAColourPng) {
  const TemporaryFolder folder;
  const Picture picture(16, 8, white);
  ASSERT_TRUE(write_picture(folder.path() / "a.png", picture).ok());
  EXPECT_THAT(std::string(read_depth_image(folder.path() / "a.png").status().message()),
              ::testing::HasSubstr("a colour PNG"));
  EXPECT_EQ(write_picture(folder.path() / "no" / "a.png", picture).code(), StatusCode::cannot_write);
}

}  // namespace
}  // namespace graspd
