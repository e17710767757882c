#include "drivers/camera/depth_decoding.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace graspd {
namespace {

/// As for images from files: some sensors mark what was not measured with a huge number.
constexpr double farthest = 1000.0;

template <class Value>
Value load(const std::byte* place) {
  Value value;
  std::memcpy(&value, place, sizeof value);
  return value;
}

/// The invalid value as the format would store it; no number, which nothing equals, where there is none.
template <class Value>
double stored_invalid_value(const DepthDecoding& decoding) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const double value = decoding.invalid_value;
  if (!decoding.has_invalid_value || !(std::abs(value) <= static_cast<double>(std::numeric_limits<Value>::max()))) {
    return none;
  }
  return std::is_integral_v<Value> ? value : static_cast<double>(static_cast<Value>(value));
}

/// One row. The compiler makes vectors of it, which a test holds it to: one type in all comparisons, and what was not
/// measured is computed too and then masked, as a choice between two values would become a branch.
template <class Value, std::size_t Stride, std::size_t Place, bool Disparity>
void decode_row(const DepthDecoding& decoding, double invalid, const std::byte* row, std::span<float> depth) {
  const double scale = decoding.scale;
  const double offset = decoding.offset;
  const double focal_baseline = decoding.focal_baseline;
  float* const out = depth.data();
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const auto stored = static_cast<double>(load<Value>(row + (i * Stride + Place) * sizeof(Value)));
    const double scaled = stored * scale + offset;
    const double z = Disparity ? focal_baseline / scaled : scaled;
    const bool measured = (z > 0.0) & (z < farthest) & (stored != invalid);
    const std::uint64_t mask = 0 - static_cast<std::uint64_t>(measured);
    out[i] = static_cast<float>(std::bit_cast<double>(std::bit_cast<std::uint64_t>(z) & mask));
  }
}

template <class Value, std::size_t Stride, std::size_t Place>
void decode_block(const DepthDecoding& decoding, const PixelBlock& block, std::span<float> depth) {
  const auto width = static_cast<std::size_t>(block.width);
  const std::size_t row_bytes = width * Stride * sizeof(Value) + block.row_padding;
  const auto invalid = stored_invalid_value<Value>(decoding);
  for (std::size_t v = 0; v < static_cast<std::size_t>(block.height); ++v) {
    const std::byte* row = block.bytes.data() + v * row_bytes;
    const std::span<float> out = depth.subspan(v * width, width);
    if (decoding.focal_baseline > 0) {
      decode_row<Value, Stride, Place, true>(decoding, invalid, row, out);
    } else {
      decode_row<Value, Stride, Place, false>(decoding, invalid, row, out);
    }
  }
}

/// Tells whether `block` holds all of its pixels and `depth` has room for them.
Status check_extent(const PixelBlock& block, std::size_t room) {
  if (block.width <= 0 || block.height <= 0) return {StatusCode::bad_frame, "the camera sent an image without pixels"};
  const auto width = static_cast<std::size_t>(block.width);
  const auto height = static_cast<std::size_t>(block.height);
  const std::size_t row_bytes = width * bytes_per_pixel(block.format) + block.row_padding;
  // The last row may come without its padding.
  const std::size_t needed = row_bytes * height - block.row_padding;
  if (block.bytes.size() < needed) {
    return Status::format(StatusCode::bad_frame, "the camera sent %zu bytes for %d x %d pixels of %s, which need %zu",
                          block.bytes.size(), block.width, block.height, pixel_format_name(block.format), needed);
  }
  if (room < width * height) {
    return Status::format(StatusCode::bad_frame, "%d x %d pixels do not fit into room for %zu", block.width,
                          block.height, room);
  }
  return {};
}

template <class Value>
void clear_unsure(const PixelBlock& confidence, std::span<float> depth) {
  const auto width = static_cast<std::size_t>(confidence.width);
  const std::size_t row_bytes = width * sizeof(Value) + confidence.row_padding;
  for (std::size_t v = 0; v < static_cast<std::size_t>(confidence.height); ++v) {
    const std::byte* row = confidence.bytes.data() + v * row_bytes;
    float* const out = depth.data() + v * width;
    for (std::size_t u = 0; u < width; ++u) {
      // Written so that a confidence that is no number clears the pixel.
      out[u] = load<Value>(row + u * sizeof(Value)) > Value{0} ? out[u] : 0.0F;
    }
  }
}

}  // namespace

