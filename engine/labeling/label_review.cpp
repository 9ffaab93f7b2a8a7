// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/label_review.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/labeling/ray_labeling.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace episcope {
namespace {

// Outside the image counts as outside the blob.
PixelIndex deepest_pixel(const Image<std::uint8_t>& mask) {
  cv::Mat padded(mask.height() + 2, mask.width() + 2, CV_8U, cv::Scalar(0));
  for (int y = 0; y < mask.height(); ++y) {
    std::copy_n(mask.row(y), mask.width(), padded.ptr(y + 1) + 1);
  }
  cv::Mat depth;
  cv::distanceTransform(padded, depth, cv::DIST_L2, cv::DIST_MASK_5);
  cv::Point deepest;
  cv::minMaxLoc(depth, nullptr, nullptr, nullptr, &deepest);
  return {deepest.y - 1, deepest.x - 1};
}

Blob blob_of(const cv::Mat& numbers, int number, const int* statistics) {
  const int x0 = statistics[cv::CC_STAT_LEFT];
  const int y0 = statistics[cv::CC_STAT_TOP];
  Blob blob;
  blob.bounds = {y0, x0, y0 + statistics[cv::CC_STAT_HEIGHT], x0 + statistics[cv::CC_STAT_WIDTH]};
  blob.pixels = statistics[cv::CC_STAT_AREA];
  blob.mask = Image<std::uint8_t>(blob.bounds.y1 - y0, blob.bounds.x1 - x0);
  for (int y = 0; y < blob.mask.height(); ++y) {
    const int* row = numbers.ptr<int>(y0 + y) + x0;
    for (int x = 0; x < blob.mask.width(); ++x) blob.mask.at(y, x) = row[x] == number;
  }
  const PixelIndex deepest = deepest_pixel(blob.mask);
  blob.inside = {y0 + deepest.y, x0 + deepest.x};
  return blob;
}

// By row, then column.
PixelIndex first_pixel(const Blob& blob) {
  const std::uint8_t* row = blob.mask.row(0);
  const auto x = std::find(row, row + blob.mask.width(), 1) - row;
  return {blob.bounds.y0, blob.bounds.x0 + static_cast<int>(x)};
}

// By pixel: how doubtful its label is, and which layer of the probabilities speaks against it.
struct Doubts {
  Image<float> doubt;
  Image<std::uint8_t> rival;
};

Doubts doubts_of(VolumeView<const std::uint8_t> probabilities, const std::vector<std::int32_t>& ids,
                 ImageView<const std::int32_t> labels) {
  Doubts found{Image<float>(labels.height, labels.width),
               Image<std::uint8_t>(labels.height, labels.width)};
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      int own = 0;
      int best = 0;
      for (std::size_t layer = 0; layer < ids.size(); ++layer) {
        const int probability = probabilities.row(y, static_cast<int>(layer))[x];
        if (ids[layer] == labels.at(y, x)) {
          own = probability;
        } else if (probability > best) {
          best = probability;
          found.rival.at(y, x) = static_cast<std::uint8_t>(layer);
        }
      }
      found.doubt.at(y, x) = best >= own ? (best > 0 ? 1.0F : 0.0F)
                                         : static_cast<float>(best) / static_cast<float>(own);
    }
  }
  return found;
}

// Doubtful pixels of one label, without what is narrower than `width_px`.
Image<std::uint8_t> doubtful(std::int32_t label, const Doubts& doubts,
                             ImageView<const std::int32_t> labels,
                             ImageView<const std::uint8_t> painted, const DoubtChoice& choice) {
  Image<std::uint8_t> mask(labels.height, labels.width);
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      const bool is_painted = !painted.empty() && painted.at(y, x) != 0;
      mask.at(y, x) = labels.at(y, x) == label && !is_painted &&
                      doubts.doubt.at(y, x) >= static_cast<float>(choice.least_doubt);
    }
  }
  const cv::Mat pixels(mask.height(), mask.width(), CV_8U, mask.data());
  const cv::Size width(choice.least_width_px, choice.least_width_px);
  cv::morphologyEx(pixels, pixels, cv::MORPH_OPEN,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, width));
  return mask;
}

