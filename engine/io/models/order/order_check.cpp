// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/order_check.h"

#include "engine/core/text_table.h"
#include "engine/io/models/order/line_matches.h"
#include "engine/io/models/order/sign_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace episcope::io {
namespace {

/// Mean of the evidence of several maps (the two layers of a transparent scene).
WarpErrors mean_errors(const LightField::Samples& samples,
                       const std::vector<OrderEvidence>& truth) {
  WarpErrors sum;
  const auto add = [](AxisErrors& to, const AxisErrors& more) {
    const auto total = static_cast<double>(to.pixels + more.pixels);
    if (total == 0) return;
    const double a = static_cast<double>(to.pixels) / total;
    const double b = static_cast<double>(more.pixels) / total;
    to = {a * to.forward + b * more.forward, a * to.reversed + b * more.reversed,
          a * to.unwarped + b * more.unwarped, to.pixels + more.pixels};
  };
  for (const OrderEvidence& one : truth) {
    const WarpErrors errors =
        one.errors ? *one.errors : warp_errors(samples, one.at, one.disparity);
    add(sum.u, errors.u);
    add(sum.v, errors.v);
  }
  return sum;
}

std::string axis_text(const char* name, const AxisErrors& errors, bool is_flipped) {
  if (errors.pixels == 0) return std::string(name) + " not compared";
  const double taken = is_flipped ? errors.reversed : errors.forward;
  const double other = is_flipped ? errors.forward : errors.reversed;
  return std::string(name) + " " + fixed_text(taken, 2) + " (other way " + fixed_text(other, 2) +
         ")";
}

constexpr const char* kEitherWay =
    "the truth fits this order of views, and negated the opposite one; nothing tells which is "
    "right";

struct Checked {
  ViewFlip flip;
  bool is_decided = false;
  std::string text;
  std::string warning = {};
  bool is_sign_known = false;
  std::string sign_text = {};
  bool is_poor = false;  ///< Of a truth: it hardly explains the views in any order.

