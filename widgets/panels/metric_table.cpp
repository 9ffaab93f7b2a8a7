// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/metric_table.h"

#include "engine/core/text_table.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QAction>
#include <QClipboard>
#include <QEvent>
#include <QGuiApplication>
#include <QHeaderView>
#include <QLocale>
#include <QMenu>
#include <QTableWidget>
#include <QToolButton>

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

constexpr int kValueRole = Qt::UserRole;
constexpr int kIdRole = Qt::UserRole + 1;
constexpr double kHeaderScale = 0.88;
constexpr int kSortArrowWidth = 14;
constexpr int kColumnPadding = 7;
constexpr int kWidestText = 150;
constexpr int kNarrowestName = 70;
constexpr int kSideWidth = 26;

bool is_absent(const QVariant& value) {
  return !value.isValid() || (value.typeId() == QMetaType::Double && std::isnan(value.toDouble()));
}

/// Sorts numbers as numbers, texts as people sort them, and what is absent to the end, whichever
/// way is up.
class MetricItem : public QTableWidgetItem {
 public:
  using QTableWidgetItem::QTableWidgetItem;

  bool operator<(const QTableWidgetItem& other) const override {
    const QVariant mine = data(kValueRole);
    const QVariant theirs = other.data(kValueRole);
    if (is_absent(mine) || is_absent(theirs)) {
      const auto order = tableWidget()->horizontalHeader()->sortIndicatorOrder();
      const bool mine_first = !is_absent(mine) && is_absent(theirs);
      const bool theirs_first = is_absent(mine) && !is_absent(theirs);
      return order == Qt::AscendingOrder ? mine_first : theirs_first;
    }
    const bool are_numbers = mine.typeId() != QMetaType::QString;
    if (are_numbers) return mine.toDouble() < theirs.toDouble();
    return QString::localeAwareCompare(mine.toString(), theirs.toString()) < 0;
  }
};

QString full_text(const QVariant& value) {
  if (is_absent(value)) return {};
  if (value.typeId() == QMetaType::QString) return value.toString();
  return QString::number(value.toDouble(), 'g', QLocale::FloatingPointShortest);
}

}  // namespace

MetricTable::MetricTable(QWidget* parent)
    : QWidget(parent),
      table_(named("metrics.table", new QTableWidget(this))),
      empty_(named(
          "metrics.empty",
          new QLabel(tr("Metrics appear here once there is a result and a ground truth."), this))),
      copy_csv_(make_tool_button({"metrics.copyCsv", "copy", tr("Copy as CSV (Ctrl+C)"), tr("CSV")},
                                 this)),
      copy_latex_(
          make_tool_button({"metrics.copyLatex", "copy", tr("Copy as LaTeX"), tr("LaTeX")}, this)),
      save_(make_tool_button({"metrics.save", "export", tr("Save as CSV or LaTeX"), tr("Save…")},
                             this)) {
  setObjectName("metricTable");
  setUpTable();
  auto* menu = new QMenu(save_);
  menu->addAction(tr("CSV…"), this, [this] { emit saveRequested("csv", toCsv()); });
  menu->addAction(tr("LaTeX…"), this, [this] { emit saveRequested("tex", toLatex()); });
  QMenu* columns = menu->addMenu(tr("Columns"));
  connect(columns, &QMenu::aboutToShow, this, [this, columns] { addColumnsTo(*columns); });
  // No menu of the button's own, whose arrow would stand below the text.
  connect(save_, &QToolButton::clicked, menu,
          [this, menu] { menu->popup(save_->mapToGlobal(QPoint(0, save_->height()))); });
  lay_out_list(this, empty_, table_, {copy_csv_, copy_latex_, save_});
  connect(copy_csv_, &QToolButton::clicked, this, &MetricTable::copyCsv);
  connect(copy_latex_, &QToolButton::clicked, this, &MetricTable::copyLatex);
  fill();
  theme::follow_palette(this, this, [this] { stressBest(); });
}

void MetricTable::setUpTable() {
  table_->setAccessibleName(tr("Metrics of all results"));
  table_->viewport()->installEventFilter(this);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->setAlternatingRowColors(true);
  table_->setShowGrid(false);
  table_->setWordWrap(false);
  table_->setIconSize({14, 14});
  table_->verticalHeader()->hide();
  table_->verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 8);
  table_->horizontalHeader()->setHighlightSections(false);
  table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  table_->horizontalHeader()->setMinimumSectionSize(24);
  QFont small = font();
  small.setPointSizeF(small.pointSizeF() * kHeaderScale);
  table_->horizontalHeader()->setFont(small);
  table_->setContextMenuPolicy(Qt::CustomContextMenu);
  connect(table_, &QTableWidget::customContextMenuRequested, this, &MetricTable::showMenu);
  table_->horizontalHeader()->setContextMenuPolicy(Qt::CustomContextMenu);
  connect(table_->horizontalHeader(), &QHeaderView::customContextMenuRequested, this,
          &MetricTable::showMenu);
  auto* copy = new QAction(tr("Copy"), this);
  copy->setShortcut(QKeySequence::Copy);
  copy->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  connect(copy, &QAction::triggered, this, &MetricTable::copyCsv);
  addAction(copy);
  connect(table_->horizontalHeader(), &QHeaderView::sortIndicatorChanged, this,
          &MetricTable::fitColumns);
  table_->horizontalHeader()->setSortIndicatorClearable(true);
  connect(table_, &QTableWidget::cellClicked, this, [this](int row, int) {
    emit rowClicked(table_->item(row, 0)->data(kIdRole).toULongLong());
  });
}

