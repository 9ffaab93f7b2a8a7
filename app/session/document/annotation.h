// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/document/annotation_journal.h"

#include <filesystem>
#include <optional>

namespace episcope {

/// The document painted on a light field, with the journal that survives a crash. The journal
/// begins with the first edit, so that merely looking leaves no file.
class Annotation {
 public:
  /// Keeps journals in `folder`; none if that is empty.
  Annotation(AnnotationDocument document, JournalOwner owner, std::filesystem::path folder);
  Annotation(const Annotation&) = delete;
  Annotation& operator=(const Annotation&) = delete;

  [[nodiscard]] AnnotationDocument& document() { return document_; }
  [[nodiscard]] const AnnotationDocument& document() const { return document_; }

  /// LightField::sample_hash for a journal that is begun later; until then it is unknown, 0.
  void set_sample_hash(std::uint64_t hash) { owner_.sample_hash = hash; }
  /// Where the document was saved last; a later crash does not forget it. Throws IoError if the
  /// journal cannot be written.
  void set_file(const std::string& file);
  [[nodiscard]] const std::string& file() const { return owner_.file; }
  /// What opens the light field now, which was moved. Throws IoError likewise.
  void set_source(const std::string& source);
  /// Begins the journal unless it is there, or is not wanted. To be called before each edit. Throws
  /// IoError if it cannot be kept: then there will be none.
  void keep_journal();
  [[nodiscard]] bool has_journal() const { return journal_.has_value(); }
  /// Precondition: there is one.
  [[nodiscard]] const std::filesystem::path& journal_path() const { return journal_->path(); }
  /// Abandons the journal, which can no longer be written.
  void drop_journal();
  /// The session ended normally or its changes were discarded: the journal is removed.
  void finish();

 private:
  AnnotationDocument document_;
  JournalOwner owner_;
  std::filesystem::path folder_;
  std::optional<AnnotationJournal> journal_;
};

}  // namespace episcope
