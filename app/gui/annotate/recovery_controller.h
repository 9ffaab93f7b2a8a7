// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/annotation_journal.h"

#include <QObject>

#include <optional>
#include <vector>

namespace episcope {

class MessageBar;

/// Offers the journals of crashed sessions one after the other, in a bar that does not block.
class RecoveryController : public QObject {
  Q_OBJECT

 public:
  explicit RecoveryController(const Workbench& bench);

  /// Looks for journals in the background and offers the latest.
  void look();

 private:
  [[nodiscard]] bool isOpen(const JournalOwner& owner) const;
  void offerNext();
  void recover(const RecoverableJournal& journal);
  void open(const JournalOwner& owner);
  void discard(const RecoverableJournal& journal);
  void read(const RecoverableJournal& journal);
  void takeOver(const RecoverableJournal& journal, RecoveredAnnotation found, std::uint64_t sample_hash);
  void refuse(const QString& sentence);

  Workbench bench_;
  Session& session_;
  DocumentController& document_;
  MessageBar* bar_;
  std::vector<RecoverableJournal> left_;       // the one to be offered next comes last
  std::optional<RecoverableJournal> awaited_;  // its light field is being opened
  LatestJob job_;
};

}  // namespace episcope
