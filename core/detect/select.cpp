#include "core/detect/select.hpp"

#include <algorithm>
#include <numeric>

namespace graspd {

namespace {

/// Share of the candidate's cells in which its body and an accepted one's would share room.
float shared_room(const RenderedModel& candidate, const SelectWorkspace& workspace, float tolerance) {
  float cells = 0;
  for (const float front : candidate.front) cells += front > 0.0F ? 1.0F : 0.0F;
  float worst = 0;
  for (const OccupiedRoom& room : workspace.rooms) {
    const ImageRectangle& a = candidate.rectangle;
    const ImageRectangle& b = room.rectangle;
    float shared = 0;
    float room_cells = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(b.width) * static_cast<std::size_t>(b.height); ++i)
      room_cells += workspace.front[room.first + i] > 0.0F ? 1.0F : 0.0F;
    const int v_end = std::min(a.top + a.height, b.top + b.height);
    const int u_end = std::min(a.left + a.width, b.left + b.width);
    for (int v = std::max(a.top, b.top); v < v_end; ++v) {
      for (int u = std::max(a.left, b.left); u < u_end; ++u) {
        const std::size_t i = candidate.camera.index(u - a.left, v - a.top);
        const std::size_t k = room.first + static_cast<std::size_t>((v - b.top) * b.width + (u - b.left));
        if (candidate.front[i] == 0.0F || workspace.front[k] == 0.0F) continue;
        const float overlap =
            std::min(candidate.back[i], workspace.back[k]) - std::max(candidate.front[i], workspace.front[k]);
        shared += overlap > tolerance ? 1.0F : 0.0F;
      }
    }
    worst = std::max(worst, shared / std::max(1.0F, std::min(cells, room_cells)));
  }
  return worst;
}

std::size_t used_room(const SelectWorkspace& workspace) {
  if (workspace.rooms.empty()) return 0;
  const OccupiedRoom& last = workspace.rooms[workspace.rooms.size() - 1];
  return last.first + static_cast<std::size_t>(last.rectangle.width) * static_cast<std::size_t>(last.rectangle.height);
}

void claim(const SceneMap& map, const RenderedModel& model, float tolerance, std::uint16_t number,
           std::span<std::uint16_t> claimed) {
  for (int v = 0; v < model.rectangle.height; ++v) {
    for (int u = 0; u < model.rectangle.width; ++u) {
      const float front = model.front[model.camera.index(u, v)];
      if (front == 0.0F) continue;
      const std::size_t index = map.camera.index(model.rectangle.left + u, model.rectangle.top + v);
      const MapCell& cell = map.cells[index];
      // Wider than for confirming: what lies just inside a part is that part, measured badly.
      if (cell.measured() && std::abs(cell.point.z() - front) < 3.0F * tolerance && claimed[index] == 0)
        claimed[index] = number;
    }
  }
}

}  // namespace

SelectWorkspace carve_select_workspace(Arena& arena, const DetectCapacity& capacity) {
  SelectWorkspace workspace;
  workspace.claimed = arena.take<std::uint16_t>(capacity.map_cells, "selection");
  workspace.order = arena.take<std::uint32_t>(capacity.judged, "selection");
  workspace.front = arena.take<float>(std::size_t{3} * capacity.map_cells, "selection");
  workspace.back = arena.take<float>(std::size_t{3} * capacity.map_cells, "selection");
  workspace.rooms = FixedVector(arena.take<OccupiedRoom>(capacity.instances, "selection"));
  return workspace;
}

std::uint32_t select_instances(const SceneMap& map, std::span<const Bank> banks, const VerifyParameters& parameters,
                               float minimum_score, std::span<Instance> judged, SelectWorkspace& workspace,
                               FixedVector<Instance>& accepted, FixedVector<Instance>& rejected) {
  std::uint32_t flags = 0;
  workspace.rooms.clear();
  std::fill_n(workspace.claimed.begin(), map.cells.size(), std::uint16_t{0});
  const std::span<std::uint32_t> order = workspace.order.first(judged.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return judged[a].score != judged[b].score ? judged[a].score > judged[b].score : a < b;
  });
  for (const std::uint32_t j : order) {
    Instance instance = judged[j];
    const Bank& bank = banks[instance.bank];
    const float threshold = minimum_score >= 0.0F ? minimum_score : bank.part->thresholds.minimum_score;
    const float tolerance = parameters.tolerance * bank.part->sampling;
    if (instance.rejection == Rejection::none && instance.score < threshold) instance.rejection = Rejection::score;
    if (instance.rejection == Rejection::none) {
      const std::size_t used = used_room(workspace);
      const RenderedModel model = render_model(map, bank, instance.camera_from_part, workspace.front.subspan(used),
                                               workspace.back.subspan(used));
      const Evidence own = gather_evidence(map, bank, model, parameters, workspace.claimed);
      if (own.confirmed < 0.5F * instance.evidence.confirmed) {
        instance.rejection = Rejection::duplicate;
      } else if (parameters.tests && shared_room(model, workspace, 2.0F * tolerance) > 0.25F) {
        instance.rejection = Rejection::intersecting;
      } else if (model.rectangle.empty() || accepted.full() || !workspace.rooms.push_back({model.rectangle, used})) {
        flags |= flag_instances_cut;
        continue;
      } else {
        claim(map, model, tolerance, static_cast<std::uint16_t>(accepted.size() + 1), workspace.claimed);
        accepted.push_back(instance);
      }
    }
    if (instance.rejection != Rejection::none) rejected.push_back(instance);
  }
  return flags;
}

}  // namespace graspd
