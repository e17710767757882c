#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <tiffio.h>

#include <cmath>
#include <numeric>

#include "drivers/files/depth_image.hpp"
#include "drivers/files/whole_file.hpp"
#include "tests/drivers/files/temporary_folder.hpp"

namespace graspd {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr int width = 37;
constexpr int height = 21;

std::vector<std::uint16_t> ramp() {
  std::vector<std::uint16_t> values(static_cast<std::size_t>(width * height));
  std::iota(values.begin(), values.end(), std::uint16_t{300});
  values[5] = 0;
  values[6] = 65535;
  return values;
}

class DepthImageFile : public ::testing::Test {
 protected:
  fs::path write_png() {
    const fs::path path = folder_.path() / "depth.png";
    EXPECT_TRUE(write_depth_png(path, width, height, ramp()).ok());
    return path;
  }

  /// An 8-bit PNG of the given libpng format, as other programs write them.
  fs::path write_byte_png(std::uint32_t format) {
    const fs::path path = folder_.path() / "byte.png";
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = 4;
    image.height = 4;
    image.format = format;
    const std::vector<std::uint8_t> pixels(64, 100);
    EXPECT_NE(png_image_write_to_file(&image, path.c_str(), 0, pixels.data(), 0, nullptr), 0);
    return path;
  }

  /// A TIFF whose rows are those of `values`; tiles of 16 x 16 when `tiled`.
  template <class T>
  fs::path write_tiff(const std::vector<T>& values, std::uint16_t format, bool tiled, int compression,
                      std::uint16_t channels = 1) {
    const fs::path path = folder_.path() / "depth.tif";
    TIFF* const tiff = TIFFOpen(path.c_str(), "w");
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, height);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, static_cast<int>(8 * sizeof(T)));
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, channels);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, format);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, compression);
    if (tiled) {
      TIFFSetField(tiff, TIFFTAG_TILEWIDTH, 16);
      TIFFSetField(tiff, TIFFTAG_TILELENGTH, 16);
      for (int top = 0; top < height; top += 16) {
        for (int left = 0; left < width; left += 16) {
          std::vector<T> tile(256);
          for (int v = top; v < std::min(top + 16, height); ++v) {
            for (int u = left; u < std::min(left + 16, width); ++u) {
              tile[static_cast<std::size_t>((v - top) * 16 + u - left)] =
                  values[static_cast<std::size_t>(v * width + u)];
            }
          }
          TIFFWriteTile(tiff, tile.data(), static_cast<std::uint32_t>(left), static_cast<std::uint32_t>(top), 0, 0);
        }
      }
    } else {
      TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 8);
      std::vector<T> row(static_cast<std::size_t>(width * channels));
      for (int v = 0; v < height; ++v) {
        std::copy_n(values.begin() + v * width * channels, width * channels, row.begin());
        TIFFWriteScanline(tiff, row.data(), static_cast<std::uint32_t>(v));
      }
    }
    TIFFClose(tiff);
    return path;
  }

  static std::string refusal(const fs::path& path) {
    const Result<DepthImage> image = read_depth_image(path);
    EXPECT_EQ(image.status().code(), StatusCode::bad_file);
    return std::string(image.status().message());
  }

  TemporaryFolder folder_;
};

TEST_F(DepthImageFile, PngComesBackAsItWasWritten) {
  const Result<DepthImage> image = read_depth_image(write_png());
  ASSERT_TRUE(image.ok()) << image.status().message();
  EXPECT_EQ(image.value().width, width);
  EXPECT_EQ(image.value().height, height);
  const std::vector<std::uint16_t> expected = ramp();
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), image.value().values.begin(),
                         [](std::uint16_t a, float b) { return static_cast<float>(a) == b; }));
}

TEST_F(DepthImageFile, TiffOfBothKindsInStripsAndTiles) {
  const std::vector<std::uint16_t> whole = ramp();
  const std::vector<float> fractions(whole.begin(), whole.end());
  for (const bool tiled : {false, true}) {
    for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE}) {
      const Result<DepthImage> from_whole = read_depth_image(write_tiff(whole, SAMPLEFORMAT_UINT, tiled, compression));
      ASSERT_TRUE(from_whole.ok()) << from_whole.status().message();
      EXPECT_EQ(from_whole.value().values, fractions);
      const Result<DepthImage> from_float =
          read_depth_image(write_tiff(fractions, SAMPLEFORMAT_IEEEFP, tiled, compression));
      ASSERT_TRUE(from_float.ok()) << from_float.status().message();
      EXPECT_EQ(from_float.value().values, fractions);
    }
  }
}

