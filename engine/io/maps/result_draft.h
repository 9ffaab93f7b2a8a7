// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/io/durable/append_log.h"
#include "engine/io/maps/draft_file.h"
#include "engine/io/maps/kept_maps.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope::io {

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
