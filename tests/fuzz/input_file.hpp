#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace graspd::fuzz {

/// A fuzzer's input as a file in memory, for readers that take a path; gone with this object.
class InputFile {
 public:
  /// `extension` ends the file's name (".toml").
  InputFile(const std::uint8_t* data, std::size_t size, const char* extension)
      : path_("/dev/shm/graspd-fuzz-" + std::to_string(getpid()) + extension) {
    const int descriptor = open(path_.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0600);
    if (descriptor < 0 || write(descriptor, data, size) != static_cast<ssize_t>(size) || close(descriptor) != 0) {
      std::abort();
    }
  }
  ~InputFile() { unlink(path_.c_str()); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace graspd::fuzz
