// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/review/label_doubts.h"

#include "engine/core/error.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace episcope {
namespace {

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

}  // namespace

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
    for (Blob& blob : blobs_of(mask, Neighbours::Sides)) {
      found.push_back(judged(id, std::move(blob), doubts, ids));
    }
  }
  std::ranges::stable_sort(found, std::ranges::greater(), &LabelDoubt::gain);
  if (found.size() > choice.count) found.resize(choice.count);
  return found;
}

}  // namespace episcope
