#pragma once

#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/background.hpp"
#include "core/detect/detections.hpp"
#include "core/detect/parameters.hpp"
#include "core/detect/scene_map.hpp"
#include "core/geometry/depth_render.hpp"

namespace graspd {

/// The posed model as the map's camera would see it.
struct RenderedModel {
  ImageRectangle rectangle;  ///< In cells of the map.
  Camera camera;             ///< Of the rectangle.
  float inside = 1;          ///< Share of the part's surface that projects into the image.
  std::span<float> front;    ///< Depth of the surface towards the sensor (metres), 0: no model.
  std::span<float> back;     ///< Depth of the last surface; empty when it was not asked for.
};

/// How far (metres) a model surface and the measured one may lie apart: `parameters.tolerance` for sensors that keep
/// depth steps sharp, up to `parameters.blurred_tolerance` for those that smear them, which bend surfaces too,
/// and at least `parameters.noise_tolerance` deviations where depths are noisier than that.
[[nodiscard]] float surface_tolerance(const SceneMap& map, const Bank& bank, const VerifyParameters& parameters);

/// Renders the posed model into `storage`, the front and, when it holds both, the back. An empty
/// rectangle when the model falls outside the image or the storage is too small for it.
[[nodiscard]] RenderedModel render_model(const SceneMap& map, const Bank& bank, const RigidTransform& camera_from_part,
                                         std::span<float> front, std::span<float> back);

/// Holds the rendered model against the measured scene (paper 2.4.2). Cells that the sensor did not
/// see are neutral; cells where the scene lies behind the model count against it. `claimed` marks
/// cells that better instances explain, by a number other than 0; may be empty.
[[nodiscard]] Evidence gather_evidence(const SceneMap& map, const Bank& bank, const RenderedModel& model,
                                       const VerifyParameters& parameters, std::span<const std::uint16_t> claimed);

}  // namespace graspd
