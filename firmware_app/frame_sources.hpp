#pragma once

#include <cstddef>
#include <memory>

#include "core/status.hpp"
#include "drivers/camera/frame_source.hpp"
#include "firmware_app/configuration.hpp"

namespace graspd {

/// The configured source of frames, and what it keeps in memory.
struct OpenedSource {
  std::unique_ptr<FrameSource> source;
  std::size_t bytes = 0;
};

/// Opens the source that [camera] names. Fails as the source's own `open` does.
[[nodiscard]] Result<OpenedSource> open_source(const CameraSettings& settings);

}  // namespace graspd
