// SPDX-License-Identifier: BSD-3-Clause
#include "tests/cuda/cases.h"

#include "engine/disparity/common/profile.h"
#include "engine/disparity/registry.h"
#include "engine/scenes/request.h"

#include <algorithm>
#include <variant>

namespace episcope::cuda_tests {
namespace {

constexpr const char* kMasked = "masked:";

bool has_profiles(const Estimator& estimator) {
  return std::ranges::any_of(estimator.parameters,
                             [](const auto& parameter) { return parameter.key == kProfileKey; });
}

// As a Lytro picture has them: nothing was seen in the corners.
ViewStack<std::uint8_t> round_mask(const LightField& lf) {
  ViewStack<std::uint8_t> mask(lf.grid(), lf.height(), lf.width());
  const double radius = 0.6 * std::max(lf.height(), lf.width());
  for (int i = 0; i < lf.grid().count(); ++i) {
    const ImageView<std::uint8_t> view = mask.view(lf.grid().view_at(i));
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        const double dy = y - 0.5 * view.height, dx = x - 0.5 * view.width;
        view.at(y, x) = dy * dy + dx * dx < radius * radius ? 1 : 0;
      }
    }
  }
  return mask;
}

}  // namespace

Kind kind_of(const Estimator& estimator) {
  return estimator.info.iterative ? Kind::Iterative : Kind::Local;
}

std::vector<Case> cases(const std::string& filter) {
  std::vector<Case> cases;
  for (const Estimator& estimator : registered_estimators()) {
    const EstimatorInfo& info = estimator.info;
    if (!info.id.starts_with(filter)) continue;
    if (std::ranges::count(info.devices, Device::Cuda) == 0) continue;
    cases.push_back({estimator, {}, info.id});
    if (!has_profiles(estimator)) continue;
    cases.push_back(
        {estimator, {{kProfileKey, std::string(kPaperProfile)}}, info.id + " " + kPaperProfile});
  }
  return cases;
}

std::vector<std::string> scene_texts() {
  return {"demo",
          "slant",
          "random?seed=3&kind=thin",
          "random?seed=8&noise=4",
          "transparent",
          std::string(kMasked) + "random?seed=5"};
}

Scene make_scene(const std::string& text, int size) {
  const bool is_masked = text.starts_with(kMasked);
  scenes::BuiltinRequest request =
      scenes::read_request(is_masked ? text.substr(std::string(kMasked).size()) : text);
  request.options.height = size;
  request.options.width = size + size / 8;
  Scene scene = scenes::render_builtin(request.scene, request.options, Progress());
  if (!is_masked) return scene;
  ViewStack<std::uint8_t> mask = round_mask(*scene.light_field);
  const auto& samples = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples());
  scene.light_field =
      std::make_shared<LightField>(samples.clone(), scene.light_field->info(), std::move(mask));
  return scene;
}

}  // namespace episcope::cuda_tests
