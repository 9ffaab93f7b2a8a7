// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/review/strip_controller.h"

#include "app/gui/document/label_choice.h"
#include "app/gui/frame/commands.h"
#include "app/gui/review/review_section.h"
#include "app/gui/stage/overlay.h"
#include "widgets/annotate/check_panel.h"
#include "widgets/annotate/epi_strip_view.h"
#include "widgets/style/picture.h"

#include <QAction>
#include <QComboBox>
#include <QDialog>
#include <QScrollArea>
#include <QVBoxLayout>

namespace episcope {
namespace {

constexpr QSize kSize(620, 560);

EpiStripView::Epi drawn(const LabelEpi& epi, EpiDirection direction, std::int32_t label) {
  RgbaImage picture = epi.picture;
  return {direction == EpiDirection::Horizontal ? StripController::tr("row %1").arg(epi.line)
                                                : StripController::tr("column %1").arg(epi.line),
          to_qimage(std::move(picture)),
          boundaries_of(epi.labels.view(), label, Boundaries::OfLabel),
          boundaries_of(epi.labels.view(), label, Boundaries::Others)};
}

}  // namespace

StripController::StripController(const Workbench& bench, CheckPanel* panel)
    : QObject(&bench.owner),
      bench_(bench),
      dialog_(new QDialog(&bench.window)),
      direction_(new QComboBox(dialog_)),
      strip_view_(new EpiStripView(dialog_)),
      job_(this) {
  dialog_->setObjectName("strip");
  dialog_->resize(kSize);
  direction_->setObjectName("strip.direction");
  direction_->addItem(tr("Horizontal EPIs: the views of this row"));
  direction_->addItem(tr("Vertical EPIs: the views of this column"));
  auto* scroll = new QScrollArea(dialog_);
  scroll->setWidgetResizable(true);
  scroll->setWidget(strip_view_);
  auto* layout = new QVBoxLayout(dialog_);
  layout->addWidget(direction_);
  layout->addWidget(scroll, 1);
  addCommands(panel);
  connect(direction_, &QComboBox::activated, this, &StripController::update);
  connect(&bench.labels, &LabelChoice::changed, this, &StripController::update);
  connect(&bench.overlay, &Overlay::drawn, this, &StripController::update);
  connect(strip_view_, &EpiStripView::clicked, this, &StripController::goTo);
}

void StripController::addCommands(CheckPanel* panel) {
  QAction* action = bench_.commands.add(
      {.id = "review.strip",
       .menu = Menu::Segmentation,
       .text = tr("Label over the views…"),
       .tip = tr("Shows EPIs through the current label with the boundaries of labels: straight "
                 "lines where the views agree"),
       .keys = {tr("Shift+L")},
       .run = [this] { open(); },
       .section = kCheckSection,
       .enabled = [this] { return bench_.labels.current() != 0; }});
  panel->addAction(action, "button.review.strip");
}

void StripController::open() {
  dialog_->show();
  dialog_->raise();
  update();
}

EpiDirection StripController::direction() const {
  return direction_->currentIndex() == 0 ? EpiDirection::Horizontal : EpiDirection::Vertical;
}

void StripController::hint(const QString& sentence) {
  subject_.reset();
  job_.drop();
  strip_view_->setHint(sentence);
  strip_view_->setEpis({}, {}, 0);
}

// While the window is hidden, nothing is made.
void StripController::update() {
  if (!dialog_->isVisible()) return;
  const LabelInfo* label = bench_.labels.info();
  dialog_->setWindowTitle(label ? tr("“%1” over the views").arg(QString::fromStdString(label->name))
                                : tr("Label over the views"));
  const auto source =
      label ? bench_.overlay.sourceOf({render::Quantity::Segmentation}) : std::nullopt;
  if (!source || source->labeling->labels.grid() != bench_.session.light_field()->grid()) {
    hint(tr("This shows labels of all views: segment all views first (Shift+U)."));
    return;
  }
  const Subject now{source->labeling, source->finish, label->id, source->view, direction()};
  if (now == subject_) return;
  subject_ = now;
  begin(now);
}

void StripController::begin(const Subject& subject) {
  job_.start<LabelStrip>(
      [subject, light_field = bench_.session.light_field()](const Progress& progress) {
        return label_strip(
            *light_field, *subject.labeling, subject.finish,
            {.label = subject.label, .view = subject.view, .direction = subject.direction},
            progress);
      },
      [this, subject](const LabelStrip& strip) { show(strip, subject); });
}

void StripController::show(const LabelStrip& strip, const Subject& subject) {
  strip_ = strip;
  std::vector<EpiStripView::Epi> epis;
  for (const LabelEpi& epi : strip.epis) {
    epis.push_back(drawn(epi, strip.direction, subject.label));
  }
  const LabelInfo* label = bench_.labels.info();
  const Rgb color = label ? label->color : label_color(subject.label);
  const bool is_horizontal = strip.direction == EpiDirection::Horizontal;
  strip_view_->setHint(tr("This label is not seen in this view."));
  strip_view_->setEpis(std::move(epis), QColor(color[0], color[1], color[2]),
                       is_horizontal ? subject.view.u : subject.view.v);
}

void StripController::goTo(int index, int view, int place) {
  const int line = strip_.epis[static_cast<std::size_t>(index)].line;
  const int at = strip_.first_place + place;
  if (strip_.direction == EpiDirection::Horizontal) {
    bench_.session.set_cross_hair({line, at});
    bench_.session.set_view({bench_.session.view().v, view});
  } else {
    bench_.session.set_cross_hair({at, line});
    bench_.session.set_view({view, bench_.session.view().u});
  }
}

}  // namespace episcope

#include "moc_strip_controller.cpp"
