#include "firmware_app/bench_growth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>
#include <utility>

#include "firmware_app/bank_cut.hpp"

namespace graspd {
namespace {

constexpr std::array shares{0.125, 0.25, 0.5, 0.75, 1.0};

/// 1, 2, 4 ... and `most` itself.
std::vector<int> doubled_up_to(int most) {
  std::vector<int> sizes;
  for (int size = 1; size < most; size *= 2) sizes.push_back(size);
  sizes.push_back(most);
  return sizes;
}

/// A window of a frame, in pixels.
struct Window {
  float u = 0;  ///< Its middle.
  float v = 0;
  float half_width = 0;
  float half_height = 0;
};

float median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Windows of the shape of the frame that hold `shares` of `points`; none when there are no points.
std::vector<Window> windows_about(std::span<const OrientedPoint> points, const Camera& camera) {
  if (points.empty()) return {};
  std::vector<float> u;
  std::vector<float> v;
  for (const OrientedPoint& point : points) {
    const Eigen::Vector2f pixel = camera.project(point.position);
    u.push_back(pixel.x());
    v.push_back(pixel.y());
  }
  const float middle_u = median(u);
  const float middle_v = median(v);
  const auto width = static_cast<float>(camera.width);
  const auto height = static_cast<float>(camera.height);
  std::vector<float> sizes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sizes.push_back(std::max(std::abs(u[i] - middle_u) / width, std::abs(v[i] - middle_v) / height));
  }
  std::sort(sizes.begin(), sizes.end());
  std::vector<Window> windows;
  for (const double share : shares) {
    const auto held = static_cast<std::size_t>(share * static_cast<double>(sizes.size() - 1));
    // The last shows the whole frame.
    const float size = share < 1.0 ? sizes[held] : 1.0F;
    windows.push_back({middle_u, middle_v, size * width, size * height});
  }
  return windows;
}

/// The frame with nothing measured outside the window.
LoadedFrame seen_through(const Window& window, LoadedFrame frame) {
  for (int v = 0; v < frame.camera.height; ++v) {
    for (int u = 0; u < frame.camera.width; ++u) {
      const bool inside = std::abs(static_cast<float>(u) - window.u) <= window.half_width &&
                          std::abs(static_cast<float>(v) - window.v) <= window.half_height;
      if (!inside) frame.depth[frame.camera.index(u, v)] = 0.0F;
    }
  }
  return frame;
}

bool shows_anything(const LoadedFrame& frame) {
  return std::any_of(frame.depth.begin(), frame.depth.end(), [](float depth) { return depth > 0.0F; });
}

std::string label_of(const Growth& growth, std::size_t number) {
  return "growth with " + growth.with + ", point " + std::to_string(number + 1);
}

/// Adds a point for banks of which `kept` tells the references that vote.
template <class Kept, class Size>
Status add_cut_banks(BenchBed& bed, const Kept& kept, const Size& size, Growth& growth) {
  std::vector<BankCut> cuts;
  std::vector<Bank> banks;
  double total = 0;
  for (const Bank& bank : bed.input().banks.banks) {
    cuts.emplace_back(bank, kept(bank));
    banks.push_back(cuts.back().bank());
    total += size(banks.back());
  }
  BenchSetting setting = bed.whole();
  setting.banks = banks;
  const Result<BenchRun> run = bed.run_briefly(setting, label_of(growth, growth.points.size()));
  if (!run.ok()) return run.status();
  growth.points.push_back({total, run.value()});
  return {};
}

}  // namespace

Result<Growth> growth_with_scene(BenchBed& bed) {
  Growth growth{"scene points", {}};
  std::vector<std::vector<Window>> windows;
  for (LoadedFrame& frame : bed.input().frames) {
    BenchSetting setting = bed.whole();
    setting.frames = {&frame, 1};
    const Result<BenchRun> run = bed.run(setting, 0, 1, "scene points of " + frame.name);
    if (!run.ok()) return run.status();
    windows.push_back(windows_about(bed.scene_points(), frame.camera));
  }
  for (std::size_t i = 0; i < shares.size(); ++i) {
    std::vector<LoadedFrame> seen;
    for (std::size_t f = 0; f < windows.size(); ++f) {
      if (windows[f].empty()) continue;
      LoadedFrame frame = seen_through(windows[f][i], bed.input().frames[f]);
      if (shows_anything(frame)) seen.push_back(std::move(frame));
    }
    if (seen.empty()) continue;
    BenchSetting setting = bed.whole();
    setting.frames = seen;
    const Result<BenchRun> run = bed.run_briefly(setting, label_of(growth, growth.points.size()));
    if (!run.ok()) return run.status();
    growth.points.push_back({run.value().count(BenchCount::scene_points), run.value()});
  }
  return growth;
}

Result<Growth> growth_with_references(BenchBed& bed) {
  Growth growth{"model references", {}};
  for (const double share : shares) {
    const Status added = add_cut_banks(
        bed, [&](const Bank& bank) { return share_of_references(bank, share); },
        [](const Bank& bank) { return static_cast<double>(bank.reference_points.size()); }, growth);
    if (!added.ok()) return added;
  }
  return growth;
}

Result<Growth> growth_with_views(BenchBed& bed) {
  Growth growth{"views", {}};
  std::size_t most = 1;
  for (const Bank& bank : bed.input().banks.banks) most = std::max(most, bank.views.size());
  for (const int views : doubled_up_to(static_cast<int>(most))) {
    const auto kept = [&](const Bank& bank) { return references_of_views(bank, static_cast<std::size_t>(views)); };
    const auto voting = [](const Bank& bank) {
      return static_cast<double>(std::count_if(bank.views.begin(), bank.views.end(),
                                               [](const BankView& view) { return view.reference_count > 0; }));
    };
    if (Status added = add_cut_banks(bed, kept, voting, growth); !added.ok()) return added;
  }
  return growth;
}

Result<Growth> growth_with_threads(BenchBed& bed) {
  Growth growth{"threads", {}};
  for (const int threads : doubled_up_to(most_threads(bed.input()))) {
    BenchSetting setting = bed.whole();
    setting.parameters.threads = threads;
    const Result<BenchRun> run = bed.run_briefly(setting, label_of(growth, growth.points.size()));
    if (!run.ok()) return run.status();
    growth.points.push_back({static_cast<double>(threads), run.value()});
  }
  return growth;
}

int most_threads(const BenchInput& input) {
  return std::max(input.parameters.threads, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace graspd
