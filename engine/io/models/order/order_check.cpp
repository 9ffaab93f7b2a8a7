// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/order_check.h"

#include "engine/core/finding.h"
#include "engine/core/numbers.h"
#include "engine/core/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

struct Checked {
  ViewFlip flip;
  bool is_decided = false;
  std::string text;
  std::string warning = {};
  bool is_sign_known = false;
  std::string sign_text = {};
  bool is_poor = false;      ///< Of a truth: it hardly explains the views in any order.
  bool proves_axes = false;  ///< Likewise: along rows and columns as stored.

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
    return fmt::format(finding_text("truth.unchecked"), comparison.squares, 100 * comparison.left,
                       comparison.score);
  }
  const AxisErrors& worse = errors.u.is_poor() ? errors.u : errors.v;
  return fmt::format(
      finding_text("truth.poor"), fixed_text(std::min(worse.forward, worse.reversed), 2),
      errors.u.is_poor() ? "u" : "v", fixed_text(std::max(worse.forward, worse.reversed), 2),
      fixed_text(worse.unwarped, 2));
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
    checked.proves_axes = is_sure;
    checked.text = fmt::format(fmt::runtime(is_sure ? finding_text("order.by_truth")
                                                    : finding_text("order.by_doubtful_truth")),
                               errors_text);
    checked.is_sign_known = is_sure && !expected.is_truth_sign_assumed;
    checked.sign_text = is_sure ? finding_text("sign.either") : finding_text("sign.doubtful_truth");
    if (checked.is_sign_known) {
      checked.sign_text = fmt::format(finding_text("sign.by_truth"), errors_text);
    }
  }
  return checked;
}

Checked check_by_slopes(const CoarseMotion& coarse, ViewFlip expected, const Progress& progress) {
  const SlopeCorrelation slopes = correlate_epi_slopes(coarse, progress);
  Checked checked{expected, slopes.is_decided(), {}};
  if (!checked.is_decided) return checked;
  const bool must_differ = slopes.value < 0;
  if ((expected.u != expected.v) != must_differ) checked.flip.u = !checked.flip.u;
  checked.text = fmt::format(fmt::runtime(must_differ ? finding_text("order.slopes_differ")
                                                      : finding_text("order.slopes_agree")),
                             fixed_text(slopes.value, 2), slopes.points);
  return checked;
}

/// Near and far: what the slopes leave open, or, where they are undecided, all that is known.
void add_occlusion(const CoarseMotion& coarse, Checked& checked, const Progress& progress) {
  const SignFinding sign = check_sign(coarse, checked.flip, checked.is_decided, progress);
  checked.is_sign_known = sign.is_decided;
  checked.sign_text = sign.is_decided ? "by " + sign.evidence : sign.evidence;
  if (!sign.is_decided) return;
  checked.text =
      checked.is_decided
          ? checked.text + "; " + fmt::format(finding_text("order.direction"), sign.evidence)
          : fmt::format(finding_text("order.by_occlusion"), sign.evidence);
  checked.flip = sign.flip;
  checked.is_decided = true;
}

std::string not_checked_text(GridShape grid, bool are_axes_unclear) {
  if (are_axes_unclear) return std::string(finding_text("order.axes_unclear"));
  if (grid.count() == 1) return std::string(finding_text("order.single_view"));
  if (grid.v == 1) return std::string(finding_text("order.one_row"));
  if (grid.u == 1) return std::string(finding_text("order.one_column"));
  return std::string(finding_text("order.no_texture"));
}

