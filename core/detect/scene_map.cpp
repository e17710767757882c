#include "core/detect/scene_map.hpp"

#include <algorithm>
#include <array>

#include "core/geometry/lanes.hpp"

namespace graspd {

namespace {

/// Depths (metres) beyond these are no measurements.
constexpr float nearest_depth = 1e-6F;
constexpr float furthest_depth = 1e6F;

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
  DepthRange range = range_of_block(frame, stride, mu, mv, nearest_depth, furthest_depth);
  for (int halving = 0; halving < 8 && range.count > 0 && range.high - range.low > step; ++halving) {
    const float middle = 0.5F * (range.low + range.high);
    const DepthRange near = range_of_block(frame, stride, mu, mv, range.low, middle);
    const DepthRange far = range_of_block(frame, stride, mu, mv, std::nextafter(middle, furthest_depth), range.high);
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
  WholeBlock block{{furthest_depth, nearest_depth, 0}, {}};
  const int v_end = std::min((mv + 1) * stride, frame.camera.height);
  const int u_end = std::min((mu + 1) * stride, frame.camera.width);
  for (int v = mv * stride; v < v_end; ++v) {
    for (int u = mu * stride; u < u_end; ++u) {
      const float z = frame.at(u, v);
      // Without branches: whether a pixel was measured is hard to foretell.
      const bool measured = z >= nearest_depth && z <= furthest_depth;
      block.range.low = measured && z < block.range.low ? z : block.range.low;
      block.range.high = measured && z > block.range.high ? z : block.range.high;
      block.range.count += measured ? 1 : 0;
      block.sum.add(measured ? u : 0, measured ? v : 0, measured ? z : 0.0F);
    }
  }
  return block;
}

/// The blocks from (mu, mv) on, one in each lane, as read_block() reads each; all of them whole.
std::array<WholeBlock, lane_count> read_blocks(const DepthFrame& frame, int stride, int mu, int mv) {
  Lanes low = Lanes{} + furthest_depth;
  Lanes high = Lanes{} + nearest_depth;
  Lanes sum_u{};
  Lanes sum_v{};
  Lanes sum_z{};
  LaneMask count{};
  const auto width = static_cast<float>(stride);
  const Lanes first_u = static_cast<float>(mu * stride) + Lanes{0.0F, width, 2.0F * width, 3.0F * width};
  for (int v = mv * stride; v < (mv + 1) * stride; ++v) {
    const float* const row = &frame.depth[frame.camera.index(mu * stride, v)];
    for (int k = 0; k < stride; ++k) {
      const Lanes z{row[k], row[stride + k], row[2 * stride + k], row[3 * stride + k]};
      const LaneMask measured = (z >= nearest_depth) & (z <= furthest_depth);
      low = (measured & (z < low)) ? z : low;
      high = (measured & (z > high)) ? z : high;
      count -= measured;
      sum_u += measured ? first_u + static_cast<float>(k) : Lanes{};
      sum_v += measured ? Lanes{} + static_cast<float>(v) : Lanes{};
      sum_z += measured ? z : Lanes{};
    }
  }
  std::array<WholeBlock, lane_count> blocks;
  for (std::size_t i = 0; i < lane_count; ++i)
    blocks[i] = {{low[i], high[i], count[i]}, {sum_u[i], sum_v[i], sum_z[i]}};
  return blocks;
}

bool supported(const SceneMap& map, int u, int v) {
  const float z = map.at(u, v).point.z();
  const float step = map.surface_step(z);
  int support = 0;
  for (int dv = -1; dv <= 1; ++dv) {
    for (int du = -1; du <= 1; ++du) {
      if ((du == 0 && dv == 0) || !map.camera.contains(u + du, v + dv)) continue;
      const float other = map.at(u + du, v + dv).point.z();
      support += other > 0.0F && std::abs(other - z) < step * (du != 0 && dv != 0 ? 1.5F : 1.0F) ? 1 : 0;
    }
  }
  return support >= 3;
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

void bin_frame(const DepthFrame& frame, const Execution& execution, SceneMap& map) {
  constexpr auto lanes = static_cast<int>(lane_count);
  const int enough = std::max(1, map.stride * map.stride / 3);
  parallel_for(map.camera.height, execution, 8, [&](int v) {
    std::array<WholeBlock, lane_count> blocks;
    const int whole_blocks = (v + 1) * map.stride <= frame.camera.height ? frame.camera.width / map.stride : 0;
    const int in_lanes = whole_blocks / lanes * lanes;
    for (int u = 0; u < map.camera.width; ++u) {
      MapCell& cell = map.at(u, v);
      cell = MapCell{};
      if (u < in_lanes && u % lanes == 0) blocks = read_blocks(frame, map.stride, u, v);
      const WholeBlock block =
          u < in_lanes ? blocks[static_cast<std::size_t>(u % lanes)] : read_block(frame, map.stride, u, v);
      if (block.range.count < enough) continue;
      const float step = map.surface_step(block.range.low);
      if (block.range.high - block.range.low <= step) {
        cell.point = block.sum.mean(frame.camera, block.range.count);
        continue;
      }
      const DepthRange range = larger_surface(frame, map.stride, u, v, step);
      if (range.count >= enough) cell.point = mean_point(frame, map.stride, u, v, range);
    }
  });
  // Support is judged on the map as it was, so cells are marked first and emptied afterwards.
  parallel_for(map.camera.height, execution, 8, [&](int v) {
    for (int u = 0; u < map.camera.width; ++u) {
      MapCell& cell = map.at(u, v);
      cell.foreground = cell.measured() && supported(map, u, v) ? 1 : 0;
    }
  });
  parallel_for(map.camera.height, execution, 8, [&](int v) {
    for (int u = 0; u < map.camera.width; ++u) {
      MapCell& cell = map.at(u, v);
      if (cell.foreground == 0) cell.point.setZero();
    }
  });
}

}  // namespace graspd
