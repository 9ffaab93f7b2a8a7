// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QHash>
#include <QLabel>
#include <QString>
#include <QVariant>
#include <QWidget>

#include <vector>

class QMenu;
class QTableWidget;
class QToolButton;

namespace episcope {

enum class BestValue { None, Least, Greatest };

struct MetricColumn {
  QString key;    ///< CSV header, e.g. "mse_100".
  QString label;  ///< Table header.
  QString help;   ///< Tool tip.
  int decimals = 3;
  BestValue best = BestValue::None;
  bool is_shown = true;   ///< Else it stands in copied and saved tables only.
  bool is_minor = false;  ///< Hidden until it is chosen in the menu of columns.
  friend bool operator==(const MetricColumn&, const MetricColumn&) = default;
};

struct MetricRow {
  quint64 id = 0;
  /// One value per column: a double, a string, or an invalid QVariant if the metric is missing.
  std::vector<QVariant> values;
  QString warning{};  ///< The name then has a warning sign, and this in its tool tip.
  friend bool operator==(const MetricRow&, const MetricRow&) = default;
};

/// Metrics of all results, sortable by any column (numbers as numbers, missing and NaN last), with
/// the best of each column emphasized. Copies or saves the shown order as CSV or LaTeX; Ctrl+C
/// copies CSV. A menu chooses the columns of table and LaTeX.
class MetricTable : public QWidget {
  Q_OBJECT

 public:
  explicit MetricTable(QWidget* parent = nullptr);

  /// Costs nothing without changes.
  void setTable(const std::vector<MetricColumn>& columns, const std::vector<MetricRow>& rows);
  /// Why the table is empty, e.g. no ground truth.
  void setEmptyText(const QString& text) { empty_->setText(text); }
  /// Marks the rows of the shown and the compared result; 0 = none.
  void setSides(quint64 a, quint64 b);

  /// Whether there is nothing to copy or save.
  [[nodiscard]] bool isEmpty() const { return rows_.empty() || columns_.empty(); }
  /// RFC 4180, full precision, decimal point, keys as header; missing values are empty.
  [[nodiscard]] QString toCsv() const;
  /// A `tabular` with the shown decimals and the best of each column in bold; missing values are
  /// "--". Without columns that the user hid.
  [[nodiscard]] QString toLatex() const;

 public slots:
  void copyCsv();
  void copyLatex();

 signals:
  void rowClicked(quint64 id);
  void compareRequested(quint64 id);
  /// "CSV" or "LaTeX" was copied to the clipboard.
  void copied(const QString& form);
  /// The host should write the text, "csv" or "tex".
  void saveRequested(const QString& suffix, const QString& text);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void setUpTable();
  void fill();
  void fillRow(int row, const MetricRow& values);
  void fitColumns();
  [[nodiscard]] int widthOf(int column) const;
  void stressBest();
  void showMenu(const QPoint& position);
  void addColumnsTo(QMenu& menu);
  [[nodiscard]] bool isHidden(const MetricColumn& column) const;

  std::vector<MetricColumn> columns_;
  std::vector<MetricRow> rows_;
  QHash<QString, bool> chosen_;  // Whether the columns with these keys are wanted.
  QTableWidget* table_;
  QLabel* empty_;
  QToolButton* copy_csv_;
  QToolButton* copy_latex_;
  QToolButton* save_;
};

}  // namespace episcope
