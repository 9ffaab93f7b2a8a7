// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/controls/line_plot.h"

#include <QString>
#include <QStringList>
#include <QWidget>

#include <array>
#include <vector>

class QCheckBox;
class QComboBox;
class QHBoxLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QToolButton;

namespace episcope {

class ElidedLabel;

/// Sweeps over one or two parameters of a method: what is tried next, how it goes, the sweeps that
/// are there, and two plots of what one of them found out, a click on a point of which chooses it.
/// Setters never emit.
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
  /// What the user asks for; `key` is empty where no parameter is chosen.
  struct Choice {
    QString key;
    QString values;
  };

  explicit SweepPanel(QWidget* parent = nullptr);

  /// What was chosen stays if there is still such a parameter and `method` is the same.
  void setMethod(const QString& method, const QString& title,
                 const std::vector<Parameter>& parameters);
  /// What Run would do, or why it cannot be run.
  void setPlan(const QString& plan, bool can_run);
  void setRunning(bool is_running);
  /// How many light fields are open: with several, a sweep can be over all of them.
  void setSceneCount(int count);
  /// The sweeps that are there, and which of them is shown: −1 = none.
  void setSweeps(const QStringList& titles, const std::vector<quint64>& ids, int shown);
  /// Of which light fields the plots can be; empty = there is no choice. The place that was chosen
  /// stays if the names are the same.
  void setScenes(const QStringList& names);
  /// Names of what can be plotted; those that are shown stay if they are among them, else `first`
  /// and `second` are shown.
  void setMeasures(const QStringList& names, int first, int second);
  /// A null text enables the plots; else it is said in their place.
  void setPlots(const Plot& upper, const Plot& lower, const QString& instead = {});
  /// The point that is shown, where it is in the upper and the lower plot, in words, and what can
  /// be done with it.
  void setChosen(std::array<std::optional<PlotPlace>, 2> places, const QString& text, bool can_keep,
                 bool can_use);
  void setExportable(bool can_export);

  /// The first parameter and the second.
  [[nodiscard]] std::array<Choice, 2> choices() const;
  /// Places among the names of the upper and the lower plot.
  [[nodiscard]] std::array<int, 2> measures() const;
  [[nodiscard]] bool isOnAllScenes() const;
  /// Place among the names of `setScenes`; 0 without a choice.
  [[nodiscard]] int scene() const;
  [[nodiscard]] bool isExportable() const;

 signals:
  /// What is asked for changed.
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
