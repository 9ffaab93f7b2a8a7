// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/thin_gaps.h"

#include "engine/core/parallel/parallel.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <vector>

namespace episcope {
namespace {

constexpr int kReach_px = 9;
constexpr int kThin_px = 7;
constexpr int kFewestPixels = 60;
constexpr double kThinShare = 0.5;
constexpr double kMostThin = 0.7;
constexpr float kAgreement = 1;  // Most by which the misfit of a label may exceed the least one.

// What forest and disparity say of each pixel: labels.
struct Opinions {
  Opinions(int height, int width)
      : voted(height, width, CV_32S), fitting(height, width, CV_32S), agree(height, width, CV_8U) {}
  cv::Mat voted, fitting;
  cv::Mat agree;  // 255 where the voted label fits about as well as the fitting one.
};

Opinions opinions_of(const PixelVotes& votes, const LabelSurfaces& surfaces,
                     const Progress& progress) {
  const int labels = votes.label_count();
  Opinions opinions(votes.height(), votes.width());
  parallel_for(votes.height(), progress, [&](int y) {
    const float *p = votes.row(y), *m = surfaces.misfits(y);
    for (int x = 0; x < votes.width(); ++x, p += votes.pitch(), m += surfaces.pitch()) {
      const auto voted = std::max_element(p, p + labels) - p;
      const auto fitting = std::min_element(m, m + labels) - m;
      opinions.voted.at<std::int32_t>(y, x) = static_cast<std::int32_t>(voted);
      opinions.fitting.at<std::int32_t>(y, x) = static_cast<std::int32_t>(fitting);
      opinions.agree.at<std::uint8_t>(y, x) = m[voted] - m[fitting] < kAgreement ? 255 : 0;
    }
  });
  return opinions;
}

// What of a label lies in no square of it, as masks of 255.
struct ThinParts {
  cv::Mat pixels;  // For which the forest votes.
  cv::Mat thin;
  double share = 0;     // Of its pixels that are thin,
  double agreeing = 0;  // and of those whose disparity agrees.
};

double share_of(const cv::Mat& part, const cv::Mat& whole) {
  return static_cast<double>(cv::countNonZero(part)) / std::max(cv::countNonZero(whole), 1);
}

ThinParts thin_parts_of(const Opinions& opinions, int label) {
  const cv::Mat square = cv::getStructuringElement(cv::MORPH_RECT, {kThin_px, kThin_px});
  ThinParts parts;
  parts.pixels = opinions.voted == label;
  cv::Mat wide;
  cv::morphologyEx(parts.pixels, wide, cv::MORPH_OPEN, square, {-1, -1}, 1, cv::BORDER_REPLICATE);
  parts.thin = parts.pixels & ~wide;
  parts.share = share_of(parts.thin, parts.pixels);
  parts.thin &= opinions.agree;
  parts.agreeing = share_of(parts.thin, parts.pixels & opinions.agree);
  return parts;
}

// What lies within kReach_px of connected thin pixels, if they are many.
cv::Mat reach_of(const cv::Mat& thin) {
  cv::Mat parts, statistics, middles;
  cv::connectedComponentsWithStats(thin, parts, statistics, middles, 8);
  cv::Mat large(thin.size(), CV_8U);
  for (int y = 0; y < thin.rows; ++y) {
    const auto* part = parts.ptr<std::int32_t>(y);
    std::transform(part, part + thin.cols, large.ptr(y), [&](std::int32_t id) {
      const bool is_large =
          id > 0 && statistics.at<std::int32_t>(id, cv::CC_STAT_AREA) >= kFewestPixels;
      return static_cast<std::uint8_t>(is_large ? 255 : 0);
    });
  }
  cv::Mat reach = cv::Mat::zeros(thin.size(), CV_8U);
  // Most labels have none, and few are everywhere: a disc is no product of lines, and slow.
  const cv::Rect box = cv::boundingRect(large);
  if (box.empty()) return reach;
  const cv::Rect around = cv::Rect(box.x - kReach_px, box.y - kReach_px, box.width + 2 * kReach_px,
                                   box.height + 2 * kReach_px) &
                          cv::Rect({0, 0}, thin.size());
  const cv::Mat disc =
      cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * kReach_px + 1, 2 * kReach_px + 1});
  cv::dilate(large(around), reach(around), disc);
  return reach;
}

}  // namespace

Image<std::int32_t> labels_in_thin_gaps(const PixelVotes& votes, const LabelSurfaces& surfaces,
                                        const Progress& progress) {
  const Opinions opinions = opinions_of(votes, surfaces, progress);
  std::vector<ThinParts> parts;
  for (int l = 0; l < votes.label_count(); ++l) parts.push_back(thin_parts_of(opinions, l));
  Image<std::int32_t> gaps(votes.height(), votes.width());
  for (int l = 0; l < votes.label_count(); ++l) {
    progress.check();
    const ThinParts& thing = parts[static_cast<std::size_t>(l)];
    if (thing.agreeing < kThinShare) continue;
    const cv::Mat candidates = reach_of(thing.thin) & (opinions.fitting == l) & ~thing.pixels;
    for (int y = 0; y < gaps.height(); ++y) {
      for (int x = 0; x < gaps.width(); ++x) {
        if (candidates.at<std::uint8_t>(y, x) == 0) continue;
        const std::int32_t voted = opinions.voted.at<std::int32_t>(y, x);
        const bool goes_on = parts[static_cast<std::size_t>(voted)].share <= kMostThin;
        if (goes_on && surfaces.lies_behind(voted, y, x)) gaps.at(y, x) = voted + 1;
      }
    }
  }
  return gaps;
}

}  // namespace episcope
