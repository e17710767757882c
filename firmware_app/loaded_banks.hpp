#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/bank/bank.hpp"
#include "core/status.hpp"
#include "drivers/files/resident_file.hpp"

namespace graspd {

/// Banks read from their files, in the order in which they were named.
struct LoadedBanks {
  std::vector<std::string> paths;
  std::vector<ResidentFile> files;
  std::vector<Bank> banks;  ///< Spans into `files`.

  [[nodiscard]] std::size_t bytes() const;
};

/// Reads and checks every bank. Fails with bad_bank and the first file that is wrong, and when two banks
/// carry the same part number: the PLC could not tell them apart.
[[nodiscard]] Result<LoadedBanks> load_banks(std::span<const std::string> paths);

}  // namespace graspd