LabelDoubt judged(std::int32_t label, Blob blob, const Doubts& doubts,
                  const std::vector<std::int32_t>& ids) {
  LabelDoubt found{label, 0, 0, std::move(blob)};
  std::map<std::uint8_t, double> votes;
  for (int y = found.blob.bounds.y0; y < found.blob.bounds.y1; ++y) {
    for (int x = found.blob.bounds.x0; x < found.blob.bounds.x1; ++x) {
      if (!found.blob.contains({y, x})) continue;
      votes[doubts.rival.at(y, x)] += doubts.doubt.at(y, x);
      found.gain += doubts.doubt.at(y, x);
    }
  }
  found.rival =
      ids[std::ranges::max_element(votes, {}, [](const auto& each) { return each.second; })->first];
  return found;
}

bool reaches_border(const Blob& blob, ImageView<const std::int32_t> labels) {
  return blob.bounds.y0 == 0 || blob.bounds.x0 == 0 || blob.bounds.y1 == labels.height ||
         blob.bounds.x1 == labels.width;
}

std::int32_t most_frequent(const Blob& blob, ImageView<const std::int32_t> labels) {
  std::map<std::int32_t, int> counts;
  for (int y = 0; y < blob.mask.height(); ++y) {
    for (int x = 0; x < blob.mask.width(); ++x) {
      if (blob.mask.at(y, x) != 0) ++counts[labels.at(blob.bounds.y0 + y, blob.bounds.x0 + x)];
    }
  }
  return std::ranges::max_element(counts, {}, [](const auto& each) { return each.second; })->first;
}

constexpr double kReach = 3;  // of a Gaussian, in standard deviations

std::map<std::int32_t, PixelRect> bounds_of(ImageView<const std::int32_t> labels) {
  std::map<std::int32_t, PixelRect> bounds;
  for (int y = 0; y < labels.height; ++y) {
    const std::int32_t* row = labels.row(y);
    for (int x = 0; x < labels.width;) {
      const int begin = x;
      while (x < labels.width && row[x] == row[begin]) ++x;
      bounds[row[begin]].include({y, begin, y + 1, x});
    }
  }
  return bounds;
}

// Where pixels of the label can have any weight.
PixelRect widened(const PixelRect& rect, int margin, ImageView<const std::int32_t> labels) {
  return {std::max(0, rect.y0 - margin), std::max(0, rect.x0 - margin),
          std::min(labels.height, rect.y1 + margin), std::min(labels.width, rect.x1 + margin)};
}

cv::Mat weights_of(std::int32_t label, const PixelRect& rect, ImageView<const std::int32_t> labels,
                   double smoothing_px) {
  cv::Mat weights(rect.y1 - rect.y0, rect.x1 - rect.x0, CV_32F);
  for (int y = rect.y0; y < rect.y1; ++y) {
    const std::int32_t* row = labels.row(y);
    std::transform(row + rect.x0, row + rect.x1, weights.ptr<float>(y - rect.y0),
                   [label](std::int32_t each) { return each == label ? 1.0F : 0.0F; });
  }
  const int size = 2 * static_cast<int>(std::ceil(kReach * smoothing_px)) + 1;
  cv::GaussianBlur(weights, weights, cv::Size(size, size), smoothing_px, smoothing_px,
                   cv::BORDER_REPLICATE);
  return weights;
}

struct Pair {
  ViewIndex from, to;
};

