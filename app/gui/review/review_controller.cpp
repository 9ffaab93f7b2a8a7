// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/review/review_controller.h"

#include "app/gui/document/document_controller.h"
#include "app/gui/document/label_choice.h"
#include "app/gui/frame/cancels.h"
#include "app/gui/frame/commands.h"
#include "app/gui/frame/messages.h"
#include "app/gui/review/review_section.h"
#include "app/gui/stage/overlay.h"
#include "app/gui/stage/stage.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/style/number_text.h"

#include <QAction>

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

QString quoted(const LabelInfo& label) {
  return ReviewController::tr("“%1”").arg(QString::fromStdString(label.name));
}

}  // namespace

ReviewController::ReviewController(const Workbench& bench, CheckPanel* panel)
    : QObject(&bench.owner), bench_(bench), panel_(panel), job_(this) {
  addCommands();
  connect(panel_, &CheckPanel::doubtChosen, this, &ReviewController::goTo);
  connect(panel_, &CheckPanel::pieceChosen, this, &ReviewController::goToPiece);
  connect(panel_, &CheckPanel::labelChosen, this, [this](int id) { bench_.labels.choose(id); });
  connect(&bench.labels, &LabelChoice::changed, this, &ReviewController::show);
  connect(&bench.overlay, &Overlay::drawn, this, &ReviewController::look);
  connect(&bench.document, &DocumentController::changed, this, &ReviewController::look);
  bench.session.on_changed([this](Parts parts) {
    if (parts.has_any(Part::Shown | Part::Estimates)) look();
  });
  bench.cancels.add(CancelRank::Mark, [this] {
    if (bench_.stage.canvas()->outline().empty()) return false;
    bench_.stage.canvas()->setOutline({});
    panel_->setCurrentDoubt(doubt_ = -1);
    return true;
  });
  show();
}

void ReviewController::addCommands() {
  const auto has_document = [this] { return std::as_const(bench_.document).document() != nullptr; };
  struct Row {
    const char* id;
    QString text;
    QString tip;
    QKeySequence key;
    int step;
  };
  for (const Row& row : std::initializer_list<Row>{
           {"review.next", tr("Next region in doubt"),
            tr("Goes to where a stroke would decide most: large regions of which another label is "
               "nearly as probable"),
            Qt::Key_J, 1},
           {"review.previous", tr("Previous region in doubt"),
            tr("Goes back to the region in doubt before"), tr("Shift+J"), -1}}) {
    QAction* action = bench_.commands.add({.id = row.id,
                                           .menu = Menu::Segmentation,
                                           .text = row.text,
                                           .tip = row.tip,
                                           .keys = {row.key},
                                           .run = [this, by = row.step] { step(by); },
                                           .section = kCheckSection,
                                           .enabled = has_document});
    panel_->addAction(action, QString("button.%1").arg(row.id));
  }
}

