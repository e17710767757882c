#include "drivers/files/whole_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <system_error>

#include "drivers/files/file_descriptor.hpp"

namespace graspd {

namespace {

constexpr off_t largest_file = off_t{2} << 30U;

}  // namespace

Result<std::string> read_file(const std::filesystem::path& path, StatusCode code) {
  const auto failure = [&](int error) {
    return Status::format(code, "cannot read %s: %s", path.c_str(), std::generic_category().message(error).c_str());
  };
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.valid()) return failure(errno);
  struct stat state = {};
  if (::fstat(file.number(), &state) != 0) return failure(errno);
  if (S_ISDIR(state.st_mode)) return failure(EISDIR);
  // Devices need not have an end.
  if (S_ISCHR(state.st_mode) || S_ISBLK(state.st_mode)) {
    return Status::format(code, "cannot read %s: it is not a file", path.c_str());
  }
  const Status too_large = Status::format(code, "cannot read %s: it holds more than 2 GiB", path.c_str());
  if (state.st_size > largest_file) return too_large;

  std::string bytes(static_cast<std::size_t>(state.st_size), '\0');
  std::size_t filled = 0;
  while (true) {
    if (filled > static_cast<std::size_t>(largest_file)) return too_large;
    // A pipe tells no size, so the string grows as long as something comes.
    if (filled == bytes.size()) bytes.resize(bytes.size() + 4096);
    const ssize_t count = ::read(file.number(), bytes.data() + filled, bytes.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return failure(errno);
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  bytes.resize(filled);
  return bytes;
}

}  // namespace graspd
