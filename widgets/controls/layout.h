// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QBoxLayout>
#include <QMargins>
#include <QSignalBlocker>
#include <QSplitter>
#include <QString>

#include <initializer_list>

class QAction;
class QComboBox;
class QDialog;
class QDialogButtonBox;
class QGridLayout;
class QLabel;
class QScrollArea;
class QToolButton;
class QTreeWidget;
class QWidget;

namespace episcope {

/// Gives an object its name.
template <class T>
T* named(const QString& name, T* object) {
  object->setObjectName(name);
  return object;
}

/// Calls a control's setter without its signals: Quietly(slider)->setValue(3).
template <class T>
class Quietly {
 public:
  explicit Quietly(T* control) : control_(control), blocker_(control) {}
  T* operator->() const { return control_; }

 private:
  T* control_;
  QSignalBlocker blocker_;
};

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

/// A grid of widgets without margins.
[[nodiscard]] QGridLayout* make_grid(QWidget* place, int horizontal_spacing, int vertical_spacing);

/// Cancel and a default button `name` with this text, which accepts the dialog.
[[nodiscard]] QDialogButtonBox* make_answers(QDialog* dialog, const QString& name,
                                             const QString& text);

/// A list of rows of one height, whose long texts lose their middle.
[[nodiscard]] QTreeWidget* make_list(const QString& name, const QString& accessible_name,
                                     QWidget* parent);

/// An action that Delete triggers in a list.
QAction* add_delete_action(QWidget* list);

/// Whether an item of a combo box can be chosen.
void set_item_enabled(QComboBox* box, int item, bool is_enabled);

/// Lets an area scroll its widget up and down alone, without a frame.
void set_up_scrolling(QScrollArea* area);

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
