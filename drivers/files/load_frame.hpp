#pragma once

#include <filesystem>

#include "core/status.hpp"
#include "drivers/files/cloud_projection.hpp"
#include "drivers/files/conventions.hpp"
#include "drivers/files/loaded_frame.hpp"

namespace graspd {

/// What a frame file does not say of itself.
struct FrameFileOptions {
  LengthUnit cloud_unit = LengthUnit::millimetres;  ///< For clouds.
  CameraAxes cloud_axes = CameraAxes::opencv;       ///< For clouds.
  std::filesystem::path camera_file;  ///< For depth images; empty: the BOP scene's, or that of the folder.
  std::filesystem::path empty_file;   ///< The bin without parts, same kind of file; empty: the scene's.
  ProjectionLimits limits;            ///< For clouds.
};

/// True for names that end like a frame's: .png, .tif, .tiff, .ply, .pcd.
[[nodiscard]] bool is_frame_file(const std::filesystem::path& path);

/// Reads one frame: a depth image (PNG, TIFF) or a point cloud (PLY, PCD), recognised by its extension.
/// A depth image takes its intrinsics from the camera file of `options`, else from the BOP scene that it
/// lies in (scene_camera.json in the folder above), which also gives the scene's empty frame, else from a
/// camera.json beside it or in the folder above.
/// Fails with bad_file for what cannot be read or has no intrinsics, with bad_frame for a wrong size, for a
/// frame that is all invalid or at whose distance no bin stands, and for an empty frame that is either.
[[nodiscard]] Result<LoadedFrame> load_frame(const std::filesystem::path& path, const FrameFileOptions& options);

}  // namespace graspd
