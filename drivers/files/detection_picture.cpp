#include "drivers/files/detection_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "drivers/files/depth_colouring.hpp"
#include "drivers/files/instance_overlay.hpp"

namespace graspd {

namespace {

constexpr Colour white{255, 255, 255};
constexpr Colour black{0, 0, 0};
constexpr Colour paper{24, 26, 33};
constexpr Colour rejected_colour{255, 60, 90};
constexpr std::array<Colour, 3> axis_colours{{{255, 70, 70}, {80, 230, 80}, {80, 140, 255}}};

/// A frame whose pixels are repeated `factor` times, and the camera that fits it.
struct EnlargedFrame {
  int factor = 1;
  std::vector<float> depth;
  DepthFrame frame;
};

EnlargedFrame enlarge(const DepthFrame& frame) {
  constexpr int comfortable_width = 800;
  EnlargedFrame large;
  const int width = std::max(frame.camera.width, 1);
  large.factor = std::max(1, (comfortable_width + width / 2) / width);
  const auto factor = static_cast<float>(large.factor);
  const float shift = 0.5F * (factor - 1.0F);
  const Camera& small = frame.camera;
  const Camera camera{small.width * large.factor, small.height * large.factor, small.fx * factor,
                      small.fy * factor,          small.cx * factor + shift,   small.cy * factor + shift};
  large.depth.resize(camera.pixel_count());
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      large.depth[camera.index(u, v)] = frame.at(u / large.factor, v / large.factor);
    }
  }
  large.frame = {camera, large.depth, frame.captured_ns, frame.sequence};
  return large;
}

/// Draws in a picture through a camera, with a dark casing so that lines stand out from any ground.
class Drafter {
 public:
  Drafter(Picture& picture, const Camera& camera) : picture_(picture), camera_(camera) {}

  void line(const Vector3& from, const Vector3& to, Colour colour, float thickness) const {
    stroke(from, to, colour, thickness, draw_line);
  }
  void arrow(const Vector3& from, const Vector3& to, Colour colour, float thickness) const {
    stroke(from, to, colour, thickness, draw_arrow);
  }
  void ring(const Vector3& centre, float radius_pixels, Colour colour, float thickness) const {
    if (!visible(centre)) return;
    const Eigen::Vector2f place = camera_.project(centre);
    draw_circle(picture_, place.x(), place.y(), radius_pixels, black, thickness + 3.0F);
    draw_circle(picture_, place.x(), place.y(), radius_pixels, colour, thickness);
  }
  /// A word on a dark plate, its middle `below` pixels below the place of `at`.
  void label(const Vector3& at, int below, const std::string& text, Colour colour, int scale) const {
    if (!visible(at)) return;
    const Eigen::Vector2f place = camera_.project(at);
    const int width = text_width(text, scale);
    const int left = static_cast<int>(std::clamp(place.x(), -1e6F, 1e6F)) - width / 2;
    const int top = static_cast<int>(std::clamp(place.y(), -1e6F, 1e6F)) - text_height(scale) / 2 + below;
    fill_rectangle(picture_, left - 2 * scale, top - 2 * scale, width + 4 * scale, text_height(scale) + 3 * scale,
                   black, 0.55F);
    draw_text(picture_, left, top, text, colour, scale);
  }

 private:
  using Stroke = void (*)(Picture&, float, float, float, float, Colour, float);

  static bool visible(const Vector3& p) { return p.allFinite() && p.z() > 0.01F; }

  void stroke(const Vector3& from, const Vector3& to, Colour colour, float thickness, Stroke draw) const {
    if (!visible(from) || !visible(to)) return;
    const Eigen::Vector2f a = camera_.project(from);
    const Eigen::Vector2f b = camera_.project(to);
    draw(picture_, a.x(), a.y(), b.x(), b.y(), black, thickness + 2.0F);
    draw(picture_, a.x(), a.y(), b.x(), b.y(), colour, thickness);
  }

  Picture& picture_;
  const Camera& camera_;
};

/// The middle and the half diagonal of a mesh's bounding box, in the camera's frame.
struct Extent {
  Vector3 centre = Vector3::Zero();
  float radius = 0;
};

Extent extent_of(const DrawnInstance& instance) {
  if (instance.mesh.vertices.empty()) return {instance.camera_from_part.translation, 0.0F};
  Vector3 low = instance.mesh.vertices[0];
  Vector3 high = low;
  for (const Vector3& vertex : instance.mesh.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  return {instance.camera_from_part * Vector3(0.5F * (low + high)), 0.5F * (high - low).norm()};
}

std::string score_text(float score) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%.2f", static_cast<double>(score));
  return text.data();
}

void draw_pose(const Drafter& drafter, const DrawnInstance& instance, const std::string& label, int scale) {
  const Extent extent = extent_of(instance);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 tip = extent.centre + 0.45F * extent.radius * instance.camera_from_part.rotation.col(axis);
    drafter.line(extent.centre, tip, axis_colours[static_cast<std::size_t>(axis)], 1.5F);
  }
  drafter.label(extent.centre, 10 * scale, label, white, scale);
}

/// The edges of the gripper's pieces.
void draw_pieces(const Drafter& drafter, const RigidTransform& camera_from_tool, std::span<const Box> pieces,
                 Colour colour, float thickness) {
  for (const Box& box : pieces) {
    std::array<Vector3, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = camera_from_tool * box.corner(i);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      for (const std::size_t edge : {std::size_t{1}, std::size_t{2}, std::size_t{4}}) {
        if ((i & edge) == 0) drafter.line(corners[i], corners[i | edge], colour, thickness);
      }
    }
  }
}

