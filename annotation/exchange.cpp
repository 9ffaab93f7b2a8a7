// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/exchange.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace episcope {
namespace {

void require_fitting(const ViewScribbles& painted, const ScribbleLayer& layer) {
  if (painted.labels.height() != layer.height() || painted.labels.width() != layer.width()) {
    throw InvalidInput(fmt::format("scribbles of {}×{} px do not fit views of {}×{} px",
                                   painted.labels.width(), painted.labels.height(), layer.width(),
                                   layer.height()));
  }
}

/// Copies a view and collects its ids.
void put_view(const ViewScribbles& painted, ScribbleLayer& layer, std::set<int>& ids) {
  require_fitting(painted, layer);
  std::uint8_t* out = layer.writable_view(painted.view).data;
  int last = 0;
  for (const std::int32_t id : painted.labels) {
    if (id < 0 || id > LabelSet::kMaxId) {
      throw InvalidInput(
          fmt::format("the scribbles hold the label {}, but labels range from 1 to 255", id));
    }
    *out++ = static_cast<std::uint8_t>(id);
    if (id != last && id != 0) ids.insert(last = id);
  }
}

std::map<std::uint8_t, PixelRegion> regions_of(ImageView<const std::uint8_t> image) {
  std::map<std::uint8_t, PixelRegion> regions;
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* row = image.row(y);
    for (int x = 0; x < image.width;) {
      const int begin = x;
      while (x < image.width && row[x] == row[begin]) ++x;
      if (row[begin] != 0) regions[row[begin]].push_back({y, begin, x});
    }
  }
  return regions;
}

}  // namespace

Scribbles scribbles_of(const AnnotationDocument& document) {
  Scribbles scribbles = scribbles_of(document.scribbles());
  scribbles.labels = document.labels().labels();
  return scribbles;
}

Scribbles scribbles_of(const ScribbleLayer& layer) {
  Scribbles scribbles;
  for (const ViewIndex view : layer.painted_views()) {
    Image<std::int32_t> labels(layer.height(), layer.width());
    std::copy_n(layer.view(view).data, labels.size(), labels.data());
    scribbles.views.push_back({view, std::move(labels)});
  }
  return scribbles;
}

AnnotationDocument document_from(const Scribbles& scribbles, GridShape grid, int height, int width,
                                 std::size_t history_bytes) {
  ScribbleLayer layer(grid, height, width);
  std::set<int> ids;
  for (const ViewScribbles& painted : scribbles.views) put_view(painted, layer, ids);
  LabelSet labels;
  for (const LabelInfo& label : scribbles.labels) labels.insert(label);
  for (const int id : ids) {
    if (labels.contains(id)) continue;
    labels.insert(default_label(id));
  }
  return {std::move(labels), std::move(layer), history_bytes};
}

bool import_scribbles(AnnotationDocument& document, const Scribbles& scribbles, EditKind kind) {
  const ScribbleLayer& layer = document.scribbles();
  const AnnotationDocument other =
      document_from(scribbles, layer.grid(), layer.height(), layer.width(), 0);
  LabelSet labels = document.labels();
  for (const LabelInfo& label : other.labels().labels()) {
    if (!labels.contains(label.id)) labels.insert(label);
  }
  PendingEdit edit(document, kind);
  edit.set_labels(std::move(labels));
  for (const ViewIndex view : other.scribbles().painted_views()) {
    for (const auto& [label, region] : regions_of(other.scribbles().view(view))) {
      edit.paint(view, region, {label, all_labels_but(0)});
    }
  }
  return edit.commit();
}

}  // namespace episcope
