#pragma once

#include <span>
#include <string>

#include "core/train/bank_builder.hpp"
#include "drivers/files/bop_dataset.hpp"
#include "firmware_app/bank_adaptation.hpp"

namespace CLI {
class App;
}

namespace graspd {

/// What `bank compile` and `bank learn` share on the command line.
struct BankSwitches {
  bool without_refinement = false;
  std::string generalisation = "fuse";
  bool full_model = false;
  int model_points = 0;
  std::string picture;
  AdaptationSwitches adaptation;

  /// Lays what was asked for over the part file's own parameters.
  void apply(BankBuildParameters& build) const;
};
void add_bank_switches(CLI::App& command, BankSwitches& switches);

/// Makes the folder for the banks of a data set unless it is there. Fails with cannot_write.
[[nodiscard]] Status make_bank_folder(const std::string& folder);

/// A BOP model as a part: symmetries from models_info.json, named obj_000001 and so on.
[[nodiscard]] Result<PartDescription> part_from_bop(const BopModel& model);

/// Reads the bank back, writes it to `path`, draws the report when `picture` names a file, and prints what became of
/// the candidates.
[[nodiscard]] Status write_bank_file(const std::string& path, std::span<const std::byte> bytes,
                                     const BankReport& report, const std::string& picture);

}  // namespace graspd
