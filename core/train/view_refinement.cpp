#include "core/train/view_refinement.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "core/geometry/symmetric_matrix.hpp"

namespace graspd {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr float minimum_conditioning = 0.001F;
constexpr float fusion_overlap = 0.8F;  ///< Views that share this much of the larger one are fused.
constexpr float unshown = 0.4F;         ///< A degenerate view that shows this share of what no other does is kept.

std::size_t count_bits(std::span<const std::uint64_t> row) {
  return std::accumulate(row.begin(), row.end(), std::size_t{0}, [](std::size_t sum, std::uint64_t word) {
    return sum + static_cast<std::size_t>(std::popcount(word));
  });
}

std::size_t count_common(std::span<const std::uint64_t> a, std::span<const std::uint64_t> b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += static_cast<std::size_t>(std::popcount(a[i] & b[i]));
  return count;
}

float share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0F : static_cast<float>(part) / static_cast<float>(whole);
}

/// The candidate's points, how many, and what it must be judged by.
struct Judged {
  std::vector<std::size_t> visible;
  std::vector<float> completeness;
  std::size_t largest = 0;  ///< Of the rendered views.
};

Judged judge_candidates(const CandidateViews& candidates) {
  Judged judged;
  for (std::size_t i = 0; i < candidates.directions.size(); ++i) {
    judged.visible.push_back(count_bits(candidates.visibility.seen.row(i)));
    judged.completeness.push_back(
        std::min(1.0F, share(judged.visible[i], count_bits(candidates.visibility.facing.row(i)))));
    if (i < candidates.rendered) judged.largest = std::max(judged.largest, judged.visible[i]);
  }
  if (judged.largest == 0) judged.largest = *std::max_element(judged.visible.begin(), judged.visible.end());
  return judged;
}

/// Enters every candidate into the report, still without a fate.
void list_candidates(const CandidateViews& candidates, const Judged& judged, BankReport& report) {
  report.candidates.clear();
  for (std::size_t i = 0; i < candidates.directions.size(); ++i) {
    CandidateReport entry;
    entry.direction = candidates.directions[i];
    entry.completeness = judged.completeness[i];
    if (i >= candidates.rendered) {
      entry.source = candidates.cut_outs[candidates.twins[i - candidates.rendered].cut_out].source;
    }
    report.candidates.push_back(entry);
    if (candidates.eligible(i)) ++(i < candidates.rendered ? report.views_rendered : report.views_cut_out);
  }
}

struct SiftedCandidates {
  std::vector<std::size_t> usable;  ///< Complete, and firm enough to fix the pose,
  std::vector<std::size_t> degenerate;
};

SiftedCandidates sift_candidates(const CandidateViews& candidates, const Judged& judged, const SymmetryGroup& symmetry,
                                 float diameter, const BankBuildParameters& parameters, BankReport& report) {
  SiftedCandidates sifted;
  for (std::size_t i = 0; i < candidates.directions.size(); ++i) {
    if (!candidates.eligible(i)) continue;
    const std::span<const std::uint64_t> seen = candidates.visibility.seen.row(i);
    if (judged.completeness[i] < parameters.minimum_completeness ||
        share(judged.visible[i], judged.largest) < parameters.minimum_completeness) {
      ++report.views_incomplete;
      report.candidates[i].fate = CandidateFate::incomplete;
    } else if (pose_conditioning(candidates.samples, seen, symmetry, 0.5F * diameter) < minimum_conditioning) {
      ++report.views_degenerate;
      report.candidates[i].fate = CandidateFate::degenerate;
      sifted.degenerate.push_back(i);
    } else {
      sifted.usable.push_back(i);
    }
  }
  if (sifted.usable.empty()) {
    report.remarks.emplace_back("no view fixes the pose by itself: the fullest one is kept");
    std::size_t fullest = 0;
    for (std::size_t i = 0; i < judged.visible.size(); ++i) {
      if (candidates.eligible(i) && judged.visible[i] > judged.visible[fullest]) fullest = i;
    }
    sifted.usable.push_back(fullest);
  }
  return sifted;
}

