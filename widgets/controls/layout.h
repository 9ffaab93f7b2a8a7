// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QBoxLayout>
#include <QMargins>
#include <QSplitter>
#include <QString>

#include <initializer_list>

class QLabel;
class QToolButton;
class QWidget;

namespace episcope {

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

}  // namespace episcope
