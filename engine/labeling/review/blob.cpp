// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/review/blob.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
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

}  // namespace

std::vector<Blob> blobs_of(ImageView<const std::uint8_t> mask, Neighbours neighbours,
                           int least_pixels) {
  if (mask.empty()) return {};
  const cv::Mat pixels(mask.height, mask.width, CV_8U, const_cast<std::uint8_t*>(mask.data),
                       static_cast<std::size_t>(mask.row_stride));
  cv::Mat numbers;
  cv::Mat statistics;
  cv::Mat centres;
  const int count = cv::connectedComponentsWithStats(pixels, numbers, statistics, centres,
                                                     neighbours == Neighbours::Sides ? 4 : 8);
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

}  // namespace episcope
