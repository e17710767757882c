#include "drivers/camera/genicam_buffer.hpp"

#include <arv.h>

#include <algorithm>

#include "drivers/system/clock.hpp"

namespace graspd {
namespace {

PixelFormat format_of(ArvBuffer* buffer, guint part) {
  return static_cast<PixelFormat>(arv_buffer_get_part_pixel_format(buffer, part));
}

bool is_confidence(ArvBuffer* buffer, guint part) {
  const PixelFormat format = format_of(buffer, part);
  return arv_buffer_get_part_data_type(buffer, part) == ARV_BUFFER_PART_DATA_TYPE_CONFIDENCE_MAP ||
         format == PixelFormat::confidence1 || format == PixelFormat::confidence8 ||
         format == PixelFormat::confidence16 || format == PixelFormat::confidence32f;
}

bool is_three_dimensional(ArvBuffer* buffer, guint part) {
  return arv_buffer_get_part_data_type(buffer, part) == ARV_BUFFER_PART_DATA_TYPE_3D_IMAGE;
}

}  // namespace

std::int64_t arrival_ns(ArvBuffer* buffer) {
  const std::int64_t now_real_ns = g_get_real_time() * 1000;
  const auto arrived_real_ns = static_cast<std::int64_t>(arv_buffer_get_system_timestamp(buffer));
  return monotonic_ns() - std::max<std::int64_t>(0, now_real_ns - arrived_real_ns);
}

PixelBlock block_of(ArvBuffer* buffer, int part) {
  const auto index = static_cast<guint>(part);
  std::size_t size = 0;
  const void* data = arv_buffer_get_part_data(buffer, index, &size);
  gint padding_x = 0;
  gint padding_y = 0;
  arv_buffer_get_part_padding(buffer, index, &padding_x, &padding_y);
  PixelBlock block;
  block.format = format_of(buffer, index);
  block.width = arv_buffer_get_part_width(buffer, index);
  block.height = arv_buffer_get_part_height(buffer, index);
  block.row_padding = static_cast<std::size_t>(std::max(padding_x, 0));
  block.bytes = {static_cast<const std::byte*>(data), data == nullptr ? 0 : size};
  return block;
}

ImagePlace place_of(ArvBuffer* buffer, int part) {
  const auto index = static_cast<guint>(part);
  return {arv_buffer_get_part_x(buffer, index), arv_buffer_get_part_y(buffer, index)};
}

BufferParts find_parts(ArvBuffer* buffer, PixelFormat depth_format) {
  BufferParts parts;
  bool sure = false;
  const guint count = arv_buffer_get_n_parts(buffer);
  for (guint i = 0; i < count; ++i) {
    if (is_confidence(buffer, i)) {
      parts.confidence = static_cast<int>(i);
    } else if (format_of(buffer, i) == depth_format && !sure) {
      sure = is_three_dimensional(buffer, i);
      if (parts.depth < 0 || sure) parts.depth = static_cast<int>(i);
    }
  }
  if (parts.depth < 0 && count == 1) parts.depth = 0;
  return parts;
}

std::size_t missing_bytes(ArvBuffer* buffer) {
  std::size_t announced = 0;
  for (guint i = 0; i < arv_buffer_get_n_parts(buffer); ++i) {
    std::size_t size = 0;
    arv_buffer_get_part_data(buffer, i, &size);
    announced += size;
  }
  std::size_t received = 0;
  arv_buffer_get_data(buffer, &received);
  return announced > received ? announced - received : 0;
}

}  // namespace graspd
