// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter.h"

#include <QDialog>
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
class QPushButton;
class QScrollArea;

namespace episcope {

class ElidedLabel;
class ParameterForm;

/// What the panel needs to know of a method.
struct MethodDescription {
  std::string id;
  std::string name;
  std::string summary;
  std::string reference;
  bool all_views = false;  ///< Can estimate every view at once.
  std::vector<ParameterDescription> parameters;
};

/// What a run was asked for, by value: changing the form later changes nothing.
struct RunRequest {
  std::string method;
  ParameterSet values;
  bool all_views = false;
};

/// Method, its parameters, Run, Live, Cancel, Reset and Copy as command. Values of a method are
/// kept while another one is chosen.
class MethodPanel : public QWidget {
  Q_OBJECT

 public:
  explicit MethodPanel(QWidget* parent = nullptr);

  void setMethods(std::vector<MethodDescription> methods);
  /// Ignored for an unknown id.
  void setCurrentMethod(const std::string& id);
  /// Chooses method, parameters and views, e.g. those of an earlier result.
  void setRequest(const RunRequest& request);
  /// While running, Cancel is enabled; Run stays so, and queues.
  void setRunning(bool running);
  /// An empty reason enables Run; else it is greyed out and the reason is its tool tip.
  void setRunBlocked(const QString& reason);
  /// Whether every change of the request is to be answered at once.
  void setLive(bool is_live);
  /// How that goes, a few words beside the box of views; they never take room from others.
  void setLiveStatus(const QString& text);
  /// The buttons take the tool tips of what they do, with the keys in them.
  void followTips(const QAction* cancel, const QAction* copy);
  void followLiveTip(const QAction* live);

  /// `method` is empty while there are no methods.
  [[nodiscard]] RunRequest request() const;
  [[nodiscard]] ParameterForm* form() const { return form_; }

  /// As high as the whole form.
  [[nodiscard]] QSize sizeHint() const override;

 signals:
  void runRequested(const episcope::RunRequest& request);
  void cancelRequested();
  void copyCommandRequested(const episcope::RunRequest& request);
  void methodChanged(const QString& id);
  /// Another method, other parameters or other views.
  void requestChanged();
  /// By the user.
  void liveToggled(bool is_live);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  [[nodiscard]] QBoxLayout* layViews();
  [[nodiscard]] QBoxLayout* layRun();
  void connectControls();
  void showMethod(int index);
  void updateReset();
  void updateColors();

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

/// Chooses methods, and light fields to run them on.
class BatchDialog : public QDialog {
  Q_OBJECT

 public:
  struct Row {
    QString id;
    QString name;
    bool is_checked = false;
  };

  BatchDialog(const std::vector<Row>& methods, const std::vector<Row>& scenes, QWidget* parent);

  /// Ids of the rows that are checked, in their order.
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
