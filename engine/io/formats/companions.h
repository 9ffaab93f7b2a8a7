// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/core/view_stack.h"
#include "engine/io/models/segmentation_file.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace episcope::io {

/// edge_weights.h5 and the three files of label probabilities in `folder`, as far as they exist and
/// hold what their names say. A file that is damaged or does not fit the light field is ignored
/// with a warning.
[[nodiscard]] std::vector<Companion> find_companions(const std::filesystem::path& folder,
                                                     const LightField& field,
                                                     ConventionReport& report);

/// Edge probabilities in [0, 1] (dataset EDGE_WEIGHTS) of all views in canonical order,
/// `[v][u][y][x]`, or `[v][u][y][x][2]` if the file has one per direction. Throws IoError, also if
/// they do not fit; Cancelled.
[[nodiscard]] ViewStack<float> read_edge_probabilities(const std::filesystem::path& path,
                                                       const Scene& scene,
                                                       const Progress& progress);

/// Writes edge probabilities of all views as EDGE_WEIGHTS in the order of views of the files of
/// `scene`, to be stored beside them. Atomic. Throws IoError, also if they do not fit the light
/// field; Cancelled.
void write_edge_probabilities(const std::filesystem::path& path, const ViewStack<float>& weights,
                              const Scene& scene, const Progress& progress);

/// The archive's name for a file of this kind, as "edge_weights.h5".
[[nodiscard]] std::string companion_file(CompanionKind kind);

/// Writes label probabilities of all views as `Probabilities` [v][h][y][x][label] in the order of
/// views of the files of `scene`, to be stored beside them; those of a view by `probabilities`, in
/// canonical order. Read by ProbabilityFile and `bytes_of`, they are the same bit by bit. Atomic.
/// Throws IoError, Cancelled.
void write_label_probabilities(const std::filesystem::path& path, int label_count,
                               const ViewProbabilities& probabilities, const Scene& scene,
                               const Progress& progress);

/// Label probabilities of an archive file, read one view at a time because all views take
/// gigabytes.
class ProbabilityFile {
 public:
  /// Finds the axis of labels: the one left when those of the views and pixels of `scene` are taken
  /// away. Throws IoError if the shape does not fit.
  ProbabilityFile(const std::filesystem::path& path, const Scene& scene);
  ~ProbabilityFile();
  ProbabilityFile(ProbabilityFile&&) noexcept;
  ProbabilityFile& operator=(ProbabilityFile&&) noexcept;

  [[nodiscard]] int label_count() const;
  /// Views in the file: all, or the centre view only.
  [[nodiscard]] bool contains(ViewIndex view) const;
  /// `[y][x][label]` of a view in canonical order. Precondition: `contains(view)`. Throws IoError.
  [[nodiscard]] Image<float> view(ViewIndex view) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace episcope::io
