#include "firmware_app/frame_sources.hpp"

#include <utility>

#include "drivers/camera/genicam_source.hpp"

namespace graspd {

namespace {

/// What Aravis keeps of a camera: its description as a tree, packets under way, threads.
constexpr std::size_t aravis_bytes = std::size_t{32} << 20U;

}  // namespace

Result<OpenedSource> open_source(const CameraSettings& settings, bool connect) {
  OpenedSource opened;
  switch (settings.kind) {
    case CameraKind::recorded: {
      Result<std::unique_ptr<RecordedSource>> recorded = RecordedSource::open(settings.recorded);
      if (!recorded.ok()) return recorded.status();
      opened.bytes = recorded.value()->bytes();
      opened.limits = recorded.value()->limits();
      opened.source = std::move(recorded).value();
      break;
    }
    case CameraKind::genicam: {
      LoadedFrame empty_bin;
      if (!settings.empty_bin.empty()) {
        Result<LoadedFrame> loaded = load_frame(settings.empty_bin, settings.recorded.files);
        if (!loaded.ok()) return loaded.status();
        empty_bin = std::move(loaded).value();
      }
      opened.limits = settings.genicam.limits;
      opened.bytes = genicam_buffer_bytes(opened.limits) + aravis_bytes + empty_bin.depth.size() * sizeof(float);
      if (connect) opened.source = std::make_unique<GenicamSource>(settings.genicam, std::move(empty_bin));
      break;
    }
  }
  return opened;
}

}  // namespace graspd
