#pragma once

#include "core/evaluate/reliability.hpp"
#include "drivers/files/picture.hpp"

namespace graspd {

/// Draws the share that is right over the score; on the diagonal, a score is the probability of being right.
[[nodiscard]] Picture draw_reliability(const Reliability& reliability);

}  // namespace graspd
