#include "firmware_app/record_folder.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>
#include <utility>

#include "drivers/files/atomic_file.hpp"
#include "drivers/files/bop_dataset.hpp"
#include "drivers/files/json_file.hpp"

namespace graspd {
namespace {

namespace fs = std::filesystem;

constexpr int largest_number = 999999;

/// The number that a folder is named by; 0 for other names.
int number_of(const fs::path& folder) {
  const std::string name = folder.filename().string();
  int number = 0;
  std::from_chars(name.data(), name.data() + name.size(), number);
  return name == bop_number(number) ? number : 0;
}

/// The parts that were looked for in a recording. None when that cannot be told any more: one recording that was
/// damaged must not keep the line from running, and goes when it is the oldest.
std::set<std::uint32_t> parts_in(const fs::path& recording) {
  std::set<std::uint32_t> parts;
  const Result<nlohmann::json> record = read_json(recording / "record.json");
  if (!record.ok() || !record.value().is_object() || !record.value().contains("banks")) return parts;
  for (const nlohmann::json& bank : record.value()["banks"]) {
    if (!bank.is_object() || !bank.contains("part") || !bank["part"].is_number_unsigned()) continue;
    parts.insert(bank["part"].get<std::uint32_t>());
  }
  return parts;
}

std::size_t bytes_below(const fs::path& folder) {
  std::size_t bytes = 0;
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(folder, ignored)) {
    if (entry.is_regular_file(ignored)) bytes += static_cast<std::size_t>(entry.file_size(ignored));
  }
  return bytes;
}

Status cannot_write(const fs::path& path, const std::error_code& error) {
  return Status::format(StatusCode::cannot_write, "%s: %s", path.c_str(), error.message().c_str());
}

}  // namespace

fs::path RecordFolder::scenes() const { return fs::path(settings_.folder) / "recorded"; }

Result<RecordFolder> RecordFolder::open(const RecordSettings& settings) {
  RecordFolder folder(settings);
  if (Status made = make_folder(folder.scenes()); !made.ok()) return made;
  std::error_code error;
  if (Status writable = check_writable(fs::path(settings.folder) / "recorded_targets_bop19.json"); !writable.ok()) {
    return writable;
  }
  for (const auto& entry : fs::directory_iterator(folder.scenes(), error)) {
    const int number = number_of(entry.path());
    if (number <= 0) continue;
    folder.recordings_.push_back({number, bytes_below(entry.path()), parts_in(entry.path())});
  }
  folder.sort_by_age();
  if (!folder.recordings_.empty()) folder.next_ = folder.recordings_.back().number % largest_number + 1;
  return folder;
}

/// Numbers begin again behind the largest one: where the widest gap between them is, the oldest follows.
void RecordFolder::sort_by_age() {
  std::sort(recordings_.begin(), recordings_.end(),
            [](const Recording& a, const Recording& b) { return a.number < b.number; });
  std::size_t oldest = 0;
  int widest = 0;
  for (std::size_t i = 0; i < recordings_.size(); ++i) {
    const int before = i == 0 ? recordings_.back().number - largest_number : recordings_[i - 1].number;
    const int gap = recordings_[i].number - before;
    if (gap <= widest) continue;
    widest = gap;
    oldest = i;
  }
  std::rotate(recordings_.begin(), recordings_.begin() + static_cast<std::ptrdiff_t>(oldest), recordings_.end());
}

Result<fs::path> RecordFolder::add(const std::set<std::uint32_t>& parts,
                                   const std::function<Status(const fs::path&)>& fill) {
  const fs::path unfinished = scenes() / ".unfinished";
  const fs::path finished = scenes() / bop_number(next_);
  std::error_code error;
  fs::remove_all(unfinished, error);
  if (Status made = make_folder(unfinished); !made.ok()) return made;
  if (Status filled = fill(unfinished); !filled.ok()) {
    fs::remove_all(unfinished, error);
    return filled;
  }
  fs::rename(unfinished, finished, error);
  if (error) return cannot_write(finished, error);
  recordings_.push_back({next_, bytes_below(finished), parts});
  next_ = next_ % largest_number + 1;
  forget_oldest();
  if (Status written = write_targets(); !written.ok()) return written;
  return finished;
}

void RecordFolder::forget_oldest() {
  std::size_t bytes = 0;
  for (const Recording& recording : recordings_) bytes += recording.bytes;
  std::size_t gone = 0;
  while (gone < recordings_.size() && (recordings_.size() - gone > static_cast<std::size_t>(settings_.maximum_frames) ||
                                       bytes > settings_.maximum_bytes)) {
    std::error_code ignored;
    fs::remove_all(scenes() / bop_number(recordings_[gone].number), ignored);
    bytes -= recordings_[gone].bytes;
    ++gone;
  }
  recordings_.erase(recordings_.begin(), recordings_.begin() + static_cast<std::ptrdiff_t>(gone));
}

Status RecordFolder::write_targets() const {
  nlohmann::json targets = nlohmann::json::array();
  for (const Recording& recording : recordings_) {
    for (const std::uint32_t part : recording.parts) {
      targets.push_back({{"scene_id", recording.number}, {"im_id", 0}, {"obj_id", part}, {"inst_count", 1}});
    }
  }
  return write_file(fs::path(settings_.folder) / "recorded_targets_bop19.json", targets.dump(1) + "\n");
}

}  // namespace graspd