/// The largest share of `candidate` that a kept view or a twin of it shows, and which view that is.
struct Overlap {
  float share = 0.0F;
  std::size_t view = 0;
};

Overlap largest_overlap(std::size_t candidate, std::span<const RefinedView> kept, const CandidateViews& candidates,
                        const Judged& judged) {
  const VisibilityRows& seen = candidates.visibility.seen;
  Overlap largest;
  for (std::size_t v = 0; v < kept.size(); ++v) {
    for (const std::size_t twin : candidates.orbits[kept[v].candidate]) {
      const float overlap = share(count_common(seen.row(candidate), seen.row(twin)), judged.visible[candidate]);
      if (overlap > largest.share) largest = {overlap, v};
    }
  }
  return largest;
}

/// Keeps those of the degenerate candidates that show sides which no kept view shows: without them a part that turns
/// such a side to the sensor would never be voted for. `order`: the fullest first.
void cover_rest(const CandidateViews& candidates, const Judged& judged, std::span<const std::size_t> order,
                std::size_t most, std::vector<RefinedView>& kept, BankReport& report) {
  const VisibilityRows& seen = candidates.visibility.seen;
  std::vector<std::uint64_t> covered(seen.words_per_row, 0);
  const auto cover = [&](std::size_t candidate) {
    for (const std::size_t twin : candidates.orbits[candidate]) {
      const std::span<const std::uint64_t> row = seen.row(twin);
      for (std::size_t word = 0; word < row.size(); ++word) covered[word] |= row[word];
    }
  };
  for (const RefinedView& view : kept) cover(view.candidate);
  for (const std::size_t i : order) {
    if (kept.size() >= most) return;
    if (share(count_common(seen.row(i), covered), judged.visible[i]) > 1.0F - unshown) continue;
    kept.push_back({i, {}, judged.completeness[i]});
    cover(i);
    --report.views_degenerate;
  }
}

/// What the views fuse with: everything that shows nearly the same.
void find_fused(const CandidateViews& candidates, const Judged& judged, std::vector<RefinedView>& kept) {
  const VisibilityRows& seen = candidates.visibility.seen;
  for (RefinedView& view : kept) {
    for (std::size_t j = 0; j < candidates.directions.size(); ++j) {
      const std::size_t larger = std::max(judged.visible[j], judged.visible[view.candidate]);
      const bool fuses = share(count_common(seen.row(view.candidate), seen.row(j)), larger) >= fusion_overlap;
      if (fuses || j == view.candidate) view.fused.push_back(j);
    }
  }
}

/// Tells merged candidates whose points a view holds from those that were only left out.
void report_fused(const CandidateViews& candidates, std::span<const RefinedView> kept, BankReport& report) {
  for (std::size_t v = 0; v < kept.size(); ++v) {
    for (const std::size_t i : kept[v].fused) {
      if (!candidates.eligible(i) || report.candidates[i].fate != CandidateFate::merged) continue;
      report.candidates[i].fate = CandidateFate::fused;
      report.candidates[i].view = v;
      ++report.views_fused;
    }
  }
}

/// The first `count` of the candidates, each as far as can be from those before.
std::vector<RefinedView> evenly_spread(const CandidateViews& candidates, const Judged& judged, std::size_t count) {
  std::vector<RefinedView> kept;
  while (kept.size() < count) {
    std::size_t best = candidates.directions.size();
    float least = 2.0F;
    for (std::size_t i = 0; i < candidates.directions.size(); ++i) {
      if (!candidates.eligible(i) || judged.visible[i] == 0) continue;
      float nearest = -1.0F;
      for (const RefinedView& view : kept) {
        nearest = std::max(nearest, candidates.directions[i].dot(candidates.directions[view.candidate]));
      }
      if (nearest < least && nearest < 0.9999F) {
        least = nearest;
        best = i;
      }
    }
    if (best == candidates.directions.size()) break;
    kept.push_back({best, {}, judged.completeness[best]});
  }
  return kept;
}

}  // namespace

