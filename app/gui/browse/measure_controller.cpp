// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/browse/measure_controller.h"

#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/frame.h"
#include "widgets/canvas/epi_pane.h"
#include "widgets/controls/text.h"
#include "widgets/panels/measure_panel.h"

#include <QAction>
#include <QClipboard>
#include <QGuiApplication>

#include <algorithm>

namespace episcope {
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

#include "moc_measure_controller.cpp"
