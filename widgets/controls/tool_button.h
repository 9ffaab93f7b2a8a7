// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"

#include <QBoxLayout>
#include <QIcon>
#include <QIconEngine>
#include <QMargins>
#include <QPalette>
#include <QSplitter>
#include <QString>
#include <QStyledItemDelegate>

#include <initializer_list>

class QAction;
class QLabel;
class QToolButton;
class QWidget;

namespace episcope {

/// Icon of resources/icons by name ("open", "play", …) in the text color of the current palette,
/// so that it follows light and dark themes. Null for an unknown name.
[[nodiscard]] QIcon themed_icon(const QString& name);

/// The program's icon, for its windows.
[[nodiscard]] QIcon program_icon();

/// An icon painted once for each size. Qt's own engine leaves the background of a pixmap undefined;
/// here it is transparent.
class PaintedIconEngine : public QIconEngine {
 public:
  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) final;

 protected:
  /// Key that distinguishes this picture from all other icons, including colors.
  [[nodiscard]] virtual QString look(QIcon::Mode mode) const = 0;
};

/// Side of a swatch, logical pixels.
inline constexpr int kSwatchSize = 16;

/// A label's color as an icon, unchanged in selected rows.
[[nodiscard]] QIcon swatch(const Rgb& rgb, const QPalette& palette);

struct ToolButtonText {
  QString name;      ///< Object name.
  const char* icon;  ///< Of `themed_icon`.
  QString tip;
  QString text = {};  ///< Beside the icon; empty = icon alone.
};

/// A flat tool button in the common style.
[[nodiscard]] QToolButton* make_tool_button(const ToolButtonText& text, QWidget* parent);

/// A flat tool button of an action, with its icon, tip and state; takes no focus.
[[nodiscard]] QToolButton* make_action_button(QAction* action, const QString& object_name,
                                              QWidget* parent);

/// Keeps a widget's tool tip equal to its command's, including keys.
void follow_tip(QWidget* widget, const QAction* action);

/// Gives an object its name.
template <class T>
T* named(const QString& name, T* object) {
  object->setObjectName(name);
  return object;
}

/// What stands in a row or column, a widget or a layout, and its share of the room that is left.
struct LayoutPart {
  LayoutPart(QWidget* widget_, int share_ = 0) : widget(widget_), share(share_) {}
  LayoutPart(QLayout* layout_, int share_ = 0) : layout(layout_), share(share_) {}

  QWidget* widget = nullptr;
  QLayout* layout = nullptr;
  int share;
};

/// Empty room that takes what is left.
inline const LayoutPart kRoom(static_cast<QWidget*>(nullptr), 1);

inline constexpr QMargins kStyleMargins{-1, -1, -1, -1};

struct LayoutLook {
  QMargins margins{};  ///< `kStyleMargins`: those of the style.
  int spacing = -1;    ///< −1 = that of the style.
};

/// Lays out parts from top to bottom, or from left to right, in `place` or, if it is null, in
/// another layout.
QVBoxLayout* make_column(QWidget* place, std::initializer_list<LayoutPart> parts,
                         const LayoutLook& look = {});
QHBoxLayout* make_row(QWidget* place, std::initializer_list<LayoutPart> parts,
                      const LayoutLook& look = {});
[[nodiscard]] QHBoxLayout* make_row(std::initializer_list<LayoutPart> parts,
                                    const LayoutLook& look = {});

/// Lays out a panel: a list, or the hint that stands in its place, above a row of buttons.
void lay_out_list(QWidget* panel, QLabel* hint, QWidget* list,
                  std::initializer_list<QToolButton*> buttons);

/// A vertical splitter that gives its first part its preferred height and the rest to the second,
/// but at least `least_rest` pixels. Dragging the handle ends that.
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

/// Draws a second, quieter text in an item's row: at its right end, for which the first text is
/// elided, or in a column right of the longest first text.
class AsideDelegate : public QStyledItemDelegate {
  Q_OBJECT

 public:
  /// Role of the second text in the item's data.
  static constexpr int kAsideRole = Qt::UserRole + 100;

  enum class Place { End, Column };
  AsideDelegate(Place place, QObject* parent);

  void paint(QPainter* painter, const QStyleOptionViewItem& option,
             const QModelIndex& index) const override;
  [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option,
                               const QModelIndex& index) const override;

 protected:
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override;

 private:
  /// Distance from the left edge to the second text.
  [[nodiscard]] int begin(const QStyleOptionViewItem& option, const QModelIndex& index) const;

  Place place_;
};

}  // namespace episcope
