#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/grasp/parameters.hpp"
#include "core/grasp/pick.hpp"

namespace graspd {

/// A pose as the files of graspd write it: x, y, z in millimetres, then the quaternion x, y, z, w.
[[nodiscard]] std::array<double, 7> pose_values(const RigidTransform& pose);

/// The best pick, why the others fell and where the bin stands, for a person: poses in millimetres and quaternions x,
/// y, z, w.
[[nodiscard]] std::string picks_as_text(const PickResult& result, const GraspParameters& parameters);

/// The same as JSON; every pick, in the order to pick them.
[[nodiscard]] nlohmann::ordered_json picks_as_json(const PickResult& result);

}  // namespace graspd
