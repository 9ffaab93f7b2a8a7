// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/order/parallax_axis.h"

#include "engine/core/array/indices.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope::io {
namespace {

constexpr int kBlock = 12;

/// Blocks side by side that no shift moves out of the picture.
struct Blocks {
  int rows = 0;
  int columns = 0;
  int margin = 0;

  Blocks(const Image<float>& picture, int range)
      : rows(std::max(picture.height() - 2 * range, 0) / kBlock),
        columns(std::max(picture.width() - 2 * range, 0) / kBlock),
        margin(range) {}
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(rows) * columns; }
};

/// What is left of every block, as the root of its mean square, when `other` is moved by whole
/// pixels (dy, dx), of which one is 0, and along the axis by up to a pixel more: to first order,
/// with the gradient of `other`.
std::vector<float> left_over(const Image<float>& one, const Image<float>& other,
                             const Blocks& blocks, PixelIndex shift, bool is_x) {
  struct Sums {
    float squares = 0, products = 0, gradients = 0;
  };
  std::vector<Sums> sums(blocks.count());
  for (int y = 0; y < blocks.rows * kBlock; ++y) {
    const int at = y + blocks.margin + shift.y;
    const float* a = one.row(y + blocks.margin) + blocks.margin;
    const float* b = other.row(at) + blocks.margin + shift.x;
    const float* next = is_x ? b + 1 : other.row(at + 1) + blocks.margin + shift.x;
    const float* last = is_x ? b - 1 : other.row(at - 1) + blocks.margin + shift.x;
    for (int k = 0; k < blocks.columns; ++k) {
      Sums row;
      for (int x = k * kBlock; x < (k + 1) * kBlock; ++x) {
        const float difference = a[x] - b[x];
        const float gradient = 0.5F * (next[x] - last[x]);
        row.squares += difference * difference;
        row.products += difference * gradient;
        row.gradients += gradient * gradient;
      }
      Sums& block = sums[static_cast<std::size_t>(y / kBlock) * blocks.columns + k];
      block.squares += row.squares;
      block.products += row.products;
      block.gradients += row.gradients;
    }
  }
  std::vector<float> left(sums.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    const Sums& block = sums[i];
    const float more =
        block.gradients > 0 ? std::clamp(block.products / block.gradients, -1.0F, 1.0F) : 0.0F;
    const float rest = block.squares - 2 * more * block.products + more * more * block.gradients;
    left[i] = std::sqrt(std::max(rest, 0.0F) / (kBlock * kBlock));
  }
  return left;
}

std::vector<float> unmoved_difference(const Image<float>& one, const Image<float>& other,
                                      const Blocks& blocks) {
  std::vector<float> sums(blocks.count());
  for (int y = 0; y < blocks.rows * kBlock; ++y) {
    for (int x = 0; x < blocks.columns * kBlock; ++x) {
      const float difference = one.at(y + blocks.margin, x + blocks.margin) -
                               other.at(y + blocks.margin, x + blocks.margin);
      sums[static_cast<std::size_t>(y / kBlock) * blocks.columns + x / kBlock] +=
          difference * difference;
    }
  }
  for (float& sum : sums) sum = std::sqrt(sum / (kBlock * kBlock));
  return sums;
}

void keep_smaller(std::vector<float>& best, const std::vector<float>& more) {
  for (std::size_t i = 0; i < best.size(); ++i) best[i] = std::min(best[i], more[i]);
}

void add_pair(const Image<float>& one, const Image<float>& other, int range,
              AxisEvidence::Sums& sums) {
  // The gradient reaches one pixel further.
  const Blocks blocks(one, range + 1);
  const std::vector<float> unmoved = unmoved_difference(one, other, blocks);
  std::vector<float> along_x = unmoved;
  std::vector<float> along_y = unmoved;
  for (int shift = -range; shift <= range; ++shift) {
    keep_smaller(along_x, left_over(one, other, blocks, {0, shift}, true));
    keep_smaller(along_y, left_over(one, other, blocks, {shift, 0}, false));
  }
  for (std::size_t i = 0; i < blocks.count(); ++i) {
    const double difference = along_y[i] - along_x[i];
    sums.blocks += 1;
    sums.unmoved += unmoved[i];
    sums.along_x += along_x[i];
    sums.along_y += along_y[i];
    sums.squares += difference * difference;
  }
}

}  // namespace

double AxisEvidence::Sums::score() const {
  if (blocks < 2 || squares == 0) return 0;
  const double mean = (along_y - along_x) / blocks;
  const double variance = std::max(squares / blocks - mean * mean, 1e-12);
  return mean / std::sqrt(variance / blocks);
}

void AxisEvidence::add(const MotionPictures& one, const MotionPictures& other) {
  add_pair(one.scales[0], other.scales[0], 6, scales_[0]);
  add_pair(one.scales[1], other.scales[1], 12, scales_[1]);
}

const AxisEvidence::Sums& AxisEvidence::clearest() const {
  return std::abs(scales_[0].score()) >= std::abs(scales_[1].score()) ? scales_[0] : scales_[1];
}

double AxisEvidence::gone_along_x() const {
  const Sums& sums = clearest();
  return sums.unmoved > 0 ? 1 - sums.along_x / sums.unmoved : 0;
}

double AxisEvidence::gone_along_y() const {
  const Sums& sums = clearest();
  return sums.unmoved > 0 ? 1 - sums.along_y / sums.unmoved : 0;
}

double AxisEvidence::score() const {
  return clearest().score();
}

bool AxisEvidence::is_x() const {
  return score() > 5 && gone_along_x() > 1.25 * gone_along_y();
}

bool AxisEvidence::is_y() const {
  return score() < -5 && gone_along_y() > 1.25 * gone_along_x();
}

}  // namespace episcope::io
