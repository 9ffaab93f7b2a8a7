// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/run/run_log.h"

namespace episcope {

RunLog::RunLog(const std::filesystem::path& folder, const std::filesystem::path& file)
    : log_(file, io::LogFraming::Lines, io::LogFlush::AtOnce), known_(folder) {
  for (const io::LogRecord& line : log_.records()) {
    if (auto record = record_from_json({line.begin(), line.end()})) known_.keep(std::move(*record));
  }
}

void RunLog::add(const BenchmarkRecord& record) {
  log_.append(record_to_json(record));
  known_.keep(record);
}

void RunLog::take_over(const std::vector<BenchmarkRecord>& records) {
  std::vector<io::LogRecord> lines;
  for (const BenchmarkRecord& record : records) {
    const BenchmarkRecord* known = known_.last(record.key, record.result.scene);
    const std::string line = record_to_json(record);
    const bool is_worse = known && !known->result.has_failed && record.result.has_failed;
    if (is_worse || (known && record_to_json(*known) == line)) continue;
    lines.emplace_back(line.begin(), line.end());
    known_.keep(record);
  }
  log_.append_all(lines);
}

}  // namespace episcope
