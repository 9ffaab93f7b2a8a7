// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>
#include <QPointer>
#include <QWidget>

#include <vector>

namespace episcope {

/// Widgets that float at the top of an area, under the captions there and below each other, each as
/// high as it needs to be: nothing moves when they come and go.
class Floating : public QObject {
  Q_OBJECT

 public:
  /// `parent` is that of the widgets; it outlives this.
  explicit Floating(QWidget& parent);

  /// They float over this descendant of the parent; over the parent until it is set.
  void setArea(QWidget* area);
  /// Adds one below those that are there, and makes it a child of the parent.
  void add(QWidget* widget);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place();

  QWidget& parent_;
  QPointer<QWidget> area_;
  std::vector<QPointer<QWidget>> widgets_;
};

}  // namespace episcope