/// What views and truth leave open, poses of the cameras tell.
void follow_poses(const ExpectedOrder& expected, Checked& checked) {
  if (checked.is_sign_known || !(checked.flip == expected.flip)) return;
  checked.is_sign_known = true;
  checked.proves_axes = true;
  checked.sign_text = finding_text("sign.by_poses");
  if (!checked.is_decided) checked.text = checked.sign_text;
  checked.is_decided = true;
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
    finding.sign_check = finding_text("sign.by_hand");
    if (checked.is_sign_known) finding.sign_check += ", against the check " + checked.sign_text;
  }
  if (!checked.contradicts(chosen)) return;
  finding.check = "the check favors \"" + flip_text(checked.flip) + "\": " + checked.text;
  finding.warnings.push_back(
      fmt::format(finding_text("order.chosen"), flip_text(chosen), flip_text(checked.flip)));
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

  if (expected.is_of_poses) follow_poses(expected, checked);
  finding.flip = checked.flip;
  finding.are_axes_unclear = expected.are_axes_unclear && !checked.proves_axes;
  const bool is_checked = checked.is_decided && !finding.are_axes_unclear;
  finding.check = is_checked ? checked.text
                             : not_checked_text(grid_of(samples), finding.are_axes_unclear) + "; " +
                                   expected.reason;
  finding.sign = checked.is_sign_known ? "checked" : "";
  finding.sign_check = checked.sign_text;
  if (choice != Flip::Auto) {
    follow(chosen_flip(choice), checked, finding);
    return finding;
  }
  finding.order = flip_text(finding.flip);
  if (!(finding.flip == expected.flip)) {
    finding.warnings.push_back(fmt::format(finding_text("order.unexpected"), finding.order,
                                           flip_text(expected.flip), expected.reason));
  }
  return finding;
}

