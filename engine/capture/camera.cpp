// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/camera.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/io/base/atomic_file.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace episcope::capture {
namespace {

constexpr std::uintmax_t kLargest = 1 << 20;  ///< Bytes; a camera takes some hundred.

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw IoError(path, "this file cannot be read; make one with episcope-cli calibrate");
  if (std::error_code error; std::filesystem::file_size(path, error) > kLargest) {
    throw IoError(path, "this file is too large for a camera; choose another");
  }
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Of OpenCV's YAML. Its own reading believes the sizes that are stated, or missing.
struct StoredMatrix {
  int rows = 0;
  int columns = 0;
  std::vector<double> numbers{};  ///< Row by row; empty unless there are as many as stated.
};

StoredMatrix matrix_of(const cv::FileStorage& file, const char* name) {
  const cv::FileNode node = file[name];
  if (!node.isMap() || !node["data"].isSeq()) return {};
  const cv::FileNode data = node["data"];
  StoredMatrix matrix{whole_int(node["rows"].real()).value_or(0),
                      whole_int(node["cols"].real()).value_or(0)};
  const bool is_whole = matrix.rows > 0 && matrix.columns > 0 &&
                        data.size() / static_cast<std::size_t>(matrix.rows) ==
                            static_cast<std::size_t>(matrix.columns) &&
                        data.size() % static_cast<std::size_t>(matrix.rows) == 0;
  if (!is_whole) return {};
  for (const cv::FileNode& number : data) matrix.numbers.push_back(number.real());
  return matrix;
}

bool is_camera(const LensCamera& camera) {
  return camera.width > 0 && camera.height > 0 && camera.focal_x > 0 && camera.focal_y > 0 &&
         std::isfinite(camera.focal_x + camera.focal_y + camera.center_x + camera.center_y);
}

// A colon with nothing before it in its line or list, or an empty name: OpenCV's parser ends the
// program there.
bool has_empty_key(const std::string& text) {
  for (std::size_t at = text.find(':'); at != std::string::npos; at = text.find(':', at + 1)) {
    std::string_view before = std::string_view(text).substr(0, at);
    before = before.substr(0, before.find_last_not_of(" \t\r") + 1);
    const bool has_name =
        !before.empty() && std::string_view("\n{,[").find(before.back()) == std::string_view::npos;
    if (!has_name || before.ends_with("\"\"")) return true;
  }
  return false;
}

LensCamera parse(const std::filesystem::path& path, const std::string& text) {
  const cv::FileStorage file(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
  const StoredMatrix matrix = matrix_of(file, "camera_matrix");
  const std::vector<double> distortion = matrix_of(file, "distortion_coefficients").numbers;
  LensCamera camera;
  camera.width = whole_int(file["image_width"].real()).value_or(0);
  camera.height = whole_int(file["image_height"].real()).value_or(0);
  if (matrix.rows == 3 && matrix.columns == 3) {
    camera.focal_x = matrix.numbers[0];
    camera.focal_y = matrix.numbers[4];
    camera.center_x = matrix.numbers[2];
    camera.center_y = matrix.numbers[5];
  }
  if (distortion.size() > camera.distortion.size()) {
    throw IoError(path, "this lens has " + std::to_string(distortion.size()) +
                            " distortion coefficients, but 5 are understood (k1, k2, p1, p2, k3); "
                            "calibrate again with episcope-cli calibrate");
  }
  std::ranges::copy(distortion, camera.distortion.begin());
  const cv::FileNode rms = file["avg_reprojection_error"];
  if (!rms.empty()) camera.rms = rms.real();
  return camera;
}

}  // namespace

void write_camera(const std::filesystem::path& path, const LensCamera& camera) {
  cv::FileStorage file(
      ".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  const cv::Mat matrix = (cv::Mat_<double>(3, 3) << camera.focal_x, 0, camera.center_x, 0,
                          camera.focal_y, camera.center_y, 0, 0, 1);
  const cv::Mat distortion(5, 1, CV_64F, const_cast<double*>(camera.distortion.data()));
  file << "image_width" << camera.width << "image_height" << camera.height << "camera_matrix"
       << matrix << "distortion_coefficients" << distortion << "avg_reprojection_error"
       << camera.rms;
  const std::string text = file.releaseAndGetString();
  io::write_atomically(path, text);
}

LensCamera read_camera(const std::filesystem::path& path) {
  const std::string text = text_of(path);
  LensCamera camera;
  try {
    if (!has_empty_key(text)) camera = parse(path, text);
  } catch (const cv::Exception&) {
    // As a file without a camera, below.
  }
  if (!is_camera(camera)) {
    throw IoError(path,
                  "this is no camera in OpenCV's YAML (image_width, image_height, camera_matrix, "
                  "distortion_coefficients); make one with episcope-cli calibrate");
  }
  return camera;
}

}  // namespace episcope::capture
