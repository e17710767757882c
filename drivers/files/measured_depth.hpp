#pragma once

#include <filesystem>
#include <span>

#include "core/status.hpp"

namespace graspd {

/// The median of the depths that are measured, in metres; 0 when none is.
[[nodiscard]] float median_depth(std::span<const float> depth);

/// Whether bins stand at such a depth (metres): else a unit was mistaken.
[[nodiscard]] inline bool is_bin_distance(float depth) { return depth >= 0.02F && depth <= 50.0F; }

/// Fails with bad_frame, naming `path`, when nothing of `depth` (metres) is measured or its median is not one at which
/// bins stand.
[[nodiscard]] Status check_measured(std::span<const float> depth, const std::filesystem::path& path);

}  // namespace graspd
