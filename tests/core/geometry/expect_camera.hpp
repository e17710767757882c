#pragma once

#include <gtest/gtest.h>

#include "core/geometry/camera.hpp"

namespace graspd {

/// Expects the same size and intrinsics, but for rounding.
inline void expect_same_camera(const Camera& camera, const Camera& expected) {
  EXPECT_EQ(camera.width, expected.width);
  EXPECT_EQ(camera.height, expected.height);
  EXPECT_FLOAT_EQ(camera.fx, expected.fx);
  EXPECT_FLOAT_EQ(camera.fy, expected.fy);
  EXPECT_FLOAT_EQ(camera.cx, expected.cx);
  EXPECT_FLOAT_EQ(camera.cy, expected.cy);
}

}  // namespace graspd
