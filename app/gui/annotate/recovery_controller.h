// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/document/document_controller.h"
#include "app/gui/frame/jobs.h"
#include "app/session/document/annotation_journal.h"

#include <QObject>

#include <functional>
#include <optional>
#include <vector>

namespace episcope {

class MessageBar;

/// Offers what sessions that died left behind, one after the other, in a bar that blocks nothing.
class RecoveryController : public QObject {
  Q_OBJECT

 public:
  /// Opens a light field by what opened it before, and bakes a focus plane in unless that is 0.
  using Open = std::function<void(const QString& source, double focus_px)>;
  /// Calls back once the present document may be replaced, or never.
  using Leave = std::function<void(std::function<void()> go_on)>;

  RecoveryController(Session& session, DocumentController& document, MessageBar& bar, Open open,
                     Leave leave, QObject* parent);

  /// Looks for journals in the background and offers the latest.
  void look();

 signals:
  void recovered(const QString& name);

 private:
  [[nodiscard]] bool isOpen(const JournalOwner& owner) const;
  void offerNext();
  void recover(const LeftJournal& journal);
  void discard(const LeftJournal& journal);
  void read(const LeftJournal& journal);
  void takeOver(const LeftJournal& journal, RecoveredAnnotation found, std::uint64_t sample_hash);
  void refuse(const QString& sentence);

  Session& session_;
  DocumentController& document_;
  MessageBar& bar_;
  Open open_;
  Leave leave_;
  std::vector<LeftJournal> left_;       // the one to be offered next comes last
  std::optional<LeftJournal> awaited_;  // its light field is being opened
  LatestJob job_;
};

}  // namespace episcope
