#include "core/detect/scene_map.hpp"

#include <algorithm>

#include "core/geometry/image_lanes.hpp"
#include "core/geometry/lane_vectors.hpp"

namespace graspd {

namespace {

/// Depth range [low, high] that holds the larger of the two surfaces seen in a block.
struct DepthRange {
  float low = 0;
  float high = 0;
  int count = 0;
};

template <class Visit>
void for_each_pixel(const DepthFrame& frame, int stride, int mu, int mv, Visit visit) {
  const int v_end = std::min((mv + 1) * stride, frame.camera.height);
  const int u_end = std::min((mu + 1) * stride, frame.camera.width);
  for (int v = mv * stride; v < v_end; ++v) {
    for (int u = mu * stride; u < u_end; ++u) {
      const float z = frame.at(u, v);
      if (z > 0.0F) visit(u, v, z);
    }
  }
}

DepthRange range_of_block(const DepthFrame& frame, int stride, int mu, int mv, float low, float high) {
  DepthRange range{high, low, 0};
  for_each_pixel(frame, stride, mu, mv, [&](int, int, float z) {
    if (z < low || z > high) return;
    range.low = std::min(range.low, z);
    range.high = std::max(range.high, z);
    ++range.count;
  });
  return range;
}

/// Halves the range, keeping the fuller half, until it is one surface.
DepthRange larger_surface(const DepthFrame& frame, int stride, int mu, int mv, float step) {
  DepthRange range = range_of_block(frame, stride, mu, mv, least_depth, greatest_depth);
  for (int halving = 0; halving < 8 && range.count > 0 && range.high - range.low > step; ++halving) {
    const float middle = 0.5F * (range.low + range.high);
    const DepthRange near = range_of_block(frame, stride, mu, mv, range.low, middle);
    const DepthRange far = range_of_block(frame, stride, mu, mv, std::nextafter(middle, greatest_depth), range.high);
    range = near.count >= far.count ? near : far;
  }
  return range;
}

/// The pixels of a block that lie in a depth range, summed up.
struct PixelSum {
  float u = 0;
  float v = 0;
  float z = 0;

