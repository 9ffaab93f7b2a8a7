// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/report/report_files.h"

#include "app/benchmark/report/html_page.h"
#include "app/benchmark/report/published.h"
#include "app/benchmark/report/report_json.h"
#include "engine/evaluation/tables/label_tables.h"
#include "engine/evaluation/tables/search_tables.h"
#include "engine/io/durable/atomic_file.h"

#include <algorithm>

namespace episcope {

std::vector<TitledTable> report_tables(const BenchmarkReport& report) {
  std::vector<TitledTable> tables = label_tables(report.results);
  if (!report.has_disparities) return tables;
  for (auto& table : benchmark_tables(report.results)) tables.push_back(std::move(table));
  TitledTable published = published_table(report);
  if (!published.table.rows.empty()) tables.push_back(std::move(published));
  for (auto& table : search_tables(report.searched)) tables.push_back(std::move(table));
  return tables;
}

std::string tables_to_csv(const std::vector<TitledTable>& tables) {
  std::string text;
  for (const TitledTable& titled : tables) {
    if (!text.empty()) text += "\n";
    text += table_to_csv({{titled.title}, {}}) + table_to_csv(titled.table);
  }
  return text;
}

std::string tables_to_latex(const std::vector<TitledTable>& tables) {
  std::string text;
  for (const TitledTable& titled : tables) {
    text += (text.empty() ? "% " : "\n% ") + titled.title + "\n";
    if (!titled.note.empty()) text += "% " + titled.note + "\n";
    text += table_to_latex(titled.table);
  }
  return text;
}

void write_report(const std::filesystem::path& folder, const BenchmarkReport& report) {
  const std::vector<TitledTable> tables = report_tables(report);
  io::write_atomically(folder / "tables.csv", tables_to_csv(tables));
  io::write_atomically(folder / "tables.tex", tables_to_latex(tables));
  io::write_atomically(folder / "results.csv", table_to_csv(results_table(report.results)));
  io::write_atomically(folder / "results.json", report_to_json(report));
  io::write_atomically(folder / "index.html", html_page(report, tables));
}

}  // namespace episcope
