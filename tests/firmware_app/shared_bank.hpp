#pragma once

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "drivers/files/atomic_file.hpp"
#include "drivers/files/whole_file.hpp"
#include "tests/firmware_app/rendered_scene.hpp"

namespace graspd {

/// The bank of the angle bar, made by the first test that asks for it and kept beside the program: each test may be a
/// run of its own, and under the sanitizers a bank takes longer than most of them. A program that was built anew makes
/// it anew.
inline const std::vector<std::byte>& shared_angle_bar_bank() {
  static const std::vector<std::byte> bytes = [] {
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
    const std::filesystem::path kept = program.string() + ".angle_bar.bank";
    std::error_code missing;
    if (std::filesystem::last_write_time(kept, missing) > std::filesystem::last_write_time(program) && !missing) {
      if (const Result<std::string> file = read_file(kept); file.ok()) {
        std::vector<std::byte> read(file.value().size());
        std::memcpy(read.data(), file.value().data(), read.size());
        return read;
      }
    }
    std::vector<std::byte> made = angle_bar_bank();
    // Where it cannot be kept, the next test makes it again.
    static_cast<void>(write_file(kept, made));
    return made;
  }();
  return bytes;
}

}  // namespace graspd
