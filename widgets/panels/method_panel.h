// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter.h"
#include "widgets/controls/labels.h"
#include "widgets/controls/parameter_form.h"

#include <QDialog>
#include <QPushButton>
#include <QString>
#include <QWidget>

#include <map>
#include <string>
#include <vector>

class QAction;
class QBoxLayout;
class QCheckBox;
class QComboBox;
class QLabel;
class QListWidget;
class QScrollArea;

namespace episcope {

struct MethodDescription {
  std::string id;
  std::string name;
  std::string summary;
  std::string reference;
  bool all_views = false;  ///< Can estimate every view at once.
  std::vector<ParameterDescription> parameters;
  std::vector<std::string> main_parameters{};  ///< Keys; the form folds the others. Empty = none.
};

/// A requested run, by value: later changes of the form do not affect it.
struct RunRequest {
  std::string method;
  ParameterSet values;
  bool all_views = false;
};

/// Method and parameters, with Run, Live, Cancel, Reset and Copy as command. Remembers the values
/// of each method, but the disparity range goes with the light field from method to method.
class MethodPanel : public QWidget {
  Q_OBJECT

 public:
  explicit MethodPanel(QWidget* parent = nullptr);

  void setMethods(std::vector<MethodDescription> methods);
  /// Ignored for an unknown id.
  void setCurrentMethod(const std::string& id);
  /// Sets method, parameters and views, e.g. from an earlier result.
  void setRequest(const RunRequest& request);
  /// Enables Cancel while running; Run stays enabled and queues.
  void setRunning(bool running) { cancel_->setEnabled(running); }
  /// Disables Run and shows the reason as its tool tip; an empty reason enables it.
  void setRunBlocked(const QString& reason);
  /// Whether every change of the request runs at once.
  void setLive(bool is_live) { live_->setChecked(is_live); }
  /// State of the live estimate in a few words, which never take room from other controls.
  void setLiveStatus(const QString& text) { live_status_->setFullText(text); }
  /// Keeps the buttons' tool tips equal to their commands', including keys.
  void followTips(const QAction* cancel, const QAction* copy);
  void followLiveTip(const QAction* live);

  /// `method` is empty if there are no methods.
  [[nodiscard]] RunRequest request() const;
  [[nodiscard]] ParameterForm* form() const { return form_; }

  /// Height of the whole form.
  [[nodiscard]] QSize sizeHint() const override;

 signals:
  void runRequested(const episcope::RunRequest& request);
  void cancelRequested();
  void copyCommandRequested(const episcope::RunRequest& request);
  void methodChanged(const QString& id);
  /// Method, parameters or views changed.
  void requestChanged();
  /// The user switched Live.
  void liveToggled(bool is_live);

 private:
  void connectControls();
  void showMethod(int index);
  void updateReset() { reset_->setEnabled(!form_->modifiedValues().empty()); }

  std::vector<MethodDescription> methods_;
  std::map<std::string, ParameterSet> kept_values_;
  int shown_ = -1;
  QString blocked_;
  QComboBox* method_;
  QLabel* summary_;
  QLabel* reference_;
  ParameterForm* form_;
  QScrollArea* scroll_;
  QCheckBox* all_views_;
  ElidedLabel* live_status_;
  QPushButton* run_;
  QPushButton* live_;
  QPushButton* cancel_;
  QPushButton* reset_;
  QPushButton* copy_;
};

/// Chooses methods and the light fields to run them on.
class BatchDialog : public QDialog {
  Q_OBJECT

 public:
  struct Row {
    QString id;
    QString name;
    bool is_checked = false;
  };

  BatchDialog(const std::vector<Row>& methods, const std::vector<Row>& scenes, QWidget* parent);

  /// Ids of the checked rows, in order.
  [[nodiscard]] QStringList methods() const;
  [[nodiscard]] QStringList scenes() const;

 private:
  QListWidget* addList(const QString& name, const QString& title, const std::vector<Row>& rows);
  void showCount();

  QListWidget* methods_;
  QListWidget* scenes_;
  QPushButton* run_;
};

}  // namespace episcope