void MetricTable::setTable(const std::vector<MetricColumn>& columns,
                           const std::vector<MetricRow>& rows) {
  if (columns == columns_ && rows == rows_) return;
  columns_ = columns;
  rows_ = rows;
  fill();
}

void MetricTable::fill() {
  // Filling a table that sorts would move the rows while they are filled.
  const int sort_column = table_->horizontalHeader()->sortIndicatorSection();
  const Qt::SortOrder order = table_->horizontalHeader()->sortIndicatorOrder();
  const bool is_same_shape = table_->columnCount() == static_cast<int>(columns_.size());
  table_->setSortingEnabled(false);
  table_->clear();
  table_->setColumnCount(static_cast<int>(columns_.size()));
  table_->setRowCount(static_cast<int>(rows_.size()));
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    auto* header = new QTableWidgetItem(columns_[i].label);
    header->setToolTip(columns_[i].help);
    header->setTextAlignment((i == 0 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    table_->setHorizontalHeaderItem(static_cast<int>(i), header);
    table_->setColumnHidden(static_cast<int>(i), !columns_[i].is_shown || isHidden(columns_[i]));
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) fillRow(static_cast<int>(i), rows_[i]);
  stressBest();
  table_->horizontalHeader()->setSortIndicator(is_same_shape ? sort_column : -1, order);
  table_->setSortingEnabled(true);
  fitColumns();
  table_->setVisible(!isEmpty());
  empty_->setVisible(isEmpty());
  for (auto* button : {copy_csv_, copy_latex_, save_}) button->setEnabled(!isEmpty());
}

// No wider than the text: a style would keep room for a sort arrow in every header. Names of
// results leave room for the numbers.
void MetricTable::fitColumns() {
  int room = table_->viewport()->width();
  for (int column = table_->columnCount() - 1; column >= 0; --column) {
    int width = widthOf(column);
    if (column == 0) width = std::min(width, std::max(room, kNarrowestName));
    table_->setColumnWidth(column, width);
    if (!table_->isColumnHidden(column)) room -= width;
  }
}

int MetricTable::widthOf(int column) const {
  const QHeaderView* header = table_->horizontalHeader();
  const auto* label = table_->horizontalHeaderItem(column);
  if (!label) return 0;  // the table is being filled, as below
  int width = QFontMetrics(header->font()).size(0, label->text()).width();
  if (header->sortIndicatorSection() == column) width += kSortArrowWidth;
  for (int row = 0; row < table_->rowCount(); ++row) {
    const auto* item = table_->item(row, column);
    if (!item) continue;
    const int icon_width = item->icon().isNull() ? 0 : kSideWidth;
    const int text_width = QFontMetrics(item->font()).horizontalAdvance(item->text()) + icon_width;
    width = std::max(width, std::min(text_width, kWidestText));
  }
  return width + kColumnPadding;
}

bool MetricTable::eventFilter(QObject* watched, QEvent* event) {
  if (watched == table_->viewport() && event->type() == QEvent::Resize) fitColumns();
  return QWidget::eventFilter(watched, event);
}

void MetricTable::fillRow(int row, const MetricRow& values) {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const QVariant value = i < values.values.size() ? values.values[i] : QVariant();
    auto* item = new MetricItem;
    const bool is_text = value.typeId() == QMetaType::QString;
    item->setText(is_absent(value) ? QString("–")
                  : is_text        ? value.toString()
                                   : number_text(value.toDouble(), columns_[i].decimals));
    item->setTextAlignment((is_text ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    item->setData(kValueRole, value);
    item->setData(kIdRole, values.id);
    if (is_text) item->setToolTip(value.toString());
    table_->setItem(row, static_cast<int>(i), item);
  }
  if (values.warning.isEmpty()) return;
  QTableWidgetItem* name = table_->item(row, 0);
  name->setToolTip(name->text() + '\n' + values.warning);
  name->setText(warned_name(name->text()));
}

void MetricTable::setSides(quint64 a, quint64 b) {
  for (int row = 0; row < table_->rowCount(); ++row) {
    QTableWidgetItem* item = table_->item(row, 0);
    const quint64 id = item->data(kIdRole).toULongLong();
    if (id == a) table_->selectRow(row);
    item->setIcon(side_icon(b == 0    ? Side::None
                            : id == a ? Side::A
                            : id == b ? Side::B
                                      : Side::None));
  }
  fitColumns();
}

// Emphasizes all ties, but not a value without others.
void MetricTable::stressBest() {
  for (int column = 0; column < table_->columnCount(); ++column) {
    const BestValue best = columns_[static_cast<std::size_t>(column)].best;
    std::vector<QTableWidgetItem*> known;
    for (int row = 0; row < table_->rowCount(); ++row) {
      QTableWidgetItem* item = table_->item(row, column);
      if (!is_absent(item->data(kValueRole))) known.push_back(item);
    }
    if (best == BestValue::None || known.size() < 2) continue;
    const auto value = [](const QTableWidgetItem* item) {
      return item->data(kValueRole).toDouble();
    };
    const auto [least, greatest] =
        std::minmax_element(known.begin(), known.end(),
                            [&](const auto* a, const auto* b) { return value(a) < value(b); });
    const QString winner = (best == BestValue::Least ? *least : *greatest)->text();
    for (QTableWidgetItem* item : known) {
      if (item->text() != winner) continue;
      QFont font = table_->font();
      font.setBold(true);
      item->setFont(font);
      item->setForeground(theme::success_text(palette()));
      item->setToolTip(tr("Best of this column"));
    }
  }
}

void MetricTable::showMenu(const QPoint& position) {
  auto* menu = named("metrics.menu", new QMenu(this));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->addAction(themed_icon("copy"), tr("Copy as CSV"), this, &MetricTable::copyCsv);
  menu->addAction(themed_icon("copy"), tr("Copy as LaTeX"), this, &MetricTable::copyLatex);
  addColumnsTo(*menu->addMenu(tr("Columns")));
  const auto* item = sender() == table_->horizontalHeader() ? nullptr : table_->itemAt(position);
  if (item) {
    const quint64 id = item->data(kIdRole).toULongLong();
    menu->addSeparator();
    menu->addAction(side_icon(Side::A), tr("Show"), this, [this, id] { emit rowClicked(id); });
    menu->addAction(side_icon(Side::B), tr("Compare with"), this,
                    [this, id] { emit compareRequested(id); });
  }
  menu->popup(table_->viewport()->mapToGlobal(position));
}

void MetricTable::addColumnsTo(QMenu& menu) {
  menu.setObjectName("metrics.columns");
  menu.clear();
  for (std::size_t i = 1; i < columns_.size(); ++i) {  // names of results stay
    const MetricColumn& column = columns_[i];
    QAction* action = menu.addAction(QString(column.label).replace('\n', ' '));
    action->setCheckable(true);
    action->setChecked(!isHidden(column));
    connect(action, &QAction::toggled, this, [this, key = column.key](bool is_wanted) {
      chosen_[key] = is_wanted;
      fill();
    });
  }
}

bool MetricTable::isHidden(const MetricColumn& column) const {
  return !chosen_.value(column.key, !column.is_minor);
}

QString MetricTable::toCsv() const {
  TextTable text;
  for (const auto& column : columns_) text.header.push_back(column.key.toStdString());
  for (int row = 0; row < table_->rowCount(); ++row) {
    auto& cells = text.rows.emplace_back();
    for (int column = 0; column < table_->columnCount(); ++column) {
      cells.push_back(full_text(table_->item(row, column)->data(kValueRole)).toStdString());
    }
  }
  return QString::fromStdString(table_to_csv(text));
}

QString MetricTable::toLatex() const {
  TextTable text;
  for (const auto& column : columns_) {
    if (isHidden(column)) continue;
    text.header.push_back(QString(column.label).replace('\n', ' ').toStdString());
  }
  for (int row = 0; row < table_->rowCount(); ++row) {
    auto& cells = text.rows.emplace_back();
    auto& stressed = text.stressed.emplace_back();
    for (int column = 0; column < table_->columnCount(); ++column) {
      if (isHidden(columns_[static_cast<std::size_t>(column)])) continue;
      const auto* item = table_->item(row, column);
      const QVariant value = item->data(kValueRole);
      const bool is_text = value.typeId() == QMetaType::QString;
      cells.push_back(is_absent(value) ? "--"
                                       : (is_text ? value.toString() : item->text()).toStdString());
      stressed.push_back(item->font().bold());
    }
  }
  return QString::fromStdString(table_to_latex(text));
}

void MetricTable::copyCsv() {
  QGuiApplication::clipboard()->setText(toCsv());
  emit copied(tr("CSV"));
}

void MetricTable::copyLatex() {
  QGuiApplication::clipboard()->setText(toLatex());
  emit copied(tr("LaTeX"));
}

}  // namespace episcope

#include "moc_metric_table.cpp"
