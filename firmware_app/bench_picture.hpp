#pragma once

#include "drivers/files/picture.hpp"
#include "firmware_app/bench.hpp"

namespace graspd {

/// Draws times, memory and, when measured, growth and deadlines on one sheet.
[[nodiscard]] Picture draw_bench(const Bench& bench);

}  // namespace graspd
