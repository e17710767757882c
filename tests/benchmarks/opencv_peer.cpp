#include "tests/benchmarks/opencv_peer.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <memory>
#include <utility>

// OpenCV's headers do not pass this project's warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <opencv2/core.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/surface_matching.hpp>
#pragma GCC diagnostic pop

#include "tests/benchmarks/scene_cloud.hpp"
#include "tests/benchmarks/thread_seconds.hpp"

namespace graspd {
namespace {

constexpr float millimetres = 1000.0F;

cv::Mat matrix_of(const std::vector<OrientedPoint>& points) {
  cv::Mat matrix(static_cast<int>(points.size()), 6, CV_32F);
  for (int row = 0; row < matrix.rows; ++row) {
    const OrientedPoint& point = points[static_cast<std::size_t>(row)];
    for (int axis = 0; axis < 3; ++axis) {
      matrix.at<float>(row, axis) = point.position[axis] * millimetres;
      matrix.at<float>(row, axis + 3) = point.normal[axis];
    }
  }
  return matrix;
}

/// OpenCV's averaged quaternions do not always make a rotation: the nearest one counts.
RigidTransform transform_of(const cv::Matx44d& pose) {
  RigidTransform transform;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) transform.rotation(row, column) = static_cast<float>(pose(row, column));
    transform.translation[row] = static_cast<float>(pose(row, 3)) / millimetres;
  }
  transform.rotation = orthonormalised(transform.rotation);
  return transform;
}

cv::Matx44d matrix_of(const RigidTransform& transform) {
  cv::Matx44d pose = cv::Matx44d::eye();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) pose(row, column) = static_cast<double>(transform.rotation(row, column));
    pose(row, 3) = static_cast<double>(transform.translation[row] * millimetres);
  }
  return pose;
}

/// A part with its detector.
struct Trained {
  OpenCvSettings settings;
  float voxel = 0;  // Metres.
  mutable cv::ppf_match_3d::PPF3DDetector detector;
  std::vector<OrientedPoint> surface;

  /// What of the part faces the camera in this pose: the rest cannot be in the scene and misleads ICP.
  [[nodiscard]] cv::Mat visible_side(const RigidTransform& pose) const {
    std::vector<OrientedPoint> visible;
    for (const OrientedPoint& point : surface) {
      const OrientedPoint posed = pose * point;
      if (posed.normal.dot(posed.position) < 0.0F) visible.push_back(posed);
    }
    return matrix_of(visible);
  }
};

std::shared_ptr<Trained> train(const MeshView& mesh, float diameter, const OpenCvSettings& settings) {
  auto part = std::make_shared<Trained>(Trained{
      settings, static_cast<float>(settings.sampling) * diameter, {settings.sampling, settings.sampling, 30}, {}});
  part->detector.setSearchParams(settings.cluster_position * static_cast<double>(diameter * millimetres),
                                 settings.cluster_rotation);
  const std::vector<OrientedPoint> dense = points_on_mesh(mesh, 30000);
  // OpenCV samples by shares of each side of the bounding box, which is far denser than asked for on
  // parts that are not cubes, and slow: it gets the points at the voxel's distance.
  part->detector.trainModel(matrix_of(voxel_averages(dense, part->voxel, VoxelSampling::both_faces)));
  part->surface = voxel_averages(dense, part->voxel * 0.5F, VoxelSampling::both_faces);
  return part;
}

PeerPoses find(const Trained& part, const std::vector<OrientedPoint>& scene) {
  PeerPoses found;
  if (scene.size() < 10) return found;
  const cv::Mat cloud = matrix_of(scene);

  // OpenCV samples once more, relative to the scene's bounding box: half a voxel leaves the sampling as it is.
  Vector3 low = scene.front().position;
  Vector3 high = low;
  for (const OrientedPoint& point : scene) {
    low = low.cwiseMin(point.position);
    high = high.cwiseMax(point.position);
  }
  const double relative = std::max(1.0 / 150.0, 0.5 * static_cast<double>(part.voxel / (high - low).maxCoeff()));

  const double match_start = thread_seconds();
  std::vector<cv::ppf_match_3d::Pose3DPtr> poses;
  part.detector.match(cloud, poses, part.settings.reference_share, relative);
  found.seconds = thread_seconds() - match_start;
  if (poses.size() > static_cast<std::size_t>(part.settings.refined)) {
    poses.resize(static_cast<std::size_t>(part.settings.refined));
  }

  const OpenCvSettings& settings = part.settings;
  cv::ppf_match_3d::ICP icp(settings.icp_iterations, settings.icp_tolerance, settings.icp_rejection,
                            settings.icp_levels);
  const double refine_start = thread_seconds();
  for (const auto& candidate : poses) {
    const RigidTransform pose = transform_of(candidate->pose);
    const cv::Mat side = part.visible_side(pose);
    if (side.rows < 10) continue;
    double residual = 0;
    cv::Matx44d step;
    icp.registerModelToScene(side, cloud, residual, step);
    found.poses.push_back(transform_of(step * matrix_of(pose)));
  }
  found.seconds += thread_seconds() - refine_start;
  for (const auto& candidate : poses) found.poses.push_back(transform_of(candidate->pose));
  return found;
}

}  // namespace

Peer opencv_peer(const OpenCvSettings& settings) {
  cv::setNumThreads(1);
  return {"OpenCV", static_cast<float>(settings.sampling), [settings](const MeshView& mesh, float diameter) {
            return [part = train(mesh, diameter, settings)](const std::vector<OrientedPoint>& scene) {
              return find(*part, scene);
            };
          }};
}

}  // namespace graspd
