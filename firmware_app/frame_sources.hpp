#pragma once

#include <cstddef>
#include <memory>

#include "core/status.hpp"
#include "drivers/camera/frame_source.hpp"
#include "firmware_app/configuration.hpp"

namespace graspd {

/// The configured source of frames, and what it keeps in memory.
struct OpenedSource {
  std::unique_ptr<FrameSource> source;  ///< Null when a camera was not to be connected.
  FrameLimits limits;
  std::size_t bytes = 0;
};

/// Opens the source that [camera] names. A camera on the network is left alone unless `connect` is true; it
/// need not be there. Fails as the recorded source's `open` and as load_frame, for the empty bin, do.
[[nodiscard]] Result<OpenedSource> open_source(const CameraSettings& settings, bool connect);

}  // namespace graspd
