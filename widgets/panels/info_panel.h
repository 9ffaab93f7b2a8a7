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

/// One fact: a short key, a value of any length, and how it was found out.
struct InfoRow {
  QString key;
  QString value;
  QString check;  ///< "checked against truth: …", drawn quietly below the value; may be empty.
  QString id{};   ///< "order": the value is the object "info.order"; may be empty.
  QAction* action = nullptr;  ///< A command that changes it, as a link below; may be null.
  QString tip{};              ///< What the value says in short; may be empty.
  friend bool operator==(const InfoRow&, const InfoRow&) = default;
};

/// Facts of the scene, the conventions found with their checks, and warnings. Values wrap; what
/// cannot wrap is elided, with the whole of it as tool tip.
class InfoPanel : public QWidget {
  Q_OBJECT

 public:
  explicit InfoPanel(QWidget* parent = nullptr);

  /// An empty title says that there is no light field. Costs nothing if all is as before.
  void setInfo(const QString& title, const std::vector<InfoRow>& rows, const QStringList& warnings);
  /// The command behind the button beside the title; it is disabled with the action.
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