void draw_pick(const Drafter& drafter, const DrawnInstance& instance, const DrawnPick& pick, const Camera& camera,
               int scale) {
  const Extent extent = extent_of(instance);
  const Vector3& grip = pick.camera_from_tool.translation;
  const float pixels_per_metre = camera.fx / std::max(extent.centre.z(), 0.05F);
  drafter.ring(extent.centre, 1.1F * extent.radius * pixels_per_metre + 4.0F, pick_colour, 3.0F);

  const Matrix3& tool = pick.camera_from_tool.rotation;
  draw_pieces(drafter, pick.camera_from_tool, pick.pieces, pick_colour, 2.0F);
  if (pick.pieces.empty() && pick.opening > 0.0F) {
    const Vector3 half = 0.5F * pick.opening * tool.col(0);
    const Vector3 back = -0.5F * extent.radius * tool.col(2);
    for (const float side : {-1.0F, 1.0F}) {
      const Vector3 tip = grip + side * half;
      drafter.line(tip + back, tip, pick_colour, 4.0F);
    }
    drafter.line(grip - half + back, grip + half + back, pick_colour, 2.0F);
  }
  for (int axis = 0; axis < 3; ++axis) {
    drafter.arrow(grip, grip + 0.6F * extent.radius * tool.col(axis), axis_colours[static_cast<std::size_t>(axis)],
                  2.5F);
  }
  drafter.arrow(pick.camera_from_approach.translation, grip, white, 3.0F);
  drafter.label(extent.centre, -static_cast<int>(1.1F * extent.radius * pixels_per_metre) - 12 * scale, "PICK",
                pick_colour, scale + 1);
}

/// The band below the frame: the caption, and a line for each instance in as many columns as fit.
Picture draw_legend(int width, std::span<const DrawnInstance> instances, const std::optional<DrawnPick>& pick,
                    bool with_rejected, std::string_view caption, int scale) {
  constexpr std::size_t most_rows = 6;
  const int line = text_height(scale) + 4 * scale;
  const int column_width = text_width(std::string(30, ' '), scale);
  const auto columns = static_cast<std::size_t>(std::max(1, width / column_width));
  const std::size_t shown = std::min(instances.size(), columns * most_rows);
  const auto rows = static_cast<int>((shown + columns - 1) / columns);
  const int header_lines = pick ? 2 : 1;
  Picture legend(width, (rows + header_lines) * line + 3 * scale, paper);

  std::string title(caption);
  if (shown < instances.size()) title += "  (first " + std::to_string(shown) + " listed)";
  draw_text(legend, 4 * scale, 4 * scale, title, white, scale);
  if (pick) {
    draw_text(legend, 4 * scale, 4 * scale + line,
              "ring: the pick, number " + std::to_string(pick->instance + 1) +
                  "   white arrow: approach   yellow: gripper" + (with_rejected ? "   red: rejected grasps" : "") +
                  "   red/green/blue axes: x/y/z",
              pick_colour, scale);
  }
  for (std::size_t i = 0; i < shown; ++i) {
    const int left = 4 * scale + static_cast<int>(i % columns) * column_width;
    const int top = 4 * scale + (header_lines + static_cast<int>(i / columns)) * line;
    fill_rectangle(legend, left, top - scale, 7 * scale, 8 * scale, distinct_colour(i));
    const std::string text =
        std::to_string(i + 1) + " " + score_text(instances[i].score) + " " + instances[i].part.substr(0, 17);
    draw_text(legend, left + 10 * scale, top, text, white, scale);
  }
  return legend;
}

}  // namespace

Picture draw_detections(const DepthFrame& frame, std::span<const DrawnInstance> instances,
                        const std::optional<DrawnPick>& pick, std::string_view caption,
                        std::span<const DrawnGrasp> rejected) {
  const EnlargedFrame large = enlarge(frame);
  const Camera& camera = large.frame.camera;
  const int scale = camera.width >= 1100 ? 2 : 1;

  Picture ground = colour_depth(frame);
  Picture scene(camera.width, camera.height, paper);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) scene.at(u, v) = ground.at(u / large.factor, v / large.factor);
  }
  const std::uint32_t picked = pick ? static_cast<std::uint32_t>(pick->instance) : InstanceMap::nothing;
  draw_instances(scene, large.frame, map_instances(camera, instances), picked);
  const Drafter drafter(scene, camera);
  // In a crowd the plates would hide the parts: the legend has the scores then.
  constexpr std::size_t crowd = 8;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    const bool roomy = instances.size() < crowd;
    draw_pose(drafter, instances[i], roomy ? number + " " + score_text(instances[i].score) : number, scale);
  }
  for (const DrawnGrasp& grasp : rejected) {
    draw_pieces(drafter, grasp.camera_from_tool, grasp.pieces, rejected_colour, 1.0F);
  }
  if (pick && pick->instance < instances.size()) {
    draw_pick(drafter, instances[pick->instance], *pick, camera, scale);
  }

  const Picture legend = draw_legend(camera.width, instances, pick, !rejected.empty(), caption, scale);
  Picture whole(camera.width, camera.height + legend.height, paper);
  paste(whole, scene, 0, 0);
  paste(whole, legend, 0, camera.height);
  return whole;
}

}  // namespace graspd
