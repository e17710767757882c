#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/train/adaptation.hpp"
#include "firmware_app/progress_bar.hpp"

namespace CLI {
class App;
}

namespace graspd {

/// How `bank compile` and `bank learn` adapt banks, as asked for on the command line.
struct AdaptationSwitches {
  bool without = false;
  int effort = 1;   ///< Multiplies the simulated bins.
  int threads = 0;  ///< 0: one for each processor.

  [[nodiscard]] int thread_count() const;
  [[nodiscard]] AdaptationParameters parameters(const BankBuildParameters& build) const;
};
void add_adaptation_switches(CLI::App& command, AdaptationSwitches& switches);

/// Chooses in `build` how the part is sampled and whether edges judge, and prints what was tried. Does nothing when
/// adaptation is off.
[[nodiscard]] Status adapt_to_part(const PartDescription& part, const AdaptationSwitches& switches, bool edges_given,
                                   const std::string& label, ProgressBar& bar, BankBuildParameters& build);

/// The bank with what can be expected of it; as it is when adaptation is off.
[[nodiscard]] Result<std::vector<std::byte>> with_expectation(std::vector<std::byte> file,
                                                              const BankBuildParameters& build,
                                                              const AdaptationSwitches& switches,
                                                              const std::string& label, ProgressBar& bar);

/// What a bank is expected to find, in one line.
[[nodiscard]] std::string expectation_text(const BankExpectation& expected);

}  // namespace graspd
