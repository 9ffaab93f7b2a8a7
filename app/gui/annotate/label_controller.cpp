// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/label_controller.h"

#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/features.h"
#include "app/gui/shell/frame.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/text.h"
#include "widgets/panels/label_palette.h"

#include <QColorDialog>
#include <QCoreApplication>
#include <QInputDialog>
#include <QLocale>
#include <QPushButton>
#include <QSettings>
#include <QStringList>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace episcope {
namespace {

constexpr int kLabelKeys = 9;

QString no_labels() {
  return LabelController::tr(
      "No labels yet. Add one for each kind of object, then paint a few strokes on the view.");
}

}  // namespace

namespace {

/// The label that a step back or forward is about: one that it brings back, else the only one that
/// is painted again, or no longer erased; 0 = none.
int label_of_step(const Edit& edit, bool is_undo) {
  if (edit.labels) {
    const LabelSet& now = is_undo ? edit.labels->before : edit.labels->after;
    const LabelSet& former = is_undo ? edit.labels->after : edit.labels->before;
    for (const LabelInfo& label : now.labels()) {
      if (!former.find(label.id)) return label.id;
    }
  }
  std::set<int> painted;
  for (const ViewEdit& view : edit.views) {
    for (const LabelRun& run : view.runs) {
      if (!is_undo || run.after == 0) painted.insert(is_undo ? run.before : run.after);
    }
  }
  painted.erase(0);
  return painted.size() == 1 ? *painted.begin() : 0;
}

}  // namespace

LabelController::LabelController(const Workbench& bench, LabelPalette* palette)
    : QObject(&bench.owner),
      bench_(bench),
      document_(bench.document),
      labels_(bench.labels),
      palette_(palette) {
  addChoiceCommands();
  addEditCommands();
  connect(palette_, &LabelPalette::currentChosen, &labels_, &LabelChoice::choose);
  connect(palette_, &LabelPalette::addRequested, this, &LabelController::add);
  connect(palette_, &LabelPalette::removeRequested, this, &LabelController::remove);
  connect(palette_, &LabelPalette::colorRequested, this, &LabelController::recolor);
  connect(palette_, &LabelPalette::renameRequested, this, &LabelController::setName);
  connect(palette_, &LabelPalette::mergeRequested, this, &LabelController::merge);
  connect(palette_, &LabelPalette::numberRequested, this, &LabelController::askForNumber);
  connect(palette_, &LabelPalette::moveRequested, this, &LabelController::move);
  connect(&labels_, &LabelChoice::changed, this, &LabelController::show);
  connect(&document_, &DocumentController::replaced, this, &LabelController::show);
  connect(&document_, &DocumentController::changed, this, [this](const DocumentChange& change) {
    if (change.has_new_labels) show();
  });
  connect(&document_, &DocumentController::steppedBack, this,
          [this](const DocumentChange&, const Edit& edit, bool is_undo) {
            const int label = label_of_step(edit, is_undo);
            if (label != 0) labels_.choose(label);
          });
  connect(&bench.viewer_area, &ViewerArea::previewChanged, this, &LabelController::showHint);
  show();
}

void LabelController::addChoiceCommands() {
  const auto has_label = [this] { return labels_.current() != 0; };
  for (int id = 1; id <= kLabelKeys; ++id) {
    bench_.commands.add(
        {.id = QString("annotate.label_%1").arg(id),
         .menu = Menu::Labels,
         .text = tr("Label %1").arg(id),
         .tip = tr("Paints with the label at place %1 of the list, or gives it to the "
                   "marked region in doubt")
                    .arg(id),
         .keys = {QKeySequence(Qt::Key_0 + id)},
         .run = [this, id] { choose(id); },
         .section = label_section::kLabels,
         .enabled = [this] { return hasDocument(); },
         .visible = [this, id] { return at(id) || !hasDocument(); },
         .live_text =
             [this, id] {
               const LabelInfo* label = at(id);
               return label ? label_name(*label) : tr("Label %1").arg(id);
             }});
  }
  bench_.commands.add({.menu = Menu::Labels, .section = label_section::kEdit, .enabled = has_label},
                      {{.id = "annotate.next_label",
                        .text = tr("Next label"),
                        .tip = tr("Paints with the next label"),
                        .keys = {Qt::Key_N},
                        .run =
                            [this] {
                              labels_.chooseNext();
                              if (labels_.current() == 0) bench_.messages.hint(no_labels());
                            },
                        .enabled = [this] { return hasDocument(); }},
                       {.id = "annotate.swap_labels",
                        .text = tr("Swap labels"),
                        .tip = tr("Returns to the label used before"),
                        .keys = {Qt::Key_X},
                        .run = [this] { labels_.swap(); }}});
}

