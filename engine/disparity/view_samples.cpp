// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/view_samples.h"

#include "engine/core/isa.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/disparity/kernels/sample_kernel.h"

#include <array>
#include <limits>
#include <utility>

namespace episcope {

SamplePlanes::SamplePlanes(const LightField& light_field, InvalidSamples invalid)
    : light_field_(light_field),
      invalid_as_nan_(invalid == InvalidSamples::AsNan && !light_field.valid().empty()) {}

void SamplePlanes::invalidate(ViewIndex view, int y, int x0, int x1, float* const* out) const {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const std::uint8_t* const valid = light_field_.valid().view(view).row(y);
  for (int x = x0; x < x1; ++x) {
    if (valid[x] != 0) continue;
    for (int c = 0; c < light_field_.channels(); ++c) out[c][x - x0] = kNan;
  }
}

void SamplePlanes::read(ViewIndex view, int y, int x0, int x1, float* const* out) {
  const int channels = light_field_.channels();
  if (light_field_.sample_type() == SampleType::UInt8) {
    const std::uint8_t* row = light_field_.view<std::uint8_t>(view).row(y);
    EPISCOPE_CHOOSE_KERNEL(best_isa(), kSampleKernel)
        .deinterleave(row + static_cast<std::size_t>(x0) * channels, x1 - x0, channels, out);
    if (invalid_as_nan_) invalidate(view, y, x0, x1, out);
    return;
  }
  interleaved_.resize(static_cast<std::size_t>(x1 - x0) * channels);
  light_field_.read_row(view, y, x0, x1, interleaved_.data());
  for (int i = 0; i < x1 - x0; ++i) {
    for (int c = 0; c < channels; ++c) out[c][i] = interleaved_[i * channels + c];
  }
  if (invalid_as_nan_) invalidate(view, y, x0, x1, out);
}

void SamplePlanes::read_clamped(ViewIndex view, int y, int x0, int x1, float* const* out) {
  const int width = light_field_.width();
  const int row = std::clamp(y, 0, light_field_.height() - 1);
  const int first = std::clamp(x0, 0, width - 1);
  const int last = std::clamp(x1, first + 1, width);
  // Where the columns that exist belong; all may lie to one side of what is wanted.
  const int begin = std::clamp(first - x0, 0, x1 - x0 - 1);
  std::array<float*, 3> inside{};
  for (int c = 0; c < light_field_.channels(); ++c) inside[c] = out[c] + begin;
  const int count = std::min(last - first, x1 - x0 - begin);
  read(view, row, first, first + count, inside.data());
  for (int c = 0; c < light_field_.channels(); ++c) {
    std::fill(out[c], inside[c], inside[c][0]);
    std::fill(inside[c] + count, out[c] + (x1 - x0), inside[c][count - 1]);
  }
}

namespace {

constexpr std::uint32_t kInvalid = 1U << kPackedInvalidBit;

std::uint32_t quantized(float sample) {
  return static_cast<std::uint32_t>(std::clamp(sample, 0.0F, 1.0F) * kPackedMost + 0.5F);
}

void pack_row(const float* samples, int width, int channels, std::uint32_t* out) {
  const int second = channels == 3 ? 1 : 0;
  for (int x = 0; x < width; ++x) {
    const float* const s = samples + static_cast<std::ptrdiff_t>(x) * channels;
    out[x] = quantized(s[0]) | quantized(s[second]) << kPackedBits |
             quantized(s[2 * second]) << (2 * kPackedBits);
  }
}

void mark_invalid(const std::uint8_t* valid, int width, std::uint32_t* out) {
  for (int x = 0; x < width; ++x) {
    if (valid[x] == 0) out[x] = kInvalid;
  }
}

// From the row `first_row` on, as many as `packed` has.
void pack_view(const LightField& lf, ViewIndex view, int first_row, PackedViews& packed) {
  const ImageView<std::uint32_t> out = packed.pixels.view(view);
  std::vector<float> row(static_cast<std::size_t>(lf.width()) * lf.channels());
  for (int i = 0; i < out.height; ++i) {
    const int y = first_row + i;
    lf.read_row(view, y, 0, lf.width(), row.data());
    pack_row(row.data(), lf.width(), lf.channels(), out.row(i));
    if (packed.has_invalid) mark_invalid(lf.valid().view(view).row(y), lf.width(), out.row(i));
  }
}

// How far outside [first, first + count) a place is.
int beyond(int place, int first, int count) {
  return std::max({first - place, place - (first + count - 1), 0});
}

constexpr float kDark = 0.02F;

// Sums over windows of one view, `values` and how many pixels count, from running sums.
class WindowMeans {
 public:
  WindowMeans(const LightField& lf, ViewIndex view, int radius)
      : lf_(lf),
        view_(view),
        radius_(radius),
        sums_(static_cast<std::size_t>(lf.width()) * lf.channels()),
        counts_(lf.width()),
        row_(sums_.size()) {
    for (int y = 0; y < std::min(radius, lf.height()); ++y) add(y, 1);
  }

