// Evaluates a BOP result file: every pose error into a CSV file, the average recalls on the terminal.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/evaluate/summary.hpp"
#include "drivers/files/bop_dataset.hpp"
#include "drivers/files/bop_evaluation.hpp"
#include "tests/benchmarks/summary_table.hpp"

namespace graspd {
namespace {

struct Options {
  std::string root;
  std::string split = "test";
  std::string results;
  std::string errors;
};

/// Numbers of the true poses of `part` among all of the image.
std::vector<std::size_t> places_of(const EvaluationImage& image, std::uint32_t part) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < image.truths.size(); ++i) {
    if (image.truths[i].part == part) places.push_back(i);
  }
  return places;
}

/// One line for each estimate and true pose; `lines` are the estimates' lines in the result file.
void write_errors(std::ofstream& out, const EvaluationImage& image, const ImageErrors& errors,
                  const std::vector<std::size_t>& lines) {
  for (const PartErrors& part : errors.parts) {
    const std::vector<std::size_t> places = places_of(image, part.part);
    for (std::size_t estimate = 0; estimate < part.scores.size(); ++estimate) {
      for (std::size_t truth = 0; truth < places.size(); ++truth) {
        const PoseError& error = part.error(estimate, truth);
        out << lines[part.sources[estimate]] << ',' << places[truth] << ',';
        for (const float vsd : error.visible_surface) out << vsd << ' ';
        out << ',' << error.surface << ',' << error.projection << '\n';
      }
    }
  }
}

Status run(const Options& options) {
  const Result<std::vector<EvaluationPart>> parts = read_evaluation_parts(options.root);
  if (!parts.ok()) return parts.status();
  Result<std::vector<EvaluationImage>> images = read_evaluation_images(options.root, options.split);
  if (!images.ok()) return images.status();
  const Result<std::vector<BopResult>> results = read_bop_results(options.results);
  if (!results.ok()) return results.status();

  std::ofstream out;
  if (!options.errors.empty()) {
    out.open(options.errors);
    out.precision(9);
    out << "estimate,truth,vsd,mssd,mspd\n";
  }
  std::vector<ImageErrors> errors;
  for (EvaluationImage& image : images.value()) {
    std::vector<std::size_t> lines;
    for (std::size_t line = 0; line < results.value().size(); ++line) {
      const BopResult& result = results.value()[line];
      if (static_cast<std::uint32_t>(result.scene_id) != image.scene ||
          static_cast<std::uint32_t>(result.im_id) != image.image) {
        continue;
      }
      image.estimates.push_back({static_cast<std::uint32_t>(result.obj_id), result.score, result.camera_from_part});
      image.seconds = static_cast<double>(result.seconds);
      lines.push_back(line);
    }
    const Result<BopScene> scene =
        read_bop_scene(bop_scene_folder(options.root, options.split, static_cast<int>(image.scene)));
    if (!scene.ok()) return scene.status();
    Result<LoadedFrame> frame = load_bop_frame(scene.value(), static_cast<int>(image.image));
    if (!frame.ok()) return frame.status();
    errors.push_back(image_errors(image, frame.value().frame(), parts.value()));
    if (out.is_open()) write_errors(out, image, errors.back(), lines);
  }
  const EvaluationSummary summary = summarise(errors);
  print_summary_table("all", summary);
  std::printf("average recalls: %.9f,%.9f,%.9f\n", summary.all.recall.visible_surface, summary.all.recall.surface,
              summary.all.recall.projection);
  return {};
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  graspd::Options options;
  CLI::App app("Evaluates a BOP result file");
  app.add_option("--bop", options.root, "Data set in BOP format")->required();
  app.add_option("--split", options.split, "Its images")->capture_default_str();
  app.add_option("--results", options.results, "Result file in BOP's form")->required();
  app.add_option("--errors", options.errors, "Where every pose error goes (CSV)");
  CLI11_PARSE(app, argc, argv);
  const graspd::Status status = graspd::run(options);
  if (!status.ok())
    std::fprintf(stderr, "pose_errors: %.*s\n", static_cast<int>(status.message().size()), status.message().data());
  return static_cast<int>(status.code());
}
