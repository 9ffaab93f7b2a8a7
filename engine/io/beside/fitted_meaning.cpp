// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/fitted_meaning.h"

#include "engine/io/beside/shift_fit.h"
#include "engine/io/maps/foreign_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope::io {
namespace {

constexpr int kMostPoints = 60000;
/// A scale is one by a round number if it is so within this part of it,
constexpr double kRound = 0.01;
/// and the offset is no more than this, in px.
constexpr double kNoOffset = 0.03;

std::vector<ValuePoint> points_of(const DisparityView& map, ValueForm form) {
  const ImageView<const float>& values = map.disparity;
  const double area = static_cast<double>(values.height) * values.width;
  const int stride = std::max(1, static_cast<int>(std::sqrt(area / kMostPoints)));
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

void apply_meaning(const FittedMeaning& meaning, DisparityField& field) {
  std::for_each(field.disparity.data(), field.disparity.data() + field.disparity.size(),
                [&](float& value) { value = meaning.disparity(value); });
  mark_invalid(field);
}

}  // namespace episcope::io
