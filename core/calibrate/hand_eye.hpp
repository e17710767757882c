#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

namespace graspd {

/// Where the camera is.
enum class HandEyeSetup : std::uint8_t {
  eye_in_hand,  ///< On the flange; the target stands still. Solved for flange_from_camera.
  eye_to_hand,  ///< Fixed; the target is held by the robot. Solved for robot_from_camera.
};

/// One stop of the robot. Metres.
struct HandEyePair {
  Eigen::Isometry3d robot_from_flange = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d camera_from_target = Eigen::Isometry3d::Identity();  ///< The part or board, as it was detected.
};

/// What one pair disagrees with the solution by.
struct HandEyeResidual {
  double translation = 0;  ///< Metres, of the target.
  double rotation = 0;     ///< Radians.
};

/// What the motions leave open; several may hold.
enum HandEyeWarning : std::uint32_t {
  hand_eye_few_pairs = 1U << 0U,  ///< Fewer than five pairs: nothing is left to tell a good answer from a bad one.
  hand_eye_no_turn = 1U << 1U,    ///< The flange hardly turned between the stops: nothing is determined.
  hand_eye_one_axis = 1U << 2U,   ///< All turns are about one axis: the place along that axis is not determined.
  hand_eye_outlier = 1U << 3U,    ///< One pair disagrees far more than the others.
};

/// The outcome of a calibration.
struct HandEyeSolution {
  Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();   ///< flange_from_camera or robot_from_camera.
  Eigen::Isometry3d target = Eigen::Isometry3d::Identity();  ///< robot_from_target or flange_from_target.
  std::vector<HandEyeResidual> residuals;                    ///< One for each pair.
  HandEyeResidual rms;                                       ///< Root mean square of them.
  double translation_deviation = 0;  ///< Metres: standard deviation of the mount where it is determined worst.
  double rotation_deviation = 0;     ///< Radians, likewise.
  double turn_spread = 0;            ///< Radians: how far the flange turned about the second most used axis.
  Eigen::Vector3d turn_axis = Eigen::Vector3d::Zero();  ///< The most used axis, frame of the flange; of the robot when
                                                        ///< the camera is fixed.
  std::uint32_t warnings = 0;                           ///< HandEyeWarning bits.
};

/// Solves AX = XB for where the camera is: a first answer in closed form by Park and Martin (IEEE Trans. Robotics and
/// Automation 10, 1994), then Levenberg-Marquardt on all pairs for camera and target together. A radian weighs as much
/// as the mean distance between camera and target in metres. Needs at least three pairs.
[[nodiscard]] HandEyeSolution solve_hand_eye(std::span<const HandEyePair> pairs, HandEyeSetup setup);

}  // namespace graspd
