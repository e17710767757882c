// Measures how long a vote takes against a bare loop that increments random cells of an accumulator of the same size,
// on one thread and on several at once.

#include <omp.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "core/detect/preprocess.hpp"
#include "core/detect/voting.hpp"
#include "drivers/files/bop_dataset.hpp"
#include "firmware_app/detection_session.hpp"
#include "firmware_app/loaded_banks.hpp"
#include "firmware_app/memory_block.hpp"

namespace graspd {
namespace {

struct Options {
  std::string root;
  std::string split = "val";
  int scene = 1;
  int image = 0;
  std::string bank;
  int repetitions = 5;
};

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The least of several runs of `body(thread)` on `threads` threads at once, in seconds.
template <class Body>
double least_seconds(int repetitions, int threads, const Body& body) {
  double least = 1e9;
  for (int r = 0; r < repetitions; ++r) {
    const double start = seconds_now();
#pragma omp parallel num_threads(threads)
    body(omp_get_thread_num());
    least = std::min(least, seconds_now() - start);
  }
  return least;
}

/// What each thread works with.
struct Worker {
  MemoryBlock memory;
  VotingScratch scratch;
  std::vector<std::uint8_t> cells;
};

void print_rates(const char* what, double nanoseconds, double bare) {
  std::printf("%-44s %8.3f ns, %5.2f of the bare loop's\n", what, nanoseconds, nanoseconds / bare);
}

Status run(const Options& options) {
  const Result<BopScene> scene = read_bop_scene(bop_scene_folder(options.root, options.split, options.scene));
  if (!scene.ok()) return scene.status();
  Result<LoadedFrame> frame = load_bop_frame(scene.value(), options.image);
  if (!frame.ok()) return frame.status();
  const Result<LoadedBanks> banks = load_banks(std::vector<std::string>{options.bank});
  if (!banks.ok()) return banks.status();
  const Bank& bank = banks.value().banks.front();
  const DepthFrame depth = frame.value().frame();
  const DetectCapacity capacity = fitted_capacity({}, {depth.camera.width, depth.camera.height}, banks.value().banks);

  Arena measuring = Arena::measuring();
  static_cast<void>(carve_preprocess_workspace(measuring, capacity));
  MemoryBlock memory(measuring.used());
  Arena arena(memory.bytes());
  PreprocessWorkspace workspace = carve_preprocess_workspace(arena, capacity);
  const Scene seen = preprocess(depth, frame.value().empty_bin(), bank.part->detail, {}, {}, workspace);
  const float reach = bank.grid.distance_step * static_cast<float>(bank.grid.distance_bins);
  const NeighbourGrid points = sample_for(seen, bank.part->sampling, reach, {}, workspace);

  const int most_threads = omp_get_num_procs();
  std::vector<Worker> workers(static_cast<std::size_t>(most_threads));
  for (Worker& worker : workers) {
    Arena counting = Arena::measuring();
    static_cast<void>(carve_voting_scratch(counting, capacity));
    worker.memory = MemoryBlock(counting.used());
    Arena own(worker.memory.bytes());
    worker.scratch = carve_voting_scratch(own, capacity);
    worker.cells.resize(bank.reference_points.size() * alpha_bins);
  }
  constexpr std::size_t increments = 1U << 24U;
  std::vector<std::uint32_t> random_cells(1U << 20U);
  std::mt19937 random(1);
  for (std::uint32_t& cell : random_cells) cell = static_cast<std::uint32_t>(random() % workers[0].cells.size());

  const auto count_bare = [&](int thread) {
    std::vector<std::uint8_t>& cells = workers[static_cast<std::size_t>(thread)].cells;
    for (std::size_t round = 0; round < increments / random_cells.size(); ++round) {
      for (const std::uint32_t cell : random_cells) ++cells[cell];
    }
  };
  std::printf("accumulator: %zu references, %.0f KiB; %zu scene points\n", bank.reference_points.size(),
              static_cast<double>(workers[0].cells.size()) / 1024.0, points.points.size());
  for (int threads = 1; threads <= most_threads; threads *= 2) {
    const double bare = 1e9 * least_seconds(options.repetitions, threads, count_bare) / increments;
    std::printf("\n%d thread%s\n", threads, threads > 1 ? "s, each its own work" : "");
    print_rates("an increment of the bare loop", bare, bare);
    for (const InstructionSet set : every_instruction_set) {
      if (!is_supported(set)) continue;
      const Voting vote = voting_with(set);
      const auto count_votes = [&](int thread) {
        VotingScratch& scratch = workers[static_cast<std::size_t>(thread)].scratch;
        prepare_voting(bank, scratch);
        for (std::size_t i = 0; i < points.points.size(); i += 3) vote(points, bank, points.points[i], scratch);
      };
      const double seconds = least_seconds(options.repetitions, threads, count_votes);
      const VotingWork& work = workers[0].scratch.work;
      const std::string name = "a vote, " + std::string(set == InstructionSet::baseline ? "baseline"
                                                        : set == InstructionSet::avx2   ? "AVX2"
                                                                                        : "AVX-512");
      print_rates(name.c_str(), 1e9 * seconds / static_cast<double>(work.votes), bare);
      std::printf("%-44s %8.3f ns; %.2e pairs, %.2e votes\n", "  a pair, its votes and the peaks with it",
                  1e9 * seconds / static_cast<double>(work.pairs), static_cast<double>(work.pairs),
                  static_cast<double>(work.votes));
    }
  }
  return {};
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  graspd::Options options;
  CLI::App app("Measures how long a vote takes, against a bare loop that increments random cells");
  app.add_option("--bop", options.root, "Data set in BOP format")->required();
  app.add_option("--split", options.split, "Its images")->capture_default_str();
  app.add_option("--scene", options.scene)->capture_default_str();
  app.add_option("--image", options.image)->capture_default_str();
  app.add_option("--bank", options.bank, "Bank of a part in that image")->required();
  app.add_option("--repetitions", options.repetitions, "The fastest counts")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const graspd::Status status = graspd::run(options);
  if (!status.ok()) {
    std::fprintf(stderr, "vote_rate: %.*s\n", static_cast<int>(status.message().size()), status.message().data());
  }
  return static_cast<int>(status.code());
}
