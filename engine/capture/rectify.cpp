// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/rectify.h"

#include "engine/capture/camera.h"
#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <type_traits>

namespace episcope::capture {
namespace {

/// Resampling by Lanczos' windowed sinc of 3 lobes, at places to 1/1024 px (OpenCV's own is to 1/32
/// px, which is coarser than views are aligned).
class Lanczos {
 public:
  static constexpr int kTaps = 6;

  Lanczos();

  /// The sample at a place, times `gain`, rounded to T and limited to its range; `channels` values
  /// to `out`. Beyond the border the picture is continued by its last pixels. T: uint8, uint16,
  /// float.
  template <class T>
  void sample(ImageView<const T> picture, const PlanePoint& at, double gain, T* out) const;

 private:
  static constexpr int kSteps = 1024;
  std::vector<std::array<float, kTaps>> weights_;  ///< By the fraction.
};

constexpr int kLobes = 3;
constexpr int kMostChannels = 3;

double lanczos(double x) {
  if (std::abs(x) < 1e-9) return 1;
  if (std::abs(x) >= kLobes) return 0;
  const double p = std::numbers::pi * x;
  return kLobes * std::sin(p) * std::sin(p / kLobes) / (p * p);
}

template <class T>
T rounded(float value) {
  if constexpr (std::is_floating_point_v<T>) {
    return value;
  } else {
    constexpr auto most = static_cast<float>(std::numeric_limits<T>::max());
    return static_cast<T>(std::clamp(value + 0.5F, 0.0F, most));
  }
}

Lanczos::Lanczos() : weights_(kSteps + 1) {
  for (int i = 0; i <= kSteps; ++i) {
    double weights[kTaps];
    double sum = 0;
    for (int k = 0; k < kTaps; ++k) {
      weights[k] = lanczos(k - (kLobes - 1) - static_cast<double>(i) / kSteps);
      sum += weights[k];
    }
    for (int k = 0; k < kTaps; ++k) weights_[i][k] = static_cast<float>(weights[k] / sum);
  }
}

template <class T>
void Lanczos::sample(ImageView<const T> picture, const PlanePoint& at, double gain, T* out) const {
  const int x = static_cast<int>(std::floor(at.x));
  const int y = static_cast<int>(std::floor(at.y));
  const auto& by_x = weights_[static_cast<std::size_t>(std::lround((at.x - x) * kSteps))];
  const auto& by_y = weights_[static_cast<std::size_t>(std::lround((at.y - y) * kSteps))];
  int columns[kTaps];
  for (int k = 0; k < kTaps; ++k) {
    columns[k] = std::clamp(x + k - (kLobes - 1), 0, picture.width - 1) * picture.channels;
  }
  float sum[kMostChannels] = {};
  for (int j = 0; j < kTaps; ++j) {
    const T* row = picture.row(std::clamp(y + j - (kLobes - 1), 0, picture.height - 1));
    for (int c = 0; c < picture.channels; ++c) {
      float in_row = 0;
      for (int k = 0; k < kTaps; ++k) in_row += by_x[k] * static_cast<float>(row[columns[k] + c]);
      sum[c] += by_y[j] * in_row;
    }
  }
  for (int c = 0; c < picture.channels; ++c) {
    out[c] = rounded<T>(sum[c] * static_cast<float>(gain));
  }
}

template void Lanczos::sample(ImageView<const std::uint8_t>, const PlanePoint&, double,
                              std::uint8_t*) const;
template void Lanczos::sample(ImageView<const std::uint16_t>, const PlanePoint&, double,
                              std::uint16_t*) const;
template void Lanczos::sample(ImageView<const float>, const PlanePoint&, double, float*) const;

constexpr int kLeastSide = 32;
constexpr double kBorder = 3;  // px that the interpolation needs

void require_fitting(const LightField& photographs, const LensCamera& camera) {
  if (photographs.width() == camera.width && photographs.height() == camera.height) return;
  throw InvalidInput("the camera was calibrated with photographs of " +
                     std::to_string(camera.width) + "×" + std::to_string(camera.height) +
                     " px, but these have " + std::to_string(photographs.width()) + "×" +
                     std::to_string(photographs.height()) + "; calibrate at that size");
}

RowErrors row_errors(const ViewMatches& matches) {
  const std::vector<double> all = vertical_disparities(matches);
  if (all.empty()) return {};
  return {all[all.size() / 2], all[all.size() * 95 / 100]};
}

struct Frame {
  PlanePoint low{-1e9, -1e9};
  PlanePoint high{1e9, 1e9};
};

/// What all views show, in the aligned plane, shifted: the largest upright rectangle within the
/// borders of every photograph.
Frame common_frame(const RectifyingMap& map, const LightField& photographs) {
  Frame frame;
  const double right = photographs.width() - 1 - kBorder;
  const double bottom = photographs.height() - 1 - kBorder;
  constexpr int steps = 64;
  const GridShape grid = photographs.grid();
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    for (int k = 0; k <= steps; ++k) {
      const double x = kBorder + (right - kBorder) * k / steps;
      const double y = kBorder + (bottom - kBorder) * k / steps;
      frame.low.x = std::max(frame.low.x, map.rectified(view, {kBorder, y}).x);
      frame.high.x = std::min(frame.high.x, map.rectified(view, {right, y}).x);
      frame.low.y = std::max(frame.low.y, map.rectified(view, {x, kBorder}).y);
      frame.high.y = std::min(frame.high.y, map.rectified(view, {x, bottom}).y);
    }
  }
  return frame;
}

/// One view, row by row.
template <class T>
ViewStack<T> resampled(const ViewStack<T>& from, const RectifyingMap& map, int height, int width,
                       const std::vector<double>& gains, const Progress& progress) {
  const GridShape grid = from.grid();
  ViewStack<T> to(grid, height, width, from.channels());
  const Lanczos lanczos;
  parallel_for(grid.count() * height, progress, [&](int item) {
    const ViewIndex view = grid.view_at(item / height);
    const int y = item % height;
    T* row = to.view(view).row(y);
    for (int x = 0; x < width; ++x) {
      lanczos.sample(from.view(view), map.photograph(view, x, y), 1 / gains[item / height],
                     row + static_cast<std::ptrdiff_t>(x) * from.channels());
    }
  });
  return to;
}

}  // namespace

