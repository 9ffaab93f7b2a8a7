// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>
#include <QPointer>
#include <QWidget>

#include <vector>

namespace episcope {

/// Widgets that float at the top of another one, below each other, each as high as it needs to be:
/// nothing moves when they come and go.
class Floating : public QObject {
  Q_OBJECT

 public:
  /// `over` is the widget that they float over; it outlives this.
  explicit Floating(QWidget& over);

  /// Adds one below those that are there. It becomes a child of the widget that it floats over.
  void add(QWidget* widget);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place();

  QWidget& over_;
  std::vector<QPointer<QWidget>> widgets_;
};

}  // namespace episcope