const char* pixel_format_name(PixelFormat format) {
  switch (format) {
    case PixelFormat::mono8:
      return "Mono8";
    case PixelFormat::mono16:
      return "Mono16";
    case PixelFormat::confidence1:
      return "Confidence1";
    case PixelFormat::confidence8:
      return "Confidence8";
    case PixelFormat::confidence16:
      return "Confidence16";
    case PixelFormat::confidence32f:
      return "Confidence32f";
    case PixelFormat::coordinate_c16:
      return "Coord3D_C16";
    case PixelFormat::coordinate_c32f:
      return "Coord3D_C32f";
    case PixelFormat::coordinate_abc16:
      return "Coord3D_ABC16";
    case PixelFormat::coordinate_abc32f:
      return "Coord3D_ABC32f";
    case PixelFormat::coordinate_ac8:
      return "Coord3D_AC8";
    case PixelFormat::coordinate_ac16:
      return "Coord3D_AC16";
    case PixelFormat::coordinate_ac32f:
      return "Coord3D_AC32f";
  }
  return "unknown";
}

Status check_depth_format(PixelFormat format) {
  switch (format) {
    case PixelFormat::coordinate_c16:
    case PixelFormat::coordinate_c32f:
    case PixelFormat::coordinate_abc16:
    case PixelFormat::coordinate_abc32f:
    case PixelFormat::mono16:
      return {};
    case PixelFormat::coordinate_ac8:
    case PixelFormat::coordinate_ac16:
    case PixelFormat::coordinate_ac32f:
      return Status::format(StatusCode::bad_frame,
                            "PixelFormat is %s, profiles of a line scanner: graspd needs a depth image, as Coord3D_C16",
                            pixel_format_name(format));
    default:
      return Status::format(StatusCode::bad_frame,
                            "PixelFormat is %s (0x%08X), which carries no depth: use Coord3D_C16, Coord3D_C32f, "
                            "Coord3D_ABC16, Coord3D_ABC32f or Mono16",
                            pixel_format_name(format), static_cast<unsigned>(format));
  }
}

Status decode_depth(const DepthDecoding& decoding, const PixelBlock& block, std::span<float> depth) {
  if (block.format != decoding.format) {
    return Status::format(StatusCode::bad_frame, "the camera sent %s (0x%08X), but its PixelFormat was %s",
                          pixel_format_name(block.format), static_cast<unsigned>(block.format),
                          pixel_format_name(decoding.format));
  }
  if (Status readable = check_depth_format(block.format); !readable.ok()) return readable;
  if (Status whole = check_extent(block, depth.size()); !whole.ok()) return whole;
  switch (block.format) {
    case PixelFormat::coordinate_c32f:
      decode_block<float, 1, 0>(decoding, block, depth);
      break;
    case PixelFormat::coordinate_abc16:
      decode_block<std::uint16_t, 3, 2>(decoding, block, depth);
      break;
    case PixelFormat::coordinate_abc32f:
      decode_block<float, 3, 2>(decoding, block, depth);
      break;
    default:
      decode_block<std::uint16_t, 1, 0>(decoding, block, depth);
      break;
  }
  return {};
}

Status apply_confidence(const PixelBlock& confidence, const Camera& camera, std::span<float> depth) {
  if (confidence.width != camera.width || confidence.height != camera.height) {
    return Status::format(StatusCode::bad_frame, "the confidences have %d x %d pixels, the depth %d x %d",
                          confidence.width, confidence.height, camera.width, camera.height);
  }
  if (Status whole = check_extent(confidence, depth.size()); !whole.ok()) return whole;
  switch (confidence.format) {
    case PixelFormat::confidence1:
    case PixelFormat::confidence8:
    case PixelFormat::mono8:
      clear_unsure<std::uint8_t>(confidence, depth);
      return {};
    case PixelFormat::confidence16:
    case PixelFormat::mono16:
      clear_unsure<std::uint16_t>(confidence, depth);
      return {};
    case PixelFormat::confidence32f:
      clear_unsure<float>(confidence, depth);
      return {};
    default:
      return Status::format(StatusCode::bad_frame, "confidences as %s (0x%08X) are not understood: use Confidence8",
                            pixel_format_name(confidence.format), static_cast<unsigned>(confidence.format));
  }
}

}  // namespace graspd
