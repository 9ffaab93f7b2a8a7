// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/opencv_epi_l.h"

#include "engine/core/parallel.h"
#include "engine/disparity/structure_tensor.h"
#include "tests/bench/bench_scene.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <vector>

namespace episcope::bench {
namespace {

int taps_of(double sigma) {
  return 2 * static_cast<int>(std::ceil(2 * sigma)) + 1;
}

struct Tensor {
  cv::Mat xx, xs, ss;
};

// Rows are views, columns pixels along the EPI.
class OpenCvEpi {
 public:
  OpenCvEpi(const EpiLParameters& parameters, Interval range, int channels)
      : parameters_(parameters),
        search_(cover_range(range,
                            std::max(1, static_cast<int>(std::lround(2 * parameters.shear_step))))),
        range_(range),
        contrast_(channels * parameters.contrast * parameters.contrast / (255.0 * 255.0)),
        noise_(channels * parameters.noise * parameters.noise / (255.0 * 255.0)) {}

  // Estimates disparity() and coherence() of an interleaved 8-bit EPI.
  void run(const cv::Mat& epi) {
    smooth(epi);
    best_coherence_ = cv::Mat::zeros(epi.size(), CV_32F);
    for (cv::Mat* plane : {&best_.xx, &best_.xs, &best_.ss}) {
      *plane = cv::Mat::zeros(epi.size(), CV_32F);
    }
    for (const int half_steps : search_.half_step_shears) {
      add_shear(0.5 * half_steps, epi.rows / 2);
    }
    average_neighbors();
    resolve();
  }

  // Merges a result of the other direction into this one, as merge_orientations.
  void merge(const cv::Mat& disparity, const cv::Mat& coherence) {
    cv::pow(coherence_, parameters_.fusion_power, t0_);
    cv::pow(coherence, parameters_.fusion_power, t1_);
    cv::add(t0_, t1_, t1_);
    cv::add(t1_, 1e-30, t1_);
    cv::divide(t0_, t1_, t0_);
    cv::subtract(disparity_, disparity, t1_);
    cv::multiply(t0_, t1_, t0_);
    cv::add(disparity, t0_, t0_);
    cv::Mat far = cv::abs(t1_) >= 0.3;
    cv::Mat here = coherence_ > coherence;
    disparity_.copyTo(t0_, far & here);
    disparity.copyTo(t0_, far & ~here);
    cv::swap(t0_, disparity_);
    cv::max(coherence_, coherence, coherence_);
  }

  [[nodiscard]] const cv::Mat& disparity() const { return disparity_; }
  [[nodiscard]] const cv::Mat& coherence() const { return coherence_; }

 private:
  void smooth(const cv::Mat& epi) {
    epi.convertTo(samples_, CV_32F, 1.0 / 255);
    const int taps = taps_of(parameters_.inner_scale);
    cv::GaussianBlur(samples_, samples_, {taps, taps}, parameters_.inner_scale,
                     parameters_.inner_scale, cv::BORDER_REPLICATE);
    cv::split(samples_, planes_);
  }

  static void shear(const cv::Mat& from, cv::Mat& to, double k, int center) {
    const cv::Matx23d map(1, -k, k * center, 0, 1, 0);
    cv::warpAffine(from, to, map, from.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                   cv::BORDER_REPLICATE);
  }

  void add_products(const cv::Mat& plane, bool first) {
    static const cv::Mat along = (cv::Mat_<float>(1, 3) << -0.5F, 0, 0.5F);
    static const cv::Mat across = (cv::Mat_<float>(1, 3) << 3.0F / 16, 10.0F / 16, 3.0F / 16);
    static const cv::Mat views = -along;
    cv::sepFilter2D(plane, gx_, CV_32F, along, across, {-1, -1}, 0, cv::BORDER_REPLICATE);
    cv::sepFilter2D(plane, gs_, CV_32F, across, views, {-1, -1}, 0, cv::BORDER_REPLICATE);
    const auto add = [&](const cv::Mat& a, const cv::Mat& b, cv::Mat& sum) {
      if (first) {
        cv::multiply(a, b, sum);
      } else {
        cv::multiply(a, b, t0_);
        cv::add(sum, t0_, sum);
      }
    };
    add(gx_, gx_, tensor_.xx);
    add(gx_, gs_, tensor_.xs);
    add(gs_, gs_, tensor_.ss);
  }

