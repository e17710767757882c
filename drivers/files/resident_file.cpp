#include "drivers/files/resident_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "drivers/files/file_descriptor.hpp"

namespace graspd {

namespace {

void unmap(std::span<const std::byte> bytes) {
  if (!bytes.empty()) ::munmap(const_cast<std::byte*>(bytes.data()), bytes.size());
}

/// Fills `target`; 0, the error's number, or ENODATA when the file ends before.
int read_whole(int file, std::span<std::byte> target) {
  while (!target.empty()) {
    const ssize_t count = ::read(file, target.data(), target.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    if (count == 0) return ENODATA;
    target = target.subspan(static_cast<std::size_t>(count));
  }
  return 0;
}

}  // namespace

Result<ResidentFile> ResidentFile::open(const std::filesystem::path& path, StatusCode code) {
  const auto failure = [&](const std::string& reason) {
    return Status::format(code, "cannot read %s: %s", path.c_str(), reason.c_str());
  };
  const auto words = [](int error) { return std::generic_category().message(error); };
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.valid()) return failure(words(errno));
  struct stat state = {};
  if (::fstat(file.number(), &state) != 0) return failure(words(errno));
  if (!S_ISREG(state.st_mode)) return failure("it is not a file");
  if (state.st_size == 0) return failure("the file is empty");
  const auto size = static_cast<std::size_t>(state.st_size);
  void* const place = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (place == MAP_FAILED) return failure(words(errno));
  const std::span pages(static_cast<std::byte*>(place), size);
  ResidentFile read(pages);
  const int error = read_whole(file.number(), pages);
  if (error == ENODATA) return failure("it is being written: try again");
  if (error != 0) return failure(words(error));
  ::mprotect(place, size, PROT_READ);
  return read;
}

ResidentFile::ResidentFile(ResidentFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

ResidentFile& ResidentFile::operator=(ResidentFile&& other) noexcept {
  if (this != &other) {
    unmap(bytes_);
    bytes_ = std::exchange(other.bytes_, {});
  }
  return *this;
}

ResidentFile::~ResidentFile() { unmap(bytes_); }

}  // namespace graspd
