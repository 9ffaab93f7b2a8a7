// SPDX-License-Identifier: BSD-3-Clause
#include "tests/accuracy/strokes.h"

#include "engine/core/error.h"
#include "engine/scenes/recipes.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <map>
#include <queue>
#include <tuple>
#include <vector>

namespace episcope::accuracy {
namespace {

constexpr int kDots = 6;
constexpr int kLongestCorrection_px = 40;
constexpr int kBrushRadius_px = 4;

int brush_radius(ImageView<const std::int32_t> labels) {
  return std::max(1, std::max(labels.height, labels.width) / 170);
}

int dot_radius(ImageView<const std::int32_t> labels) {
  return std::max(2, std::max(labels.height, labels.width) / 100);
}

// Distance of each pixel of `region` from its outline, and 0 elsewhere.
cv::Mat depth_inside(const cv::Mat& region) {
  cv::Mat framed;
  cv::copyMakeBorder(region, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::Mat depth;
  cv::distanceTransform(framed, depth, cv::DIST_L2, 5);
  return depth(cv::Rect(1, 1, region.cols, region.rows)).clone();
}

// Cheapest ways from `start` to all of its part of the region; ways through its middle are cheap.
struct Ways {
  cv::Mat cost, from;
  cv::Point farthest;
};
Ways find_ways(const cv::Mat& depth, cv::Point start) {
  double deepest = 0;
  cv::minMaxLoc(depth, nullptr, &deepest);
  Ways ways{cv::Mat(depth.size(), CV_32F, 1e9F), cv::Mat(depth.size(), CV_32S, -1), start};
  using Item = std::tuple<float, int, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  queue.emplace(0.F, start.y, start.x);
  ways.cost.at<float>(start) = 0;
  while (!queue.empty()) {
    const auto [cost, y, x] = queue.top();
    queue.pop();
    if (cost > ways.cost.at<float>(y, x)) continue;
    ways.farthest = {x, y};
    for (const cv::Point step : {cv::Point{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const cv::Point to{x + step.x, y + step.y};
      if (to.x < 0 || to.y < 0 || to.x >= depth.cols || to.y >= depth.rows) continue;
      const float inside = depth.at<float>(to);
      if (inside <= 0) continue;
      const float share = static_cast<float>(deepest) / inside;
      const float next = cost + 1 + share * share;
      if (next >= ways.cost.at<float>(to)) continue;
      ways.cost.at<float>(to) = next;
      ways.from.at<int>(to) = y * depth.cols + x;
      queue.emplace(next, to.y, to.x);
    }
  }
  return ways;
}

std::vector<cv::Point> way_to(const Ways& ways, cv::Point to) {
  std::vector<cv::Point> way{to};
  for (int from = ways.from.at<int>(to); from >= 0; from = ways.from.at<int>(way.back())) {
    way.emplace_back(from % ways.from.cols, from / ways.from.cols);
  }
  return way;
}

// The longest way through the middle of the region around its deepest pixel.
std::vector<cv::Point> middle_line(const cv::Mat& depth) {
  cv::Point deepest;
  cv::minMaxLoc(depth, nullptr, nullptr, nullptr, &deepest);
  const cv::Point end = find_ways(depth, deepest).farthest;
  const Ways ways = find_ways(depth, end);
  return way_to(ways, ways.farthest);
}

void paint_dot(cv::Point at, int radius, ImageView<const std::int32_t> truth,
               ImageView<std::int32_t> strokes) {
  const std::int32_t label = truth.at(at.y, at.x);
  for (int y = std::max(at.y - radius, 0); y <= std::min(at.y + radius, truth.height - 1); ++y) {
    for (int x = std::max(at.x - radius, 0); x <= std::min(at.x + radius, truth.width - 1); ++x) {
      const int dx = x - at.x, dy = y - at.y;
      if (dx * dx + dy * dy <= radius * radius && truth.at(y, x) == label) {
        strokes.at(y, x) = label;
      }
    }
  }
}

cv::Mat mask_of(ImageView<const std::int32_t> labels, std::int32_t label) {
  cv::Mat mask(labels.height, labels.width, CV_8U);
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      mask.at<std::uint8_t>(y, x) = labels.at(y, x) == label ? 255 : 0;
    }
  }
  return mask;
}

void paint_line(const cv::Mat& depth, ImageView<const std::int32_t> truth,
                ImageView<std::int32_t> strokes) {
  const std::vector<cv::Point> line = middle_line(depth);
  const std::size_t skip = line.size() / 8;
  for (std::size_t i = skip; i < line.size() - skip; ++i) {
    paint_dot(line[i], brush_radius(truth), truth, strokes);
  }
}

void paint_dots(cv::Mat depth, ImageView<const std::int32_t> truth,
                ImageView<std::int32_t> strokes) {
  double first = 0;
  for (int i = 0; i < kDots; ++i) {
    double deepest = 0;
    cv::Point at;
    cv::minMaxLoc(depth, nullptr, &deepest, nullptr, &at);
    if (i == 0) first = deepest;
    if (deepest < std::max(first / 4, 0.5)) return;
    paint_dot(at, dot_radius(truth), truth, strokes);
    // The next one elsewhere.
    cv::circle(depth, at, static_cast<int>(2 * deepest + 8), cv::Scalar(0), cv::FILLED);
  }
}

}  // namespace

StrokeStyle stroke_style(const std::string& name) {
  const std::map<std::string, StrokeStyle> styles = {{"cross", StrokeStyle::Cross},
                                                     {"line", StrokeStyle::Line},
                                                     {"dots", StrokeStyle::Dots},
                                                     {"stored", StrokeStyle::Stored}};
  const auto found = styles.find(name);
  if (found == styles.end()) {
    throw InvalidInput("strokes are cross, line, dots or stored, not '" + name + "'");
  }
  return found->second;
}

Image<std::int32_t> simulated_strokes(ImageView<const std::int32_t> labels, StrokeStyle style) {
  std::map<std::int32_t, int> sizes;
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) ++sizes[labels.at(y, x)];
  }
  Image<std::int32_t> strokes(labels.height, labels.width);
  if (style == StrokeStyle::Cross) strokes = scenes::scribble(labels);
  for (const auto& [label, size] : sizes) {
    if (label <= 0 || size < kFewestPixels) {
      std::replace(strokes.begin(), strokes.end(), label, 0);
    } else if (style == StrokeStyle::Line) {
      paint_line(depth_inside(mask_of(labels, label)), labels, strokes.view());
    } else if (style == StrokeStyle::Dots) {
      paint_dots(depth_inside(mask_of(labels, label)), labels, strokes.view());
    }
  }
  return strokes;
}

