// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/scene.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace episcope::io {

/// For which views a form holds maps of a kind.
enum class MapsHeld { None, Center, All };

/// How a form holds float samples.
enum class FloatsHeld {
  None,     ///< They cannot be written.
  Rounded,  ///< To 16 bit.
  Exactly
};

/// Which cameras a form holds.
enum class CamerasHeld {
  None,
  Converging,  ///< Whose plane of zero disparity lies at a finite distance: shift > 0.
  All
};

/// Parts of a scene that a form can hold besides views of 8 and 16 bit.
struct FormContents {
  FloatsHeld floats = FloatsHeld::None;
  MapsHeld disparity = MapsHeld::None;
  bool is_depth = false;    ///< Disparity is held as depth in float, within 2⁻²³ of d + Δx.
  bool has_origin = false;  ///< Whether disparities that are no truth say how they were estimated.
  bool has_layers = false;
  MapsHeld labels = MapsHeld::None;
  bool has_scribbles = false;
  bool has_regions = false;  ///< Region masks of the center view.
  bool has_valid = false;    ///< The mask of valid pixels.
  CamerasHeld camera = CamerasHeld::None;
  bool has_range = false;      ///< The disparity range that files promise.
  bool has_positions = false;  ///< Of the cameras.
  bool has_rows = true;        ///< More than one row of views.
};

/// A form in which light fields can be written: one row of the table.
struct Writer {
  const char* id;    ///< As on the command line: "archive".
  const char* name;  ///< As in a sentence: "the archive form".
  /// Suffixes of its files in lower case, the usual one first; empty = a folder is written.
  std::span<const char* const> suffixes;
  FormContents holds;
  /// Writes the parts that the form can hold; atomic. Throws IoError, also for samples that the
  /// form cannot hold; Cancelled.
  void (*write)(const std::filesystem::path& path, const Scene& scene, const Progress& progress);

  [[nodiscard]] bool writes_folder() const { return suffixes.empty(); }
  [[nodiscard]] bool has_suffix_of(const std::filesystem::path& path) const;
};

/// All writers. Of writers with the same suffix, the first is the usual one.
[[nodiscard]] std::span<const Writer> writers();

/// The writer with this id; null for an unknown one.
[[nodiscard]] const Writer* writer_named(const std::string& id);

/// The first writer of files whose names end as `path` does, of quilts if the name states tiles;
/// null if there is none.
[[nodiscard]] const Writer* writer_of(const std::filesystem::path& path);

/// Lists the parts of a scene that the form cannot hold, a sentence for each kind.
[[nodiscard]] std::vector<std::string> unsupported_parts(const Writer& writer, const Scene& scene);

/// Writes the views as one PNG of lenslets: pixel (x, y) of view (v, u) at (x·columns + u,
/// y·rows + v), 8 or 16 bit as they are. Truth, labels and the camera have no place in it. Atomic.
/// Throws IoError, also for float samples; Cancelled.
void write_eslf(const std::filesystem::path& path, const Scene& scene, const Progress& progress);

}  // namespace episcope::io
