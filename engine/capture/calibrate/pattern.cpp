// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/calibrate/pattern.h"

#include "engine/capture/calibrate/find_charuco.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace episcope::capture {
namespace {

cv::Mat matrix_of(ImageView<const std::uint8_t> grey) {
  return {grey.height, grey.width, CV_8U, const_cast<std::uint8_t*>(grey.data),
          static_cast<std::size_t>(grey.row_stride)};
}

bool find_chessboard(const cv::Mat& grey, const cv::Size& size, std::vector<cv::Point2f>& corners) {
  constexpr int flags =
      cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK;
  if (!cv::findChessboardCorners(grey, size, corners, flags)) return false;
  // Half the distance of neighbours, so that no window reaches another corner.
  const double distance = cv::norm(corners[1] - corners[0]);
  const int reach = std::clamp(static_cast<int>(distance / 2.5), 2, 11);
  cv::cornerSubPix(grey, corners, {reach, reach}, {-1, -1},
                   {cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 60, 1e-4});
  return true;
}

bool find_circles(const cv::Mat& grey, const cv::Size& size, std::vector<cv::Point2f>& centers) {
  constexpr int flags = cv::CALIB_CB_SYMMETRIC_GRID;
  return cv::findCirclesGrid(grey, size, centers, flags) ||
         cv::findCirclesGrid(grey, size, centers, flags | cv::CALIB_CB_CLUSTERING);
}

}  // namespace

Names<PatternKind> names_of(PatternKind) {
  return {{PatternKind::Chessboard, "chessboard"},
          {PatternKind::Charuco, "charuco"},
          {PatternKind::Circles, "circles"}};
}

Schema<Pattern> pattern_schema() {
  return Schema<Pattern>()
      .choice("kind", &Pattern::kind, {"Kind", "What the photographs show"})
      .integer("columns", &Pattern::columns,
               {"Columns", "Inner corners of a chessboard or ChArUco board, or circles, in a row"},
               {2, 100})
      .integer("rows", &Pattern::rows, {"Rows", "The same in a column"}, {2, 100})
      .real("square", &Pattern::square,
            {"Distance", "Of neighbouring points, in any unit; the camera does not depend on it"},
            {1e-3, 1e4, true});
}

FoundPattern find_pattern(ImageView<const std::uint8_t> grey, const Pattern& pattern) {
  if (pattern.kind == PatternKind::Charuco) return find_charuco(grey, pattern);
  const cv::Size size(pattern.columns, pattern.rows);
  const cv::Mat picture = matrix_of(grey);
  std::vector<cv::Point2f> pixels;
  const bool is_found = pattern.kind == PatternKind::Circles
                            ? find_circles(picture, size, pixels)
                            : find_chessboard(picture, size, pixels);
  FoundPattern found;
  if (!is_found) {
    found.problem = "the pattern was not found; it may be cut off, blurred or of another size";
    return found;
  }
  for (int y = 0; y < pattern.rows; ++y) {
    for (int x = 0; x < pattern.columns; ++x) {
      const cv::Point2f& pixel = pixels[static_cast<std::size_t>(y) * pattern.columns + x];
      found.pixels.push_back({pixel.x, pixel.y});
      found.points.push_back({x * pattern.square, y * pattern.square});
    }
  }
  return found;
}

}  // namespace episcope::capture
