// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/local_colors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope {
namespace {

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
