#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace graspd {

inline constexpr std::size_t unmatched = static_cast<std::size_t>(-1);

/// Matches estimates to ground truths one to one, as BOP'19 does: in the order given (best score
/// first), each estimate takes the `usable` truth that is still free and has the smallest error, if that
/// is below `threshold`. `error(estimate, truth)` tells the error. Returns, for each estimate, the
/// truth it took or `unmatched`.
[[nodiscard]] std::vector<std::size_t> match_greedily(std::size_t estimates, const std::vector<bool>& usable,
                                                      double threshold,
                                                      const std::function<double(std::size_t, std::size_t)>& error);

}  // namespace graspd
