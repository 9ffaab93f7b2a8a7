// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/label_scores.h"

#include "app/session/label_review.h"

#include <QStringList>

#include <utility>

namespace episcope {
namespace {

QString percent(double share) {
  return QString::number(100 * share, 'f', 1) + " %";
}

QString words_of(const LabelingScores& scores) {
  QStringList parts;
  const auto of_view = scores.view.all.share();
  const auto of_all = scores.all_views.all.share();
  const auto overlap = scores.view.all.mean_overlap();
  const auto near = scores.view.boundaries.share();
  if (of_view) parts << LabelScores::tr("correct: %1 of this view").arg(percent(*of_view));
  if (near) parts << LabelScores::tr("%1 near boundaries").arg(percent(*near));
  if (overlap) parts << LabelScores::tr("mean IoU %1").arg(percent(*overlap));
  if (of_all) parts << LabelScores::tr("%1 of all").arg(percent(*of_all));
  if (of_view && scores.is_by_overlap) parts << LabelScores::tr("labels matched by overlap");
  if (scores.consistency) {
    parts << LabelScores::tr("consistent: %1").arg(percent(*scores.consistency));
  }
  return parts.join(", ");
}

}  // namespace

LabelScores::LabelScores(const Session& session, QObject* parent)
    : QObject(parent), session_(session), job_(this) {}

void LabelScores::judge(const Judged& judged, std::shared_ptr<const DisparityField> disparity) {
  const Known now{judged, session_.true_labels(), session_.view()};
  if (now == known_) return;
  known_ = now;
  text_.clear();
  job_.drop();
  if (!judged.labeling) return;
  job_.start<LabelingScores>(
      [now, disparity = std::move(disparity), scene = session_.scene(),
       infos = session_.true_label_infos()](const Progress& progress) {
        static const ViewStack<std::int32_t> kNone;
        const Judged& of = now.judged;
        return matched(
            judge_labeling(finished_labels(*of.labeling, of.finish, progress.part(0, 0.3)),
                           now.view, now.truth ? *now.truth : kNone, *scene->truth, disparity.get(),
                           progress.part(0.3, 1)),
            of.labels, infos);
      },
      [this](const LabelingScores& scores) {
        text_ = words_of(scores);
        emit changed();
      });
}

}  // namespace episcope

#include "moc_label_scores.cpp"
