#include "firmware_app/bank_output.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <utility>

#include "drivers/files/atomic_file.hpp"
#include "drivers/files/mesh_file.hpp"
#include "firmware_app/candidate_sheet.hpp"

namespace graspd {
namespace {

void print_report(const std::string& path, std::size_t bytes, const BankPart& part, const BankReport& report) {
  std::printf(
      "%s: %.1f MiB; %d views rendered, %d cut out of frames, %d kept, %d fused into them, %d merged, "
      "dropped: %d incomplete, "
      "%d degenerate\n",
      path.c_str(), static_cast<double>(bytes) / (1024.0 * 1024.0), report.views_rendered, report.views_cut_out,
      report.views_kept, report.views_fused, report.views_merged - report.views_fused, report.views_incomplete,
      report.views_degenerate);
  const Vector3 size = 1000.0F * (part.box_max - part.box_min);
  std::printf("  size %.1f x %.1f x %.1f mm\n", static_cast<double>(size.x()), static_cast<double>(size.y()),
              static_cast<double>(size.z()));
  if (!report.resting.empty()) {
    const RestingPose& first = report.resting.front();
    std::printf("  %zu resting poses; in the most frequent (%.0f%%) this points down: (%.2f, %.2f, %.2f)\n",
                report.resting.size(), static_cast<double>(first.share) * 100.0, static_cast<double>(first.down.x()),
                static_cast<double>(first.down.y()), static_cast<double>(first.down.z()));
  }
  if (part.expected.instances > 0) std::printf("  expected: %s\n", expectation_text(part.expected).c_str());
  for (const std::string& remark : report.remarks) std::printf("  %s\n", remark.c_str());
  std::fflush(stdout);
}

}  // namespace

void BankSwitches::apply(BankBuildParameters& build) const {
  build.refinement = !without_refinement;
  build.full_model = full_model;
  build.model_points = model_points;
  build.generalisation = generalisation == "none"     ? Generalisation::none
                         : generalisation == "smooth" ? Generalisation::smooth
                                                      : Generalisation::fuse;
}

void add_bank_switches(CLI::App& command, BankSwitches& switches) {
  command.add_flag("--no-refinement", switches.without_refinement,
                   "Keep evenly spread views as they are: nothing dropped, nothing merged");
  command
      .add_option("--generalisation", switches.generalisation,
                  "Fuse each view with those that it stands for, smooth it alone, or take it as it is")
      ->capture_default_str()
      ->check(CLI::IsMember({"fuse", "smooth", "none"}));
  command.add_flag("--full-model", switches.full_model, "Make one view of the whole part, in place of many");
  command
      .add_option("--model-points", switches.model_points,
                  "Sample so that the whole surface makes about so many points (else by the share of the diameter)")
      ->check(CLI::Range(50, 20000));
  command.add_option("--picture", switches.picture, "Write every candidate view, and what became of it, into this PNG");
  add_adaptation_switches(command, switches.adaptation);
}

Status make_bank_folder(const std::string& folder) {
  const Status made = make_folder(folder);
  if (made.ok()) return made;
  return {made.code(), std::string(made.message()) + "; choose another folder with -o"};
}

Result<PartDescription> part_from_bop(const BopModel& model) {
  Result<Mesh> mesh = read_mesh(model.mesh_file, LengthUnit::millimetres);
  if (!mesh.ok()) return mesh.status();
  PartDescription part;
  char name[32];
  std::snprintf(name, sizeof name, "obj_%06d", model.obj_id);
  part.name = name;
  part.part_id = static_cast<std::uint32_t>(model.obj_id);
  part.mesh = std::move(mesh).value();
  part.symmetry_given = true;
  part.symmetry_discrete = model.symmetry_discrete;
  part.symmetry_continuous = !model.symmetry_continuous.empty();
  if (part.symmetry_continuous) part.symmetry_axis = model.symmetry_continuous.front();
  return part;
}

Status write_bank_file(const std::string& path, std::span<const std::byte> bytes, const BankReport& report,
                       const std::string& picture) {
  const Result<Bank> bank = read_bank(bytes, path);
  if (!bank.ok()) {
    return Status::format(StatusCode::internal, "the bank that was made cannot be read back: %.*s",
                          static_cast<int>(bank.status().message().size()), bank.status().message().data());
  }
  if (Status written = write_file(path, bytes); !written.ok()) return written;
  print_report(path, bytes.size(), *bank.value().part, report);
  if (picture.empty()) return {};
  return write_picture(picture, draw_candidate_sheet(*bank.value().part, report));
}

}  // namespace graspd