std::optional<ReviewController::Subject> ReviewController::subject() const {
  const AnnotationDocument* document = std::as_const(bench_.document).document();
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

void ReviewController::look() {
  const std::optional<Subject> now = subject();
  if (now == subject_) return;
  const bool is_other_view = !now || !subject_ || now->view != subject_->view ||
                             now->scene != subject_->scene || now->labeling != subject_->labeling;
  subject_ = now;
  job_.drop();
  if (is_other_view) {
    review_ = nullptr;
    bench_.stage.canvas()->setOutline({});
    doubt_ = -1;
    show();
  }
  if (now) begin(*now);
}

void ReviewController::begin(const Subject& subject) {
  const auto painted =
      std::make_shared<const ScribbleLayer>(std::as_const(bench_.document).document()->scribbles());
  job_.start<ViewReview>(
      [subject, painted](const Progress& progress) {
        return review_view(*subject.labeling, subject.finish, subject.view, *painted,
                           subject.disparity.get(), progress);
      },
      [this](ViewReview review) { take(std::move(review)); });
}

void ReviewController::take(ViewReview review) {
  review_ = std::make_shared<const ViewReview>(std::move(review));
  doubt_ = -1;
  show();
  if (const int step_by = std::exchange(awaited_, 0)) step(step_by);
}

LabelInfo ReviewController::infoOf(int id) const {
  const AnnotationDocument* document = std::as_const(bench_.document).document();
  const LabelInfo* known = document ? document->labels().find(id) : nullptr;
  return known ? *known : LabelInfo{id, tr("label %1").arg(id).toStdString(), label_color(id)};
}

std::vector<LabelSummary>::const_iterator ReviewController::summaryOf(int id) const {
  return std::ranges::find_if(review_->labels,
                              [id](const LabelSummary& each) { return each.amount.id == id; });
}

CheckPanel::Row ReviewController::rowOf(const LabelSummary& label, std::int64_t all) const {
  const double percent = 100.0 * static_cast<double>(label.amount.pixels) /
                         static_cast<double>(std::max<std::int64_t>(all, 1));
  CheckPanel::Row row{.label = infoOf(label.amount.id),
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

void ReviewController::show() {
  if (!review_) {
    panel_->setNote(subject_ ? QString()
                    : !bench_.session.scene()
                        ? tr("Open a light field first.")
                        : tr("Nothing is segmented yet: paint two labels, then update the "
                             "segmentation."));
    panel_->setDoubts({});
    panel_->setRows({}, 0);
    panel_->setPieces(tr("Islands and holes"), {});
    return;
  }
  panel_->setNote({});
  std::vector<CheckPanel::Doubt> doubts;
  for (const LabelDoubt& each : review_->doubts) {
    doubts.push_back({infoOf(each.label), infoOf(each.rival), each.blob.pixels});
  }
  panel_->setDoubts(doubts);
  panel_->setCurrentDoubt(doubt_);
  std::int64_t all = 0;
  for (const LabelSummary& each : review_->labels) all += each.amount.pixels;
  std::vector<CheckPanel::Row> rows;
  for (const LabelSummary& each : review_->labels) rows.push_back(rowOf(each, all));
  panel_->setRows(rows, bench_.labels.current());
  showPieces();
}

void ReviewController::showPieces() {
  const int current = bench_.labels.current();
  const auto found = summaryOf(current);
  std::vector<CheckPanel::Piece> pieces;
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

void ReviewController::step(int by) {
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

void ReviewController::goTo(int index) {
  if (!review_ || index < 0 || index >= static_cast<int>(review_->doubts.size())) return;
  const LabelDoubt& doubt = review_->doubts[static_cast<std::size_t>(index)];
  doubt_ = index;
  panel_->setCurrentDoubt(index);
  mark(doubt.blob);
  bench_.messages.hint(tr("%1 of %2: %3 pixels of %4 may be %5. A stroke here decides.")
                           .arg(index + 1)
                           .arg(review_->doubts.size())
                           .arg(doubt.blob.pixels)
                           .arg(quoted(infoOf(doubt.label)), quoted(infoOf(doubt.rival))));
}

void ReviewController::goToPiece(int index) {
  if (!review_) return;
  const auto found = summaryOf(bench_.labels.current());
  if (found == review_->labels.end()) return;
  // The main part comes first and is not listed.
  const auto place = static_cast<std::size_t>(index) + 1;
  if (index >= 0 && place < found->pieces.size()) mark(found->pieces[place].blob);
}

void ReviewController::mark(const Blob& blob) {
  ViewCanvas* canvas = bench_.stage.canvas();
  bench_.stage.requestSingleView();
  canvas->setOutline(outline_of(blob.mask.view(), {blob.bounds.x0, blob.bounds.y0}));
  bench_.session.set_cross_hair(blob.inside);
  canvas->ensureVisible(blob.inside);
}

}  // namespace episcope

#include "moc_review_controller.cpp"
