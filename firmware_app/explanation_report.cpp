#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <set>

#include "core/evaluate/summary.hpp"
#include "firmware_app/append_text.hpp"
#include "firmware_app/explanation.hpp"

namespace graspd {
namespace {

using PartNames = std::span<const std::pair<std::uint32_t, std::string>>;
using Chooses = std::function<bool(const TargetFate&)>;

constexpr std::array<const char*, visibility_class_count> visibility_names{"< 0.3", "0.3-0.5", "> 0.5"};

/// The order in which a hypothesis meets its tests.
constexpr std::array<Rejection, rejection_count - 1> test_order{
    Rejection::weak,  Rejection::overlap,   Rejection::boundary,     Rejection::edge,     Rejection::below_plane,
    Rejection::score, Rejection::duplicate, Rejection::intersecting, Rejection::ambiguous};

double wide(float value) { return static_cast<double>(value); }

std::string part_label(std::uint32_t part, PartNames names) {
  const auto name = std::find_if(names.begin(), names.end(), [&](const auto& entry) { return entry.first == part; });
  return "part " + std::to_string(part) + (name == names.end() ? "" : " " + name->second);
}

/// The rows that tables over targets have: all, and by part, level and both.
std::vector<std::pair<std::string, Chooses>> rows_of(const Explanation& explanation, PartNames names) {
  std::vector<std::string> levels;
  std::set<std::uint32_t> parts;
  for (const TargetFate& target : explanation.targets) {
    parts.insert(target.part);
    if (!target.level.empty() && std::find(levels.begin(), levels.end(), target.level) == levels.end())
      levels.push_back(target.level);
  }
  std::vector<std::pair<std::string, Chooses>> rows{{"all", [](const TargetFate&) { return true; }}};
  for (const std::string& level : levels) {
    rows.emplace_back("level " + level, [level](const TargetFate& t) { return t.level == level; });
  }
  for (const std::uint32_t part : parts) {
    rows.emplace_back(part_label(part, names), [part](const TargetFate& t) { return t.part == part; });
    for (const std::string& level : levels) {
      rows.emplace_back("  " + level,
                        [part, level](const TargetFate& t) { return t.part == part && t.level == level; });
    }
  }
  return rows;
}

void append_recalls(std::string& text, const Explanation& explanation, PartNames names) {
  text += "\nRecall (MSSD below 0.1 of the diameter) by part, level and visible share\n\n";
  append(text, "%-24s", "");
  for (const char* name : visibility_names) append(text, " %15s", name);
  append(text, " %15s\n", "all");
  for (const auto& [label, chooses] : rows_of(explanation, names)) {
    std::array<Share, visibility_class_count + 1> shares;
    for (const TargetFate& target : explanation.targets) {
      if (!chooses(target)) continue;
      const auto count_in = [&](std::size_t column) {
        ++shares[column].total;
        shares[column].hits += target.fate == Fate::found ? 1U : 0U;
      };
      count_in(visibility_class_count);
      if (is_known_visibility(target.visibility)) count_in(visibility_class(target.visibility));
    }
    if (shares.back().total == 0) continue;
    append(text, "%-24.40s", label.c_str());
    for (const Share& share : shares) {
      if (share.total == 0) {
        append(text, " %15s", "-");
      } else {
        append(text, "  %5.2f %4zu/%-3zu", share.value(), share.hits, share.total);
      }
    }
    text += '\n';
  }
}

/// Counts of one row: targets by fate, the rejected ones by reason.
struct Losses {
  std::size_t targets = 0;
  std::array<std::size_t, fate_count> by_fate{};
  std::array<std::size_t, rejection_count> by_rejection{};
};

Losses losses_of(const Explanation& explanation, const Chooses& chooses) {
  Losses losses;
  for (const TargetFate& target : explanation.targets) {
    if (!chooses(target)) continue;
    ++losses.targets;
    ++losses.by_fate[static_cast<std::size_t>(target.fate)];
  }
  for (const MissedTarget& missed : explanation.missed) {
    if (missed.fate.fate == Fate::rejected && chooses(missed.fate))
      ++losses.by_rejection[static_cast<std::size_t>(missed.judged.rejection)];
  }
  return losses;
}

void append_losses(std::string& text, const Explanation& explanation, PartNames names) {
  text += "\nWhere the right pose of each target was lost\n";
  append(
      text,
      "Until it is refined to the end a pose is right below an MSSD of %.1f of the diameter, then of %.1f. A target\n"
      "was lost behind the last stage that held such a pose; the columns follow the chain.\n\n",
      wide(near_pose_error), right_pose_error);
  const auto rows = rows_of(explanation, names);
  const Losses all = losses_of(explanation, rows.front().second);
  append(text, "%-24s %7s %5s %6s %8s %5s %7s %9s %5s %6s", "", "targets", "found", "votes", "clusters", "kept",
         "coarse", "outranked", "fine", "taken");
  for (const Rejection reason : test_order) {
    if (all.by_rejection[static_cast<std::size_t>(reason)] > 0) append(text, " %s", rejection_name(reason));
  }
  text += '\n';
  const auto append_row = [&](const std::string& label, const Chooses& chooses) {
    const Losses losses = losses_of(explanation, chooses);
    if (losses.targets == 0) return;
    const auto count = [&](Fate fate) { return losses.by_fate[static_cast<std::size_t>(fate)]; };
    append(text, "%-24.40s %7zu %5zu %6zu %8zu %5zu %7zu %9zu %5zu %6zu", label.c_str(), losses.targets,
           count(Fate::found), count(Fate::never_voted), count(Fate::lost_clustering), count(Fate::implausible),
           count(Fate::lost_coarse), count(Fate::outranked), count(Fate::lost_fine), count(Fate::taken));
    for (const Rejection reason : test_order) {
      if (all.by_rejection[static_cast<std::size_t>(reason)] == 0) continue;
      append(text, " %*zu", static_cast<int>(std::string_view(rejection_name(reason)).size()),
             losses.by_rejection[static_cast<std::size_t>(reason)]);
    }
    text += '\n';
  };
  append_row(rows.front().first, rows.front().second);
  for (std::size_t c = 0; c < visibility_class_count; ++c) {
    append_row(std::string("visible ") + visibility_names[c],
               [c](const TargetFate& t) { return visibility_class(t.visibility) == c; });
  }
  for (std::size_t i = 1; i < rows.size(); ++i) append_row(rows[i].first, rows[i].second);
}

void append_verdicts(std::string& text, const Explanation& explanation, PartNames names) {
  const Losses lost = losses_of(explanation, [](const TargetFate&) { return true; });
  std::array<Verdicts, rejection_count> all{};
  for (const auto& [part, verdicts] : explanation.verdicts) {
    for (std::size_t r = 0; r < rejection_count; ++r) {
      all[r].right += verdicts[r].right;
      all[r].wrong += verdicts[r].wrong;
    }
  }
  std::size_t wrong_left = 0;
  for (const Verdicts& count : all) wrong_left += count.wrong;
  text += "\nWhat each test did to right and wrong hypotheses, in the order of the tests\n\n";
  append(text, "%-14s %14s %20s %14s %18s\n", "", "right rejected", "targets lost by it", "wrong rejected",
         "wrong let through");
  for (const Rejection reason : test_order) {
    const Verdicts& count = all[static_cast<std::size_t>(reason)];
    wrong_left -= count.wrong;
    append(text, "%-14s %14zu %20zu %14zu %18zu\n", rejection_name(reason), count.right,
           lost.by_rejection[static_cast<std::size_t>(reason)], count.wrong, wrong_left);
  }
  append(text, "%-14s %14zu %20s %14zu\n", "reported", all[0].right, "", all[0].wrong);

  text += "\nBy part, right:wrong hypotheses rejected by each test\n\n";
  append(text, "%-24s", "");
  for (const Rejection reason : test_order) append(text, " %12s", rejection_name(reason));
  append(text, " %12s\n", "reported");
  for (const auto& [part, verdicts] : explanation.verdicts) {
    append(text, "%-24.40s", part_label(part, names).c_str());
    for (const Rejection reason : test_order) {
      const Verdicts& count = verdicts[static_cast<std::size_t>(reason)];
      append(text, " %6zu:%-5zu", count.right, count.wrong);
    }
    append(text, " %6zu:%-5zu\n", verdicts[0].right, verdicts[0].wrong);
  }
}

std::string distance_text(float error) {
  if (!std::isfinite(error)) return "nowhere near";
  char text[32];
  std::snprintf(text, sizeof text, "%.3f d off", wide(error));
  return text;
}

/// The figure on which the right pose was rejected, against its threshold.
void append_reason(std::string& text, const MissedTarget& missed) {
  const Instance& judged = missed.judged;
  append(text, "rejected by %s", rejection_name(judged.rejection));
  const auto test = std::find_if(missed.tests.begin(), missed.tests.end(), [&](const TestOutcome& outcome) {
    return outcome.test == judged.rejection && outcome.failed();
  });
  if (test != missed.tests.end()) {
    append(text, " %.3f, must be %s %.3f", wide(test->figure), test->at_least ? "at least" : "at most",
           wide(test->threshold));
  } else if (judged.rejection == Rejection::score) {
    append(text, " %.3f, must be at least %.3f", wide(judged.score), wide(missed.minimum_score));
  }
  append(text, " (%s, score %.3f)", distance_text(missed.fate.error).c_str(), wide(judged.score));
}

void append_missed(std::string& text, const Explanation& explanation) {
  text += "\nTargets missed (d: diameter)\n";
  for (const MissedTarget& missed : explanation.missed) {
    const TargetFate& fate = missed.fate;
    append(text, "scene %u image %u part %u true pose %zu%s%s", fate.scene, fate.image, fate.part, fate.truth,
           fate.level.empty() ? "" : " ", fate.level.c_str());
    if (is_known_visibility(fate.visibility)) append(text, " visible %.2f", wide(fate.visibility));
    text += ": ";
    if (fate.fate == Fate::rejected) {
      append_reason(text, missed);
    } else {
      text += fate_name(fate.fate);
      if (fate.rank > 0) append(text, " (was number %zu, %.3f d off)", fate.rank, wide(fate.error));
    }
    append(text, "; reported there: %s\n",
           std::isfinite(fate.reported) ? distance_text(fate.reported).c_str() : "nothing");
  }
}

void append_false(std::string& text, const Explanation& explanation) {
  text += "\nWrong instances reported, with the figures that let them through (threshold)\n";
  for (const FalseInstance& wrong : explanation.false_instances) {
    append(text, "scene %u image %u part %u score %.3f, %s:", wrong.scene, wrong.image, wrong.part,
           wide(wrong.instance.score), distance_text(wrong.error).c_str());
    for (const TestOutcome& test : wrong.tests) {
      append(text, " %s %.3f (%s%.3f)", rejection_name(test.test), wide(test.figure),
             test.at_least ? ">=" : "<=", wide(test.threshold));
    }
    append(text, " visible %.2f residual %.2f confirmed %.0f\n", wide(wrong.instance.evidence.visible),
           wide(wrong.instance.evidence.residual), wide(wrong.instance.evidence.confirmed));
  }
}

}  // namespace

std::string explanation_as_text(const Explanation& explanation, PartNames part_names) {
  std::string text;
  append_recalls(text, explanation, part_names);
  append_losses(text, explanation, part_names);
  append_verdicts(text, explanation, part_names);
  append_missed(text, explanation);
  append_false(text, explanation);
  if (explanation.dropped > 0)
    append(text, "\n%zu poses had no room in the trace: stages may look emptier than they were.\n",
           explanation.dropped);
  return text;
}

}  // namespace graspd
