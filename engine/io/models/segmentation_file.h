// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/parameter.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/core/view_stack.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace episcope::io {

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
};

/// Writes a segmentation in canonical order of views. `LABELS` is int32 [v][u][y][x], or [y][x]
/// with the attribute `view` for a single view; it has names and colors as SCRIBBLES. If
/// `probabilities` is set, `Probabilities` is float [v][u][y][x][label] (or [y][x][label]), with
/// the labels of StoredSegmentation::infos. Attributes of the root: `parameters`, `source`,
/// `seconds`, `version`, `reader`, `reading`. Atomic. Throws IoError, Cancelled.
void write_segmentation(const std::filesystem::path& path, const StoredSegmentation& labeling,
                        const ViewProbabilities& probabilities, const Progress& progress);

/// A segmentation file, read view by view.
class SegmentationFile {
 public:
  /// Throws IoError.
  explicit SegmentationFile(const std::filesystem::path& path);
  ~SegmentationFile();

  [[nodiscard]] GridShape grid() const;
  [[nodiscard]] ViewIndex first() const;
  [[nodiscard]] bool contains(ViewIndex view) const;
  [[nodiscard]] const std::vector<LabelInfo>& infos() const;
  [[nodiscard]] bool has_probabilities() const;
  /// Labels of a view, `[y][x]`. Precondition: `contains(view)`. Throws IoError.
  [[nodiscard]] Image<std::int32_t> labels(ViewIndex view) const;
  /// Probabilities of a view, `[y][x][label]`, labels in the order of `infos`. Precondition:
  /// `has_probabilities` and `contains(view)`. Throws IoError.
  [[nodiscard]] Image<float> probabilities(ViewIndex view) const;
  /// Light field that the segmentation belongs to, as stored; may be empty.
  [[nodiscard]] std::string source() const;
  /// Reading of that light field; unknown for files of former versions.
  [[nodiscard]] Reading reading() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Whether `write_segmentation` wrote the file: it holds LABELS, but neither samples nor scribbles.
/// Throws IoError for a damaged HDF5 file.
[[nodiscard]] bool is_segmentation_file(const std::filesystem::path& path);

}  // namespace episcope::io
