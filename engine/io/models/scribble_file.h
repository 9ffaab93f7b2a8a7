// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/parameter.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/core/view_stack.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/base/hdf5_output.h"
#include "engine/io/models/order/view_axes.h"
#include "engine/io/models/stored_maps.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace episcope::io {

/// If a focus plane is baked into the scene (shear.h), files keep the views as stored: reading
/// moves scribbles to the plane, writing moves them back.

/// Reads the scribbles of `scene` from a file in archive form (labels.h5), in canonical order.
/// Assumes that the file orders views as the files of the light field do. Takes names and colors
/// from the file, which only this program writes. Throws IoError if the file has no SCRIBBLES or
/// they do not fit the light field. Throws Cancelled.
[[nodiscard]] Scribbles read_scribbles(const std::filesystem::path& path, const Scene& scene,
                                       const Progress& progress);

/// Writes scribbles in archive form, with names and colors in attributes that other readers ignore.
/// Preserves everything else in the file, in particular GT_LABELS. With a focus plane, also
/// preserves scribbles outside the moved views. Atomic. Throws IoError, also if the file is not an
/// HDF5 file, holds a light field or belongs to another one, or if a view of `scribbles` does not
/// fit. Throws Cancelled.
void write_scribbles(const std::filesystem::path& path, const Scribbles& scribbles,
                     const Scene& scene, const Progress& progress);

/// Dataset SCRIBBLES of an archive file, with label ids in canonical form.
struct StoredScribbles {
  Scribbles scribbles;  ///< Views in the stored order.
  /// 0 is a label among the true labels of the file, which are to be raised by one.
  bool raises_labels = false;
};

/// Reads SCRIBBLES, which must exist. Unpainted pixels become 0: pixels with the value of the
/// attribute `unpainted`, which this program writes, else pixels of 0, −1 or 255. Ids are raised by
/// one if −1 or 255 prevails and 0 is a label (`has_label_zero`). Takes names and colors from the
/// attributes that `add_scribbles` writes. Throws IoError, Cancelled.
[[nodiscard]] StoredScribbles read_scribble_dataset(const Hdf5Input& file, const FieldShape& shape,
                                                    bool has_label_zero, const Progress& progress);

/// Brings views into canonical order.
void put_in_order(Scribbles& scribbles, GridShape grid, ViewFlip flip);

/// Shape of the file to write scribbles to, and its order of views.
struct ScribblePlace {
  FieldShape shape;
  ViewFlip flip;               ///< From the canonical order to the order of the file.
  bool raises_labels = false;  ///< As StoredScribbles.
};

/// Adds SCRIBBLES as integers (`write_label_maps`): `[y][x]` with the attribute `scribble_view` for
/// one painted view, as in the archive, `[v][h][y][x]` for several. Names and colors go to
/// attributes that other readers ignore: `label_ids`, `label_names` (one per line), `label_colors`
/// (R, G, B each), `unpainted` (0). Throws IoError, Cancelled.
void add_scribbles(Hdf5Output& file, const Scribbles& scribbles, const ScribblePlace& place,
                   const Progress& progress);

/// Reads the true labels (GT_LABELS) of a file in archive form, `[v][u][y][x]` in canonical order.
/// Assumes that the file stores views and labels as the files of the light field do. Omits views
/// that the file lacks. Applies the focus plane of the scene (shear.h). Throws IoError if the file
/// has no GT_LABELS or they do not fit the light field. Throws Cancelled.
[[nodiscard]] ViewStack<std::int32_t> read_true_labels(const std::filesystem::path& path,
                                                       const Scene& scene,
                                                       const Progress& progress);

/// Dataset of the true labels.
inline constexpr const char* kTrueLabels = "GT_LABELS";

/// Files that may hold the labels of an archive file beside it, where they are looked for in this
/// order: `<stem>_labels.h5`, then `labels.h5`; of `lf.h5` only the latter.
[[nodiscard]] std::vector<std::filesystem::path> label_files_of(const std::filesystem::path& file);

/// The first of these that holds true labels or scribbles; `labels.h5` if none does, whether it is
/// there or not.
[[nodiscard]] std::filesystem::path labels_beside(const std::filesystem::path& file);

/// Reads names and colors of labels from attributes of a dataset, which other readers ignore:
/// `label_ids`, `label_names` (one per line), `label_colors` (R, G, B each). Empty if the
/// attributes are missing or inconsistent.
[[nodiscard]] std::vector<LabelInfo> read_label_list(const Hdf5Input& file,
                                                     const std::string& dataset);

/// Writes the attributes that `read_label_list` reads. Throws IoError.
void add_label_list(Hdf5Output& file, const std::string& dataset,
                    const std::vector<LabelInfo>& labels);

