// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/run/run_records.h"

#include "engine/io/durable/append_log.h"

#include <algorithm>

namespace episcope {
namespace {

std::string place_name(const std::string& key, const std::string& scene) {
  return key + " " + scene;
}

}  // namespace

void RunRecords::keep(BenchmarkRecord record) {
  for (const auto& file : record.files) writers_[file] = record.key;
  places_[place_name(record.key, record.result.scene)] = records_.size();
  records_.push_back(std::move(record));
}

void RunRecords::read(const std::filesystem::path& log) {
  std::error_code ignored;
  if (!std::filesystem::exists(log, ignored)) return;
  for (const io::LogRecord& line : io::read_log(log, io::LogFraming::Lines)) {
    if (auto record = record_from_json({line.begin(), line.end()})) keep(std::move(*record));
  }
}

const BenchmarkRecord* RunRecords::find(const std::string& key, const std::string& scene) const {
  const BenchmarkRecord* record = last(key, scene);
  if (!record || record->result.has_failed) return nullptr;
  const auto is_own = [&](const std::string& file) {
    std::error_code ignored;
    return writers_.at(file) == key && std::filesystem::exists(folder_ / file, ignored);
  };
  return std::all_of(record->files.begin(), record->files.end(), is_own) ? record : nullptr;
}

const BenchmarkRecord* RunRecords::last(const std::string& key, const std::string& scene) const {
  const auto place = places_.find(place_name(key, scene));
  return place == places_.end() ? nullptr : &records_[place->second];
}

std::vector<BenchmarkRecord> RunRecords::last_of_each() const {
  std::vector<std::size_t> order;
  order.reserve(places_.size());
  for (const auto& [name, place] : places_) order.push_back(place);
  std::sort(order.begin(), order.end());
  std::vector<BenchmarkRecord> last;
  last.reserve(order.size());
  for (const std::size_t place : order) last.push_back(records_[place]);
  return last;
}

}  // namespace episcope