TEST_F(DepthImageFile, DepthIsInMetres) {
  DepthImage image{5, 1, {7500.0F, 0.0F, -3.0F, std::nanf(""), 1e30F}};
  std::vector<float> depth(5, 9.0F);
  scale_depth(image, 0.1F, depth);
  EXPECT_FLOAT_EQ(depth[0], 0.75F);
  EXPECT_EQ(depth[1], 0.0F);
  EXPECT_EQ(depth[2], 0.0F);
  EXPECT_EQ(depth[3], 0.0F);
  EXPECT_EQ(depth[4], 0.0F);
}

TEST_F(DepthImageFile, WrongSizeNamesBoth) {
  const Status status = check_size({640, 480, {}}, {1280, 960, 1, 1, 0, 0}, "depth.png");
  EXPECT_EQ(status.code(), StatusCode::bad_frame);
  EXPECT_THAT(std::string(status.message()), HasSubstr("depth.png: 640 x 480 pixels, but the camera has 1280 x 960"));
}

TEST_F(DepthImageFile, WrongKindOfPngIsNamed) {
  EXPECT_THAT(refusal(write_byte_png(PNG_FORMAT_GRAY)),
              HasSubstr("byte.png: a grey PNG of 8 bits; depth must be 16-bit"));
  EXPECT_THAT(refusal(write_byte_png(PNG_FORMAT_RGB)), HasSubstr("byte.png: a colour PNG"));
}

TEST_F(DepthImageFile, WrongKindOfTiffIsNamed) {
  const std::vector<std::uint8_t> bytes(static_cast<std::size_t>(3 * width * height), 7);
  EXPECT_THAT(refusal(write_tiff(bytes, SAMPLEFORMAT_UINT, false, COMPRESSION_NONE)), HasSubstr("a TIFF of 8 bits"));
  EXPECT_THAT(refusal(write_tiff(bytes, SAMPLEFORMAT_UINT, false, COMPRESSION_NONE, 3)),
              HasSubstr("a TIFF of 3 channels"));
  const std::vector<std::int16_t> negative(static_cast<std::size_t>(width * height), -7);
  EXPECT_THAT(refusal(write_tiff(negative, SAMPLEFORMAT_INT, false, COMPRESSION_NONE)), HasSubstr("sample format 2"));
}

TEST_F(DepthImageFile, DamageIsRefusedAtEveryLength) {
  const std::string png = read_file(write_png()).value();
  for (std::size_t size = 8; size + 12 < png.size(); size += 13) {
    EXPECT_THAT(refusal(folder_.write("cut.png", png.substr(0, size))), HasSubstr("cut.png: damaged PNG"));
  }
  const std::string tiff = read_file(write_tiff(ramp(), SAMPLEFORMAT_UINT, false, COMPRESSION_LZW)).value();
  for (std::size_t size = 8; size + 4 < tiff.size(); size += 13) {
    EXPECT_THAT(refusal(folder_.write("cut.tif", tiff.substr(0, size))), HasSubstr("cut.tif: damaged TIFF"));
  }
  std::string flipped = png;
  flipped[png.size() / 2] = static_cast<char>(flipped[png.size() / 2] ^ 0x10);
  EXPECT_THAT(refusal(folder_.write("flipped.png", flipped)), HasSubstr("damaged PNG"));
}

TEST_F(DepthImageFile, OtherFilesAreRefused) {
  EXPECT_THAT(refusal(folder_.write("depth.png", "JFIF")), HasSubstr("neither a PNG nor a TIFF"));
  EXPECT_THAT(refusal(folder_.write("void.png", "")), HasSubstr("neither a PNG nor a TIFF"));
  EXPECT_THAT(refusal(folder_.path() / "none.png"), HasSubstr("No such file"));
}

}  // namespace
}  // namespace graspd
