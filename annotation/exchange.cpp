// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/exchange.h"

#include "engine/core/error.h"

#include <algorithm>
#include <set>
#include <string>

namespace episcope {
namespace {

void require_fitting(const ViewScribbles& painted, const ScribbleLayer& layer) {
  if (painted.labels.height() != layer.height() || painted.labels.width() != layer.width()) {
    throw InvalidInput("scribbles of " + std::to_string(painted.labels.height()) + "×" +
                       std::to_string(painted.labels.width()) + " px do not fit views of " +
                       std::to_string(layer.height()) + "×" + std::to_string(layer.width()) +
                       " px");
  }
}

/// Copies a view and notes its ids.
void put_view(const ViewScribbles& painted, ScribbleLayer& layer, std::set<int>& ids) {
  require_fitting(painted, layer);
  std::uint8_t* out = layer.writable_view(painted.view).data;
  int last = 0;
  for (const std::int32_t id : painted.labels) {
    if (id < 0 || id > LabelSet::kMaxId) {
      throw InvalidInput("the scribbles hold the label " + std::to_string(id) +
                         ", but labels go from 1 to 255");
    }
    *out++ = static_cast<std::uint8_t>(id);
    if (id != last && id != 0) ids.insert(last = id);
  }
}

}  // namespace

Scribbles scribbles_of(const AnnotationDocument& document) {
  Scribbles scribbles{{}, document.labels().labels()};
  const ScribbleLayer& layer = document.scribbles();
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
    labels.insert({id, "label " + std::to_string(id), label_color(id)});
  }
  return {std::move(labels), std::move(layer), history_bytes};
}

}  // namespace episcope
