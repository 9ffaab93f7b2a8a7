// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/camera/camera_file.h"

#include "engine/core/array/whole_int.h"
#include "engine/core/error.h"
#include "engine/io/durable/atomic_file.h"

#include <opencv2/core.hpp>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>

namespace episcope::capture {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw IoError(path, "this file cannot be read; make one with episcope-cli calibrate");
  return {std::istreambuf_iterator<char>(file), {}};
}

cv::Mat matrix_of(const cv::FileStorage& file, const char* name) {
  cv::Mat stored;
  file[name] >> stored;
  cv::Mat matrix;
  if (!stored.empty()) stored.convertTo(matrix, CV_64F);
  return matrix;
}

bool is_camera(const LensCamera& camera) {
  return camera.width > 0 && camera.height > 0 && camera.focal_x > 0 && camera.focal_y > 0 &&
         std::isfinite(camera.focal_x + camera.focal_y + camera.center_x + camera.center_y);
}

LensCamera parse(const std::filesystem::path& path, const std::string& text) {
  const cv::FileStorage file(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
  const cv::Mat matrix = matrix_of(file, "camera_matrix");
  const cv::Mat distortion = matrix_of(file, "distortion_coefficients");
  LensCamera camera;
  camera.width = whole_int(file["image_width"].real()).value_or(0);
  camera.height = whole_int(file["image_height"].real()).value_or(0);
  if (matrix.size() == cv::Size(3, 3)) {
    camera.focal_x = matrix.at<double>(0, 0);
    camera.focal_y = matrix.at<double>(1, 1);
    camera.center_x = matrix.at<double>(0, 2);
    camera.center_y = matrix.at<double>(1, 2);
  }
  if (distortion.total() > camera.distortion.size()) {
    throw IoError(path, "this lens has " + std::to_string(distortion.total()) +
                            " distortion coefficients, but 5 are understood (k1, k2, p1, p2, k3); "
                            "calibrate again with episcope-cli calibrate");
  }
  for (std::size_t i = 0; i < distortion.total(); ++i) {
    camera.distortion[i] = distortion.ptr<double>()[i];
  }
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
    camera = parse(path, text);
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
