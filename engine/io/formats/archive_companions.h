// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/core/view_stack.h"
#include "engine/io/models/scribble_file.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace episcope::io {

/// Finds edge_weights.h5 and the three files of label probabilities in `folder` that hold what
/// their names say. A file that is damaged or does not fit the light field is ignored with a
/// warning.
[[nodiscard]] std::vector<Companion> find_companions(const std::filesystem::path& folder,
                                                     const LightField& field,
                                                     ConventionReport& report);

/// Reads edge probabilities in [0, 1] (dataset EDGE_WEIGHTS) of all views in canonical order,
/// `[v][u][y][x]`, or `[v][u][y][x][2]` if the file has one per direction. Throws IoError, also if
/// they do not fit; Cancelled.
[[nodiscard]] ViewStack<float> read_edge_probabilities(const std::filesystem::path& path,
                                                       const Scene& scene,
                                                       const Progress& progress);

/// Writes edge probabilities of all views as EDGE_WEIGHTS, for storage beside the files of `scene`
/// and in their order of views. Atomic. Throws IoError, also if they do not fit the light field;
/// Cancelled.
void write_edge_probabilities(const std::filesystem::path& path, const ViewStack<float>& weights,
                              const Scene& scene, const Progress& progress);

/// The archive's name for a file of this kind, as "edge_weights.h5".
[[nodiscard]] std::string companion_file(CompanionKind kind);

/// Writes label probabilities of all views as `Probabilities` [v][h][y][x][label], for storage
/// beside the files of `scene` and in their order of views. `probabilities` gives a view in
/// canonical order. A round trip by ProbabilityFile and `bytes_of` is exact. Atomic. Throws
/// IoError, Cancelled.
void write_label_probabilities(const std::filesystem::path& path, int label_count,
                               const ViewProbabilities& probabilities, const Scene& scene,
                               const Progress& progress);

/// Label probabilities of an archive file, read one view at a time because all views take
/// gigabytes.
class ProbabilityFile {
 public:
  /// Finds the axis of labels: the one left besides the axes of views and pixels of `scene`. Throws
  /// IoError if the shape does not fit.
  ProbabilityFile(const std::filesystem::path& path, const Scene& scene);

  [[nodiscard]] int label_count() const { return static_cast<int>(layout_.length('c')); }
  /// Views in the file: all, or the center view only.
  [[nodiscard]] bool contains(ViewIndex view) const {
    return layout_.has('v') ? grid_.contains(view) : view == grid_.center();
  }
  /// `[y][x][label]` of a view in canonical order. Precondition: `contains(view)`. Throws IoError.
  [[nodiscard]] Image<float> view(ViewIndex view) const;

 private:
  Hdf5Input file_;
  ArrayLayout layout_;  ///< Labels are channels.
  GridShape grid_;
  ViewFlip flip_;
};

}  // namespace episcope::io
