// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/benchmark/high_res_files.h"

#include "engine/core/error.h"
#include "engine/io/benchmark/benchmark_names.h"
#include "engine/io/grid/decode_image.h"
#include "engine/io/maps/pfm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <system_error>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDisparity = "gt_disp_highres.pfm";
constexpr const char* kHighResMaskSuffix = "_highres.png";
/// What the map of one scene may take: those of the benchmark take 100 MiB.
constexpr std::uintmax_t kGrantedMiB = 512;

template <class T>
void require_size(const fs::path& path, const Image<T>& map, int height, int width) {
  if (map.height() == height && map.width() == width) return;
  throw IoError(path, fmt::format("this map has {}×{} px, but {} times the size of the views is "
                                  "{}×{} px; replace or remove it",
                                  map.width(), map.height(), kHighResScale, width, height));
}

class TruthInFiles : public HighResTruth {
 public:
  TruthInFiles(const HighResFiles& files, int height, int width)
      : disparity_(files.disparity),
        height_(height * kHighResScale),
        width_(width * kHighResScale) {
    for (const fs::path& path : files.masks)
      masks_.emplace(region_of(path, kHighResMaskSuffix), path);
  }

  [[nodiscard]] Image<float> read_disparity() const override {
    require_memory();
    Image<float> map = read_pfm_map(disparity_);
    require_size(disparity_, map, height_, width_);
    return map;
  }

  [[nodiscard]] std::vector<std::string> regions() const override {
    std::vector<std::string> names;
    for (const auto& [name, path] : masks_) names.push_back(name);
    return names;
  }

  [[nodiscard]] Image<std::uint8_t> read_region(const std::string& name) const override {
    require_memory();
    const fs::path& path = masks_.at(name);
    AnyImage decoded = decode_image(path);
    auto* mask = std::get_if<Image<std::uint8_t>>(&decoded);
    if (!mask) {
      throw IoError(path, "this mask has " + describe_image(decoded) +
                              ", but 8 bit are expected; replace or remove it");
    }
    require_size(path, *mask, height_, width_);
    return first_channel(std::move(*mask));
  }

  [[nodiscard]] std::string identity() const override {
    std::string text = identity_of(disparity_);
    for (const auto& [name, path] : masks_) text += identity_of(path);
    return text;
  }

 private:
  void require_memory() const {
    const std::uintmax_t bytes = std::uintmax_t{sizeof(float)} * height_ * width_;
    constexpr std::uintmax_t mib = 1 << 20;
    if (bytes <= kGrantedMiB * mib) return;
    throw IoError(disparity_, fmt::format("{}×{} px take {} MiB, more than the {} that are granted "
                                          "to the high resolution; use a smaller light field",
                                          width_, height_, bytes / mib, kGrantedMiB));
  }

  [[nodiscard]] static Image<std::uint8_t> first_channel(Image<std::uint8_t> mask) {
    if (mask.channels() == 1) return mask;
    Image<std::uint8_t> first(mask.height(), mask.width());
    for (std::size_t i = 0; i < first.size(); ++i) {
      first.data()[i] = mask.data()[i * static_cast<std::size_t>(mask.channels())];
    }
    return first;
  }

  [[nodiscard]] static std::string identity_of(const fs::path& path) {
    std::error_code ignored;
    const auto written = fs::last_write_time(path, ignored).time_since_epoch().count();
    return fmt::format("{} {} {}\n", path.filename().string(), fs::file_size(path, ignored),
                       written);
  }

  fs::path disparity_;
  std::map<std::string, fs::path> masks_;  ///< By the name of the region.
  int height_;
  int width_;
};

}  // namespace

HighResFiles find_high_res_files(const fs::path& folder) {
  HighResFiles files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& path = entry.path();
    if (path.filename() == kDisparity) files.disparity = path;
    if (!region_of(path, kHighResMaskSuffix).empty()) files.masks.push_back(path);
  }
  std::sort(files.masks.begin(), files.masks.end());
  return files;
}

HighResTruthPtr high_res_truth(const HighResFiles& files, int height, int width) {
  if (files.disparity.empty()) return nullptr;
  return std::make_shared<const TruthInFiles>(files, height, width);
}

}  // namespace episcope::io
