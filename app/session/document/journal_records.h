// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/document/annotation_journal.h"

namespace episcope {

/// What a journal of a document as it is now holds: the owner, the document before the oldest edit
/// of the history, then the steps that lead to the present state.
[[nodiscard]] std::vector<io::LogRecord> journal_records(const JournalOwner& owner,
                                                         const AnnotationDocument& document);

/// One step.
[[nodiscard]] io::LogRecord step_record(const DocumentEvent& event);

/// The document that the records lead to, up to the first invalid one. Throws InvalidInput if one
/// of the first two is.
[[nodiscard]] RecoveredAnnotation replay(const std::vector<io::LogRecord>& records);

}  // namespace episcope
