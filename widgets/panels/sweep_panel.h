// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/controls/line_plot.h"

#include <QCheckBox>
#include <QComboBox>
#include <QPushButton>
#include <QString>
#include <QStringList>
#include <QToolButton>
#include <QWidget>

#include <array>
#include <vector>

class QHBoxLayout;
class QLabel;
class QLineEdit;

namespace episcope {

class ElidedLabel;

/// Sweeps over one or two parameters of a method: the plan of the next one, its progress, existing
/// sweeps, and two plots of one of them whose points can be clicked. Setters never emit.
class SweepPanel : public QWidget {
  Q_OBJECT

 public:
  /// A parameter that can be varied.
  struct Parameter {
    QString key;
    QString label;             ///< With its unit.
    QString values;            ///< Proposed, as the user would type them.
    bool is_searched = false;  ///< A search varies it, too: such a one is proposed first.
  };
  /// The requested sweep; `key` is empty without a chosen parameter.
  struct Choice {
    QString key;
    QString values;
  };

  explicit SweepPanel(QWidget* parent = nullptr);

  /// Keeps the choice if its parameter still exists and `method` is unchanged.
  void setMethod(const QString& method, const QString& title,
                 const std::vector<Parameter>& parameters);
  /// Describes the sweep that Run starts, or why it cannot.
  void setPlan(const QString& plan, bool can_run);
  void setRunning(bool is_running) { cancel_->setEnabled(is_running); }
  /// Number of open light fields; with several, a sweep can cover all.
  void setSceneCount(int count);
  /// Existing sweeps and the shown one; −1 = none.
  void setSweeps(const QStringList& titles, const std::vector<quint64>& ids, int shown);
  /// Light fields to plot; empty = no choice. Keeps the chosen index if the names are unchanged.
  void setScenes(const QStringList& names);
  /// Names of measures. Keeps the shown ones if they remain, else shows `first` and `second`.
  void setMeasures(const QStringList& names, int first, int second);
  /// A null text enables the plots; else it replaces them.
  void setPlots(const Plot& upper, const Plot& lower, const QString& instead = {});
  /// The chosen point: its places in both plots, its description, and its actions.
  void setChosen(std::array<std::optional<PlotPlace>, 2> places, const QString& text, bool can_keep,
                 bool can_use);
  void setExportable(bool can_export) { export_->setEnabled(can_export); }

  /// First and second parameter.
  [[nodiscard]] std::array<Choice, 2> choices() const;
  /// Indices of the measures of upper and lower plot.
  [[nodiscard]] std::array<int, 2> measures() const;
  [[nodiscard]] bool isOnAllScenes() const { return everywhere_->isChecked(); }
  /// Index among the names of `setScenes`; 0 without a choice.
  [[nodiscard]] int scene() const { return std::max(0, scenes_->currentIndex()); }
  [[nodiscard]] bool isExportable() const { return export_->isEnabled(); }

 signals:
  void planEdited();
  void runRequested();
  void cancelRequested();
  void measureChosen();
  /// `plot`: 0 is the upper one.
  void pointChosen(int plot, episcope::PlotPlace place);
  void sweepChosen(quint64 id);
  void sceneChosen();
  void removeRequested();
  void keepRequested();
  void useRequested();
  void exportRequested();

 private:
  struct Row {
    QComboBox* parameter;
    QLineEdit* values;
  };
  struct Part {
    QComboBox* measure;
    LinePlot* plot;
  };
  Row makeRow(const QString& name, const QString& accessible);
  Part makePart(int number, const QString& name, const QString& accessible);
  QHBoxLayout* makeSweepRow();
  QHBoxLayout* makeButtons();
  QHBoxLayout* makeActions();
  void propose(const Row& row);

  QString method_;
  std::vector<Parameter> parameters_;
  ElidedLabel* title_;
  std::array<Row, 2> rows_;
  QLabel* plan_;
  QPushButton* run_;
  QPushButton* cancel_;
  QCheckBox* everywhere_;
  QComboBox* sweeps_;
  QComboBox* scenes_;
  QToolButton* remove_;
  QToolButton* export_;
  std::array<Part, 2> parts_;
  ElidedLabel* chosen_;
  QPushButton* keep_;
  QPushButton* use_;
};

}  // namespace episcope
