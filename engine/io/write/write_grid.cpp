// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/write/write_grid.h"

#include "engine/core/parallel/parallel.h"
#include "engine/io/arrays/npy_file.h"
#include "engine/io/durable/atomic_folder.h"
#include "engine/io/grid/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

/// Names of the files of one view: row and column from 0 on, padded to the same width.
class ViewNames {
 public:
  explicit ViewNames(GridShape grid)
      : digits_(std::max<std::size_t>(2, std::to_string(std::max(grid.v, grid.u) - 1).size())) {}

  [[nodiscard]] std::string of(ViewIndex view) const {
    return fmt::format("{:0{}}_{:0{}}", view.v, digits_, view.u, digits_);
  }

 private:
  std::size_t digits_;
};

void write_view(const fs::path& stem, const LightField& field, ViewIndex view) {
  const fs::path png = stem.string() + ".png";
  if (field.sample_type() == SampleType::UInt8) {
    write_png(png, field.view<std::uint8_t>(view));
  } else if (field.sample_type() == SampleType::UInt16) {
    write_png(png, field.view<std::uint16_t>(view));
  } else {
    write_tiff(stem.string() + ".tiff", field.view<float>(view));
  }
}

void write_disparity_map(const fs::path& path, const DisparityView& map) {
  std::vector<float> marked;
  marked.reserve(map.disparity.size());
  for (int y = 0; y < map.disparity.height; ++y) {
    for (int x = 0; x < map.disparity.width; ++x) {
      marked.push_back(map.is_valid(y, x) ? map.disparity.at(y, x)
                                          : std::numeric_limits<float>::quiet_NaN());
    }
  }
  write_npy<float>(path,
                   {static_cast<std::size_t>(map.disparity.height),
                    static_cast<std::size_t>(map.disparity.width)},
                   marked);
}

void write_label_map(const fs::path& path, ImageView<const std::int32_t> labels) {
  write_npy<std::int32_t>(
      path, {static_cast<std::size_t>(labels.height), static_cast<std::size_t>(labels.width)},
      {labels.data, labels.size()});
}

void write_regions(const fs::path& folder, const GroundTruth& truth) {
  for (const auto& [name, region] : truth.regions) {
    write_npy<std::uint8_t>(
        folder / ("mask_" + name + ".npy"),
        {static_cast<std::size_t>(region.height()), static_cast<std::size_t>(region.width())},
        {region.data(), region.size()});
  }
}

std::uintmax_t scene_bytes(const Scene& scene) {
  const GroundTruth& truth = *scene.truth;
  const std::size_t disparities = truth.field.empty() ? 0 : truth.field.disparity.size();
  const std::size_t labels = truth.labels.empty() ? 0 : truth.labels.size();
  return scene.light_field->byte_size() + 4 * (disparities + labels);
}

}  // namespace

void write_grid_folder(const fs::path& folder, const Scene& scene, const Progress& progress) {
  progress.check();
  progress.step("writing " + folder.filename().string());
  const LightField& field = *scene.light_field;
  const GroundTruth& truth = *scene.truth;
  const ViewNames names(field.grid());
  AtomicFolder target(folder, scene_bytes(scene));
  const fs::path& place = target.temporary();
  parallel_for(field.grid().count(), progress, [&](int i) {
    const ViewIndex view = field.grid().view_at(i);
    const std::string name = names.of(view);
    write_view(place / name, field, view);
    if (truth.field.contains(view)) {
      write_disparity_map(place / ("disparity_" + name + ".npy"), truth.field.view(view));
    }
    if (!truth.labels.empty() && truth.labels.contains(view)) {
      write_label_map(place / ("label_" + name + ".npy"), truth.labels.view(view));
    }
  });
  write_regions(place, truth);
  progress.check();
  target.commit();
  progress.report(1);
}

}  // namespace episcope::io
