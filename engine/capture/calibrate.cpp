// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/calibrate.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/io/base/image_header.h"
#include "engine/io/base/quiet_decoding.h"

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

#ifdef EPISCOPE_WITH_ARUCO
#include <opencv2/aruco/charuco.hpp>
#endif

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
               {3, 100})
      .integer("rows", &Pattern::rows, {"Rows", "Inner corners, or circles, in a column"}, {3, 100})
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

namespace {

constexpr std::size_t kLeastPhotographs = 3;
constexpr double kBlurred = 0.5;  // of the median sharpness
constexpr double kMisfit = 3;     // median errors
constexpr double kGoodFit = 0.3;  // px; better photographs are never left out
constexpr int kSharpnessReach = 5;

template <class Value>
double median_of_used(const std::vector<PatternPhotograph>& photographs, const Value& value) {
  std::vector<double> values;
  for (const PatternPhotograph& each : photographs) {
    if (each.is_used()) values.push_back(value(each));
  }
  return median(std::move(values));
}

std::size_t count_used(const std::vector<PatternPhotograph>& photographs) {
  return static_cast<std::size_t>(std::ranges::count_if(photographs, &PatternPhotograph::is_used));
}

void require_enough(const std::vector<PatternPhotograph>& photographs) {
  const std::size_t used = count_used(photographs);
  if (used >= kLeastPhotographs) return;
  std::string problems;
  for (const PatternPhotograph& each : photographs) {
    if (!each.is_used()) problems += fmt::format("; {}: {}", each.name, each.problem);
  }
  throw InvalidInput(
      fmt::format("a calibration needs at least {} photographs that show the whole "
                  "pattern sharply, and there are {}{}",
                  kLeastPhotographs, used, problems));
}

void leave_out_blurred(std::vector<PatternPhotograph>& photographs) {
  const double usual = median_of_used(photographs, [](const auto& each) { return each.sharpness; });
  for (PatternPhotograph& each : photographs) {
    if (!each.is_used() || each.sharpness >= kBlurred * usual) continue;
    each.problem = fmt::format("blurred: its edges are {:.1f} times as wide as usual",
                               usual / std::max(each.sharpness, 1e-3));
  }
}

/// One calibration with those used; sets their errors.
LensCamera solve(std::vector<PatternPhotograph>& photographs, int height, int width) {
  std::vector<std::vector<cv::Point3f>> points;
  std::vector<std::vector<cv::Point2f>> pixels;
  for (const PatternPhotograph& each : photographs) {
    if (!each.is_used()) continue;
    points.emplace_back();
    pixels.emplace_back();
    for (const auto& [x, y] : each.found.points) {
      points.back().emplace_back(static_cast<float>(x), static_cast<float>(y), 0.0F);
    }
    for (const auto& [x, y] : each.found.pixels) {
      pixels.back().emplace_back(static_cast<float>(x), static_cast<float>(y));
    }
  }
  cv::Mat matrix;
  cv::Mat distortion;
  cv::Mat rotations;
  cv::Mat translations;
  cv::Mat errors;
  LensCamera camera;
  camera.rms = cv::calibrateCamera(points, pixels, {width, height}, matrix, distortion, rotations,
                                   translations, cv::noArray(), cv::noArray(), errors);
  camera.width = width;
  camera.height = height;
  camera.focal_x = matrix.at<double>(0, 0);
  camera.focal_y = matrix.at<double>(1, 1);
  camera.center_x = matrix.at<double>(0, 2);
  camera.center_y = matrix.at<double>(1, 2);
  std::copy_n(distortion.ptr<double>(), camera.distortion.size(), camera.distortion.begin());
  const double* error = errors.ptr<double>();
  for (PatternPhotograph& each : photographs) {
    if (each.is_used()) each.rms = *error++;
  }
  return camera;
}

/// Leaves out the photograph that fits worst, if it does not fit; one at a time, because it spoils
/// the others.
bool leave_out_misfit(std::vector<PatternPhotograph>& photographs) {
  const double usual = median_of_used(photographs, [](const auto& each) { return each.rms; });
  PatternPhotograph* worst = nullptr;
  for (PatternPhotograph& each : photographs) {
    if (each.is_used() && (worst == nullptr || each.rms > worst->rms)) worst = &each;
  }
  if (worst->rms <= std::max(kGoodFit, kMisfit * usual)) return false;
  worst->problem =
      fmt::format("does not fit: error {:.2f} px, of the others {:.2f} px", worst->rms, usual);
  return true;
}

cv::Mat read_gray(const std::filesystem::path& file) {
  const io::QuietDecoding quiet;
  cv::Mat gray;
  io::require_plausible_picture(file);
  try {
    gray = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  } catch (const cv::Exception&) {
    // Empty, below.
  }
  if (gray.empty()) throw IoError(file, "this is no picture that can be read; leave it out");
  return gray;
}

}  // namespace

