#pragma once

#include <cstddef>
#include <cstdint>

#include "core/grasp/candidates.hpp"
#include "core/grasp/parameters.hpp"
#include "core/grasp/pick.hpp"
#include "core/grasp/surroundings.hpp"

namespace graspd {

/// How far the search for the best grasp of one instance has come.
enum class SearchPhase : std::uint8_t {
  unasked,  ///< Nothing was looked up.
  begun,    ///< It has grasps left that could be its best.
  settled,  ///< The best is known, or that there is none.
  listed,   ///< Its best is among the picks.
};

/// The search for the best grasp of one instance.
struct GraspSearch {
  SearchPhase phase = SearchPhase::unasked;
  GraspRejection reason = GraspRejection::none;  ///< Of the grasp that came furthest so far; `none` when `found`.
  bool found = false;
  std::int32_t rank = 0;      ///< order_rank.
  float bound = 0;            ///< No grasp of it is worth more; when settled, what the best is worth.
  std::uint32_t share = 0;    ///< Grasps of it that may be looked up in the frame.
  std::uint32_t checked = 0;  ///< Those that were, from the first candidate on.
  GraspTarget target;
  Pick best;  ///< Of those that were looked up; meaningful only when `found`.
};

/// A choice under way: what it goes by, and how far it has come.
struct GraspChoice {
  static constexpr std::size_t nobody = ~std::size_t{0};

  GraspSurroundings around;
  GraspParameters parameters;
  BinFit bin;
  std::size_t in_hand = nobody;   ///< The instance whose candidates are in the workspace.
  std::uint32_t checks_left = 0;  ///< Less those that are set aside for searches that have begun.
  std::uint32_t checks = 0;       ///< Grasps that were looked up in the frame.
  std::uint32_t unasked = 0;      ///< Instances.
  std::uint32_t flags = 0;        ///< PickFlag bits.
};

}  // namespace graspd
