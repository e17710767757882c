#pragma once

#include <cstddef>

#include "core/grasp/workspace.hpp"

namespace graspd {

/// Asks an instance of the workspace's choice for its candidates, and gives it an even share of the checks that are
/// left: what one search does not use goes to those that begin after it.
void begin_search(GraspWorkspace& workspace, std::size_t instance);

/// Looks the next candidate of an instance whose search has begun up in the frame. They come in the order of the value
/// that they would have with all the clearance that counts, so the search settles at the first that could not be better
/// even so.
void check_next(GraspWorkspace& workspace, std::size_t instance);

}  // namespace graspd
