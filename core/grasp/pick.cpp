#include "core/grasp/pick.hpp"

namespace graspd {

const char* grasp_rejection_name(GraspRejection rejection) {
  switch (rejection) {
    case GraspRejection::none:
      return "none";
    case GraspRejection::no_grasp:
      return "no grasp";
    case GraspRejection::tilt:
      return "tilt";
    case GraspRejection::reach:
      return "reach";
    case GraspRejection::collision:
      return "collision";
    case GraspRejection::opening:
      return "opening";
    case GraspRejection::tool:
      return "tool";
    case GraspRejection::avoided:
      return "avoided";
    case GraspRejection::wall:
      return "wall";
    case GraspRejection::unseen:
      return "unseen";
    case GraspRejection::neighbour:
      return "neighbour";
    case GraspRejection::closing:
      return "closing";
    case GraspRejection::retreat:
      return "retreat";
    case GraspRejection::no_bin:
      return "no bin";
  }
  return "unknown";
}

}  // namespace graspd
