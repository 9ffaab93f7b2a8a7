// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/archive_labels.h"

#include "engine/core/error.h"

#include <algorithm>
#include <vector>

namespace episcope::io {
namespace {

struct Census {
  std::size_t zeros = 0;
  std::size_t nones = 0;  ///< −1 or 255.
  std::size_t painted = 0;
};

bool is_none(std::int32_t label) {
  return label == -1 || label == 255;
}

Census count(ImageView<const std::int32_t> labels) {
  Census census;
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      const std::int32_t label = labels.at(y, x);
      if (label == 0) {
        ++census.zeros;
      } else if (is_none(label)) {
        ++census.nones;
      } else {
        ++census.painted;
      }
    }
  }
  return census;
}

/// Most painted view of a 4-D dataset. A view of nothing but one value is not painted.
ViewIndex painted_view(const ViewStack<std::int32_t>& stack) {
  ViewIndex best = stack.first();
  std::size_t most = 0;
  for (int i = 0; i < stack.grid().count(); ++i) {
    const ViewIndex view{stack.first().v + i / stack.grid().u,
                         stack.first().u + i % stack.grid().u};
    const Census census = count(stack.view(view));
    const bool is_mixed = census.zeros > 0 && census.nones > 0;
    const std::size_t painted =
        census.painted + (is_mixed ? std::min(census.zeros, census.nones) : 0);
    if (painted > most) {
      most = painted;
      best = view;
    }
  }
  return best;
}

bool contains_zero(const ViewStack<std::int32_t>& labels) {
  return !labels.empty() && std::find(labels.data(), labels.data() + labels.size(), 0) !=
                                labels.data() + labels.size();
}

Scribbles read_scribbles(const Hdf5Input& file, const FieldShape& shape, const Progress& progress) {
  const ViewStack<std::int32_t> stack = read_maps<std::int32_t>(file, "SCRIBBLES", shape, progress);
  Scribbles scribbles;
  scribbles.view = painted_view(stack);
  const auto stored = stack.view(scribbles.view);
  scribbles.labels = Image<std::int32_t>(shape.height, shape.width);
  std::copy_n(stored.data, stored.size(), scribbles.labels.data());
  const std::vector<double> stated = file.numbers("/", "scribble_view");
  if (stack.grid().count() == 1 && stated.size() == 2) {
    const ViewIndex view{static_cast<int>(stated[0]), static_cast<int>(stated[1])};
    if (!shape.grid.contains(view)) {
      throw IoError(file.path(), "the attribute scribble_view names view (" +
                                     std::to_string(view.v) + ", " + std::to_string(view.u) +
                                     "), which the light field does not have; correct it");
    }
    scribbles.view = view;
  }
  return scribbles;
}

}  // namespace

ArchiveLabels read_archive_labels(const Hdf5Input& file, const FieldShape& shape,
                                  ConventionReport& report, const Progress& progress) {
  ArchiveLabels found;
  if (file.has("GT_LABELS")) {
    found.labels = read_maps<std::int32_t>(file, "GT_LABELS", shape, progress.part(0, 0.9));
  }
  if (!file.has("SCRIBBLES")) return found;
  found.scribbles = read_scribbles(file, shape, progress.part(0.9, 1));

  const Census census = count(found.scribbles.labels.view());
  const bool is_zero_a_label =
      census.zeros > 0 && census.nones > census.zeros && contains_zero(found.labels);
  for (std::int32_t& label : found.scribbles.labels) {
    if (is_none(label)) {
      label = 0;
    } else if (is_zero_a_label) {
      ++label;
    }
  }
  if (is_zero_a_label) {
    std::for_each(found.labels.data(), found.labels.data() + found.labels.size(),
                  [](std::int32_t& label) { ++label; });
    report.warnings.push_back(
        "Labels begin at 0 in this file and unpainted pixels are marked otherwise: all labels are "
        "raised by one, so that 0 means unpainted.");
  }
  if (std::all_of(found.scribbles.labels.begin(), found.scribbles.labels.end(),
                  [](std::int32_t label) { return label == 0; })) {
    found.scribbles = {};
  }
  return found;
}

}  // namespace episcope::io
