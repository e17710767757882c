#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/bank/bank.hpp"
#include "core/status.hpp"
#include "core/train/trial_bins.hpp"

namespace graspd {

/// The bins in which evidence is gathered, from what the vision of a bin picker is up against.
enum class BinKind : std::uint8_t {
  usual,           ///< The part alone, the empty bin is known.
  unaided,         ///< Nothing is known of a bin with thick walls.
  window,          ///< The same through a frame that cuts the pile off.
  smeared,         ///< As usual, but the sensor smears depth steps.
  smeared_window,  ///< The frame of such a sensor that cuts the pile off, the bin unknown.
  mixed,           ///< With two other parts, the empty bin is known.
  others,          ///< Other parts alone, the bin unknown.
  smeared_others,  ///< The same before a sensor that smears.
  shapes,          ///< Everyday things alone, the bin unknown.
  smeared_shapes,  ///< The same before a sensor that smears.
};
inline constexpr std::array every_bin_kind{
    BinKind::usual, BinKind::unaided, BinKind::window,         BinKind::smeared, BinKind::smeared_window,
    BinKind::mixed, BinKind::others,  BinKind::smeared_others, BinKind::shapes,  BinKind::smeared_shapes};
[[nodiscard]] const char* bin_kind_name(BinKind kind);

/// A bin, with whether its empty frame may be used. Instances of the part that is looked for have number 0.
struct EvidenceBin {
  SimulatedScene scene;
  bool empty_known = false;
};

/// Bin number `seed` of a kind for part `wanted` of `parts`, which is described by `bank`. The same arguments make the
/// same bin.
[[nodiscard]] EvidenceBin evidence_bin(BinKind kind, std::span<const TrialPart> parts, std::size_t wanted,
                                       const Bank& bank, std::uint64_t seed);

}  // namespace graspd