// Row by row, so that a stop request is seen.
LabelConsistency compare(const ViewStack<std::int32_t>& labels, const DisparityField& disparity,
                         const Pair& pair, const Progress& progress) {
  LabelConsistency found;
  const ViewIndex step{pair.to.v - pair.from.v, pair.to.u - pair.from.u};
  const auto here = labels.view(pair.from), there = labels.view(pair.to);
  const DisparityView from = disparity.view(pair.from), to = disparity.view(pair.to);
  std::vector<std::int32_t> targets(labels.width());
  for (int y = 0; y < labels.height(); ++y) {
    progress.check();
    find_ray_targets(from, to, step, y, targets.data());
    for (int x = 0; x < labels.width(); ++x) {
      if (targets[x] < 0) continue;
      ++found.visible;
      found.agreeing += here.at(y, x) == there.data[targets[x]] ? 1 : 0;
    }
  }
  found.pairs = static_cast<std::int64_t>(labels.view_size());
  return found;
}

}  // namespace

std::vector<Blob> blobs_of(ImageView<const std::uint8_t> mask, Neighbors neighbors,
                           int least_pixels) {
  if (mask.empty()) return {};
  const cv::Mat pixels(mask.height, mask.width, CV_8U, const_cast<std::uint8_t*>(mask.data),
                       static_cast<std::size_t>(mask.row_stride));
  cv::Mat numbers;
  cv::Mat statistics;
  cv::Mat centers;
  const int count = cv::connectedComponentsWithStats(pixels, numbers, statistics, centers,
                                                     neighbors == Neighbors::Sides ? 4 : 8);
  std::vector<Blob> blobs;
  for (int number = 1; number < count; ++number) {  // 0 is what the mask leaves out
    const int* row = statistics.ptr<int>(number);
    if (row[cv::CC_STAT_AREA] >= least_pixels) blobs.push_back(blob_of(numbers, number, row));
  }
  // OpenCV numbers them as its threads find them.
  std::ranges::sort(blobs, {}, [](const Blob& blob) {
    const PixelIndex first = first_pixel(blob);
    return std::pair(first.y, first.x);
  });
  return blobs;
}

std::vector<LabelDoubt> label_doubts(VolumeView<const std::uint8_t> probabilities,
                                     const std::vector<std::int32_t>& ids,
                                     ImageView<const std::int32_t> labels,
                                     ImageView<const std::uint8_t> painted,
                                     const DoubtChoice& choice) {
  const bool fits =
      probabilities.height == labels.height && probabilities.width == labels.width &&
      probabilities.layers == static_cast<int>(ids.size()) &&
      (painted.empty() || (painted.height == labels.height && painted.width == labels.width));
  if (!fits) throw InvalidInput("probabilities, labels and scribbles differ in size");
  const Doubts doubts = doubts_of(probabilities, ids, labels);
  std::vector<LabelDoubt> found;
  for (const std::int32_t id : ids) {
    const Image<std::uint8_t> mask = doubtful(id, doubts, labels, painted, choice);
    for (Blob& blob : blobs_of(mask, Neighbors::Sides)) {
      found.push_back(judged(id, std::move(blob), doubts, ids));
    }
  }
  std::ranges::stable_sort(found, std::ranges::greater(), &LabelDoubt::gain);
  if (found.size() > choice.count) found.resize(choice.count);
  return found;
}

std::vector<LabelPiece> pieces_of(ImageView<const std::int32_t> labels, std::int32_t label) {
  std::vector<LabelPiece> pieces;
  for (Blob& blob : blobs_of(label_mask(labels, label), Neighbors::Sides)) {
    pieces.push_back({PieceKind::Island, label, std::move(blob)});
  }
  if (pieces.empty()) return pieces;
  for (Blob& blob : blobs_of(label_mask(labels, label, {0, 255}), Neighbors::Corners)) {
    if (reaches_border(blob, labels)) continue;
    const std::int32_t inside = most_frequent(blob, labels);
    pieces.push_back({PieceKind::Hole, inside, std::move(blob)});
  }
  const auto is_larger = [](const LabelPiece& a, const LabelPiece& b) {
    return a.blob.pixels > b.blob.pixels;
  };
  std::ranges::stable_sort(pieces, is_larger);
  const auto main = std::ranges::find(pieces, PieceKind::Island, &LabelPiece::kind);
  main->kind = PieceKind::Main;
  std::rotate(pieces.begin(), main, std::next(main));
  return pieces;
}

