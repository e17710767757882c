#pragma once

#include "core/detect/empty_bin.hpp"
#include "core/detect/execution.hpp"
#include "core/detect/parameters.hpp"
#include "core/detect/scene_map.hpp"

namespace graspd {

// What is marked once it is late is of no use.

/// What carries the parts, when it is a plane: n . x = offset with n towards the sensor.
struct SupportPlane {
  bool found = false;
  Vector3 normal = -Vector3::UnitZ();
  float offset = 0;  ///< Metres.

  [[nodiscard]] float height(const Vector3& point) const { return normal.dot(point) - offset; }
};

/// Marks as background what does not stand out from the nearest of the empty bin around it, and writes the depth of the
/// background into the cells of `map` where the empty bin was measured.
void remove_background_by_frame(const EmptyBin& empty, float margin, const Execution& execution, SceneMap& map);

/// Finds the dominant plane behind which next to nothing is measured, and marks what does not stand
/// out from it as background. Finds none when no such plane holds a fair share of the scene: then all
/// that is measured stays foreground. The plane is a guess, and no bin is flat to the millimetre: the depth of
/// the background is written `slack` metres below it.
[[nodiscard]] SupportPlane remove_background_by_plane(float margin, float slack, const Execution& execution,
                                                      SceneMap& map);

/// Marks as background what lies outside a box.
void remove_background_by_box(const RigidTransform& box_from_camera, const Vector3& half_size,
                              const Execution& execution, SceneMap& map);

}  // namespace graspd
