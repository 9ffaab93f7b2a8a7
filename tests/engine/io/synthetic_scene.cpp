// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/io/synthetic_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope::test {
namespace {

/// Smooth texture on the plane, in 0…255, different in every channel.
double texture(double x, double y, int c) {
  return 127 + 45 * std::sin(0.61 * x + 0.23 * y + c) + 40 * std::sin(0.19 * x - 0.47 * y + 2 * c) +
         30 * std::sin(0.33 * x + 0.71 * y);
}

}  // namespace

Scene plane_scene(const PlaneOptions& options) {
  const GridShape grid = options.grid;
  const ViewIndex center = grid.center();
  ViewStack<std::uint8_t> views(grid, options.height, options.width, options.channels);
  GroundTruth truth;
  truth.field.disparity = ViewStack<float>(grid, options.height, options.width);
  truth.labels = ViewStack<std::int32_t>(grid, options.height, options.width);
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view{i / grid.u, i % grid.u};
    const int du = view.u - center.u;
    const int dv = view.v - center.v;
    for (int y = 0; y < options.height; ++y) {
      for (int x = 0; x < options.width; ++x) {
        // (x, y) shows the point that the center view has at (x + d·du, y + d·dv).
        const double d = (options.d0 + options.slope_x * (x - options.width / 2.0) +
                          options.slope_y * (y - options.height / 2.0)) /
                         (1 - options.slope_x * du - options.slope_y * dv);
        truth.field.disparity.view(view).at(y, x) = static_cast<float>(d);
        truth.labels.view(view).at(y, x) = x + d * du < options.width / 2.0 ? 1 : 2;
        for (int c = 0; c < options.channels; ++c) {
          views.view(view).at(y, x, c) =
              static_cast<std::uint8_t>(std::lround(texture(x + d * du, y + d * dv, c)));
        }
      }
    }
  }
  Scene scene;
  LightFieldInfo info{"plane", "test:plane", {}, Interval{-3, 3}};
  info.camera.baseline = 40;
  info.camera.focal_length = 1.5;
  info.camera.shift = 5;
  info.camera.cam_distance = 12;
  scene.light_field = std::make_shared<LightField>(std::move(views), std::move(info));
  scene.truth = std::make_shared<GroundTruth>(std::move(truth));
  Image<std::int32_t> painted(options.height, options.width);
  painted.at(3, 4) = 1;
  painted.at(3, options.width - 4) = 2;
  scene.scribbles.views.push_back({center, std::move(painted)});
  return scene;
}

const ViewStack<std::uint8_t>& bytes_of(const Scene& scene) {
  return std::get<ViewStack<std::uint8_t>>(scene.light_field->samples());
}

double largest_difference(const DisparityField& a, const DisparityField& b) {
  constexpr double kDifferent = std::numeric_limits<double>::infinity();
  const ViewStack<float>& x = a.disparity;
  const ViewStack<float>& y = b.disparity;
  if (!(x.grid() == y.grid()) || !(x.first() == y.first()) || x.size() != y.size()) {
    return kDifferent;
  }
  double largest = 0;
  for (std::size_t i = 0; i < (x.empty() ? 0 : x.size()); ++i) {
    const bool is_valid_a = a.valid.empty() || a.valid.data()[i] != 0;
    const bool is_valid_b = b.valid.empty() || b.valid.data()[i] != 0;
    if (is_valid_a != is_valid_b) return kDifferent;
    if (is_valid_a) {
      largest = std::max<double>(largest, std::abs(x.data()[i] - y.data()[i]));
    }
  }
  return largest;
}

bool has_same_samples(const Scene& a, const Scene& b) {
  return a.light_field->sample_hash() == b.light_field->sample_hash();
}

std::string describe(const ConventionReport& report) {
  std::string text =
      report.format + " | " + report.order + " | " + report.order_check + " | " + report.units;
  for (const std::string& warning : report.warnings) text += " | " + warning;
  return text;
}

}  // namespace episcope::test