/// Writes labels as `write_maps` does, deflated, in the smallest of uint8, uint16 and int32 that
/// holds them; datasets that are added afterwards are plain. Calls `samples` twice for each view.
void write_label_maps(Hdf5Output& file, const std::string& name, const MapGeometry& maps,
                      const Progress& progress,
                      const std::function<const std::int32_t*(ViewIndex)>& samples);
void write_label_maps(Hdf5Output& file, const std::string& name,
                      const ViewStack<std::int32_t>& labels, const Progress& progress);

/// Raises a label by one, to make room for 0 = "none". The largest integer stays.
inline void raise_label(std::int32_t& label) {
  if (label < std::numeric_limits<std::int32_t>::max()) ++label;
}

/// Returns the probabilities of one view, `[y][label][x]`, 0 … 255 for 0 … 1.
using ViewProbabilities = std::function<VolumeView<const std::uint8_t>(ViewIndex)>;

/// Converts probabilities to the form of files, `[y][x][label]` in [0, 1], in an image of that
/// size.
void fill_samples(VolumeView<const std::uint8_t> probabilities, Image<float>& samples);

/// Inverse of `fill_samples`, whose output comes back bit by bit. Other values are clamped to [0,
/// 1] and rounded; NaN becomes 0.
[[nodiscard]] Volume<std::uint8_t> bytes_of(const Image<float>& samples);

/// Content of a segmentation file except its probabilities.
struct StoredSegmentation {
  ViewStack<std::int32_t> labels;
  std::vector<LabelInfo> infos;  ///< By id; includes the labels of the layers of probabilities.
  ParameterSet parameters;
  std::string source;  ///< Path or name of the light field.
  Reading reading{};   ///< How that was read.
  double seconds = 0;
  std::uint64_t sources_hash = 0;  ///< Of strokes and what else was given; 0 = not known.
};

/// Writes a segmentation in canonical order of views. `LABELS` is [v][u][y][x] of integers
/// (`write_label_maps`), or [y][x] with the attribute `view` for a single view; it has names and
/// colors as SCRIBBLES. If `probabilities` is set, `Probabilities` is float [v][u][y][x][label] (or
/// [y][x][label]), with the labels of StoredSegmentation::infos. Attributes of the root:
/// `parameters`, `source`, `seconds`, `version`, `reader`, `reading`, `sources_hash`. Atomic.
/// Throws IoError, Cancelled.
void write_segmentation(const std::filesystem::path& path, const StoredSegmentation& labeling,
                        const ViewProbabilities& probabilities, const Progress& progress);

/// A segmentation file, read view by view.
class SegmentationFile {
 public:
  /// Throws IoError.
  explicit SegmentationFile(const std::filesystem::path& path);

  [[nodiscard]] GridShape grid() const { return grid_; }
  [[nodiscard]] ViewIndex first() const { return first_; }
  [[nodiscard]] bool contains(ViewIndex view) const { return grid_.contains(place(view)); }
  [[nodiscard]] const std::vector<LabelInfo>& infos() const { return infos_; }
  [[nodiscard]] bool has_probabilities() const;
  /// Labels of a view, `[y][x]`. Precondition: `contains(view)`. Throws IoError.
  [[nodiscard]] Image<std::int32_t> labels(ViewIndex view) const;
  /// Probabilities of a view, `[y][x][label]`, labels in the order of `infos`. Precondition:
  /// `has_probabilities` and `contains(view)`. Throws IoError.
  [[nodiscard]] Image<float> probabilities(ViewIndex view) const;
  /// Light field that the segmentation belongs to, as stored; may be empty.
  [[nodiscard]] std::string source() const { return file_.text("/", "source").value_or(""); }
  /// Reading of that light field; unknown for files of former versions.
  [[nodiscard]] Reading reading() const;

 private:
  void require_sound_shape() const;
  void read_first();
  [[nodiscard]] int height() const { return static_cast<int>(shape_[shape_.size() - 2]); }
  [[nodiscard]] int width() const { return static_cast<int>(shape_.back()); }
  [[nodiscard]] ViewIndex place(ViewIndex view) const {
    return {view.v - first_.v, view.u - first_.u};
  }

  Hdf5Input file_;
  Hdf5Shape shape_;
  std::vector<LabelInfo> infos_;
  GridShape grid_{1, 1};
  ViewIndex first_;
};

/// Attributes of the root that tell labels of other strokes apart: the digits, and what they are
/// of.
inline constexpr const char* kSourcesHash = "sources_hash";
inline constexpr const char* kSourcesHashOf = "sources_hash_of";

/// Whether `write_segmentation` wrote the file: it holds LABELS, but neither samples nor scribbles.
/// Throws IoError for a damaged HDF5 file.
[[nodiscard]] bool is_segmentation_file(const std::filesystem::path& path);

/// What to do with such a file where something else is wanted.
inline constexpr const char* kRemedyForLabels =
    "name it with --labels or --scribbles, look at it with show, or make pictures of it with "
    "convert --to labels";

}  // namespace episcope::io