  // The means of row y, which must be asked for in order.
  void next(int y, float* means) {
    if (y + radius_ < lf_.height()) add(y + radius_, 1);
    if (y - radius_ - 1 >= 0) add(y - radius_ - 1, -1);
    const int channels = lf_.channels(), width = lf_.width();
    double sum[3] = {}, count = 0;
    const auto move = [&](int x, int sign) {
      if (x < 0 || x >= width) return;
      for (int c = 0; c < channels; ++c) sum[c] += sign * sums_[x * channels + c];
      count += sign * counts_[x];
    };
    for (int x = 0; x < radius_; ++x) move(x, 1);
    for (int x = 0; x < width; ++x) {
      move(x + radius_, 1);
      move(x - radius_ - 1, -1);
      for (int c = 0; c < channels; ++c) {
        means[x * channels + c] = count > 0 ? static_cast<float>(sum[c] / count) : 0;
      }
    }
  }

 private:
  void add(int y, int sign) {
    const int channels = lf_.channels();
    lf_.read_row(view_, y, 0, lf_.width(), row_.data());
    for (int x = 0; x < lf_.width(); ++x) {
      if (!lf_.is_valid(view_, y, x)) continue;
      for (int c = 0; c < channels; ++c) sums_[x * channels + c] += sign * row_[x * channels + c];
      counts_[x] += sign;
    }
  }

  const LightField& lf_;
  ViewIndex view_;
  int radius_;
  std::vector<double> sums_, counts_;  // Of the columns of the window.
  std::vector<float> row_;
};

void make_relative(const LightField& lf, ViewIndex view, int radius, ImageView<std::uint16_t> out) {
  WindowMeans windows(lf, view, radius);
  std::vector<float> means(static_cast<std::size_t>(lf.width()) * lf.channels()), row(means.size());
  for (int y = 0; y < lf.height(); ++y) {
    windows.next(y, means.data());
    lf.read_row(view, y, 0, lf.width(), row.data());
    std::uint16_t* const to = out.row(y);
    for (std::size_t i = 0; i < row.size(); ++i) {
      const float relative = 0.5F * row[i] / std::max(means[i], kDark);
      to[i] = to_word_sample(relative);
    }
  }
}

constexpr std::array<PixelIndex, 4> kWays = {{{0, 1}, {1, 0}, {1, 1}, {1, -1}}};

using ViewChannels = std::vector<Image<float>>;

ViewChannels read_view(const LightField& lf, ViewIndex view) {
  ViewChannels planes;
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
void second_differences(const ViewChannels& planes, int y, PixelIndex way, float* out) {
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
          window_mean_row(squares, y, kNoiseRadius, columns.data(), means.data());
          float* const row = least.row(y);
          for (int x = 0; x < width; ++x) row[x] = std::min(row[x], means[x]);
        };
  });
}

Image<float> variance_of(const ViewChannels& planes, const Progress& progress) {
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

PackedViews pack_views(const LightField& lf, const Progress& progress) {
  return pack_rows(lf, 0, lf.height(), progress);
}

PackedViews pack_rows(const LightField& lf, int first_row, int end_row, const Progress& progress) {
  PackedViews packed{ViewStack<std::uint32_t>(lf.grid(), end_row - first_row, lf.width()),
                     !lf.valid().empty()};
  parallel_for(lf.grid().count(), progress,
               [&](int i) { pack_view(lf, lf.grid().view_at(i), first_row, packed); });
  return packed;
}

PackedViews pack_around(const LightField& lf, const ViewRectangle& views, int reach,
                        const Progress& progress) {
  const ViewIndex from{std::max(views.first.v - reach, 0), std::max(views.first.u - reach, 0)};
  const ViewIndex to{std::min(views.first.v + views.grid.v + reach, lf.grid().v),
                     std::min(views.first.u + views.grid.u + reach, lf.grid().u)};
  PackedViews packed{ViewStack<std::uint32_t>({to.v - from.v, to.u - from.u}, lf.height(),
                                              lf.width(), 1, from, allocate_large_zeros),
                     !lf.valid().empty()};
  parallel_for(packed.pixels.grid().count(), progress, [&](int i) {
    const ViewIndex view = packed.pixels.view_at(i);
    const bool is_beside = beyond(view.v, views.first.v, views.grid.v) == 0 ||
                           beyond(view.u, views.first.u, views.grid.u) == 0;
    if (is_beside) pack_view(lf, view, 0, packed);
  });
  return packed;
}

LightField relative_samples(const LightField& lf, int radius, const Progress& progress) {
  ViewStack<std::uint16_t> samples(lf.grid(), lf.height(), lf.width(), lf.channels());
  parallel_for(lf.grid().count(), progress, [&](int i) {
    const ViewIndex view = lf.grid().view_at(i);
    make_relative(lf, view, radius, samples.view(view));
  });
  return {std::move(samples), lf.info(), lf.valid().clone()};
}

Image<float> local_noise_variance(const LightField& lf, ViewIndex view, const Progress& progress) {
  return variance_of(read_view(lf, view), progress);
}

Image<float> local_noise_variance(ImageView<const float> map, const Progress& progress) {
  ViewChannels planes;
  Image<float>& plane = planes.emplace_back(map.height, map.width);
  for (int y = 0; y < map.height; ++y) std::copy_n(map.row(y), map.width, plane.row(y));
  return variance_of(planes, progress);
}

double view_noise_variance(const LightField& lf, ViewIndex view, const Progress& progress) {
  Image<float> variance = local_noise_variance(lf, view, progress);
  return quantile({variance.data(), variance.size()}, 0.5);
}

}  // namespace episcope
