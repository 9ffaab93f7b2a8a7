// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/blender/render_truth.h"

#include "engine/core/error.h"
#include "engine/core/parallel/parallel.h"
#include "engine/io/arrays/npy_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

template <class T>
Image<T> of_size(const fs::path& path, const RenderManifest& manifest, Image<T> map) {
  if (map.height() == manifest.height && map.width() == manifest.width) return map;
  throw IoError(path, fmt::format("this map has {}×{} px, but the views have {}×{} px; render the "
                                  "folder anew",
                                  map.width(), map.height(), manifest.width, manifest.height));
}

Image<float> read_depth(const RenderManifest& manifest, const char* part, ViewIndex stored) {
  const fs::path path = manifest.file(part, stored);
  return of_size(path, manifest, read_npy_map(path));
}

/// Where a part of the views is stored, and where it goes.
struct Block {
  GridShape grid;
  ViewIndex first;   ///< Of the stack.
  ViewIndex stored;  ///< The same view in the folder.

  [[nodiscard]] ViewIndex stored_at(ViewIndex view) const {
    return {view.v - first.v + stored.v, view.u - first.u + stored.u};
  }
};

Block block_of(const ViewCrop& crop, MapViews views) {
  if (views == MapViews::All) return {crop.kept, {}, crop.first};
  const ViewIndex center = crop.kept.center();
  return {{1, 1}, center, {crop.first.v + center.v, crop.first.u + center.u}};
}

DisparityField empty_field(const RenderManifest& manifest, const Block& block) {
  return {ViewStack<float>(block.grid, manifest.height, manifest.width, 1, block.first),
          ViewStack<std::uint8_t>(block.grid, manifest.height, manifest.width, 1, block.first)};
}

/// Disparity of a depth map where `is_there(pixel)`; invalid elsewhere, and where there is no
/// surface.
template <class IsThere>
void store(const CameraGrid& camera, const Image<float>& depth, ViewIndex view,
           DisparityField& field, const IsThere& is_there) {
  float* disparity = field.disparity.view(view).data;
  std::uint8_t* valid = field.valid.view(view).data;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const auto d = static_cast<float>(camera.disparity_from_depth(depth.data()[i]));
    valid[i] = is_there(i) && std::isfinite(d) ? 1 : 0;
    disparity[i] = std::isfinite(d) ? d : 0;
  }
}

void read_view(const RenderManifest& manifest, const Block& block, ViewIndex view,
               GroundTruth& truth) {
  const ViewIndex stored = block.stored_at(view);
  const Image<float> front = read_depth(manifest, "depth", stored);
  if (truth.foreground.empty()) {
    store(manifest.camera, front, view, truth.field, [](std::size_t) { return true; });
    return;
  }
  // NaN: there is no transparent surface; infinite: there is nothing behind it.
  const Image<float> behind = read_depth(manifest, "depth_behind", stored);
  const auto is_layered = [&](std::size_t i) { return !std::isnan(behind.data()[i]); };
  store(manifest.camera, front, view, truth.field, [&](std::size_t i) { return !is_layered(i); });
  store(manifest.camera, front, view, truth.foreground, is_layered);
  store(manifest.camera, behind, view, truth.background, is_layered);
}

void read_labels(const RenderManifest& manifest, const Block& block, ViewIndex view,
                 GroundTruth& truth) {
  const fs::path path = manifest.file("labels", block.stored_at(view));
  const Image<std::int32_t> labels = of_size(path, manifest, read_npy_labels(path));
  std::copy_n(labels.data(), labels.size(), truth.labels.view(view).data);
}

}  // namespace

GroundTruth read_render_truth(const RenderManifest& manifest, const ViewCrop& crop, MapViews views,
                              bool needs_labels, const Progress& progress) {
  const Block block = block_of(crop, views);
  GroundTruth truth;
  const bool has_depth = manifest.has("depth");
  const bool has_labels = needs_labels && manifest.has("labels");
  if (has_depth) truth.field = empty_field(manifest, block);
  if (has_depth && manifest.has("depth_behind")) {
    truth.foreground = empty_field(manifest, block);
    truth.background = empty_field(manifest, block);
  }
  if (has_labels) {
    truth.labels =
        ViewStack<std::int32_t>(block.grid, manifest.height, manifest.width, 1, block.first);
  }
  parallel_for(block.grid.count(), progress, [&](int i) {
    const ViewIndex view = block.grid.view_at(i, block.first);
    if (has_depth) read_view(manifest, block, view, truth);
    if (has_labels) read_labels(manifest, block, view, truth);
  });
  return truth;
}

}  // namespace episcope::io
