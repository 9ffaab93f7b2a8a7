// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/report/report.h"
#include "engine/evaluation/tables/benchmark_tables.h"

#include <filesystem>
#include <string>
#include <vector>

namespace episcope {

/// Every table of a benchmark, in the order of the page: labels, overview, accuracy, beside
/// the paper, search.
[[nodiscard]] std::vector<TitledTable> report_tables(const BenchmarkReport& report);

/// The tables one below the other, each after a line with its title.
[[nodiscard]] std::string tables_to_csv(const std::vector<TitledTable>& tables);
/// The same as LaTeX, titles and notes as comments.
[[nodiscard]] std::string tables_to_latex(const std::vector<TitledTable>& tables);

/// Writes index.html, tables.csv, tables.tex, results.csv (a result a line, every metric) and
/// results.json into the folder, each atomically. Throws IoError.
void write_report(const std::filesystem::path& folder, const BenchmarkReport& report);

}  // namespace episcope
