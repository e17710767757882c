#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "drivers/files/picture.hpp"
#include "firmware_app/bank_adaptation.hpp"
#include "firmware_app/commands.hpp"
#include "firmware_app/contact_sheet.hpp"
#include "firmware_app/loaded_banks.hpp"

namespace graspd {
namespace {

struct ShowOptions {
  std::string bank;
  std::string picture;
};

double millimetres(float metres) { return static_cast<double>(metres) * 1000.0; }
double kibibytes(std::size_t bytes) { return static_cast<double>(bytes) / 1024.0; }

void print_part(const Bank& bank) {
  const BankPart& part = *bank.part;
  std::printf("part        %.*s, number %u\n", static_cast<int>(part.name_view().size()), part.name_view().data(),
              part.part_id);
  const Vector3 size = part.box_max - part.box_min;
  std::printf("size        %.1f x %.1f x %.1f mm, diameter %.1f mm\n", millimetres(size.x()), millimetres(size.y()),
              millimetres(size.z()), millimetres(part.diameter));
  std::printf("symmetry    %zu discrete poses%s\n", bank.symmetry_discrete.size(),
              part.symmetry_continuous != 0 ? ", any turn about an axis" : "");
  std::printf("sampling    %.2f mm, poses are judged at %.2f mm\n", millimetres(part.sampling),
              millimetres(part.detail));
  const VerifyThresholds& limits = part.thresholds;
  std::printf("thresholds  score %.2f, overlap %.2f, boundary %.2f, edge %.2f, below %.2f\n",
              static_cast<double>(limits.minimum_score), static_cast<double>(limits.minimum_overlap),
              static_cast<double>(limits.maximum_boundary), static_cast<double>(limits.minimum_edge),
              static_cast<double>(limits.maximum_below));
  std::printf("edges       %s, %s\n", part.edges_refine != 0 ? "refine poses" : "do not refine poses",
              part.edges_judge != 0 ? "judge them" : "do not judge them");
  std::printf("expected    %s\n", expectation_text(part.expected).c_str());
}

template <class T>
void print_section(const char* name, std::span<const T> section) {
  std::printf("%-20s %10zu %12.1f\n", name, section.size(), kibibytes(section.size_bytes()));
}

void print_sections(const Bank& bank, std::size_t file_bytes) {
  std::printf("\n%-20s %10s %12s\n", "section", "count", "KiB");
  print_section("views", bank.views);
  print_section("view points", bank.view_points);
  print_section("references", bank.reference_points);
  print_section("PPF cells", bank.cell_offsets);
  print_section("PPF entries", bank.entries);
  print_section("surface points", bank.surface);
  print_section("edge points", bank.edges);
  print_section("visibility", bank.visibility.bits);
  print_section("mesh vertices", bank.mesh.vertices);
  print_section("mesh triangles", bank.mesh.triangles);
  print_section("symmetry poses", bank.symmetry_discrete);
  print_section("twins", bank.twins);
  print_section("grasps", bank.grasps);
  std::printf("%-20s %10s %12.1f\n", "file", "", kibibytes(file_bytes));
}

void print_views(const Bank& bank) {
  std::printf("\n%-6s %24s %8s %11s %13s\n", "view", "direction", "points", "references", "completeness");
  for (std::size_t i = 0; i < bank.views.size(); ++i) {
    const BankView& view = bank.views[i];
    std::printf("%-6zu %8.3f%8.3f%8.3f %8u %11u %12.0f%%\n", i, static_cast<double>(view.direction.x()),
                static_cast<double>(view.direction.y()), static_cast<double>(view.direction.z()), view.point_count,
                view.reference_count, static_cast<double>(view.completeness) * 100.0);
  }
}

Status show(const ShowOptions& options) {
  const Result<LoadedBanks> loaded = load_banks(std::span(&options.bank, 1));
  if (!loaded.ok()) return loaded.status();
  const Bank& bank = loaded.value().banks.front();
  print_part(bank);
  print_sections(bank, loaded.value().bytes());
  print_views(bank);
  if (options.picture.empty()) return {};
  return write_picture(options.picture, draw_contact_sheet(bank));
}

}  // namespace

void add_bank_show_command(CLI::App& bank_command, Status& outcome) {
  auto options = std::make_shared<ShowOptions>();
  CLI::App* command = bank_command.add_subcommand("show", "Show what a bank holds");
  command->add_option("BANK", options->bank, "Bank file")->required();
  command->add_option("--picture", options->picture, "Write the views side by side into this PNG");
  command->footer(
      "Prints the part, the memory that each section takes, and every view.\n"
      "\n"
      "Example:\n"
      "  graspd bank show bushing.bank --picture views.png");
  command->callback([options, &outcome] { outcome = show(*options); });
}

}  // namespace graspd
