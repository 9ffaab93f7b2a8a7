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
