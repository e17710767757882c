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
#include "firmware_app/commands.hpp"
#include "firmware_app/part_file.hpp"
#include "firmware_app/progress_bar.hpp"

namespace graspd {
namespace {

struct CompileOptions {
  std::string part_file;
  std::string bop_root;
  std::string output;
};

void print_report(const std::string& path, std::size_t bytes, const BankReport& report) {
  std::printf("%s: %.1f MiB; %d views rendered, %d kept, %d merged, dropped: %d incomplete, %d degenerate\n",
              path.c_str(), static_cast<double>(bytes) / (1024.0 * 1024.0), report.views_rendered, report.views_kept,
              report.views_merged, report.views_incomplete, report.views_degenerate);
  for (const std::string& remark : report.remarks) std::printf("  %s\n", remark.c_str());
  std::fflush(stdout);
}

/// Builds one bank and writes it. `mesh_file` stands in complaints, `label` on the progress bar.
Status compile_one(const PartDescription& part, const BankBuildParameters& build, const std::string& mesh_file,
                   const std::string& output, const std::string& label) {
  BankReport report;
  ProgressBar bar;
  const Result<std::vector<std::byte>> bytes =
      build_bank(part, build, report, [&](float share) { bar.show(label, share); });
  bar.clear();
  if (!bytes.ok()) {
    const std::string_view message = bytes.status().message();
    return Status::format(bytes.status().code(), "%s: %.*s", mesh_file.c_str(), static_cast<int>(message.size()),
                          message.data());
  }
  if (const Result<Bank> bank = read_bank(bytes.value(), output); !bank.ok()) {
    return Status::format(StatusCode::internal, "the bank that was made cannot be read back: %.*s",
                          static_cast<int>(bank.status().message().size()), bank.status().message().data());
  }
  if (Status written = write_file(output, bytes.value()); !written.ok()) return written;
  print_report(output, bytes.value().size(), report);
  return {};
}

Status compile_part_file(const CompileOptions& options) {
  Result<PartFile> file = read_part_file(options.part_file);
  if (!file.ok()) return file.status();
  if (Status writable = check_writable(options.output); !writable.ok()) return writable;
  PartFile& part_file = file.value();
  Result<Mesh> mesh = read_mesh(part_file.mesh_path, part_file.mesh_unit);
  if (!mesh.ok()) return mesh.status();
  part_file.part.mesh = std::move(mesh).value();
  return compile_one(part_file.part, part_file.build, part_file.mesh_path, options.output, part_file.part.name);
}

Result<PartDescription> describe(const BopModel& model, const std::string& name) {
  Result<Mesh> mesh = read_mesh(model.mesh_file, LengthUnit::millimetres);
  if (!mesh.ok()) return mesh.status();
  PartDescription part;
  part.name = name;
  part.part_id = static_cast<std::uint32_t>(model.obj_id);
  part.mesh = std::move(mesh).value();
  part.symmetry_given = true;
  part.symmetry_discrete = model.symmetry_discrete;
  part.symmetry_continuous = !model.symmetry_continuous.empty();
  if (part.symmetry_continuous) part.symmetry_axis = model.symmetry_continuous.front();
  return part;
}

Status compile_bop(const CompileOptions& options) {
  const Result<std::vector<BopModel>> models = read_bop_models(options.bop_root);
  if (!models.ok()) return models.status();
  std::error_code error;
  std::filesystem::create_directories(options.output, error);
  if (error) {
    return Status::format(StatusCode::cannot_write, "%s: cannot be made: %s; choose another folder with -o",
                          options.output.c_str(), error.message().c_str());
  }
  std::size_t done = 0;
  for (const BopModel& model : models.value()) {
    char name[32];
    std::snprintf(name, sizeof name, "obj_%06d", model.obj_id);
    const std::string output = (std::filesystem::path(options.output) / (std::string(name) + ".bank")).string();
    if (Status writable = check_writable(output); !writable.ok()) return writable;
    const Result<PartDescription> part = describe(model, name);
    if (!part.ok()) return part.status();
    ++done;
    const std::string label =
        std::string(name) + " (" + std::to_string(done) + " of " + std::to_string(models.value().size()) + ")";
    if (Status compiled = compile_one(part.value(), {}, model.mesh_file.string(), output, label); !compiled.ok())
      return compiled;
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
  command->footer(
      "Only CAD is read, no frames. Symmetries come from the part file (with --bop from\n"
      "models_info.json); when a part file has no [symmetry], they are looked for and reported.\n"
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
