// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/settle_values.h"

#include "engine/io/beside/near_side.h"
#include "engine/io/beside/unknown_zeros.h"

#include <algorithm>

namespace episcope::io {
namespace {

/// A map that explains views this well needs no fit.
constexpr double kPlain = 0.5;
/// A fit must leave at most this share of the error.
constexpr double kClearlyBetter = 0.85;

void drop_zeros(const LightField::Samples& samples, ViewIndex at, float zero, NamedValues values,
                ConventionReport& report) {
  const std::string text = drop_unknown_zeros(samples, at, zero, values.field);
  if (!text.empty()) report.warnings.push_back(values.name + text);
}

/// Negates disparity of the other sign, and says whether it did.
bool correct_sign(const LightField::Samples& samples, ViewIndex at, DisparityField& field) {
  const Explanation explanation = explain_views(samples, at, field.view(at), 1);
  const NearSide side = find_near_side(samples, at, field.view(at), 1, explanation);
  if (!has_other_sign(side, explanation, grid_of(samples))) return false;
  scale_values(field, -1);
  return true;
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
  SettledUnit settled = settle_unit(samples, at, values.field.view(at), units);
  float zero = 0;
  const Explanation& as_stored = settled.explanation;
  // Shifts out of the picture leave nothing to compare.
  const bool is_plain = as_stored.unwarped > 0 && as_stored.error <= kPlain * as_stored.unwarped;
  if (!is_plain) {
    const auto meaning = fit_meaning(samples, at, values.field.view(at), {ValueForm::Linear});
    const bool is_compared = as_stored.unwarped > 0;
    if (meaning && (!is_compared || meaning->error < kClearlyBetter * as_stored.error)) {
      apply_meaning(*meaning, values.field);
      zero = meaning->disparity(0);
      const Explanation first = settled.first;
      settled = settle_unit(samples, at, values.field.view(at), {{1, meaning->text}});
      settled.first = first;
      report.warnings.push_back(meaning->warning(values.name));
    }
  }
  drop_zeros(samples, at, zero, values, report);
  return settled;
}

std::optional<FittedMeaning> settle_unknown_values(const LightField::Samples& samples,
                                                   const std::vector<ValueForm>& forms,
                                                   NamedValues values, ConventionReport& report) {
  const ViewIndex at = values.at(grid_of(samples));
  auto meaning = fit_meaning(samples, at, values.field.view(at), forms);
  if (!meaning) return std::nullopt;
  apply_meaning(*meaning, values.field);
  if (meaning->form == ValueForm::Linear) {
    drop_zeros(samples, at, meaning->disparity(0), values, report);
  }
  const bool is_reversed =
      meaning->form == ValueForm::Linear && correct_sign(samples, at, values.field);
  report.units = "disparity from " + values.name + ": " + meaning->text +
                 (is_reversed ? ", negative = nearer" : "");
  report.units_check = meaning->check;
  report.warnings.push_back(meaning->warning(values.name));
  return meaning;
}

}  // namespace episcope::io
