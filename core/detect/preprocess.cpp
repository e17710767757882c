#include "core/detect/preprocess.hpp"

#include <algorithm>
#include <cmath>

#include "core/detect/depth_noise.hpp"
#include "core/detect/edge_blur.hpp"
#include "core/detect/normals.hpp"

namespace graspd {

namespace {

/// A depth that is typical of the frame: the median of a sparse sample, by halving the range.
float typical_depth(const DepthFrame& frame) {
  constexpr std::size_t step = 97;
  float low = 0.0F;
  float high = 100.0F;
  for (int halving = 0; halving < 24; ++halving) {
    const float middle = 0.5F * (low + high);
    std::size_t nearer = 0;
    std::size_t all = 0;
    for (std::size_t i = 0; i < frame.depth.size(); i += step) {
      if (!is_measured(frame.depth[i])) continue;
      ++all;
      nearer += frame.depth[i] < middle ? 1 : 0;
    }
    (2 * nearer < all ? low : high) = middle;
  }
  return 0.5F * (low + high);
}

int stride_for(const DepthFrame& frame, float detail_pixels, float cells_per_detail, std::size_t most_cells) {
  int stride = std::max(1, static_cast<int>(std::lround(detail_pixels / cells_per_detail)));
  while (make_scene_map(frame.camera, stride, {}).camera.pixel_count() > most_cells) ++stride;
  return stride;
}

}  // namespace

PreprocessWorkspace carve_preprocess_workspace(Arena& arena, const DetectCapacity& capacity) {
  PreprocessWorkspace workspace;
  const std::size_t cells = capacity.map_cells;
  workspace.map_cells = arena.take<MapCell>(cells, "scene map");
  workspace.depths = arena.take<float>(cells, "scene map");
  workspace.empty_bin = carve_empty_bin(arena, cells);
  workspace.segments.parent = arena.take<std::uint32_t>(cells, "segmentation");
  workspace.segments.size = arena.take<std::uint32_t>(cells, "segmentation");
  workspace.edges.nearest = arena.take<std::uint32_t>(cells, "edges");
  workspace.sampling.keys = arena.take<VoxelKey>(cells, "sampling");
  workspace.sampling.scratch = arena.take<VoxelKey>(cells, "sampling");
  workspace.samples = FixedVector(arena.take<OrientedPoint>(capacity.scene_points, "sampling"));
  workspace.grid = carve_neighbour_grid(arena, capacity.scene_points);
  return workspace;
}

Scene preprocess(const DepthFrame& frame, const DepthFrame& empty_bin, float detail,
                 const PreprocessParameters& parameters, const Execution& execution, PreprocessWorkspace& workspace) {
  Scene scene;
  const float detail_pixels = detail * frame.camera.fx / std::max(typical_depth(frame), 0.01F);
  const int stride = stride_for(frame, detail_pixels, parameters.cells_per_detail, workspace.map_cells.size());
  // Fewer than asked for where the sensor resolves less.
  const float detail_cells = std::min(parameters.cells_per_detail, detail_pixels / static_cast<float>(stride));
  scene.map = make_scene_map(frame.camera, stride, workspace.map_cells);
  bin_frame(frame, execution, workspace.depths, scene.map);
  if (execution.late()) return scene;
  know_edge_blur(frame, detail, execution, scene.map.edge_blurs);
  if (execution.late()) return scene;

  const bool by_frame = parameters.background == BackgroundMode::automatic && !empty_bin.depth.empty();
  if (by_frame) {
    keep_empty_bin(empty_bin, stride, execution, workspace.depths, workspace.empty_bin);
    if (execution.late()) return scene;
    remove_background_by_frame(workspace.empty_bin, parameters.background_margin, execution, scene.map);
  } else if (parameters.background == BackgroundMode::automatic || parameters.background == BackgroundMode::plane) {
    scene.plane =
        remove_background_by_plane(parameters.background_margin, parameters.plane_slack * detail, execution, scene.map);
  } else if (parameters.background == BackgroundMode::box) {
    remove_background_by_box(parameters.box_from_camera, parameters.box_half_size, execution, scene.map);
  }
  if (parameters.has_region) {
    remove_background_by_box(parameters.region_from_camera, parameters.region_half_size, execution, scene.map);
  }
  if (execution.late()) return scene;
  if (parameters.segmentation) {
    // Drop-out tears a surface into pieces that are smaller than a detail; a lone speck is none, however small that is.
    const float cells = std::max(0.5F * detail_cells * detail_cells, 4.0F);
    segment_foreground(static_cast<std::uint32_t>(cells), execution, workspace.segments, scene.map);
    if (execution.late()) return scene;
  }
  scene.map.noise = measure_depth_noise(scene.map, execution, workspace.depths);
  if (execution.late()) return scene;
  const int radius = std::clamp(static_cast<int>(std::ceil(0.5F * detail_cells)), 1, 4);
  fit_normals(radius, execution, scene.map);
  if (execution.late()) return scene;

  scene.edges = {workspace.edges.nearest.first(scene.map.cells.size())};
  find_depth_edges(scene.map, static_cast<int>(2.0F * parameters.cells_per_detail), execution, scene.edges);

  for (const float depth : frame.depth) scene.measured_pixels += is_measured(depth) ? 1 : 0;
  for (const MapCell& cell : scene.map.cells) scene.foreground_cells += cell.foreground != 0 ? 1 : 0;
  return scene;
}

NeighbourGrid sample_for(const Scene& scene, float sampling, float reach, const Execution& execution,
                         PreprocessWorkspace& workspace) {
  sample_scene(scene.map, sampling, execution, workspace.sampling, workspace.samples);
  return build_neighbour_grid(workspace.samples.span(), 0.5F * reach, workspace.grid);
}

}  // namespace graspd
