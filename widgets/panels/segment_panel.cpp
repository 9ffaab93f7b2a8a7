// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/segment_panel.h"

#include "annotation/document.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/number_spin.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QHBoxLayout>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QToolButton>

#include <algorithm>

namespace episcope {
namespace {

constexpr int kNoteLines = 2;
constexpr int kSettingsHeight = 170;
constexpr int kLeastSettingsHeight = 130;

}  // namespace

SegmentPanel::SegmentPanel(QWidget* parent)
    : QWidget(parent),
      chip_(named("segment.state", new QLabel(this))),
      actions_(make_row({kRoom}, {.spacing = 2})),
      overlays_(make_row({kRoom}, {.spacing = 2})),
      note_(named("segment.note", new QLabel(this))),
      fold_(named("segment.settings", new QToolButton(this))),
      settings_(named("segment.form", new QScrollArea(this))),
      source_(named("segment.source", new QComboBox(this))),
      all_views_(named("segment.keepAll", new QCheckBox(tr("All views after each stroke"), this))),
      smoothing_(named("segment.smoothing", new NumberSpin(this))),
      form_(new ParameterForm(this)) {
  setObjectName("segmentPanel");
  chip_->setTextFormat(Qt::PlainText);
  note_->setTextFormat(Qt::PlainText);
  note_->setWordWrap(true);
  note_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  note_->setMinimumHeight(kNoteLines *
                          fontMetrics().lineSpacing());  // what is above stays in place
  fold_->setText(tr("Settings"));
  fold_->setToolTip(tr("Shows the settings of the segmentation"));
  fold_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  fold_->setArrowType(Qt::RightArrow);
  fold_->setAutoRaise(true);
  fold_->setFocusPolicy(Qt::NoFocus);
  auto* above = make_row({{actions_, 1}, chip_}, {.spacing = 2});
  auto* below = new QHBoxLayout;
  below->setSpacing(theme::kSpacing);
  below->addWidget(fold_, 0, Qt::AlignTop);
  below->addWidget(note_, 1);
  make_column(this, {above, overlays_, below, makeSettings()}, {.spacing = 4});
  connect(fold_, &QToolButton::clicked, this,
          [this] { setSettingsVisible(settings_->isHidden()); });
  connect(form_, &ParameterForm::valuesChanged, this, &SegmentPanel::parametersEdited);
  connect(source_, &QComboBox::activated, this, &SegmentPanel::sourceEdited);
  connect(all_views_, &QCheckBox::toggled, this, &SegmentPanel::keepsAllViewsEdited);
  setSettingsVisible(false);
  setNote({});
  theme::follow_palette(this, this, [this] { showMood(); });
}

QWidget* SegmentPanel::makeSettings() {
  source_->setToolTip(
      tr("Disparity that propagates labels from view to view, and that the classifier may use as a "
         "feature"));
  source_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  all_views_->setToolTip(
      tr("Strokes change the labels of all views: they are corrected near what "
         "the strokes say, or segmented anew if that cannot be"));
  auto* row =
      make_row({new QLabel(tr("Disparity"), this), {source_, 1}}, {.spacing = theme::kSpacing});
  auto* content = new QWidget(settings_);
  make_column(content, {row, makeSmoothing(), form_, all_views_, kRoom},
              {.margins = {0, 0, theme::kSpacing, 0}, .spacing = theme::kSpacing});
  set_up_scrolling(settings_);
  settings_->setMinimumHeight(kLeastSettingsHeight);  // rather than a window beyond the screen
  settings_->setMaximumHeight(kSettingsHeight);
  settings_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Preferred);
  settings_->setWidget(content);
  return settings_;
}

QLayout* SegmentPanel::makeSmoothing() {
  const QString tip =
      tr("Smooths the boundaries of all labels; 0 shows them as they were computed. Can be undone");
  smoothing_->setRange(0, AnnotationDocument::kMaxSmoothing_px);
  smoothing_->setDecimals(2);
  smoothing_->setLeastDecimals(1);
  smoothing_->setSingleStep(0.5);
  smoothing_->setKeyboardTracking(false);
  smoothing_->setSuffix(tr(" px"));
  smoothing_->setToolTip(tip);
  auto* label = new QLabel(tr("Smooth boundaries by"), this);
  label->setBuddy(smoothing_);
  label->setToolTip(tip);
  connect(smoothing_, &NumberSpin::valueChanged, this, &SegmentPanel::smoothingEdited);
  return make_row({label, smoothing_, kRoom}, {.spacing = theme::kSpacing});
}

void SegmentPanel::setState(const QString& text, ChipMood mood, const QString& detail) {
  chip_->setText(text);
  chip_->setToolTip(detail);
  mood_ = mood;
  showMood();
}

void SegmentPanel::showMood() {
  QColor color = theme::muted_text(palette());
  if (mood_ == ChipMood::Busy) color = palette().color(QPalette::WindowText);
  if (mood_ == ChipMood::Stale || mood_ == ChipMood::Hint) color = theme::warning_text(palette());
  if (mood_ == ChipMood::Failed) color = theme::error_text(palette());
  chip_->setPalette(theme::text_palette(color));
}

void SegmentPanel::setParameters(const std::vector<ParameterDescription>& parameters) {
  form_->setParameters(parameters);
}

void SegmentPanel::setSources(const std::vector<Source>& sources, int current) {
  const QSignalBlocker blocker(source_);
  source_->clear();
  for (const Source& source : sources) {
    source_->addItem(source.name, source.id);
    source_->setItemData(source_->count() - 1, source.name, Qt::ToolTipRole);
    set_item_enabled(source_, source_->count() - 1, source.is_available);
  }
  source_->setCurrentIndex(std::max(0, source_->findData(current)));
}

void SegmentPanel::setSettingsVisible(bool are_visible) {
  settings_->setVisible(are_visible);
  fold_->setArrowType(are_visible ? Qt::DownArrow : Qt::RightArrow);
}

}  // namespace episcope

#include "moc_segment_panel.cpp"
