#include "firmware_app/frame_sources.hpp"

#include <utility>

namespace graspd {

Result<OpenedSource> open_source(const CameraSettings& settings) {
  OpenedSource opened;
  switch (settings.kind) {
    case CameraKind::recorded: {
      Result<std::unique_ptr<RecordedSource>> recorded = RecordedSource::open(settings.recorded);
      if (!recorded.ok()) return recorded.status();
      opened.bytes = recorded.value()->bytes();
      opened.source = std::move(recorded).value();
      break;
    }
  }
  return opened;
}

}  // namespace graspd
