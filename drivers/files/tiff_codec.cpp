#include "drivers/files/tiff_codec.hpp"

#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>

#include "drivers/files/png_codec.hpp"

namespace graspd {

namespace {

/// The file in memory as libtiff walks it, and the first error that it reports.
struct TiffState {
  std::string_view bytes;
  toff_t position = 0;
  std::array<char, 200> error{};
};

TiffState& state_of(thandle_t handle) { return *static_cast<TiffState*>(handle); }

tmsize_t on_read(thandle_t handle, void* target, tmsize_t count) {
  TiffState& state = state_of(handle);
  if (state.position >= state.bytes.size() || count <= 0) return 0;
  const std::size_t size = std::min<std::size_t>(static_cast<std::size_t>(count), state.bytes.size() - state.position);
  std::memcpy(target, state.bytes.data() + state.position, size);
  state.position += size;
  return static_cast<tmsize_t>(size);
}

tmsize_t on_write(thandle_t, void*, tmsize_t) { return -1; }

toff_t on_seek(thandle_t handle, toff_t offset, int whence) {
  TiffState& state = state_of(handle);
  if (whence == SEEK_CUR) offset += state.position;
  if (whence == SEEK_END) offset += state.bytes.size();
  state.position = offset;
  return offset;
}

int on_close(thandle_t) { return 0; }

toff_t on_size(thandle_t handle) { return state_of(handle).bytes.size(); }

int on_map(thandle_t, void**, toff_t*) { return 0; }

void on_unmap(thandle_t, void*, toff_t) {}

[[gnu::format(printf, 4, 0)]] int on_error(TIFF*, void* user, const char*, const char* format, va_list arguments) {
  TiffState& state = state_of(user);
  if (state.error[0] == '\0') std::vsnprintf(state.error.data(), state.error.size(), format, arguments);
  return 1;
}

int on_warning(TIFF*, void*, const char*, const char*, va_list) { return 1; }

struct TiffCloser {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using TiffHandle = std::unique_ptr<TIFF, TiffCloser>;

TiffHandle open_tiff(TiffState& state) {
  TIFFOpenOptions* const options = TIFFOpenOptionsAlloc();
  if (options == nullptr) return nullptr;
  TIFFOpenOptionsSetMaxSingleMemAlloc(options, tmsize_t{1} << 30);
  TIFFOpenOptionsSetErrorHandlerExtR(options, on_error, &state);
  TIFFOpenOptionsSetWarningHandlerExtR(options, on_warning, &state);
  TiffHandle tiff(TIFFClientOpenExt("depth", "rm", &state, on_read, on_write, on_seek, on_close, on_size, on_map,
                                    on_unmap, options));
  TIFFOpenOptionsFree(options);
  return tiff;
}

enum class Sample : std::uint8_t { unsigned16, float32 };

/// Copies a block of decoded samples into the image; what hangs over its border is left out.
void copy_block(const std::byte* block, Sample sample, std::size_t block_width, std::size_t block_height,
                std::size_t left, std::size_t top, DepthImage& image) {
  const auto image_width = static_cast<std::size_t>(image.width);
  const std::size_t columns = std::min(block_width, image_width - left);
  const std::size_t rows = std::min(block_height, static_cast<std::size_t>(image.height) - top);
  for (std::size_t row = 0; row < rows; ++row) {
    float* const target = image.values.data() + (top + row) * image_width + left;
    if (sample == Sample::float32) {
      std::memcpy(target, block + row * block_width * sizeof(float), columns * sizeof(float));
      continue;
    }
    const std::byte* const source = block + row * block_width * sizeof(std::uint16_t);
    for (std::size_t column = 0; column < columns; ++column) {
      std::uint16_t value = 0;
      std::memcpy(&value, source + column * sizeof(value), sizeof(value));
      target[column] = value;
    }
  }
}

bool read_tiles(TIFF* tiff, Sample sample, DepthImage& image) {
  std::uint32_t tile_width = 0;
  std::uint32_t tile_height = 0;
  TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &tile_width);
  TIFFGetField(tiff, TIFFTAG_TILELENGTH, &tile_height);
  const std::size_t size = std::size_t{tile_width} * tile_height * (sample == Sample::float32 ? 4 : 2);
  if (tile_width == 0 || tile_height == 0 || tile_width > maximum_image_side || tile_height > maximum_image_side ||
      TIFFTileSize(tiff) != static_cast<tmsize_t>(size)) {
    return false;
  }
  std::vector<std::byte> block(size);
  for (std::uint32_t top = 0; top < static_cast<std::uint32_t>(image.height); top += tile_height) {
    for (std::uint32_t left = 0; left < static_cast<std::uint32_t>(image.width); left += tile_width) {
      const tmsize_t count =
          TIFFReadEncodedTile(tiff, TIFFComputeTile(tiff, left, top, 0, 0), block.data(), static_cast<tmsize_t>(size));
      if (count != static_cast<tmsize_t>(size)) return false;
      copy_block(block.data(), sample, tile_width, tile_height, left, top, image);
    }
  }
  return true;
}

bool read_strips(TIFF* tiff, Sample sample, DepthImage& image) {
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::uint32_t>(image.height);
  std::uint32_t strip_rows = height;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_ROWSPERSTRIP, &strip_rows);
  strip_rows = std::clamp<std::uint32_t>(strip_rows, 1, height);
  const std::size_t row_size = width * (sample == Sample::float32 ? 4 : 2);
  std::vector<std::byte> block(row_size * strip_rows);
  for (std::uint32_t top = 0; top < height; top += strip_rows) {
    const std::size_t rows = std::min(strip_rows, height - top);
    const auto size = static_cast<tmsize_t>(rows * row_size);
    if (TIFFReadEncodedStrip(tiff, TIFFComputeStrip(tiff, top, 0), block.data(), size) != size) return false;
    copy_block(block.data(), sample, width, rows, 0, top, image);
  }
  return true;
}

}  // namespace

