// SPDX-License-Identifier: BSD-3-Clause
#include "tests/cuda/cases.h"

#include "engine/disparity/estimator.h"
#include "engine/disparity/registry.h"
#include "engine/scenes/builtin.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace episcope::cuda_tests {
namespace {

constexpr const char* kMasked = "masked:";
constexpr const char* kGrey = "grey:";
constexpr const char* kFloat = "float:";
constexpr const char* kMoved = "moved:";

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

using Bytes = ViewStack<std::uint8_t>;

LightField::Samples as_grey(const Bytes& samples) {
  ViewStack<std::uint16_t> grey(samples.grid(), samples.height(), samples.width());
  const int channels = samples.channels();
  for (std::size_t i = 0; i < grey.size(); ++i) grey.data()[i] = 257 * samples.data()[i * channels];
  return grey;
}

LightField::Samples as_float(const Bytes& samples) {
  ViewStack<float> values(samples.grid(), samples.height(), samples.width(), samples.channels());
  std::transform(samples.data(), samples.data() + samples.size(), values.data(),
                 [](std::uint8_t sample) { return static_cast<float>(sample) / 255; });
  return values;
}

// The same scene with other samples, or a mask.
void change(Scene& scene, const std::string& how) {
  const LightField& lf = *scene.light_field;
  const auto& samples = std::get<Bytes>(lf.samples());
  LightField::Samples changed = how == kGrey    ? as_grey(samples)
                                : how == kFloat ? as_float(samples)
                                                : samples.clone();
  Bytes mask = how == kMasked ? round_mask(lf) : Bytes();
  scene.light_field = std::make_shared<LightField>(std::move(changed), lf.info(), std::move(mask));
}

// Cameras stand up to a quarter of a step beside the grid, and the file says so.
std::vector<CameraPosition> moved_cameras(GridShape grid) {
  std::vector<CameraPosition> positions;
  const ViewIndex center = grid.center();
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    const double off = view == center ? 0 : 0.25;
    positions.push_back(
        {view.u - center.u + off * std::sin(5 * i), view.v - center.v + off * std::cos(7 * i)});
  }
  return positions;
}

}  // namespace

Kind kind_of(const Estimator& estimator) {
  if (estimator.info.iterative) return Kind::Iterative;
  return estimator.info.weights.empty() ? Kind::Local : Kind::Learned;
}

std::vector<Case> cases(const std::string& filter) {
  std::vector<Case> cases;
  for (const Estimator& estimator : registered_estimators()) {
    const EstimatorInfo& info = estimator.info;
    if (!info.id.starts_with(filter)) continue;
    if (std::ranges::count(info.devices, Device::Cuda) == 0) continue;
    cases.push_back({estimator, {}, info.id});
    if (info.all_views) {
      cases.push_back({estimator, {}, info.id + ", center view", ViewSelection::Center});
    }
    if (!info.weights.empty()) {
      cases.push_back({estimator,
                       {{"silhouettes", std::string("mean")}, {"rounds", 1}},
                       info.id + " mean, one round",
                       ViewSelection::Center});
    }
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
          std::string(kMasked) + "random?seed=5",
          std::string(kMoved) + "random?seed=2",
          "random?seed=4&grid=1x9",
          "random?seed=4&grid=6x1",
          std::string(kGrey) + "random?seed=6&grid=4x2",
          std::string(kFloat) + "random?seed=7&grid=3x17"};
}

Scene make_scene(const std::string& text, int size) {
  const auto colon = text.find(':');
  const std::size_t begin = colon == text.npos ? 0 : colon + 1;
  scenes::BuiltinRequest request = scenes::read_request(text.substr(begin));
  request.options.height = size;
  request.options.width = size + size / 8;
  const std::string how = text.substr(0, begin);
  if (how == kMoved) request.options.positions = moved_cameras(request.options.grid);
  Scene scene = scenes::render_builtin(request.scene, request.options, Progress());
  if (!how.empty() && how != kMoved) change(scene, how);
  return scene;
}

Scene make_label_scene(int size) {
  scenes::BuiltinRequest request = scenes::read_request("random?seed=6");
  request.options.height = request.options.width = size;
  return scenes::render_builtin(request.scene, request.options, Progress());
}

}  // namespace episcope::cuda_tests
