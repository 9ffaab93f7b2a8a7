// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/document/document_controller.h"

#include <QObject>

namespace episcope {

/// The current label of the document: the one painted with and whose probability is shown.
class LabelChoice : public QObject {
  Q_OBJECT

 public:
  LabelChoice(DocumentController& document, QObject* parent);

  /// Id of the current label; 0 without labels.
  [[nodiscard]] int current() const { return current_; }
  /// The same with name and colour; null without labels.
  [[nodiscard]] const LabelInfo* info() const;
  /// Returns whether there is such a label.
  bool choose(int id);
  void chooseNext();
  /// Back to the label before this one.
  void swap();

 signals:
  /// The current label is another one, or has another name or colour.
  void changed();

 private:
  void followDocument();
  [[nodiscard]] bool isKnown(int id) const;

  DocumentController& document_;
  int current_ = 0;
  int former_ = 0;
};

}  // namespace episcope
