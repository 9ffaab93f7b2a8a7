// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/calibrate.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/io/base/image_header.h"

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cmath>

namespace episcope::capture {
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
