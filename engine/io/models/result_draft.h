// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Contents of a draft of a result.
struct DraftShape {
  MapGeometry maps;
  bool has_valid = false;   ///< Whether some pixels may be marked as not valid.
  bool has_second = false;  ///< Whether it holds a second disparity.
};

/// Bytes of a file and their offset.
struct FileExtent {
  std::uintmax_t offset = 0;
  std::vector<std::uint8_t> bytes;
};

/// The maps of a draft, in the order in which they are made; masks of valid pixels last.
enum class DraftMap { Disparity, Confidence, Second, Valid };

/// An HDF5 file with the maps of a result. Blocks are written in any order, without the HDF5
/// library. Members throw IoError that names `target`.
class DraftFile {
 public:
  /// Creates the file at `path`, complete but for the values of the maps. Throws IoError also if
  /// the disk has no room for them.
  static void create(const std::filesystem::path& path, const DraftShape& shape,
                     const std::filesystem::path& target);

  DraftFile() = default;
  /// Opens a file that `create` made.
  DraftFile(const std::filesystem::path& path, const DraftShape& shape,
            const std::filesystem::path& target);

  /// Everything in the file but the maps.
  [[nodiscard]] std::vector<FileExtent> rest() const;
  [[nodiscard]] std::uintmax_t byte_size() const;
  /// Restores everything in a file but the maps, whatever was added or damaged. Throws IoError that
  /// names `path`.
  static void restore(const std::filesystem::path& path, const std::vector<FileExtent>& rest,
                      std::uintmax_t byte_size);

  [[nodiscard]] BlockMaps read(const MapBlock& block) const;
  /// Writes a block, which is on the disk when it returns. Invalid disparity is NaN.
  void write(const MapBlock& block, const BlockMaps& maps) const;
  /// Write a block to another file, and move it from there to its place; `has_valid` tells whether
  /// the block had a mask.
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
  void require(bool is_done) const {
    if (!is_done) throw write_error(target_);
  }
  void write_strips(const FileDescriptor& to, bool is_aside, const MapBlock& block,
                    const BlockMaps& maps) const;

  std::filesystem::path target_;
  DraftShape shape_;
  FileDescriptor file_;
  std::vector<Place> places_;  // By offset.
};

/// A result file that is filled block by block and survives the end of the program at any instant.
/// Each block is on the disk before the next. `NAME.partial` becomes the result when it is
/// complete. `NAME.partial.log` tells the run, its progress, and how to undo or redo an interrupted
/// write. Members throw IoError.
class ResultDraft {
 public:
  /// Continues the draft of a run with the same `identity` (one line), or begins a new one that
  /// replaces the draft of another run. Throws IoError also if the disk has too little room, or if
  /// another program is writing it.
  ResultDraft(const std::filesystem::path& result, const DraftShape& shape,
              const std::string& identity);

  /// What existed before: nothing, a draft of another run, or one that is continued.
  enum class Found { Nothing, Other, Same };
  [[nodiscard]] Found found() const { return found_; }

  [[nodiscard]] const BlockProgress& progress() const { return progress_; }
  /// Reads disparity and confidence as last written.
  [[nodiscard]] BlockMaps read(const MapBlock& block) const { return file_.read(block); }

  void note(const BlockProgress& after);
  /// Writes a block, then notes the progress once it is on the disk. With `replaces`, the block and
  /// the progress change together or not at all.
  void write(const MapBlock& block, const BlockMaps& maps, const BlockProgress& after,
             bool replaces);

  /// Turns the draft into the result file. `source` as in write_result.
  void commit(const Provenance& provenance, const std::string& source);

 private:
  void begin(const std::string& identity);
  void continue_with(const std::vector<LogRecord>& records);
  [[nodiscard]] std::string rest_text() const;
  void restore(const std::string& rest) const;
  void remove_others() const;

  std::filesystem::path result_, draft_, log_path_, aside_path_;
  DraftShape shape_;
  Found found_ = Found::Nothing;
  std::optional<AppendLog> log_;
  DraftFile file_;
  BlockProgress progress_;
};

}  // namespace episcope::io
