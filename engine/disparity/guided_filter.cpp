// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/guided_filter.h"

#include "engine/core/isa.h"
#include "engine/core/parallel.h"
#include "engine/disparity/kernels/matching_kernel.h"
#include "engine/disparity/view_samples.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace episcope {
namespace {

constexpr int kInversePlanes = 6;

// Symmetric 3×3: 00, 01, 02, 11, 12, 22.
using Symmetric = std::array<double, 6>;

Symmetric inverted(const Symmetric& m) {
  const double a = m[3] * m[5] - m[4] * m[4];
  const double b = m[2] * m[4] - m[1] * m[5];
  const double c = m[1] * m[4] - m[2] * m[3];
  const double scale = 1 / (m[0] * a + m[1] * b + m[2] * c);
  return {a * scale,
          b * scale,
          c * scale,
          (m[0] * m[5] - m[2] * m[2]) * scale,
          (m[1] * m[2] - m[0] * m[4]) * scale,
          (m[0] * m[3] - m[1] * m[1]) * scale};
}

int padded_width(int width) {
  return width + kGuidedSlack;
}

}  // namespace

GuideImage::GuideImage(const LightField& lf, ViewIndex view, int radius, double regularization,
                       const Progress& progress)
    : radius_(radius),
      height_(lf.height()),
      width_(lf.width()),
      channels_(lf.channels()),
      planes_(channels_ == 3 ? 6 + kInversePlanes : 3),
      pitch_(padded_width(lf.width())) {
  assert(radius >= 1 && radius <= kMaxGuidedRadius);
  memory_.resize(static_cast<std::size_t>(height_) * planes_ * pitch_ + kGuidedSlack);
  read_samples(lf, view);
  parallel_for(height_, progress, [&](int y) { find_statistics(y, regularization); });
}

void GuideImage::read_samples(const LightField& lf, ViewIndex view) {
  SamplePlanes samples(lf);
  for (int y = 0; y < height_; ++y) {
    std::array<float*, 3> rows{};
    for (int c = 0; c < channels_; ++c) rows[c] = row(c, y);
    samples.read(view, y, 0, width_, rows.data());
  }
}

void GuideImage::find_statistics(int y, double regularization) {
  const int y0 = std::max(0, y - radius_);
  const int y1 = std::min(height_, y + radius_ + 1);
  // Sums down the window's columns: samples, then products.
  constexpr int kMaxColumns = 9;
  std::array<std::vector<double>, kMaxColumns> columns;
  const int products = channels_ == 3 ? kInversePlanes : 1;
  for (int i = 0; i < channels_ + products; ++i) columns[i].assign(width_, 0.0);
  for (int j = y0; j < y1; ++j) {
    int product = channels_;
    for (int a = 0; a < channels_; ++a) {
      const float* first = row(a, j);
      for (int x = 0; x < width_; ++x) columns[a][x] += first[x];
      for (int b = a; b < channels_; ++b, ++product) {
        const float* second = row(b, j);
        for (int x = 0; x < width_; ++x) columns[product][x] += first[x] * second[x];
      }
    }
  }
  for (int x = 0; x < width_; ++x) {
    const int x0 = std::max(0, x - radius_);
    const int x1 = std::min(width_, x + radius_ + 1);
    std::array<double, kMaxColumns> mean{};
    for (int i = 0; i < channels_ + products; ++i) {
      for (int j = x0; j < x1; ++j) mean[i] += columns[i][j];
      mean[i] /= (x1 - x0) * (y1 - y0);
    }
    for (int c = 0; c < channels_; ++c) row(channels_ + c, y)[x] = static_cast<float>(mean[c]);
    if (channels_ == 1) {
      const double variance = mean[1] - mean[0] * mean[0] + regularization;
      row(2, y)[x] = static_cast<float>(1 / variance);
      continue;
    }
    Symmetric covariance{};
    int product = 0;
    for (int a = 0; a < channels_; ++a) {
      for (int b = a; b < channels_; ++b, ++product) {
        covariance[product] = mean[channels_ + product] - mean[a] * mean[b];
        if (a == b) covariance[product] += regularization;
      }
    }
    const Symmetric inverse = inverted(covariance);
    for (int i = 0; i < kInversePlanes; ++i) row(6 + i, y)[x] = static_cast<float>(inverse[i]);
  }
}

