#include "core/grasp/hidden_part.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/chance.hpp"
#include "core/grasp/hidden_places.hpp"

namespace graspd {
namespace {

/// Of the outline, so many points may be in sight: a corner is easily lost.
constexpr int forgiven = 1;
/// How far behind the tip of a jaw, and in how many steps, places on it are tried.
constexpr float tip_length = 0.036F;
constexpr int steps_along = 4;
/// Of the orientations with all anchors, at each place one in so many is tried.
constexpr std::size_t thinning = 4;
/// A share of poses that is hardly more than none.
constexpr float one_pose = 1e-4F;
constexpr std::size_t points_needed = TurnedPart::outline_points + TurnedPart::anchor_points;

/// Evenly drawn rotations (Shoemake 1992).
Matrix3 rotation_of(Chance& chance) {
  const float share = chance.unit();
  const float a = 6.2831853F * chance.unit();
  const float b = 6.2831853F * chance.unit();
  const float near = std::sqrt(1.0F - share);
  const float far = std::sqrt(share);
  return Eigen::Quaternionf(far * std::cos(b), near * std::sin(a), near * std::cos(a), far * std::sin(b))
      .toRotationMatrix();
}

/// Orientations in which parts are tried; camera_from_part.
const std::array<Matrix3, HiddenSpace::turns>& rotations() {
  static const std::array<Matrix3, HiddenSpace::turns> all = [] {
    std::array<Matrix3, HiddenSpace::turns> drawn;
    Chance chance(1);
    for (Matrix3& rotation : drawn) rotation = rotation_of(chance);
    return drawn;
  }();
  return all;
}

void turn_part(const Bank& bank, const Matrix3& rotation, TurnedPart& turned) {
  for (std::size_t i = 0; i < TurnedPart::outline_points; ++i) turned.outline[i] = rotation * bank.surface[i].position;
  for (std::size_t i = 0; i < TurnedPart::anchor_points; ++i) {
    turned.anchors[i] = rotation * bank.surface[TurnedPart::outline_points + i].position;
  }
  std::sort(turned.outline.begin(), turned.outline.end(),
            [](const Vector3& a, const Vector3& b) { return a.z() < b.z(); });
}

/// A part in one orientation; of the first banks all are made when one is asked for, others in `spare`.
const TurnedPart& turned_part(const HiddenSpace& space, std::size_t bank, std::size_t turn, TurnedPart& spare) {
  if (bank >= HiddenSpace::kept_banks) {
    turn_part(space.banks[bank], rotations()[turn], spare);
    return spare;
  }
  const std::span<TurnedPart> kept = space.turned.subspan(bank * HiddenSpace::turns, HiddenSpace::turns);
  if (space.is_turned[bank] == 0) {
    for (std::size_t i = 0; i < HiddenSpace::turns; ++i) turn_part(space.banks[bank], rotations()[i], kept[i]);
    space.is_turned[bank] = 1;
  }
  return kept[turn];
}

/// Whether a part in one orientation, moved to `place`, would be hidden whole.
bool hide(const HiddenPlaces& hidden, const TurnedPart& turned, const Vector3& place) {
  int in_sight = 0;
  return std::all_of(turned.outline.begin(), turned.outline.end(),
                     [&](const Vector3& point) { return hidden.hold(point + place) || ++in_sight <= forgiven; });
}

/// Places on the pieces that touch the held part, those of a group together: of the poses, every group tries others.
struct TriedPlaces {
  struct Group {
    std::array<Vector3, 4 * steps_along*(maximum_tool_boxes + 3) / thinning> places;
    std::size_t count = 0;
  };
  std::array<Group, thinning> groups;
  std::size_t all = 0;  ///< Hidden or not.
  bool any = false;     ///< One of them is hidden.
};

/// Corners of a piece, from its tip backwards.
Vector3 place_on(const GripperPiece& piece, int number) {
  const Box tip = tip_of(piece.box, tip_length);
  Vector3 place = tip.corner(static_cast<std::size_t>(number % 4) | 4U);
  const int steps_back = number / 4;
  place.z() -= (tip.upper.z() - tip.lower.z()) * static_cast<float>(steps_back) / static_cast<float>(steps_along - 1);
  return place;
}

TriedPlaces tried_places(const HiddenPlaces& hidden, const RigidTransform& camera_from_tool, const Gripper& gripper) {
  TriedPlaces tried;
  for (const GripperPiece& piece : gripper.all()) {
    if (!piece.touches_part) continue;
    for (int i = 0; i < 4 * steps_along; ++i, ++tried.all) {
      const Vector3 place = camera_from_tool * place_on(piece, i);
      if (!hidden.hold(place)) continue;
      TriedPlaces::Group& group = tried.groups[static_cast<std::size_t>(i + i / 4) % thinning];
      group.places[group.count++] = place;
      tried.any = true;
    }
  }
  return tried;
}

}  // namespace

float hidden_part_clearance(float share, const CollisionParameters& parameters) {
  return parameters.hidden_clearance * std::log10(1.0F + share / one_pose);
}

float hidden_part_share_at(float clearance, const CollisionParameters& parameters) {
  const float tenfolds = parameters.hidden_clearance > 0.0F ? clearance / parameters.hidden_clearance : 10.0F;
  return one_pose * (std::pow(10.0F, std::min(tenfolds, 10.0F)) - 1.0F);
}

float hidden_part_share(const HiddenSpace& space, std::size_t bank, const BinWalls& walls,
                        const RigidTransform& camera_from_tool, const Gripper& gripper, float most) {
  if (space.banks[bank].surface.size() < points_needed) return 0.0F;
  const HiddenPlaces hidden(space, walls);
  const TriedPlaces tried = tried_places(hidden, camera_from_tool, gripper);
  if (!tried.any) return 0.0F;
  const std::size_t poses_tried = tried.all * HiddenSpace::turns * TurnedPart::anchor_points / thinning;
  const auto poses = static_cast<float>(poses_tried);
  TurnedPart spare;
  std::size_t count = 0;
  for (std::size_t turn = 0; turn < HiddenSpace::turns; ++turn) {
    const TurnedPart& turned = turned_part(space, bank, turn, spare);
    for (std::size_t anchor = 0; anchor < TurnedPart::anchor_points; ++anchor) {
      const TriedPlaces::Group& group = tried.groups[(turn + anchor) % thinning];
      for (std::size_t i = 0; i < group.count; ++i) {
        if (hide(hidden, turned, group.places[i] - turned.anchors[anchor])) ++count;
      }
    }
    if (static_cast<float>(count) > most * poses) break;
  }
  return static_cast<float>(count) / poses;
}

}  // namespace graspd
