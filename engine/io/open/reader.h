// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/open/open_options.h"
#include "engine/io/open/scene_probe.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace episcope::io {

/// A form of light fields that can be opened: one row of the table, one pair of files.
struct Reader {
  const char* id;    ///< Stored with results: "archive".
  const char* name;  ///< As in a sentence: "a light field of the 2013 archive".
  /// Keys of the reading options (`open_schema`) that mean something to it, besides the focus
  /// plane and what `assemble` does for all readers.
  std::span<const char* const> options;
  /// The file or folder that would be read for `path`, which may be it, beside it or around it;
  /// empty if the form is another. Throws IoError for a damaged file.
  std::filesystem::path (*find)(const std::filesystem::path& path, const OpenOptions& options);
  /// Reads what `find` found. Throws IoError, InvalidInput for a bad option, Cancelled.
  Scene (*read)(const std::filesystem::path& found, const OpenOptions& options,
                const Progress& progress);
  /// What the headers of what `find` found tell, within milliseconds; null = nothing but the form
  /// is known without reading. Throws NoLightField, IoError for what cannot be read, as far as
  /// headers show it.
  SceneProbe (*probe)(const std::filesystem::path& found, const OpenOptions& options) = nullptr;

  /// Whether the option means something to it; false for the focus plane.
  [[nodiscard]] bool has_option(std::string_view key) const;
};

/// Every reader; if several recognise a path, the first one reads it.
[[nodiscard]] std::span<const Reader> readers();

/// The reader of `path`, and what it reads. `reader` is null if there is none.
struct FoundReader {
  const Reader* reader = nullptr;
  std::filesystem::path path;
};
/// Throws IoError if there is no such path, or for a damaged file.
[[nodiscard]] FoundReader find_reader(const std::filesystem::path& path,
                                      const OpenOptions& options);

/// The reader with this id; null for an unknown one.
[[nodiscard]] const Reader* reader_named(const std::string& id);

}  // namespace episcope::io
