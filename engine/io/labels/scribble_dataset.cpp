// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/labels/scribble_dataset.h"

#include "engine/core/array/whole_int.h"
#include "engine/core/error.h"
#include "engine/io/hdf5/map_writer.h"
#include "engine/io/labels/label_list.h"
#include "engine/io/labels/raise_label.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace episcope::io {
namespace {

constexpr const char* kName = "SCRIBBLES";

struct Census {
  std::size_t zeros = 0;
  std::size_t nones = 0;  ///< −1 or 255.
  std::size_t painted = 0;
};

bool is_none(std::int32_t label) {
  return label == -1 || label == 255;
}

void count(const Image<std::int32_t>& labels, Census& census) {
  for (const std::int32_t label : labels) {
    if (label == 0) {
      ++census.zeros;
    } else if (is_none(label)) {
      ++census.nones;
    } else {
      ++census.painted;
    }
  }
}

/// A view of nothing but one value that means "none" somewhere is not painted.
bool is_painted(const Image<std::int32_t>& labels) {
  Census census;
  count(labels, census);
  return census.painted > 0 || (census.zeros > 0 && census.nones > 0);
}

ViewIndex stated_view(const Hdf5Input& file, const FieldShape& shape, ViewIndex otherwise) {
  const std::vector<double> stated = file.numbers("/", "scribble_view");
  if (stated.size() != 2) return otherwise;
  const ViewIndex view{whole_int(stated[0]).value_or(-1), whole_int(stated[1]).value_or(-1)};
  if (!shape.grid.contains(view)) {
    throw IoError(file.path(), fmt::format("the attribute scribble_view names view ({}, {}), which "
                                           "the light field does not have; correct it",
                                           view.v, view.u));
  }
  return view;
}

std::vector<ViewScribbles> read_views(const Hdf5Input& file, const FieldShape& shape,
                                      const Progress& progress) {
  const ViewStack<std::int32_t> stack = read_maps<std::int32_t>(file, kName, shape, progress);
  std::vector<ViewScribbles> views;
  for (int i = 0; i < stack.grid().count(); ++i) {
    const ViewIndex view = stack.view_at(i);
    Image<std::int32_t> labels(shape.height, shape.width);
    std::copy_n(stack.view(view).data, labels.size(), labels.data());
    views.push_back({view, std::move(labels)});
  }
  if (views.size() == 1) views[0].view = stated_view(file, shape, views[0].view);
  return views;
}

/// Ids of other programs. Returns whether they were raised.
bool decode(std::vector<ViewScribbles>& views, bool has_label_zero) {
  std::erase_if(views, [](const ViewScribbles& one) { return !is_painted(one.labels); });
  Census census;
  for (const ViewScribbles& one : views) count(one.labels, census);
  const bool is_zero_a_label = census.zeros > 0 && census.nones > census.zeros && has_label_zero;
  for (ViewScribbles& one : views) {
    for (std::int32_t& label : one.labels) {
      if (is_none(label)) {
        label = 0;
      } else if (is_zero_a_label) {
        raise_label(label);
      }
    }
  }
  return is_zero_a_label;
}

}  // namespace

StoredScribbles read_scribble_dataset(const Hdf5Input& file, const FieldShape& shape,
                                      bool has_label_zero, const Progress& progress) {
  StoredScribbles stored;
  std::vector<ViewScribbles>& views = stored.scribbles.views;
  views = read_views(file, shape, progress);
  if (const auto unpainted = file.number(kName, "unpainted")) {
    const std::int32_t none = whole_int(*unpainted).value_or(0);
    for (ViewScribbles& one : views) std::ranges::replace(one.labels, none, 0);
    stored.raises_labels = file.number(kName, "raises_labels").value_or(0) != 0;
  } else {
    stored.raises_labels = decode(views, has_label_zero);
  }
  std::erase_if(views, [](const ViewScribbles& one) {
    return std::ranges::all_of(one.labels, [](std::int32_t label) { return label == 0; });
  });
  stored.scribbles.labels = read_label_list(file, kName);
  return stored;
}

void put_in_order(Scribbles& scribbles, GridShape grid, ViewFlip flip) {
  for (ViewScribbles& one : scribbles.views) one.view = flipped(one.view, grid, flip);
  std::ranges::sort(scribbles.views, {},
                    [](const ViewScribbles& one) { return std::pair(one.view.v, one.view.u); });
}

void add_scribbles(Hdf5Output& file, const Scribbles& scribbles, const ScribblePlace& place,
                   const Progress& progress) {
  const FieldShape& shape = place.shape;
  const Image<std::int32_t> bare(shape.height, shape.width);
  const bool has_many = scribbles.views.size() > 1;
  MapGeometry maps{{1, 1}, shape.grid.center(), shape.height, shape.width};
  if (has_many) maps = {shape.grid, {}, shape.height, shape.width};
  if (scribbles.views.size() == 1) {
    maps.first = flipped(scribbles.views[0].view, shape.grid, place.flip);
  }
  write_maps<std::int32_t>(file, kName, maps, "", progress, [&](ViewIndex stored) {
    const auto painted = std::ranges::find(scribbles.views, flipped(stored, shape.grid, place.flip),
                                           &ViewScribbles::view);
    return painted == scribbles.views.end() ? bare.data() : painted->labels.data();
  });
  if (!has_many) file.set_integers("/", "scribble_view", {maps.first.v, maps.first.u});
  file.set_integers(kName, "unpainted", {0});
  if (place.raises_labels) file.set_integers(kName, "raises_labels", {1});
  add_label_list(file, kName, scribbles.labels);
}

}  // namespace episcope::io