Calibration calibrate(std::vector<PatternPhotograph> photographs, int height, int width) {
  for (PatternPhotograph& each : photographs) {
    if (each.is_used()) each.problem = each.found.problem;
  }
  leave_out_blurred(photographs);
  Calibration calibration{{}, std::move(photographs)};
  do {
    require_enough(calibration.photographs);
    try {
      calibration.camera = solve(calibration.photographs, height, width);
    } catch (const cv::Exception&) {
      throw InvalidInput(
          "the photographs do not determine the camera; take the pattern tilted in several "
          "directions, and check its size");
    }
  } while (leave_out_misfit(calibration.photographs));
  return calibration;
}

namespace {

/// Pixels across and down, with the number of photographs of that size.
struct PhotographSize {
  int width = 0;
  int height = 0;
  int count = 0;
};

/// The most frequent size; of equally frequent ones, the first.
PhotographSize usual_size(const std::vector<PhotographSize>& sizes) {
  std::vector<PhotographSize> counted;
  for (const PhotographSize& size : sizes) {
    const auto known = std::ranges::find_if(counted, [&](const PhotographSize& each) {
      return each.width == size.width && each.height == size.height;
    });
    if (known != counted.end()) {
      ++known->count;
    } else {
      counted.push_back({size.width, size.height, 1});
    }
  }
  return counted.empty() ? PhotographSize{}
                         : *std::ranges::max_element(counted, {}, &PhotographSize::count);
}

PatternPhotograph find_in(const cv::Mat& gray, const std::filesystem::path& file,
                          const Pattern& pattern) {
  const ImageView<const std::uint8_t> view{gray.data, gray.rows, gray.cols, 1,
                                           static_cast<std::ptrdiff_t>(gray.step[0])};
  PatternPhotograph photograph;
  photograph.name = file.string();
  photograph.found = find_pattern(view, pattern);
  photograph.sharpness = sharpness(view, photograph.found.pixels, kSharpnessReach);
  return photograph;
}

}  // namespace

Calibration calibrate(const std::vector<std::filesystem::path>& files, const Pattern& pattern,
                      const Progress& progress) {
  std::vector<PatternPhotograph> photographs;
  std::vector<PhotographSize> sizes;
  for (std::size_t i = 0; i < files.size(); ++i) {
    progress.check();
    progress.step("finding the pattern in " + files[i].filename().string());
    const cv::Mat gray = read_gray(files[i]);
    sizes.push_back({gray.cols, gray.rows});
    photographs.push_back(find_in(gray, files[i], pattern));
    progress.report(0.8 * static_cast<double>(i + 1) / static_cast<double>(files.size()));
  }
  const PhotographSize usual = usual_size(sizes);
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (sizes[i].width == usual.width && sizes[i].height == usual.height) continue;
    photographs[i].problem =
        fmt::format("{}×{} px, but {} of {} have {}×{}", sizes[i].width, sizes[i].height,
                    usual.count, files.size(), usual.width, usual.height);
  }
  progress.step("calibrating");
  return calibrate(std::move(photographs), usual.height, usual.width);
}

double sharpness(ImageView<const std::uint8_t> gray, std::span<const std::array<double, 2>> points,
                 int reach) {
  double sum = 0;
  int count = 0;
  for (const auto& [px, py] : points) {
    const int x0 = std::max(static_cast<int>(px) - reach, 1);
    const int y0 = std::max(static_cast<int>(py) - reach, 1);
    const int x1 = std::min(static_cast<int>(px) + reach, gray.width - 1);
    const int y1 = std::min(static_cast<int>(py) + reach, gray.height - 1);
    int low = 255;
    int high = 0;
    int across = 0;
    int down = 0;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const int here = gray.at(y, x);
        low = std::min(low, here);
        high = std::max(high, here);
        across = std::max(across, std::abs(here - gray.at(y, x - 1)));
        down = std::max(down, std::abs(here - gray.at(y - 1, x)));
      }
    }
    if (high - low < 8) continue;
    sum += static_cast<double>(std::min(across, down)) / (high - low);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace episcope::capture
