// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/document/annotation_journal.h"

#include "app/session/document/journal_records.h"
#include "app/session/document/unheld_journals.h"
#include "app/session/save/file_name.h"
#include "engine/core/error.h"
#include "engine/io/durable/make_folder.h"

#include <cstdio>
#include <random>

namespace episcope {
namespace {

namespace fs = std::filesystem;

fs::path new_path(const fs::path& folder, const std::string& name) {
  std::random_device random;
  char suffix[24];
  std::snprintf(suffix, sizeof suffix, "-%08x", static_cast<unsigned>(random()));
  const std::string stem = file_name_of(name);
  return folder / ((stem.empty() ? "session" : stem) + suffix + kJournalSuffix);
}

}  // namespace

AnnotationJournal::AnnotationJournal(const fs::path& folder, JournalOwner owner,
                                     AnnotationDocument& document)
    : path_(new_path(folder, owner.name)), owner_(std::move(owner)), document_(&document) {
  io::make_folder(folder,
                  ", so nothing painted could be recovered after a crash; create it or make its "
                  "parent writable");
  rewrite();
  document.set_observer([this](const DocumentEvent& event) { record(event); });
}

AnnotationJournal::~AnnotationJournal() {
  document_->set_observer({});
}

void AnnotationJournal::finish() {
  document_->set_observer({});
  discard_journal(path_);
}

void AnnotationJournal::set_owner(JournalOwner owner) {
  if (owner == owner_) return;
  owner_ = std::move(owner);
  rewrite();
}

void AnnotationJournal::record(const DocumentEvent& event) {
  log_->append(step_record(event));
  if (log_->byte_size() > 2 * first_bytes_ + kSlackBytes) rewrite();
}

void AnnotationJournal::rewrite() {
  log_.emplace(path_, io::LogFraming::Checked, io::LogFlush::InBackground,
               journal_records(owner_, *document_));
  first_bytes_ = log_->byte_size();
}

RecoveredAnnotation read_journal(const fs::path& path) {
  try {
    return replay(io::read_log(path, io::LogFraming::Checked));
  } catch (const InvalidInput& error) {
    throw IoError(path, std::string(error.what()) + "; nothing can be recovered");
  }
}

std::vector<LeftJournal> left_journals(const fs::path& folder) {
  std::vector<LeftJournal> left;
  for (const UnheldJournal& each : unheld_journals(folder)) {
    try {
      RecoveredAnnotation found = read_journal(each.path);
      if (found.document.has_unsaved_changes()) {
        left.push_back({each.path, std::move(found.owner), each.last_change});
        continue;
      }
    } catch (const IoError&) {
      // Of a later program, or for the moment not to be read: another start may have more luck.
      if (std::error_code error; fs::file_size(each.path, error) != 0 || error) continue;
    }
    discard_journal(each.path);
  }
  return left;
}

void discard_journal(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

}  // namespace episcope
