// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/info_panel.h"

#include "widgets/controls/labels.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QRegularExpression>
#include <QScrollArea>
#include <QVBoxLayout>

namespace episcope {
namespace {

// A number and its unit stay in one line.
QString with_units(QString text) {
  static const QRegularExpression before_unit("(?<=\\d) (?=(%|px|MB)(\\W|$))");
  return text.replace(before_unit, QString(QChar::Nbsp));
}

/// Sentences wrap; a word that cannot wrap, such as a path, is elided in the middle.
QLabel* make_value(const QString& text, QWidget* parent) {
  if (!text.contains(' ')) {
    auto* label = new ElidedLabel(parent, Qt::ElideMiddle);
    label->setFullText(text);
    return label;
  }
  auto* label = new QLabel(breakable(with_units(text)), parent);
  label->setTextFormat(Qt::PlainText);
  label->setWordWrap(true);
  label->setMinimumWidth(1);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  return label;
}

/// How a fact was found out: long, and read by few.
QLabel* make_check(const QString& text, QWidget* parent) {
  auto* label = new FoldedLabel(parent);
  label->setFullText(text);
  label->setObjectName("info.check");
  label->setPalette(theme::text_palette(theme::muted_text(parent->palette())));
  return label;
}

QWidget* make_warning(const QString& text, QWidget* parent) {
  auto* warning = new QWidget(parent);
  auto* icon = new QLabel(warning);
  icon->setPixmap(themed_icon("warning").pixmap(14, 14));
  icon->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  auto* label = make_value(text, warning);
  label->setObjectName("info.warning");
  label->setPalette(theme::text_palette(theme::warning_text(parent->palette())));
  auto* layout = new QHBoxLayout(warning);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(icon);
  layout->addWidget(label, 1);
  return warning;
}

QToolButton* make_button(QAction* action, QWidget* parent) {
  auto* button = new QToolButton(parent);
  button->setObjectName("info.action");
  button->setAutoRaise(true);
  button->setDefaultAction(action);
  return button;
}

}  // namespace

InfoPanel::InfoPanel(QWidget* parent)
    : QWidget(parent),
      title_(new ElidedLabel(this)),
      conventions_(new QToolButton(this)),
      scroll_(new QScrollArea(this)) {
  setObjectName("infoPanel");
  title_->setObjectName("info.title");
  QFont bold = font();
  bold.setBold(true);
  title_->setFont(bold);
  conventions_->setObjectName("info.conventions");
  conventions_->setAutoRaise(true);
  scroll_->setObjectName("info.scroll");
  scroll_->setFrameShape(QFrame::NoFrame);
  scroll_->setWidgetResizable(true);
  scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll_->viewport()->setAutoFillBackground(false);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(4);
  layout->addWidget(title_);
  layout->addWidget(scroll_, 1);
  layout->addWidget(conventions_, 0, Qt::AlignLeft);
  setInfo({}, {}, {});
}

void InfoPanel::setInfo(const QString& title, const std::vector<InfoRow>& rows,
                        const QStringList& warnings) {
  title_->setFullText(title.isEmpty() ? tr("No light field") : title);
  if (rows == rows_ && warnings == warnings_ && scroll_->widget()) return;
  rows_ = rows;
  warnings_ = warnings;
  rebuild();
}

void InfoPanel::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) rebuild();
}

void InfoPanel::rebuild() {
  auto* body = new QWidget;
  body->setPalette(palette());
  auto* grid = new QGridLayout(body);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(theme::kMargin);
  grid->setVerticalSpacing(3);
  grid->setColumnStretch(1, 1);
  int line = 0;
  // First of all: below the rows they would be out of sight.
  for (const auto& warning : warnings_) {
    grid->addWidget(make_warning(warning, body), line++, 0, 1, 2);
  }
  for (const auto& row : rows_) {
    auto* key = new QLabel(row.key, body);
    key->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    key->setPalette(theme::text_palette(theme::muted_text(palette())));
    auto* value = make_value(row.value, body);
    if (!row.id.isEmpty()) value->setObjectName("info." + row.id);
    if (!row.tip.isEmpty()) {
      value->setToolTip(row.tip);
      value->setAccessibleDescription(row.tip);
    }
    grid->addWidget(key, line, 0);
    grid->addWidget(value, line++, 1);
    if (!row.check.isEmpty()) grid->addWidget(make_check(row.check, body), line++, 1);
    if (row.action) grid->addWidget(make_button(row.action, body), line++, 0, 1, 2);
  }
  grid->setRowStretch(line, 1);
  scroll_->setWidget(body);  // Deletes the body before.
  body->setAutoFillBackground(false);
}

}  // namespace episcope

#include "moc_info_panel.cpp"
