// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/io/base/append_log.h"
#include "engine/io/base/files.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace episcope::io {

/// What a draft of a result holds.
struct DraftShape {
  MapGeometry maps;
  bool has_valid = false;   ///< Whether some pixels may be marked as not valid.
  bool has_layers = false;  ///< Whether it holds two layers as well.
  int kept = 0;             ///< Maps beside it that passes keep for later ones.
};

/// Bytes of a file and where they are.
struct FileExtent {
  std::uintmax_t offset = 0;
  std::vector<std::uint8_t> bytes;
};

/// The maps of a draft, in the order in which they are made; masks of valid pixels last.
enum class DraftMap {
  Disparity,
  Confidence,
  Foreground,
  Background,
  Layers,
  Valid,
  ForegroundValid,
  BackgroundValid
};

/// An HDF5 file with the maps of a result, of which blocks are written in any order, without the
/// library. Members throw IoError that names `target`.
class DraftFile {
 public:
  /// Makes the file at `path`, whole but for the values of the maps. Throws IoError also if the
  /// disk has no room for these.
  static void create(const std::filesystem::path& path, const DraftShape& shape,
                     const std::filesystem::path& target);

  DraftFile() = default;
  /// Opens a file that `create` made.
  DraftFile(const std::filesystem::path& path, const DraftShape& shape,
            const std::filesystem::path& target);

  /// All but the maps.
  [[nodiscard]] std::vector<FileExtent> rest() const;
  [[nodiscard]] std::uintmax_t byte_size() const;
  /// Makes all but the maps of a file what it was, whatever was added or is damaged. Throws IoError
  /// that names `path`.
  static void restore(const std::filesystem::path& path, const std::vector<FileExtent>& rest,
                      std::uintmax_t byte_size);

  [[nodiscard]] BlockMaps read(const MapBlock& block) const;
  /// Is on the disk when it returns. Disparity is NaN where it is not valid.
  void write(const MapBlock& block, const BlockMaps& maps) const;
  /// The same into another file, from its beginning, and from there to where it belongs;
  /// `has_valid` tells whether the block had a mask.
  void write_aside(const FileDescriptor& aside, const MapBlock& block, const BlockMaps& maps) const;
  void take_from(const FileDescriptor& aside, const MapBlock& block, bool has_valid) const;

 private:
  // A dataset.
  struct Place {
    DraftMap map;
    std::uintmax_t offset = 0;
  };

  [[nodiscard]] std::uintmax_t at(const Place& place, ViewIndex view, int row) const;
  [[nodiscard]] std::uintmax_t map_bytes(const Place& place) const;
  void require(bool is_done) const;
  void write_strips(const FileDescriptor& to, bool is_aside, const MapBlock& block,
                    const BlockMaps& maps) const;

  std::filesystem::path target_;
  DraftShape shape_;
  FileDescriptor file_;
  std::vector<Place> places_;  // By offset.
};

/// A file of maps that passes of a run in blocks keep for later ones, one after the other, each
/// float32 `[v][u][y][x]`, without a header. Members throw IoError that names `target`.
class KeptMaps {
 public:
  /// How large the file of `count` maps is.
  [[nodiscard]] static std::uintmax_t byte_size(const MapGeometry& maps, int count);
  /// Makes the file at `path`, whatever is there. Throws IoError also if the disk has no room.
  static void create(const std::filesystem::path& path, const MapGeometry& maps, int count,
                     const std::filesystem::path& target);

  KeptMaps() = default;
  /// Opens a file that `create` made.
  KeptMaps(const std::filesystem::path& path, const MapGeometry& maps,
           const std::filesystem::path& target);

  [[nodiscard]] ViewStack<float> read(const MapBlock& block, int number) const;
  /// All of a block, from number 0 on; is on the disk when it returns.
  void write(const MapBlock& block, const std::vector<ViewStack<float>>& kept) const;

 private:
  [[nodiscard]] std::uintmax_t at(int number, ViewIndex view, int row) const;
  void require(bool is_done) const;

  std::filesystem::path target_;
  MapGeometry maps_;
  FileDescriptor file_;
};

/// A result file that is filled block by block, each of which is on the disk before the next, and
/// that survives the end of the program at any instant: `NAME.partial` beside the result, which it
/// becomes when it is complete, `NAME.partial.kept` with what passes keep for later ones, and
/// `NAME.partial.log`, which says of what run it is, how far that has come, and how to undo or redo
/// what was being written. Members throw IoError.
class ResultDraft {
 public:
  /// Continues the draft that a run of the same `identity` (one line) left, or begins one, in the
  /// place of one of another run. Throws IoError also if there is not enough room for all of it, or
  /// if another program is writing it.
  ResultDraft(const std::filesystem::path& result, const DraftShape& shape,
              const std::string& identity);

  /// What was there: nothing, a draft of another run, or one that is continued.
  enum class Found { Nothing, Other, Same };
  [[nodiscard]] Found found() const { return found_; }

  [[nodiscard]] const BlockProgress& progress() const { return progress_; }
  /// Disparity and confidence as they were written last.
  [[nodiscard]] BlockMaps read(const MapBlock& block) const { return file_.read(block); }
  [[nodiscard]] ViewStack<float> read_kept(const MapBlock& block, int number) const {
    return kept_.read(block, number);
  }

  void note(const BlockProgress& after);
  /// Writes a block, and notes the progress once it is on the disk. With `replaces`, what was there
  /// is either replaced as a whole and the progress noted, or neither. What is kept beside it for
  /// later passes is written first.
  void write(const MapBlock& block, const BlockMaps& maps, const BlockProgress& after,
             bool replaces);

  /// Makes it the result file. `source` as in write_result.
  void commit(const Provenance& provenance, const std::string& source);

 private:
  [[nodiscard]] bool has_files() const;
  void open_files();
  void begin(const std::string& identity);
  void continue_with(const std::vector<LogRecord>& records);
  [[nodiscard]] std::string rest_text() const;
  void restore(const std::string& rest) const;
  void remove_others() const;

  std::filesystem::path result_, draft_, log_path_, aside_path_, kept_path_;
  DraftShape shape_;
  Found found_ = Found::Nothing;
  std::optional<AppendLog> log_;
  DraftFile file_;
  KeptMaps kept_;
  BlockProgress progress_;
};

}  // namespace episcope::io