namespace {

// The largest connected region of wrong pixels that truly have one label; empty if there is none.
cv::Mat largest_wrong_region(ImageView<const std::int32_t> labels,
                             ImageView<const std::int32_t> truth) {
  // Wrong pixels of each true label are regions of their own.
  std::map<std::int32_t, cv::Mat> wrong;
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const std::int32_t label = truth.at(y, x);
      if (label <= 0 || labels.at(y, x) == label) continue;
      cv::Mat& mask = wrong[label];
      if (mask.empty()) mask = cv::Mat::zeros(truth.height, truth.width, CV_8U);
      mask.at<std::uint8_t>(y, x) = 255;
    }
  }
  int largest = 0;
  cv::Mat region;
  for (const auto& entry : wrong) {
    cv::Mat parts, sizes, middles;
    const int count = cv::connectedComponentsWithStats(entry.second, parts, sizes, middles, 4);
    for (int part = 1; part < count; ++part) {
      const int size = sizes.at<int>(part, cv::CC_STAT_AREA);
      if (size <= largest) continue;
      largest = size;
      region = parts == part;
    }
  }
  return region;
}

cv::Point middle_of(const cv::Mat& depth) {
  cv::Point middle;
  cv::minMaxLoc(depth, nullptr, nullptr, nullptr, &middle);
  return middle;
}

}  // namespace

std::optional<PixelIndex> middle_of_wrong(ImageView<const std::int32_t> labels,
                                          ImageView<const std::int32_t> truth) {
  const cv::Mat region = largest_wrong_region(labels, truth);
  if (region.empty()) return std::nullopt;
  const cv::Point middle = middle_of(depth_inside(region));
  return PixelIndex{middle.y, middle.x};
}

bool add_correction(ImageView<const std::int32_t> labels, ImageView<const std::int32_t> truth,
                    ImageView<std::int32_t> strokes) {
  const cv::Mat region = largest_wrong_region(labels, truth);
  if (region.empty()) return false;
  const cv::Mat depth = depth_inside(region);
  const cv::Point middle = middle_of(depth);
  const Ways ways = find_ways(depth, middle);
  const std::vector<cv::Point> way = way_to(ways, ways.farthest);
  const std::size_t length = std::min(way.size(), static_cast<std::size_t>(kLongestCorrection_px));
  for (std::size_t i = 0; i < length; ++i) {
    paint_dot(way[way.size() - 1 - i], kBrushRadius_px, truth, strokes);
  }
  return true;
}

}  // namespace episcope::accuracy
