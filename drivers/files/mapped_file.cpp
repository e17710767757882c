#include "drivers/files/mapped_file.hpp"

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

}  // namespace

Result<MappedFile> MappedFile::open(const std::filesystem::path& path, StatusCode code) {
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
  void* const place = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, file.number(), 0);
  if (place == MAP_FAILED) return failure(words(errno));
  return MappedFile({static_cast<const std::byte*>(place), size});
}

MappedFile::MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  if (this != &other) {
    unmap(bytes_);
    bytes_ = std::exchange(other.bytes_, {});
  }
  return *this;
}

MappedFile::~MappedFile() { unmap(bytes_); }

}  // namespace graspd
