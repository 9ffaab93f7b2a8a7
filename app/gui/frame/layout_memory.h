// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QByteArray>
#include <QPointer>
#include <QSplitter>

#include <vector>

namespace episcope {

/// How the user has divided the window: sizes on both sides of splitters, kept in the settings.
class LayoutMemory {
 public:
  /// All splitters in `window` that have an object name of the form "split.NAME"; as they are now
  /// is how `reset` leaves them.
  explicit LayoutMemory(const QWidget& window);

  void save() const;
  void restore() const;
  /// As at first, and forgets what was saved.
  void reset() const;

 private:
  struct Kept {
    QPointer<QSplitter> splitter;
    QByteArray first_state;
  };
  std::vector<Kept> kept_;
};

}  // namespace episcope