void LabelController::addEditCommands() {
  const auto add_one = [this](const QString& id, const QString& text, const QString& tip,
                              const QString& icon, const QList<QKeySequence>& keys,
                              std::function<void()> run, std::function<bool()> enabled) {
    bench_.commands.add({.id = "annotate." + id,
                         .menu = Menu::Labels,
                         .text = text,
                         .tip = tip,
                         .icon = icon,
                         .keys = keys,
                         .run = std::move(run),
                         .section = label_section::kEdit,
                         .enabled = std::move(enabled)});
  };
  const auto has_label = [this] { return labels_.current() != 0; };
  add_one(
      "add_label", tr("Add label"), tr("Adds a label to name and paint with"), "add",
      {tr("Ctrl+Shift+N")}, [this] { add(); }, [this] { return hasDocument(); });
  add_one(
      "rename_label", tr("Rename label"), tr("Renames the current label"), "rename", {Qt::Key_F2},
      [this] { rename(); }, has_label);
  add_one(
      "recolor_label", tr("Change color…"), tr("Changes the color of the current label"), {}, {},
      [this] { recolor(labels_.current()); }, has_label);
  add_one(
      "remove_label", tr("Remove label"),
      tr("Removes the current label and everything painted with it"), "trash", {},
      [this] { remove(labels_.current()); }, has_label);
  add_one(
      "merge_label", tr("Merge into…"),
      tr("Gives everything painted with the current label to another one, "
         "and removes it"),
      {}, {}, [this] { merge(labels_.current()); },
      [this] { return document_.labels().labels().size() > 1; });
  add_one(
      "renumber_label", tr("Change number…"),
      tr("Gives the current label another number, in everything painted with it"), {}, {},
      [this] { askForNumber(labels_.current()); }, has_label);
  add_one(
      "label_up", tr("Move label up"), tr("Moves the current label up in the list"), {},
      {tr("Alt+Up")}, [this] { move(labels_.current(), -1); }, has_label);
  add_one(
      "label_down", tr("Move label down"), tr("Moves the current label down in the list"), {},
      {tr("Alt+Down")}, [this] { move(labels_.current(), 1); }, has_label);
}

bool LabelController::hasDocument() const {
  return document_.document() != nullptr;
}

const LabelInfo* LabelController::find(int id) const {
  return document_.labels().find(id);
}

void LabelController::show() {
  palette_->setLabels(document_.labels().labels());
  palette_->setCurrent(labels_.current());
  palette_->setEnabled(hasDocument());
  showHint();
  bench_.commands.refresh();
}

void LabelController::showHint() {
  palette_->setHint(hasDocument()                       ? no_labels()
                    : bench_.viewer_area.isPreviewing() ? tr("The light field is still loading.")
                                                        : tr("Open a light field to label it."));
}

// By its place in the list, from 1.
const LabelInfo* LabelController::at(int place) const {
  const auto& labels = document_.labels().labels();
  return place <= static_cast<int>(labels.size()) ? &labels[static_cast<std::size_t>(place) - 1]
                                                  : nullptr;
}

void LabelController::choose(int place) {
  const LabelInfo* label = at(place);
  if (!label) {
    if (hasDocument()) bench_.messages.hint(tr("There is no label at place %1.").arg(place));
  } else if (labels_.hasRegion()) {
    labels_.giveRegion(label->id);
  } else {
    labels_.choose(label->id);
  }
}

void LabelController::add() {
  int id = 0;
  document_.edit([&](AnnotationDocument& document) { id = document.add_label(labels_.newName()); });
  if (id == 0) return;
  labels_.choose(id);
  rename();
}

void LabelController::setName(int id, const QString& typed) {
  const std::string name = typed.trimmed().toStdString();
  const auto& labels = document_.labels().labels();
  const bool is_taken = std::ranges::any_of(
      labels, [&](const LabelInfo& label) { return label.id != id && label.name == name; });
  if (is_taken) {
    bench_.messages.hint(tr("There is a label “%1” already: choose another name, or merge the two.")
                             .arg(typed.trimmed()));
  }
  const bool is_renamed = !is_taken && document_.edit([&](AnnotationDocument& document) {
    document.rename_label(id, name);
  });
  if (!is_renamed) show();  // the row holds what was typed
}

