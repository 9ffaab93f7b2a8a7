// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/core/view_stack.h"
#include "engine/io/models/labels/label_pictures.h"
#include "engine/io/models/labels/label_views.h"
#include "engine/io/models/stored_maps.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// Of an open light field. Names are known where its views are files of one folder that tell rows
/// and columns.
[[nodiscard]] LabelPlaces label_places(const Scene& scene);

/// Whether a file or folder holds labels and no light field, by its name or, of arrays, by what is
/// in it: a picture, JSON, `.npy` of at most four axes, labels in HDF5; with the `shape` of the
/// light field, other arrays that are its labels by size and name; a folder of labelme, COCO, VOC,
/// CVAT or of exported strokes.
[[nodiscard]] bool holds_labels_only(const std::filesystem::path& path,
                                     const FieldShape* shape = nullptr);

/// Whether an HDF5 file holds labels in the form of Episcope or the archive, with names and colors.
/// Throws IoError for a damaged file.
[[nodiscard]] bool has_own_labels(const std::filesystem::path& path);

/// Reads labels of other programs, in the order of the canonical grid:
/// - pictures: PNG, BMP, PGM, TIFF of any integers; pages of a TIFF are the views, row by row;
/// - arrays: `.npy`, `.npz`, `.mat` of version 5 to 7.3, HDF5, also of ilastik (`axistags`), of one
///   view, of all views in a row or in the grid;
/// - JSON: labelme, and COCO, whose pictures are the views of their names; others are left out with
///   a note. Ids of labelme's names are those of the light field's labels of the same name, else
///   free ones.
///
/// A file of one view belongs to the view whose file has its name (`LabelPlaces::names`), else to
/// the one whose row and column are numbers of its name ("04_05_labels.png"): of more than two,
/// those that vary from file to file, else the last two, with a note where others may be meant. A
/// file alone that tells neither is of the center view, with a note if its numbers are of no view;
/// several that tell nothing are all views, by their running number. Of a folder, all files of
/// labels in it are read: of `scribbles_VV_UU.png` only those, of a VOC folder those in
/// `SegmentationClass`, of a COCO folder those in `annotations`. Colors of `labelmap.txt` beside
/// them count where no table is given. Throws IoError that says what is expected: no labels,
/// another size than the views have, fractions, a JPEG picture, several arrays that fit. Throws
/// Cancelled.
[[nodiscard]] ImportedLabels read_label_files(const std::vector<std::filesystem::path>& paths,
                                              const LabelPlaces& places,
                                              const LabelReading& reading = {},
                                              const Progress& progress = Progress());

/// Reads labels for a scene: SCRIBBLES, LABELS or GT_LABELS of a file of Episcope or the archive,
/// else as `read_label_files`. Moves labels to the focus plane of the scene (shear.h). Throws
/// IoError, Cancelled.
[[nodiscard]] ImportedLabels read_labels(const std::vector<std::filesystem::path>& paths,
                                         const Scene& scene, const LabelReading& reading,
                                         const Progress& progress);

/// Labels as maps: of all views, 0 in those without labels, or of the only one.
[[nodiscard]] ViewStack<std::int32_t> stack_of(const Scribbles& labels, const FieldShape& shape);

/// Gives labels that are `taken`, which is what the light field has, the id there of the label of
/// their name; a label without a name that tells more than its id keeps that. Labels of other names
/// whose ids are taken, and ids above `most`, get free ids from 1 to `most`, smallest first; those
/// without a name are named by their former ids. Returns a sentence about changed ids; empty if
/// there are none. Throws InvalidInput if there are more labels than ids.
std::string renumber_labels(Scribbles& labels, std::int32_t most,
                            const std::vector<LabelInfo>& taken = {});

}  // namespace episcope::io
