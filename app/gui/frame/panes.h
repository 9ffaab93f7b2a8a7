// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QHash>
#include <QObject>
#include <QString>
#include <QStringList>

#include <functional>
#include <vector>

class QWidget;

namespace episcope {

class PaneWindow;

/// A part of the window that can be in a window of its own.
struct Pane {
  QString id;
  QString title;
  QWidget* widget = nullptr;
  std::function<void()> put_back;  ///< Gives the widget its place in the main window again.
};

/// The panes that can be torn off. Those that are stay above the main window, hear its keys, and
/// come back when their own window is closed.
class Panes : public QObject {
  Q_OBJECT

 public:
  /// `home` is in the main window, and outlives this.
  explicit Panes(QWidget& home);
  ~Panes() override;

  void add(Pane pane);
  [[nodiscard]] bool isTorn(const QString& id) const { return windows_.contains(id); }
  /// Opens a window of its own, where and as large as it was the last time. Raises it if there is
  /// one. Ignored for an unknown id.
  void tear(const QString& id);
  /// Back into the main window; ignored if it is there.
  void putBack(const QString& id);
  void toggle(const QString& id);

  /// Remembers in the settings which are torn off; `restore` tears them off again.
  void save() const;
  void restore();
  /// All come back, and their places are forgotten.
  void reset();

 signals:
  /// It was torn off or has come back.
  void changed(const QString& id);
  /// A window was opened, which should hear the keys of the viewer.
  void opened(QWidget* window);

 private:
  [[nodiscard]] const Pane* find(const QString& id) const;
  void remember(const QString& id) const;

  QWidget& home_;
  std::vector<Pane> panes_;
  QHash<QString, PaneWindow*> windows_;
};

}  // namespace episcope
