// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/browse/measure_controller.h"

#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/frame.h"
#include "widgets/canvas/epi_pane.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QAction>
#include <QBoxLayout>
#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>
#include <QLabel>
#include <QSignalBlocker>
#include <QString>
#include <QToolButton>
#include <QTreeWidget>
#include <QWidget>

#include <algorithm>
#include <vector>

namespace episcope {

namespace {

enum MeasureColumn { kLineName, kDisparity, kDepth, kPlace };

}  // namespace

/// Disparities measured by hand: a click goes to one, a double click renames it, Delete removes it.
/// Setters never emit; user actions are signals.
class MeasurePanel : public QWidget {
  Q_OBJECT

 public:
  /// A measurement, as text.
  struct Row {
    QString name;
    QString disparity;  ///< "0.42"
    QString depth;      ///< Empty = unknown.
    QString place;      ///< "row 12 · (4, 4)"
    QString tip;
  };

  explicit MeasurePanel(QWidget* parent = nullptr)
      : QWidget(parent),
        actions_(make_row({kRoom}, {.spacing = 2})),
        list_(make_list("measure.list", tr("Measured lines"), this)),
        hint_(named("measure.hint", new QLabel(this))),
        chosen_actions_(new QVBoxLayout) {
    setObjectName("measurePanel");
    setUpList();
    hint_->setTextFormat(Qt::PlainText);
    hint_->setAlignment(Qt::AlignCenter);
    hint_->setWordWrap(true);
    hint_->setMargin(theme::kMargin);
    chosen_actions_->setSpacing(2);
    make_column(this, {actions_, {hint_, 1}, {list_, 1}, chosen_actions_},
                {.margins = {0, theme::kSpacing, 0, theme::kSpacing}, .spacing = 4});
    setRows({}, -1);
  }

  /// Adds a button above the list, or (`addChosenAction`) below it for the chosen measurement, in
  /// order of the calls.
  void addAction(QAction* action) { add_action_button(actions_, action); }
  void addChosenAction(QAction* action) {
    auto* button = make_action_button(action, this);
    button->setToolButtonStyle(Qt::ToolButtonTextOnly);
    chosen_actions_->addWidget(button);
  }

  void setRows(const std::vector<Row>& rows, int current) {
    const QSignalBlocker blocker(list_);
    const auto count = static_cast<int>(rows.size());
    // Rows stay what they are, so that a name that is being typed stays too.
    while (list_->topLevelItemCount() > count) delete list_->takeTopLevelItem(count);
    while (list_->topLevelItemCount() < count) {
      auto* item = new QTreeWidgetItem(list_);
      item->setFlags(item->flags() | Qt::ItemIsEditable);
    }
    for (int i = 0; i < count; ++i) {
      const Row& row = rows[static_cast<std::size_t>(i)];
      QTreeWidgetItem* item = list_->topLevelItem(i);
      item->setText(kLineName, row.name);
      item->setText(kDisparity, row.disparity);
      item->setText(kDepth, row.depth);
      item->setText(kPlace, row.place);
      for (const int column : {kDisparity, kDepth}) {
        item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
      }
      for (const int column : {kLineName, kDisparity, kDepth, kPlace})
        item->setToolTip(column, row.tip);
    }
    list_->setCurrentItem(current < 0 ? nullptr : list_->topLevelItem(current));
    list_->setVisible(!rows.empty());
    hint_->setVisible(rows.empty());
  }

  /// Text shown without measurements.
  void setHint(const QString& hint) { hint_->setText(hint); }
  /// Begins to edit a measurement's name in its row.
  void editName(int index) {
    if (QTreeWidgetItem* item = list_->topLevelItem(index)) list_->editItem(item, kLineName);
  }

 signals:
  void chosen(int index);
  void renameRequested(int index, const QString& name);
  void removeRequested(int index);

 private:
  void setUpList() {
    list_->setHeaderLabels({tr("Name"), tr("Disparity"), tr("Depth"), tr("Place")});
    list_->header()->setSectionResizeMode(kLineName, QHeaderView::Stretch);
    const auto index_of = [this](QTreeWidgetItem* item) {
      return list_->indexOfTopLevelItem(item);
    };
    connect(add_delete_action(list_), &QAction::triggered, this, [this, index_of] {
      if (QTreeWidgetItem* item = list_->currentItem()) emit removeRequested(index_of(item));
    });
    const auto choose = [this, index_of](QTreeWidgetItem* item) { emit chosen(index_of(item)); };
    connect(list_, &QTreeWidget::itemClicked, this, choose);
    connect(list_, &QTreeWidget::itemActivated, this, choose);
    // After what the first of the two clicks brings about.
    connect(
        list_, &QTreeWidget::itemDoubleClicked, this,
        [this, index_of](QTreeWidgetItem* item) { editName(index_of(item)); },
        Qt::QueuedConnection);
    connect(list_, &QTreeWidget::itemChanged, this,
            [this, index_of](QTreeWidgetItem* item, int column) {
              if (column == kLineName) emit renameRequested(index_of(item), item->text(kLineName));
            });
  }

