#pragma once

#include "core/bank/bank.hpp"
#include "drivers/files/picture.hpp"

namespace graspd {

/// Every view of a bank side by side: its points as seen from the view's direction, shaded by their
/// normals, voting references marked, with number, direction, point count and completeness.
[[nodiscard]] Picture draw_contact_sheet(const Bank& bank);

}  // namespace graspd
