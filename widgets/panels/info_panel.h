// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>
#include <QToolButton>
#include <QWidget>

#include <set>
#include <vector>

class QGridLayout;
class QLabel;
class QScrollArea;

namespace episcope {

class ElidedLabel;

/// A fact: short key, value of any length, and evidence.
struct InfoRow {
  QString key;
  QString value;
  QString check{};            ///< "checked against truth: …", behind the arrow; may be empty.
  QString id{};               ///< "order": the value is the object "info.order"; may be empty.
  QAction* action = nullptr;  ///< A command that changes it; may be null.
  QString tip{};              ///< Long form of the value, behind the arrow too; may be empty.
  bool needs_action = false;  ///< Shows the command without a click on the arrow.
  friend bool operator==(const InfoRow&, const InfoRow&) = default;
};

/// Something the user should know of the light field.
struct InfoWarning {
  QString text;
  QString brief{};  ///< One line in its place, which an arrow opens; empty = its first lines.
  QAction* action = nullptr;  ///< A command that may help; may be null.
  bool is_note = false;       ///< It tells what was done, of which all is well.
  friend bool operator==(const InfoWarning&, const InfoWarning&) = default;
};

/// Facts of the scene, its conventions with their checks, and warnings: one line each. An arrow
/// opens the rest of the value, its evidence and what can be done about it.
class InfoPanel : public QWidget {
  Q_OBJECT

 public:
  explicit InfoPanel(QWidget* parent = nullptr);

  /// Shows facts; an empty title means no light field. Costs nothing without changes.
  void setInfo(const QString& title, const std::vector<InfoRow>& rows,
               const std::vector<InfoWarning>& warnings);
  /// Command of the button below the facts, which is disabled with the action, and hidden where a
  /// warning offers it.
  void setConventionsAction(QAction* action) { conventions_->setDefaultAction(action); }

 private:
  void rebuild();
  void addWarning(const InfoWarning& warning, QAction* action, QGridLayout* grid);
  void addRow(const InfoRow& row, QGridLayout* grid);
  QToolButton* makeArrow(const QString& id, const QString& key, QLabel* value,
                         const std::vector<QWidget*>& behind);

  std::vector<InfoRow> rows_;
  std::vector<InfoWarning> warnings_;
  std::set<QString> open_;  ///< Keys of rows whose evidence is shown.
  ElidedLabel* title_;
  QToolButton* conventions_;
  QScrollArea* scroll_;
};

}  // namespace episcope