Image<std::uint8_t> label_mask(ImageView<const std::int32_t> labels, std::int32_t label,
                               MaskValues values) {
  Image<std::uint8_t> mask(labels.height, labels.width);
  for (int y = 0; y < labels.height; ++y) {
    const std::int32_t* row = labels.row(y);
    std::transform(row, row + labels.width, mask.row(y), [=](std::int32_t each) {
      return each == label ? values.of_label : values.of_others;
    });
  }
  return mask;
}

Image<std::int32_t> smooth_boundaries(ImageView<const std::int32_t> labels,
                                      ImageView<const std::uint8_t> painted, double smoothing_px) {
  if (smoothing_px < 0) throw InvalidInput("boundaries cannot be smoothed by less than 0 px");
  if (!painted.empty() && (painted.height != labels.height || painted.width != labels.width)) {
    throw InvalidInput("labels and scribbles differ in size");
  }
  Image<std::int32_t> smooth(labels.height, labels.width);
  for (int y = 0; y < labels.height; ++y) std::copy_n(labels.row(y), labels.width, smooth.row(y));
  if (smoothing_px == 0) return smooth;
  constexpr float kTie = 1e-4F;  // own labels win against rounding
  Image<float> best(labels.height, labels.width);
  const int margin = static_cast<int>(std::ceil(kReach * smoothing_px));
  for (const auto& [label, bounds] : bounds_of(labels)) {
    if (label == 0) continue;
    const PixelRect rect = widened(bounds, margin, labels);
    const cv::Mat weights = weights_of(label, rect, labels, smoothing_px);
    for (int y = rect.y0; y < rect.y1; ++y) {
      const auto* weight = weights.ptr<float>(y - rect.y0);
      for (int x = rect.x0; x < rect.x1; ++x, ++weight) {
        if (labels.at(y, x) == 0 || (!painted.empty() && painted.at(y, x) != 0)) continue;
        const float now = *weight + (labels.at(y, x) == label ? kTie : 0);
        if (now <= best.at(y, x)) continue;
        best.at(y, x) = now;
        smooth.at(y, x) = label;
      }
    }
  }
  return smooth;
}

LabelConsistency label_consistency(const ViewStack<std::int32_t>& labels,
                                   const DisparityField& disparity, const Progress& progress) {
  if (labels.empty() || disparity.empty() || labels.height() != disparity.disparity.height() ||
      labels.width() != disparity.disparity.width()) {
    throw InvalidInput("consistency needs labels and disparities of the same size");
  }
  std::vector<Pair> pairs;
  const GridShape grid = labels.grid();
  const ViewIndex first = labels.first();
  const auto add = [&](ViewIndex from, ViewIndex to) {
    if (from == to || !disparity.contains(from) || !disparity.contains(to)) return;
    pairs.push_back({from, to});
  };
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex from = grid.view_at(i, first);
    for (int u = 0; u < grid.u; ++u) add(from, {from.v, first.u + u});
    for (int v = 0; v < grid.v; ++v) add(from, {first.v + v, from.u});
  }
  std::vector<LabelConsistency> parts(pairs.size());
  parallel_for(static_cast<int>(pairs.size()), progress,
               [&](int i) { parts[i] = compare(labels, disparity, pairs[i], progress); });
  LabelConsistency sum;
  for (const auto& part : parts) {
    sum.agreeing += part.agreeing;
    sum.visible += part.visible;
    sum.pairs += part.pairs;
  }
  return sum;
}

}  // namespace episcope