void LabelController::merge(int from) {
  const LabelInfo* label = find(from);
  if (!label || refuseLocked(*label, tr("“%1” is locked: unlock it to merge it."))) return;
  QStringList names;
  std::vector<int> ids;
  for (const LabelInfo& each : document_.labels().labels()) {
    if (each.id == label->id) continue;
    names << QString("%1 · %2").arg(each.id).arg(label_name(each));
    ids.push_back(each.id);
  }
  auto* dialog = named("merge_labels", new QInputDialog(&bench_.window));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(tr("Merge labels"));
  dialog->setLabelText(tr("Merge “%1” into:").arg(label_name(*label)));
  dialog->setComboBoxItems(names);
  dialog->setComboBoxEditable(false);
  connect(dialog, &QInputDialog::textValueSelected, this,
          [this, id = label->id, names, ids](const QString& chosen) {
            const auto place = names.indexOf(chosen);
            if (place < 0 || !find(id)) return;
            const int into = ids[static_cast<std::size_t>(place)];
            const bool is_merged = document_.edit(
                [&](AnnotationDocument& document) { document.merge_label(id, into); });
            if (is_merged) emit labels_.relabeled(id, into);
            labels_.choose(into);
          });
  dialog->open();
}

void LabelController::move(int id, int by) {
  const LabelInfo* label = find(id);
  if (!label) return;
  const auto& labels = document_.labels().labels();
  const int place = static_cast<int>(label - labels.data()) + by;
  document_.edit([id, place](AnnotationDocument& document) { document.move_label(id, place); });
}

void LabelController::askForNumber(int id) {
  const LabelInfo* label = find(id);
  if (!label || refuseLocked(*label, tr("“%1” is locked: unlock it to change its number."))) return;
  auto* dialog = named("renumber_label", new QInputDialog(&bench_.window));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(tr("Change the number of a label"));
  dialog->setLabelText(
      tr("Number of “%1”, from 1 to %2:").arg(label_name(*label)).arg(LabelSet::kMaxId));
  dialog->setInputMode(QInputDialog::IntInput);
  dialog->setIntRange(1, LabelSet::kMaxId);
  dialog->setIntValue(id);
  connect(dialog, &QInputDialog::intValueSelected, this, [this, id](int to) { renumber(id, to); });
  dialog->open();
}

void LabelController::renumber(int id, int to) {
  if (!find(id) || id == to) return;
  if (const LabelInfo* other = find(to)) {
    bench_.messages.warn(tr("“%1” has the number %2: choose another one, or merge the two.")
                             .arg(QString::fromStdString(other->name))
                             .arg(to));
    return;
  }
  LabelMarks marks = bench_.session.place().label_marks;
  const bool is_current = labels_.current() == id;
  const bool is_renumbered =
      document_.edit([=](AnnotationDocument& document) { document.renumber_label(id, to); });
  if (is_renumbered) emit labels_.relabeled(id, to);
  if (marks.hidden.erase(id) > 0) marks.hidden.insert(to);
  bench_.session.set_label_marks(marks);
  if (is_current) labels_.choose(to);
}

void LabelController::rename() {
  bench_.frame.showTab("annotate");
  palette_->editName(labels_.current());
}

bool LabelController::refuseLocked(const LabelInfo& label, const QString& hint) {
  if (!bench_.session.place().label_marks.locked.contains(label.id)) return false;
  bench_.messages.hint(hint.arg(label_name(label)));
  return true;
}

bool LabelController::isPainted(int id) const {
  const ScribbleLayer& layer = document_.document()->scribbles();
  return std::ranges::any_of(layer.painted_views(), [&](ViewIndex view) {
    const auto image = layer.view(view);
    return std::count(image.data, image.data + image.size(), id) > 0;
  });
}

void LabelController::remove(int id) {
  const LabelInfo* label = find(id);
  if (!label || refuseLocked(*label, tr("“%1” is locked: unlock it to remove it."))) return;
  if (!isPainted(id)) {
    removeNow(id);
    return;
  }
  auto* box = new_question_box(
      &bench_.window, {.name = "remove_label",
                       .title = tr("Remove a label"),
                       .text = tr("Remove “%1” and everything painted with it, on all views?")
                                   .arg(label_name(*label))});
  box->addButton(tr("Remove"), QMessageBox::AcceptRole)->setObjectName("remove_label.remove");
  connect(box, &QDialog::accepted, this, [this, id] { removeNow(id); });
  box->open();
}

