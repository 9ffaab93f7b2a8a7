// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/run/record.h"
#include "engine/io/durable/append_log.h"

#include <filesystem>
#include <map>
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
  explicit RunLog(const std::filesystem::path& folder);

  /// The finished run of this key for the scene of this name, if it did not fail, its files are
  /// there and no later run wrote the same ones; else null. Valid until the next `add`.
  [[nodiscard]] const BenchmarkRecord* find(const std::string& key, const std::string& scene) const;
  /// Throws IoError.
  void add(const BenchmarkRecord& record);

  [[nodiscard]] const std::vector<BenchmarkRecord>& records() const { return records_; }

 private:
  void keep(BenchmarkRecord record);

  std::filesystem::path folder_;
  io::AppendLog log_;
  std::vector<BenchmarkRecord> records_;
  std::map<std::string, std::size_t> places_;   ///< By key and scene.
  std::map<std::string, std::string> writers_;  ///< Key of the last run that wrote a file.
};

}  // namespace episcope
