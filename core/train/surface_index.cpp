#include "core/train/surface_index.hpp"

#include <array>
#include <cstdint>
#include <nanoflann.hpp>

namespace graspd {

namespace {

/// Position and weighted normal as one point of six dimensions.
struct PointCloud {
  std::span<const OrientedPoint> points;
  float normal_weight = 0;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] float kdtree_get_pt(std::size_t index, std::size_t dimension) const {
    const OrientedPoint& p = points[index];
    if (dimension < 3) return p.position[static_cast<Eigen::Index>(dimension)];
    return p.normal[static_cast<Eigen::Index>(dimension - 3)] * normal_weight;
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
};

using KdTree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, PointCloud>, PointCloud, 6>;

}  // namespace

struct SurfaceIndex::Tree {
  PointCloud cloud;
  KdTree index;

  Tree(std::span<const OrientedPoint> points, float normal_weight) : cloud{points, normal_weight}, index(6, cloud) {}
};

SurfaceIndex::SurfaceIndex(std::span<const OrientedPoint> points, float normal_weight)
    : tree_(std::make_unique<Tree>(points, normal_weight)) {}

SurfaceIndex::~SurfaceIndex() = default;

std::size_t SurfaceIndex::nearest(const OrientedPoint& point) const {
  const float weight = tree_->cloud.normal_weight;
  const std::array<float, 6> query{point.position.x(),        point.position.y(),        point.position.z(),
                                   point.normal.x() * weight, point.normal.y() * weight, point.normal.z() * weight};
  std::uint32_t found = 0;
  float distance = 0;
  tree_->index.knnSearch(query.data(), 1, &found, &distance);
  return found;
}

std::span<const OrientedPoint> SurfaceIndex::points() const { return tree_->cloud.points; }

}  // namespace graspd
