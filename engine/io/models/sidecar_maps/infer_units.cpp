// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/infer_units.h"

#include "engine/io/models/external_result.h"
#include "engine/io/models/order/warp_check.h"
#include "engine/io/models/sidecar_maps/disparity_units.h"
#include "engine/io/models/sidecar_maps/shift_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace episcope::io {
namespace {

constexpr std::ptrdiff_t kFewestUnknown = 30;
constexpr double kMostShare = 0.9;
/// Values next to the unknown one, within this part of the farthest, are next to none: else it
/// is one of them.
constexpr double kGapAroundUnknown = 0.05;
constexpr double kFewInGap = 0.1;  ///< Of the pixels with the unknown value.
/// Zeros are a spike if so many times as many pixels have them as any value nearby.
constexpr std::ptrdiff_t kSpike = 8;
constexpr std::ptrdiff_t kFewestFilled = 200;
/// They are contradicted if what lies around them explains the views by so much better; if it
/// explains them by so much worse, they are right.
constexpr double kFilledBetter = 0.93;
constexpr double kLeastDifference = 0.3;  ///< Grey levels.
constexpr double kAlike = 0.2;            ///< px between both: then neither matters.
/// Values are contradicted if their error is so many times the error of the others.
constexpr double kContradicted = 2;
/// Values other than 0 may belong to a surface that matches badly, but better than unwarped.
constexpr double kAsUnwarped = 0.9;

Image<std::uint8_t> pixels_of(const DisparityView& map, float value) {
  const ImageView<const float>& values = map.disparity;
  Image<std::uint8_t> pixels(values.height, values.width);
  for (int y = 0; y < values.height; ++y) {
    for (int x = 0; x < values.width; ++x) {
      pixels.at(y, x) = map.is_valid(y, x) && values.at(y, x) == value ? 1 : 0;
    }
  }
  return pixels;
}

/// Other values than the one that so many pixels have, near it.
struct Nearby {
  std::ptrdiff_t pixels = 0;
  std::ptrdiff_t most = 0;  ///< Pixels that have the same one.
};

std::optional<Nearby> values_near(const DisparityView& map, float value) {
  std::vector<float> distances;
  const ImageView<const float>& values = map.disparity;
  for (int y = 0; y < values.height; ++y) {
    for (int x = 0; x < values.width; ++x) {
      if (!map.is_valid(y, x) || values.at(y, x) == value) continue;
      distances.push_back(std::abs(values.at(y, x) - value));
    }
  }
  if (distances.empty()) return std::nullopt;
  const double gap = kGapAroundUnknown * *std::ranges::max_element(distances);
  std::erase_if(distances, [=](float distance) { return distance >= gap; });
  std::ranges::sort(distances);
  Nearby near{std::ssize(distances), 0};
  for (auto i = distances.begin(); i != distances.end();) {
    const auto next = std::upper_bound(i, distances.end(), *i);
    near.most = std::max(near.most, next - i);
    i = next;
  }
  return near;
}

void mark(DisparityField& field, float value) {
  field.require_mask();
  for (std::size_t i = 0; i < field.disparity.size(); ++i) {
    if (field.disparity.data()[i] == value) field.valid.data()[i] = 0;
  }
}

std::ptrdiff_t count_of(const DisparityView& map, float value) {
  const Image<std::uint8_t> pixels = pixels_of(map, value);
  return std::count(pixels.begin(), pixels.end(), std::uint8_t{1});
}

Image<float> scaled(const ImageView<const float>& map, double factor) {
  Image<float> out(map.height, map.width);
  for (int y = 0; y < map.height; ++y) {
    std::transform(map.row(y), map.row(y) + map.width, out.row(y),
                   [&](float value) { return static_cast<float>(factor * value); });
  }
  return out;
}

/// With the orders of views in which others fit better; infinite if nothing was compared.
double error_as_of(const WarpErrors& errors, const WarpErrors& others) {
  const auto pixels = static_cast<double>(errors.u.pixels + errors.v.pixels);
  if (pixels == 0) return std::numeric_limits<double>::infinity();
  const auto sum = [](const AxisErrors& axis, const AxisErrors& other) {
    return (other.says_reversed() ? axis.reversed : axis.forward) *
           static_cast<double>(axis.pixels);
  };
  return (sum(errors.u, others.u) + sum(errors.v, others.v)) / pixels;
}

/// A map in px, the pixels that may be unknown, and the others.
struct Doubtful {
  const LightField::Samples& samples;
  ViewIndex at;
  const Image<float>& disparity;
  const Image<std::uint8_t>& pixels;
  const Image<std::uint8_t>& others;
};

struct Verdict {
  bool is_wrong = false;
  std::string evidence;  ///< Empty if the value is as good as others.

