// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/sweep_panel.h"

#include "widgets/controls/labels.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>

#include <algorithm>

namespace episcope {
namespace {

constexpr int kLeastCombo = 12;  // characters

void choose_key(QComboBox& combo, const QString& key) {
  combo.setCurrentIndex(std::max(0, combo.findData(key)));
}

}  // namespace

SweepPanel::SweepPanel(QWidget* parent)
    : QWidget(parent),
      title_(named("sweep.title", new ElidedLabel(this))),
      rows_{makeRow("sweep.first", tr("Parameter that is varied")),
            makeRow("sweep.second", tr("Second parameter that is varied"))},
      plan_(named("sweep.plan", new QLabel(this))),
      run_(named("sweep.run", new QPushButton(themed_icon("run"), tr("Run"), this))),
      cancel_(named("sweep.cancel", new QPushButton(themed_icon("stop"), tr("Cancel"), this))),
      everywhere_(named("sweep.everywhere", new QCheckBox(tr("All open light fields"), this))),
      sweeps_(named("sweep.list", new QComboBox(this))),
      scenes_(named("sweep.scene", new QComboBox(this))),
      remove_(make_tool_button({"sweep.remove", "trash", tr("Removes this sweep")}, this)),
      export_(make_tool_button({"sweep.export", "export", tr("Saves the points as CSV")}, this)),
      parts_{makePart(0, "sweep.upper", tr("Upper plot")),
             makePart(1, "sweep.lower", tr("Lower plot"))},
      chosen_(named("sweep.chosen", new ElidedLabel(this))),
      keep_(named("sweep.keep", new QPushButton(tr("Keep"), this))),
      use_(named("sweep.use", new QPushButton(tr("Use values"), this))) {
  setObjectName("sweepPanel");
  plan_->setWordWrap(true);
  auto* layout = new QGridLayout(this);
  layout->setContentsMargins(0, theme::kSpacing, 0, 0);
  layout->setSpacing(theme::kSpacing);
  layout->addWidget(title_, 0, 0, 1, 2);
  for (int i = 0; i < 2; ++i) {
    const Row& row = rows_[static_cast<std::size_t>(i)];
    layout->addWidget(row.parameter, 1 + i, 0);
    layout->addWidget(row.values, 1 + i, 1);
  }
  layout->setColumnStretch(1, 1);
  layout->addWidget(plan_, 3, 0, 1, 2);
  layout->addLayout(makeButtons(), 4, 0, 1, 2);
  layout->addLayout(makeSweepRow(), 5, 0, 1, 2);
  for (int i = 0; i < 2; ++i) {
    const Part& part = parts_[static_cast<std::size_t>(i)];
    layout->addWidget(part.measure, 6 + 2 * i, 0, 1, 2, Qt::AlignLeft);
    layout->addWidget(part.plot, 7 + 2 * i, 0, 1, 2);
    layout->setRowStretch(7 + 2 * i, 1);
  }
  layout->addWidget(chosen_, 10, 0, 1, 2);
  layout->addLayout(makeActions(), 11, 0, 1, 2);
  setRunning(false);
  setSceneCount(0);
  setSweeps({}, {}, -1);
  setScenes({});
  setExportable(false);
  setChosen({}, {}, false, false);
}

SweepPanel::Row SweepPanel::makeRow(const QString& name, const QString& accessible) {
  const Row row{new QComboBox(this), new QLineEdit(this)};
  row.parameter->setObjectName(name);
  row.parameter->setAccessibleName(accessible);
  row.parameter->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  row.parameter->setMinimumContentsLength(kLeastCombo);
  row.values->setObjectName(name + ".values");
  row.values->setAccessibleName(tr("Its values"));
  row.values->setToolTip(
      tr("Values such as 0.1, 0.2, 0.4, or first:last:number such as 0.1:1.6:5, spread like the "
         "slider of the parameter"));
  connect(row.parameter, &QComboBox::activated, this, [this, row] {
    propose(row);
    emit planEdited();
  });
  connect(row.values, &QLineEdit::textEdited, this, &SweepPanel::planEdited);
  connect(row.values, &QLineEdit::returnPressed, this, [this] {
    if (run_->isEnabled()) emit runRequested();
  });
  return row;
}

SweepPanel::Part SweepPanel::makePart(int number, const QString& name, const QString& accessible) {
  const Part part{new QComboBox(this), new LinePlot(this)};
  part.measure->setObjectName(name + ".measure");
  part.measure->setAccessibleName(tr("%1: what it shows").arg(accessible));
  part.plot->setObjectName(name);
  part.plot->setAccessibleName(accessible);
  connect(part.measure, &QComboBox::activated, this, &SweepPanel::measureChosen);
  connect(part.plot, &LinePlot::pointChosen, this,
          [this, number](PlotPlace place) { emit pointChosen(number, place); });
  return part;
}

QHBoxLayout* SweepPanel::makeButtons() {
  run_->setToolTip(tr("Runs the method on the center view with each of the values"));
  cancel_->setToolTip(tr("Ends the sweep and keeps its points"));
  auto* row = make_row({run_, cancel_});
  everywhere_->setToolTip(tr("Runs on every open light field, one after the other"));
  row->addWidget(everywhere_);
  connect(everywhere_, &QCheckBox::toggled, this, &SweepPanel::planEdited);
  row->addStretch(1);
  row->addWidget(export_);
  connect(run_, &QPushButton::clicked, this, &SweepPanel::runRequested);
  connect(cancel_, &QPushButton::clicked, this, &SweepPanel::cancelRequested);
  connect(export_, &QToolButton::clicked, this, &SweepPanel::exportRequested);
  return row;
}

QHBoxLayout* SweepPanel::makeSweepRow() {
  sweeps_->setAccessibleName(tr("Sweeps"));
  sweeps_->setToolTip(tr("Sweeps so far; they are kept in the project"));
  scenes_->setAccessibleName(tr("Light fields that are plotted"));
  scenes_->setToolTip(tr("Which light fields are plotted"));
  for (QComboBox* combo : {sweeps_, scenes_}) {
    combo->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    combo->setMinimumContentsLength(kLeastCombo);
  }
  auto* row = make_row({{sweeps_, 3}, {scenes_, 2}, remove_});
  connect(sweeps_, &QComboBox::activated, this,
          [this](int place) { emit sweepChosen(sweeps_->itemData(place).toULongLong()); });
  connect(scenes_, &QComboBox::activated, this, &SweepPanel::sceneChosen);
  connect(remove_, &QToolButton::clicked, this, &SweepPanel::removeRequested);
  return row;
}

QHBoxLayout* SweepPanel::makeActions() {
  keep_->setToolTip(tr(
      "Keeps the map of this point in the list of results; otherwise the next point replaces it"));
  use_->setToolTip(tr("Sets the form of the Estimate tab to the values of this point"));
  auto* row = make_row({kRoom, keep_, use_});
  connect(keep_, &QPushButton::clicked, this, &SweepPanel::keepRequested);
  connect(use_, &QPushButton::clicked, this, &SweepPanel::useRequested);
  return row;
}

void SweepPanel::setMethod(const QString& method, const QString& title,
                           const std::vector<Parameter>& parameters) {
  const std::array<Choice, 2> former = method == method_ ? choices() : std::array<Choice, 2>{};
  method_ = method;
  parameters_ = parameters;
  title_->setFullText(title);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    row.parameter->clear();
    if (i > 0) row.parameter->addItem(tr("One only"), QString());
    for (const Parameter& each : parameters_) row.parameter->addItem(each.label, each.key);
    if (row.parameter->findData(former[i].key) >= 0) {
      choose_key(*row.parameter, former[i].key);
      row.values->setText(former[i].values);
      row.values->setEnabled(!former[i].key.isEmpty());
      continue;
    }
    const auto first = std::ranges::find(parameters_, true, &Parameter::is_searched);
    choose_key(*row.parameter, i == 0 && first != parameters_.end() ? first->key : QString());
    propose(row);
  }
}

