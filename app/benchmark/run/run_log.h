// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/run/run_records.h"
#include "engine/io/durable/append_log.h"

#include <filesystem>
#include <string>
#include <vector>

namespace episcope {

/// `log.jsonl` of a benchmark: every run and every point of a search, one JSON object a line,
/// flushed as soon as it is finished. What it holds need not be computed again.
class RunLog {
 public:
  static constexpr const char* kFileName = "log.jsonl";

  /// Throws IoError, also if another program works in the folder. Lines that are no records are
  /// passed over.
  explicit RunLog(const std::filesystem::path& folder) : RunLog(folder, folder / kFileName) {}
  /// A log of that name of a benchmark in that folder.
  RunLog(const std::filesystem::path& folder, const std::filesystem::path& file);

  /// As of RunRecords.
  [[nodiscard]] const BenchmarkRecord* find(const std::string& key,
                                            const std::string& scene) const {
    return known_.find(key, scene);
  }
  [[nodiscard]] const BenchmarkRecord* last(const std::string& key,
                                            const std::string& scene) const {
    return known_.last(key, scene);
  }
  /// Throws IoError.
  void add(const BenchmarkRecord& record);
  /// Adds what it does not hold yet of runs that were made elsewhere. Throws IoError.
  void take_over(const std::vector<BenchmarkRecord>& records);

  [[nodiscard]] const std::vector<BenchmarkRecord>& records() const { return known_.all(); }

 private:
  io::AppendLog log_;
  RunRecords known_;
};

}  // namespace episcope
