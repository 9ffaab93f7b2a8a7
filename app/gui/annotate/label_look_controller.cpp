// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/label_look_controller.h"

#include "app/gui/annotate/annotate_section.h"
#include "app/gui/document/document_controller.h"
#include "app/gui/document/label_choice.h"
#include "app/gui/frame/commands.h"
#include "app/gui/frame/messages.h"
#include "widgets/annotate/label_palette.h"
#include "widgets/style/number_text.h"

#include <QLocale>
#include <QSettings>

#include <memory>
#include <utility>

namespace episcope {
namespace {

constexpr const char* kDrawingKey = "annotate/drawing";
constexpr int kDrawingCount = 3;

using render::LabelDrawing;

QString name_of(LabelDrawing drawing) {
  switch (drawing) {
    case LabelDrawing::Fill:
      return LabelLookController::tr("areas");
    case LabelDrawing::Contours:
      return LabelLookController::tr("contours");
    case LabelDrawing::Both:
      return LabelLookController::tr("areas and contours");
  }
  return {};
}

LabelDrawing after(LabelDrawing drawing) {
  return static_cast<LabelDrawing>((static_cast<int>(drawing) + 1) % kDrawingCount);
}

// Labels that an edit gave pixels to or took them from.
std::set<std::int32_t> painted_labels(const Edit& edit) {
  std::set<std::int32_t> ids;
  for (const ViewEdit& view : edit.views) {
    for (const LabelRun& run : view.runs) {
      ids.insert(run.before);
      ids.insert(run.after);
    }
  }
  return ids;
}

QString tip_of(const LabelAmount& amount, double share) {
  QString tip = LabelLookController::tr("%1 px painted on this view, %2 %")
                    .arg(QLocale::c().toString(static_cast<qlonglong>(amount.pixels)))
                    .arg(100 * share, 0, 'f', 2);
  if (amount.disparity) {
    tip += '\n' + LabelLookController::tr("Disparity %1 ± %2 px, from %3 to %4 px")
                      .arg(number_text(amount.disparity->mean),
                           number_text(amount.disparity->deviation),
                           number_text(amount.disparity->min), number_text(amount.disparity->max));
  }
  return tip;
}

}  // namespace

LabelLookController::LabelLookController(const Workbench& bench, LabelPalette* palette)
    : QObject(&bench.owner), bench_(bench), palette_(palette), count_job_(this) {
  const int kept = QSettings().value(kDrawingKey).toInt();
  if (kept >= 0 && kept < kDrawingCount) {
    bench_.session.set_label_drawing(static_cast<LabelDrawing>(kept));
  }
  addCommands();
  connect(palette_, &LabelPalette::hiddenRequested, this, &LabelLookController::setHidden);
  connect(palette_, &LabelPalette::onlyRequested, this, &LabelLookController::showOnly);
  connect(palette_, &LabelPalette::lockedRequested, this, &LabelLookController::setLocked);
  connect(&bench_.document, &DocumentController::replaced, this, &LabelLookController::count);
  connect(&bench_.document, &DocumentController::changed, this,
          [this](const DocumentChange& change) {
            if (change.has_new_labels) followLabels();
            count();
          });
  connect(
      &bench_.document, &DocumentController::steppedBack, this,
      [this](const DocumentChange&, const Edit& edit, bool is_undo) { tellLocked(edit, is_undo); });
  bench_.session.on_changed([this](Parts parts) { update(parts); });
}

void LabelLookController::addCommands() {
  const auto current = [this] { return bench_.labels.current(); };
  const auto has_label = [current] { return current() != 0; };
  const auto marks = [this]() -> const LabelMarks& { return bench_.session.place().label_marks; };
  bench_.commands.add(
      {.id = "annotate.hide_label",
       .menu = Menu::Label,
       .text = tr("Hide label"),
       .tip = tr("Neither shows the current label nor paints over it"),
       .icon = "eye_off",
       .keys = {Qt::Key_V},
       .run = [this, current, marks] { setHidden(current(), !marks().hidden.contains(current())); },
       .section = label_section::kLook,
       .enabled = has_label,
       .checked = [=] { return marks().hidden.contains(current()); }});
  bench_.commands.add({.id = "annotate.only_label",
                       .menu = Menu::Label,
                       .text = tr("Show only this label"),
                       .tip = tr("Hides all other labels; again shows all"),
                       .run = [this, current] { showOnly(current()); },
                       .section = label_section::kLook,
                       .enabled = has_label});
  bench_.commands.add(
      {.id = "annotate.lock_label",
       .menu = Menu::Label,
       .text = tr("Lock label"),
       .tip = tr("The current label is neither painted nor painted over"),
       .icon = "lock",
       .keys = {tr("Shift+V")},
       .run = [this, current, marks] { setLocked(current(), !marks().locked.contains(current())); },
       .section = label_section::kLook,
       .enabled = has_label,
       .checked = [=] { return marks().locked.contains(current()); }});
  bench_.commands.add(
      {.id = "annotate.drawing",
       .menu = Menu::Label,
       .text = tr("Draw labels as areas, contours or both"),
       .tip = tr("Draws strokes and segments as areas, as contours, or as faint areas with "
                 "contours"),
       .keys = {tr("Shift+C")},
       .run = [this] { setDrawing(after(bench_.session.label_style().drawing)); },
       .section = label_section::kLook});
}

void LabelLookController::update(Parts parts) {
  if (parts.has(Part::LabelLook)) {
    palette_->setHidden(bench_.session.place().label_marks.hidden);
    palette_->setLocked(bench_.session.place().label_marks.locked);
    bench_.commands.refresh();
  }
  if (parts.has_any(Part::View | Part::Shown | Part::Estimates)) count();
}

void LabelLookController::setHidden(int id, bool hides) {
  LabelMarks marks = bench_.session.place().label_marks;
  hides ? void(marks.hidden.insert(id)) : void(marks.hidden.erase(id));
  bench_.session.set_label_marks(marks);
}

void LabelLookController::showOnly(int id) {
  const AnnotationDocument* document = std::as_const(bench_.document).document();
  if (!document) return;
  LabelMarks marks = bench_.session.place().label_marks;
  std::set<std::int32_t> others;
  for (const LabelInfo& label : document->labels().labels()) {
    if (label.id != id) others.insert(label.id);
  }
  marks.hidden = marks.hidden == others ? std::set<std::int32_t>{} : others;
  bench_.session.set_label_marks(marks);
}

void LabelLookController::setLocked(int id, bool locks) {
  LabelMarks marks = bench_.session.place().label_marks;
  locks ? void(marks.locked.insert(id)) : void(marks.locked.erase(id));
  bench_.session.set_label_marks(marks);
}

// Locks keep the brush away; undo goes back whatever was locked since, as in painting programs.
void LabelLookController::tellLocked(const Edit& edit, bool is_undo) {
  const AnnotationDocument* document = std::as_const(bench_.document).document();
  if (!document) return;
  const std::set<std::int32_t> touched = painted_labels(edit);
  QStringList names;
  for (const LabelInfo& label : document->labels().labels()) {
    const bool is_locked = bench_.session.place().label_marks.locked.contains(label.id);
    if (is_locked && touched.contains(label.id)) names << QString::fromStdString(label.name);
  }
  if (names.isEmpty()) return;
  bench_.messages.hint((is_undo ? tr("Undo changed what is locked: %1. Redo brings it back.")
                                : tr("Redo changed what is locked: %1. Undo brings it back."))
                           .arg(names.join(", ")));
}

void LabelLookController::setDrawing(LabelDrawing drawing) {
  QSettings().setValue(kDrawingKey, static_cast<int>(drawing));
  bench_.session.set_label_drawing(drawing);
  bench_.messages.hint(tr("Labels are drawn as %1.").arg(name_of(drawing)));
}

void LabelLookController::followLabels() {
  const AnnotationDocument* document = std::as_const(bench_.document).document();
  if (!document) return;
  LabelMarks marks = bench_.session.place().label_marks;
  const auto is_gone = [document](std::int32_t id) { return !document->labels().contains(id); };
  std::erase_if(marks.hidden, is_gone);
  std::erase_if(marks.locked, is_gone);
  bench_.session.set_label_marks(marks);
}

void LabelLookController::count() {
  const AnnotationDocument* document = std::as_const(bench_.document).document();
  const ViewIndex view = bench_.session.view();
  const auto layer = document ? document->scribbles().view(view) : ImageView<const std::uint8_t>{};
  if (layer.empty()) {
    count_job_.drop();
    palette_->setAmounts({});
    return;
  }
  auto painted = std::make_shared<Image<std::uint8_t>>(layer.height, layer.width);
  std::copy_n(layer.data, layer.size(), painted->data());
  count_job_.start<std::vector<LabelAmount>>(
      [painted, view, field = bench_.session.known_disparity(view)](const Progress&) {
        return label_amounts(painted->view(), field ? field->view(view) : DisparityView{});
      },
      [this, all = static_cast<double>(layer.size())](const std::vector<LabelAmount>& amounts) {
        showAmounts(amounts, all);
      });
}

void LabelLookController::showAmounts(const std::vector<LabelAmount>& amounts, double all) {
  std::map<std::int32_t, LabelPalette::Amount> texts;
  for (const LabelAmount& each : amounts) {
    texts[each.id] = {QLocale::c().toString(static_cast<qlonglong>(each.pixels)),
                      tip_of(each, static_cast<double>(each.pixels) / all)};
  }
  palette_->setAmounts(texts);
}

}  // namespace episcope

#include "moc_label_look_controller.cpp"
