#include "core/detect/select.hpp"

#include <omp.h>

#include <algorithm>
#include <numeric>

#include "core/detect/score.hpp"

namespace graspd {

namespace {

constexpr int most_rounds = 3;
constexpr float hopeless_score = 0.02F;

bool surer(const Instance& a, const Instance& b) { return a.score > b.score; }

/// What does not change while instances are selected.
struct Selection {
  const SceneMap& map;
  std::span<const Bank> banks;
  const VerifyParameters& parameters;
  float minimum_score;

  [[nodiscard]] float tolerance(const Instance& instance) const {
    return surface_tolerance(map, banks[instance.bank], parameters);
  }
  [[nodiscard]] float threshold(const Instance& instance) const {
    return minimum_score >= 0.0F ? minimum_score : banks[instance.bank].part->thresholds.minimum_score;
  }
};

/// Notes a pose of surface that is claimed, to be held against the instance that claims it.
void note_rival(const Selection& selection, const Instance& rival, std::size_t holder, SelectWorkspace& workspace) {
  Standing& standing = workspace.standings[holder];
  if (standing.rivals == most_rivals || lead_by_evidence(selection.banks, standing.alone, rival) >= hopeless_lead ||
      !differ(selection.banks, rival, standing.alone))
    return;
  workspace.rivals.push_back({static_cast<std::uint32_t>(holder), rival});
  ++standing.rivals;
}

/// Judges an instance by `own`, what the others leave it of the scene, and by the room that they leave.
void judge_among_others(const Selection& selection, const RenderedModel& model, const Evidence& own,
                        const ClaimedScene& claims, std::span<const Instance> others, Instance& instance) {
  const Bank& bank = selection.banks[instance.bank];
  const VerifyParameters& parameters = selection.parameters;
  instance.evidence = own;
  instance.score = score_of(own, company_of(instance, others));
  instance.rejection = parameters.tests ? failed_test(own, parameters, bank.part->thresholds) : Rejection::none;
  if (instance.rejection == Rejection::none && instance.score < selection.threshold(instance))
    instance.rejection = Rejection::score;
  if (instance.rejection == Rejection::none && parameters.tests &&
      shared_room(model, claims, 2.0F * selection.tolerance(instance)) > 0.25F)
    instance.rejection = Rejection::intersecting;
}

enum class Outcome : std::uint8_t { accepted, refused, no_room };

/// Judges a hypothesis anew by what the accepted ones leave of the scene, and claims its surface if it holds.
Outcome consider(const Selection& selection, Instance& instance, SelectWorkspace& workspace,
                 FixedVector<Instance>& accepted) {
  ClaimedScene& claims = workspace.claims;
  const Bank& bank = selection.banks[instance.bank];
  const ClaimedShare claimed =
      claimed_share(selection.map, bank, instance.camera_from_part, selection.tolerance(instance), claims);
  if (claimed.share > 0.5F) {
    instance.rejection = Rejection::duplicate;
    note_rival(selection, instance, claimed.holder, workspace);
    return Outcome::refused;
  }
  const std::size_t room = free_room(claims);
  const RenderedModel model = render_into(claims, room, selection.map, bank, instance.camera_from_part);
  if (model.rectangle.empty() || accepted.full() || claims.rooms.full()) return Outcome::no_room;
  const Evidence own = gather_evidence(selection.map, bank, model, selection.parameters, claims.cells);
  const Instance alone = instance;
  judge_among_others(selection, model, own, claims, accepted.span(), instance);
  if (instance.rejection != Rejection::none) return Outcome::refused;
  claim(selection.map, model, selection.tolerance(instance), accepted.size(), claims);
  claims.rooms.push_back({model.rectangle, room});
  workspace.standings.push_back({alone, 0, {}, 0.0F});
  accepted.push_back(instance);
  return Outcome::accepted;
}

/// Among the rejected, `former` takes the place of the rival that has won.
void refuse_instead(const Instance& former, const Instance& rival, FixedVector<Instance>& rejected) {
  const RigidTransform& pose = rival.camera_from_part;
  Instance* const place = std::find_if(rejected.begin(), rejected.end(), [&](const Instance& refused) {
    return refused.bank == rival.bank && refused.camera_from_part.translation == pose.translation &&
           refused.camera_from_part.rotation == pose.rotation;
  });
  if (place == rejected.end()) return;
  *place = former;
  place->rejection = Rejection::duplicate;
}

/// Puts the winner of the contest for accepted instance k in its place, if it holds beside all others: the instance
/// itself with its pose refined, or a rival, which changes places with it.
void adopt_winner(const Selection& selection, std::size_t k, SelectWorkspace& workspace,
                  FixedVector<Instance>& accepted, FixedVector<Instance>& rejected) {
  ClaimedScene& claims = workspace.claims;
  Standing& standing = workspace.standings[k];
  OccupiedRoom& room = claims.rooms[k];
  const OccupiedRoom former_room = room;
  const RenderedModel former_model = model_in(selection.map, former_room, claims);
  Instance winner = standing.outcome.winner;
  const Bank& bank = selection.banks[winner.bank];
  const std::size_t new_room = free_room(claims);
  const RenderedModel model = render_into(claims, new_room, selection.map, bank, winner.camera_from_part);
  release(selection.map, former_model, k, claims);
  room.rectangle = {};
  const Instance former = accepted[k];
  // In its place already, or the instance that it replaces would be company to it.
  accepted[k] = winner;
  bool holds = !model.rectangle.empty();
  if (holds) {
    const Evidence own = gather_evidence(selection.map, bank, model, selection.parameters, claims.cells);
    judge_among_others(selection, model, own, claims, accepted.span(), winner);
    holds = winner.rejection == Rejection::none;
  }
  if (!holds) {
    accepted[k] = former;
    room = former_room;
    claim(selection.map, former_model, selection.tolerance(former), k, claims);
    return;
  }
  accepted[k] = winner;
  standing.others = standing.outcome.others;
  if (standing.outcome.rival != no_rival)
    refuse_instead(former, workspace.rivals[standing.outcome.rival].instance, rejected);
  room = {model.rectangle, new_room};
  claim(selection.map, model, selection.tolerance(winner), k, claims);
}

/// Compares the poses of each surface of which several were judged.
void settle_contests(const Selection& selection, const Execution& execution, std::span<const std::span<float>> images,
                     SelectWorkspace& workspace, FixedVector<Instance>& accepted, FixedVector<Instance>& rejected) {
  // Those that time is not left for are to have an outcome too.
  parallel_for(accepted.size(), execution.threads, 1, [&](std::size_t k) {
    Standing& standing = workspace.standings[k];
    if (standing.rivals == 0) return;
    standing.outcome = hold_contest(selection.map, selection.banks, selection.parameters, execution, standing.alone,
                                    workspace.rivals.span(), static_cast<std::uint32_t>(k),
                                    images[static_cast<std::size_t>(omp_get_thread_num())]);
    standing.others = standing.outcome.others_of_own;
  });
  for (std::size_t k = 0; k < accepted.size() && !execution.late(); ++k) {
    if (workspace.standings[k].rivals > 0) adopt_winner(selection, k, workspace, accepted, rejected);
  }
}

/// Divides the scores between poses of the same surface; instances that are not sure enough then are rejected.
void share_scores(const Selection& selection, std::span<const Standing> standings, FixedVector<Instance>& accepted,
                  FixedVector<Instance>& rejected) {
  for (std::size_t k = 0; k < accepted.size(); ++k) {
    Instance& instance = accepted[k];
    instance.score = score_of(instance.evidence, company_of(instance, accepted.span()));
    instance.score /= 1.0F + standings[k].others;
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
  workspace.claims = carve_claimed_scene(arena, capacity);
  workspace.order = arena.take<std::uint32_t>(capacity.judged, "selection");
  workspace.standings = FixedVector(arena.take<Standing>(capacity.instances, "selection"));
  workspace.rivals = FixedVector(arena.take<Rival>(most_rivals * capacity.instances, "selection"));
  return workspace;
}

std::uint32_t select_instances(const SceneMap& map, std::span<const Bank> banks, const VerifyParameters& parameters,
                               float minimum_score, const Execution& execution,
                               std::span<const std::span<float>> images, std::span<Instance> judged,
                               SelectWorkspace& workspace, FixedVector<Instance>& accepted,
                               FixedVector<Instance>& rejected) {
  const Selection selection{map, banks, parameters, minimum_score};
  std::uint32_t flags = 0;
  workspace.claims.rooms.clear();
  workspace.standings.clear();
  workspace.rivals.clear();
  std::fill_n(workspace.claims.cells.begin(), map.cells.size(), std::uint16_t{0});
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
  settle_contests(selection, execution, images, workspace, accepted, rejected);
  share_scores(selection, workspace.standings.span(), accepted, rejected);
  std::sort(accepted.begin(), accepted.end(), surer);
  return flags;
}

}  // namespace graspd
