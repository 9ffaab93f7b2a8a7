// SPDX-License-Identifier: BSD-3-Clause
#include "tests/app/gui/annotating.h"

#include "app/session/session.h"
#include "engine/evaluation/label_quality.h"
#include "widgets/canvas/view_canvas.h"

#include <QTest>

namespace episcope {

Annotating::Annotating(const std::string& id) {
  openSmall(id);
  QTRY_VERIFY_WITH_TIMEOUT(window.bench().document.document(), kPatience);
  trigger("annotate.mode");
}

QColor Annotating::shownAt(PixelIndex pixel) const {
  return canvas()->scribbles().pixelColor(pixel.x, pixel.y);
}

double Annotating::accuracy() {
  const LabelingPtr labeling = segment().labeler().labeling(view());
  const auto& truth = window.bench().session.scene()->truth->labels;
  return judge_labels(labeling->labels.view(view()), truth.view(view())).share().value_or(0);
}

}  // namespace episcope
