// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/run/record.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace episcope {

/// What is known of finished runs, in the order in which they were made.
class RunRecords {
 public:
  /// `folder`: of the benchmark, which the files of runs are named below.
  explicit RunRecords(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void keep(BenchmarkRecord record);
  /// Keeps what a log holds, also while another program writes it; a log that is not there holds
  /// nothing. Lines that are no records are passed over. Throws IoError.
  void read(const std::filesystem::path& log);

  /// The finished run of this key for the scene of this name, if it did not fail, its files are
  /// there and no later run wrote the same ones; else null. Valid until the next `keep`.
  [[nodiscard]] const BenchmarkRecord* find(const std::string& key, const std::string& scene) const;
  /// The last run of this key and scene, failed or not; else null. Valid until the next `keep`.
  [[nodiscard]] const BenchmarkRecord* last(const std::string& key, const std::string& scene) const;
  /// Of every key and scene the last run.
  [[nodiscard]] std::vector<BenchmarkRecord> last_of_each() const;

  [[nodiscard]] const std::vector<BenchmarkRecord>& all() const { return records_; }

 private:
  std::filesystem::path folder_;
  std::vector<BenchmarkRecord> records_;
  std::map<std::string, std::size_t> places_;   ///< By key and scene.
  std::map<std::string, std::string> writers_;  ///< Key of the last run that wrote a file.
};

}  // namespace episcope
