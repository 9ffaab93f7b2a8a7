// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QWidget>

class QAction;
class QLabel;
class QSlider;

namespace episcope {

/// A slider over the frames of a sequence.
class TimeBar : public QWidget {
  Q_OBJECT

 public:
  explicit TimeBar(QWidget* parent = nullptr);

  /// The button that plays; takes its icon, tip and state from the action.
  void setPlayAction(QAction* action);
  /// Shows frame `frame` of `count`; emits nothing.
  void setFrame(int frame, int count);

 signals:
  void frameChosen(int frame);

 private:
  void showNumber();

  QSlider* slider_;
  QLabel* number_;
};

}  // namespace episcope
