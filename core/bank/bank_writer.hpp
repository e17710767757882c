#pragma once

#include <cstddef>
#include <vector>

#include "core/bank/bank.hpp"

namespace graspd {

/// The bytes of the file that read_bank turns back into `bank`. The same bank gives the same bytes.
[[nodiscard]] std::vector<std::byte> write_bank(const Bank& bank);

}  // namespace graspd
