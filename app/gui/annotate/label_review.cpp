// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/label_review.h"

#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/overlay.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/features.h"
#include "app/gui/shell/frame.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/picture.h"
#include "widgets/controls/text.h"

#include <QAction>
#include <QComboBox>
#include <QCoreApplication>
#include <QDialog>
#include <QScrollArea>

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

QString quoted(const LabelInfo& label) {
  return LabelReviewController::tr("“%1”").arg(label_name(label));
}

}  // namespace

LabelReviewController::LabelReviewController(const Workbench& bench, LabelReviewPanel* panel)
    : QObject(&bench.owner), bench_(bench), panel_(panel), job_(this) {
  addCommands();
  connect(panel_, &LabelReviewPanel::doubtChosen, this, &LabelReviewController::goTo);
  connect(panel_, &LabelReviewPanel::pieceChosen, this, &LabelReviewController::goToPiece);
  connect(panel_, &LabelReviewPanel::labelChosen, this,
          [this](int id) { bench_.labels.choose(id); });
  connect(&bench.labels, &LabelChoice::changed, this, &LabelReviewController::show);
  connect(&bench.overlay, &Overlay::drawn, this, &LabelReviewController::look);
  connect(&bench.labels, &LabelChoice::regionChanged, &bench.commands, &Commands::refresh);
  connect(&bench.document, &DocumentController::changed, this, &LabelReviewController::look);
  bench.session.on_changed([this](Parts parts) {
    if (parts.has_any(Part::Shown | Part::Estimates)) look();
  });
  bench.cancels.add(CancelRank::Mark, [this] {
    if (bench_.viewer_area.canvas()->outline().empty()) return false;
    bench_.viewer_area.canvas()->setOutline({});
    panel_->setCurrentDoubt(doubt_ = -1);
    bench_.labels.offerRegion(0, nullptr);
    return true;
  });
  show();
}

void LabelReviewController::addCommands() {
  const auto has_document = [this] { return bench_.document.document() != nullptr; };
  struct Row {
    const char* id;
    QString text;
    QString tip;
    QKeySequence key;
    int step;
  };
  for (const Row& row : std::initializer_list<Row>{
           {"review.next", tr("Next region in doubt"),
            tr("Goes to the places where a stroke decides most: large regions with another label "
               "nearly as probable"),
            Qt::Key_J, 1},
           {"review.previous", tr("Previous region in doubt"),
            tr("Goes back to the previous region in doubt"), tr("Shift+J"), -1}}) {
    QAction* action = bench_.commands.add({.id = row.id,
                                           .menu = Menu::Segmentation,
                                           .text = row.text,
                                           .tip = row.tip,
                                           .keys = {row.key},
                                           .run = [this, by = row.step] { step(by); },
                                           .section = kCheckSection,
                                           .enabled = has_document});
    panel_->addAction(action);
  }
}

namespace {

PixelRegion region_of(const Blob& blob) {
  PixelRegion region = region_where(blob.mask.height(), blob.mask.width(),
                                    [&](int y, int x) { return blob.mask.at(y, x) != 0; });
  for (PixelSpan& span : region) {
    span = {blob.bounds.y0 + span.y, blob.bounds.x0 + span.x0, blob.bounds.x0 + span.x1};
  }
  return region;
}

}  // namespace

std::optional<LabelReviewController::Subject> LabelReviewController::subject() const {
  const AnnotationDocument* document = bench_.document.document();
  if (!document || !bench_.session.scene()) return std::nullopt;
  const auto source = bench_.overlay.sourceOf({render::Quantity::Segmentation});
  if (!source) return std::nullopt;
  return Subject{bench_.session.generation(),
                 source->view,
                 source->labeling,
                 source->finish,
                 document->state(),
                 bench_.session.known_disparity(bench_.session.view())};
}

void LabelReviewController::look() {
  const std::optional<Subject> now = subject();
  if (now == subject_) return;
  const bool is_other_view = !now || !subject_ || now->view != subject_->view ||
                             now->scene != subject_->scene || now->labeling != subject_->labeling;
  subject_ = now;
  job_.drop();
  if (is_other_view) {
    review_ = nullptr;
    bench_.viewer_area.canvas()->setOutline({});
    doubt_ = -1;
    show();
  }
  if (now) begin(*now);
}

void LabelReviewController::begin(const Subject& subject) {
  const auto painted =
      std::make_shared<const ScribbleLayer>(bench_.document.document()->scribbles());
  job_.start<ViewReview>(
      [subject, painted](const Progress& progress) {
        return review_view(*subject.labeling, subject.finish, subject.view, *painted,
                           subject.disparity.get(), progress);
      },
      [this](ViewReview review) { take(std::move(review)); });
}

void LabelReviewController::take(ViewReview review) {
  review_ = std::make_shared<const ViewReview>(std::move(review));
  doubt_ = -1;
  show();
  if (const int step_by = std::exchange(awaited_, 0)) step(step_by);
}

LabelInfo LabelReviewController::infoOf(int id) const {
  const LabelInfo* known = bench_.document.labels().find(id);
  return known ? *known : LabelInfo{id, tr("label %1").arg(id).toStdString(), label_color(id)};
}

