// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>
#include <QWidget>

#include <vector>

class QAction;
class QComboBox;
class QHBoxLayout;

namespace episcope {

class ElidedLabel;

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

/// Which part of the view is judged, and how many pixels that is. Setters never emit.
class RegionBar : public QWidget {
  Q_OBJECT

 public:
  explicit RegionBar(QWidget* parent = nullptr);

  /// A button for the action.
  void addAction(QAction* action, const QString& object_name);
  /// Parts that can be chosen, in their order.
  void setParts(const QStringList& names);
  void setCurrent(int part);
  /// "1 024 px", or why nothing is judged.
  void setSummary(const QString& text);
  [[nodiscard]] QString summary() const;

 signals:
  void partChosen(int part);

 private:
  QComboBox* part_;
  ElidedLabel* summary_;
  QHBoxLayout* layout_;
};

}  // namespace episcope