Result<DepthImage> decode_depth_tiff(std::string_view bytes, std::string_view name) {
  TiffState state;
  state.bytes = bytes;
  const int name_length = static_cast<int>(name.size());
  const auto damaged = [&] {
    return Status::format(StatusCode::bad_file, "%.*s: damaged TIFF: %s", name_length, name.data(),
                          state.error[0] == '\0' ? "its sizes contradict each other" : state.error.data());
  };
  const TiffHandle tiff = open_tiff(state);
  if (tiff == nullptr) return damaged();

  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint16_t channels = 1;
  std::uint16_t bits = 1;
  std::uint16_t format = SAMPLEFORMAT_UINT;
  TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, &channels);
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_SAMPLEFORMAT, &format);
  if (width == 0 || height == 0 || width > maximum_image_side || height > maximum_image_side) {
    return Status::format(StatusCode::bad_file, "%.*s: a TIFF of %u x %u pixels; sides from 1 to %d can be read",
                          name_length, name.data(), width, height, maximum_image_side);
  }
  if (channels != 1) {
    return Status::format(StatusCode::bad_file,
                          "%.*s: a TIFF of %u channels; depth must have one: is this the colour picture?", name_length,
                          name.data(), channels);
  }
  const bool is_unsigned16 = bits == 16 && format == SAMPLEFORMAT_UINT;
  const bool is_float32 = bits == 32 && format == SAMPLEFORMAT_IEEEFP;
  if (!is_unsigned16 && !is_float32) {
    return Status::format(StatusCode::bad_file,
                          "%.*s: a TIFF of %u bits (sample format %u); depth must be 16-bit unsigned or 32-bit float",
                          name_length, name.data(), bits, format);
  }

  DepthImage image{static_cast<int>(width), static_cast<int>(height), {}};
  image.values.resize(std::size_t{width} * height);
  const Sample sample = is_float32 ? Sample::float32 : Sample::unsigned16;
  const bool complete =
      TIFFIsTiled(tiff.get()) != 0 ? read_tiles(tiff.get(), sample, image) : read_strips(tiff.get(), sample, image);
  if (!complete) return damaged();
  return image;
}

}  // namespace graspd
