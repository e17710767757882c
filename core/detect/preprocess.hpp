#pragma once

#include "core/bank/bank.hpp"
#include "core/detect/background.hpp"
#include "core/detect/depth_edges.hpp"
#include "core/detect/neighbour_grid.hpp"
#include "core/detect/parameters.hpp"
#include "core/detect/sampling.hpp"
#include "core/detect/scene_map.hpp"
#include "core/detect/segmentation.hpp"
#include "core/memory/arena.hpp"
#include "core/memory/fixed_vector.hpp"

namespace graspd {

/// The scene as the stages after the preprocessing see it.
struct Scene {
  SceneMap map;
  DepthEdges edges;
  SupportPlane plane;
  std::uint32_t measured_pixels = 0;
  std::uint32_t foreground_cells = 0;
};

struct PreprocessWorkspace {
  std::span<MapCell> map_cells;
  std::span<float> depths;  ///< Of a map that is being binned.
  EmptyBin empty_bin;
  SegmentWorkspace segments;
  DepthEdges edges;
  SamplingWorkspace sampling;
  FixedVector<OrientedPoint> samples;
  NeighbourGridStorage grid;
};

[[nodiscard]] PreprocessWorkspace carve_preprocess_workspace(Arena& arena, const DetectCapacity& capacity);

/// Bins the frame, removes the background, splits the rest into segments, fits normals and finds edges (paper 2.4.1),
/// at a resolution that suits a part whose poses are judged at `detail` metres. `empty_bin` may have no depth. Once it
/// is late, it returns what there is, of no use but for the size of the map.
[[nodiscard]] Scene preprocess(const DepthFrame& frame, const DepthFrame& empty_bin, float detail,
                               const PreprocessParameters& parameters, const Execution& execution,
                               PreprocessWorkspace& workspace);

/// The scene points that vote for a part sampled at `sampling`, in a grid for pairs up to `reach` apart. Once it is
/// late there are none.
[[nodiscard]] NeighbourGrid sample_for(const Scene& scene, float sampling, float reach, const Execution& execution,
                                       PreprocessWorkspace& workspace);

}  // namespace graspd