  void add_shear(double k, int center) {
    for (std::size_t c = 0; c < planes_.size(); ++c) {
      shear(planes_[c], sheared_, k, center);
      add_products(sheared_, c == 0);
    }
    cv::add(tensor_.xx, tensor_.ss, t0_);
    cv::add(t0_, contrast_, t0_);
    cv::divide(contrast_, t0_, t0_);
    for (cv::Mat* plane : {&tensor_.xx, &tensor_.xs, &tensor_.ss}) {
      cv::multiply(*plane, t0_, *plane);
      cv::GaussianBlur(*plane, *plane,
                       {taps_of(parameters_.outer_scale), taps_of(parameters_.view_scale)},
                       parameters_.outer_scale, parameters_.view_scale, cv::BORDER_REPLICATE);
    }
    keep_better(k, center);
  }

  void keep_better(double k, int center) {
    for (cv::Mat* plane : {&tensor_.xx, &tensor_.xs, &tensor_.ss}) {
      shear(*plane, t0_, -k, center);
      cv::swap(t0_, *plane);
    }
    cv::subtract(tensor_.xx, tensor_.ss, t0_);
    cv::magnitude(t0_, 2 * tensor_.xs, t1_);
    cv::add(t0_, t1_, t0_);
    cv::divide(tensor_.xs, t0_, t0_, -2);
    cv::add(tensor_.xx, tensor_.ss, t2_);
    cv::add(t2_, noise_, t2_);
    cv::divide(t1_, t2_, t1_);
    cv::Mat better;
    cv::inRange(t0_, -search_.limit, search_.limit, better);
    better &= t1_ > best_coherence_;
    t1_.copyTo(best_coherence_, better);
    // Back to unsheared coordinates.
    cv::scaleAdd(tensor_.xx, -k, tensor_.xs, t0_);
    cv::add(tensor_.xs, t0_, t1_);
    cv::scaleAdd(t1_, -k, tensor_.ss, t1_);
    tensor_.xx.copyTo(best_.xx, better);
    t0_.copyTo(best_.xs, better);
    t1_.copyTo(best_.ss, better);
  }

  void average_neighbors() {
    const cv::Mat weights =
        cv::getGaussianKernel(taps_of(parameters_.cross_scale), parameters_.cross_scale, CV_64F);
    for (cv::Mat* plane : {&best_.xx, &best_.xs, &best_.ss}) {
      t0_ = *plane * weights.at<double>(0);
      for (int i = 1; i < weights.rows; ++i) {
        cv::scaleAdd(*plane, weights.at<double>(i), t0_, t0_);
      }
      cv::swap(t0_, *plane);
    }
  }

  void resolve() {
    cv::add(best_.xx, 1e-20, best_.xx);
    cv::divide(best_.xs, best_.xx, disparity_, -1);
    cv::multiply(disparity_, best_.xs, t0_);
    cv::add(best_.ss, t0_, t0_);
    cv::max(t0_, 0, t0_);
    cv::subtract(best_.xx, t0_, t1_);
    cv::add(best_.xx, t0_, t0_);
    cv::add(t0_, noise_, t0_);
    cv::divide(t1_, t0_, coherence_);
    cv::max(coherence_, 0, coherence_);
    cv::max(disparity_, range_.min, disparity_);
    cv::min(disparity_, range_.max, disparity_);
  }

