#pragma once

#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/parameters.hpp"
#include "core/detect/scene_map.hpp"
#include "core/detect/verify.hpp"
#include "core/geometry/rigid_transform.hpp"

namespace graspd {

/// A pose that was refined against every cell of the map it covers.
struct DenseFit {
  RigidTransform camera_from_part;
  float residual = 0;      ///< Root mean square distance of the cells that agree (metres).
  bool supported = false;  ///< Enough of them do; else the pose is as it was.
};

/// Refines a pose that is already close against all cells that the rendered model covers (point-to-plane ICP with
/// projective association, Blais and Levine 1995), so that what is left of its error is below the noise of a cell.
/// `tolerance` (metres): cells further from the model do not take part. `image` holds the rendering meanwhile.
[[nodiscard]] DenseFit refine_densely(const SceneMap& map, const Bank& bank, const RigidTransform& camera_from_part,
                                      float tolerance, std::span<float> image);

/// What measured depths look like.
struct DepthNoise {
  float deviation = 0;  ///< Of the distances between the measured surface and the true one (metres).
  float spread = 0;     ///< Over which depths whatever else is there may lie (metres).
};

/// How much likelier the measured depths are if the part stands there than if anything does, in natural logarithms and
/// summed up over the cells that the model covers: distances are normal, apart from what stands in front and from
/// outliers. The difference of two poses tells which of them explains the scene.
[[nodiscard]] float log_likelihood(const SceneMap& map, const Bank& bank, const RigidTransform& camera_from_part,
                                   const DepthNoise& noise, std::span<float> image);

}  // namespace graspd