  QBoxLayout* actions_;
  QTreeWidget* list_;
  QLabel* hint_;
  QBoxLayout* chosen_actions_;
};

namespace {

QString place_of(const EpiMeasurement& each) {
  const bool is_row = each.direction == EpiDirection::Horizontal;
  return is_row ? MeasureController::tr("row %1").arg(each.pixel.y)
                : MeasureController::tr("column %1").arg(each.pixel.x);
}

MeasurePanel::Row row_of(const EpiMeasurement& each, const CameraGrid& camera) {
  const auto depth = depth_of(each, camera);
  return {QString::fromStdString(each.name), number_text(each.disparity_px),
          depth ? number_text(*depth) : QString(), place_of(each),
          MeasureController::tr("%1 px per view, measured in %2 at pixel x %3, y %4 of view (%5, "
                                "%6). A click goes there.")
              .arg(number_text(each.disparity_px), place_of(each))
              .arg(each.pixel.x)
              .arg(each.pixel.y)
              .arg(each.view.v)
              .arg(each.view.u)};
}

}  // namespace

MeasureController::MeasureController(const Workbench& bench)
    : QObject(&bench.owner), bench_(bench), panel_(new MeasurePanel(&bench.frame)) {
  bench.frame.addTab({.id = "measure",
                      .title = tr("Measure"),
                      .task = "estimate",
                      .command_text = tr("Measure tab"),
                      .command_tip = tr("Lists the disparities measured in EPIs"),
                      .widget = panel_,
                      .waits = true});
  addCommands();
  connectPanel();
  bench.session.on_changed([this](Parts parts) { update(parts); });
  show();
}

void MeasureController::addCommand(const Row& row) {
  const bool needs_current = row.run != &MeasureController::keep;
  bench_.commands.add(
      {.id = row.id,
       .menu = row.run == &MeasureController::save ? Menu::Export : Menu::Measurements,
       .text = row.text,
       .tip = row.tip,
       .icon = row.icon,
       .keys = row.key.isEmpty() ? QList<QKeySequence>() : QList<QKeySequence>{row.key},
       .run = [this, run = row.run] { (this->*run)(); },
       .enabled =
           [this, needs_current] {
             return needs_current ? current_of(measured()) != nullptr
                                  : bench_.session.scene() != nullptr;
           }});
}

void MeasureController::addCommands() {
  addCommand({"measure.keep", tr("Keep the measured line"),
              tr("Keeps the disparity of the line drawn in an EPI in the list of the Measure tab"),
              "add", &MeasureController::keep, tr("Ctrl+K")});
  addCommand({"measure.rename", tr("Rename the chosen measurement"),
              tr("Renames the chosen measured line"), "rename", &MeasureController::nameCurrent});
  addCommand({"measure.remove", tr("Remove the chosen measurement"),
              tr("Removes the chosen measured line"), "trash", &MeasureController::removeCurrent});
  addCommand({"measure.copy", tr("Copy measurements as CSV"),
              tr("Copies all measured lines as a table"), "copy", &MeasureController::copy});
  addCommand({"measure.save", tr("Measurements…"), tr("Saves all measured lines as a table (CSV)"),
              "export", &MeasureController::save});
  addCommand({"measure.focus", tr("Focus on the chosen measurement"),
              tr("Moves the focus plane to the measured disparity"), "",
              &MeasureController::focusOnCurrent});
  for (const char* id :
       {"measure.keep", "measure.rename", "measure.remove", "measure.copy", "measure.save"}) {
    panel_->addAction(bench_.commands.find(id));
  }
  for (const char* id : {"measure.focus", "estimate.range_from", "estimate.range_to"}) {
    panel_->addChosenAction(bench_.commands.find(id));
  }
}

void MeasureController::connectPanel() {
  panel_->setHint(tr("Drag along a line in an EPI to measure its disparity, then keep it (%1).")
                      .arg(bench_.commands.keyText("measure.keep")));
  connect(panel_, &MeasurePanel::chosen, this, &MeasureController::choose);
  connect(panel_, &MeasurePanel::renameRequested, this, &MeasureController::rename);
  connect(panel_, &MeasurePanel::removeRequested, this, &MeasureController::remove);
  for (const EpiDirection direction : {EpiDirection::Horizontal, EpiDirection::Vertical}) {
    connect(pane(direction), &EpiPane::disparityMeasured, this, [this, direction](double px) {
      drawn_ = direction;
      bench_.messages.hint(tr("Measured disparity: %1 px per view; %2 keeps it")
                               .arg(number_text(px), bench_.commands.keyText("measure.keep")));
    });
  }
}

EpiPane* MeasureController::pane(EpiDirection direction) const {
  return direction == EpiDirection::Horizontal ? bench_.viewer_area.horizontalEpi()
                                               : bench_.viewer_area.verticalEpi();
}

QString MeasureController::nextName() const {
  const auto is_taken = [this](const QString& name) {
    return std::ranges::any_of(measured().list, [&](const EpiMeasurement& each) {
      return each.name == name.toStdString();
    });
  };
  int number = 1;
  while (is_taken(tr("line %1").arg(number))) ++number;
  return tr("line %1").arg(number);
}

void MeasureController::show() {
  std::vector<MeasurePanel::Row> rows;
  const LightFieldPtr light_field = bench_.session.light_field();
  for (const EpiMeasurement& each : measured().list) {
    rows.push_back(row_of(each, light_field->info().camera));
  }
  panel_->setRows(rows, measured().current);
  bench_.commands.refresh();
}

void MeasureController::keep() {
  if (!pane(drawn_)->measuredDisparity()) {
    drawn_ = drawn_ == EpiDirection::Horizontal ? EpiDirection::Vertical : EpiDirection::Horizontal;
  }
  const auto disparity = pane(drawn_)->measuredDisparity();
  if (!disparity) {
    bench_.messages.hint(tr("Nothing is measured: drag along a line in an EPI first."));
    return;
  }
  PixelIndex pixel = bench_.session.cross_hair();
  int& along = drawn_ == EpiDirection::Horizontal ? pixel.x : pixel.y;
  along = pane(drawn_)->measuredPixel().value_or(along);
  Measurements more = measured();
  more.current = static_cast<int>(more.list.size());
  more.list.push_back({nextName().toStdString(), drawn_, bench_.session.view(), pixel, *disparity});
  bench_.session.set_measurements(more);
  bench_.frame.showTab("measure");
}

void MeasureController::choose(int index) {
  Measurements chosen = measured();
  chosen.current = index;
  const EpiMeasurement* found = current_of(chosen);
  if (!found) return;
  bench_.session.set_measurements(chosen);
  bench_.session.set_view(found->view);
  bench_.session.set_cross_hair(found->pixel);
  // The EPIs of that place are shown by then.
  QMetaObject::invokeMethod(this, &MeasureController::showLine, Qt::QueuedConnection);
}

void MeasureController::showLine() {
  const EpiMeasurement* found = current_of(measured());
  if (!found) return;
  for (const EpiDirection each : {EpiDirection::Horizontal, EpiDirection::Vertical}) {
    pane(each)->clearMeasurement();
  }
  drawn_ = found->direction;
  pane(drawn_)->showMeasurement(found->disparity_px);
}

void MeasureController::rename(int index, const QString& name) {
  Measurements renamed = measured();
  if (index < 0 || index >= std::ssize(renamed.list)) return;
  if (!name.trimmed().isEmpty()) {
    renamed.list[static_cast<std::size_t>(index)].name = name.trimmed().toStdString();
  }
  bench_.session.set_measurements(renamed);
  show();  // the row holds what was typed
}

void MeasureController::remove(int index) {
  Measurements fewer = measured();
  if (index < 0 || index >= std::ssize(fewer.list)) return;
  fewer.list.erase(fewer.list.begin() + index);
  fewer.current = std::min(index, static_cast<int>(fewer.list.size()) - 1);
  bench_.session.set_measurements(fewer);
}

void MeasureController::nameCurrent() {
  bench_.frame.showTab("measure");
  panel_->editName(measured().current);
}

std::string MeasureController::csv() const {
  return measurements_csv(measured().list, bench_.session.light_field()->info().camera);
}

void MeasureController::copy() {
  QGuiApplication::clipboard()->setText(QString::fromStdString(csv()));
  bench_.messages.hint(
      tr("%n measured line(s) copied as CSV.", nullptr, static_cast<int>(measured().list.size())));
}

void MeasureController::save() {
  ask_where_to_save_text(bench_,
                         {.name = "save_measurements",
                          .title = tr("Save the measurements"),
                          .filter = tr("CSV (*.csv)"),
                          .proposal = named_after_front(bench_, "measurements.csv")},
                         QString::fromStdString(csv()));
}

}  // namespace episcope

#include "measure_controller.moc"
#include "moc_measure_controller.cpp"
