// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>
#include <QWidget>

#include <optional>
#include <vector>

class QLabel;
class QToolButton;
class QTreeWidget;

namespace episcope {

inline constexpr quint64 kLiveResult = 0;

struct ResultRow {
  quint64 id = 0;  ///< `kLiveResult`: an estimate that is not kept.
  QString method;
  QString parameters;  ///< Summary; the whole of it is the tool tip.
  double seconds = 0;  ///< 0 = unknown.
  std::optional<double> mse_100;
  QString detail;       ///< Further tool tip: source, notes.
  QString note{};       ///< The user's note.
  QString warning{};    ///< Shown with a warning sign before the parameters.
  bool is_new = false;  ///< It was not shown yet.
};

/// Results of this light field, newest last, with A (shown) and B (compared) marked, and those that
/// were not shown yet. A live one can only be looked at. Choosing a row
/// asks to show it; a click on its mark to compare with it; a double click on its name renames it.
/// Other actions are in buttons and the context menu.
class ResultList : public QWidget {
  Q_OBJECT

 public:
  explicit ResultList(QWidget* parent = nullptr);

  void setResults(const std::vector<ResultRow>& results);
  /// Whether a running method will add a result; an empty list says so.
  void setExpecting(bool is_expecting);
  /// Marks the rows of the shown and the compared result; none = no mark.
  void setShown(std::optional<quint64> id, std::optional<quint64> compared = std::nullopt);

  [[nodiscard]] std::optional<quint64> selectedId() const;

 signals:
  void selected(quint64 id);
  void compareRequested(quint64 id);
  void removeRequested(quint64 id);
  void renameRequested(quint64 id, const QString& name);
  void exportRequested(quint64 id);
  void copyCommandRequested(quint64 id);
  /// The user wants its parameters back in the form.
  void reuseRequested(quint64 id);
  void noteRequested(quint64 id);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void setUpColumns();
  void setUpTree();
  void fitMethods();
  void showMenu(const QPoint& position);
  void editName(quint64 id);
  [[nodiscard]] bool hasRowsOf(const std::vector<ResultRow>& results) const;
  /// Target of the buttons: the selected result, else the shown one.
  [[nodiscard]] std::optional<quint64> target() const;
  void updateButtons();

  QTreeWidget* tree_;
  QLabel* hint_;
  QToolButton* export_;
  QToolButton* remove_;
  QToolButton* reuse_;
  std::optional<quint64> shown_;
  std::optional<quint64> compared_;
};

}  // namespace episcope