PlanePoint RectifyingMap::photograph(ViewIndex view, double x, double y) const {
  const ViewIndex middle = grid_.center();
  const double f = alignment_.focal_px;
  // The ideal ray, then the observed one, which the correction takes to it.
  const double ideal_x = (x + crop_.x - shift_ * (view.u - middle.u) - camera_.center_x) / f;
  const double ideal_y = (y + crop_.y - shift_ * (view.v - middle.v) - camera_.center_y) / f;
  PlanePoint seen{ideal_x, ideal_y};
  for (int i = 0; i < 2; ++i) {
    const PlanePoint off = correction(view).at(seen.x, seen.y);
    seen = {ideal_x + off.x / f, ideal_y + off.y / f};
  }
  const auto& r = alignment_.rotation;  // its inverse is its transpose
  const double z = r[2] * seen.x + r[5] * seen.y + r[8];
  return pixel_of_ray(camera_, {(r[0] * seen.x + r[3] * seen.y + r[6]) / z,
                                (r[1] * seen.x + r[4] * seen.y + r[7]) / z});
}

PlanePoint RectifyingMap::rectified(ViewIndex view, const PlanePoint& photograph) const {
  const ViewIndex middle = grid_.center();
  const double f = alignment_.focal_px;
  const PlanePoint ray = ray_of_pixel(camera_, photograph);
  const auto& r = alignment_.rotation;
  const double z = r[6] * ray.x + r[7] * ray.y + r[8];
  const double x = (r[0] * ray.x + r[1] * ray.y + r[2]) / z;
  const double y = (r[3] * ray.x + r[4] * ray.y + r[5]) / z;
  const PlanePoint off = correction(view).at(x, y);
  return {f * x + camera_.center_x - off.x + shift_ * (view.u - middle.u) - crop_.x,
          f * y + camera_.center_y - off.y + shift_ * (view.v - middle.v) - crop_.y};
}

PlanePoint Rectified::center_pixel(const LensCamera& camera, const PlanePoint& photograph) const {
  const GridShape grid = light_field->grid();
  const RectifyingMap map(alignment, camera, grid, crop, light_field->info().camera.shift);
  return map.rectified(grid.center(), photograph);
}

Schema<RectifyOptions> rectify_schema() {
  return Schema<RectifyOptions>()
      .real("step", &RectifyOptions::step,
            {"Step",
             "Between neighboring positions of the gantry, in the unit of the mesh; with 1, depth "
             "is in steps"},
            {1e-3, 1e4, true})
      .flag("even_gain", &RectifyOptions::equalize,
            {"Even brightness", "Divide each view by its gain, as measured against the center"});
}

Rectified rectify(const LightField& photographs, const LensCamera& camera,
                  const RectifyOptions& options, const Progress& progress) {
  require_fitting(photographs, camera);
  Rectified result;
  const ViewMatches matches = match_views(photographs, progress.part(0, 0.4));
  result.points = matches.points.size();
  result.before = row_errors(matches);
  result.gains = view_gains(matches);
  progress.step("finding the axes of the gantry");
  result.alignment = align(matches, camera);
  const double shift = median(result.alignment.parallax);
  const GridShape grid = photographs.grid();

  const RectifyingMap whole(result.alignment, camera, grid, {}, shift);
  const Frame frame = common_frame(whole, photographs);
  const PlanePoint crop{std::ceil(frame.low.x), std::ceil(frame.low.y)};
  const int width = static_cast<int>(std::floor(frame.high.x) - crop.x) + 1;
  const int height = static_cast<int>(std::floor(frame.high.y) - crop.y) + 1;
  if (width < kLeastSide || height < kLeastSide) {
    throw InvalidInput(
        "shifted onto one another, the photographs have too little in common; use a smaller step");
  }
  progress.check();
  progress.step("resampling");
  const RectifyingMap map(result.alignment, camera, grid, crop, shift);
  const std::vector<double> gains =
      options.equalize ? result.gains : std::vector<double>(result.gains.size(), 1.0);
  LightField::Samples samples = std::visit(
      [&](const auto& stack) -> LightField::Samples {
        return resampled(stack, map, height, width, gains, progress.part(0.4, 0.7));
      },
      photographs.samples());
  LightFieldInfo info = photographs.info();
  info.camera = {};
  info.camera.baseline = options.step;
  info.camera.focal_length = result.alignment.focal_px;
  info.camera.shift = shift;
  info.camera.pinhole =
      Pinhole{result.alignment.focal_px, camera.center_x - crop.x, camera.center_y - crop.y};
  result.crop = crop;
  result.light_field = std::make_shared<LightField>(std::move(samples), std::move(info));
  result.after = row_errors(match_views(*result.light_field, progress.part(0.7, 1)));
  return result;
}

}  // namespace episcope::capture
