// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>
#include <QStringList>
#include <QToolButton>
#include <QWidget>

#include <vector>

class QScrollArea;

namespace episcope {

class ElidedLabel;

/// A fact: short key, value of any length, and evidence.
struct InfoRow {
  QString key;
  QString value;
  QString check{};  ///< "checked against truth: …", drawn quietly below the value; may be empty.
  QString id{};   ///< "order": the value is the object "info.order"; may be empty.
  QAction* action = nullptr;  ///< A command that changes it, as a link below; may be null.
  QString tip{};              ///< Long form of the value; may be empty.
  friend bool operator==(const InfoRow&, const InfoRow&) = default;
};

/// Facts of the scene, its conventions with their checks, and warnings. Values wrap; unbreakable
/// values are elided, with a tool tip.
class InfoPanel : public QWidget {
  Q_OBJECT

 public:
  explicit InfoPanel(QWidget* parent = nullptr);

  /// Shows facts; an empty title means no light field. Costs nothing without changes.
  void setInfo(const QString& title, const std::vector<InfoRow>& rows, const QStringList& warnings);
  /// Command of the button beside the title, which is disabled with the action.
  void setConventionsAction(QAction* action) { conventions_->setDefaultAction(action); }

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void rebuild();

  std::vector<InfoRow> rows_;
  QStringList warnings_;
  ElidedLabel* title_;
  QToolButton* conventions_;
  QScrollArea* scroll_;
};

}  // namespace episcope
