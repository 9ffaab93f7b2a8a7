// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/io/archive/archive_maps.h"
#include "engine/io/order/view_order.h"

namespace episcope::io {

/// The dataset SCRIBBLES of an archive file, with label ids in canonical form.
struct StoredScribbles {
  Scribbles scribbles;  ///< Views in the stored order.
  /// 0 is a label among the true labels of the file, which are to be raised by one.
  bool raises_labels = false;
};

/// Reads SCRIBBLES, which must exist. Unpainted pixels become 0: those with the value of the
/// attribute `unpainted`, where this program has written it, else those of 0, −1 or 255. Where −1
/// or 255 prevails and 0 is a label (`has_label_zero` says that there is one), ids are raised by
/// one. Names and colours come from the attributes that `add_scribbles` writes. Throws IoError,
/// Cancelled.
[[nodiscard]] StoredScribbles read_scribble_dataset(const Hdf5Input& file, const FieldShape& shape,
                                                    bool has_label_zero, const Progress& progress);

/// Brings views into canonical order.
void put_in_order(Scribbles& scribbles, GridShape grid, ViewFlip flip);

/// Where scribbles are written and how the file orders views.
struct ScribblePlace {
  FieldShape shape;
  ViewFlip flip;               ///< From the canonical order to that of the file.
  bool raises_labels = false;  ///< As StoredScribbles.
};

/// Adds SCRIBBLES as int32: `[y][x]` and the attribute `scribble_view` for one painted view, as in
/// the archive, `[v][h][y][x]` for several. Names and colours go to attributes of the dataset that
/// other readers ignore: `label_ids`, `label_names` (one per line), `label_colors` (R, G, B each),
/// `unpainted` (0). Throws IoError, Cancelled.
void add_scribbles(Hdf5Output& file, const Scribbles& scribbles, const ScribblePlace& place,
                   const Progress& progress);

}  // namespace episcope::io
