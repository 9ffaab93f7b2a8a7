// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/label_controller.h"

#include "app/gui/annotate/annotate_section.h"
#include "app/gui/document/document_controller.h"
#include "app/gui/document/label_choice.h"
#include "app/gui/frame/commands.h"
#include "app/gui/frame/frame.h"
#include "app/gui/frame/messages.h"
#include "app/gui/frame/question_box.h"
#include "app/gui/stage/stage.h"
#include "app/session/session.h"
#include "widgets/annotate/label_palette.h"

#include <QColorDialog>
#include <QPushButton>

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

constexpr int kLabelKeys = 9;

}  // namespace

LabelController::LabelController(const Workbench& bench, LabelPalette* palette)
    : QObject(&bench.owner),
      bench_(bench),
      document_(bench.document),
      labels_(bench.labels),
      palette_(palette) {
  addChoiceCommands();
  addEditCommands();
  connect(palette_, &LabelPalette::currentChosen, this, &LabelController::choose);
  connect(palette_, &LabelPalette::addRequested, this, &LabelController::add);
  connect(palette_, &LabelPalette::removeRequested, this, &LabelController::remove);
  connect(palette_, &LabelPalette::colorRequested, this, &LabelController::recolor);
  connect(palette_, &LabelPalette::renameRequested, this, [this](int id, const QString& name) {
    const bool is_renamed = document_.edit([&](AnnotationDocument& document) {
      document.rename_label(id, name.trimmed().toStdString());
    });
    if (!is_renamed) show();  // the row holds what was typed
  });
  connect(&labels_, &LabelChoice::changed, this, &LabelController::show);
  connect(&document_, &DocumentController::replaced, this, &LabelController::show);
  connect(&document_, &DocumentController::changed, this, [this](const DocumentChange& change) {
    if (change.has_new_labels) show();
  });
  connect(&bench.stage, &Stage::previewChanged, this, &LabelController::showHint);
  show();
}

void LabelController::addChoiceCommands() {
  const auto has_label = [this] { return labels_.current() != 0; };
  for (int id = 1; id <= kLabelKeys; ++id) {
    bench_.commands.add({.id = QString("annotate.label_%1").arg(id),
                         .menu = Menu::Label,
                         .text = tr("Label %1").arg(id),
                         .tip = tr("Paints with label %1").arg(id),
                         .keys = {QKeySequence(Qt::Key_0 + id)},
                         .run = [this, id] { choose(id); },
                         .section = label_section::kLabels,
                         .enabled = [this] { return hasDocument(); },
                         .visible = [this, id] { return find(id) || !hasDocument(); },
                         .live_text =
                             [this, id] {
                               const LabelInfo* label = find(id);
                               return label ? QString::fromStdString(label->name)
                                            : tr("Label %1").arg(id);
                             }});
  }
  bench_.commands.add({.id = "annotate.next_label",
                       .menu = Menu::Label,
                       .text = tr("Next label"),
                       .tip = tr("Paints with the next label"),
                       .keys = {Qt::Key_N},
                       .run = [this] { labels_.chooseNext(); },
                       .section = label_section::kEdit,
                       .enabled = has_label});
  bench_.commands.add({.id = "annotate.swap_labels",
                       .menu = Menu::Label,
                       .text = tr("Swap labels"),
                       .tip = tr("Returns to the label used before"),
                       .keys = {Qt::Key_X},
                       .run = [this] { labels_.swap(); },
                       .section = label_section::kEdit,
                       .enabled = has_label});
}

void LabelController::addEditCommands() {
  const auto add_one = [this](const QString& id, const QString& text, const QString& tip,
                              const QString& icon, const QList<QKeySequence>& keys,
                              std::function<void()> run) {
    bench_.commands.add({.id = "annotate." + id,
                         .menu = Menu::Label,
                         .text = text,
                         .tip = tip,
                         .icon = icon,
                         .keys = keys,
                         .run = std::move(run),
                         .section = label_section::kEdit,
                         .enabled = [this, is_first = id == "add_label"] {
                           return is_first ? hasDocument() : labels_.current() != 0;
                         }});
  };
  add_one("add_label", tr("Add label"), tr("Adds a label, to be named and painted with"), "add",
          {tr("Ctrl+Shift+N")}, [this] { add(); });
  add_one("rename_label", tr("Rename label"), tr("Renames the current label"), "rename",
          {Qt::Key_F2}, [this] { rename(); });
  add_one("recolor_label", tr("Change colour…"), tr("Changes the colour of the current label"), {},
          {}, [this] { recolor(labels_.current()); });
  add_one("remove_label", tr("Remove label"),
          tr("Removes the current label and everything painted with it"), "trash", {},
          [this] { remove(labels_.current()); });
}

bool LabelController::hasDocument() const {
  return document_.document() != nullptr;
}

const LabelInfo* LabelController::find(int id) const {
  const AnnotationDocument* document = std::as_const(document_).document();
  return document ? document->labels().find(id) : nullptr;
}

void LabelController::show() {
  const AnnotationDocument* document = std::as_const(document_).document();
  palette_->setLabels(document ? document->labels().labels() : std::vector<LabelInfo>());
  palette_->setCurrent(labels_.current());
  palette_->setEnabled(document != nullptr);
  showHint();
  bench_.commands.refresh();
}

void LabelController::showHint() {
  palette_->setHint(
      hasDocument() ? tr("No labels yet. Add one for each kind of thing, then paint a few strokes "
                         "on the view.")
      : bench_.stage.isPreviewing() ? tr("The light field is still loading.")
                                    : tr("Open a light field to label it."));
}

void LabelController::choose(int id) {
  if (hasDocument() && !labels_.choose(id)) {
    bench_.messages.hint(tr("There is no label %1.").arg(id));
  }
}

void LabelController::add() {
  int id = 0;
  document_.edit([&](AnnotationDocument& document) { id = document.add_label(); });
  if (id == 0) return;
  labels_.choose(id);
  rename();
}

void LabelController::rename() {
  bench_.frame.showTab("annotate");
  palette_->editName(labels_.current());
}

bool LabelController::isPainted(int id) const {
  const ScribbleLayer& layer = document_.document()->scribbles();
  return std::ranges::any_of(layer.painted_views(), [&](ViewIndex view) {
    const auto image = layer.view(view);
    const std::size_t size = static_cast<std::size_t>(image.height) * image.width;
    return std::find(image.data, image.data + size, id) != image.data + size;
  });
}

void LabelController::remove(int id) {
  const LabelInfo* label = find(id);
  if (!label) return;
  if (bench_.session.place().label_marks.locked.contains(id)) {
    bench_.messages.hint(
        tr("“%1” is locked: unlock it to remove it.").arg(QString::fromStdString(label->name)));
    return;
  }
  if (!isPainted(id)) {
    removeNow(id);
    return;
  }
  auto* box = new_question_box(
      &bench_.window, {.name = "remove_label",
                       .title = tr("Remove a label"),
                       .text = tr("Remove “%1” and everything painted with it, on all views?")
                                   .arg(QString::fromStdString(label->name))});
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
  dialog->setWindowTitle(tr("Colour of “%1”").arg(QString::fromStdString(label->name)));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QColorDialog::colorSelected, this, [this, id](const QColor& color) {
    const Rgb rgb{static_cast<std::uint8_t>(color.red()), static_cast<std::uint8_t>(color.green()),
                  static_cast<std::uint8_t>(color.blue())};
    document_.edit([&](AnnotationDocument& edited) { edited.recolor_label(id, rgb); });
  });
  dialog->open();
}

}  // namespace episcope

#include "moc_label_controller.cpp"
