#pragma once

#include "core/geometry/rigid_transform.hpp"

namespace graspd {

/// A surface point (metres) with its outward unit normal.
struct OrientedPoint {
  Vector3 position = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();
};

[[nodiscard]] inline OrientedPoint operator*(const RigidTransform& t, const OrientedPoint& p) {
  return {t * p.position, t.rotation * p.normal};
}

}  // namespace graspd
