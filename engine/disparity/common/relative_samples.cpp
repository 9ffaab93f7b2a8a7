// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/relative_samples.h"

#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace episcope {
namespace {

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

}  // namespace

LightField relative_samples(const LightField& lf, int radius, const Progress& progress) {
  ViewStack<std::uint16_t> samples(lf.grid(), lf.height(), lf.width(), lf.channels());
  parallel_for(lf.grid().count(), progress, [&](int i) {
    const ViewIndex view = lf.grid().view_at(i);
    make_relative(lf, view, radius, samples.view(view));
  });
  return {std::move(samples), lf.info(), lf.valid().clone()};
}

}  // namespace episcope
