// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/report.h"
#include "engine/evaluation/benchmark_tables.h"

#include <string>
#include <vector>

namespace episcope {

/// The page of a benchmark: its tables, then for each scene pictures of the view, the truth, and of
/// every entry disparity and error. Needs nothing but the files beside it; light or dark as the
/// reader's system; a small script sorts tables by a click, all else works without.
[[nodiscard]] std::string html_page(const BenchmarkReport& report,
                                    const std::vector<TitledTable>& tables);

}  // namespace episcope