namespace {

/// Share of the error as stored, and of that without warping, below which a turned map is right:
/// the right map is near the least error that there is, so none can be so much better than it.
constexpr double kFarBetterTurn = 0.6;
/// Share of the error without warping below which a map is right beyond doubt.
constexpr double kEvident = 0.2;

constexpr MapTurn kTurns[] = {{false, true, false, finding_text("truth.rows_reversed").data()},
                              {false, false, true, finding_text("truth.columns_reversed").data()},
                              {false, true, true, finding_text("truth.both_reversed").data()},
                              {true, false, false, finding_text("truth.transposed").data()}};

/// A single view of the stack, or all.
template <class T>
ViewStack<T> turned(const ViewStack<T>& stack, const MapTurn& turn, GridShape grid,
                    ViewIndex first) {
  if (stack.empty()) return {};
  const int height = turn.is_transposed ? stack.width() : stack.height();
  const int width = turn.is_transposed ? stack.height() : stack.width();
  ViewStack<T> out(grid, height, width, 1, first);
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

DisparityField turned_back(const DisparityField& field, const MapTurn& turn) {
  const GridShape grid = field.disparity.grid();
  const ViewIndex first = field.disparity.first();
  return {turned(field.disparity, turn, grid, first), turned(field.valid, turn, grid, first)};
}

std::optional<MapTurn> far_better_turn(
    const DisparityView& map, double error,
    const std::function<double(const DisparityView&)>& error_of) {
  DisparityField field{ViewStack<float>({1, 1}, map.disparity.height, map.disparity.width),
                       ViewStack<std::uint8_t>({1, 1}, map.disparity.height, map.disparity.width)};
  for (int y = 0; y < map.disparity.height; ++y) {
    std::copy_n(map.disparity.row(y), map.disparity.width, field.disparity.view({}).row(y));
    for (int x = 0; x < map.disparity.width; ++x) {
      field.valid.view({}).at(y, x) = map.is_valid(y, x) ? 1 : 0;
    }
  }
  double least = kFarBetterTurn * error;
  std::optional<MapTurn> found;
  for (const MapTurn& turn : kTurns) {
    if (turn.is_transposed && map.disparity.height != map.disparity.width) continue;
    const double so = error_of(turned_back(field, turn).view({}));
    if (so >= least) continue;
    least = so;
    found = turn;
  }
  return found;
}

std::string turned_back_text(const std::string& turn) {
  return fmt::format(finding_text("truth.turned"), turn);
}

UprightTruth put_truth_upright(const LightField::Samples& samples, DisparityField& field) {
  if (field.empty()) return {};
  const ViewIndex at = told_view(field, grid_of(samples));
  UprightTruth found{{}, warp_errors(samples, at, field.view(at))};
  const double error = found.errors->best(), without = found.errors->unwarped();
  if (error < kEvident * without) return found;
  const auto errors_of = [&](const DisparityView& map) { return warp_errors(samples, at, map); };
  const auto turn = far_better_turn(field.view(at), std::min(error, without),
                                    [&](const auto& map) { return errors_of(map).best(); });
  if (!turn) return found;
  field = turned_back(field, *turn);
  return {turn->text, errors_of(field.view(at))};
}

namespace {

/// What hides what at depth edges, as seen along one or both view axes.
struct OcclusionVotes {
  /// Points where, by the order of views as stored, the nearer of two surfaces hides the farther
  /// one, and points where it is the other way round, as if the axis were reversed.
  long long forward = 0;
  long long reversed = 0;
  /// Squares of 16×16 px in which most of the points say so: points side by side are no
  /// independent evidence.
  int forward_squares = 0;
  int reversed_squares = 0;

  [[nodiscard]] bool is_decided() const;
  [[nodiscard]] bool says_reversed() const { return reversed_squares > forward_squares; }
  /// The votes if the axis is reversed.
  [[nodiscard]] OcclusionVotes turned() const {
    return {reversed, forward, reversed_squares, forward_squares};
  }
  OcclusionVotes& operator+=(const OcclusionVotes& more);
};

/// Votes of every view axis; none for an axis of fewer than three views.
struct OcclusionByAxis {
  OcclusionVotes u;
  OcclusionVotes v;
};

constexpr int kVoteSquare = 16;
constexpr float kLeastApart = 2;  ///< Shifts that differ by less are of one surface.
constexpr float kClearly = 0.6;
/// Windows that differ by less than this many times the usual error may differ by noise.
constexpr float kWindowAboveNoise = 2.5;
constexpr float kLeastWindowContrast = 0.5;
constexpr double kSignificantVotes = 3.3;  ///< Standard deviations of votes by chance.
/// Systematic errors, such as edges found beside their place, must be clearly fewer.
constexpr double kMajority = 0.35;

/// A point of the middle view that a shift leads to some place.
struct Arrival {
  int x = -1;
  float shift = 0;
};

/// The two surfaces that are led to one place of a view.
struct Arrivals {
  Arrival smallest{-1, std::numeric_limits<float>::max()};
  Arrival largest{-1, std::numeric_limits<float>::lowest()};

  void add(int x, float shift) {
    if (shift < smallest.shift) smallest = {x, shift};
    if (shift > largest.shift) largest = {x, shift};
  }
  [[nodiscard]] bool is_collision() const { return largest.shift - smallest.shift >= kLeastApart; }
};

/// Compares small windows of the middle view with other views.
class Windows {
 public:
  Windows(const Image<float>& middle, const Image<float>& target, const Image<float>& opposite)
      : middle_(middle), target_(target), opposite_(opposite) {}

  /// Sets the contrast above which windows differ by more than noise: from the median error of
  /// windows moved by their own shifts.
  void measure_noise(const Image<float>& shift, float side) {
    std::vector<float> errors;
    for (int y = 1; y < shift.height(); y += 3) {
      for (int x = 1; x < shift.width(); x += 3) {
        const float error = on_opposite(y, x, side * shift.at(y, x));
        if (std::isfinite(error)) errors.push_back(error);
      }
    }
    if (errors.empty()) return;
    contrast_ = kLeastWindowContrast + kWindowAboveNoise * quantile(errors, 0.5);
  }
  [[nodiscard]] float contrast() const { return contrast_; }

  /// How far the window at x, moved by `by`, differs from the target or the opposite view.
  [[nodiscard]] float on_target(int y, int x, float by) const { return error(target_, y, x, by); }
  [[nodiscard]] float on_opposite(int y, int x, float by) const {
    return error(opposite_, y, x, by);
  }

 private:
  [[nodiscard]] float error(const Image<float>& other, int y, int x, float by) const {
    if (!std::isfinite(by)) return by;
    const float place = static_cast<float>(x) + by;
    const int whole = static_cast<int>(std::floor(place));
    if (y < 1 || y >= middle_.height() - 1 || x < 1 || x >= middle_.width() - 1 || whole < 1 ||
        whole >= other.width() - 2) {
      return std::numeric_limits<float>::quiet_NaN();
    }
    const float part = place - static_cast<float>(whole);
    float sum = 0;
    for (int j = -1; j <= 1; ++j) {
      const float* a = middle_.row(y + j) + x;
      const float* b = other.row(y + j) + whole;
      for (int i = -1; i <= 1; ++i) {
        sum += std::abs(a[i] - (1 - part) * b[i] - part * b[i + 1]);
      }
    }
    return sum / 9;
  }

  const Image<float>& middle_;
  const Image<float>& target_;
  const Image<float>& opposite_;
  float contrast_ = kLeastWindowContrast;
};

/// +1 if the point with the larger shift hides the other one, −1 if it is hidden, 0 if that cannot
/// be told. `side` is +1 for the view after the middle one.
int winner(const Windows& windows, int y, const Arrivals& two, float side) {
  const Arrival& p = two.smallest;
  const Arrival& q = two.largest;
  // NaN makes every comparison false.
  const auto moves_alone = [&](const Arrival& one, float other_shift) {
    const float own = windows.on_opposite(y, one.x, side * one.shift);
    const float other = windows.on_opposite(y, one.x, side * other_shift);
    return own < kClearly * other && other > windows.contrast();
  };
  if (!moves_alone(p, q.shift) || !moves_alone(q, p.shift)) return 0;
  const float p_error = windows.on_target(y, p.x, -side * p.shift);
  const float q_error = windows.on_target(y, q.x, -side * q.shift);
  if (q_error < kClearly * p_error && p_error > windows.contrast()) return 1;
  if (p_error < kClearly * q_error && q_error > windows.contrast()) return -1;
  return 0;
}

/// Counts points by squares of the view.
class Tally {
 public:
  Tally(int height, int width)
      : columns_(width / kVoteSquare + 1),
        balance_(static_cast<std::size_t>(columns_) * (height / kVoteSquare + 1)) {}

  void add(int y, int x, int vote) {
    (vote > 0 ? votes_.forward : votes_.reversed) += 1;
    balance_[static_cast<std::size_t>(y / kVoteSquare) * columns_ + x / kVoteSquare] += vote;
  }
  [[nodiscard]] OcclusionVotes votes() const {
    OcclusionVotes all = votes_;
    for (const int square : balance_) {
      if (square > 0) ++all.forward_squares;
      if (square < 0) ++all.reversed_squares;
    }
    return all;
  }

 private:
  int columns_;
  std::vector<int> balance_;
  OcclusionVotes votes_;
};

OcclusionVotes votes_of(const LineMatches& matches) {
  if (matches.shift.empty()) return {};
  const Image<float>& shift = matches.shift;
  Tally tally(shift.height(), shift.width());
  for (const int side : {-1, 1}) {
    Windows windows(matches.views.middle, matches.views.far[side > 0 ? 1 : 0],
                    matches.views.far[side > 0 ? 0 : 1]);
    windows.measure_noise(shift, static_cast<float>(side));
    std::vector<Arrivals> row(static_cast<std::size_t>(shift.width()));
    for (int y = 0; y < shift.height(); ++y) {
      std::ranges::fill(row, Arrivals{});
      for (int x = 0; x < shift.width(); ++x) {
        const float by = shift.at(y, x);
        if (!std::isfinite(by)) continue;
        const int place =
            static_cast<int>(std::lround(static_cast<float>(x) - static_cast<float>(side) * by));
        if (place >= 0 && place < shift.width()) row[static_cast<std::size_t>(place)].add(x, by);
      }
      for (const Arrivals& two : row) {
        if (two.smallest.x < 0 || !two.is_collision()) continue;
        const int vote = winner(windows, y, two, static_cast<float>(side));
        // Reversed views exchange the two: their middle stays.
        if (vote != 0) tally.add(y, (two.smallest.x + two.largest.x) / 2, vote);
      }
    }
  }
  return tally.votes();
}

OcclusionVotes& OcclusionVotes::operator+=(const OcclusionVotes& more) {
  forward += more.forward;
  reversed += more.reversed;
  forward_squares += more.forward_squares;
  reversed_squares += more.reversed_squares;
  return *this;
}

bool OcclusionVotes::is_decided() const {
  const double sum = forward_squares + reversed_squares;
  const double difference = std::abs(forward_squares - reversed_squares);
  const bool is_agreed = (forward > reversed) == (forward_squares > reversed_squares);
  return is_agreed && difference > kSignificantVotes * std::sqrt(sum) &&
         difference > kMajority * sum;
}

/// Two points of the view at the center of the grid whose disparities lead them to the same place
/// of another view, and which in the opposite view are seen side by side, each with its own motion:
/// the one that is seen in that place is the nearer one. If it has the larger disparity, the axis
/// has the canonical direction. Looks at five views of each axis, reduced to at most `side` px, of
/// them at the middle of 512×512 px. Linear in the range of disparities. Throws Cancelled.
OcclusionByAxis count_occlusions(const CoarseMotion& coarse, int side, const Progress& progress) {
  const auto [u, v] = along_both_axes(
      progress, [&](bool is_v) { return votes_of(match_line(coarse, is_v, side, progress)); });
  return {u, v};
}

constexpr int kLargestVoteSide = 1024;
constexpr int kSmallestVoteSide = 256;

constexpr std::string_view kVotesText = finding_text("sign.occlusion");
constexpr std::size_t kBeforeCounts = kVotesText.find('{');

std::string counted(const OcclusionVotes& votes) {
  return fmt::format(fmt::runtime(kVotesText.substr(kBeforeCounts)),
                     std::max(votes.forward, votes.reversed),
                     std::min(votes.forward, votes.reversed),
                     std::max(votes.forward_squares, votes.reversed_squares),
                     std::min(votes.forward_squares, votes.reversed_squares));
}

/// Both axes together, counted for the order `flip`.
OcclusionVotes votes_for(const OcclusionByAxis& votes, ViewFlip flip) {
  OcclusionVotes sum = flip.u ? votes.u.turned() : votes.u;
  sum += flip.v ? votes.v.turned() : votes.v;
  return sum;
}

SignFinding related_axes(const OcclusionByAxis& votes, ViewFlip flip) {
  const OcclusionVotes sum = votes_for(votes, flip);
  if (!sum.is_decided()) return {flip, false, {}};
  if (sum.says_reversed()) flip = {!flip.u, !flip.v};
  return {flip, true, std::string(kVotesText.substr(0, kBeforeCounts)) + counted(sum)};
}

SignFinding single_axes(const OcclusionByAxis& votes, GridShape grid, ViewFlip flip) {
  const bool needs_u = grid.u > 1;
  const bool needs_v = grid.v > 1;
  SignFinding found{flip, false, {}};
  found.is_decided = (!needs_u || votes.u.is_decided()) && (!needs_v || votes.v.is_decided());
  if (!found.is_decided) return found;
  if (needs_u) found.flip.u = votes.u.says_reversed();
  if (needs_v) found.flip.v = votes.v.says_reversed();
  found.evidence = kVotesText.substr(0, kBeforeCounts);
  if (needs_u) found.evidence += "along u " + counted(votes.u);
  if (needs_u && needs_v) found.evidence += "; ";
  if (needs_v) found.evidence += "along v " + counted(votes.v);
  return found;
}

}  // namespace

SignFinding check_sign(const CoarseMotion& coarse, ViewFlip flip, bool are_axes_related,
                       const Progress& progress) {
  const auto [grid, larger] = std::visit(
      [](const auto& stack) {
        return std::pair(stack.grid(), std::max(stack.width(), stack.height()));
      },
      coarse.samples());
  SignFinding found{flip, false, {}};
  if (std::max(grid.u, grid.v) < 3) {
    found.evidence = finding_text("sign.few_views");
    return found;
  }
  OcclusionVotes most;
  for (int side = std::min(larger, kLargestVoteSide); side >= std::min(kSmallestVoteSide, larger);
       side = (side + 1) / 2) {
    progress.check();
    const OcclusionByAxis votes = count_occlusions(coarse, side, progress);
    found = are_axes_related ? related_axes(votes, flip) : single_axes(votes, grid, flip);
    if (found.is_decided) return found;
    const OcclusionVotes sum = votes_for(votes, flip);
    if (sum.forward + sum.reversed > most.forward + most.reversed) most = sum;
    if (side <= kSmallestVoteSide) break;
  }
  found.evidence = fmt::format(finding_text("sign.no_edges"), most.forward, most.reversed);
  return found;
}

}  // namespace episcope::io