  [[nodiscard]] std::string sentence(float stored, double percent) const {
    if (evidence.empty()) return {};
    const std::string is = fmt::format(" is {:.7g} at {:.3g} % of its pixels, ", stored, percent);
    if (is_wrong) {
      return is + "which the views contradict (" + evidence + "): no disparity is known there.";
    }
    return is +
           "and hardly anywhere nearly so: whether that stands for unknown, the views do not "
           "tell (" +
           evidence + ").";
  }
};

/// Whether the views contradict the value more than the others.
Verdict compare_with_others(const Doubtful& map, float stored) {
  const WarpErrors there =
      warp_errors(map.samples, map.at, {map.disparity.view(), map.pixels.view()});
  const WarpErrors elsewhere =
      warp_errors(map.samples, map.at, {map.disparity.view(), map.others.view()});
  const double error = error_as_of(there, elsewhere);
  const bool helps = stored != 0 && error < kAsUnwarped * there.unwarped();
  if (!(error > kContradicted * elsewhere.best()) || helps) return {};
  return {true, std::isfinite(error) ? fmt::format("grey error {:.2f} there, {:.2f} elsewhere",
                                                   error, elsewhere.best())
                                     : "it leads out of the picture"};
}

/// The map with those pixels as the last of the others before them, row by row, from either end.
Image<float> filled(const Doubtful& map, bool from_end) {
  Image<float> values = map.disparity;
  const std::size_t all = values.size();
  const auto place = [&](std::size_t i) { return from_end ? all - 1 - i : i; };
  std::size_t first = 0;
  while (first < all && map.others.data()[place(first)] == 0) ++first;
  if (first == all) return values;
  float last = values.data()[place(first)];
  for (std::size_t i = 0; i < all; ++i) {
    float& value = values.data()[place(i)];
    if (map.others.data()[place(i)] != 0) last = value;
    value = last;
  }
  return values;
}

/// How well these values explain those pixels, and how far they are from the doubtful ones.
struct Filling {
  double error = 0;
  double distance = 0;  ///< Mean, in px.
};

Filling filling_from(const Doubtful& map, bool from_end, const WarpErrors& elsewhere) {
  const Image<float> values = filled(map, from_end);
  Filling filling;
  double pixels = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (map.pixels.data()[i] == 0) continue;
    filling.distance += std::abs(values.data()[i] - map.disparity.data()[i]);
    pixels += 1;
  }
  filling.distance /= pixels;
  filling.error =
      error_as_of(warp_errors(map.samples, map.at, {values.view(), map.pixels.view()}), elsewhere);
  return filling;
}

/// Whether values of the surroundings explain those pixels better, whatever the noise.
Verdict compare_with_filled(const Doubtful& map) {
  const WarpErrors elsewhere =
      warp_errors(map.samples, map.at, {map.disparity.view(), map.others.view()});
  const WarpErrors there =
      warp_errors(map.samples, map.at, {map.disparity.view(), map.pixels.view()});
  const double error = error_as_of(there, elsewhere);
  const Filling around = std::ranges::min(filling_from(map, false, elsewhere),
                                          filling_from(map, true, elsewhere), {}, &Filling::error);
  if (around.distance < kAlike || error < kFilledBetter * around.error) return {};
  const bool is_wrong =
      around.error < kFilledBetter * error && error - around.error > kLeastDifference;
  return {is_wrong, fmt::format("grey error {:.2f} there, {:.2f} with the values around", error,
                                around.error)};
}

/// 1 where the map is valid and has another value, `[y][x]`.
Image<std::uint8_t> valid_without(const DisparityView& map, float value) {
  Image<std::uint8_t> valid(map.disparity.height, map.disparity.width);
  for (int y = 0; y < valid.height(); ++y) {
    for (int x = 0; x < valid.width(); ++x) {
      valid.at(y, x) = map.is_valid(y, x) && map.disparity.at(y, x) != value ? 1 : 0;
    }
  }
  return valid;
}

}  // namespace

std::vector<float> possible_unknown_values(const DisparityView& map) {
  std::vector<float> values{0, -1};
  std::optional<float> smallest, largest;
  for (int y = 0; y < map.disparity.height; ++y) {
    for (int x = 0; x < map.disparity.width; ++x) {
      if (!map.is_valid(y, x)) continue;
      const float value = map.disparity.at(y, x);
      smallest = std::min(smallest.value_or(value), value);
      largest = std::max(largest.value_or(value), value);
    }
  }
  for (const std::optional<float>& extreme : {largest, smallest}) {
    if (extreme && *extreme != 0 && *extreme != -1) values.push_back(*extreme);
  }
  std::erase_if(values, [&](float value) { return count_of(map, value) < kFewestUnknown; });
  return values;
}