void SweepPanel::propose(const Row& row) {
  const auto chosen =
      std::ranges::find(parameters_, row.parameter->currentData().toString(), &Parameter::key);
  row.values->setText(chosen == parameters_.end() ? QString() : chosen->values);
  row.values->setEnabled(chosen != parameters_.end());
}

void SweepPanel::setPlan(const QString& plan, bool can_run) {
  plan_->setText(plan);
  run_->setEnabled(can_run);
}

void SweepPanel::setSceneCount(int count) {
  const QSignalBlocker blocker(everywhere_);
  everywhere_->setVisible(count > 1);
  if (count < 2) everywhere_->setChecked(false);
}

void SweepPanel::setSweeps(const QStringList& titles, const std::vector<quint64>& ids, int shown) {
  sweeps_->clear();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    sweeps_->addItem(titles[static_cast<int>(i)], QVariant::fromValue(ids[i]));
  }
  sweeps_->setCurrentIndex(shown);
  sweeps_->setVisible(!ids.empty());
  remove_->setVisible(!ids.empty());
}

void SweepPanel::setScenes(const QStringList& names) {
  QStringList former;
  for (int i = 0; i < scenes_->count(); ++i) former << scenes_->itemText(i);
  if (names != former) {
    scenes_->clear();
    scenes_->addItems(names);
  }
  scenes_->setVisible(!names.isEmpty());
}

void SweepPanel::setMeasures(const QStringList& names, int first, int second) {
  const std::array<int, 2> proposed{first, second};
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    QComboBox& combo = *parts_[i].measure;
    const int former = static_cast<int>(names.indexOf(combo.currentText()));
    combo.clear();
    combo.addItems(names);
    combo.setCurrentIndex(former >= 0 ? former : proposed[i]);
  }
}

void SweepPanel::setPlots(const Plot& upper, const Plot& lower, const QString& instead) {
  for (const Part& part : parts_) part.plot->setEmptyText(instead);
  parts_[0].plot->setPlot(upper);
  parts_[1].plot->setPlot(lower);
}

void SweepPanel::setChosen(std::array<std::optional<PlotPlace>, 2> places, const QString& text,
                           bool can_keep, bool can_use) {
  for (std::size_t i = 0; i < parts_.size(); ++i) parts_[i].plot->setMark(places[i]);
  chosen_->setFullText(text);
  keep_->setEnabled(can_keep);
  use_->setEnabled(can_use);
}

std::array<SweepPanel::Choice, 2> SweepPanel::choices() const {
  std::array<Choice, 2> chosen;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    chosen[i] = {rows_[i].parameter->currentData().toString(), rows_[i].values->text()};
  }
  return chosen;
}

std::array<int, 2> SweepPanel::measures() const {
  return {parts_[0].measure->currentIndex(), parts_[1].measure->currentIndex()};
}

}  // namespace episcope

#include "moc_sweep_panel.cpp"
