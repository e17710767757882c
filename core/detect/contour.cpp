#include "core/detect/contour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace graspd {

namespace {

constexpr std::array<std::array<int, 2>, 8> ring{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

struct ImageDirection {
  float u = 0;
  float v = 0;
};

/// For every set of neighbours beyond, a bit for each: the direction in the image in which the surface ends, the sum of
/// theirs. Zero where none shares an edge with the cell.
constexpr std::array<ImageDirection, 256> outward_of = [] {
  constexpr float diagonal = 0.70710678F;
  std::array<ImageDirection, 256> outward{};
  for (std::size_t beyond = 0; beyond < outward.size(); ++beyond) {
    if ((beyond & 0b01010101U) == 0) continue;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      if ((beyond >> k & 1U) == 0) continue;
      const float length = k % 2 == 0 ? 1.0F : diagonal;
      outward[beyond].u += length * static_cast<float>(ring[k][0]);
      outward[beyond].v += length * static_cast<float>(ring[k][1]);
    }
  }
  return outward;
}();

/// The direction in which the surface ends at (u, v); zero where it goes on.
Eigen::Vector2f outward(const SceneMap& map, const RenderedModel& model, int u, int v) {
  const Camera& camera = model.camera;
  const float* const cell = &model.front[camera.index(u, v)];
  const float step = map.surface_step(*cell);
  const bool inner = u > 0 && v > 0 && u + 1 < camera.width && v + 1 < camera.height;
  unsigned beyond = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const bool contained = inner || camera.contains(u + ring[k][0], v + ring[k][1]);
    const float depth = contained ? cell[ring[k][1] * camera.width + ring[k][0]] : 0.0F;
    beyond |= (depth == 0.0F || depth - *cell >= step ? 1U : 0U) << k;
  }
  return {outward_of[beyond].u, outward_of[beyond].v};
}

constexpr int block = 64;
constexpr std::size_t most_kept = 2048;

/// Marks those cells of row `v` from `first` on at which the surface may end: a neighbour beyond the rectangle, or not
/// covered, or a step behind. Most cells are inside, and found to be so many at once.
void mark_ends(const SceneMap& map, const RenderedModel& model, int first, int v, int count,
               std::array<std::uint32_t, block>& ends) {
  const int width = model.rectangle.width;
  const float* const row = model.front.data() + model.camera.index(first, v);
  const bool border_row = v == 0 || v == model.rectangle.height - 1;
  for (int k = 0; k < count; ++k) ends[static_cast<std::size_t>(k)] = row[k] != 0.0F ? 1 : 0;
  if (border_row) return;
  const auto smaller = [](float a, float b) { return a < b ? a : b; };
  const auto larger = [](float a, float b) { return a > b ? a : b; };
  const int inner_end = std::min(count, width - 1 - first);
  for (int k = first == 0 ? 1 : 0; k < inner_end; ++k) {
    const float* const above = row + k - width;
    const float* const here = row + k;
    const float* const below = row + k + width;
    const float lowest = smaller(smaller(smaller(above[-1], above[0]), smaller(above[1], here[-1])),
                                 smaller(smaller(here[1], below[-1]), smaller(below[0], below[1])));
    const float highest = larger(larger(larger(above[-1], above[0]), larger(above[1], here[-1])),
                                 larger(larger(here[1], below[-1]), larger(below[0], below[1])));
    const std::uint32_t covered = here[0] != 0.0F ? 1 : 0;
    const std::uint32_t open = lowest == 0.0F ? 1 : 0;
    const std::uint32_t steps = highest - here[0] < map.surface_step(here[0]) ? 0 : 1;
    ends[static_cast<std::size_t>(k)] = covered & (open | steps);
  }
}

template <class Visit>
void for_each_contour_cell(const SceneMap& map, const RenderedModel& model, Visit visit) {
  std::array<std::uint32_t, block> ends;
  for (int v = 0; v < model.rectangle.height; ++v) {
    for (int first = 0; first < model.rectangle.width; first += block) {
      const int count = std::min(block, model.rectangle.width - first);
      mark_ends(map, model, first, v, count, ends);
      for (int k = 0; k < count; ++k) {
        if (ends[static_cast<std::size_t>(k)] == 0) continue;
        const Eigen::Vector2f direction = outward(map, model, first + k, v);
        if (direction.squaredNorm() > 0.1F) visit(first + k, v, direction);
      }
    }
  }
}

}  // namespace

std::size_t find_contour(const SceneMap& map, const RenderedModel& model, const RigidTransform& camera_from_part,
                         std::span<EdgePoint> points) {
  // Kept from counting them, as long as they are not very many.
  struct ContourCell {
    int u, v;
    Eigen::Vector2f direction;
  };
  std::array<ContourCell, most_kept> kept;
  std::size_t cells = 0;
  for_each_contour_cell(map, model, [&](int u, int v, const Eigen::Vector2f& direction) {
    if (cells < kept.size()) kept[cells] = {u, v, direction};
    ++cells;
  });
  if (cells == 0 || points.empty()) return 0;
  const std::size_t step = (cells + points.size() - 1) / points.size();
  const RigidTransform part_from_camera = inverse(camera_from_part);
  std::size_t seen = 0;
  std::size_t count = 0;
  const auto take = [&](int u, int v, const Eigen::Vector2f& direction) {
    if (seen++ % step != 0) return;
    const Vector3 point =
        model.camera.point(static_cast<float>(u), static_cast<float>(v), model.front[model.camera.index(u, v)]);
    const Vector3 tangent(-direction.y(), direction.x(), 0.0F);
    points[count++] = {part_from_camera * point, part_from_camera.rotation * tangent.normalized()};
  };
  if (cells <= kept.size()) {
    for (const ContourCell& cell : std::span(kept).first(cells)) take(cell.u, cell.v, cell.direction);
  } else {
    for_each_contour_cell(map, model, take);
  }
  return count;
}

}  // namespace graspd
