#pragma once

#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"

namespace graspd {

/// A sphere that holds an instance.
struct BoundingSphere {
  Vector3 centre = Vector3::Zero();  ///< Camera frame.
  float radius = 0;
};

/// The one about the middle of the bounding box.
[[nodiscard]] inline BoundingSphere bounding_sphere(const Instance& instance, std::span<const Bank> banks) {
  const BankPart& part = *banks[instance.bank].part;
  return {instance.camera_from_part * Vector3(0.5F * (part.box_min + part.box_max)),
          0.5F * (part.box_max - part.box_min).norm()};
}

}  // namespace graspd
