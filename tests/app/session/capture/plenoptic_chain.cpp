// SPDX-License-Identifier: BSD-3-Clause
#include "tests/app/session/capture/plenoptic_chain.h"

#include "app/session/raw_scene.h"
#include "engine/core/numbers.h"
#include "engine/disparity/registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope::test {
namespace {

using capture::Decoded;
using capture::SyntheticCamera;

constexpr int kInset = 6;  // px; estimates at borders differ for other reasons

double rms_of_centers(const capture::LensGrid& grid, const SyntheticCamera& camera) {
  const capture::LensBlock block =
      capture::lens_block(grid, camera.height, camera.width, camera.pitch_px);
  double sum = 0;
  int count = 0;
  for (int j = block.first_row; j < block.first_row + block.rows; ++j) {
    const int first = static_cast<int>(std::ceil(lens_at(grid, block.first_column, j)));
    for (int i = first; i < first + static_cast<int>(block.columns); ++i) {
      const capture::PlanePoint found = grid.center(i, j), truth = camera.center(i, j);
      sum += std::pow(found.x - truth.x, 2) + std::pow(found.y - truth.y, 2);
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

/// The part of the ideal views that was decoded.
LightField cropped(const LightField& ideal, const Decoded& decoded, const SyntheticCamera& camera) {
  const LightField& field = *decoded.light_field;
  ViewStack<std::uint8_t> samples(field.grid(), field.height(), field.width(), field.channels());
  const int x0 = camera.view_width() / 2 + decoded.first_x;
  const int y0 = camera.view_height() / 2 + decoded.first_y;
  for (int k = 0; k < field.grid().count(); ++k) {
    const ViewIndex view = field.grid().view_at(k);
    for (int y = 0; y < field.height(); ++y) {
      std::copy_n(ideal.view<std::uint8_t>(view).row(y0 + y) + x0 * field.channels(),
                  field.width() * field.channels(), samples.view(view).row(y));
    }
  }
  return LightField(std::move(samples), {});
}

double median_difference(const LightField& a, const LightField& b) {
  const Estimator& method = find_estimator("st_ch_s");
  const ParameterSet range{{"range", IntervalOrAuto(Interval{-2, 2})}};
  const Estimate first = method.run(a, range, {}, Progress(2));
  const Estimate second = method.run(b, range, {}, Progress(2));
  const ViewIndex center = a.center();
  std::vector<double> differences;
  for (int y = kInset; y < a.height() - kInset; ++y) {
    for (int x = kInset; x < a.width() - kInset; ++x) {
      differences.push_back(std::abs(first.field.disparity.view(center).at(y, x) -
                                     second.field.disparity.view(center).at(y, x)));
    }
  }
  return median(differences);
}

/// The views of the middle row or column.
LightField line_of(const LightField& field, bool is_column) {
  const int n = is_column ? field.grid().v : field.grid().u;
  ViewStack<std::uint16_t> samples(is_column ? GridShape{n, 1} : GridShape{1, n}, field.height(),
                                   field.width(), field.channels());
  for (int k = 0; k < n; ++k) {
    const ViewIndex c = field.center();
    const auto from = field.view<std::uint16_t>(is_column ? ViewIndex{k, c.u} : ViewIndex{c.v, k});
    std::copy_n(from.data, from.size(),
                samples.view(is_column ? ViewIndex{k, 0} : ViewIndex{0, k}).data);
  }
  return LightField(std::move(samples), {});
}

/// Median ratio of disparities of horizontal and vertical EPIs where they are large.
double slope_ratio(const LightField& field, const Image<float>& disparity) {
  const Estimator& method = find_estimator("st_ch_s");
  const ParameterSet range{{"range", IntervalOrAuto(Interval{-2, 2})}};
  const LightField row = line_of(field, false), column = line_of(field, true);
  const Estimate across = method.run(row, range, {}, Progress(2));
  const Estimate down = method.run(column, range, {}, Progress(2));
  std::vector<double> ratios;
  for (int y = kInset; y < field.height() - kInset; ++y) {
    for (int x = kInset; x < field.width() - kInset; ++x) {
      if (std::abs(disparity.at(y, x)) < 0.3) continue;
      const double h = across.field.disparity.view(row.center()).at(y, x);
      const double v = down.field.disparity.view(column.center()).at(y, x);
      if (std::abs(v) > 0.1) ratios.push_back(h / v);
    }
  }
  return median(ratios);
}

/// Shift of rows of one parity along x, from the ideal center view.
double row_shift(const LightField& field, const LightField& ideal, int parity, double level) {
  const Image<float> found = field.view_as_float(field.center());
  const Image<float> truth = ideal.view_as_float(ideal.center());
  double with = 0, all = 0;
  for (int y = kInset + parity; y < field.height() - kInset; y += 2) {
    for (int x = kInset; x < field.width() - kInset; ++x) {
      for (int k = 0; k < field.channels(); ++k) {
        const double gradient = (truth.at(y, x + 1, k) - truth.at(y, x - 1, k)) / 2;
        with += gradient * (found.at(y, x, k) / level - truth.at(y, x, k));
        all += gradient * gradient;
      }
    }
  }
  return -with / all;
}

struct Brightness {
  double worst_percent = 0;
  double level = 1;
};

Brightness brightness(const LightField& field, const LightField& ideal) {
  std::vector<double> ratios;
  double found_all = 0, truth_all = 0;
  for (int k = 0; k < field.grid().count(); ++k) {
    const ViewIndex view = field.grid().view_at(k);
    const Image<float> a = field.view_as_float(view), b = ideal.view_as_float(view);
    double found = 0, truth = 0;
    std::size_t seen = 0;
    for (int y = 0; y < field.height(); ++y) {
      for (int x = 0; x < field.width(); ++x) {
        if (!field.is_valid(view, y, x)) continue;
        ++seen;
        for (int c = 0; c < field.channels(); ++c) {
          found += a.at(y, x, c);
          truth += b.at(y, x, c);
        }
      }
    }
    if (seen * 2 < a.size() / a.channels()) continue;  // a dark corner
    ratios.push_back(found / truth);
    found_all += found;
    truth_all += truth;
  }
  Brightness result;
  result.level = found_all / truth_all;
  for (const double ratio : ratios) {
    result.worst_percent = std::max(result.worst_percent, 100 * std::abs(ratio - 1));
  }
  return result;
}

}  // namespace

std::string ChainErrors::text() const {
  return fmt::format(
      "centers {:.3f} px, disparity {:.4f} px, slopes {:.2f} %, rows {:.3f} px, brightness {:.2f} "
      "% "
      "(level {:.3f}); {}×{} views of {}×{}, residual {:.3f}, hot {}",
      center_px, disparity_px, slope_percent, row_shift_px, brightness_percent, level,
      decoded.light_field->grid().v, decoded.light_field->grid().u, decoded.light_field->width(),
      decoded.light_field->height(), decoded.grid.residual_px, decoded.hot_pixels);
}

ChainErrors chain_errors(const std::string& scene, const SyntheticCamera& camera, bool has_white) {
  const scenes::BuiltinRequest request = scenes::read_request(scene);
  capture::SyntheticPictures seen = expose(camera, light_of(request, camera), Progress(2));
  capture::PlenopticPictures pictures;
  pictures.raw = std::move(seen.raw);
  if (has_white) pictures.white = std::move(seen.white);
  pictures.dark = std::move(seen.dark);

  ChainErrors errors;
  const capture::LensGrid grid = find_lenses(pictures, Progress(2));
  errors.decoded = decode(pictures, grid, {}, Progress(2));
  const LightField& field = *errors.decoded.light_field;
  const Scene ideal = ideal_views(request, camera, field.grid().u, Progress(2));
  const LightField truth = cropped(*ideal.light_field, errors.decoded, camera);

  errors.center_px = rms_of_centers(grid, camera);
  errors.disparity_px = median_difference(field, truth);
  Image<float> disparity(field.height(), field.width());
  for (int y = 0; y < field.height(); ++y) {
    std::copy_n(ideal.truth->field.disparity.view(ideal.light_field->center())
                        .row(camera.view_height() / 2 + errors.decoded.first_y + y) +
                    camera.view_width() / 2 + errors.decoded.first_x,
                field.width(), disparity.row(y));
  }
  errors.slope_percent = 100 * std::abs(slope_ratio(field, disparity) - 1);
  const Brightness light = brightness(field, truth);
  errors.brightness_percent = light.worst_percent;
  errors.level = light.level;
  errors.row_shift_px =
      std::abs(row_shift(field, truth, 0, light.level) - row_shift(field, truth, 1, light.level));
  return errors;
}

}  // namespace episcope::test
