#pragma once

#include <cstddef>
#include <cstdint>

#include "drivers/camera/depth_decoding.hpp"

using ArvBuffer = struct _ArvBuffer;

namespace graspd {

/// When the first packet of the buffer arrived, on our clock (nanoseconds). The exposure was over by then.
[[nodiscard]] std::int64_t arrival_ns(ArvBuffer* buffer);

/// One image of the buffer, in the buffer's memory.
[[nodiscard]] PixelBlock block_of(ArvBuffer* buffer, int part);

/// Where on the sensor an image begins, as the camera said when it sent it; pixels.
struct ImagePlace {
  int x = 0;
  int y = 0;

  friend bool operator==(const ImagePlace&, const ImagePlace&) = default;
};
[[nodiscard]] ImagePlace place_of(ArvBuffer* buffer, int part);

/// The part of the buffer that holds depth, and the one with confidences; -1: none.
struct BufferParts {
  int depth = -1;
  int confidence = -1;
};
/// A part that is said to be a 3D image goes before others of the same format, which may be intensities. A single image
/// of another format counts as depth: decoding says what is wrong with it.
[[nodiscard]] BufferParts find_parts(ArvBuffer* buffer, PixelFormat depth_format);

/// Bytes that the leader of the buffer announced and no packet brought. Aravis takes a buffer for whole as soon as its
/// trailer is there, and leaves in the rest what was in it before.
[[nodiscard]] std::size_t missing_bytes(ArvBuffer* buffer);

}  // namespace graspd
