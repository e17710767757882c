#pragma once

#include <filesystem>
#include <span>

#include "core/geometry/depth_frame.hpp"
#include "core/status.hpp"
#include "drivers/files/bop_dataset.hpp"

namespace graspd {

/// Writes a depth image as TIFF: one channel of 32-bit floats in metres, uncompressed, so that it reads back
/// as it was in every bit. Fails with cannot_write.
[[nodiscard]] Status write_depth_tiff(const std::filesystem::path& path, const DepthFrame& frame);

/// Adds `frame` to the BOP scene at `scene_folder`, which is made when it is not there: depth/<number>.tiff and
/// its intrinsics in scene_camera.json. Returns the image's path. Fails with cannot_write, and with bad_file
/// when the scene_camera.json that is there cannot be read.
[[nodiscard]] Result<std::filesystem::path> append_bop_image(const std::filesystem::path& scene_folder,
                                                             const DepthFrame& frame);

/// Makes `frame` the scene's frame of the bin without parts, empty/000000.tiff, with its intrinsics beside it.
/// Fails with cannot_write.
[[nodiscard]] Result<std::filesystem::path> write_bop_empty_bin(const std::filesystem::path& scene_folder,
                                                                const DepthFrame& frame);

/// Writes what is true of the scene's images: scene_gt.json, and the visible shares in scene_gt_info.json. Fails with
/// cannot_write.
[[nodiscard]] Status write_bop_ground_truth(const std::filesystem::path& scene_folder,
                                            std::span<const BopInstance> instances);

}  // namespace graspd
