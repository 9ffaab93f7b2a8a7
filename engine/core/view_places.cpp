// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/view_places.h"

#include "engine/core/numbers.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

constexpr double kRegular = 0.02;  // steps
constexpr double kOutlier = 0.5;   // steps
constexpr double kMostOutliers = 0.1;
constexpr double kMostSkew = 1.0 / 3;
constexpr double kMostRatio = 2;
constexpr int kPlaneSweeps = 50;

double median_of_finite(std::vector<float> values) {
  std::erase_if(values, [](float value) { return !std::isfinite(value); });
  return values.empty() ? 0 : quantile(values, 0.5);
}

// One coordinate of all positions, and the plane through it: base + along_u·u + along_v·v.
class Coordinate {
 public:
  Coordinate(GridShape grid, std::vector<double> values) : grid_(grid), values_(std::move(values)) {
    along_u = median_of_finite(differences({0, 1}));
    along_v = median_of_finite(differences({1, 0}));
    std::vector<float> bases;
    bases.reserve(grid_.count());
    for (int i = 0; i < grid_.count(); ++i) {
      bases.push_back(static_cast<float>(values_[i] - slope(grid_.view_at(i))));
    }
    base_ = median_of_finite(bases);
  }

  // Least squares over the views that are believed, by Gauss and Seidel.
  void refine(const std::vector<bool>& is_believed) {
    for (int sweep = 0; sweep < kPlaneSweeps; ++sweep) {
      base_ += mean_residual(is_believed, [](ViewIndex) { return 1; });
      along_u += mean_residual(is_believed, [this](ViewIndex v) { return v.u - grid_.center().u; });
      along_v += mean_residual(is_believed, [this](ViewIndex v) { return v.v - grid_.center().v; });
    }
  }

  [[nodiscard]] double fitted(int i) const { return base_ + slope(grid_.view_at(i)); }
  // As stated, or where the grid has it.
  [[nodiscard]] double value(int i, bool is_stated) const {
    return is_stated ? values_[i] : fitted(i);
  }
  [[nodiscard]] bool is_near(int i, double distance) const {
    return std::abs(values_[i] - fitted(i)) <= distance;
  }

  double along_u = 0, along_v = 0;

 private:
  // About the center.
  [[nodiscard]] double slope(ViewIndex view) const {
    return along_u * (view.u - grid_.center().u) + along_v * (view.v - grid_.center().v);
  }
  // The change of a coefficient that fits the residuals best.
  template <class Factor>
  [[nodiscard]] double mean_residual(const std::vector<bool>& is_believed,
                                     const Factor& factor) const {
    double sum = 0, weight = 0;
    for (int i = 0; i < grid_.count(); ++i) {
      if (!is_believed[i]) continue;
      const double f = factor(grid_.view_at(i));
      sum += f * (values_[i] - fitted(i));
      weight += f * f;
    }
    return weight > 0 ? sum / weight : 0;
  }
  [[nodiscard]] std::vector<float> differences(ViewIndex way) const {
    std::vector<float> all;
    for (int i = 0; i < grid_.count(); ++i) {
      const ViewIndex view = grid_.view_at(i), next{view.v + way.v, view.u + way.u};
      if (!grid_.contains(next)) continue;
      all.push_back(static_cast<float>(values_[next.v * grid_.u + next.u] - values_[i]));
    }
    return all;
  }

  GridShape grid_;
  std::vector<double> values_;
  double base_ = 0;
};

bool is_grid(const Coordinate& x, const Coordinate& y, GridShape grid) {
  const double step_u = std::abs(x.along_u), step_v = std::abs(y.along_v);
  if (grid.u > 1 && !(step_u > 0 && std::abs(y.along_u) <= kMostSkew * step_u)) return false;
  if (grid.v > 1 && !(step_v > 0 && std::abs(x.along_v) <= kMostSkew * step_v)) return false;
  if (grid.u == 1 || grid.v == 1) return true;
  return step_u <= kMostRatio * step_v && step_v <= kMostRatio * step_u;
}

double deviation_from_grid(const std::vector<ViewPlace>& places, GridShape grid) {
  const ViewIndex center = grid.center();
  const ViewPlace origin = places[static_cast<std::size_t>(center.v) * grid.u + center.u];
  double largest = 0;
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    largest = std::max({largest, std::abs(places[i].v - origin.v - (view.v - center.v)),
                        std::abs(places[i].u - origin.u - (view.u - center.u))});
  }
  return largest;
}

}  // namespace

ViewPlaces view_places(const LightFieldInfo& info, GridShape grid) {
  ViewPlaces result;
  if (info.positions.size() != static_cast<std::size_t>(grid.count()) || grid.count() < 2) {
    return result;
  }
  std::vector<double> xs, ys;
  for (const CameraPosition& position : info.positions) {
    xs.push_back(position.x);
    ys.push_back(position.y);
  }
  Coordinate x(grid, std::move(xs)), y(grid, std::move(ys));
  result.kind = PlacesKind::Implausible;
  if (!is_grid(x, y, grid)) return result;
  const auto unit = [&](double along) {
    return std::copysign(grid.u > 1 ? x.along_u : y.along_v, along);
  };
  std::vector<bool> is_believed;
  is_believed.reserve(grid.count());
  for (int i = 0; i < grid.count(); ++i) {
    is_believed.push_back(x.is_near(i, kOutlier * unit(1)) && y.is_near(i, kOutlier * unit(1)));
  }
  result.outliers = static_cast<int>(std::ranges::count(is_believed, false));
  if (result.outliers > kMostOutliers * grid.count()) return result;
  x.refine(is_believed);
  y.refine(is_believed);
  const double u = unit(x.along_u), v = unit(y.along_v);
  for (int i = 0; i < grid.count(); ++i) {
    const bool stands = is_believed[i];
    result.places.push_back({y.value(i, stands) / v, x.value(i, stands) / u});
  }
  result.largest_deviation = deviation_from_grid(result.places, grid);
  result.kind = result.largest_deviation < kRegular ? PlacesKind::Regular : PlacesKind::Irregular;
  if (result.kind == PlacesKind::Regular) result.places.clear();
  return result;
}

}  // namespace episcope