std::string drop_unknown_value(const LightField::Samples& samples, ViewIndex at,
                               const UnknownValue& unknown, DisparityField& field) {
  const DisparityView map = field.view(at);
  const Image<std::uint8_t> pixels = pixels_of(map, unknown.value);
  const auto count = std::count(pixels.begin(), pixels.end(), std::uint8_t{1});
  const auto all = static_cast<double>(pixels.size());
  if (count < kFewestUnknown || static_cast<double>(count) > kMostShare * all) return {};
  const auto near = values_near(map, unknown.value);
  if (!near) return {};
  const bool is_apart = static_cast<double>(near->pixels) < kFewInGap * static_cast<double>(count);
  const bool is_spike = unknown.stored == 0 && count >= kFewestFilled &&
                        count > kSpike * std::max<std::ptrdiff_t>(near->most, 1);
  if (!is_apart && !is_spike) return {};
  const Image<std::uint8_t> others = valid_without(map, unknown.value);
  const Image<float> disparity = scaled(map.disparity, unknown.factor);
  const Doubtful doubtful{samples, at, disparity, pixels, others};
  Verdict verdict;
  if (is_apart) verdict = compare_with_others(doubtful, unknown.stored);
  if (is_spike && !verdict.is_wrong) verdict = compare_with_filled(doubtful);
  if (verdict.is_wrong) mark(field, unknown.value);
  return verdict.sentence(unknown.stored, 100 * static_cast<double>(count) / all);
}

namespace {

constexpr int kMostValuePoints = 60000;
/// A scale is one by a round number if it is so within this part of it,
constexpr double kRound = 0.01;
/// and the offset is no more than this, in px.
constexpr double kNoOffset = 0.03;

std::vector<ValuePoint> points_of(const DisparityView& map, ValueForm form) {
  const ImageView<const float>& values = map.disparity;
  const double area = static_cast<double>(values.height) * values.width;
  const int stride = std::max(1, static_cast<int>(std::sqrt(area / kMostValuePoints)));
  std::vector<ValuePoint> points;
  for (int y = 0; y < values.height; y += stride) {
    for (int x = 0; x < values.width; x += stride) {
      if (!map.is_valid(y, x)) continue;
      const double value = values.at(y, x);
      if (form == ValueForm::Linear) points.push_back({y, x, value});
      if (form == ValueForm::Inverse && value > 0) points.push_back({y, x, 1 / value});
    }
  }
  return points;
}

/// 0 if the scale is not one by such a number.
double round_divisor(const ShiftFit& fit) {
  if (std::abs(fit.offset) > kNoOffset) return 0;
  constexpr double kDivisors[] = {2,    4,    8,    10,   16,   32,  64,  100,   128,   256,  512,
                                  1000, 1024, 2048, 4096, 8192, 1e4, 1e5, 16384, 32768, 65536};
  const auto* const found = std::ranges::find_if(
      kDivisors, [&](double divisor) { return std::abs(fit.slope * divisor - 1) < kRound; });
  return found == std::end(kDivisors) ? 0 : *found;
}

std::string formula(const FittedMeaning& meaning) {
  const char* const operation = meaning.form == ValueForm::Linear ? "·value" : "/value";
  return fmt::format("d = {:.6g}{} {} {:.4g} px per view step", meaning.scale, operation,
                     meaning.offset < 0 ? "−" : "+", std::abs(meaning.offset));
}

}  // namespace

float FittedMeaning::disparity(float value) const {
  if (form == ValueForm::Linear) return static_cast<float>(scale * value + offset);
  if (!(value > 0)) return std::numeric_limits<float>::quiet_NaN();
  return static_cast<float>(scale / value + offset);
}

CameraGrid FittedMeaning::camera() const {
  CameraGrid camera;
  if (form == ValueForm::Linear) return camera;
  camera.baseline = scale;
  camera.focal_length = 1;
  camera.shift = -offset;
  return camera;
}

std::string FittedMeaning::warning(const std::string& name) const {
  return fmt::format(
      "What the numbers of {} mean is not stated in a usable way; {} was found by "
      "comparing them with the views.",
      name, text);
}

