// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/document/annotation.h"

#include "engine/core/error.h"

#include <utility>

namespace episcope {

Annotation::Annotation(AnnotationDocument document, JournalOwner owner,
                       std::filesystem::path folder)
    : document_(std::move(document)), owner_(std::move(owner)), folder_(std::move(folder)) {}

void Annotation::set_file(const std::string& file) {
  owner_.file = file;
  if (journal_) journal_->set_owner(owner_);
}

void Annotation::set_source(const std::string& source) {
  owner_.source = source;
  if (journal_) journal_->set_owner(owner_);
}

void Annotation::keep_journal() {
  if (journal_ || folder_.empty()) return;
  try {
    journal_.emplace(folder_, owner_, document_);
  } catch (const IoError&) {
    folder_.clear();
    throw;
  }
}

void Annotation::drop_journal() {
  journal_.reset();
  folder_.clear();
}

void Annotation::finish() {
  if (journal_) journal_->finish();
  drop_journal();
}

}  // namespace episcope
