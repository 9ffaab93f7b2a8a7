// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/document.h"
#include "engine/io/base/atomic_file.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// Which light field a journal belongs to.
struct JournalOwner {
  std::string name;               ///< Short, for the question whether to recover.
  std::string source;             ///< What opens the light field again.
  std::uint64_t sample_hash = 0;  ///< LightField::sample_hash.
  double focus_px = 0;            ///< Focus plane to bake in after opening (shear.h).
  std::string file{};             ///< Where the document was saved last; empty = nowhere yet.
  friend bool operator==(const JournalOwner&, const JournalOwner&) = default;
};

/// The document of a crashed session.
struct RecoveredAnnotation {
  JournalOwner owner;
  AnnotationDocument document;  ///< With its history.

  /// Whether the document is as it was opened, so that it holds no work.
  [[nodiscard]] bool is_untouched() const {
    return document.history().applied_count() == 0 && !document.has_unsaved_changes();
  }
};

/// Reads a journal: the document after the last complete step. Throws IoError if not even the
/// initial document can be read.
[[nodiscard]] RecoveredAnnotation read_journal(const std::filesystem::path& path);

struct RecoverableJournal {
  std::filesystem::path path;
  JournalOwner owner;
  std::filesystem::file_time_type last_change;
  int strokes = 0;  ///< Edits of pixels that were not saved.
};

/// Journals in `folder` whose session crashed with unsaved changes, the latest first. Skips
/// journals of running sessions and unreadable ones; removes journals without unsaved changes.
[[nodiscard]] std::vector<RecoverableJournal> recoverable_journals(
    const std::filesystem::path& folder);

/// Removes a journal that the user does not want or that was recovered.
void discard_journal(const std::filesystem::path& path);

/// The document painted on a light field, with the journal that survives a crash: a step is in that
/// file when the call that made it returns, and on the disk soon after. The journal begins with the
/// first edit, so that merely looking leaves no file, and stays unless `finish` removes it. At most
/// two times the size of the document with its history and kSlackBytes are kept.
class Annotation {
 public:
  static constexpr std::uintmax_t kSlackBytes = std::uintmax_t{4} << 20;

  /// Keeps journals in `folder`, which is made; none if that is empty.
  Annotation(AnnotationDocument document, JournalOwner owner, std::filesystem::path folder);
  Annotation(const Annotation&) = delete;
  Annotation& operator=(const Annotation&) = delete;

  [[nodiscard]] AnnotationDocument& document() { return document_; }
  [[nodiscard]] const AnnotationDocument& document() const { return document_; }

  /// LightField::sample_hash for a journal that is begun later; until then it is unknown, 0.
  void set_sample_hash(std::uint64_t hash) { owner_.sample_hash = hash; }
  /// Sets where the document was saved last, which a crash does not forget. Throws IoError if the
  /// journal cannot be written.
  void set_file(const std::string& file) { set(&JournalOwner::file, file); }
  [[nodiscard]] const std::string& file() const { return owner_.file; }
  /// Sets what opens the light field, which was moved. Throws IoError as `set_file`.
  void set_source(const std::string& source) { set(&JournalOwner::source, source); }
  /// Begins the journal unless it is there, or is not wanted. To be called before each edit. Throws
  /// IoError if it cannot be kept: then there will be none.
  void keep_journal();
  [[nodiscard]] bool has_journal() const { return log_.has_value(); }
  /// Precondition: there is one.
  [[nodiscard]] const std::filesystem::path& journal_path() const { return path_; }
  /// Abandons the journal, which can no longer be written.
  void drop_journal();
  /// Removes the journal, since the session ended normally or its changes were discarded.
  void finish();

 private:
  void set(std::string JournalOwner::*member, const std::string& value);
  void record(const DocumentEvent& event);
  void rewrite();

  AnnotationDocument document_;
  JournalOwner owner_;
  std::filesystem::path folder_;
  std::filesystem::path path_;
  std::optional<io::AppendLog> log_;
  std::uintmax_t first_bytes_ = 0;  ///< Of the file when it was last written anew,
  JournalOwner written_owner_;      ///< with this owner.
};

/// Records of a journal of the present document: the owner, the document before the oldest edit of
/// the history, then the steps up to the present state.
[[nodiscard]] std::vector<io::LogRecord> journal_records(const JournalOwner& owner,
                                                         const AnnotationDocument& document);

/// The document that the records lead to, up to the first invalid one. Throws InvalidInput if one
/// of the first two is.
[[nodiscard]] RecoveredAnnotation replay(const std::vector<io::LogRecord>& records);

/// Journal of a session that ended unexpectedly, with or without unsaved changes.
struct OrphanedJournal {
  std::filesystem::path path;
  std::filesystem::file_time_type last_change;
};

/// Journals in `folder` that no running session holds, the latest first.
[[nodiscard]] std::vector<OrphanedJournal> orphaned_journals(const std::filesystem::path& folder);

}  // namespace episcope