void LabelController::removeNow(int id) {
  document_.edit([id](AnnotationDocument& document) { document.remove_label(id); });
}

void LabelController::recolor(int id) {
  const LabelInfo* label = find(id);
  if (!label) return;
  auto* dialog =
      new QColorDialog(QColor(label->color[0], label->color[1], label->color[2]), &bench_.window);
  dialog->setObjectName("label_color");
  dialog->setWindowTitle(tr("Color of “%1”").arg(label_name(*label)));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QColorDialog::colorSelected, this, [this, id](const QColor& color) {
    const Rgb rgb{static_cast<std::uint8_t>(color.red()), static_cast<std::uint8_t>(color.green()),
                  static_cast<std::uint8_t>(color.blue())};
    document_.edit([&](AnnotationDocument& edited) { edited.recolor_label(id, rgb); });
  });
  dialog->open();
}

namespace {

struct LabelLookControllerText {
  Q_DECLARE_TR_FUNCTIONS(episcope::LabelLookController)
};

constexpr const char* kDrawingKey = "annotate/drawing";
constexpr int kDrawingCount = 3;

using render::LabelDrawing;

QString name_of(LabelDrawing drawing) {
  switch (drawing) {
    case LabelDrawing::Fill:
      return LabelLookControllerText::tr("areas");
    case LabelDrawing::Contours:
      return LabelLookControllerText::tr("contours");
    case LabelDrawing::Both:
      return LabelLookControllerText::tr("areas and contours");
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
  QString tip = LabelLookControllerText::tr("%1 px painted on this view, %2 %")
                    .arg(QLocale::c().toString(static_cast<qlonglong>(amount.pixels)))
                    .arg(100 * share, 0, 'f', 2);
  if (amount.disparity) {
    tip += '\n' + LabelLookControllerText::tr("Disparity %1 ± %2 px, from %3 to %4 px")
                      .arg(number_text(amount.disparity->mean),
                           number_text(amount.disparity->deviation),
                           number_text(amount.disparity->min), number_text(amount.disparity->max));
  }
  return tip;
}

}  // namespace

/// Visibility, locks and drawing style of labels, and how much of the view each label covers.
class LabelLookController : public QObject {
  Q_OBJECT

 public:
  LabelLookController(const Workbench& bench, LabelPalette* palette)
      : QObject(&bench.owner), bench_(bench), palette_(palette), count_job_(this) {
    const int kept = QSettings().value(kDrawingKey).toInt();
    if (kept >= 0 && kept < kDrawingCount) {
      bench_.session.set_label_drawing(static_cast<LabelDrawing>(kept));
    }
    addCommands();
    connect(palette_, &LabelPalette::hiddenRequested, this,
            [this](int id, bool hides) { mark(&LabelMarks::hidden, id, hides); });
    connect(palette_, &LabelPalette::onlyRequested, this, &LabelLookController::showOnly);
    connect(palette_, &LabelPalette::lockedRequested, this,
            [this](int id, bool locks) { mark(&LabelMarks::locked, id, locks); });
    connect(&bench_.document, &DocumentController::replaced, this, &LabelLookController::count);
    connect(&bench_.document, &DocumentController::changed, this,
            [this](const DocumentChange& change) {
              if (change.has_new_labels) followLabels();
              count();
            });
    connect(&bench_.document, &DocumentController::steppedBack, this,
            [this](const DocumentChange&, const Edit& edit, bool is_undo) {
              tellLocked(edit, is_undo);
            });
    bench_.session.on_changed([this](Parts parts) { update(parts); });
  }

