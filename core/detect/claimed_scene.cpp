#include "core/detect/claimed_scene.hpp"

#include <algorithm>
#include <cmath>

#include "core/detect/consistency.hpp"

namespace graspd {

namespace {

std::size_t cells_of(const ImageRectangle& rectangle) {
  return static_cast<std::size_t>(rectangle.width) * static_cast<std::size_t>(rectangle.height);
}

}  // namespace

ClaimedScene carve_claimed_scene(Arena& arena, const DetectCapacity& capacity) {
  ClaimedScene claims;
  claims.cells = arena.take<std::uint16_t>(capacity.map_cells, "selection");
  claims.front = arena.take<float>(std::size_t{3} * capacity.map_cells, "selection");
  claims.back = arena.take<float>(std::size_t{3} * capacity.map_cells, "selection");
  claims.rooms = FixedVector(arena.take<OccupiedRoom>(capacity.instances, "selection"));
  return claims;
}

std::size_t free_room(const ClaimedScene& claims) {
  std::size_t used = 0;
  for (const OccupiedRoom& room : claims.rooms) used = std::max(used, room.first + cells_of(room.rectangle));
  return used;
}

RenderedModel render_into(const ClaimedScene& claims, std::size_t room, const SceneMap& map, const Bank& bank,
                          const RigidTransform& camera_from_part) {
  return render_model(map, bank, camera_from_part, claims.front.subspan(room), claims.back.subspan(room));
}

RenderedModel model_in(const SceneMap& map, const OccupiedRoom& room, const ClaimedScene& claims) {
  RenderedModel model;
  model.rectangle = room.rectangle;
  model.camera = cropped(map.camera, room.rectangle);
  model.front = claims.front.subspan(room.first, cells_of(room.rectangle));
  model.back = claims.back.subspan(room.first, cells_of(room.rectangle));
  return model;
}

void claim(const SceneMap& map, const RenderedModel& model, float tolerance, std::size_t k, ClaimedScene& claims) {
  for (int v = 0; v < model.rectangle.height; ++v) {
    for (int u = 0; u < model.rectangle.width; ++u) {
      const float front = model.front[model.camera.index(u, v)];
      if (front == 0.0F) continue;
      const std::size_t index = map.camera.index(model.rectangle.left + u, model.rectangle.top + v);
      const MapCell& cell = map.cells[index];
      // Wider than for confirming: what lies just inside a part is that part, measured badly.
      if (cell.measured() && std::abs(cell.point.z() - front) < 3.0F * tolerance && claims.cells[index] == 0)
        claims.cells[index] = static_cast<std::uint16_t>(k + 1);
    }
  }
}

void release(const SceneMap& map, const RenderedModel& model, std::size_t k, ClaimedScene& claims) {
  for (int v = 0; v < model.rectangle.height; ++v) {
    for (int u = 0; u < model.rectangle.width; ++u) {
      std::uint16_t& holder = claims.cells[map.camera.index(model.rectangle.left + u, model.rectangle.top + v)];
      if (holder == k + 1) holder = 0;
    }
  }
}

ClaimedShare claimed_share(const SceneMap& map, const Bank& bank, const RigidTransform& camera_from_part,
                           float tolerance, const ClaimedScene& claims) {
  constexpr int looked_at = 400;
  int confirmed = 0;
  int claimed = 0;
  // By majority vote (Boyer and Moore 1981).
  std::uint16_t holder = 0;
  int lead = 0;
  const auto ask = [&](const SurfacePoint& surface, const Vector3& point, const MapCell* cell) {
    if (cell == nullptr) return;
    const std::uint16_t number = claims.cells[static_cast<std::size_t>(cell - map.cells.data())];
    if (confirms(*cell, point, camera_from_part.rotation * surface.normal, tolerance)) {
      ++confirmed;
      claimed += number != 0 ? 1 : 0;
    }
    if (number == 0) return;
    if (lead == 0) holder = number;
    lead += number == holder ? 1 : -1;
  };
  for_each_looked_up(map, bank, camera_from_part, visible_row(bank, camera_from_part), looked_at, ask);
  if (claimed == 0) return {};
  return {static_cast<float>(claimed) / static_cast<float>(confirmed), holder - std::size_t{1}};
}

float shared_room(const RenderedModel& candidate, const ClaimedScene& claims, float tolerance) {
  float cells = 0;
  for (const float front : candidate.front) cells += front > 0.0F ? 1.0F : 0.0F;
  float worst = 0;
  for (const OccupiedRoom& room : claims.rooms) {
    const ImageRectangle& a = candidate.rectangle;
    const ImageRectangle& b = room.rectangle;
    float shared = 0;
    float room_cells = 0;
    for (std::size_t i = 0; i < cells_of(b); ++i) room_cells += claims.front[room.first + i] > 0.0F ? 1.0F : 0.0F;
    const int v_end = std::min(a.top + a.height, b.top + b.height);
    const int u_end = std::min(a.left + a.width, b.left + b.width);
    for (int v = std::max(a.top, b.top); v < v_end; ++v) {
      for (int u = std::max(a.left, b.left); u < u_end; ++u) {
        const std::size_t i = candidate.camera.index(u - a.left, v - a.top);
        const std::size_t k = room.first + static_cast<std::size_t>((v - b.top) * b.width + (u - b.left));
        if (candidate.front[i] == 0.0F || claims.front[k] == 0.0F) continue;
        const float overlap =
            std::min(candidate.back[i], claims.back[k]) - std::max(candidate.front[i], claims.front[k]);
        shared += overlap > tolerance ? 1.0F : 0.0F;
      }
    }
    worst = std::max(worst, shared / std::max(1.0F, std::min(cells, room_cells)));
  }
  return worst;
}

}  // namespace graspd
