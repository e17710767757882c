#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "core/evaluate/reliability.hpp"
#include "drivers/files/atomic_file.hpp"
#include "firmware_app/commands.hpp"
#include "firmware_app/progress_bar.hpp"
#include "firmware_app/reliability_plot.hpp"
#include "firmware_app/validation.hpp"

namespace graspd {
namespace {

struct ValidateOptions {
  ValidationOptions validation;
  std::string output;
  std::string reliability;
};

void print_heading() {
  std::printf("%-24s %6s %6s %6s %6s   %6s %8s %6s   %16s %8s\n", "", "AR", "VSD", "MSSD", "MSPD", "<0.3", "0.3-0.5",
              ">0.5", "right / reported", "targets");
}

/// A share, or - where there is nothing to have a share of.
std::string share_text(const Share& share) {
  if (share.total == 0) return "-";
  char text[16];
  std::snprintf(text, sizeof text, "%.2f", share.value());
  return text;
}

void print_row(const std::string& label, const EvaluationRow& row) {
  const AverageRecall& recall = row.recall;
  const auto& seen = row.found_by_visibility;
  std::printf("%-24s %6.3f %6.3f %6.3f %6.3f   %6s %8s %6s   %5s %5zu/%-5zu %7zu\n", label.c_str(), recall.mean(),
              recall.visible_surface, recall.surface, recall.projection, share_text(seen[0]).c_str(),
              share_text(seen[1]).c_str(), share_text(seen[2]).c_str(), share_text(row.precision).c_str(),
              row.precision.hits, row.precision.total, row.targets);
}

void print_reliability(const Reliability& found) {
  std::printf("share right by score:");
  for (std::size_t i = 0; i < score_bin_count; ++i) {
    const ScoreBin& bin = found.bins[i];
    if (bin.total == 0) continue;
    std::printf(" %.1f-%.1f %zu/%zu", 0.1 * static_cast<double>(i), 0.1 * static_cast<double>(i + 1), bin.right,
                bin.total);
  }
  std::printf("; mean distance to the score %.3f\n", found.calibration_error());
}

void print_summary(const Validation& validation) {
  const EvaluationSummary summary = summarise(validation.errors);
  std::printf(
      "Average recall of BOP'19; recall by visibility and right / reported count poses with MSSD below 0.1 of\n"
      "the diameter, the latter against every true instance, however little of it is visible.\n\n");
  print_heading();
  print_row("all", summary.all);
  for (const LabelledRow& part : summary.by_part) {
    std::string label = "part " + part.label;
    for (const auto& [id, name] : validation.part_names) {
      if (id == part.part) label += " " + name;
    }
    print_row(label, part.row);
  }
  for (const LabelledRow& level : summary.by_level) print_row("level " + level.label, level.row);
  if (summary.all.visibility_known()) {
    std::printf("\nbest scored instance right in %zu of %zu images with a part more than half visible\n",
                summary.first_right.hits, summary.first_right.total);
  } else {
    std::printf("\nvisibility not known (no scene_gt_info.json)\n");
  }
  print_reliability(reliability(validation.errors));
  std::printf("seconds a frame: median %.3f, mean %.3f (", summary.median_seconds, summary.mean_seconds);
  for (std::size_t i = 0; i < stage_count; ++i) {
    std::printf("%s%s %.3f", i == 0 ? "" : ", ", stage_name(static_cast<Stage>(i)), validation.stage_seconds[i]);
  }
  std::printf(")\n");
}

Status run_validation(const ValidateOptions& options) {
  for (const std::string& file : {options.output, options.reliability}) {
    if (file.empty()) continue;
    if (Status writable = check_writable(file); !writable.ok()) return writable;
  }
  if (!options.validation.picture_folder.empty()) {
    if (Status made = make_folder(options.validation.picture_folder); !made.ok())
      return {made.code(), std::string(made.message()) + "; choose another --picture-dir"};
  }
  ProgressBar bar;
  const Result<Validation> validation =
      validate(options.validation, [&](float share, const std::string& label) { bar.show(label, share); });
  bar.clear();
  if (!validation.ok()) return validation.status();
  if (Status written = write_bop_results(options.output, validation.value().results); !written.ok()) return written;
  std::printf("%zu instances reported in %zu images, written to %s\n", validation.value().results.size(),
              validation.value().images, options.output.c_str());
  if (validation.value().errors.empty()) {
    std::printf("No ground truth (scene_gt.json): nothing to compare with.\n");
  } else {
    print_summary(validation.value());
    if (!options.reliability.empty()) {
      const Picture plot = draw_reliability(reliability(validation.value().errors));
      if (Status written = write_picture(options.reliability, plot); !written.ok()) return written;
    }
    if (options.validation.explain)
      std::fputs(explanation_as_text(validation.value().explanation, validation.value().part_names).c_str(), stdout);
  }
  return {};
}

}  // namespace

void add_validate_command(CLI::App& command_line, Status& outcome) {
  auto options = std::make_shared<ValidateOptions>();
  options->validation.split = "test";
  CLI::App* command = command_line.add_subcommand("validate", "Measure recall on recorded frames with known poses");
  command->add_option("--bop", options->validation.root, "Data set in BOP format")->required();
  command->add_option("--split", options->validation.split, "Folder of the scenes to look at")->capture_default_str();
  command->add_option("--sensor", options->validation.sensor,
                      "Read depth_NAME, scene_camera_NAME.json and so on, where scenes hold the files of several");
  command->add_option("--banks", options->validation.bank_folder, "Folder with obj_000001.bank ...")->required();
  command->add_option("-o,--output", options->output, "Results in BOP's form (CSV)")->required();
  command->add_option("--threads", options->validation.threads, "Threads; the result does not depend on them")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  command->add_flag("--no-background", options->validation.without_empty_bin,
                    "Do without the scenes' frames of the empty bin");
  command->add_flag("--explain", options->validation.explain,
                    "Tell for each missed target where its right pose was lost, and what each test did");
  command->add_option("--reliability", options->reliability,
                      "Write a plot of the share that is right over the score into this PNG");
  command
      ->add_option("--images", options->validation.images,
                   "Only the images of these numbers out of each scene, as 0,2,5")
      ->delimiter(',');
  command
      ->add_option("--minimum-score", options->validation.minimum_score,
                   "Report from this score on (else the banks' own)")
      ->check(CLI::Range(0.0, 1.0));
  command->add_flag("--no-tests", options->validation.without_tests,
                    "Let the score alone decide, without the tests of verification");
  command->add_flag("--no-edges", options->validation.without_edges,
                    "Refine and judge by surfaces alone, without edges and outlines");
  command->add_option("--picture-dir", options->validation.picture_folder,
                      "Write each frame with the instances found into this folder");
  command->footer(
      "For each image of <split>_targets_bop19.json, detects the objects listed for it (their counts\n"
      "are not used), writes every instance reported at the default threshold, then prints average\n"
      "recall, recall by visibility, the share of reported instances that are right, by score too, and\n"
      "seconds a frame. Without such a file, test_targets_bop19.json is read for a split named test_...,\n"
      "and else what the scenes' ground truth shows a tenth or more of is looked for.\n"
      "The time of a row is that of its whole frame: depth in memory to verified instances.\n"
      "\n"
      "Example:\n"
      "  graspd bank compile --bop /data/synth_dev -o banks\n"
      "  graspd validate --bop /data/synth_dev --split val --banks banks -o results.csv\n"
      "  graspd validate --bop /data/synth_dev --split val --banks banks -o results.csv --explain\n"
      "  graspd validate --bop /data/ipd --split val --sensor photoneo --banks banks -o results.csv");
  command->callback([options, &outcome] { outcome = run_validation(*options); });
}

}  // namespace graspd
