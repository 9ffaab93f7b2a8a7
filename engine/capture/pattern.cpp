// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/pattern.h"

#include "engine/core/error.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#ifdef EPISCOPE_WITH_ARUCO
#include <opencv2/aruco/charuco.hpp>
#endif

#include <algorithm>

namespace episcope::capture {
namespace {

cv::Mat matrix_of(ImageView<const std::uint8_t> gray) {
  return {gray.height, gray.width, CV_8U, const_cast<std::uint8_t*>(gray.data),
          static_cast<std::size_t>(gray.row_stride)};
}

bool find_chessboard(const cv::Mat& gray, const cv::Size& size, std::vector<cv::Point2f>& corners) {
  constexpr int flags =
      cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK;
  if (!cv::findChessboardCorners(gray, size, corners, flags)) return false;
  // Half the distance of neighbors, so that no window reaches another corner.
  const double distance = cv::norm(corners[1] - corners[0]);
  const int reach = std::clamp(static_cast<int>(distance / 2.5), 2, 11);
  cv::cornerSubPix(gray, corners, {reach, reach}, {-1, -1},
                   {cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 60, 1e-4});
  return true;
}

bool find_circles(const cv::Mat& gray, const cv::Size& size, std::vector<cv::Point2f>& centers) {
  constexpr int flags = cv::CALIB_CB_SYMMETRIC_GRID;
  return cv::findCirclesGrid(gray, size, centers, flags) ||
         cv::findCirclesGrid(gray, size, centers, flags | cv::CALIB_CB_CLUSTERING);
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
      .integer("rows", &Pattern::rows, {"Rows", "Inner corners, or circles, in a column"}, {2, 100})
      .real(
          "square", &Pattern::square,
          {"Distance", "Between neighboring points, in any unit; the camera does not depend on it"},
          {1e-3, 1e4, true});
}

FoundPattern find_pattern(ImageView<const std::uint8_t> gray, const Pattern& pattern) {
  if (pattern.kind == PatternKind::Charuco) return find_charuco(gray, pattern);
  const cv::Size size(pattern.columns, pattern.rows);
  const cv::Mat picture = matrix_of(gray);
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

#ifdef EPISCOPE_WITH_ARUCO

namespace {

constexpr cv::aruco::PREDEFINED_DICTIONARY_NAME kDictionaries[] = {
    cv::aruco::DICT_4X4_50,   cv::aruco::DICT_4X4_250,  cv::aruco::DICT_4X4_1000,
    cv::aruco::DICT_5X5_250,  cv::aruco::DICT_5X5_1000, cv::aruco::DICT_6X6_250,
    cv::aruco::DICT_6X6_1000, cv::aruco::DICT_7X7_250};
constexpr int kLeastMarkers = 4;

cv::Ptr<cv::aruco::CharucoBoard> board_of(const Pattern& pattern, int dictionary) {
  return cv::aruco::CharucoBoard::create(pattern.columns + 1, pattern.rows + 1,
                                         static_cast<float>(pattern.square),
                                         static_cast<float>(pattern.square * kMarkerShare),
                                         cv::aruco::getPredefinedDictionary(dictionary));
}

struct Markers {
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
};

Markers markers_of(const cv::Mat& picture, const cv::aruco::CharucoBoard& board) {
  Markers markers;
  auto parameters = cv::aruco::DetectorParameters::create();
  parameters->cornerRefinementMethod = cv::aruco::CORNER_REFINE_NONE;  // corners of squares follow
  cv::aruco::detectMarkers(picture, board.dictionary, markers.corners, markers.ids, parameters);
  return markers;
}

}  // namespace

FoundPattern find_charuco(ImageView<const std::uint8_t> gray, const Pattern& pattern) {
  const cv::Mat picture = matrix_of(gray);
  const int markers_of_board = (pattern.columns + 1) * (pattern.rows + 1) / 2;
  Markers best;
  cv::Ptr<cv::aruco::CharucoBoard> board;
  for (const int dictionary : kDictionaries) {
    if (cv::aruco::getPredefinedDictionary(dictionary)->bytesList.rows < markers_of_board) continue;
    const auto tried = board_of(pattern, dictionary);
    Markers markers = markers_of(picture, *tried);
    std::erase_if(markers.ids, [&](int id) { return id >= markers_of_board; });
    if (markers.ids.size() != markers.corners.size()) continue;  // markers of another board
    if (markers.ids.size() <= best.ids.size()) continue;
    best = std::move(markers);
    board = tried;
  }
  FoundPattern found;
  if (static_cast<int>(best.ids.size()) < kLeastMarkers) {
    found.problem = "no ChArUco board of this size was found";
    return found;
  }
  std::vector<cv::Point2f> corners;
  std::vector<int> ids;
  cv::aruco::interpolateCornersCharuco(best.corners, best.ids, picture, board, corners, ids);
  if (static_cast<int>(ids.size()) * 4 < pattern.columns * pattern.rows) {
    found.problem = "only " + std::to_string(ids.size()) + " of " +
                    std::to_string(pattern.columns * pattern.rows) + " corners were found";
    return found;
  }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const cv::Point3f& point = board->chessboardCorners[ids[i]];
    found.pixels.push_back({corners[i].x, corners[i].y});
    found.points.push_back({point.x, point.y});
  }
  return found;
}

Image<std::uint8_t> draw_charuco(const Pattern& pattern, int pixels_per_square) {
  const int margin = pixels_per_square / 2;
  const cv::Size size((pattern.columns + 1) * pixels_per_square + 2 * margin,
                      (pattern.rows + 1) * pixels_per_square + 2 * margin);
  cv::Mat picture;
  board_of(pattern, kDictionaries[0])->draw(size, picture, margin, 1);
  Image<std::uint8_t> image(picture.rows, picture.cols);
  for (int y = 0; y < picture.rows; ++y) {
    std::copy_n(picture.ptr<std::uint8_t>(y), picture.cols, image.row(y));
  }
  return image;
}

#else

namespace {

constexpr const char* kAdvice =
    "ChArUco boards need OpenCV's ArUco module, which this build lacks; install "
    "libopencv-contrib-dev and build again, or use a chessboard";

}  // namespace

FoundPattern find_charuco(ImageView<const std::uint8_t>, const Pattern&) {
  throw Unavailable(kAdvice);
}

Image<std::uint8_t> draw_charuco(const Pattern&, int) {
  throw Unavailable(kAdvice);
}

#endif

}  // namespace episcope::capture
