#include "core/detect/detections.hpp"

namespace graspd {

const char* rejection_name(Rejection rejection) {
  switch (rejection) {
    case Rejection::none:
      return "none";
    case Rejection::weak:
      return "weak";
    case Rejection::overlap:
      return "overlap";
    case Rejection::boundary:
      return "boundary";
    case Rejection::edge:
      return "edge";
    case Rejection::below_plane:
      return "below plane";
    case Rejection::ambiguous:
      return "ambiguous";
    case Rejection::intersecting:
      return "intersecting";
    case Rejection::duplicate:
      return "duplicate";
    case Rejection::score:
      return "score";
  }
  return "unknown";
}

const char* stage_name(Stage stage) {
  switch (stage) {
    case Stage::preprocess:
      return "preprocess";
    case Stage::match:
      return "match";
    case Stage::cluster:
      return "cluster";
    case Stage::refine:
      return "refine";
    case Stage::verify:
      return "verify";
  }
  return "unknown";
}

}  // namespace graspd