namespace {

/// The form, of those to try, that explains how the views next to `at` differ, with scale and
/// offset (`fit_shift`). A scale of one by a round number, with next to no offset, is taken as
/// exactly that. Nothing if no form does.
std::optional<FittedMeaning> fit_meaning(const LightField::Samples& samples, ViewIndex at,
                                         const DisparityView& map,
                                         const std::vector<ValueForm>& forms) {
  std::optional<ShiftFit> best;
  FittedMeaning meaning;
  for (const ValueForm form : forms) {
    const auto fit = fit_shift(samples, at, points_of(map, form));
    if (!fit || (best && fit->error >= best->error)) continue;
    best = fit;
    meaning.form = form;
  }
  if (!best) return std::nullopt;
  meaning.scale = best->slope;
  meaning.offset = best->offset;
  meaning.error = best->error;
  meaning.unwarped = best->unwarped;
  meaning.text = formula(meaning);
  const double divisor = meaning.form == ValueForm::Linear ? round_divisor(*best) : 0;
  if (divisor > 0) {
    meaning.scale = 1 / divisor;
    meaning.offset = 0;
    meaning.text = fmt::format("d = value/{:g} px per view step", divisor);
  }
  meaning.check = fmt::format(
      "found from the views: they differ by {:.2f} grey levels after warping, by {:.2f} unwarped; "
      "each of eight parts of the values agrees within {:.3f} px",
      best->error, best->unwarped, best->deviation);
  return meaning;
}

/// Turns the values of all views into disparity; where that is none, pixels become invalid.
void apply_meaning(const FittedMeaning& meaning, DisparityField& field) {
  std::for_each(field.disparity.data(), field.disparity.data() + field.disparity.size(),
                [&](float& value) { value = meaning.disparity(value); });
  mark_invalid(field);
}

/// What the numbers of a map mean that may hold others, too, or be stored in another order of
/// pixels.
struct AmbiguousMeaning {
  FittedMeaning meaning;
  std::optional<MapTurn> turn = std::nullopt;  ///< How the map was stored.
};

/// A map that explains views this well, as a share of the error without warping, is as it should
/// be.
constexpr double kWell = 0.5;
/// Largest share of the error that another reading of a map may leave: maps as they are stored may
/// explain views not much worse than turned ones, which are wrong then.
constexpr double kFarBetterReading = 0.6;
/// The map as it is where that explains the views well (`fit_meaning`). Else also without each
/// value that may stand for unknown (`possible_unknown_values`), else also turned back
/// (`possible_turns`); each must explain the views far better than those before.
std::optional<AmbiguousMeaning> fit_ambiguous_map(const LightField::Samples& samples, ViewIndex at,
                                                  const DisparityView& map,
                                                  const std::vector<ValueForm>& forms) {
  std::optional<AmbiguousMeaning> best;
  const auto is_well = [&] { return best && best->meaning.error < kWell * best->meaning.unwarped; };
  const auto look = [&](const DisparityView& part, const std::optional<MapTurn>& turn) {
    auto meaning = fit_meaning(samples, at, part, forms);
    if (!meaning || (best && meaning->error > kFarBetterReading * best->meaning.error)) return;
    best = {std::move(*meaning), turn};
  };
  look(map, std::nullopt);
  for (const float unknown : possible_unknown_values(map)) {
    if (is_well()) break;
    const Image<std::uint8_t> valid = valid_without(map, unknown);
    look({map.disparity, valid.view()}, std::nullopt);
  }
  for (const MapTurn& turn : possible_turns(map.disparity.height, map.disparity.width)) {
    if (is_well()) break;
    look(turned_back(map, turn).view({}), turn);
  }
  return best;
}

/// A map that explains views this well needs no fit.
constexpr double kPlainMap = 0.5;
/// A fit must leave at most this share of the error.
constexpr double kClearlyBetterFit = 0.85;

/// How values of the file became values of the field.
struct Becoming {
  const FittedMeaning* meaning = nullptr;  ///< If they were turned into disparity,
  double factor = 1;                       ///< else what is still to be done.
};

void drop_unknown(const LightField::Samples& samples, const std::vector<float>& possible,
                  const Becoming& becoming, NamedValues values, ConventionReport& report) {
  const ViewIndex at = values.at(grid_of(samples));
  for (const float stored : possible) {
    const float value = becoming.meaning ? becoming.meaning->disparity(stored) : stored;
    const std::string text =
        drop_unknown_value(samples, at, {stored, value, becoming.factor}, values.field);
    if (!text.empty()) report.warnings.push_back(values.name + text);
  }
}

bool is_plain(const Explanation& explanation) {
  // Shifts out of the picture leave nothing to compare.
  return explanation.unwarped > 0 && explanation.error <= kPlainMap * explanation.unwarped;
}

void turn_back(const MapTurn& turn, DisparityField& field, ConventionReport& report) {
  field = turned_back(field, turn);
  report.warnings.push_back(turned_back_text(turn.text));
}

/// Before near and far are judged, which mirrored maps would get wrong.
void put_upright(const LightField::Samples& samples, const std::vector<MapUnit>& units,
                 ViewIndex at, DisparityField& field, ConventionReport& report) {
  const DisparityView map = field.view(at);
  const Explanation stored = settle_unit(samples, at, map, units).explanation;
  if (is_plain(stored)) return;
  double least =
      kFarBetterReading * (stored.unwarped > 0 ? std::min(stored.error, stored.unwarped) : 0);
  std::optional<MapTurn> found;
  for (const MapTurn& turn : possible_turns(map.disparity.height, map.disparity.width)) {
    const DisparityField turned = turned_back(map, turn);
    const double error = settle_unit(samples, at, turned.view({}), units).explanation.error;
    if (error >= least) continue;
    least = error;
    found = turn;
  }
  if (found) turn_back(*found, field, report);
}

/// Negates disparity of the other sign.
TruthSign correct_sign(const LightField::Samples& samples, ViewIndex at, DisparityField& field) {
  const Explanation explanation = explain_views(samples, at, field.view(at), 1);
  const OcclusionOrder side = find_occlusion_order(samples, at, field.view(at), 1, explanation);
  TruthSign sign = find_truth_sign(samples, side, explanation);
  if (sign.is_negated) scale_values(field, -1);
  return sign;
}

}  // namespace