std::vector<LabelSummary>::const_iterator LabelReviewController::summaryOf(int id) const {
  return std::ranges::find_if(review_->labels,
                              [id](const LabelSummary& each) { return each.amount.id == id; });
}

LabelReviewPanel::Row LabelReviewController::rowOf(const LabelSummary& label,
                                                   std::int64_t all) const {
  const double percent = 100.0 * static_cast<double>(label.amount.pixels) /
                         static_cast<double>(std::max<std::int64_t>(all, 1));
  LabelReviewPanel::Row row{.label = infoOf(label.amount.id),
                            .pixels = label.amount.pixels,
                            .share = tr("%1 %").arg(percent, 0, 'f', 1),
                            .islands = label.count(PieceKind::Island),
                            .holes = label.count(PieceKind::Hole)};
  if (const auto& disparity = label.amount.disparity) {
    row.mean = number_text(disparity->mean, 2);
    row.min = number_text(disparity->min, 2);
    row.max = number_text(disparity->max, 2);
    row.tip = tr("Disparity in px per view: %1 ± %2 (mean and standard deviation), from %3 to %4")
                  .arg(number_text(disparity->mean), number_text(disparity->deviation),
                       number_text(disparity->min), number_text(disparity->max));
  }
  return row;
}

void LabelReviewController::show() {
  if (doubt_ < 0) bench_.labels.offerRegion(0, nullptr);
  if (!review_) {
    panel_->setNote(subject_ ? QString()
                    : !bench_.session.scene()
                        ? open_a_light_field()
                        : tr("Nothing is segmented yet: paint two labels, then update the "
                             "segmentation."));
    panel_->setDoubts({});
    panel_->setRows({}, 0);
    panel_->setPieces(tr("Islands and holes"), {});
    return;
  }
  panel_->setNote({});
  std::vector<LabelReviewPanel::Doubt> doubts;
  for (const LabelDoubt& each : review_->doubts) {
    doubts.push_back({infoOf(each.label), infoOf(each.rival), each.blob.pixels});
  }
  panel_->setDoubts(doubts);
  panel_->setCurrentDoubt(doubt_);
  std::int64_t all = 0;
  for (const LabelSummary& each : review_->labels) all += each.amount.pixels;
  std::vector<LabelReviewPanel::Row> rows;
  for (const LabelSummary& each : review_->labels) rows.push_back(rowOf(each, all));
  panel_->setRows(rows, bench_.labels.current());
  showPieces();
}

void LabelReviewController::showPieces() {
  const int current = bench_.labels.current();
  const auto found = summaryOf(current);
  std::vector<LabelReviewPanel::Piece> pieces;
  if (found != review_->labels.end()) {
    for (const LabelPiece& each : found->pieces) {
      if (each.kind == PieceKind::Main) continue;
      pieces.push_back({each.kind == PieceKind::Hole ? tr("hole") : tr("island"),
                        infoOf(each.label), each.blob.pixels});
    }
  }
  panel_->setPieces(current == 0 ? tr("Islands and holes")
                                 : tr("Islands and holes of %1").arg(quoted(infoOf(current))),
                    pieces);
}

void LabelReviewController::step(int by) {
  if (!subject_) {
    bench_.messages.hint(
        tr("Nothing is segmented yet: paint two labels, then update the segmentation."));
    return;
  }
  if (!review_) {
    awaited_ = by;
    return;
  }
  const int count = static_cast<int>(review_->doubts.size());
  if (count == 0) {
    bench_.messages.hint(tr("No region of this view is in doubt."));
    return;
  }
  goTo(doubt_ < 0 ? (by > 0 ? 0 : count - 1) : (doubt_ + by + count) % count);
}

void LabelReviewController::goTo(int index) {
  if (!review_ || index < 0 || index >= static_cast<int>(review_->doubts.size())) return;
  const LabelDoubt& doubt = review_->doubts[static_cast<std::size_t>(index)];
  doubt_ = index;
  panel_->setCurrentDoubt(index);
  mark(doubt.blob);
  bench_.labels.offerRegion(doubt.label,
                            [this, blob = region_of(doubt.blob)](int id) { give(blob, id); });
  bench_.messages.hint(tr("%1 of %2: %3 pixels of %4 may be %5. A stroke here decides; Return "
                          "keeps the label, 1 … 9 give it another.")
                           .arg(index + 1)
                           .arg(review_->doubts.size())
                           .arg(doubt.blob.pixels)
                           .arg(quoted(infoOf(doubt.label)), quoted(infoOf(doubt.rival))));
}

void LabelReviewController::give(const PixelRegion& region, int id) {
  PaintStyle style;
  style.label = id;
  style.protects_others = true;
  const ViewIndex view = bench_.session.view();
  bench_.document.edit(
      [&](AnnotationDocument& document) { fill_region(document, view, region, style); });
}

void LabelReviewController::goToPiece(int index) {
  if (!review_) return;
  const auto found = summaryOf(bench_.labels.current());
  if (found == review_->labels.end()) return;
  // The main part comes first and is not listed.
  const auto place = static_cast<std::size_t>(index) + 1;
  if (index >= 0 && place < found->pieces.size()) mark(found->pieces[place].blob);
}

