#pragma once

#include <span>
#include <string>
#include <string_view>

namespace graspd {

/// The one of `known` that `word` is most likely a slip of, or an empty string when none is near.
[[nodiscard]] std::string nearest_word(std::string_view word, std::span<const std::string> known);

}  // namespace graspd