 private:
  void addCommands() {
    const auto current = [this] { return bench_.labels.current(); };
    const auto has_label = [current] { return current() != 0; };
    const auto marks = [this]() -> const LabelMarks& { return bench_.session.place().label_marks; };
    bench_.commands.add(
        {.menu = Menu::Labels, .section = label_section::kLook},
        {{.id = "annotate.hide_label",
          .text = tr("Hide label"),
          .tip = tr("Neither shows the current label nor paints over it"),
          .icon = "eye_off",
          .keys = {Qt::Key_V},
          .run =
              [=, this] {
                mark(&LabelMarks::hidden, current(), !marks().hidden.contains(current()));
              },
          .enabled = has_label,
          .checked = [=] { return marks().hidden.contains(current()); }},
         {.id = "annotate.only_label",
          .text = tr("Show only this label"),
          .tip = tr("Hides all other labels; a second time shows them again"),
          .run = [this, current] { showOnly(current()); },
          .enabled = has_label},
         {.id = "annotate.lock_label",
          .text = tr("Lock label"),
          .tip = tr("The current label is neither painted nor painted over"),
          .icon = "lock",
          .keys = {tr("Shift+V")},
          .run =
              [=, this] {
                mark(&LabelMarks::locked, current(), !marks().locked.contains(current()));
              },
          .enabled = has_label,
          .checked = [=] { return marks().locked.contains(current()); }},
         {.id = "annotate.drawing",
          .text = tr("Draw labels as areas, contours or both"),
          .tip = tr("Draws strokes and segments as areas, as contours, or as faint areas with "
                    "contours"),
          .keys = {tr("Shift+C")},
          .run = [this] { setDrawing(after(bench_.session.label_style().drawing)); },
          .enabled = [this] { return bench_.session.scene() != nullptr; }}});
  }

  void update(Parts parts) {
    if (parts.has(Part::LabelLook)) {
      palette_->setHidden(bench_.session.place().label_marks.hidden);
      palette_->setLocked(bench_.session.place().label_marks.locked);
      bench_.commands.refresh();
    }
    if (parts.has_any(Part::View | Part::Shown | Part::Estimates)) count();
  }

  void mark(std::set<std::int32_t> LabelMarks::*set, int id, bool is_marked) {
    LabelMarks marks = bench_.session.place().label_marks;
    is_marked ? void((marks.*set).insert(id)) : void((marks.*set).erase(id));
    bench_.session.set_label_marks(marks);
  }

  void showOnly(int id) {
    LabelMarks marks = bench_.session.place().label_marks;
    std::set<std::int32_t> others;
    for (const LabelInfo& label : bench_.document.labels().labels()) {
      if (label.id != id) others.insert(label.id);
    }
    marks.hidden = marks.hidden == others ? std::set<std::int32_t>{} : others;
    bench_.session.set_label_marks(marks);
  }

  void setDrawing(LabelDrawing drawing) {
    QSettings().setValue(kDrawingKey, static_cast<int>(drawing));
    bench_.session.set_label_drawing(drawing);
    bench_.messages.hint(tr("Labels are drawn as %1.").arg(name_of(drawing)));
  }

  /// Tells the user if undo or redo changed locked labels.
  // Locks keep the brush away; undo goes back whatever was locked since, as in painting programs.
  void tellLocked(const Edit& edit, bool is_undo) {
    const std::set<std::int32_t> touched = painted_labels(edit);
    QStringList names;
    for (const LabelInfo& label : bench_.document.labels().labels()) {
      const bool is_locked = bench_.session.place().label_marks.locked.contains(label.id);
      if (is_locked && touched.contains(label.id)) names << label_name(label);
    }
    if (names.isEmpty()) return;
    bench_.messages.hint((is_undo ? tr("Undo changed locked labels: %1. Redo restores them.")
                                  : tr("Redo changed locked labels: %1. Undo restores them."))
                             .arg(names.join(", ")));
  }

  /// Forgets hidden and locked marks of removed labels.
  void followLabels() {
    LabelMarks marks = bench_.session.place().label_marks;
    const auto is_gone = [this](std::int32_t id) { return !bench_.document.labels().contains(id); };
    std::erase_if(marks.hidden, is_gone);
    std::erase_if(marks.locked, is_gone);
    bench_.session.set_label_marks(marks);
  }

  void count() {
    const AnnotationDocument* document = bench_.document.document();
    const ViewIndex view = bench_.session.view();
    const auto layer =
        document ? document->scribbles().view(view) : ImageView<const std::uint8_t>{};
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

  /// `all`: number of pixels of the view.
  void showAmounts(const std::vector<LabelAmount>& amounts, double all) {
    std::map<std::int32_t, LabelPalette::Amount> texts;
    for (const LabelAmount& each : amounts) {
      texts[each.id] = {QLocale::c().toString(static_cast<qlonglong>(each.pixels)),
                        tip_of(each, static_cast<double>(each.pixels) / all)};
    }
    palette_->setAmounts(texts);
  }

  Workbench bench_;
  LabelPalette* palette_;
  LatestJob count_job_;
};

void add_label_look(const Workbench& bench, LabelPalette* palette) {
  new LabelLookController(bench, palette);
}

}  // namespace episcope

#include "moc_label_controller.cpp"

#include "label_controller.moc"
