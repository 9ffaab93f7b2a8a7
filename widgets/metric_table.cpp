// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/metric_table.h"

#include "widgets/tool_button.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QMenu>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>

namespace episcope {
namespace {

constexpr int kValueRole = Qt::UserRole;
constexpr int kIdRole = Qt::UserRole + 1;
constexpr double kHeaderScale = 0.88;
constexpr int kSortArrowWidth = 14;
constexpr int kColumnPadding = 9;
constexpr int kWidestText = 130;

/// Sorts numbers as numbers, texts as people sort them, and what is absent to the end, whichever
/// way is up.
class MetricItem : public QTableWidgetItem {
 public:
  using QTableWidgetItem::QTableWidgetItem;

  bool operator<(const QTableWidgetItem& other) const override {
    const QVariant mine = data(kValueRole);
    const QVariant theirs = other.data(kValueRole);
    if (!mine.isValid() || !theirs.isValid()) {
      const auto order = tableWidget()->horizontalHeader()->sortIndicatorOrder();
      const bool mine_first = mine.isValid() && !theirs.isValid();
      const bool theirs_first = !mine.isValid() && theirs.isValid();
      return order == Qt::AscendingOrder ? mine_first : theirs_first;
    }
    const bool are_numbers = mine.typeId() != QMetaType::QString;
    if (are_numbers) return mine.toDouble() < theirs.toDouble();
    return QString::localeAwareCompare(mine.toString(), theirs.toString()) < 0;
  }
};

QString csv_field(QString text) {
  if (!text.contains(',') && !text.contains('"') && !text.contains('\n')) return text;
  return '"' + text.replace('"', "\"\"") + '"';
}

QString latex_text(const QString& text) {
  QString escaped;
  for (const QChar c : text) {
    if (QStringLiteral("&%$#_{}").contains(c)) escaped += '\\';
    if (c == u'×') {
      escaped += "$\\times$";
    } else if (c == '\\') {
      escaped += "\\textbackslash{}";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

QString full_text(const QVariant& value) {
  if (!value.isValid()) return {};
  if (value.typeId() == QMetaType::QString) return value.toString();
  return QString::number(value.toDouble(), 'g', QLocale::FloatingPointShortest);
}

}  // namespace

MetricTable::MetricTable(QWidget* parent)
    : QWidget(parent),
      table_(new QTableWidget(this)),
      empty_(
          new QLabel(tr("Metrics appear here once there is a result and a ground truth."), this)),
      copy_csv_(make_tool_button({"metrics.copyCsv", "copy", tr("Copy as CSV"), tr("CSV")}, this)),
      copy_latex_(
          make_tool_button({"metrics.copyLatex", "copy", tr("Copy as LaTeX"), tr("LaTeX")}, this)),
      save_(make_tool_button({"metrics.save", "export", tr("Save as CSV or LaTeX"), tr("Save")},
                             this)) {
  setObjectName("metricTable");
  empty_->setObjectName("metrics.empty");
  empty_->setAlignment(Qt::AlignCenter);
  empty_->setWordWrap(true);
  setUpTable();
  auto* menu = new QMenu(save_);
  menu->addAction(tr("CSV…"), this, [this] { emit saveRequested("csv", toCsv()); });
  menu->addAction(tr("LaTeX…"), this, [this] { emit saveRequested("tex", toLatex()); });
  save_->setMenu(menu);
  save_->setPopupMode(QToolButton::InstantPopup);
  auto* row = new QHBoxLayout;
  row->setSpacing(2);
  for (auto* button : {copy_csv_, copy_latex_, save_}) row->addWidget(button);
  row->addStretch(1);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(4);
  layout->addWidget(empty_, 1);
  layout->addWidget(table_, 1);
  layout->addLayout(row);
  connect(copy_csv_, &QToolButton::clicked, this, &MetricTable::copyCsv);
  connect(copy_latex_, &QToolButton::clicked, this, &MetricTable::copyLatex);
  setTable({}, {});
}

void MetricTable::setUpTable() {
  table_->setObjectName("metrics.table");
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->setAlternatingRowColors(true);
  table_->setShowGrid(false);
  table_->setWordWrap(false);
  table_->verticalHeader()->hide();
  table_->verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 8);
  table_->horizontalHeader()->setHighlightSections(false);
  table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  table_->horizontalHeader()->setMinimumSectionSize(24);
  QFont small = font();
  small.setPointSizeF(small.pointSizeF() * kHeaderScale);
  table_->horizontalHeader()->setFont(small);
  connect(table_->horizontalHeader(), &QHeaderView::sortIndicatorChanged, this,
          &MetricTable::fitColumns);
  table_->horizontalHeader()->setSortIndicatorClearable(true);
  connect(table_, &QTableWidget::cellClicked, this, [this](int row, int) {
    emit rowClicked(table_->item(row, 0)->data(kIdRole).toULongLong());
  });
}

void MetricTable::setTable(const std::vector<MetricColumn>& columns,
                           const std::vector<MetricRow>& rows) {
  columns_ = columns;
  // Filling a table that sorts would move the rows while they are filled.
  const int sort_column = table_->horizontalHeader()->sortIndicatorSection();
  const Qt::SortOrder order = table_->horizontalHeader()->sortIndicatorOrder();
  const bool is_same_shape = table_->columnCount() == static_cast<int>(columns.size());
  table_->setSortingEnabled(false);
  table_->clear();
  table_->setColumnCount(static_cast<int>(columns.size()));
  table_->setRowCount(static_cast<int>(rows.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    auto* header = new QTableWidgetItem(columns[i].label);
    header->setToolTip(columns[i].help);
    header->setTextAlignment((i == 0 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    table_->setHorizontalHeaderItem(static_cast<int>(i), header);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) fillRow(static_cast<int>(i), rows[i]);
  table_->horizontalHeader()->setSortIndicator(is_same_shape ? sort_column : -1, order);
  table_->setSortingEnabled(true);
  fitColumns();
  const bool is_empty = rows.empty() || columns.empty();
  table_->setVisible(!is_empty);
  empty_->setVisible(is_empty);
  for (auto* button : {copy_csv_, copy_latex_, save_}) button->setEnabled(!is_empty);
}

// No wider than the text: a style would keep room for a sort arrow in every header.
void MetricTable::fitColumns() {
  const QHeaderView* header = table_->horizontalHeader();
  const QFontMetrics header_metrics(header->font());
  for (int column = 0; column < table_->columnCount(); ++column) {
    int header_width = header_metrics.size(0, table_->horizontalHeaderItem(column)->text()).width();
    if (header->sortIndicatorSection() == column) header_width += kSortArrowWidth;
    int width = header_width;
    for (int row = 0; row < table_->rowCount(); ++row) {
      const auto* item = table_->item(row, column);
      if (!item) continue;  // the table is being filled
      const int text_width = table_->fontMetrics().horizontalAdvance(item->text());
      width = std::max(width, std::min(text_width, kWidestText));
    }
    table_->setColumnWidth(column, width + kColumnPadding);
  }
}

void MetricTable::fillRow(int row, const MetricRow& values) {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const QVariant value = i < values.values.size() ? values.values[i] : QVariant();
    auto* item = new MetricItem;
    const bool is_text = value.typeId() == QMetaType::QString;
    item->setText(!value.isValid() ? QString("–")
                  : is_text        ? value.toString()
                                   : QString::number(value.toDouble(), 'f', columns_[i].decimals));
    item->setTextAlignment((is_text ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    item->setData(kValueRole, value);
    item->setData(kIdRole, values.id);
    if (is_text) item->setToolTip(value.toString());
    table_->setItem(row, static_cast<int>(i), item);
  }
}

void MetricTable::setEmptyText(const QString& text) {
  empty_->setText(text);
}

void MetricTable::setCurrent(quint64 id) {
  for (int row = 0; row < table_->rowCount(); ++row) {
    if (table_->item(row, 0)->data(kIdRole).toULongLong() == id) table_->selectRow(row);
  }
}

QString MetricTable::toCsv() const {
  QStringList header;
  for (const auto& column : columns_) header << csv_field(column.key);
  QString text = header.join(',') + '\n';
  for (int row = 0; row < table_->rowCount(); ++row) {
    QStringList fields;
    for (int column = 0; column < table_->columnCount(); ++column) {
      fields << csv_field(full_text(table_->item(row, column)->data(kValueRole)));
    }
    text += fields.join(',') + '\n';
  }
  return text;
}

QString MetricTable::toLatex() const {
  QStringList header;
  QString alignment;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    header << latex_text(columns_[i].label);
    alignment += i == 0 ? 'l' : 'r';
  }
  QString text =
      "\\begin{tabular}{" + alignment + "}\n\\hline\n" + header.join(" & ") + " \\\\\n\\hline\n";
  for (int row = 0; row < table_->rowCount(); ++row) {
    QStringList cells;
    for (int column = 0; column < table_->columnCount(); ++column) {
      const auto* item = table_->item(row, column);
      cells << (item->data(kValueRole).isValid() ? latex_text(item->text()) : QString("--"));
    }
    text += cells.join(" & ") + " \\\\\n";
  }
  return text + "\\hline\n\\end{tabular}\n";
}

void MetricTable::copyCsv() {
  QGuiApplication::clipboard()->setText(toCsv());
}
void MetricTable::copyLatex() {
  QGuiApplication::clipboard()->setText(toLatex());
}

}  // namespace episcope
