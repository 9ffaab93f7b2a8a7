// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"

#include <memory>
#include <vector>

namespace episcope {

/// What the guided filter knows of a view: samples, their means and inverse covariances over
/// windows of (2·radius + 1)² pixels. Immutable; 48 bytes per pixel (12 for gray views).
class GuideImage {
 public:
  /// `regularization` is added to the variances, samples in [0, 1]: contrast below its root is
  /// averaged away, contrast above is kept. Precondition: 1 ≤ radius ≤ 8.
  /// Throws Cancelled.
  GuideImage(const LightField& light_field, ViewIndex view, int radius, double regularization,
             const Progress& progress);

  [[nodiscard]] int radius() const { return radius_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int channels() const { return channels_; }
  /// Rows, each with slack behind it: plane 0..c−1 the samples, c..2c−1 their means, then the
  /// inverse covariances (6 of three channels, 1 of one).
  [[nodiscard]] const float* row(int plane, int y) const {
    return memory_.data() + (static_cast<std::size_t>(y) * planes_ + plane) * pitch_;
  }
  [[nodiscard]] int pitch() const { return pitch_; }

 private:
  [[nodiscard]] float* row(int plane, int y) {
    return memory_.data() + (static_cast<std::size_t>(y) * planes_ + plane) * pitch_;
  }
  void read_samples(const LightField& light_field, ViewIndex view);
  void find_statistics(int y, double regularization);

  int radius_ = 0;
  int height_ = 0;
  int width_ = 0;
  int channels_ = 0;
  int planes_ = 0;
  int pitch_ = 0;
  std::vector<float> memory_;
};

/// Filters every layer of a volume by the guided filter (a local affine model of the layer in the
/// colors of the guide): averages over windows, but not across edges of the guide. Not
/// thread-safe: use one object per thread.
///
/// Applied to matching costs it gathers evidence from neighbors on the same surface.
/// Reference: He, Sun, Tang 2013 [HST13]; for costs, Rhemann et al. 2011 [RHBRG11].
class GuidedFilter {
 public:
  explicit GuidedFilter(const GuideImage& guide);
  ~GuidedFilter();

  /// Filters in place `values`, rows [y, y + height) of the guide. Where the band is cut from a
  /// taller image, the 2·radius rows next to the cut are not what they were in the whole.
  /// Throws Cancelled on a stop request (checked for each layer).
  void apply(int y, VolumeView<float> values, const Progress& progress);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace episcope
