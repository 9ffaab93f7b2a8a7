// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/open_options.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace episcope::io {

/// A file is sound, but holds labels, maps or other things and no light field.
class NoLightField : public IoError {
 public:
  using IoError::IoError;
};

/// What the headers of a light field tell of it, before anything is decoded. Values that they do
/// not tell are 0 or empty.
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

/// Every reader, in the order in which they are asked: the first that recognises a path reads it.
/// Readers that ask others (mosaics, sequences) stand below the table, which is in open.cpp.
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

/// Whether a file or folder can be reached; of a link that leads to itself, false.
[[nodiscard]] inline bool is_there(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::exists(path, error);
}

/// The folder of a scene of images, if `path` is one, one of its images or its parameters.cfg; else
/// empty.
[[nodiscard]] inline std::filesystem::path scene_folder(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) return path;
  if (path.filename() != "parameters.cfg" && !is_image_name(path)) return {};
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

/// Whether names of an image grid are given: then no other form of a folder is meant.
[[nodiscard]] inline bool wants_image_grid(const OpenOptions& options) {
  return !options.pattern.empty() || options.snake;
}

/// Short name of a scene for lists and titles: the folder's name for a folder and for lf.h5, else
/// the file's name without suffix; a folder of views called "lf" goes by the folder that it lies
/// in.
[[nodiscard]] inline std::string scene_name(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::path whole = std::filesystem::absolute(path, error).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  const bool is_folder = std::filesystem::is_directory(whole, error);
  const std::string name = is_folder ? whole.filename().string() : whole.stem().string();
  return name == "lf" ? whole.parent_path().filename().string() : name;
}

}  // namespace episcope::io
