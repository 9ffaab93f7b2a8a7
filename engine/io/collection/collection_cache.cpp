// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/collection/collection_cache.h"

#include "engine/core/error.h"
#include "engine/core/hash/fnv1a.h"
#include "engine/core/version.h"
#include "engine/io/durable/atomic_file.h"
#include "engine/io/json/bounded_json.h"
#include "engine/io/open/reader.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <span>
#include <utility>

namespace episcope::io {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr int kForm = 3;  ///< Counts up when readers find other light fields.

/// Other readers may find other light fields.
std::string key_of_program() {
  std::string key = std::string(kVersion) + " " + std::to_string(kForm);
  for (const Reader& reader : readers()) key += std::string(" ") + reader.id;
  return key;
}

Json json_of(const ResultBeside& result) {
  return {{"path", result.path.string()}, {"method", result.method}, {"source", result.source}};
}

Json json_of(const SceneProbe& probe) {
  return {{"grid", {probe.grid.v, probe.grid.u}},
          {"size", {probe.height, probe.width, probe.channels}},
          {"type", probe.sample_type ? static_cast<int>(*probe.sample_type) : -1},
          {"truth", probe.truth},
          {"labels", probe.labels},
          {"list", probe.list},
          {"frames", probe.frames}};
}

Json json_of(const CollectionEntry& entry) {
  return {
      {"path", entry.path.string()},      {"name", entry.name},      {"reader", entry.reader},
      {"probe", json_of(entry.probe)},    {"bytes", entry.bytes},    {"modified", entry.modified},
      {"fingerprint", entry.fingerprint}, {"problem", entry.problem}};
}

template <class T>
Json array_json(const std::vector<T>& items) {
  Json array = Json::array();
  for (const T& item : items) array.push_back(json_of(item));
  return array;
}

ResultBeside result_from(const Json& json) {
  return {json.at("path").get<std::string>(), json.at("method").get<std::string>(),
          json.at("source").get<std::string>()};
}

SceneProbe probe_from(const Json& json) {
  SceneProbe probe{.grid = {int_of(json.at("grid").at(0)), int_of(json.at("grid").at(1))},
                   .height = int_of(json.at("size").at(0)),
                   .width = int_of(json.at("size").at(1)),
                   .channels = int_of(json.at("size").at(2)),
                   .truth = json.at("truth").get<std::string>(),
                   .labels = json.at("labels").get<std::string>(),
                   .list = int_of(json.at("list")),
                   .frames = int_of(json.at("frames"))};
  const int type = int_of(json.at("type"));
  constexpr int last = static_cast<int>(SampleType::Float32);
  if (type >= 0 && type <= last) probe.sample_type = static_cast<SampleType>(type);
  return probe;
}

CollectionEntry entry_from(const Json& json) {
  return {.path = json.at("path").get<std::string>(),
          .name = json.at("name").get<std::string>(),
          .reader = json.at("reader").get<std::string>(),
          .probe = probe_from(json.at("probe")),
          .bytes = json.at("bytes").get<std::uintmax_t>(),
          .modified = json.at("modified").get<std::int64_t>(),
          .fingerprint = json.at("fingerprint").get<std::uint64_t>(),
          .problem = json.at("problem").get<std::string>()};
}

Json json_of(const FolderRecord& record) {
  return {{"entries", array_json(record.entries)},
          {"results", array_json(record.results)},
          {"descends", record.descends},
          {"doubtful", record.is_doubtful}};
}

FolderRecord record_from(const Json& json) {
  FolderRecord record{.entries = {},
                      .results = {},
                      .descends = json.at("descends").get<bool>(),
                      .is_doubtful = json.at("doubtful").get<bool>()};
  for (const Json& each : json.at("entries")) record.entries.push_back(entry_from(each));
  for (const Json& each : json.at("results")) record.results.push_back(result_from(each));
  return record;
}

/// Names of files need not be UTF-8, but JSON must.
bool is_utf8(const Json& json) {
  try {
    return !json.dump().empty();
  } catch (const Json::type_error&) {
    return false;
  }
}

}  // namespace

CollectionCache::CollectionCache(fs::path file) : file_(std::move(file)) {
  std::error_code error;
  if (file_.empty() || !fs::exists(file_, error)) return;
  try {
    read();
  } catch (const Json::exception&) {
    old_.clear();  // damaged
  } catch (const Error&) {
    old_.clear();  // too large or too deep
  }
}

void CollectionCache::read() {
  const Json json = read_json<Json>(file_);
  if (json.at("program") != key_of_program()) return;
  for (const auto& [folder, kept] : json.at("folders").items()) {
    old_[folder] = {kept.at("fingerprint").get<std::uint64_t>(), record_from(kept.at("record"))};
  }
}

const FolderRecord* CollectionCache::find(const fs::path& folder, std::uint64_t fingerprint) const {
  const auto found = old_.find(folder.string());
  const bool is_same = found != old_.end() && found->second.fingerprint == fingerprint;
  return is_same ? &found->second.record : nullptr;
}

void CollectionCache::keep(const fs::path& folder, std::uint64_t fingerprint, FolderRecord record) {
  if (!find(folder, fingerprint)) has_changed_ = true;
  new_[folder.string()] = {fingerprint, std::move(record)};
}

void CollectionCache::save() const {
  if (file_.empty() || (!has_changed_ && old_.size() == new_.size())) return;
  Json folders = Json::object();
  for (const auto& [folder, kept] : new_) {
    Json each{{"fingerprint", kept.fingerprint}, {"record", json_of(kept.record)}};
    if (is_utf8(folder) && is_utf8(each)) folders[folder] = std::move(each);
  }
  const Json json{{"program", key_of_program()}, {"folders", std::move(folders)}};
  const std::string text = json.dump();
  std::error_code error;
  fs::create_directories(file_.parent_path(), error);
  if (error || text.size() > kLargestJson) return;
  try {
    write_atomically(file_, text);
  } catch (const IoError&) {
    return;  // a cache is a convenience
  }
}

}  // namespace episcope::io
