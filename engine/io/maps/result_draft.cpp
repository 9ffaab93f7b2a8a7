// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/maps/result_draft.h"

#include "engine/core/error.h"
#include "engine/io/durable/atomic_file.h"
#include "engine/io/durable/system_error.h"
#include "engine/io/hdf5/hdf5_file.h"
#include "engine/io/json/bounded_json.h"
#include "engine/io/maps/result_provenance.h"

#include <fcntl.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <utility>
#include <vector>

namespace episcope::io {
namespace {

using Json = nlohmann::json;

// Records: the identity, then the rest of the file, then these.
constexpr std::size_t kFirstStep = 2;

std::filesystem::path with(std::filesystem::path path, const char* ending) {
  path += ending;
  return path;
}

std::string text_of(const LogRecord& record) {
  return {record.begin(), record.end()};
}

// Where a link leads, which should stay.
std::filesystem::path resolved(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_symlink(path, error)) return path;
  const std::filesystem::path target = std::filesystem::weakly_canonical(path, error);
  return error ? path : target;
}

LogRecord record_of(const std::string& text) {
  return {text.begin(), text.end()};
}

Json to_json(const BlockProgress& progress) {
  return {
      {"pass", progress.pass},   {"done", progress.done},       {"prepared", progress.is_prepared},
      {"facts", progress.facts}, {"finding", progress.finding}, {"seconds", progress.seconds},
      {"notes", progress.notes}};
}

BlockProgress progress_in(const Json& json) {
  return {int_of(json.at("pass")),
          int_of(json.at("done")),
          json.at("prepared").get<bool>(),
          json.at("facts").get<std::vector<double>>(),
          json.at("finding").get<double>(),
          json.at("seconds").get<double>(),
          json.at("notes").get<std::vector<std::string>>()};
}

Json to_json(const MapBlock& block) {
  return {block.views.first.v, block.views.first.u, block.views.grid.v,
          block.views.grid.u,  block.first_row,     block.end_row};
}

MapBlock block_in(const Json& json) {
  const auto number = [&](std::size_t i) { return int_of(json.at(i)); };
  return {{{number(0), number(1)}, {number(2), number(3)}}, number(4), number(5)};
}

}  // namespace

ResultDraft::ResultDraft(const std::filesystem::path& result, const DraftShape& shape,
                         const std::string& identity)
    : result_(resolved(result)),
      draft_(with(result_, ".partial")),
      log_path_(with(result_, ".partial.log")),
      aside_path_(with(result_, ".partial.block")),
      kept_path_(with(result_, ".partial.kept")),
      shape_(shape) {
  log_.emplace(log_path_, LogFraming::Lines, LogFlush::AtOnce);
  const std::vector<LogRecord>& records = log_->records();
  const bool is_there = records.size() >= kFirstStep && has_files();
  if (is_there && text_of(records.front()) == identity) {
    found_ = Found::Same;
    continue_with(records);
  } else {
    found_ = is_there ? Found::Other : Found::Nothing;
    try {
      begin(identity);
    } catch (...) {
      remove_others();
      throw;
    }
  }
}

bool ResultDraft::has_files() const {
  if (!std::filesystem::exists(draft_)) return false;
  std::error_code error;
  return shape_.kept == 0 || std::filesystem::file_size(kept_path_, error) ==
                                 KeptMaps::byte_size(shape_.maps, shape_.kept);
}

void ResultDraft::open_files() {
  file_ = DraftFile(draft_, shape_, result_);
  if (shape_.kept > 0) kept_ = KeptMaps(kept_path_, shape_.maps, result_);
}

void ResultDraft::begin(const std::string& identity) {
  std::error_code ignored;
  for (const std::filesystem::path& old : {draft_, kept_path_}) {
    std::filesystem::remove(old, ignored);  // makes room
  }
  DraftFile::create(draft_, shape_, result_);
  if (shape_.kept > 0) KeptMaps::create(kept_path_, shape_.maps, shape_.kept, result_);
  open_files();
  const std::vector<LogRecord> records{record_of(identity), record_of(rest_text())};
  log_.emplace(log_path_, LogFraming::Lines, LogFlush::AtOnce, records);
}

void ResultDraft::continue_with(const std::vector<LogRecord>& records) {
  try {
    restore(text_of(records[1]));
    open_files();
    if (records.size() == kFirstStep) return;
    const Json last = parse_json<Json>(text_of(records.back()));
    progress_ = progress_in(last);
    if (!last.contains("aside")) return;
    const FileDescriptor aside(aside_path_, O_RDONLY);
    if (!aside.ok()) throw write_error(aside_path_);
    file_.take_from(aside, block_in(last.at("aside")), last.at("valid").get<bool>());
  } catch (const Json::exception&) {
    throw IoError(log_path_,
                  "the log of this unfinished result is damaged; remove it and " + draft_.string());
  }
  note(progress_);
}

std::string ResultDraft::rest_text() const {
  Json json{{"bytes", file_.byte_size()}, {"rest", Json::array()}};
  for (const FileBytes& gap : file_.rest()) json["rest"].push_back({gap.offset, gap.bytes});
  return json.dump();
}

void ResultDraft::restore(const std::string& rest) const {
  const Json json = parse_json<Json>(rest);
  std::vector<FileBytes> gaps;
  for (const Json& gap : json.at("rest")) {
    gaps.push_back({gap.at(0).get<std::uintmax_t>(), gap.at(1).get<std::vector<std::uint8_t>>()});
  }
  DraftFile::restore(draft_, gaps, json.at("bytes").get<std::uintmax_t>());
}

void ResultDraft::note(const BlockProgress& after) {
  log_->append(to_json(after).dump());
  progress_ = after;
}

void ResultDraft::write(const MapBlock& block, const BlockMaps& maps, const BlockProgress& after,
                        bool replaces) {
  if (!maps.kept.empty()) kept_.write(block, maps.kept);
  if (replaces) {
    const FileDescriptor aside(aside_path_, O_RDWR | O_CREAT);
    if (!aside.ok()) throw write_error(result_);
    file_.write_aside(aside, block, maps);
    Json json = to_json(after);
    json["aside"] = to_json(block);
    json["valid"] = !maps.field.valid.empty();
    log_->append(json.dump());
  }
  file_.write(block, maps);
  note(after);
}

void ResultDraft::remove_others() const {
  std::error_code ignored;
  std::filesystem::remove(aside_path_, ignored);
  std::filesystem::remove(kept_path_, ignored);
  std::filesystem::remove(log_path_, ignored);
}

void ResultDraft::commit(const Provenance& provenance, const std::string& source) {
  Hdf5Output output(draft_, result_);
  write_provenance(output, provenance, shape_.maps, source);
  output.close();
  const FileDescriptor file(draft_, O_RDWR);
  if (!file.ok() || ::fsync(file.id()) != 0 || std::rename(draft_.c_str(), result_.c_str()) != 0) {
    throw write_error(result_);
  }
  flush_folder(result_);
  remove_others();
}

}  // namespace episcope::io
