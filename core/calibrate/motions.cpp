#include "core/calibrate/motions.hpp"

namespace graspd::hand_eye {

std::vector<Stop> stops_of(std::span<const HandEyePair> pairs, HandEyeSetup setup) {
  std::vector<Stop> stops;
  for (const HandEyePair& pair : pairs) {
    const bool in_hand = setup == HandEyeSetup::eye_in_hand;
    const Pose robot_from_flange = pose_of(pair.robot_from_flange);
    stops.push_back({in_hand ? robot_from_flange : inverse(robot_from_flange), pose_of(pair.camera_from_target)});
  }
  return stops;
}

std::vector<Motion> motions_between(std::span<const Stop> stops) {
  std::vector<Motion> motions;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    for (std::size_t j = i + 1; j < stops.size(); ++j) {
      motions.push_back({inverse(stops[j].carrier) * stops[i].carrier,
                         stops[j].camera_from_target * inverse(stops[i].camera_from_target)});
    }
  }
  return motions;
}

namespace {

/// The axis of a rotation times the sine of its angle. Near half a turn the sense of the axis is a matter of chance:
/// there nothing is left of it.
Eigen::Vector3d sine_and_axis(const Eigen::Matrix3d& rotation) {
  const Eigen::Matrix3d odd = 0.5 * (rotation - rotation.transpose());
  return {odd(2, 1), odd(0, 2), odd(1, 0)};
}

}  // namespace

Pose first_answer(std::span<const Motion> motions) {
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  for (const Motion& motion : motions) {
    correlation += sine_and_axis(motion.camera.rotation) * sine_and_axis(motion.carrier.rotation).transpose();
  }
  Pose answer;
  answer.rotation = nearest_rotation(correlation.transpose());

  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
  for (const Motion& motion : motions) {
    const Eigen::Matrix3d left = motion.carrier.rotation - Eigen::Matrix3d::Identity();
    const Eigen::Vector3d right = answer.rotation * motion.camera.translation - motion.carrier.translation;
    const Eigen::Matrix3d back = left.transpose();
    normal += back * left;
    slope += back * right;
  }
  const EigenDecomposition inverted = pseudo_inverse(normal);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Vector3d direction = inverted.vectors.col(i);
    answer.translation += inverted.values(i) * direction.dot(slope) * direction;
  }
  return answer;
}

Pose mean_pose(std::span<const Stop> stops, const Pose& mount) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  for (const Stop& stop : stops) {
    const Pose target = stop.carrier * mount * stop.camera_from_target;
    rotation += target.rotation;
    translation += target.translation;
  }
  return {nearest_rotation(rotation), translation / static_cast<double>(stops.size())};
}

}  // namespace graspd::hand_eye
