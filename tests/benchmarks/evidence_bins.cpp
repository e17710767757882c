#include "tests/benchmarks/evidence_bins.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/geometry/chance.hpp"
#include "core/train/part_mesh.hpp"
#include "tests/benchmarks/stranger_shapes.hpp"

namespace graspd {

namespace {

constexpr std::array strains{SensorStrain::clean, SensorStrain::medium, SensorStrain::hard};

bool is_smeared(BinKind kind) {
  return kind == BinKind::smeared || kind == BinKind::smeared_window || kind == BinKind::smeared_others ||
         kind == BinKind::smeared_shapes;
}
bool is_window(BinKind kind) { return kind == BinKind::window || kind == BinKind::smeared_window; }
bool is_empty_known(BinKind kind) {
  return kind == BinKind::usual || kind == BinKind::smeared || kind == BinKind::mixed;
}
bool holds_part(BinKind kind) {
  return kind != BinKind::others && kind != BinKind::smeared_others && kind != BinKind::shapes &&
         kind != BinKind::smeared_shapes;
}

SimulatedPart scaled(const TrialPart& part, float diameter) {
  Mesh mesh = part.simulated.mesh;
  for (Vector3& vertex : mesh.vertices) vertex *= diameter / part.evaluation.diameter;
  return simulated_part(mesh, part.closed);
}

SimulatedPart everyday_thing(Chance& chance, float diameter) {
  const Result<PartMesh> prepared = prepare_mesh(stranger_shape(chance, diameter));
  return simulated_part(prepared.value().mesh, true);
}

/// What lies in the bin beside the part.
std::vector<SimulatedPart> strangers(BinKind kind, std::span<const TrialPart> parts, std::size_t wanted,
                                     Chance& chance) {
  const float diameter = parts[wanted].evaluation.diameter;
  const bool shapes = kind == BinKind::shapes || kind == BinKind::smeared_shapes;
  const int count = shapes ? 6 : kind == BinKind::mixed ? 2 : holds_part(kind) ? 0 : 3;
  std::vector<SimulatedPart> result;
  for (int i = 0; i < count; ++i) {
    const float size = diameter * chance.between(0.6F, 1.7F);
    if (shapes) {
      result.push_back(everyday_thing(chance, size));
      continue;
    }
    std::size_t other = chance.word() % parts.size();
    if (other == wanted) other = (other + 1) % parts.size();
    result.push_back(scaled(parts[other], size));
  }
  return result;
}

/// The mean depth of what was measured in a square window about every pixel; 0 where nothing was.
std::vector<float> window_means(const Camera& camera, int half_window, std::span<const float> depth) {
  std::vector<float> means(depth.size());
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      float sum = 0;
      int measured = 0;
      for (int y = std::max(0, v - half_window); y <= std::min(camera.height - 1, v + half_window); ++y) {
        for (int x = std::max(0, u - half_window); x <= std::min(camera.width - 1, u + half_window); ++x) {
          const float z = depth[camera.index(x, y)];
          measured += z > 0.0F ? 1 : 0;
          sum += z;
        }
      }
      means[camera.index(u, v)] = measured > 0 ? sum / static_cast<float>(measured) : 0.0F;
    }
  }
  return means;
}

/// What a sensor makes of the depth that matches windows of two images: it fills what it cannot see from what is
/// beside it, smears steps, and bends what stands at them. `roughness` (metres) is how much a patch of that size is
/// off.
void smear(const Camera& camera, int half_window, float roughness, std::uint64_t seed, std::span<float> depth) {
  const std::vector<float> beside = window_means(camera, 2 * half_window, depth);
  for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = depth[i] > 0.0F ? depth[i] : beside[i];
  const std::vector<float> smeared = window_means(camera, half_window, depth);
  const int patch = 2 * half_window + 1;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const std::size_t i = camera.index(u, v);
      const auto place = static_cast<std::uint64_t>(v / patch) * 65536U + static_cast<std::uint64_t>(u / patch);
      depth[i] = smeared[i] > 0.0F ? smeared[i] + roughness * normal_from(word_at(seed, place)) : 0.0F;
    }
  }
}

/// The middle of the frame, of which a share of `kept` of the width and height is left.
void cut_off(float kept, SimulatedScene& scene) {
  const Camera whole = scene.camera;
  Camera& camera = scene.camera;
  camera.width = static_cast<int>(kept * static_cast<float>(whole.width));
  camera.height = static_cast<int>(kept * static_cast<float>(whole.height));
  const int left = (whole.width - camera.width) / 2;
  const int top = (whole.height - camera.height) / 2;
  camera.cx -= static_cast<float>(left);
  camera.cy -= static_cast<float>(top);
  const auto cut = [&](std::vector<float>& pixels) {
    std::vector<float> rest(camera.pixel_count());
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) rest[camera.index(u, v)] = pixels[whole.index(u + left, v + top)];
    }
    pixels = std::move(rest);
  };
  cut(scene.depth);
  cut(scene.empty_depth);
}

}  // namespace

const char* bin_kind_name(BinKind kind) {
  constexpr std::array names{"usual", "unaided", "window",         "smeared", "smeared_window",
                             "mixed", "others",  "smeared_others", "shapes",  "smeared_shapes"};
  return names[static_cast<std::size_t>(kind)];
}

EvidenceBin evidence_bin(BinKind kind, std::span<const TrialPart> parts, std::size_t wanted, const Bank& bank,
                         std::uint64_t seed) {
  Chance chance(mixed(seed) + wanted);
  std::vector<SimulatedPart> piled = strangers(kind, parts, wanted, chance);
  if (holds_part(kind)) piled.insert(piled.begin(), parts[wanted].simulated);
  SceneRecipe recipe;
  recipe.instances = 14;
  recipe.strain = strains[seed % strains.size()];
  recipe.seed = chance.word();
  const float along_part = chance.between(45.0F, is_smeared(kind) ? 110.0F : 160.0F);
  recipe.pixel_pitch = parts[wanted].evaluation.diameter / along_part;
  recipe.maximum_width = 800;
  recipe.maximum_height = 600;
  if (!is_empty_known(kind)) recipe.rim = parts[wanted].evaluation.diameter * chance.between(0.03F, 0.2F);
  EvidenceBin bin{simulate_scene(piled, recipe), is_empty_known(kind)};
  if (!holds_part(kind)) {
    for (SimulatedInstance& instance : bin.scene.instances) ++instance.part;
  }
  if (is_smeared(kind)) {
    const float pitch = recipe.sensor_distance / bin.scene.camera.fx;
    const int half_window =
        std::max(1, static_cast<int>(chance.between(0.15F, 0.6F) * bank.part->sampling / pitch + 0.5F));
    const float roughness = chance.between(0.0F, 0.15F) * bank.part->sampling;
    smear(bin.scene.camera, half_window, roughness, chance.word(), bin.scene.depth);
    smear(bin.scene.camera, half_window, roughness, chance.word(), bin.scene.empty_depth);
  }
  if (is_window(kind)) cut_off(chance.between(0.5F, 0.75F), bin.scene);
  return bin;
}

}  // namespace graspd
