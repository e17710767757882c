#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/train/bank_builder.hpp"
#include "drivers/files/atomic_file.hpp"
#include "drivers/files/bop_dataset.hpp"
#include "drivers/files/mesh_file.hpp"
#include "firmware_app/bank_output.hpp"
#include "firmware_app/commands.hpp"
#include "firmware_app/part_file.hpp"
#include "firmware_app/progress_bar.hpp"

namespace graspd {
namespace {

struct CompileOptions {
  std::string part_file;
  std::string bop_root;
  std::string output;
  BankSwitches switches;
};

/// A bank that is to be made.
struct CompileOrder {
  PartDescription part;
  BankBuildParameters build;
  bool sampling_given = false;
  bool edges_given = false;
  std::string mesh_file;  ///< Stands in complaints.
  std::string output;
  std::string label;  ///< On the progress bar.
  std::string picture;
};

Result<std::vector<std::byte>> compiled(CompileOrder& order, const AdaptationSwitches& adaptation, BankReport& report) {
  ProgressBar bar;
  if (!order.sampling_given && order.build.model_points == 0) {
    const Status adapted = adapt_to_part(order.part, adaptation, order.edges_given, order.label, bar, order.build);
    if (!adapted.ok()) return adapted;
  }
  Result<std::vector<std::byte>> bytes =
      build_bank(order.part, order.build, report, [&](float share) { bar.show(order.label, share); });
  if (!bytes.ok()) return bytes;
  return with_expectation(std::move(bytes).value(), order.build, adaptation, order.label, bar);
}

/// Builds one bank and writes it.
Status compile_one(CompileOrder order, const BankSwitches& switches) {
  switches.apply(order.build);
  BankReport report;
  const Result<std::vector<std::byte>> bytes = compiled(order, switches.adaptation, report);
  if (!bytes.ok()) {
    const std::string_view message = bytes.status().message();
    return Status::format(bytes.status().code(), "%s: %.*s", order.mesh_file.c_str(), static_cast<int>(message.size()),
                          message.data());
  }
  return write_bank_file(order.output, bytes.value(), report, order.picture);
}

Status compile_part_file(const CompileOptions& options) {
  Result<PartFile> file = read_part_file(options.part_file);
  if (!file.ok()) return file.status();
  if (Status writable = check_writable(options.output); !writable.ok()) return writable;
  PartFile& part_file = file.value();
  Result<Mesh> mesh = read_mesh(part_file.mesh_path, part_file.mesh_unit);
  if (!mesh.ok()) return mesh.status();
  part_file.part.mesh = std::move(mesh).value();
  const std::string name = part_file.part.name;
  return compile_one({std::move(part_file.part), part_file.build, part_file.sampling_given, part_file.edges_given,
                      part_file.mesh_path, options.output, name, options.switches.picture},
                     options.switches);
}

Status compile_bop(const CompileOptions& options) {
  const Result<std::vector<BopModel>> models = read_bop_models(options.bop_root);
  if (!models.ok()) return models.status();
  if (Status made = make_bank_folder(options.output); !made.ok()) return made;
  std::size_t done = 0;
  for (const BopModel& model : models.value()) {
    Result<PartDescription> part = part_from_bop(model);
    if (!part.ok()) return part.status();
    const std::string name = part.value().name;
    const std::string output = (std::filesystem::path(options.output) / (name + ".bank")).string();
    if (Status writable = check_writable(output); !writable.ok()) return writable;
    ++done;
    const std::string label = name + " (" + std::to_string(done) + " of " + std::to_string(models.value().size()) + ")";
    CompileOrder order{std::move(part).value(), {}, false, false, model.mesh_file.string(), output, label, {}};
    if (Status made = compile_one(std::move(order), options.switches); !made.ok()) return made;
  }
  return {};
}

}  // namespace

void add_bank_compile_command(CLI::App& bank_command, Status& outcome) {
  auto options = std::make_shared<CompileOptions>();
  CLI::App* command = bank_command.add_subcommand("compile", "Make a bank from a part's CAD file");
  CLI::Option* part = command->add_option("PART", options->part_file, "Part file; configs/part.toml explains its keys");
  CLI::Option* bop =
      command->add_option("--bop", options->bop_root, "Make a bank for each model of the BOP data set in this folder");
  part->excludes(bop);
  command->add_option("-o,--output", options->output, "The bank; with --bop the folder for the banks")->required();
  add_bank_switches(*command, options->switches);
  // One picture cannot show the views of many parts.
  bop->excludes(command->get_option("--picture"));
  command->footer(
      "Only CAD is read, no frames. Symmetries come from the part file (with --bop from\n"
      "models_info.json); when a part file has no [symmetry], they are looked for and reported.\n"
      "Unless the part file says how to sample the part, the compiler adapts that: it tries several\n"
      "samplings in simulated bins of the part and takes the one that finds most for its cost, then\n"
      "whether poses are better not judged by their outlines. What the bank finds in other bins is\n"
      "stored in it; graspd bank show prints it.\n"
      "\n"
      "Examples:\n"
      "  graspd bank compile bushing.toml -o bushing.bank\n"
      "  graspd bank compile --bop /data/synth_dev -o banks     makes banks/obj_000001.bank ...");
  command->callback([options, part, bop, &outcome] {
    if (part->count() + bop->count() == 0) {
      outcome = Status(StatusCode::usage, "bank compile needs a part file or --bop; see graspd bank compile --help");
    } else {
      outcome = bop->count() > 0 ? compile_bop(*options) : compile_part_file(*options);
    }
  });
}

}  // namespace graspd
