// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/io/models/order/layered_scene.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace episcope::test {
namespace {

/// Random values on a lattice, interpolated smoothly, in [0, 1].
class Texture {
 public:
  explicit Texture(unsigned seed) : values_(kSide * kSide) {
    std::mt19937 random(seed);
    for (double& value : values_) value = static_cast<double>(random() % 1000) / 999;
  }

  [[nodiscard]] double at(double x, double y) const {
    return 0.6 * smooth(x / 3, y / 3) + 0.4 * smooth(x / 9 + 7, y / 9 + 3);
  }

 private:
  static constexpr int kSide = 64;

  [[nodiscard]] double lattice(int x, int y) const {
    return values_[static_cast<std::size_t>((y & (kSide - 1)) * kSide + (x & (kSide - 1)))];
  }
  [[nodiscard]] double smooth(double x, double y) const {
    const int x0 = static_cast<int>(std::floor(x));
    const int y0 = static_cast<int>(std::floor(y));
    const auto ease = [](double t) { return t * t * (3 - 2 * t); };
    const double fx = ease(x - x0);
    const double fy = ease(y - y0);
    return (1 - fy) * ((1 - fx) * lattice(x0, y0) + fx * lattice(x0 + 1, y0)) +
           fy * ((1 - fx) * lattice(x0, y0 + 1) + fx * lattice(x0 + 1, y0 + 1));
  }

  std::vector<double> values_;
};

struct Disc {
  double x = 0;
  double y = 0;
  double radius = 0;
};

std::vector<Disc> discs_of(const LayeredOptions& options) {
  std::mt19937 random(options.seed + 100);
  const auto below = [&](double limit) {
    return limit * static_cast<double>(random() % 1000) / 1000;
  };
  std::vector<Disc> discs;
  for (int i = 0; i < options.discs; ++i) {
    const double x = below(options.width);
    const double y = below(options.height);
    discs.push_back({x, y, 0.06 * options.width + below(0.06 * options.width)});
  }
  return discs;
}

}  // namespace

ViewStack<std::uint8_t> layered_views(const LayeredOptions& options) {
  const Texture near(options.seed);
  const Texture far(options.seed + 50);
  const std::vector<Disc> discs = discs_of(options);
  std::mt19937 random(options.seed + 200);
  std::normal_distribution<double> noise(0, 1);
  const ViewIndex center = options.grid.center();
  ViewStack<std::uint8_t> views(options.grid, options.height, options.width);
  for (int i = 0; i < options.grid.count(); ++i) {
    const ViewIndex view = options.grid.view_at(i);
    const auto at_center = [&](int x, int y, double d) {
      return std::pair{x + d * (view.u - center.u), y + d * (view.v - center.v)};
    };
    for (int y = 0; y < options.height; ++y) {
      for (int x = 0; x < options.width; ++x) {
        const auto [x1, y1] = at_center(x, y, options.foreground_px);
        const auto [x0, y0] = at_center(x, y, options.background_px);
        const bool is_near = std::ranges::any_of(discs, [x1 = x1, y1 = y1](const Disc& disc) {
          return std::hypot(x1 - disc.x, y1 - disc.y) < disc.radius;
        });
        const double grey = 20 + 210 * (is_near ? near.at(x1, y1) : far.at(x0, y0));
        views.view(view).at(y, x) = static_cast<std::uint8_t>(std::clamp(
            std::round(options.gain * (grey + options.noise * noise(random))), 0.0, 255.0));
      }
    }
  }
  return views;
}

ViewStack<std::uint8_t> rearranged(const ViewStack<std::uint8_t>& views, GridShape grid,
                                   const std::function<ViewIndex(int)>& source) {
  ViewStack<std::uint8_t> moved(grid, views.height(), views.width(), views.channels());
  for (int i = 0; i < grid.count(); ++i) {
    std::copy_n(views.view(source(i)).data, views.view_size(), moved.view(grid.view_at(i)).data);
  }
  return moved;
}

}  // namespace episcope::test
