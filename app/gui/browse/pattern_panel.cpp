// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/browse/pattern_panel.h"

#include "engine/core/error.h"
#include "widgets/style/breakable_text.h"
#include "widgets/style/theme.h"

#include <QFileInfo>
#include <QHeaderView>
#include <QLabel>
#include <QTreeWidget>
#include <QVBoxLayout>

namespace episcope {
namespace {

constexpr int kListHeight = 110;
constexpr int kNumberWidth = 64;
constexpr int kViewColumn = 4;

QString number_text(const std::optional<long long>& number) {
  return number ? QString::number(*number) : QString();
}

QTreeWidgetItem* make_item(const io::NamePreview& name, const QPalette& palette) {
  const QString view = name.view ? QString("%1,%2").arg(name.view->v).arg(name.view->u) : QString();
  auto* item = new QTreeWidgetItem({QString::fromStdString(name.name), number_text(name.row),
                                    number_text(name.column), number_text(name.index), view});
  item->setToolTip(0, item->text(0));
  if (name.is_match) return item;
  item->setText(kViewColumn, PatternPanel::tr("no match"));
  for (int column = 0; column < item->columnCount(); ++column) {
    item->setForeground(column, theme::muted_text(palette));
  }
  return item;
}

QString summary_of(const io::PatternPreview& preview) {
  const QString problem = breakable(QString::fromStdString(preview.problem));
  if (preview.images == 0) return problem;
  const QString matches =
      PatternPanel::tr("%1 of %2 images match").arg(preview.matches).arg(preview.images);
  if (!preview.problem.empty()) {
    return matches + ": " + problem;
  }
  const QString grid =
      preview.is_list
          ? PatternPanel::tr("a list of %1 views, whose rows the images tell").arg(preview.grid.u)
          : PatternPanel::tr("%1×%2 views").arg(preview.grid.v).arg(preview.grid.u);
  QString warnings;
  for (const std::string& warning : preview.warnings) {
    warnings += ". " + breakable(QString::fromStdString(warning));
  }
  return matches + ": " + grid + warnings;
}

io::PatternPreview preview_of(const std::string& folder, const std::string& pattern,
                              bool is_snake) {
  try {
    io::PatternPreview preview = io::preview_pattern(folder, pattern, is_snake);
    if (preview.images == 0) preview.problem = PatternPanel::tr("no images here").toStdString();
    return preview;
  } catch (const Error& error) {
    io::PatternPreview preview;
    preview.problem = error.what();
    return preview;
  }
}

}  // namespace

PatternPanel::PatternPanel(const QString& path, QWidget* parent)
    : QWidget(parent),
      folder_(QFileInfo(path).isDir() ? path : QFileInfo(path).absolutePath()),
      summary_(new QLabel(this)),
      names_(new QTreeWidget(this)),
      job_(this) {
  auto* help = new QLabel(
      tr("{row} and {col} stand for the numbers of a view, {index} for a running number, {x} and "
         "{y} for positions, * for anything. After re: follows a regular expression, as in "
         "re:view_(?<row>\\d+)_(?<col>\\d+)\\.png."),
      this);
  help->setTextFormat(Qt::PlainText);
  help->setWordWrap(true);
  help->setPalette(theme::text_palette(theme::muted_text(palette())));
  summary_->setObjectName("pattern.summary");
  summary_->setTextFormat(Qt::PlainText);
  summary_->setWordWrap(true);
  names_->setObjectName("pattern.names");
  names_->setHeaderLabels({tr("File"), tr("Row"), tr("Column"), tr("Number"), tr("View")});
  names_->setRootIsDecorated(false);
  names_->setUniformRowHeights(true);
  names_->setTextElideMode(Qt::ElideMiddle);
  names_->setMinimumHeight(kListHeight);
  names_->header()->setStretchLastSection(false);
  names_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  for (int column = 1; column < names_->columnCount(); ++column) {
    names_->header()->setSectionResizeMode(column, QHeaderView::Fixed);
    names_->header()->resizeSection(column, kNumberWidth);
  }
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(help);
  layout->addWidget(names_, 1);
  layout->addWidget(summary_);
}

void PatternPanel::preview(const std::string& pattern, bool is_snake) {
  job_.start<io::PatternPreview>(
      [folder = folder_.toStdString(), pattern, is_snake](const Progress&) {
        return preview_of(folder, pattern, is_snake);
      },
      [this](const io::PatternPreview& preview) { fill(preview); });
}

void PatternPanel::fill(const io::PatternPreview& preview) {
  names_->clear();
  QList<QTreeWidgetItem*> items;
  bool has_row = false;
  bool has_index = false;
  bool has_view = false;
  for (const io::NamePreview& name : preview.names) {
    items << make_item(name, palette());
    has_row |= name.row || name.column;
    has_index |= name.index.has_value();
    has_view |= name.view.has_value() || !name.is_match;
  }
  names_->addTopLevelItems(items);
  names_->setColumnHidden(1, !has_row);
  names_->setColumnHidden(2, !has_row);
  names_->setColumnHidden(3, !has_index);
  names_->setColumnHidden(kViewColumn, !has_view);
  summary_->setText(summary_of(preview));
  const bool is_wrong = !preview.problem.empty() || !preview.warnings.empty();
  summary_->setPalette(is_wrong ? theme::text_palette(theme::warning_text(palette())) : palette());
}

}  // namespace episcope

#include "moc_pattern_panel.cpp"
