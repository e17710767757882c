#include "core/train/part_likeness.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "core/train/bank_builder.hpp"
#include "core/train/part_mesh.hpp"
#include "core/train/symmetry_detection.hpp"
#include "core/train/twins.hpp"

namespace graspd {

namespace {

// Mean distances, as shares of the diameter.
constexpr float doubtful_symmetry = 0.02F;
constexpr float impossible_symmetry = 0.1F;

/// How far the symmetries turn the part's middle away from where it is (metres).
float moved_middle(const SymmetryGroup& group, const Vector3& middle) {
  float most = 0;
  for (const RigidTransform& member : sampled_members(group, 8)) {
    most = std::max(most, (member * middle - middle).norm());
  }
  return most;
}

Result<SymmetryGroup> given_symmetry(const PartDescription& part, const PartMesh& mesh,
                                     std::vector<std::string>& remarks) {
  const SymmetryGroup group =
      close_group(part.symmetry_discrete, part.symmetry_continuous, part.symmetry_axis, mesh.diameter);
  const float miss = group_distance(mesh.mesh, group, mesh.diameter);
  const Vector3 middle = 0.5F * (mesh.box_min + mesh.box_max);
  const float moved = moved_middle(group, middle);
  if (miss > impossible_symmetry || moved > 0.5F * mesh.diameter) {
    const Vector3 at = 1e3F * middle;
    return Status::format(StatusCode::bad_configuration,
                          "[symmetry] turns the part %.0f mm away from itself: give the axis its offset; the part's "
                          "middle is at (%.1f, %.1f, %.1f)",
                          1e3 * static_cast<double>(std::max(miss * mesh.diameter, moved)), static_cast<double>(at.x()),
                          static_cast<double>(at.y()), static_cast<double>(at.z()));
  }
  if (miss > doubtful_symmetry) {
    remarks.push_back("the symmetries given do not fit the mesh: it comes to lie " +
                      std::to_string(std::lround(100.0F * miss)) + "% of the diameter beside itself");
  }
  return group;
}

std::string describe_twins(const std::vector<RigidTransform>& twins) {
  const Eigen::AngleAxisf turn(twins.front().rotation);
  const Vector3& axis = turn.axis();
  char text[160];
  std::snprintf(text, sizeof(text),
                "nearly looks the same in other poses, most of all turned by %.0f degrees about (%.2f, %.2f, %.2f): ",
                static_cast<double>(turn.angle()) * 180.0 / std::numbers::pi, static_cast<double>(axis.x()),
                static_cast<double>(axis.y()), static_cast<double>(axis.z()));
  return std::string(text) +
         "where that cannot be told it is not picked, unless the part file gives the turn as a symmetry";
}

}  // namespace

Result<PartLikeness> likeness_of(const PartDescription& part, const PartMesh& mesh) {
  PartLikeness likeness;
  likeness.proposed = !part.symmetry_given;
  if (likeness.proposed) {
    likeness.symmetry = detect_symmetry(mesh.mesh, mesh.diameter);
    likeness.remarks.push_back("symmetries found on the mesh: " + describe(likeness.symmetry));
  } else {
    Result<SymmetryGroup> given = given_symmetry(part, mesh, likeness.remarks);
    if (!given.ok()) return given.status();
    likeness.symmetry = std::move(given).value();
  }
  likeness.twins = part.twins.has_value() ? *part.twins : find_twins(mesh.mesh, likeness.symmetry, mesh.diameter);
  if (!likeness.twins.empty()) likeness.remarks.push_back(describe_twins(likeness.twins));
  return likeness;
}

}  // namespace graspd
