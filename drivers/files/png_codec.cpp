#include "drivers/files/png_codec.hpp"

#include <png.h>

#include <array>
#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstring>

namespace graspd {

namespace {

/// What libpng's callbacks need; errors jump out of libpng with their text kept here.
struct PngState {
  std::string_view input;
  std::vector<std::byte> output;
  std::array<char, 200> error{};
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  auto* const state = static_cast<PngState*>(png_get_error_ptr(png));
  std::snprintf(state->error.data(), state->error.size(), "%s", message);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_read(png_structp png, png_bytep target, std::size_t count) {
  auto* const state = static_cast<PngState*>(png_get_io_ptr(png));
  if (count > state->input.size()) png_error(png, "the file ends too early");
  std::memcpy(target, state->input.data(), count);
  state->input.remove_prefix(count);
}

void on_write(png_structp png, png_bytep bytes, std::size_t count) {
  auto* const state = static_cast<PngState*>(png_get_io_ptr(png));
  const auto* const first = reinterpret_cast<const std::byte*>(bytes);
  state->output.insert(state->output.end(), first, first + count);
}

void on_flush(png_structp) {}

struct PngReader {
  PngState state;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &state, on_error, on_warning);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);

  PngReader() = default;
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
};

struct PngWriter {
  PngState state;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &state, on_error, on_warning);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);

  PngWriter() = default;
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;
  ~PngWriter() { png_destroy_write_struct(&png, &info); }
};

// The functions that libpng may jump out of hold nothing that would have to be destroyed.

bool read_header(PngReader& reader) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_set_user_limits(reader.png, maximum_image_side, maximum_image_side);
  png_set_read_fn(reader.png, &reader.state, on_read);
  png_read_info(reader.png, reader.info);
  return true;
}

bool read_rows(PngReader& reader, png_bytepp rows) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  if constexpr (std::endian::native == std::endian::little) png_set_swap(reader.png);
  png_read_image(reader.png, rows);
  png_read_end(reader.png, nullptr);
  return true;
}

bool write_rows(PngWriter& writer, png_uint_32 width, png_uint_32 height, PngPixels pixels, const png_byte* rows,
                std::size_t stride) {
  if (setjmp(png_jmpbuf(writer.png)) != 0) return false;
  png_set_write_fn(writer.png, &writer.state, on_write, on_flush);
  const bool grey = pixels == PngPixels::grey16;
  png_set_IHDR(writer.png, writer.info, width, height, grey ? 16 : 8, grey ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(writer.png, 4);
  png_write_info(writer.png, writer.info);
  if (grey && std::endian::native == std::endian::little) png_set_swap(writer.png);
  for (png_uint_32 row = 0; row < height; ++row) png_write_row(writer.png, rows + row * stride);
  png_write_end(writer.png, nullptr);
  return true;
}

Status refuse(std::string_view name, const char* what) {
  return Status::format(StatusCode::bad_file, "%.*s: %s", static_cast<int>(name.size()), name.data(), what);
}

}  // namespace

Result<DepthImage> decode_depth_png(std::string_view bytes, std::string_view name) {
  PngReader reader;
  if (reader.info == nullptr) return Status(StatusCode::internal, "libpng does not start");
  reader.state.input = bytes;
  const auto damaged = [&] {
    return Status::format(StatusCode::bad_file, "%.*s: damaged PNG: %s", static_cast<int>(name.size()), name.data(),
                          reader.state.error.data());
  };
  if (!read_header(reader)) return damaged();

  const int bits = png_get_bit_depth(reader.png, reader.info);
  const int colour = png_get_color_type(reader.png, reader.info);
  if (colour != PNG_COLOR_TYPE_GRAY) {
    return refuse(name, "a colour PNG; depth must be 16-bit grey: is this the colour picture?");
  }
  if (bits != 16) {
    return Status::format(StatusCode::bad_file,
                          "%.*s: a grey PNG of %d bits; depth must be 16-bit grey: export it with 16 bits",
                          static_cast<int>(name.size()), name.data(), bits);
  }

  const std::size_t width = png_get_image_width(reader.png, reader.info);
  const std::size_t height = png_get_image_height(reader.png, reader.info);
  std::vector<std::uint16_t> grey(width * height);
  std::vector<png_bytep> rows(height);
  for (std::size_t v = 0; v < height; ++v) rows[v] = reinterpret_cast<png_bytep>(grey.data() + v * width);
  if (!read_rows(reader, rows.data())) return damaged();
  return DepthImage{static_cast<int>(width), static_cast<int>(height), {grey.begin(), grey.end()}};
}

Result<std::vector<std::byte>> encode_png(int width, int height, PngPixels pixels, std::span<const std::byte> rows) {
  PngWriter writer;
  const std::size_t stride = static_cast<std::size_t>(width) * (pixels == PngPixels::grey16 ? 2 : 3);
  if (writer.info == nullptr || width <= 0 || height <= 0 || rows.size() != stride * static_cast<std::size_t>(height)) {
    return Status(StatusCode::internal, "a PNG cannot be made of these pixels");
  }
  if (!write_rows(writer, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), pixels,
                  reinterpret_cast<const png_byte*>(rows.data()), stride)) {
    return Status::format(StatusCode::internal, "libpng: %s", writer.state.error.data());
  }
  return std::move(writer.state.output);
}

}  // namespace graspd
