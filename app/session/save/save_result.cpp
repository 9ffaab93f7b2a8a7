// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/save/save_result.h"

#include "app/session/run/result_source.h"
#include "engine/core/light_field/shown_disparity.h"
#include "engine/core/text/suffix.h"
#include "engine/io/arrays/npy_file.h"
#include "engine/io/grid/image_file.h"
#include "engine/io/maps/pfm.h"
#include "engine/io/maps/ply.h"
#include "engine/io/maps/result_file.h"
#include "engine/render/shade.h"

#include <algorithm>
#include <limits>

namespace episcope {
namespace {

// Of one px of disparity without a camera: what is seen is a quarter as deep as it is wide.
double z_per_px(const DisparityView& view) {
  const auto& map = view.disparity;
  double min = std::numeric_limits<double>::infinity();
  double max = -min;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (!view.is_valid(y, x)) continue;
      min = std::min<double>(min, map.at(y, x));
      max = std::max<double>(max, map.at(y, x));
    }
  }
  return max > min ? 0.25 * map.width / (max - min) : 1;
}

}  // namespace

std::optional<MapForm> map_form_of(const std::filesystem::path& path) {
  const std::string suffix = suffix_of(path);
  if (suffix == ".h5" || suffix == ".hdf5") return MapForm::Result;
  if (suffix == ".pfm") return MapForm::Pfm;
  if (suffix == ".tif" || suffix == ".tiff") return MapForm::Tiff;
  if (suffix == ".npy") return MapForm::Npy;
  if (suffix == ".ply") return MapForm::PointCloud;
  return std::nullopt;
}

void save_result(const std::filesystem::path& path, const Estimate& estimate,
                 const std::string& input, const Progress& progress) {
  io::write_result(path, estimate, progress, source_text(input, path));
}

void save_map(const std::filesystem::path& path, const DisparityView& map) {
  Image<float> values(map.disparity.height, map.disparity.width, 1,
                      std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x) {
      if (map.is_valid(y, x)) values.at(y, x) = map.disparity.at(y, x);
    }
  }
  switch (map_form_of(path).value_or(MapForm::Tiff)) {
    case MapForm::Pfm:
      return io::write_pfm(path, values.view());
    case MapForm::Npy:
      return io::write_npy<float>(
          path,
          {static_cast<std::size_t>(values.height()), static_cast<std::size_t>(values.width())},
          {values.data(), values.size()});
    default:
      return io::write_tiff(path, values.view());
  }
}

void save_point_cloud(const std::filesystem::path& path, const LightField& light_field,
                      ViewIndex view, const DisparityView& map) {
  const ShownDisparity shown(map, light_field.valid_of(view));
  io::write_ply(path, make_point_cloud(shown.view(), light_field.info().camera,
                                       render::shade_view(light_field, view),
                                       {.z_per_px = z_per_px(shown.view())}));
}

}  // namespace episcope
