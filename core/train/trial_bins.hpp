#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/bank/bank.hpp"
#include "core/evaluate/image_evaluation.hpp"
#include "core/evaluate/summary.hpp"
#include "core/status.hpp"
#include "core/train/simulated_scene.hpp"

namespace graspd {

/// How the simulated bins are made on which banks of a part are tried.
struct TrialRecipe {
  std::size_t instances = 12;     ///< In one bin.
  float sensor_distance = 0.75F;  ///< Metres to the bin's floor; large parts are looked at from farther away.
  int maximum_width = 800;        ///< Pixels of a frame.
  int maximum_height = 600;
  int threads = 1;  ///< The result does not depend on them.
};

/// A part as the bins and the judging need it, out of any bank of it.
struct TrialPart {
  SimulatedPart simulated;
  EvaluationPart evaluation;
  bool closed = false;  ///< Its mesh has no open edges.
};

/// Fails with bad_file when the bank's mesh cannot be piled up.
[[nodiscard]] Result<TrialPart> trial_part(const Bank& bank);

/// Bins number `first` to `first` + `count` - 1 of the part. Of every five, one strains the sensor little, two strain
/// it as most bins do, two hard. The same number is always the same bin.
[[nodiscard]] std::vector<SimulatedScene> trial_bins(const TrialPart& part, std::size_t first, std::size_t count,
                                                     const TrialRecipe& recipe);

/// Bins of what is not the part but looks much like it: the same shape in other sizes and proportions. Whatever is
/// reported in them is wrong. Their instances have the part numbers from 1.
[[nodiscard]] std::vector<SimulatedScene> stranger_bins(const TrialPart& part, std::size_t count,
                                                        const TrialRecipe& recipe);

/// What became of a bank in one or more bins.
struct TrialOutcome {
  std::array<Share, visibility_class_count> found;  ///< Of the instances of each class that are to be found at all.
  Share precision;                                  ///< Of all reported, right: MSSD below right_pose_error.

  TrialOutcome& operator+=(const TrialOutcome& other);
};

/// Detects with `bank` in each of `bins` and counts. Calls `done` after each. Fails as detect() does.
[[nodiscard]] Result<TrialOutcome> try_bank(const Bank& bank, const TrialPart& part, std::span<SimulatedScene> bins,
                                            int threads, const std::function<void()>& done);

}  // namespace graspd
