// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/reweight_by_color.h"

#include "engine/core/parallel.h"
#include "engine/labeling/pixel_features.h"
#include "engine/labeling/regularizer.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope {
namespace {

constexpr int kSureCode = 242;  // Of 255.
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
  const RayLabeling smoothed = label_view(input, view, Regularizer::View, parameters, progress);
  const ImageView<const std::int32_t> labels = smoothed.labels.view(view);
  Image<std::int32_t> layers(labels.height, labels.width);
  find_layers(labels, input.probabilities->ids, layers.view());
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
      if (most_[x] > kSureCode || (view.moves() && !view.disparity.is_valid(y, x))) continue;
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

constexpr float kNoise = 0.03F;
constexpr float kBesideOthers = 0.1F;  // What a pixel beside another label counts.
constexpr float kFewest = 2;           // Pixels of a label that is nearby.
constexpr float kFloor = 0.01F;

// Side of a square in views of this size.
int square_of(int height, int width) {
  return std::clamp(std::max(height, width) / 64, 2, 4);
}

int squares_in(int pixels, int square_px) {
  return (pixels + square_px - 1) / square_px;
}

bool is_beside_others(ImageView<const std::int32_t> labels, int y, int x) {
  const int left = std::max(x - 1, 0), right = std::min(x + 1, labels.width - 1);
  const int last = std::min(y + 1, labels.height - 1);
  for (int row = std::max(y - 1, 0); row <= last; ++row) {
    const std::int32_t* const in = labels.row(row);
    for (int column = left; column <= right; ++column) {
      if (in[column] != labels.at(y, x)) return true;
    }
  }
  return false;
}

int square_at(float place, int square_px, int count) {
  const float square = std::floor(place / static_cast<float>(square_px));
  return static_cast<int>(std::clamp(square, 0.0F, static_cast<float>(count - 1)));
}

}  // namespace

void reweight_by_color(const RayLabelingInput& input, ViewIndex reference,
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

void reweight_view_by_color(const LightField& light_field, ViewIndex view,
                            const Image<std::int32_t>& layers, const Progress& progress,
                            ProbabilityMap& probabilities) {
  const LocalColors near(lab_of(light_field, view), layers, probabilities.layers());
  const JudgedView own{light_field.view_as_float(view), {}, {}};
  const VolumeView<std::uint8_t> all = probabilities.view();
  // Rows in blocks, each with room of its own.
  constexpr int kRows = 32;
  parallel_for((all.height + kRows - 1) / kRows, progress, [&](int block) {
    Judge judge(near, all);
    for (int y = block * kRows; y < std::min((block + 1) * kRows, all.height); ++y) {
      judge.judge_row(own, y);
    }
  });
}

LocalColors::Sums& LocalColors::Sums::operator+=(const Sums& other) {
  weight += other.weight;
  for (std::size_t c = 0; c < colors.size(); ++c) colors[c] += other.colors[c];
  squares += other.squares;
  return *this;
}

LocalColors::LocalColors(ImageView<const float> colors, ImageView<const std::int32_t> labels,
                         int label_count)
    : label_count_(label_count),
      square_px_(square_of(labels.height, labels.width)),
      rows_(squares_in(labels.height, square_px_)),
      columns_(squares_in(labels.width, square_px_)) {
  const std::vector<Sums> squares = sums_of(colors, labels);
  near_.reserve(squares.size());
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      std::vector<Sums> around(static_cast<std::size_t>(label_count));
      for (int r = std::max(row - 1, 0); r <= std::min(row + 1, rows_ - 1); ++r) {
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, columns_ - 1); ++c) {
          for (int l = 0; l < label_count; ++l) around[l] += squares[index(r, c) + l];
        }
      }
      for (const Sums& sums : around) near_.push_back(colors_of(sums));
    }
  }
}

std::vector<LocalColors::Sums> LocalColors::sums_of(ImageView<const float> colors,
                                                    ImageView<const std::int32_t> labels) const {
  std::vector<Sums> squares(index(rows_, 0));
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      Sums pixel;
      pixel.weight = is_beside_others(labels, y, x) ? kBesideOthers : 1;
      for (int c = 0; c < 3; ++c) {
        const float value = colors.at(y, x, c);
        pixel.colors[c] = pixel.weight * value;
        pixel.squares += pixel.weight * value * value;
      }
      squares[index(y / square_px_, x / square_px_) + labels.at(y, x)] += pixel;
    }
  }
  return squares;
}

LocalColors::Colors LocalColors::colors_of(const Sums& sums) {
  Colors colors;
  colors.variance = std::numeric_limits<float>::infinity();
  if (sums.weight <= kFewest) return colors;
  float spread = sums.squares / sums.weight;
  for (std::size_t c = 0; c < colors.mean.size(); ++c) {
    colors.mean[c] = sums.colors[c] / sums.weight;
    spread -= colors.mean[c] * colors.mean[c];
  }
  colors.variance = std::max(spread, 0.0F) + kNoise * kNoise;
  return colors;
}

void LocalColors::weigh(std::array<float, 3> color, float y, float x,
                        std::span<float> probabilities) const {
  const Colors* const near =
      near_.data() + index(square_at(y, square_px_, rows_), square_at(x, square_px_, columns_));
  const auto fit = [&](const Colors& of) {
    float distance = of.variance;
    for (std::size_t c = 0; c < color.size(); ++c) {
      distance += (color[c] - of.mean[c]) * (color[c] - of.mean[c]);
    }
    return 1 / distance;
  };
  float most = 0;
  for (int l = 0; l < label_count_; ++l) most = std::max(most, fit(near[l]));
  if (most == 0) return;
  float sum = 0;
  for (int l = 0; l < label_count_; ++l) {
    const bool is_nearby = std::isfinite(near[l].variance);
    const float share = is_nearby ? std::max(fit(near[l]) / most, kLeastShare) : kShareElsewhere;
    probabilities[l] = (probabilities[l] + kFloor) * share;
    sum += probabilities[l];
  }
  for (float& p : probabilities) p /= sum;
}

}  // namespace episcope
