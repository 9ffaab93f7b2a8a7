// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/plot/line_plot.h"

#include <QString>
#include <QStringList>
#include <QWidget>

#include <array>
#include <vector>

class QComboBox;
class QHBoxLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QToolButton;

namespace episcope {

class ElidedLabel;

/// A sweep over one or two parameters of a method: what is tried, how it goes, and two plots of
/// what it found out, a click on a point of which chooses it. Setters never emit.
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
  /// Names of what can be plotted; those that are shown stay if they are among them, else `first`
  /// and `second` are shown.
  void setMeasures(const QStringList& names, int first, int second);
  /// A null text enables the plots; else it is said in their place.
  void setPlots(const Plot& upper, const Plot& lower, const QString& instead = {});
  /// The point that is shown, in words, with what can be done with it; none = an empty text.
  void setChosen(std::optional<PlotPlace> place, const QString& text, bool can_keep);
  void setExportable(bool can_export);

  /// The first parameter and the second.
  [[nodiscard]] std::array<Choice, 2> choices() const;
  /// Places among the names of the upper and the lower plot.
  [[nodiscard]] std::array<int, 2> measures() const;

 signals:
  /// What is asked for changed.
  void planEdited();
  void runRequested();
  void cancelRequested();
  void measureChosen();
  void pointChosen(episcope::PlotPlace place);
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
  Part makePart(const QString& name, const QString& accessible);
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
  QToolButton* export_;
  std::array<Part, 2> parts_;
  ElidedLabel* chosen_;
  QPushButton* keep_;
  QPushButton* use_;
};

}  // namespace episcope
