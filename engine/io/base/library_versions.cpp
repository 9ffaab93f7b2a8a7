// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/library_versions.h"

#include "engine/io/base/hdf5_file.h"

#include <fmt/format.h>
#include <matio.h>
#include <png.h>
#include <zlib.h>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>

extern "C" {
#include <libavutil/avutil.h>
}

namespace episcope::io {
namespace {

std::string matio_version() {
  int major = 0;
  int minor = 0;
  int release = 0;
  Mat_GetLibraryVersion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

}  // namespace

std::vector<LibraryVersion> library_versions() {
  return {{"FFmpeg", av_version_info()},
          {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100,
                              FMT_VERSION % 100)},
          {"HDF5", hdf5_version()},
          {"JSON for Modern C++",
           fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                       NLOHMANN_JSON_VERSION_PATCH)},
          {"libpng", png_get_libpng_ver(nullptr)},
          {"matio", matio_version()},
          {"OpenCV", cv::getVersionString()},
          {"zlib", zlibVersion()}};
}

}  // namespace episcope::io
