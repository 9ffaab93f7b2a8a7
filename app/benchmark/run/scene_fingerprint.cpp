// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/run/scene_fingerprint.h"

namespace episcope {
namespace {

/// Raised when a metric changes its meaning, so that kept results are judged anew.
constexpr int kMetricRules = 2;

/// The view that is judged: the centre, else the only one that there is.
void add_truth(Fingerprint& fingerprint, const DisparityField& field, ViewIndex center) {
  if (field.empty()) return;
  const DisparityView view = field.view(field.contains(center) ? center : field.disparity.first());
  fingerprint.add_image(view.disparity);
  if (!view.valid.empty()) fingerprint.add_image(view.valid);
}

}  // namespace

std::string scene_fingerprint(const Scene& scene) {
  const LightField& light_field = *scene.light_field;
  const GroundTruth& truth = *scene.truth;
  Fingerprint fingerprint;
  fingerprint.add_value(kMetricRules);
  fingerprint.add_value(light_field.sample_hash());
  const CameraGrid& camera = light_field.info().camera;
  for (const double number : {camera.baseline, camera.focal_length, camera.shift}) {
    fingerprint.add_value(number);
  }
  const Interval range = light_field.info().disparity_range.value_or(Interval{});
  fingerprint.add_value(range.min);
  fingerprint.add_value(range.max);
  for (const DisparityField* field : {&truth.field, &truth.foreground, &truth.background}) {
    add_truth(fingerprint, *field, light_field.center());
    fingerprint.add("|");
  }
  for (const auto& [name, mask] : truth.regions) {
    fingerprint.add(name);
    fingerprint.add_image(mask.view());
  }
  if (truth.high_res) fingerprint.add(truth.high_res->identity());
  return fingerprint.text();
}

std::string text_fingerprint(const std::string& text) {
  Fingerprint fingerprint;
  fingerprint.add(text);
  return fingerprint.text();
}

}  // namespace episcope