  void add(int at_u, int at_v, float depth) {
    u += static_cast<float>(at_u);
    v += static_cast<float>(at_v);
    z += depth;
  }
  [[nodiscard]] Vector3 mean(const Camera& camera, int count) const {
    const float scale = 1.0F / static_cast<float>(count);
    return camera.point(u * scale, v * scale, z * scale);
  }
};

Vector3 mean_point(const DepthFrame& frame, int stride, int mu, int mv, const DepthRange& range) {
  PixelSum sum;
  for_each_pixel(frame, stride, mu, mv, [&](int u, int v, float z) {
    if (z >= range.low && z <= range.high) sum.add(u, v, z);
  });
  return sum.mean(frame.camera, range.count);
}

/// All that was measured in a block, in one pass.
struct WholeBlock {
  DepthRange range;
  PixelSum sum;
};

WholeBlock read_block(const DepthFrame& frame, int stride, int mu, int mv) {
  WholeBlock block{{greatest_depth, least_depth, 0}, {}};
  const int v_end = std::min((mv + 1) * stride, frame.camera.height);
  const int u_end = std::min((mu + 1) * stride, frame.camera.width);
  for (int v = mv * stride; v < v_end; ++v) {
    for (int u = mu * stride; u < u_end; ++u) {
      const float z = frame.at(u, v);
      // Without branches: whether a pixel was measured is hard to foretell.
      const bool measured = is_measured(z);
      block.range.low = measured && z < block.range.low ? z : block.range.low;
      block.range.high = measured && z > block.range.high ? z : block.range.high;
      block.range.count += measured ? 1 : 0;
      block.sum.add(measured ? u : 0, measured ? v : 0, measured ? z : 0.0F);
    }
  }
  return block;
}

/// The same of the blocks from (mu, mv) on, one in each lane; all of them whole.
struct WholeBlocks {
  Lanes low = Lanes{} + greatest_depth;
  Lanes high = Lanes{} + least_depth;
  LaneMask count{};
  Lanes u{};
  Lanes v{};
  Lanes z{};
};

WholeBlocks read_blocks(const DepthFrame& frame, int stride, int mu, int mv) {
  WholeBlocks blocks;
  const auto width = static_cast<float>(stride);
  const Lanes first_u = static_cast<float>(mu * stride) + Lanes{0.0F, width, 2.0F * width, 3.0F * width};
  for (int v = mv * stride; v < (mv + 1) * stride; ++v) {
    const float* const row = &frame.depth[frame.camera.index(mu * stride, v)];
    for (int k = 0; k < stride; ++k) {
      const Lanes z{row[k], row[stride + k], row[2 * stride + k], row[3 * stride + k]};
      const LaneMask measured = (z >= least_depth) & (z <= greatest_depth);
      blocks.low = (measured & (z < blocks.low)) ? z : blocks.low;
      blocks.high = (measured & (z > blocks.high)) ? z : blocks.high;
      blocks.count -= measured;
      blocks.u += measured ? first_u + static_cast<float>(k) : Lanes{};
      blocks.v += measured ? Lanes{} + static_cast<float>(v) : Lanes{};
      blocks.z += measured ? z : Lanes{};
    }
  }
  return blocks;
}

/// Bins one block by itself.
Vector3 bin_block(const DepthFrame& frame, const SceneMap& layout, int mu, int mv) {
  const int enough = layout.enough_pixels();
  const WholeBlock block = read_block(frame, layout.stride, mu, mv);
  if (block.range.count < enough) return Vector3::Zero();
  const float step = layout.surface_step(block.range.low);
  if (block.range.high - block.range.low <= step) return block.sum.mean(frame.camera, block.range.count);
  const DepthRange range = larger_surface(frame, layout.stride, mu, mv, step);
  return range.count >= enough ? mean_point(frame, layout.stride, mu, mv, range) : Vector3(Vector3::Zero());
}

/// Bins the blocks from (mu, mv) on, all of them whole.
LaneVectors bin_blocks(const DepthFrame& frame, const SceneMap& layout, int mu, int mv) {
  const Camera& camera = frame.camera;
  const WholeBlocks blocks = read_blocks(frame, layout.stride, mu, mv);
  const LaneMask full = blocks.count >= layout.enough_pixels();
  const LaneMask steep = full & (blocks.high - blocks.low > layout.surface_step(blocks.low));
  const Lanes scale = full ? 1.0F / __builtin_convertvector(blocks.count, Lanes) : Lanes{};
  const Lanes z = blocks.z * scale;
  LaneVectors points{(blocks.u * scale - camera.cx) / camera.fx * z, (blocks.v * scale - camera.cy) / camera.fy * z, z};
  if (any(steep)) {
    for (std::size_t i = 0; i < lane_count; ++i) {
      if (steep[i] != 0) points.set(i, bin_block(frame, layout, mu + static_cast<int>(i), mv));
    }
  }
  return points;
}

/// Calls store(u, v, point) for every block; z = 0: nothing was measured.
template <class Store>
void for_each_block(const DepthFrame& frame, const SceneMap& layout, const Execution& execution, Store store) {
  constexpr auto lanes = static_cast<int>(lane_count);
  parallel_for(layout.camera.height, execution, 8, [&](int v) {
    const int whole_blocks = (v + 1) * layout.stride <= frame.camera.height ? frame.camera.width / layout.stride : 0;
    const int in_lanes = whole_blocks / lanes * lanes;
    for (int u = 0; u < in_lanes; u += lanes) {
      const LaneVectors points = bin_blocks(frame, layout, u, v);
      for (int i = 0; i < lanes; ++i) store(u + i, v, points[static_cast<std::size_t>(i)]);
    }
    for (int u = in_lanes; u < layout.camera.width; ++u) store(u, v, bin_block(frame, layout, u, v));
  });
}

/// Which of the four cells from (u, v) on were measured and have neighbours on the same surface. depth_at(du, dv) gives
/// the depths of the cells beside them.
template <class DepthAt>
LaneMask supported(const SceneMap& layout, DepthAt depth_at) {
  const Lanes z = depth_at(0, 0);
  const Lanes step = layout.surface_step(z);
  const Lanes slanting_step = step * 1.5F;
  LaneMask support{};
  const auto ask = [&](int du, int dv, const Lanes& reach) {
    const Lanes other = depth_at(du, dv);
    support -= (other > 0.0F) & (magnitude(other - z) < reach);
  };
  for (const int dv : {-1, 1}) {
    ask(-1, dv, slanting_step);
    ask(0, dv, step);
    ask(1, dv, slanting_step);
  }
  ask(-1, 0, step);
  ask(1, 0, step);
  return (z > 0.0F) & (support >= 3);
}

/// Calls store(u, v, whether it is supported) for every cell.
template <class Store>
void for_each_supported(const SceneMap& layout, std::span<const float> depths, const Execution& execution,
                        Store store) {
  constexpr auto lanes = static_cast<int>(lane_count);
  const Camera& camera = layout.camera;
  parallel_for(camera.height, execution, 8, [&](int v) {
    for (int u = 0; u < camera.width; u += lanes) {
      const bool at_border = u == 0 || u + lanes >= camera.width || v == 0 || v + 1 == camera.height;
      const float* const here = &depths[camera.index(u, v)];
      const LaneMask four =
          at_border ? supported(layout, [&](int du, int dv) { return pixels_at(camera, depths, u + du, v + dv); })
                    : supported(layout, [&](int du, int dv) { return load_lanes(here + dv * camera.width + du); });
      for (int i = 0; i < std::min(lanes, camera.width - u); ++i)
        store(u + i, v, four[static_cast<std::size_t>(i)] != 0);
    }
  });
}

}  // namespace

SceneMap make_scene_map(const Camera& camera, int stride, std::span<MapCell> storage) {
  SceneMap map;
  map.stride = stride;
  const auto scale = static_cast<float>(stride);
  const float centre = 0.5F * (scale - 1.0F);
  map.camera.width = (camera.width + stride - 1) / stride;
  map.camera.height = (camera.height + stride - 1) / stride;
  map.camera.fx = camera.fx / scale;
  map.camera.fy = camera.fy / scale;
  map.camera.cx = (camera.cx - centre) / scale;
  map.camera.cy = (camera.cy - centre) / scale;
  map.cells = storage.first(std::min(map.camera.pixel_count(), storage.size()));
  return map;
}

void bin_frame(const DepthFrame& frame, const Execution& execution, std::span<float> depths, SceneMap& map) {
  for_each_block(frame, map, execution, [&](int u, int v, const Vector3& point) {
    MapCell& cell = map.at(u, v);
    cell = MapCell{};
    cell.point = point;
    depths[map.camera.index(u, v)] = point.z();
  });
  for_each_supported(map, depths, execution, [&](int u, int v, bool supported) {
    MapCell& cell = map.at(u, v);
    cell.foreground = supported ? 1 : 0;
    if (!supported) cell.point.setZero();
  });
}

void bin_depths(const DepthFrame& frame, const Execution& execution, const SceneMap& layout,
                std::span<float> unsupported, std::span<float> depths) {
  for_each_block(frame, layout, execution,
                 [&](int u, int v, const Vector3& point) { unsupported[layout.camera.index(u, v)] = point.z(); });
  for_each_supported(layout, unsupported, execution, [&](int u, int v, bool supported) {
    const std::size_t index = layout.camera.index(u, v);
    depths[index] = supported ? unsupported[index] : 0.0F;
  });
}

}  // namespace graspd
