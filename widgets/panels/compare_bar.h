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

/// Chooses A (shown) and B (compared), with buttons for actions on both. Setters never emit.
class CompareBar : public QWidget {
  Q_OBJECT

 public:
  struct Choice {
    quint64 id = 0;
    QString name;
  };

  explicit CompareBar(QWidget* parent = nullptr);

  /// Adds a button for an action, in order of the calls.
  void addAction(QAction* action, const QString& object_name);
  /// Available results, with A and B; 0 = none: `other` then names what replaces B, e.g. "truth".
  void setChoices(const std::vector<Choice>& choices, quint64 a, quint64 b, const QString& other);

 signals:
  void aChosen(quint64 id);
  void bChosen(quint64 id);

 private:
  QComboBox* a_;
  QComboBox* b_;
  QHBoxLayout* buttons_;
};

/// Region that metrics evaluate, and its number of pixels. Setters never emit.
class RegionBar : public QWidget {
  Q_OBJECT

 public:
  explicit RegionBar(QWidget* parent = nullptr);

  /// Adds a button for the action.
  void addAction(QAction* action, const QString& object_name);
  /// Available regions, in order.
  void setParts(const QStringList& names);
  void setCurrent(int part);
  /// "1 024 px", or why nothing is evaluated.
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
