// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/settle_values.h"

#include "engine/io/beside/doubtful_map.h"
#include "engine/io/beside/near_side.h"
#include "engine/io/beside/truth_sign.h"
#include "engine/io/beside/unknown_value.h"

#include <algorithm>
#include <optional>

namespace episcope::io {
namespace {

/// A map that explains views this well needs no fit.
constexpr double kPlain = 0.5;
/// A fit must leave at most this share of the error.
constexpr double kClearlyBetter = 0.85;
/// Maps as they are stored may explain views not much worse than turned ones, which are wrong then.
constexpr double kFarBetter = 0.6;

/// How values of the file became those of the field.
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
  return explanation.unwarped > 0 && explanation.error <= kPlain * explanation.unwarped;
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
  double least = kFarBetter * (stored.unwarped > 0 ? std::min(stored.error, stored.unwarped) : 0);
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
  const NearSide side = find_near_side(samples, at, field.view(at), 1, explanation);
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

SettledUnit settle_values(const LightField::Samples& samples, const std::vector<MapUnit>& units,
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
    if (is_compared && meaning && meaning->error >= kClearlyBetter * as_stored.error) {
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

std::optional<FittedMeaning> settle_unknown_values(const LightField::Samples& samples,
                                                   const std::vector<ValueForm>& forms,
                                                   NamedValues values, ConventionReport& report) {
  const ViewIndex at = values.at(grid_of(samples));
  const std::vector<float> possible = possible_unknown_values(values.field.view(at));
  auto found = fit_doubtful_map(samples, at, values.field.view(at), forms);
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
