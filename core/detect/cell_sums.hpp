#pragma once

#include "core/geometry/lane_vectors.hpp"

namespace graspd {

/// Cells that some mask holds for, counted apart in each lane.
struct CellCount {
  LaneMask lanes{};

  void add(const LaneMask& mask) { lanes -= mask; }
  [[nodiscard]] float total() const { return static_cast<float>(lanes[0] + lanes[1] + lanes[2] + lanes[3]); }
};

/// Numbers summed up where some mask holds, apart in each lane.
struct CellSum {
  Lanes lanes{};

  void add(const Lanes& numbers, const LaneMask& mask) { lanes += mask ? numbers : Lanes{}; }
  [[nodiscard]] float total() const { return lanes[0] + lanes[1] + lanes[2] + lanes[3]; }
};

/// The outer products of normals, summed up.
struct NormalScatter {
  CellSum xx, xy, xz, yy, yz, zz;

  void add(const LaneVectors& normal, const LaneMask& mask) {
    xx.add(normal.x * normal.x, mask);
    xy.add(normal.x * normal.y, mask);
    xz.add(normal.x * normal.z, mask);
    yy.add(normal.y * normal.y, mask);
    yz.add(normal.y * normal.z, mask);
    zz.add(normal.z * normal.z, mask);
  }
  [[nodiscard]] Matrix3 total() const {
    Matrix3 scatter;
    scatter << xx.total(), xy.total(), xz.total(), xy.total(), yy.total(), yz.total(), xz.total(), yz.total(),
        zz.total();
    return scatter;
  }
};

}  // namespace graspd