ViewIndex NamedValues::at(GridShape grid) const {
  return field.contains(grid.center()) ? grid.center() : field.disparity.first();
}

void scale_values(DisparityField& field, double factor) {
  if (factor == 1) return;
  std::for_each(field.disparity.data(), field.disparity.data() + field.disparity.size(),
                [&](float& value) { value = static_cast<float>(factor * value); });
}

SettledUnit infer_units(const LightField::Samples& samples, const std::vector<MapUnit>& units,
                        NamedValues values, ConventionReport& report) {
  const ViewIndex at = values.at(grid_of(samples));
  const std::vector<float> possible = possible_unknown_values(values.field.view(at));
  put_upright(samples, units, at, values.field, report);
  SettledUnit settled = settle_unit(samples, at, values.field.view(at), units);
  const Explanation& as_stored = settled.explanation;
  std::optional<FittedMeaning> meaning;
  if (!is_plain(as_stored)) {
    meaning = fit_meaning(samples, at, values.field.view(at), {ValueForm::Linear});
    const bool is_compared = as_stored.unwarped > 0;
    if (is_compared && meaning && meaning->error >= kClearlyBetterFit * as_stored.error) {
      meaning = std::nullopt;
    }
  }
  if (meaning) {
    apply_meaning(*meaning, values.field);
    const Explanation first = settled.first;
    settled = settle_unit(samples, at, values.field.view(at), {{1, meaning->text}});
    settled.first = first;
    report.warnings.push_back(meaning->warning(values.name));
  }
  const Becoming becoming{meaning ? &*meaning : nullptr, settled.unit.factor};
  drop_unknown(samples, possible, becoming, values, report);
  return settled;
}

std::optional<FittedMeaning> infer_unknown_units(const LightField::Samples& samples,
                                                 const std::vector<ValueForm>& forms,
                                                 NamedValues values, ConventionReport& report) {
  const ViewIndex at = values.at(grid_of(samples));
  const std::vector<float> possible = possible_unknown_values(values.field.view(at));
  auto found = fit_ambiguous_map(samples, at, values.field.view(at), forms);
  if (!found) return std::nullopt;
  if (found->turn) turn_back(*found->turn, values.field, report);
  FittedMeaning& meaning = found->meaning;
  apply_meaning(meaning, values.field);
  drop_unknown(samples, possible, {&meaning, 1}, values, report);
  // Depth is larger where it is farther.
  TruthSign sign{false, true, {}};
  if (meaning.form == ValueForm::Linear) sign = correct_sign(samples, at, values.field);
  report.units = "disparity from " + values.name + ": " + meaning.text +
                 (sign.is_negated ? ", negative = nearer" : "");
  report.units_check = meaning.check;
  meaning.is_sign_assumed = !sign.is_known;
  report.warnings.push_back(meaning.warning(values.name));
  return meaning;
}

}  // namespace episcope::io
