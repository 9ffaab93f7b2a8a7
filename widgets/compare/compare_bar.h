// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>
#include <QWidget>

#include <vector>

class QAction;
class QComboBox;
class QHBoxLayout;

namespace episcope {

/// Which result is A (shown), which is B (compared), and buttons for what can be done with the two.
/// Setters never emit.
class CompareBar : public QWidget {
  Q_OBJECT

 public:
  struct Choice {
    quint64 id = 0;
    QString name;
  };

  explicit CompareBar(QWidget* parent = nullptr);

  /// A button for the action, in order of the calls.
  void addAction(QAction* action, const QString& object_name);
  /// The results there are, which one is A and which B; 0 = none, then `other` tells what stands in
  /// for B, e.g. "truth".
  void setChoices(const std::vector<Choice>& choices, quint64 a, quint64 b, const QString& other);

 signals:
  void aChosen(quint64 id);
  void bChosen(quint64 id);

 private:
  QComboBox* a_;
  QComboBox* b_;
  QHBoxLayout* buttons_;
};

}  // namespace episcope
