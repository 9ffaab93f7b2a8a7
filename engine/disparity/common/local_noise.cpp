// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/local_noise.h"

#include "engine/core/array/quantile.h"
#include "engine/core/parallel/parallel.h"
#include "engine/disparity/common/box_mean.h"
#include "engine/disparity/tensor/sample_planes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace episcope {
namespace {

constexpr int kRadius = 2;
// Variance of a − 2b + c, in that of a sample.
constexpr float kSecondDifference = 6;
constexpr std::array<PixelIndex, 4> kWays = {{{0, 1}, {1, 0}, {1, 1}, {1, -1}}};

using Planes = std::vector<Image<float>>;

Planes read_view(const LightField& lf, ViewIndex view) {
  Planes planes;
  for (int c = 0; c < lf.channels(); ++c) planes.emplace_back(lf.height(), lf.width());
  SamplePlanes samples(lf);
  for (int y = 0; y < lf.height(); ++y) {
    std::array<float*, 3> rows{};
    for (int c = 0; c < lf.channels(); ++c) rows[c] = planes[c].row(y);
    samples.read(view, y, 0, lf.width(), rows.data());
  }
  return planes;
}

// Squared second differences of one row, mean over the channels, in variances.
void second_differences(const Planes& planes, int y, PixelIndex way, float* out) {
  const int height = planes.front().height(), width = planes.front().width();
  const int middle = std::clamp(y, 1, height - 2);
  std::fill_n(out, width, 0.0F);
  for (const Image<float>& plane : planes) {
    const float* const before = plane.row(middle - way.y) - way.x;
    const float* const here = plane.row(middle);
    const float* const after = plane.row(middle + way.y) + way.x;
    for (int x = 1; x + 1 < width; ++x) {
      const float d = before[x] - 2 * here[x] + after[x];
      out[x] += d * d;
    }
  }
  out[0] = out[1];
  out[width - 1] = out[width - 2];
  const float scale = 1 / (kSecondDifference * static_cast<float>(planes.size()));
  for (int x = 0; x < width; ++x) out[x] *= scale;
}

// Lowers `least` to the means of one direction's windows.
void lower(const Image<float>& squares, Image<float>& least, const Progress& progress) {
  const int width = squares.width();
  parallel_for_workers(squares.height(), progress, [&] {
    return
        [&, columns = std::vector<float>(width), means = std::vector<float>(width)](int y) mutable {
          window_mean_row(squares, y, kRadius, columns.data(), means.data());
          float* const row = least.row(y);
          for (int x = 0; x < width; ++x) row[x] = std::min(row[x], means[x]);
        };
  });
}

Image<float> variance_of(const Planes& planes, const Progress& progress) {
  const int height = planes.front().height(), width = planes.front().width();
  if (height < 3 || width < 3) return Image<float>(height, width);
  Image<float> least(height, width, 1, std::numeric_limits<float>::max());
  Image<float> squares(height, width);
  for (const PixelIndex way : kWays) {
    parallel_for(height, progress,
                 [&](int y) { second_differences(planes, y, way, squares.row(y)); });
    lower(squares, least, progress);
  }
  return least;
}

}  // namespace

Image<float> local_noise_variance(const LightField& lf, ViewIndex view, const Progress& progress) {
  return variance_of(read_view(lf, view), progress);
}

Image<float> local_noise_variance(ImageView<const float> map, const Progress& progress) {
  Planes planes;
  Image<float>& plane = planes.emplace_back(map.height, map.width);
  for (int y = 0; y < map.height; ++y) std::copy_n(map.row(y), map.width, plane.row(y));
  return variance_of(planes, progress);
}

double view_noise_variance(const LightField& lf, ViewIndex view, const Progress& progress) {
  Image<float> variance = local_noise_variance(lf, view, progress);
  return quantile({variance.data(), variance.size()}, 0.5);
}

}  // namespace episcope
