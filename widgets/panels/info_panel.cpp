// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/info_panel.h"

#include "widgets/controls/labels.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QGridLayout>
#include <QLabel>
#include <QRegularExpression>
#include <QScrollArea>

#include <algorithm>
#include <iterator>

namespace episcope {
namespace {

constexpr int kColumns = 3;  // key, value, arrow
constexpr int kWarningLines = 4;
constexpr int kValueLines = 3;
constexpr QSize kIconSize(14, 14);
constexpr QSize kArrowSize(10, 10);

// A number and its unit stay in one line.
QString with_units(QString text) {
  static const QRegularExpression before_unit("(?<=\\d) (?=(%|px|MB)(\\W|$))");
  return text.replace(before_unit, QString(QChar::Nbsp));
}

// A few lines: all of it after a click, or, of a path, its beginning and end.
QLabel* make_value(const QString& text, int lines, QWidget* parent) {
  if (!text.contains(' ')) {
    auto* path = new ElidedLabel(parent, Qt::ElideMiddle);
    path->setFullText(text);
    return path;
  }
  auto* label = new FoldedLabel(parent, lines);
  label->setFullText(with_units(text));
  return label;
}

/// How a fact was found out: long, and read by few.
QLabel* make_quiet(const QString& text, const char* name, QWidget* parent) {
  auto* label = named(name, new QLabel(breakable(with_units(text)), parent));
  label->setTextFormat(Qt::PlainText);
  label->setWordWrap(true);
  label->setMinimumWidth(1);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  label->setPalette(theme::text_palette(theme::muted_text(parent->palette())));
  return label;
}

QToolButton* make_button(QAction* action, QWidget* parent) {
  auto* button = named("info.action", new QToolButton(parent));
  button->setDefaultAction(action);
  button->setToolButtonStyle(Qt::ToolButtonTextOnly);
  return button;
}

}  // namespace

InfoPanel::InfoPanel(QWidget* parent)
    : QWidget(parent),
      title_(named("info.title", new ElidedLabel(this))),
      conventions_(named("info.conventions", new QToolButton(this))),
      scroll_(named("info.scroll", new QScrollArea(this))) {
  setObjectName("infoPanel");
  QFont bold = font();
  bold.setBold(true);
  title_->setFont(bold);
  set_up_scrolling(scroll_);
  scroll_->viewport()->setAutoFillBackground(false);
  auto* layout = make_column(this, {title_, {scroll_, 1}}, {.spacing = 4});
  layout->addWidget(conventions_, 0, Qt::AlignLeft);
  setInfo({}, {}, {});
  theme::follow_palette(this, this, [this] { rebuild(); });
}

void InfoPanel::setInfo(const QString& title, const std::vector<InfoRow>& rows,
                        const std::vector<InfoWarning>& warnings) {
  title_->setFullText(title.isEmpty() ? tr("No light field") : title);
  if (rows == rows_ && warnings == warnings_ && scroll_->widget()) return;
  rows_ = rows;
  warnings_ = warnings;
  const QAction* conventions = conventions_->defaultAction();
  conventions_->setVisible(!conventions ||
                           !std::ranges::count(warnings, conventions, &InfoWarning::action));
  rebuild();
}

// A short line with the whole text behind its arrow; else the text, of which a click shows all.
void InfoPanel::addWarning(const InfoWarning& warning, QAction* action, QGridLayout* grid) {
  QWidget* body = grid->parentWidget();
  auto* line = new QWidget(body);
  auto* icon = new QLabel(line);
  icon->setPixmap(themed_icon(warning.is_note ? "info" : "warning").pixmap(kIconSize));
  icon->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  auto* label = new FoldedLabel(line, kWarningLines);
  label->setFullText(with_units(warning.brief.isEmpty() ? warning.text : warning.brief));
  label->setObjectName("info.warning");
  if (!warning.is_note) label->setPalette(theme::text_palette(theme::warning_text(palette())));
  auto* layout = make_grid(line, theme::kSpacing, 0);
  layout->setColumnStretch(1, 1);
  layout->addWidget(icon, 0, 0);
  layout->addWidget(label, 0, 1);
  if (!warning.brief.isEmpty()) {
    auto* text = make_quiet(warning.text, "info.warning.text", line);
    layout->addWidget(text, 1, 1, 1, 2);
    layout->addWidget(makeArrow("warning", warning.brief, label, {text}), 0, 2, Qt::AlignTop);
  }
  if (action) layout->addWidget(make_button(action, line), 2, 1, Qt::AlignLeft);
  grid->addWidget(line, grid->rowCount(), 0, 1, kColumns);
}

QToolButton* InfoPanel::makeArrow(const QString& id, const QString& key, QLabel* value,
                                  const std::vector<QWidget*>& behind) {
  auto* folded = qobject_cast<FoldedLabel*>(value);
  auto* arrow = named("info.more." + id, new QToolButton(value->parentWidget()));
  arrow->setAutoRaise(true);
  arrow->setCheckable(true);
  arrow->setAccessibleName(tr("More on %1").arg(key));
  arrow->setIconSize(kArrowSize);
  arrow->setFixedSize(kArrowSize + QSize(4, 4));
  const auto show = [this, arrow, folded, behind, key](bool is_open) {
    arrow->setArrowType(is_open ? Qt::DownArrow : Qt::RightArrow);
    arrow->setToolTip(is_open ? tr("Hide the evidence") : tr("Show the evidence"));
    arrow->setChecked(is_open);
    if (folded) folded->setOpen(is_open);
    for (QWidget* each : behind) each->setVisible(is_open);
    if (is_open) {
      open_.insert(key);
    } else {
      open_.erase(key);
    }
  };
  connect(arrow, &QToolButton::clicked, this, show);
  if (folded) connect(folded, &FoldedLabel::toggled, this, show);
  show(open_.contains(key));
  return arrow;
}

void InfoPanel::addRow(const InfoRow& row, QGridLayout* grid) {
  QWidget* body = grid->parentWidget();
  auto* key = new QLabel(row.key, body);
  key->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  key->setPalette(theme::text_palette(theme::muted_text(palette())));
  // With an arrow the line stays one: the arrow opens it.
  const bool has_more = !row.tip.isEmpty() || !row.check.isEmpty() || row.action;
  QLabel* value = make_value(row.value, has_more ? 1 : kValueLines, body);
  if (!row.id.isEmpty()) value->setObjectName("info." + row.id);
  const int line = grid->rowCount();
  grid->addWidget(key, line, 0);
  grid->addWidget(value, line, 1, 1, has_more ? 1 : kColumns - 1);
  std::vector<QWidget*> behind;
  const auto add_below = [&](QLabel* text) {
    grid->addWidget(text, grid->rowCount(), 0, 1, kColumns);
    behind.push_back(text);
  };
  if (!row.tip.isEmpty()) add_below(make_quiet(row.tip, "info.tip", body));
  if (!row.check.isEmpty()) add_below(make_quiet(row.check, "info.check", body));
  if (row.action) {
    // Over all columns: it is as wide as its text, and the panel is narrow.
    QToolButton* button = make_button(row.action, body);
    grid->addWidget(button, grid->rowCount(), 0, 1, kColumns, Qt::AlignLeft);
    if (!row.needs_action) behind.push_back(button);
  }
  if (has_more) grid->addWidget(makeArrow(row.id, row.key, value, behind), line, 2, Qt::AlignTop);
}

void InfoPanel::rebuild() {
  auto* body = new QWidget;
  body->setPalette(palette());
  auto* grid = make_grid(body, theme::kSpacing, 3);
  grid->setColumnStretch(1, 1);
  // First of all: below the rows they would be out of sight.
  for (auto warning = warnings_.begin(); warning != warnings_.end(); ++warning) {
    // One that helps with several stands below the last of them.
    const bool is_last = std::ranges::count(std::next(warning), warnings_.end(), warning->action,
                                            &InfoWarning::action) == 0;
    addWarning(*warning, is_last ? warning->action : nullptr, grid);
  }
  for (const InfoRow& row : rows_) addRow(row, grid);
  grid->setRowStretch(grid->rowCount(), 1);
  scroll_->setWidget(body);  // Deletes the body before.
  body->setAutoFillBackground(false);
}

}  // namespace episcope

#include "moc_info_panel.cpp"