  /// Whether another order contradicts what was found.
  [[nodiscard]] bool contradicts(ViewFlip other) const {
    if (is_sign_known) return !(flip == other);
    return is_decided && (flip.u != flip.v) != (other.u != other.v);
  }
};

/// Of a truth that explains the views better than one disparity for all nothing is said.
std::string poor_truth(const WarpErrors& errors, const ConstantComparison& comparison) {
  if (comparison.is_better()) return {};
  if (!errors.u.is_poor() && !errors.v.is_poor()) {
    if (!comparison.is_told()) return {};
    return fmt::format(
        "The values of the truth could not be checked: one disparity for all explains the views "
        "as well, or better (where both differ, in {} squares of the view, the truth is better by "
        "{:.1f} standard deviations of chance).",
        comparison.squares, comparison.score);
  }
  const AxisErrors& worse = errors.u.is_poor() ? errors.u : errors.v;
  return "The truth hardly explains the views: warped by it, they differ by " +
         fixed_text(std::min(worse.forward, worse.reversed), 2) + " grey levels along " +
         (errors.u.is_poor() ? "u" : "v") + ", the other way by " +
         fixed_text(std::max(worse.forward, worse.reversed), 2) + " and unwarped by " +
         fixed_text(worse.unwarped, 2) +
         "; check the truth, and dH, focalLength and shift if it was stored as depth.";
}

Checked check_by_truth(const LightField::Samples& samples, const std::vector<OrderEvidence>& truth,
                       const ExpectedOrder& expected) {
  const WarpErrors errors = mean_errors(samples, truth);
  Checked checked{expected.flip, errors.u.is_decided() || errors.v.is_decided(), {}};
  if (errors.u.is_decided()) checked.flip.u = errors.u.says_reversed();
  if (errors.v.is_decided()) checked.flip.v = errors.v.says_reversed();
  // The layers of a transparent scene explain views only together.
  if (truth.size() == 1) {
    const OrderEvidence& one = truth.front();
    checked.warning =
        poor_truth(errors, compare_with_constant(samples, one.at, one.disparity, errors));
    checked.is_poor = !checked.warning.empty() && (errors.u.is_poor() || errors.v.is_poor());
  }
  if (checked.is_decided) {
    const std::string errors_text =
        axis_text("u", errors.u, checked.flip.u) + ", " + axis_text("v", errors.v, checked.flip.v);
    const bool is_sure = checked.warning.empty();
    checked.text = is_sure ? "checked against truth" : "by the truth, which is in doubt";
    checked.text += ", mean grey error after warping: " + errors_text;
    checked.is_sign_known = is_sure && !expected.is_truth_sign_assumed;
    checked.sign_text = is_sure ? kEitherWay : "the truth is in doubt";
    if (checked.is_sign_known) checked.sign_text = "by truth: " + errors_text;
  }
  return checked;
}

Checked check_by_slopes(const CoarseMotion& coarse, ViewFlip expected, const Progress& progress) {
  const SlopeCorrelation slopes = correlate_epi_slopes(coarse, progress);
  Checked checked{expected, slopes.is_decided(), {}};
  if (!checked.is_decided) return checked;
  const bool must_differ = slopes.value < 0;
  if ((expected.u != expected.v) != must_differ) checked.flip.u = !checked.flip.u;
  checked.text = fmt::format(
      "checked by the slopes of horizontal and vertical EPIs: correlation {} as stored at {} "
      "points, {}",
      fixed_text(slopes.value, 2), slopes.points,
      must_differ ? "so exactly one axis is reversed" : "so both axes agree");
  return checked;
}

/// Near and far: what the slopes leave open, or, where they are undecided, all that is known.
void add_occlusion(const CoarseMotion& coarse, Checked& checked, const Progress& progress) {
  const SignFinding sign = check_sign(coarse, checked.flip, checked.is_decided, progress);
  checked.is_sign_known = sign.is_decided;
  checked.sign_text = sign.is_decided ? "by " + sign.evidence : sign.evidence;
  if (!sign.is_decided) return;
  checked.text = checked.is_decided ? checked.text + "; direction checked by " + sign.evidence
                                    : "checked by " + sign.evidence;
  checked.flip = sign.flip;
  checked.is_decided = true;
}

std::string not_checked_text(GridShape grid) {
  if (grid.count() == 1) return "not checked (a single view)";
  if (grid.v == 1) return "not checked (one row of views)";
  if (grid.u == 1) return "not checked (one column of views)";
  return "not checked (too little depth or texture)";
}

ViewFlip chosen_flip(Flip choice) {
  return {choice == Flip::U || choice == Flip::Both, choice == Flip::V || choice == Flip::Both};
}

/// The order chosen by a user, and what the check has to say to it.
void follow(ViewFlip chosen, const Checked& checked, OrderFinding& finding) {
  finding.flip = chosen;
  finding.order = flip_text(chosen);
  finding.was_chosen = true;
  if (!(chosen == checked.flip)) {
    finding.sign = "";
    finding.sign_check = "the order was chosen by hand";
    if (checked.is_sign_known) finding.sign_check += ", against the check " + checked.sign_text;
  }
  if (!checked.contradicts(chosen)) return;
  finding.check = "the check favors \"" + flip_text(checked.flip) + "\": " + checked.text;
  finding.warnings.push_back("The order of views was chosen by hand (" + flip_text(chosen) +
                             "), but the check favors \"" + flip_text(checked.flip) + "\".");
}

}  // namespace

Flip flip_choice(ViewFlip flip) {
  if (flip.u && flip.v) return Flip::Both;
  if (flip.u) return Flip::U;
  return flip.v ? Flip::V : Flip::None;
}

OrderFinding find_order(const LightField::Samples& samples, const std::vector<OrderEvidence>& truth,
                        const ExpectedOrder& expected, Flip choice, const Progress& progress) {
  progress.check();
  Checked checked = check_by_truth(samples, truth, expected);
  OrderFinding finding;
  if (!checked.warning.empty()) finding.warnings.push_back(checked.warning);
  if (!checked.is_decided || !checked.warning.empty()) {
    const CoarseMotion coarse(samples);
    Checked by_views = check_by_slopes(coarse, expected.flip, progress);
    add_occlusion(coarse, by_views, progress);
    const bool says_more = by_views.is_sign_known || by_views.contradicts(checked.flip);
    // Truth that hardly explains the views says nothing of their order.
    if (!checked.is_decided || (by_views.is_decided && (checked.is_poor || says_more))) {
      checked = std::move(by_views);
    }
  }

  finding.flip = checked.flip;
  finding.check = checked.is_decided ? checked.text
                                     : not_checked_text(grid_of(samples)) + "; " + expected.reason;
  finding.sign = checked.is_sign_known ? "checked" : "";
  finding.sign_check = checked.sign_text;
  if (choice != Flip::Auto) {
    follow(chosen_flip(choice), checked, finding);
    return finding;
  }
  finding.order = flip_text(finding.flip);
  if (!(finding.flip == expected.flip)) {
    finding.warnings.push_back("The order of views is \"" + finding.order + "\" and not \"" +
                               flip_text(expected.flip) + "\", which was expected because " +
                               expected.reason + ".");
  }
  return finding;
}

