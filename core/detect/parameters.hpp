#pragma once

#include <cstdint>

#include "core/bank/bank.hpp"

namespace graspd {

/// How the background is found when there is no empty-bin frame.
enum class BackgroundMode : std::uint8_t {
  automatic,  ///< By the empty-bin frame when the request has one, else by the dominant plane.
  none,       ///< Everything measured is foreground.
  plane,      ///< The dominant plane and all beyond it.
  box,        ///< All outside a box.
};

/// Background removal, normals and sampling (paper 2.4.1).
struct PreprocessParameters {
  BackgroundMode background = BackgroundMode::automatic;
  float background_margin = 0.0015F;  ///< What stands out less than this (metres) from the background belongs to it.
  RigidTransform box_from_camera;     ///< For BackgroundMode::box.
  Vector3 box_half_size = Vector3::Zero();  ///< Metres; for BackgroundMode::box.
  bool segmentation = true;                 ///< Drop connected surfaces too small to be a part.
};

/// Bounds on what one detection may hold; they fix the memory of a workspace.
struct DetectCapacity {
  int maximum_width = 1280;
  int maximum_height = 960;
  std::uint32_t scene_points = 20000;
  std::uint32_t hypotheses = 20000;  ///< Peaks of the voting, over all references and views of one part.
  std::uint32_t clusters = 4000;
  std::uint32_t judged = 600;               ///< Hypotheses that are refined and verified, for one part.
  std::uint32_t instances = 100;            ///< Accepted, over all parts.
  std::uint32_t maximum_references = 8192;  ///< References of all views of one bank.
  std::uint32_t maximum_surface = 4096;     ///< Surface points of one bank.
  std::uint32_t maximum_parts = 8;
  int threads = 1;
};

/// Everything that can be set about a detection; a bank brings its own thresholds.
struct DetectParameters {
  PreprocessParameters preprocess;
  int threads = 1;
};

}  // namespace graspd
