// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QSplitter>
#include <QString>
#include <QStyledItemDelegate>

class QAction;
class QToolButton;
class QWidget;

namespace episcope {

struct ToolButtonText {
  QString name;      ///< Object name.
  const char* icon;  ///< Of `themed_icon`.
  QString tip;
  QString text = {};  ///< Beside the icon; empty = icon alone.
};

/// A flat tool button, the same everywhere.
[[nodiscard]] QToolButton* make_tool_button(const ToolButtonText& text, QWidget* parent);

/// A flat tool button of an action, with its icon, tip and state; it takes no focus.
[[nodiscard]] QToolButton* make_action_button(QAction* action, const QString& object_name,
                                              QWidget* parent);

/// Keeps the tool tip of a widget that of the command behind it, with its keys.
void follow_tip(QWidget* widget, const QAction* action);

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

/// Draws a second, quieter text in the row of an item: at its right end, or in a column right of
/// the longest first text.
class AsideDelegate : public QStyledItemDelegate {
  Q_OBJECT

 public:
  /// Of the item's data: the second text.
  static constexpr int kAsideRole = Qt::UserRole + 100;

  enum class Place { End, Column };
  AsideDelegate(Place place, QObject* parent);

  void paint(QPainter* painter, const QStyleOptionViewItem& option,
             const QModelIndex& index) const override;
  [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option,
                               const QModelIndex& index) const override;

 private:
  /// From the left edge to where the second text may begin.
  [[nodiscard]] int begin(const QStyleOptionViewItem& option, const QModelIndex& index) const;

  Place place_;
};

}  // namespace episcope
