// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/judge_colors.h"

#include "engine/core/parallel/parallel.h"
#include "engine/labeling/features/lab_colors.h"
#include "engine/labeling/local_colors.h"
#include "engine/labeling/rays/view_smoothing.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace episcope {
namespace {

constexpr int kSure = 242;  // Of 255.
constexpr double kReferenceGap = 5e-3;

Image<float> lab_of(const LightField& light_field, ViewIndex view) {
  Image<float> samples = light_field.view_as_float(view);
  const cv::Mat lab =
      lab_colors({samples.height(), samples.width(), CV_32FC(samples.channels()), samples.data()});
  Image<float> colors(samples.height(), samples.width(), 3);
  std::copy_n(lab.ptr<float>(), colors.size(), colors.data());
  return colors;
}

// The labels of `view` as layers of its probabilities, smoothed within the view.
Image<std::int32_t> layers_of(const RayLabelingInput& input, ViewIndex view,
                              RayLabelingParameters parameters, const Progress& progress) {
  parameters.gap = kReferenceGap;
  const RayLabeling smoothed = smooth_view(input, view, parameters, progress);
  const std::vector<std::int32_t>& ids = input.probabilities->ids;
  const ImageView<const std::int32_t> labels = smoothed.labels.view(view);
  Image<std::int32_t> layers(labels.height, labels.width);
  std::transform(labels.data, labels.data + labels.size(), layers.begin(), [&](std::int32_t id) {
    return static_cast<std::int32_t>(std::ranges::lower_bound(ids, id) - ids.begin());
  });
  return layers;
}

// What is known about a view, and by how many views it is away from the reference.
struct JudgedView {
  Image<float> samples;
  DisparityView disparity;  // Empty = of the reference itself.
  ViewIndex step;

  [[nodiscard]] bool moves() const { return !disparity.disparity.empty(); }
};

class Judge {
 public:
  Judge(const LocalColors& near, VolumeView<std::uint8_t> probabilities)
      : near_(near),
        probabilities_(probabilities),
        most_(static_cast<std::size_t>(probabilities.width)),
        own_(static_cast<std::size_t>(probabilities.layers)) {}

  void judge_row(const JudgedView& view, int y) {
    std::fill(most_.begin(), most_.end(), 0);
    for (int l = 0; l < probabilities_.layers; ++l) {
      const std::uint8_t* const p = probabilities_.row(y, l);
      std::transform(most_.begin(), most_.end(), p, most_.begin(),
                     [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); });
    }
    unsure_.clear();
    samples_.clear();
    const int channels = view.samples.channels();
    for (int x = 0; x < probabilities_.width; ++x) {
      if (most_[x] > kSure || (view.moves() && !view.disparity.is_valid(y, x))) continue;
      unsure_.push_back(x);
      const float* const sample = view.samples.row(y) + static_cast<std::ptrdiff_t>(x) * channels;
      samples_.insert(samples_.end(), sample, sample + channels);
    }
    if (unsure_.empty()) return;
    const cv::Mat lab =
        lab_colors({1, static_cast<int>(unsure_.size()), CV_32FC(channels), samples_.data()});
    const float* color = lab.ptr<float>();
    for (const int x : unsure_) {
      const float disparity = view.moves() ? view.disparity.disparity.at(y, x) : 0;
      judge_pixel({color[0], color[1], color[2]},
                  {static_cast<float>(y) + disparity * static_cast<float>(view.step.v),
                   static_cast<float>(x) + disparity * static_cast<float>(view.step.u)},
                  y, x);
      color += 3;
    }
  }

 private:
  struct Place {
    float y, x;
  };
  void judge_pixel(std::array<float, 3> color, Place place, int y, int x) {
    for (int l = 0; l < probabilities_.layers; ++l) {
      own_[l] = static_cast<float>(probabilities_.at(y, l, x)) / 255;
    }
    near_.weigh(color, place.y, place.x, own_);
    for (int l = 0; l < probabilities_.layers; ++l) {
      probabilities_.at(y, l, x) = static_cast<std::uint8_t>(own_[l] * 255 + 0.5F);
    }
  }

  const LocalColors& near_;
  VolumeView<std::uint8_t> probabilities_;
  // Room for a row.
  std::vector<std::uint8_t> most_;
  std::vector<int> unsure_;
  std::vector<float> samples_, own_;
};

}  // namespace

void judge_colors(const RayLabelingInput& input, ViewIndex reference,
                  const RayLabelingParameters& parameters, const Progress& progress,
                  LabelProbabilities& probabilities) {
  RayLabelingInput known = input;
  known.probabilities = &probabilities;
  const int labels = static_cast<int>(probabilities.ids.size());
  const Image<std::int32_t> layers = layers_of(known, reference, parameters, progress.part(0, 0.5));
  const LocalColors near(lab_of(*input.light_field, reference), layers, labels);
  parallel_for(probabilities.grid.count(), progress.part(0.5, 1), [&](int i) {
    const ViewIndex at = probabilities.view_at(i);
    JudgedView view;
    view.step = {at.v - reference.v, at.u - reference.u};
    if (at != reference) {
      if (input.disparity == nullptr || !input.disparity->contains(at)) return;
      view.disparity = input.disparity->view(at);
    }
    view.samples = input.light_field->view_as_float(at);
    const VolumeView<std::uint8_t> of_view = probabilities.view(at).view();
    Judge judge(near, of_view);
    for (int y = 0; y < of_view.height; ++y) judge.judge_row(view, y);
  });
}

}  // namespace episcope
