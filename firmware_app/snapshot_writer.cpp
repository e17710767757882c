#include "firmware_app/snapshot_writer.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drivers/files/atomic_file.hpp"
#include "drivers/files/frame_folder.hpp"
#include "drivers/system/log.hpp"

namespace graspd {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = "snapshot_";

/// Names sort by age, as long as the clock goes forward.
[[nodiscard]] std::string name_for(std::uint16_t request_id) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
  const auto seconds = static_cast<std::time_t>(milliseconds / 1000);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  std::array<char, 24> time{};
  std::strftime(time.data(), time.size(), "%Y%m%dT%H%M%S", &utc);
  std::array<char, 64> name{};
  std::snprintf(name.data(), name.size(), "%s%s.%03dZ_request_%u", prefix.data(), time.data(),
                static_cast<int>(milliseconds % 1000), unsigned{request_id});
  return name.data();
}

}  // namespace

Status prepare_snapshots(const fs::path& folder) {
  if (Status made = make_folder(folder); !made.ok()) return made;
  return check_writable(folder / prefix);
}

SnapshotWriter::SnapshotWriter(fs::path folder, std::size_t kept, std::span<float> memory)
    : folder_(std::move(folder)),
      kept_(kept),
      memory_(memory),
      worker_([this] { return write(); }, [this](const Status& written) { tell(written); }) {}

void SnapshotWriter::offer(const DepthFrame& frame, std::uint16_t request_id) {
  if (frame.depth.empty()) return;
  const bool taken = worker_.offer([&] {
    camera_ = frame.camera;
    std::ranges::copy(frame.depth, memory_.begin());
    request_id_ = request_id;
  });
  if (taken) return;
  log_event(LogLevel::warning, "W014", "snapshot not kept: the last one is still being written request_id=%u",
            unsigned{request_id});
}

void SnapshotWriter::tell(const Status& written) const {
  if (written.ok()) {
    log_event(LogLevel::notice, "N015", "snapshot kept request_id=%u", unsigned{written_id_});
  } else {
    log_event(LogLevel::warning, "W014", "snapshot not kept: %s", written.message().data());
  }
}

Status SnapshotWriter::write() {
  written_id_ = request_id_;
  const fs::path path = folder_ / name_for(request_id_);
  Status written = write_frame_folder(path, {camera_, memory_.first(camera_.pixel_count()), 0, 0});
  if (written.ok()) drop_oldest(path);
  return written;
}

void SnapshotWriter::drop_oldest(const fs::path& newest) const {
  std::vector<fs::path> snapshots;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    if (entry.path().filename().string().starts_with(prefix)) snapshots.push_back(entry.path());
  }
  std::ranges::sort(snapshots);
  // Names of a later time are from before the clock was set back, so older than all others.
  std::rotate(snapshots.begin(), std::ranges::upper_bound(snapshots, newest), snapshots.end());
  for (std::size_t i = 0; i + kept_ < snapshots.size(); ++i) fs::remove_all(snapshots[i]);
}

}  // namespace graspd
