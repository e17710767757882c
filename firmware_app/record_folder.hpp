#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "core/status.hpp"

namespace graspd {

/// Which requests are recorded.
enum class RecordWhen : std::uint8_t {
  failure,  ///< Those that brought no pick although the bin was not empty.
  always,   ///< All that took a frame.
};

/// [record]
struct RecordSettings {
  std::string folder;  ///< Empty: nothing is recorded.
  RecordWhen when = RecordWhen::failure;
  int maximum_frames = 200;
  std::size_t maximum_bytes = std::size_t{1} << 30U;
};

/// The folder of recordings, a data set in BOP's form: each recording is a scene of one image,
/// recorded/000001 and so on, and recorded_targets_bop19.json lists the parts that were looked for. The
/// oldest recordings go when there are more, or larger ones, than the settings allow.
class RecordFolder {
 public:
  /// Looks at what is there. Fails with cannot_write.
  [[nodiscard]] static Result<RecordFolder> open(const RecordSettings& settings);

  /// Adds a recording: `fill` writes its files into the folder that it is given; only when all are written
  /// does the recording appear. `parts` are the numbers of the parts that were looked for. Returns its folder.
  [[nodiscard]] Result<std::filesystem::path> add(const std::set<std::uint32_t>& parts,
                                                  const std::function<Status(const std::filesystem::path&)>& fill);

 private:
  struct Recording {
    int number = 0;
    std::size_t bytes = 0;
    std::set<std::uint32_t> parts;
  };

  explicit RecordFolder(const RecordSettings& settings) : settings_(settings) {}
  [[nodiscard]] std::filesystem::path scenes() const;
  void sort_by_age();
  void forget_oldest();
  [[nodiscard]] Status write_targets() const;

  RecordSettings settings_;
  std::vector<Recording> recordings_;  ///< The oldest first.
  int next_ = 1;
};

}  // namespace graspd
