// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/hash.h"
#include "engine/core/image.h"
#include "engine/core/parameter.h"
#include "engine/core/scene.h"
#include "engine/core/schema.h"
#include "engine/disparity/estimator.h"
#include "engine/evaluation/benchmark_tables.h"
#include "engine/io/base/atomic_file.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace episcope {

/// What a run is for; named so in the log.
enum class RunKind {
  Table,   ///< A method, judged for the tables.
  Search,  ///< A method, as a point of a search.
  Labels   ///< Labels from strokes.
};
[[nodiscard]] Names<RunKind> names_of(RunKind);

/// What is run: a method, or a way to label, with parameters.
struct BenchmarkRun {
  RunKind kind = RunKind::Table;
  std::string method;
  int revision = 1;         ///< EstimatorInfo::revision.
  ParameterSet parameters;  ///< All of the method.
  ViewSelection views = ViewSelection::Center;
  /// What was demanded, if the method computes there; else Auto.
  Device device = Device::Auto;
};

/// `point` over the defaults of the method.
[[nodiscard]] BenchmarkRun plan_run(const Estimator& estimator, const ParameterSet& point,
                                    const RunOptions& options, RunKind kind);

/// Key of the result of a run on a scene with this fingerprint: changes with all that the result
/// depends on, including the version of the program.
[[nodiscard]] std::string record_key(const BenchmarkRun& run, const std::string& fingerprint);

/// One finished run, a line of the log.
struct BenchmarkRecord {
  std::string key;
  std::string input;  ///< The scene as it was asked for.
  BenchmarkRun run;
  BenchmarkResult result;
  std::vector<std::string> files;  ///< Written by the run, below the folder of the benchmark.
};

/// One line of JSON, without its end.
[[nodiscard]] std::string record_to_json(const BenchmarkRecord& record);
/// Empty for a line that is no record.
[[nodiscard]] std::optional<BenchmarkRecord> record_from_json(const std::string& line);

/// Finished runs, in the order in which they were made.
class RunRecords {
 public:
  /// `folder`: of the benchmark, which the files of runs are named below.
  explicit RunRecords(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void keep(BenchmarkRecord record);
  /// Keeps the records of a log, even while another program writes it. A missing log holds nothing;
  /// other lines are skipped. Throws IoError.
  void read(const std::filesystem::path& log);

  /// The finished run of this key for the scene of this name, if it did not fail, its files are
  /// there and no later run wrote the same ones; else null. Valid until the next `keep`.
  [[nodiscard]] const BenchmarkRecord* find(const std::string& key, const std::string& scene) const;
  /// The last run of this key and scene, failed or not; else null. Valid until the next `keep`.
  [[nodiscard]] const BenchmarkRecord* last(const std::string& key, const std::string& scene) const;
  /// The last run of every key and scene.
  [[nodiscard]] std::vector<BenchmarkRecord> last_of_each() const;

  [[nodiscard]] const std::vector<BenchmarkRecord>& all() const { return records_; }

 private:
  std::filesystem::path folder_;
  std::vector<BenchmarkRecord> records_;
  std::map<std::string, std::size_t> places_;   ///< By key and scene.
  std::map<std::string, std::string> writers_;  ///< Key of the last run that wrote a file.
};

/// `log.jsonl` of a benchmark: every run and every point of a search, one JSON object a line,
/// flushed as soon as it is finished. What it holds need not be computed again.
class RunLog : public RunRecords {
 public:
  static constexpr const char* kFileName = "log.jsonl";

  /// Throws IoError, also if another program works in the folder. Skips lines that are no records.
  explicit RunLog(const std::filesystem::path& folder) : RunLog(folder, folder / kFileName) {}
  /// A log of that name of a benchmark in that folder.
  RunLog(const std::filesystem::path& folder, const std::filesystem::path& file);

  /// Throws IoError.
  void add(const BenchmarkRecord& record);
  /// Adds runs that were made elsewhere and are not in the log yet. Throws IoError.
  void take_over(const std::vector<BenchmarkRecord>& records);

 private:
  io::AppendLog log_;
};

/// Takes in bytes, values and images; `text` is 16 hexadecimal digits that change with them.
class Fingerprint {
 public:
  void add(std::string_view bytes) { hash_.add(bytes); }
  template <class T>
  void add_value(const T& value) {
    add({reinterpret_cast<const char*>(&value), sizeof value});
  }
  template <class T>
  void add_image(ImageView<const T> image) {
    add_value(image.height);
    add_value(image.width);
    for (int y = 0; y < image.height; ++y) {
      const std::size_t count = static_cast<std::size_t>(image.width) * image.channels;
      add({reinterpret_cast<const char*>(image.row(y)), count * sizeof(T)});
    }
  }
  [[nodiscard]] std::string text() const { return hash_digits(hash_.value()); }

 private:
  Fnv1a hash_;
};

/// 16 hexadecimal digits that change with anything of a scene that a judged run depends on: the
/// samples, camera and promised range of the light field, truth and region masks of its center
/// view. Linear in the samples.
[[nodiscard]] std::string scene_fingerprint(const Scene& scene);

/// 16 hexadecimal digits of a text (FNV-1a).
[[nodiscard]] std::string text_fingerprint(const std::string& text);

}  // namespace episcope