struct GuidedFilter::State {
  const GuideImage& guide;
  const GuidedKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kGuidedKernel);
  int window = 0;  // Rows of it.
  int pitch = 0;
  std::vector<float> memory;
  float* scratch = nullptr;
  float* share = nullptr;
  std::array<float*, kGuidedPlanes> model{};
  // The last `window` rows of sums of products and of models.
  std::array<std::array<float*, kGuidedPlanes>, 2 * kMaxGuidedRadius + 1> products{}, models{};

  explicit State(const GuideImage& image);
  [[nodiscard]] GuideRow guide_row(int y) const;
  void filter_layer(int y, VolumeView<float> values, int layer);
  using Ring = std::array<std::array<float*, kGuidedPlanes>, 2 * kMaxGuidedRadius + 1>;
  [[nodiscard]] GuidedSums window_about(const Ring& ring, int y, int height) const;
};

GuidedFilter::State::State(const GuideImage& image)
    : guide(image),
      window(2 * image.radius() + 1),
      pitch(padded_width(image.width()) + 2 * image.radius() + kGuidedSlack) {
  const int rows = 2 + kGuidedPlanes + 2 * window * kGuidedPlanes;
  memory.assign(static_cast<std::size_t>(rows) * pitch, 0.0F);
  float* next = memory.data();
  const auto take = [&] { return std::exchange(next, next + pitch); };
  scratch = take();
  share = take();
  for (float*& row : model) row = take();
  for (Ring* ring : {&products, &models}) {
    for (int i = 0; i < window; ++i) {
      for (float*& row : (*ring)[i]) row = take();
    }
  }
  for (int x = 0; x < guide.width(); ++x) {
    const int x0 = std::max(0, x - guide.radius());
    const int x1 = std::min(guide.width(), x + guide.radius() + 1);
    share[x] = 1.0F / static_cast<float>(x1 - x0);
  }
}

GuideRow GuidedFilter::State::guide_row(int y) const {
  GuideRow row;
  row.channels = guide.channels();
  row.width = guide.width();
  row.radius = guide.radius();
  row.share = share;
  for (int c = 0; c < row.channels; ++c) {
    row.guide[c] = guide.row(c, y);
    row.mean[c] = guide.row(row.channels + c, y);
  }
  const int inverses = row.channels == 3 ? kInversePlanes : 1;
  for (int i = 0; i < inverses; ++i) row.inverse[i] = guide.row(2 * row.channels + i, y);
  return row;
}

GuidedSums GuidedFilter::State::window_about(const Ring& ring, int y, int height) const {
  GuidedSums sums;
  const int last = std::min(height - 1, y + guide.radius());
  for (int j = std::max(0, y - guide.radius()); j <= last; ++j) {
    std::copy_n(ring[j % window].begin(), kGuidedPlanes, sums.planes[sums.rows]);
    ++sums.rows;
  }
  return sums;
}

// A row of sums, the model a radius above it and the result another radius above follow each other
// down the band, so that nothing but rows is held.
void GuidedFilter::State::filter_layer(int y, VolumeView<float> values, int layer) {
  const int radius = guide.radius();
  for (int row = 0; row < values.height + 2 * radius; ++row) {
    if (row < values.height) {
      // A copy, because the kernel reads beyond the row.
      std::copy_n(values.row(row, layer), values.width, model[0]);
      kernel.sum_products(guide_row(y + row), model[0], scratch, products[row % window].data());
    }
    const int middle = row - radius;
    if (middle >= 0 && middle < values.height) {
      kernel.solve(guide_row(y + middle), window_about(products, middle, values.height), scratch,
                   model.data(), models[middle % window].data());
    }
    const int done = row - 2 * radius;
    if (done >= 0) {
      kernel.apply(guide_row(y + done), window_about(models, done, values.height),
                   values.row(done, layer));
    }
  }
}

GuidedFilter::GuidedFilter(const GuideImage& guide) : state_(std::make_unique<State>(guide)) {}
GuidedFilter::~GuidedFilter() = default;

void GuidedFilter::apply(int y, VolumeView<float> values, const Progress& progress) {
  for (int layer = 0; layer < values.layers; ++layer) {
    progress.check();
    state_->filter_layer(y, values, layer);
  }
}

}  // namespace episcope
