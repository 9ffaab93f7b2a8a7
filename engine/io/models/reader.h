// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/io/base/files.h"
#include "engine/io/models/open_options.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace episcope::io {

/// Thrown for a sound file that holds labels, maps or other data, but no light field.
class NoLightField : public IoError {
 public:
  using IoError::IoError;
};

/// Content of a light field according to its headers, before anything is decoded. Unknown values
/// are 0 or empty.
struct SceneProbe {
  GridShape grid{};
  int height = 0;
  int width = 0;
  int channels = 0;
  std::optional<SampleType> sample_type{};
  std::string truth{};   ///< "disparity of all views"; empty = none.
  std::string labels{};  ///< "labels of all views, scribbles"; empty = none.
  int list = 0;          ///< Views of a list whose rows and columns only its images tell.
  int frames = 0;        ///< Of a sequence of light fields; 0 = a single one.
};

/// Format of light fields that can be opened: one row of the table, one unit in `formats`.
struct Reader {
  const char* id;    ///< Stored with results: "archive".
  const char* name;  ///< As in a sentence: "a light field of the 2013 archive".
  /// Keys of the reading options (`open_schema`) that the format uses, besides the focus plane and
  /// the options that `assemble` handles.
  std::span<const char* const> options;
  /// Returns the file or folder to read for `path`: `path` itself, or something beside or around
  /// it. Empty for another format. Throws IoError for a damaged file.
  std::filesystem::path (*find)(const std::filesystem::path& path, const OpenOptions& options);
  /// Reads what `find` found. Throws IoError, InvalidInput for a bad option, Cancelled.
  Scene (*read)(const std::filesystem::path& found, const OpenOptions& options,
                const Progress& progress);
  /// Reads the headers of what `find` found, within milliseconds. Null = headers tell nothing but
  /// the format. Throws NoLightField, and IoError for files that headers show to be unreadable.
  SceneProbe (*probe)(const std::filesystem::path& found, const OpenOptions& options) = nullptr;

  /// Whether the option has an effect on this format; false for the focus plane.
  [[nodiscard]] bool has_option(std::string_view key) const;
};

/// All readers, in the order of precedence. The table is in open.cpp; readers that ask others are
/// below it.
[[nodiscard]] std::span<const Reader> readers();

/// Reader of a path, and the file or folder to read. `reader` is null if there is none.
struct FoundReader {
  const Reader* reader = nullptr;
  std::filesystem::path path;
};
/// Finds the first reader that recognizes `path`. Throws IoError if there is no such path, and for
/// a damaged file.
[[nodiscard]] FoundReader find_reader(const std::filesystem::path& path,
                                      const OpenOptions& options);

/// Finds the reader with this id; null for an unknown one.
[[nodiscard]] const Reader* reader_named(const std::string& id);

/// Folder of a scene of images if `path` is the folder, one of its images or its parameters.cfg;
/// else empty.
[[nodiscard]] inline std::filesystem::path scene_folder(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) return path;
  if (path.filename() != "parameters.cfg" && !is_image_name(path)) return {};
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

/// Whether the options describe names of an image grid, which excludes other formats of a folder.
[[nodiscard]] inline bool wants_image_grid(const OpenOptions& options) {
  return !options.pattern.empty() || options.snake;
}

/// Short name of a scene for lists and titles: the name of its folder for a folder and for lf.h5,
/// else the name of the file without suffix. A folder called "lf" takes the name of its parent.
[[nodiscard]] inline std::string scene_name(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::path whole = std::filesystem::absolute(path, error).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  const bool is_folder = std::filesystem::is_directory(whole, error);
  const std::string name = is_folder ? whole.filename().string() : whole.stem().string();
  return name == "lf" ? whole.parent_path().filename().string() : name;
}

}  // namespace episcope::io
