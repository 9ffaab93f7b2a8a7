// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>
#include <QStringList>
#include <QVariant>
#include <QWidget>

#include <vector>

class QLabel;
class QTableWidget;
class QToolButton;

namespace episcope {

/// Which value of a column is the best one.
enum class BestValue { None, Least, Greatest };

struct MetricColumn {
  QString key;    ///< Of the CSV header, e.g. "mse_100".
  QString label;  ///< Of the table header.
  QString help;   ///< Tool tip.
  int decimals = 3;
  BestValue best = BestValue::None;
  bool is_shown = true;  ///< Else it stands in copied and saved tables only.
  friend bool operator==(const MetricColumn&, const MetricColumn&) = default;
};

struct MetricRow {
  quint64 id = 0;
  /// One a column: a double, a string, or an invalid QVariant where the metric is absent.
  std::vector<QVariant> values;
  friend bool operator==(const MetricRow&, const MetricRow&) = default;
};

/// Metrics of all results, sortable by any column (numbers as numbers, absent ones and NaN last),
/// the best of each column stressed, copied or saved as CSV or LaTeX in the order shown. Ctrl+C
/// copies the table as CSV.
class MetricTable : public QWidget {
  Q_OBJECT

 public:
  explicit MetricTable(QWidget* parent = nullptr);

  /// Costs nothing if they are as before.
  void setTable(const std::vector<MetricColumn>& columns, const std::vector<MetricRow>& rows);
  /// Says why the table is empty, e.g. that there is no ground truth.
  void setEmptyText(const QString& text);
  /// Marks the rows of the result on screen and of the one it is compared with; 0 = none.
  void setSides(quint64 a, quint64 b);

  /// RFC 4180, full precision, decimal point, keys as header; absent values are empty.
  [[nodiscard]] QString toCsv() const;
  /// A `tabular` with the decimals shown and the best of each column in bold; absent values are
  /// "--".
  [[nodiscard]] QString toLatex() const;

 public slots:
  void copyCsv();
  void copyLatex();

 signals:
  void rowClicked(quint64 id);
  void compareRequested(quint64 id);
  /// "CSV" or "LaTeX" is in the clipboard.
  void copied(const QString& form);
  /// "csv" or "tex" with the text to be written by the host.
  void saveRequested(const QString& suffix, const QString& text);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void setUpTable();
  void fill();
  void fillRow(int row, const MetricRow& values);
  void fitColumns();
  void stressBest();
  void showMenu(const QPoint& position);

  std::vector<MetricColumn> columns_;
  std::vector<MetricRow> rows_;
  QTableWidget* table_;
  QLabel* empty_;
  QToolButton* copy_csv_;
  QToolButton* copy_latex_;
  QToolButton* save_;
};

}  // namespace episcope