  const EpiLParameters& parameters_;
  TensorSearch search_;
  Interval range_;
  double contrast_, noise_;
  cv::Mat samples_, sheared_, gx_, gs_, t0_, t1_, t2_, best_coherence_, disparity_, coherence_;
  std::vector<cv::Mat> planes_;
  Tensor tensor_, best_;
};

// What all threads found out together.
struct Tally {
  std::mutex mutex;
  double confident = 0;
  double agreeing = 0;
};

void compare(const cv::Mat& disparity, const cv::Mat& coherence, const cv::Mat& ours,
             Tally& tally) {
  const cv::Mat sure = coherence > 0.97;
  const cv::Mat near_ours = cv::abs(disparity - ours) < 0.05;
  const std::scoped_lock lock(tally.mutex);
  tally.confident += cv::countNonZero(sure);
  tally.agreeing += cv::countNonZero(sure & near_ours);
}

class OpenCvLines {
 public:
  OpenCvLines(const LightField& lf, const EpiLParameters& parameters, const Estimate& ours)
      : lf_(lf), ours_(ours), epi_(parameters, ours.range, lf.channels()) {}

  void horizontal(int v, int y, Tally& tally) {
    cv::Mat samples(lf_.grid().u, lf_.width(), CV_8UC(lf_.channels()));
    cv::Mat result(samples.size(), CV_32F);
    for (int u = 0; u < samples.rows; ++u) {
      sample_view({v, u}).row(y).copyTo(samples.row(u));
      result_view({v, u}).row(y).copyTo(result.row(u));
    }
    epi_.run(samples);
    compare(epi_.disparity(), epi_.coherence(), result, tally);
  }

  void vertical(int u, int x, Tally& tally) {
    cv::Mat samples(lf_.grid().v, lf_.height(), CV_8UC(lf_.channels()));
    cv::Mat result(samples.size(), CV_32F);
    for (int v = 0; v < samples.rows; ++v) {
      cv::transpose(sample_view({v, u}).col(x), samples.row(v));
      cv::transpose(result_view({v, u}).col(x), result.row(v));
    }
    epi_.run(samples);
    epi_.merge(result, cv::Mat::zeros(samples.size(), CV_32F));
    compare(epi_.disparity(), epi_.coherence(), result, tally);
  }

 private:
  [[nodiscard]] cv::Mat sample_view(ViewIndex view) const {
    // OpenCV has no views of constant memory; nothing is written through it.
    auto* data = const_cast<std::uint8_t*>(lf_.view<std::uint8_t>(view).data);
    return {lf_.height(), lf_.width(), CV_8UC(lf_.channels()), data};
  }
  [[nodiscard]] cv::Mat result_view(ViewIndex view) const {
    auto* data = const_cast<float*>(ours_.field.disparity.view(view).data);
    return {lf_.height(), lf_.width(), CV_32F, data};
  }

  const LightField& lf_;
  const Estimate& ours_;
  OpenCvEpi epi_;
};

}  // namespace

OpenCvRun run_opencv_epi_l(const LightField& lf, const EpiLParameters& parameters,
                           const Estimate& ours, int step) {
  cv::setNumThreads(1);
  Tally tally;
  const int rows = (lf.height() + step - 1) / step;
  const int columns = (lf.width() + step - 1) / step;
  const int horizontal = rows * lf.grid().v;
  const int vertical = columns * lf.grid().u;
  const double start = now();
  parallel_for_workers(horizontal + vertical, Progress(), [&] {
    return [&, lines = OpenCvLines(lf, parameters, ours)](int i) mutable {
      if (i < horizontal) return lines.horizontal(i / rows, i % rows * step, tally);
      i -= horizontal;
      lines.vertical(i / columns, i % columns * step, tally);
    };
  });
  OpenCvRun run;
  run.share = static_cast<double>(horizontal + vertical) /
              (lf.height() * lf.grid().v + lf.width() * lf.grid().u);
  run.seconds = (now() - start) / run.share;
  run.agreeing = tally.agreeing / std::max(1.0, tally.confident);
  return run;
}

}  // namespace episcope::bench