float pose_conditioning(std::span<const OrientedPoint> samples, std::span<const std::uint64_t> seen,
                        const SymmetryGroup& symmetry, float length) {
  Vector3 middle = Vector3::Zero();
  std::size_t count = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if ((seen[i / 64] >> (i % 64) & 1U) == 0) continue;
    middle += samples[i].position;
    ++count;
  }
  if (count < 6) return 0.0F;
  middle /= static_cast<float>(count);
  Matrix6 hessian = Matrix6::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if ((seen[i / 64] >> (i % 64) & 1U) == 0) continue;
    Vector6 gradient;
    gradient << ((samples[i].position - middle) / length).cross(samples[i].normal).cast<double>(),
        samples[i].normal.cast<double>();
    hessian += gradient * gradient.transpose();
  }
  if (symmetry.continuous) {
    // No view has to fix the turn about the axis: lift that direction out of the small eigenvalues.
    Vector6 twist;
    twist << symmetry.axis.direction.cast<double>(),
        (symmetry.axis.direction.cross(middle - symmetry.axis.point) / length).cast<double>();
    twist.normalize();
    const Matrix6 others = Matrix6::Identity() - twist * twist.transpose();
    hessian = others * hessian * others + hessian.trace() * twist * twist.transpose();
  }
  const Eigen::VectorXd values = decomposed(hessian).values;
  return static_cast<float>(values(0) / values(symmetry.continuous ? 4 : 5));
}

std::vector<RefinedView> refine_views(const CandidateViews& candidates, const SymmetryGroup& symmetry,
                                      std::span<const float> weights, float diameter,
                                      const BankBuildParameters& parameters, BankReport& report) {
  const Judged judged = judge_candidates(candidates);
  list_candidates(candidates, judged, report);
  const auto most = static_cast<std::size_t>(parameters.maximum_views);
  std::vector<RefinedView> kept;
  if (parameters.refinement) {
    SiftedCandidates sifted = sift_candidates(candidates, judged, symmetry, diameter, parameters, report);
    const auto worth = [&](std::size_t i) {
      return static_cast<float>(judged.visible[i]) * (weights.empty() ? 1.0F : weights[i]);
    };
    const auto fuller = [&](std::size_t a, std::size_t b) {
      const bool a_measured = a >= candidates.rendered;
      const bool b_measured = b >= candidates.rendered;
      return a_measured != b_measured ? a_measured : worth(a) > worth(b);
    };
    std::stable_sort(sifted.usable.begin(), sifted.usable.end(), fuller);
    std::stable_sort(sifted.degenerate.begin(), sifted.degenerate.end(), fuller);
    for (const std::size_t i : sifted.usable) {
      const Overlap overlap = largest_overlap(i, kept, candidates, judged);
      if (overlap.share > parameters.maximum_overlap) {
        ++report.views_merged;
        report.candidates[i].fate = CandidateFate::merged;
        report.candidates[i].view = overlap.view;
      } else if (kept.size() < most) {
        kept.push_back({i, {}, judged.completeness[i]});
      }
    }
    cover_rest(candidates, judged, sifted.degenerate, most, kept, report);
  } else {
    kept = evenly_spread(candidates, judged, most);
  }
  for (std::size_t v = 0; v < kept.size(); ++v) {
    report.candidates[kept[v].candidate].fate = CandidateFate::kept;
    report.candidates[kept[v].candidate].view = v;
  }
  if (parameters.generalisation == Generalisation::fuse) {
    find_fused(candidates, judged, kept);
    report_fused(candidates, kept, report);
  } else {
    for (RefinedView& view : kept) view.fused = {view.candidate};
  }
  report.views_kept = static_cast<int>(kept.size());
  return kept;
}

}  // namespace graspd