namespace {

/// Share of the error as stored, and of that without warping, below which a turned map is right:
/// the right map is near the least error that there is, so none can be so much better than it.
constexpr double kFarBetterTurn = 0.6;
/// Share of the error without warping below which a map is right beyond doubt.
constexpr double kEvident = 0.2;

constexpr MapTurn kTurns[] = {{false, true, false, "rows from bottom to top"},
                              {false, false, true, "columns from right to left"},
                              {false, true, true, "both rows and columns in reverse order"},
                              {true, false, false, "rows and columns exchanged"}};

/// A single view of the stack, or all.
template <class T>
ViewStack<T> turned(const ViewStack<T>& stack, const MapTurn& turn, GridShape grid,
                    ViewIndex first) {
  if (stack.empty()) return {};
  ViewStack<T> out(grid, stack.height(), stack.width(), 1, first);
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = out.view_at(i);
    const auto from = stack.view(view);
    const auto to = out.view(view);
    for (int y = 0; y < to.height; ++y) {
      for (int x = 0; x < to.width; ++x) {
        const int source_y = turn.flips_y ? to.height - 1 - y : y;
        const int source_x = turn.flips_x ? to.width - 1 - x : x;
        to.at(y, x) = turn.is_transposed ? from.at(x, y) : from.at(source_y, source_x);
      }
    }
  }
  return out;
}

}  // namespace

std::vector<MapTurn> possible_turns(int height, int width) {
  std::vector<MapTurn> turns;
  for (const MapTurn& turn : kTurns) {
    if (!turn.is_transposed || height == width) turns.push_back(turn);
  }
  return turns;
}

DisparityField turned_back(const DisparityField& field, const MapTurn& turn) {
  const GridShape grid = field.disparity.grid();
  const ViewIndex first = field.disparity.first();
  return {turned(field.disparity, turn, grid, first), turned(field.valid, turn, grid, first)};
}

DisparityField turned_back(const DisparityView& map, const MapTurn& turn) {
  const int height = map.disparity.height;
  const int width = map.disparity.width;
  DisparityField field{ViewStack<float>({1, 1}, height, width),
                       ViewStack<std::uint8_t>({1, 1}, height, width)};
  for (int y = 0; y < height; ++y) {
    std::copy_n(map.disparity.row(y), width, field.disparity.view({}).row(y));
    for (int x = 0; x < width; ++x) field.valid.view({}).at(y, x) = map.is_valid(y, x) ? 1 : 0;
  }
  return turned_back(field, turn);
}

std::string turned_back_text(const std::string& turn) {
  return "The truth was stored with " + turn +
         ", as comparing it with the views shows; it was put right.";
}

UprightTruth put_truth_upright(const LightField::Samples& samples, DisparityField& field) {
  if (field.empty()) return {};
  const ViewIndex center = grid_of(samples).center();
  const ViewIndex at = field.contains(center) ? center : field.disparity.first();
  UprightTruth found{{}, warp_errors(samples, at, field.view(at))};
  const WarpErrors stored = *found.errors;
  const double without = stored.unwarped();
  if (stored.best() < kEvident * without) return found;
  double least = kFarBetterTurn * std::min(stored.best(), without);
  std::optional<MapTurn> undone;
  for (const MapTurn& turn : possible_turns(field.disparity.height(), field.disparity.width())) {
    const DisparityField candidate{turned(field.disparity, turn, {1, 1}, at),
                                   turned(field.valid, turn, {1, 1}, at)};
    const WarpErrors errors = warp_errors(samples, at, candidate.view(at));
    if (errors.best() >= least) continue;
    least = errors.best();
    found.errors = errors;
    undone = turn;
  }
  if (!undone) return found;
  field = turned_back(field, *undone);
  found.undone = undone->text;
  return found;
}

}  // namespace episcope::io