void LabelReviewController::mark(const Blob& blob) {
  ViewCanvas* canvas = bench_.viewer_area.canvas();
  bench_.viewer_area.requestSingleView();
  canvas->setOutline(outline_of(blob.mask.view(), {blob.bounds.x0, blob.bounds.y0}));
  bench_.session.set_cross_hair(blob.inside);
  canvas->ensureVisible(blob.inside);
}

namespace {

struct StripControllerText {
  Q_DECLARE_TR_FUNCTIONS(episcope::StripController)
};

constexpr QSize kSize(620, 560);

EpiStripView::Epi drawn(const LabelEpi& epi, EpiDirection direction, std::int32_t label) {
  RgbaImage picture = epi.picture;
  return {
      direction == EpiDirection::Horizontal ? StripControllerText::tr("row %1").arg(epi.line)
                                            : StripControllerText::tr("column %1").arg(epi.line),
      to_qimage(std::move(picture)), boundaries_of(epi.labels.view(), label, Boundaries::OfLabel),
      boundaries_of(epi.labels.view(), label, Boundaries::Others)};
}

}  // namespace

/// A window with EPIs through the current label over the views, with label boundaries.
class StripController : public QObject {
  Q_OBJECT

 public:
  /// Adds its button to the panel.
  StripController(const Workbench& bench, LabelReviewPanel* panel)
      : QObject(&bench.owner),
        bench_(bench),
        dialog_(named("strip", new QDialog(&bench.window))),
        direction_(named("strip.direction", new QComboBox(dialog_))),
        strip_view_(new EpiStripView(dialog_)),
        job_(this) {
    dialog_->resize(kSize);
    direction_->addItem(tr("Horizontal EPIs: the views of this row"));
    direction_->addItem(tr("Vertical EPIs: the views of this column"));
    auto* scroll = new QScrollArea(dialog_);
    scroll->setWidgetResizable(true);
    scroll->setWidget(strip_view_);
    make_column(dialog_, {direction_, {scroll, 1}}, {.margins = kStyleMargins});
    addCommands(panel);
    connect(direction_, &QComboBox::activated, this, &StripController::update);
    connect(&bench.labels, &LabelChoice::changed, this, &StripController::update);
    connect(&bench.overlay, &Overlay::drawn, this, &StripController::update);
    connect(strip_view_, &EpiStripView::clicked, this, &StripController::goTo);
  }

 private:
  /// Input of a strip.
  struct Subject {
    LabelingPtr labeling;
    LabelFinish finish;
    int label = 0;
    ViewIndex view;
    EpiDirection direction = EpiDirection::Horizontal;
    friend bool operator==(const Subject&, const Subject&) = default;
  };

  void addCommands(LabelReviewPanel* panel) {
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
    panel->addAction(action);
  }

  void open() {
    dialog_->show();
    dialog_->raise();
    update();
  }

  // While the window is hidden, nothing is made.
  void update() {
    if (!dialog_->isVisible()) return;
    const LabelInfo* label = bench_.labels.info();
    dialog_->setWindowTitle(label ? tr("“%1” over the views").arg(label_name(*label))
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

  void begin(const Subject& subject) {
    job_.start<LabelStrip>(
        [subject, light_field = bench_.session.light_field()](const Progress& progress) {
          return label_strip(
              *light_field, *subject.labeling, subject.finish,
              {.label = subject.label, .view = subject.view, .direction = subject.direction},
              progress);
        },
        [this, subject](const LabelStrip& strip) { show(strip, subject); });
  }

  void show(const LabelStrip& strip, const Subject& subject) {
    strip_ = strip;
    std::vector<EpiStripView::Epi> epis;
    for (const LabelEpi& epi : strip.epis) {
      epis.push_back(drawn(epi, strip.direction, subject.label));
    }
    const LabelInfo* label = bench_.labels.info();
    const Rgb color = label ? label->color : label_color(subject.label);
    const bool is_horizontal = strip.direction == EpiDirection::Horizontal;
    strip_view_->setHint(tr("This view does not show this label."));
    strip_view_->setEpis(std::move(epis), QColor(color[0], color[1], color[2]),
                         is_horizontal ? subject.view.u : subject.view.v);
  }

  void hint(const QString& sentence) {
    subject_.reset();
    job_.drop();
    strip_view_->setHint(sentence);
    strip_view_->setEpis({}, {}, 0);
  }

  void goTo(int index, int view, int place) {
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

  [[nodiscard]] EpiDirection direction() const {
    return direction_->currentIndex() == 0 ? EpiDirection::Horizontal : EpiDirection::Vertical;
  }

  Workbench bench_;
  QDialog* dialog_;
  QComboBox* direction_;
  EpiStripView* strip_view_;
  std::optional<Subject> subject_;
  LabelStrip strip_;
  LatestJob job_;
};

void add_label_strip(const Workbench& bench, LabelReviewPanel* panel) {
  new StripController(bench, panel);
}

}  // namespace episcope

#include "moc_label_review.cpp"

#include "label_review.moc"
