// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QSplitter>

namespace episcope {

/// A vertical splitter that gives its first part the height that it asks for, and the rest to the
/// second one, but at least `least_rest` pixels; from the first drag of the handle on it leaves
/// both as the user wants them.
class FittingSplitter : public QSplitter {
  Q_OBJECT

 public:
  FittingSplitter(int least_rest, QWidget* parent);

 protected:
  bool event(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fit();

  int least_rest_;
  bool is_dragged_ = false;
};

}  // namespace episcope
