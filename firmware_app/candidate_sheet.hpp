#pragma once

#include "core/bank/bank.hpp"
#include "core/train/bank_builder.hpp"
#include "drivers/files/picture.hpp"

namespace graspd {

/// Every candidate view of a build side by side, those kept first, each with what was merged into it behind: what it
/// shows, how complete it is, where it comes from, and what became of it and why.
[[nodiscard]] Picture draw_candidate_sheet(const BankPart& part, const BankReport& report);

/// The rotation that turns a view's direction towards the reader, with the part's z upwards where it can.
[[nodiscard]] Matrix3 sheet_from_part(const Vector3& direction);

/// Light on a surface with this normal, in the frame of the sheet.
[[nodiscard]] Colour shaded(const Vector3& normal_on_sheet);

}  // namespace graspd
