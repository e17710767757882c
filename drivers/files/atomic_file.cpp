#include "drivers/files/atomic_file.hpp"

#include <fcntl.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include "drivers/files/file_descriptor.hpp"

namespace graspd {

namespace {

namespace fs = std::filesystem;

Status cannot_write(const fs::path& path, int error) {
  const std::string reason = std::generic_category().message(error);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code ignored;
  if (error == ENOENT && !fs::exists(folder, ignored)) {
    return Status::format(StatusCode::cannot_write, "cannot write %s: %s: create the folder %s first", path.c_str(),
                          reason.c_str(), folder.c_str());
  }
  return Status::format(StatusCode::cannot_write, "cannot write %s: %s", path.c_str(), reason.c_str());
}

/// 0, or the error's number.
int write_all(int file, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return 0;
}

/// What a link stands for, whether it is there or not.
fs::path followed(const fs::path& path) {
  constexpr int longest_chain = 40;
  std::error_code ignored;
  fs::path target = path;
  for (int i = 0; i < longest_chain && fs::is_symlink(target, ignored); ++i) {
    target = target.parent_path() / fs::read_symlink(target, ignored);
  }
  return target;
}

/// Devices and pipes (/dev/stdout) cannot be renamed over: they are written to.
Status write_to_device(const fs::path& path, std::span<const std::byte> bytes) {
  FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!file.valid()) return cannot_write(path, errno);
  const int error = write_all(file.number(), bytes);
  return error == 0 ? Status() : cannot_write(path, error);
}

int write_and_rename(const fs::path& temporary, const fs::path& target, std::span<const std::byte> bytes) {
  FileDescriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (!file.valid()) return errno;
  int error = write_all(file.number(), bytes);
  if (error == 0 && ::fsync(file.number()) != 0) error = errno;
  if (!file.close() && error == 0) error = errno;
  if (error == 0 && std::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) ::unlink(temporary.c_str());
  return error;
}

}  // namespace

Status write_file(const fs::path& path, std::span<const std::byte> bytes) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) return cannot_write(path, EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_to_device(path, bytes);

  // A link keeps standing: what it points to is replaced.
  const fs::path target = followed(path);
  if (target.filename().empty()) return cannot_write(path, ENOENT);
  fs::path temporary = target;
  temporary.replace_filename("." + target.filename().string() + "." + std::to_string(::getpid()) + ".tmp");
  const int error = write_and_rename(temporary, target, bytes);
  if (error != 0) return cannot_write(path, error);

  // Without this a power cut could still undo the rename.
  const FileDescriptor folder(::open(target.has_parent_path() ? target.parent_path().c_str() : ".", O_RDONLY));
  if (folder.valid()) ::fsync(folder.number());
  return {};
}

Status write_file(const fs::path& path, std::string_view text) {
  return write_file(path, std::as_bytes(std::span(text)));
}

Status make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return {};
  return Status::format(StatusCode::cannot_write, "%s: cannot be made: %s", folder.c_str(), error.message().c_str());
}

Status check_writable(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) return cannot_write(path, EISDIR);
  if (fs::exists(status) && ::access(path.c_str(), W_OK) != 0) return cannot_write(path, errno);
  if (fs::exists(status) && !fs::is_regular_file(status)) return {};
  // A file is not written to but replaced, so its folder must let one be made.
  const fs::path target = followed(path);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::exists(folder, ignored)) return cannot_write(path, ENOENT);
  if (!fs::is_directory(folder, ignored)) return cannot_write(path, ENOTDIR);
  if (::access(folder.c_str(), W_OK | X_OK) != 0) return cannot_write(path, errno);
  return {};
}

Status check_folder(const fs::path& folder) {
  std::error_code ignored;
  fs::path place = fs::absolute(folder, ignored);
  while (!fs::exists(place, ignored) && place.has_relative_path()) place = place.parent_path();
  if (!fs::is_directory(place, ignored)) return cannot_write(folder, ENOTDIR);
  if (::access(place.c_str(), W_OK | X_OK) != 0) return cannot_write(folder, errno);
  return {};
}

}  // namespace graspd
