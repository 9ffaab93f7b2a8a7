// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/disparity/kernels/line_kernel.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace episcope {

/// How samples of invalid pixels (LightField::valid) are read. NaN goes through every filter, so
/// that whatever an invalid sample entered can be told, and left out, at the end.
enum class InvalidSamples { AsStored, AsNan };

/// Reads samples of a light field as float planes in [0, 1], one plane for each channel, whatever
/// type they are stored in. Use one object per thread; valid as long as the light field.
class SamplePlanes {
 public:
  explicit SamplePlanes(const LightField& light_field,
                        InvalidSamples invalid = InvalidSamples::AsStored);

  /// Row `y` of a view, columns [x0, x1) within the image: out[c][i] is channel c of column x0 + i.
  void read(ViewIndex view, int y, int x0, int x1, float* const* out);

  /// As `read`, but row and columns may lie outside the image, which repeats its border there.
  void read_clamped(ViewIndex view, int y, int x0, int x1, float* const* out);

 private:
  void invalidate(ViewIndex view, int y, int x0, int x1, float* const* out) const;

  const LightField& light_field_;
  bool invalid_as_nan_ = false;
  std::vector<float> interleaved_;
};

/// All views with each pixel packed into one word: three channels of 10 bits, the first lowest,
/// each round(1023·s) of a sample s in [0, 1]; gray three times. Of a pixel that is not valid, a
/// bit above them and nothing else is set. A single gather then fetches a pixel whatever its type.
/// 4 bytes per ray.
struct PackedViews {
  ViewStack<std::uint32_t> pixels;
  bool has_invalid = false;  ///< Whether any may be not valid.
};

/// Throws Cancelled.
[[nodiscard]] PackedViews pack_views(const LightField& light_field, const Progress& progress);

/// Rows [first_row, end_row) of all views, which are the rows from 0 on of `pixels`. Throws
/// Cancelled.
[[nodiscard]] PackedViews pack_rows(const LightField& light_field, int first_row, int end_row,
                                    const Progress& progress);

/// The views of a rectangle and up to `reach` views beside each in its row and column; `pixels`
/// covers the rectangle around all of these, of which other views are black. Throws Cancelled.
[[nodiscard]] PackedViews pack_around(const LightField& light_field, const ViewRectangle& views,
                                      int reach, const Progress& progress);

/// Number of views that `pack_around` packs for a row of `count` views in the middle of a large
/// grid.
[[nodiscard]] inline int packed_around(int count, int reach) {
  return count + 2 * reach + 2 * reach * count;
}

/// Channel `c` of a packed pixel, in units of 1/1023.
[[nodiscard]] inline int packed_channel(std::uint32_t packed, int c) {
  return static_cast<int>(packed >> (kPackedBits * c)) & kPackedMost;
}

/// Channel `c` of a packed pixel in [0, 1].
[[nodiscard]] inline float packed_sample(std::uint32_t packed, int c) {
  return static_cast<float>(packed_channel(packed, c)) / kPackedMost;
}

/// The light field with every sample relative to its surroundings: half of its ratio to the mean of
/// its channel over (2·radius + 1)² pixels of the same view, at most 1, stored in 16 bits. A gain
/// of a view, or one that varies slowly over it, changes nothing. Windows end at the border;
/// invalid pixels enter no mean. In the dark, where the mean is below 0.02, samples grow less. The
/// brightness of whole regions is lost. Takes 2 bytes a sample. Throws Cancelled.
[[nodiscard]] LightField relative_samples(const LightField& light_field, int radius,
                                          const Progress& progress);

/// The noise variance around each pixel of a view, `[y][x]`, mean over the channels, samples in [0,
/// 1]: the mean square of second differences a − 2b + c over windows of 5×5 px, divided by 6, in
/// the direction of four in which it is smallest, so that edges do not count. An upper bound: fine
/// texture counts as noise. The outermost pixels use the differences of their neighbors.
/// 0 for views of less than 3×3 px. Throws Cancelled.
[[nodiscard]] Image<float> local_noise_variance(const LightField& light_field, ViewIndex view,
                                                const Progress& progress);

/// The noise variance of a whole view: the median of the local ones, in which edges, texture in
/// places and shadows hardly count. Throws Cancelled.
[[nodiscard]] double view_noise_variance(const LightField& light_field, ViewIndex view,
                                         const Progress& progress);

/// The noise variance around each pixel of a map, in the square of its unit.
[[nodiscard]] Image<float> local_noise_variance(ImageView<const float> map,
                                                const Progress& progress);

/// out[x] = the sum of rows [y − radius, y + radius] of the image, of those that exist. Returns how
/// many do.
inline int sum_rows(const Image<float>& image, int y, int radius, float* out) {
  const int begin = std::max(y - radius, 0);
  const int end = std::min(y + radius + 1, image.height());
  std::fill_n(out, image.width(), 0.0F);
  for (int i = begin; i < end; ++i) {
    const float* const row = image.row(i);
    for (int x = 0; x < image.width(); ++x) out[x] += row[x];
  }
  return end - begin;
}

/// out[x] = the mean of in[x − radius … x + radius], of those within [0, width).
inline void box_mean_row(const float* in, int width, int radius, float* out) {
  const auto mean_at = [=](int x) {
    const int begin = std::max(x - radius, 0);
    const int end = std::min(x + radius + 1, width);
    float sum = 0;
    for (int i = begin; i < end; ++i) sum += in[i];
    return sum / static_cast<float>(end - begin);
  };
  const int inner = std::min(radius, width), outer = std::max(inner, width - radius);
  for (int x = 0; x < inner; ++x) out[x] = mean_at(x);
  // Shift by shift, which is vectorized.
  std::fill(out + inner, out + outer, 0.0F);
  for (int i = -radius; i <= radius; ++i) {
    for (int x = inner; x < outer; ++x) out[x] += in[x + i];
  }
  const auto count = static_cast<float>(2 * radius + 1);
  for (int x = inner; x < outer; ++x) out[x] /= count;
  for (int x = outer; x < width; ++x) out[x] = mean_at(x);
}

/// out[x] = the mean of the pixels of the image within `radius` of (y, x) along both axes.
/// `columns` holds a row meanwhile.
inline void window_mean_row(const Image<float>& image, int y, int radius, float* columns,
                            float* out) {
  const auto rows = static_cast<float>(sum_rows(image, y, radius, columns));
  box_mean_row(columns, image.width(), radius, out);
  for (int x = 0; x < image.width(); ++x) out[x] /= rows;
}

}  // namespace episcope
