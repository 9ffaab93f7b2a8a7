// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/excerpt_reader.h"

#include "engine/core/error.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/formats/archive_depth.h"
#include "engine/io/formats/image_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <sstream>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

CameraGrid camera_of(const ExcerptAttributes& attributes) {
  const auto number = [&](const char* name) {
    const auto found = attributes.find(name);
    return found == attributes.end() ? 0 : found->second;
  };
  CameraGrid camera;
  camera.baseline = number("dH");
  camera.focal_length = number("focalLength");
  camera.shift = number("shift");
  return camera;
}

ViewStack<float> read_depth(const fs::path& path, int height, int width, ViewIndex center) {
  require_readable_file(path);
  ViewStack<float> depth({1, 1}, height, width, 1, center);
  const std::uintmax_t bytes = fs::file_size(path);
  if (bytes != depth.size() * sizeof(float)) {
    throw IoError(path, fmt::format("the file has {} bytes, but {} are expected for {}×{} float "
                                    "samples; copy it again or remove it",
                                    bytes, depth.size() * sizeof(float), width, height));
  }
  std::ifstream in(path, std::ios::binary);
  in.read(reinterpret_cast<char*>(depth.data()), static_cast<std::streamsize>(bytes));
  if constexpr (std::endian::native == std::endian::big) {
    std::transform(depth.data(), depth.data() + depth.size(), depth.data(), [](float sample) {
      return std::bit_cast<float>(__builtin_bswap32(std::bit_cast<std::uint32_t>(sample)));
    });
  }
  return depth;
}

ViewStack<std::uint8_t> read_excerpt_mask(const fs::path& path, int height, int width,
                                          ViewIndex center) {
  if (!is_there(path)) return {};
  const Image<std::int32_t> numbers = decode_numbers(path);
  if (numbers.height() != height || numbers.width() != width) {
    throw IoError(
        path,
        fmt::format("the mask has {}×{} px, but the views have {}×{} px; remove or replace it",
                    numbers.width(), numbers.height(), width, height));
  }
  ViewStack<std::uint8_t> mask({1, 1}, height, width, 1, center);
  std::transform(numbers.begin(), numbers.end(), mask.data(),
                 [](std::int32_t value) { return static_cast<std::uint8_t>(value != 0); });
  return mask;
}

bool is_excerpt_folder(const fs::path& folder) {
  return is_there(folder / "depth.bin") && is_there(folder / "attributes.dat") &&
         fs::is_directory(folder / "lf");
}

Scene read_excerpt(const fs::path& folder, const OpenOptions& options, const Progress& progress) {
  const auto attributes = read_excerpt_attributes(folder / "attributes.dat");
  ImageGridExtras extras;
  extras.reader = "excerpt";
  extras.format = "archive excerpt (lf, depth.bin)";
  extras.source = folder;
  extras.camera = camera_of(attributes);
  const auto min = attributes.find("min_disp");
  const auto max = attributes.find("max_disp");
  if (min != attributes.end() && max != attributes.end() && min->second < max->second) {
    extras.disparity_range = Interval{min->second, max->second};
  }
  extras.files = {{folder / "attributes.dat", "camera attributes"},
                  {folder / "depth.bin", "depth of the center view"}};
  if (is_there(folder / "mask.png")) extras.files.emplace_back(folder / "mask.png", "mask");
  extras.read_truth = [&](const LightField::Samples& samples, CameraGrid& camera,
                          ConventionReport& report) {
    if (!camera.is_known()) {
      throw IoError(folder / "attributes.dat",
                    "dH and focalLength are missing here; add them or open the folder lf alone");
    }
    return std::visit(
        [&](const auto& stack) {
          const ViewIndex center = stack.grid().center();
          DepthMaps maps{
              "depth.bin", read_depth(folder / "depth.bin", stack.height(), stack.width(), center),
              read_excerpt_mask(folder / "mask.png", stack.height(), stack.width(), center)};
          camera = settle_units(maps, samples, camera, options.units, report);
          return disparity_from_depth(std::move(maps), camera, report, Progress(1));
        },
        samples);
  };
  return read_image_grid(folder / "lf", options, progress, extras);
}

SceneProbe probe_excerpt(const fs::path& folder, const OpenOptions& options) {
  SceneProbe probe = probe_image_grid(folder, options);
  probe.truth = "depth of the center view";
  return probe;
}

fs::path find_excerpt(const fs::path& path, const OpenOptions& options) {
  const fs::path folder = scene_folder(path);
  const bool is_one = !folder.empty() && !wants_image_grid(options) && is_excerpt_folder(folder);
  return is_one ? folder : fs::path();
}

constexpr const char* kExcerptOptions[] = {"flip",  "crop", "units", "pattern",
                                           "snake", "grid", "levels"};

}  // namespace

Reader excerpt_reader() {
  return {.id = "excerpt",
          .name = "an excerpt of the 2013 archive",
          .options = kExcerptOptions,
          .find = find_excerpt,
          .read = read_excerpt,
          .probe = probe_excerpt};
}

ExcerptAttributes read_excerpt_attributes(const std::filesystem::path& path) {
  require_readable_file(path);
  std::ifstream in(path);
  ExcerptAttributes attributes;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string value;
    std::string name;
    words >> value >> name;
    const auto number = parse_number(value);
    if (number && name.starts_with("//")) attributes[name.substr(2)] = *number;
  }
  return attributes;
}

}  // namespace episcope::io
