// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/labels/true_labels.h"

#include "engine/core/light_field/shear.h"
#include "engine/io/archive/archive_maps.h"
#include "engine/io/labels/label_list.h"
#include "engine/io/labels/raise_label.h"
#include "engine/io/open/view_crop.h"
#include "engine/io/order/view_order.h"

#include <algorithm>

namespace episcope::io {

ViewStack<std::int32_t> read_true_labels(const std::filesystem::path& path, const Scene& scene,
                                         const Progress& progress) {
  const Hdf5Input file(path);
  const LightField& field = *scene.light_field;
  const ViewCrop& crop = scene.convention.crop;
  const FieldShape shape{crop.leaves_out() ? crop.stored : field.grid(), field.height(),
                         field.width()};
  auto labels = read_maps<std::int32_t>(file, kTrueLabels, shape, progress);
  if (scene.convention.raised_labels) {
    std::for_each(labels.data(), labels.data() + labels.size(), raise_label);
  }
  reverse_views(labels, shape.grid, flip_of(scene.convention));
  if (crop.leaves_out()) labels = cropped(std::move(labels), crop);
  const double focus_px = scene.convention.focus_px;
  return focus_px == 0 ? std::move(labels) : sheared(labels, field.center(), focus_px, progress);
}

}  // namespace episcope::io
