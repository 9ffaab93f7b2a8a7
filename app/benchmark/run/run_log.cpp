// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/run/run_log.h"

#include <algorithm>

namespace episcope {
namespace {

std::string place_name(const std::string& key, const std::string& scene) {
  return key + " " + scene;
}

}  // namespace

RunLog::RunLog(const std::filesystem::path& folder)
    : folder_(folder), log_(folder / kFileName, io::LogFraming::Lines, io::LogFlush::AtOnce) {
  for (const io::LogRecord& line : log_.records()) {
    if (auto record = record_from_json({line.begin(), line.end()})) keep(std::move(*record));
  }
}

const BenchmarkRecord* RunLog::find(const std::string& key, const std::string& scene) const {
  const auto place = places_.find(place_name(key, scene));
  if (place == places_.end()) return nullptr;
  const BenchmarkRecord& record = records_[place->second];
  const auto is_own = [&](const std::string& file) {
    std::error_code ignored;
    return writers_.at(file) == key && std::filesystem::exists(folder_ / file, ignored);
  };
  const bool is_whole = std::all_of(record.files.begin(), record.files.end(), is_own);
  return is_whole && !record.result.has_failed ? &record : nullptr;
}

void RunLog::add(const BenchmarkRecord& record) {
  log_.append(record_to_json(record));
  keep(record);
}

void RunLog::keep(BenchmarkRecord record) {
  for (const auto& file : record.files) writers_[file] = record.key;
  places_[place_name(record.key, record.result.scene)] = records_.size();
  records_.push_back(std::move(record));
}

}  // namespace episcope
