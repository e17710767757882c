#include "tests/benchmarks/pcl_peer.hpp"

#include <algorithm>
#include <memory>

// PCL's headers do not pass this project's warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wextra"
#include <pcl/console/print.h>
#include <pcl/features/ppf.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/ppf_registration.h>
#pragma GCC diagnostic pop

#include "tests/benchmarks/scene_cloud.hpp"
#include "tests/benchmarks/thread_seconds.hpp"

namespace graspd {
namespace {

using Cloud = pcl::PointCloud<pcl::PointNormal>;

/// Scenes with fewer points are not searched.
constexpr std::size_t fewest_points = 20;

Cloud::Ptr cloud_of(const std::vector<OrientedPoint>& points) {
  auto cloud = std::make_shared<Cloud>();
  for (const OrientedPoint& point : points) {
    pcl::PointNormal added;
    added.getVector3fMap() = point.position;
    added.getNormalVector3fMap() = point.normal;
    cloud->push_back(added);
  }
  return cloud;
}

RigidTransform transform_of(const Eigen::Matrix4f& pose) {
  return {orthonormalised(pose.topLeftCorner<3, 3>()), pose.topRightCorner<3, 1>()};
}

/// A part with its hash map of features.
struct Trained {
  PclSettings settings;
  float diameter = 0;
  Cloud::Ptr model;
  std::vector<OrientedPoint> surface;
  pcl::PPFHashMapSearch::Ptr search;
};

std::shared_ptr<Trained> train(const MeshView& mesh, float diameter, const PclSettings& settings) {
  auto part = std::make_shared<Trained>();
  part->settings = settings;
  part->diameter = diameter;
  const std::vector<OrientedPoint> dense = points_on_mesh(mesh, 30000);
  const float voxel = settings.sampling * diameter;
  part->model = cloud_of(voxel_averages(dense, voxel, VoxelSampling::both_faces));
  part->surface = voxel_averages(dense, voxel * 0.5F, VoxelSampling::both_faces);
  auto features = std::make_shared<pcl::PointCloud<pcl::PPFSignature>>();
  pcl::PPFEstimation<pcl::PointNormal, pcl::PointNormal, pcl::PPFSignature> estimation;
  estimation.setInputCloud(part->model);
  estimation.setInputNormals(part->model);
  estimation.compute(*features);
  part->search = std::make_shared<pcl::PPFHashMapSearch>(settings.angle_step, voxel);
  part->search->setInputFeatureCloud(features);
  return part;
}

/// What of the part faces the camera in this pose: the rest cannot be in the scene and misleads ICP.
Cloud::Ptr visible_side(const Trained& part, const RigidTransform& pose) {
  std::vector<OrientedPoint> visible;
  for (const OrientedPoint& point : part.surface) {
    const OrientedPoint posed = pose * point;
    if (posed.normal.dot(posed.position) < 0.0F) visible.push_back(posed);
  }
  return cloud_of(visible);
}

RigidTransform refined(const Trained& part, const Cloud::Ptr& scene, const RigidTransform& pose) {
  const Cloud::Ptr side = visible_side(part, pose);
  if (side->size() < fewest_points) return pose;
  pcl::IterativeClosestPointWithNormals<pcl::PointNormal, pcl::PointNormal> icp;
  icp.setMaximumIterations(part.settings.icp_iterations);
  icp.setMaxCorrespondenceDistance(static_cast<double>(part.settings.icp_distance * part.diameter));
  icp.setInputSource(side);
  icp.setInputTarget(scene);
  Cloud moved;
  icp.align(moved);
  if (!icp.hasConverged()) return pose;
  const RigidTransform step = transform_of(icp.getFinalTransformation());
  return step * pose;
}

/// Removes the points that the part takes in this pose.
void remove_taken(const Trained& part, const RigidTransform& pose, std::vector<OrientedPoint>& scene) {
  pcl::KdTreeFLANN<pcl::PointNormal> tree;
  std::vector<OrientedPoint> posed;
  for (const OrientedPoint& point : part.surface) posed.push_back(pose * point);
  tree.setInputCloud(cloud_of(posed));
  const float reach = part.settings.taken_distance * part.diameter;
  std::erase_if(scene, [&](const OrientedPoint& point) {
    pcl::PointNormal asked;
    asked.getVector3fMap() = point.position;
    pcl::Indices nearest(1);
    std::vector<float> squared(1);
    return tree.nearestKSearch(asked, 1, nearest, squared) == 1 && squared[0] < reach * reach;
  });
}

PeerPoses find(const Trained& part, std::vector<OrientedPoint> scene) {
  PeerPoses found;
  const double start = thread_seconds();
  const Cloud::Ptr whole = cloud_of(scene);
  for (int i = 0; i < part.settings.instances && scene.size() >= fewest_points; ++i) {
    pcl::PPFRegistration<pcl::PointNormal, pcl::PointNormal> registration;
    registration.setSceneReferencePointSamplingRate(part.settings.reference_step);
    registration.setPositionClusteringThreshold(part.settings.cluster_position * part.diameter);
    registration.setRotationClusteringThreshold(part.settings.cluster_rotation);
    registration.setSearchMethod(part.search);
    registration.setInputSource(part.model);
    registration.setInputTarget(cloud_of(scene));
    Cloud moved;
    registration.align(moved);
    const RigidTransform pose = refined(part, whole, transform_of(registration.getFinalTransformation()));
    found.poses.push_back(pose);
    const std::size_t before = scene.size();
    remove_taken(part, pose, scene);
    if (scene.size() == before) break;
  }
  found.seconds = thread_seconds() - start;
  return found;
}

}  // namespace

Peer pcl_peer(const PclSettings& settings) {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  return {"PCL", settings.sampling, [settings](const MeshView& mesh, float diameter) {
            return [part = train(mesh, diameter, settings)](const std::vector<OrientedPoint>& scene) {
              return find(*part, scene);
            };
          }};
}

}  // namespace graspd
