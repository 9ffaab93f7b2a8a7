// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/label_info.h"
#include "engine/core/parameter.h"
#include "engine/core/progress.h"
#include "engine/core/view_stack.h"
#include "engine/core/volume.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace episcope::io {

/// Probabilities of one view, `[y][label][x]`, 0 … 255 for 0 … 1.
using ViewProbabilities = std::function<VolumeView<const std::uint8_t>(ViewIndex)>;

/// As files hold them: `[y][x][label]` in [0, 1], into an image of that size.
void fill_samples(VolumeView<const std::uint8_t> probabilities, Image<float>& samples);

/// The reverse. What `fill_samples` wrote comes back bit by bit; other values are bounded to [0, 1]
/// and rounded, and what is no number becomes 0.
[[nodiscard]] Volume<std::uint8_t> bytes_of(const Image<float>& samples);

/// The content of a segmentation file except its probabilities.
struct StoredSegmentation {
  ViewStack<std::int32_t> labels;
  std::vector<LabelInfo> infos;  ///< By id; those of the layers of probabilities above all.
  ParameterSet parameters;
  std::string source;  ///< Path or name of the light field.
  Reading reading{};   ///< How that was read.
  double seconds = 0;
};

/// Writes a segmentation in canonical order of views: `LABELS` int32 [v][u][y][x],
/// or [y][x] with the attribute `view` for a single one, with names and colours as SCRIBBLES has
/// them; if `probabilities` is set, `Probabilities` float [v][u][y][x][label] (or [y][x][label]) as
/// the archive names it, labels as in StoredSegmentation::infos; attributes of the root:
/// `parameters`, `source`, `seconds`, `version`, `reader`, `reading`. Atomic. Throws IoError,
/// Cancelled.
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
  /// `[y][x][label]`, labels in the order of `infos`. Precondition: `has_probabilities` and
  /// `contains(view)`. Throws IoError.
  [[nodiscard]] Image<float> probabilities(ViewIndex view) const;
  /// Light field that it belongs to, as its file says; empty if it does not.
  [[nodiscard]] std::string source() const;
  /// How that was read; unknown for files of former versions.
  [[nodiscard]] Reading reading() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Whether the file is one that `write_segmentation` wrote: it holds LABELS and neither samples nor
/// what a user painted. Throws IoError if it is an HDF5 file and damaged.
[[nodiscard]] bool is_segmentation_file(const std::filesystem::path& path);

}  // namespace episcope::io
