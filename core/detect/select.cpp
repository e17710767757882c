#include "core/detect/select.hpp"

#include <algorithm>
#include <numeric>

#include "core/detect/score.hpp"

namespace graspd {

namespace {

constexpr int most_rounds = 3;
constexpr float hopeless_score = 0.02F;

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

bool surer(const Instance& a, const Instance& b) { return a.score > b.score; }

/// What does not change while instances are selected.
struct Selection {
  const SceneMap& map;
  std::span<const Bank> banks;
  const VerifyParameters& parameters;
  float minimum_score;

  [[nodiscard]] float threshold(const Instance& instance) const {
    return minimum_score >= 0.0F ? minimum_score : banks[instance.bank].part->thresholds.minimum_score;
  }
};

/// The accepted instance, from 1, that claims the most of the model's surface; 0 for nobody. Found by majority vote
/// (Boyer and Moore 1981).
std::uint16_t main_claimant(const SceneMap& map, const RenderedModel& model, std::span<const std::uint16_t> claimed) {
  std::uint16_t holder = 0;
  int lead = 0;
  for (int v = 0; v < model.rectangle.height; ++v) {
    for (int u = 0; u < model.rectangle.width; ++u) {
      if (model.front[model.camera.index(u, v)] == 0.0F) continue;
      const std::uint16_t number = claimed[map.camera.index(model.rectangle.left + u, model.rectangle.top + v)];
      if (number == 0) continue;
      if (lead == 0) holder = number;
      lead += number == holder ? 1 : -1;
    }
  }
  return holder;
}

/// Whether two instances say something different: another part, or a pose that moves some of it by a tenth of the
/// diameter.
bool differ(const Bank& bank, const Instance& a, const Instance& b) {
  if (a.bank != b.bank) return true;
  constexpr std::size_t looked_at = 100;
  const float apart = 0.1F * bank.part->diameter;
  const RigidTransform nearest = nearest_symmetric(a.camera_from_part, b.camera_from_part, bank.symmetry());
  const std::size_t step = std::max<std::size_t>(1, bank.surface.size() / looked_at);
  for (std::size_t i = 0; i < bank.surface.size(); i += step) {
    const Vector3& point = bank.surface[i].position;
    if ((nearest * point - b.camera_from_part * point).squaredNorm() > apart * apart) return true;
  }
  return false;
}

/// Holds a pose of claimed surface against the instance that claims it. What it leaves unexplained speaks against it.
void note_rival(const Selection& selection, const Instance& rival, const RenderedModel& model,
                SelectWorkspace& workspace, const FixedVector<Instance>& accepted) {
  constexpr float worth_of_all = 5.0F;  // In log odds.
  const std::uint16_t holder = main_claimant(selection.map, model, workspace.claimed);
  if (holder == 0) return;
  const Instance& claimant = accepted[holder - 1U];
  if (!differ(selection.banks[rival.bank], rival, claimant)) return;
  const auto explained = [&](const Instance& instance) {
    const float diameter = selection.banks[instance.bank].part->diameter;
    return instance.evidence.confirmed * diameter * diameter;
  };
  const float unexplained = std::max(0.0F, 1.0F - explained(rival) / explained(claimant));
  Standing& standing = workspace.standings[holder - 1U];
  standing.rivals += rival_weight(standing.own - log_odds_of(rival.evidence, 0.0F) + worth_of_all * unexplained);
}

enum class Outcome : std::uint8_t { accepted, refused, no_room };

/// Judges a hypothesis anew by what the accepted ones leave of the scene, and claims its surface if it holds.
Outcome consider(const Selection& selection, Instance& instance, SelectWorkspace& workspace,
                 FixedVector<Instance>& accepted) {
  const Bank& bank = selection.banks[instance.bank];
  const VerifyParameters& parameters = selection.parameters;
  const float tolerance = surface_tolerance(selection.map, bank, parameters);
  const std::size_t used = used_room(workspace);
  const RenderedModel model = render_model(selection.map, bank, instance.camera_from_part,
                                           workspace.front.subspan(used), workspace.back.subspan(used));
  if (model.rectangle.empty() || accepted.full() || workspace.rooms.full()) return Outcome::no_room;
  const Evidence own = gather_evidence(selection.map, bank, model, parameters, workspace.claimed);
  instance.rejection = Rejection::none;
  if (own.confirmed < 0.5F * instance.evidence.confirmed) {
    instance.rejection = Rejection::duplicate;
    note_rival(selection, instance, model, workspace, accepted);
    return Outcome::refused;
  }
  const float alone = log_odds_of(instance.evidence, 0.0F);
  instance.evidence = own;
  instance.score = score_of(own, company_of(instance, accepted.span()));
  if (parameters.tests) instance.rejection = failed_test(own, parameters, bank.part->thresholds);
  if (instance.rejection == Rejection::none && instance.score < selection.threshold(instance))
    instance.rejection = Rejection::score;
  if (instance.rejection == Rejection::none && parameters.tests &&
      shared_room(model, workspace, 2.0F * tolerance) > 0.25F)
    instance.rejection = Rejection::intersecting;
  if (instance.rejection != Rejection::none) return Outcome::refused;
  claim(selection.map, model, tolerance, static_cast<std::uint16_t>(accepted.size() + 1), workspace.claimed);
  workspace.rooms.push_back({model.rectangle, used});
  workspace.standings.push_back({alone});
  accepted.push_back(instance);
  return Outcome::accepted;
}

/// Divides the scores between poses of the same surface; instances that are not sure enough then are rejected.
void settle_rivalries(const Selection& selection, std::span<const Standing> standings, FixedVector<Instance>& accepted,
                      FixedVector<Instance>& rejected) {
  for (std::size_t k = 0; k < accepted.size(); ++k) {
    Instance& instance = accepted[k];
    instance.score = score_of(instance.evidence, company_of(instance, accepted.span()));
    instance.score /= 1.0F + standings[k].rivals;
    if (instance.score < selection.threshold(instance)) instance.rejection = Rejection::ambiguous;
  }
  std::size_t kept = 0;
  for (const Instance& instance : accepted) {
    if (instance.rejection == Rejection::none) {
      accepted[kept++] = instance;
    } else {
      rejected.push_back(instance);
    }
  }
  accepted.truncate(kept);
}

/// Whether what others claim can still speak for a refused hypothesis.
bool may_recover(const Instance& instance) {
  return instance.score >= hopeless_score && instance.rejection != Rejection::weak &&
         instance.rejection != Rejection::duplicate && instance.rejection != Rejection::intersecting;
}

}  // namespace

SelectWorkspace carve_select_workspace(Arena& arena, const DetectCapacity& capacity) {
  SelectWorkspace workspace;
  workspace.claimed = arena.take<std::uint16_t>(capacity.map_cells, "selection");
  workspace.order = arena.take<std::uint32_t>(capacity.judged, "selection");
  workspace.front = arena.take<float>(std::size_t{3} * capacity.map_cells, "selection");
  workspace.back = arena.take<float>(std::size_t{3} * capacity.map_cells, "selection");
  workspace.rooms = FixedVector(arena.take<OccupiedRoom>(capacity.instances, "selection"));
  workspace.standings = FixedVector(arena.take<Standing>(capacity.instances, "selection"));
  return workspace;
}

std::uint32_t select_instances(const SceneMap& map, std::span<const Bank> banks, const VerifyParameters& parameters,
                               float minimum_score, const Execution& execution, std::span<Instance> judged,
                               SelectWorkspace& workspace, FixedVector<Instance>& accepted,
                               FixedVector<Instance>& rejected) {
  const Selection selection{map, banks, parameters, minimum_score};
  std::uint32_t flags = 0;
  workspace.rooms.clear();
  workspace.standings.clear();
  std::fill_n(workspace.claimed.begin(), map.cells.size(), std::uint16_t{0});
  std::span<std::uint32_t> order = workspace.order.first(judged.size());
  std::iota(order.begin(), order.end(), 0U);
  for (int round = 0; round < most_rounds && !order.empty() && !execution.late(); ++round) {
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return judged[a].score != judged[b].score ? surer(judged[a], judged[b]) : a < b;
    });
    const std::size_t accepted_before = accepted.size();
    std::size_t left = 0;
    for (const std::uint32_t j : order) {
      if (execution.late()) break;
      Instance& instance = judged[j];
      instance.score = score_of(instance.evidence, company_of(instance, accepted.span()));
      // The first round takes what holds by itself; later ones ask again, since neighbours that were taken
      // account for surfaces that spoke against a hypothesis.
      if (round == 0 && instance.rejection == Rejection::none && instance.score < selection.threshold(instance))
        instance.rejection = Rejection::score;
      const bool asked = round == 0 ? instance.rejection == Rejection::none : may_recover(instance);
      const Outcome outcome = asked ? consider(selection, instance, workspace, accepted) : Outcome::refused;
      if (outcome == Outcome::no_room) flags |= flag_instances_cut;
      if (outcome == Outcome::refused && may_recover(instance)) {
        order[left++] = j;
      } else if (outcome == Outcome::refused) {
        rejected.push_back(instance);
      }
    }
    order = order.first(left);
    if (round > 0 && accepted.size() == accepted_before) break;
  }
  for (const std::uint32_t j : order) rejected.push_back(judged[j]);
  settle_rivalries(selection, workspace.standings.span(), accepted, rejected);
  std::sort(accepted.begin(), accepted.end(), surer);
  return flags;
}

}  // namespace graspd
