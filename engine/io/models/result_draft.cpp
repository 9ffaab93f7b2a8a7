// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/result_draft.h"

#include "engine/core/error.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/hdf5_output.h"
#include "engine/io/base/json.h"
#include "engine/io/models/external_result.h"
#include "engine/io/models/result_file.h"
#include "engine/io/models/stored_maps.h"

#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <limits>
#include <utility>

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
      shape_(shape) {
  log_.emplace(log_path_, LogFraming::Lines, LogFlush::AtOnce);
  const std::vector<LogRecord>& records = log_->records();
  const bool is_there = records.size() >= kFirstStep && std::filesystem::exists(draft_);
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

void ResultDraft::begin(const std::string& identity) {
  std::error_code ignored;
  std::filesystem::remove(draft_, ignored);  // makes room
  DraftFile::create(draft_, shape_, result_);
  file_ = DraftFile(draft_, shape_, result_);
  const std::vector<LogRecord> records{record_of(identity), record_of(rest_text())};
  log_.emplace(log_path_, LogFraming::Lines, LogFlush::AtOnce, records);
}

void ResultDraft::continue_with(const std::vector<LogRecord>& records) {
  try {
    restore(text_of(records[1]));
    file_ = DraftFile(draft_, shape_, result_);
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
  for (const FileExtent& gap : file_.rest()) json["rest"].push_back({gap.offset, gap.bytes});
  return json_text(json);
}

void ResultDraft::restore(const std::string& rest) const {
  const Json json = parse_json<Json>(rest);
  std::vector<FileExtent> gaps;
  for (const Json& gap : json.at("rest")) {
    gaps.push_back({gap.at(0).get<std::uintmax_t>(), gap.at(1).get<std::vector<std::uint8_t>>()});
  }
  DraftFile::restore(draft_, gaps, json.at("bytes").get<std::uintmax_t>());
}

void ResultDraft::note(const BlockProgress& after) {
  log_->append(json_text(to_json(after)));
  progress_ = after;
}

void ResultDraft::write(const MapBlock& block, const BlockMaps& maps, const BlockProgress& after,
                        bool replaces) {
  if (replaces) {
    const FileDescriptor aside(aside_path_, O_RDWR | O_CREAT);
    if (!aside.ok()) throw write_error(result_);
    file_.write_aside(aside, block, maps);
    Json json = to_json(after);
    json["aside"] = to_json(block);
    json["valid"] = !maps.field.valid.empty();
    log_->append(json_text(json));
  }
  file_.write(block, maps);
  note(after);
}

void ResultDraft::remove_others() const {
  std::error_code ignored;
  std::filesystem::remove(aside_path_, ignored);
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

namespace {

constexpr std::uintmax_t kStructure = 1 << 16;

struct Dataset {
  DraftMap map;
  const char* name;
  const char* unit;
};
constexpr Dataset kDatasets[] = {
    {DraftMap::Disparity, "disparity", kDisparityUnit},
    {DraftMap::Confidence, "confidence", kNoUnit},
    {DraftMap::Second, "disparity_second", kDisparityUnit},
    {DraftMap::Valid, "valid", kNoUnit},
};

std::size_t sample_bytes(DraftMap map) {
  return map == DraftMap::Valid ? 1 : sizeof(float);
}

std::vector<Dataset> datasets_of(const DraftShape& shape) {
  std::vector<Dataset> datasets;
  for (const Dataset& dataset : kDatasets) {
    if (dataset.map == DraftMap::Valid && !shape.has_valid) continue;
    if (dataset.map == DraftMap::Second && !shape.has_second) continue;
    datasets.push_back(dataset);
  }
  return datasets;
}

template <class T>
std::span<const std::uint8_t> bytes_of(ImageView<const T> map) {
  return {reinterpret_cast<const std::uint8_t*>(map.data), map.size() * sizeof(T)};
}
template <class T>
std::span<std::uint8_t> bytes_to(ImageView<T> map) {
  return {reinterpret_cast<std::uint8_t*>(map.data), map.size() * sizeof(T)};
}

template <class Maps>
auto& field_in(Maps& maps, DraftMap map) {
  return map == DraftMap::Second ? maps.second : maps.field;
}

std::span<const std::uint8_t> bytes_in(const BlockMaps& maps, DraftMap map, ViewIndex view,
                                       Image<float>& marked) {
  if (map == DraftMap::Valid) return bytes_of(maps.field.valid.view(view));
  if (map == DraftMap::Confidence) return bytes_of(maps.confidence.view(view));
  marked = marked_map(field_in(maps, map).view(view));
  return bytes_of(ImageView<const float>(marked.view()));
}

// Where the samples of a map that is no mask go.
std::span<std::uint8_t> target_in(BlockMaps& maps, DraftMap map, ViewIndex view) {
  if (map == DraftMap::Confidence) return bytes_to(maps.confidence.view(view));
  return bytes_to(field_in(maps, map).disparity.view(view));
}

}  // namespace

void DraftFile::create(const std::filesystem::path& path, const DraftShape& shape,
                       const std::filesystem::path& target) {
  const MapGeometry& maps = shape.maps;
  const std::uintmax_t pixels =
      static_cast<std::uintmax_t>(maps.grid.count()) * maps.height * maps.width;
  std::uintmax_t bytes = kStructure;
  for (const Dataset& dataset : datasets_of(shape)) bytes += pixels * sample_bytes(dataset.map);
  AtomicFile file(path, bytes);
  Hdf5Output output(file);
  const Hdf5Shape extent = map_shape(maps.grid, maps.height, maps.width);
  const char* const axes = map_axes(maps.grid);
  output.add_group(kResultGroup);
  for (const Dataset& dataset : datasets_of(shape)) {
    const std::string name = in_group(dataset.name);
    if (sample_bytes(dataset.map) == 1) {
      output.add_dataset<std::uint8_t>(name, extent, axes, dataset.unit, true);
    } else {
      output.add_dataset<float>(name, extent, axes, dataset.unit, true);
    }
  }
  describe_maps(output, maps);
  output.close();
  {
    const FileDescriptor reserved(file.temporary(), O_RDWR);
    errno = reserved.ok()
                ? posix_fallocate(reserved.id(), 0,
                                  static_cast<off_t>(std::filesystem::file_size(file.temporary())))
                : errno;
    if (errno != 0) throw write_error(target);
  }
  file.commit();
}

DraftFile::DraftFile(const std::filesystem::path& path, const DraftShape& shape,
                     const std::filesystem::path& target)
    : target_(target), shape_(shape), file_(path, O_RDWR) {
  require(file_.ok());
  const Hdf5Input input(path);
  for (const Dataset& dataset : datasets_of(shape)) {
    const std::string name = in_group(dataset.name);
    const std::optional<std::uintmax_t> offset = sample_bytes(dataset.map) == 1
                                                     ? input.place_in_file<std::uint8_t>(name)
                                                     : input.place_in_file<float>(name);
    if (!offset) {
      throw IoError(path,
                    std::string(dataset.name) + " is not where it should be; remove this file");
    }
    places_.push_back({dataset.map, *offset});
  }
  std::ranges::sort(places_, {}, &Place::offset);
}

std::uintmax_t DraftFile::map_bytes(const Place& place) const {
  const MapGeometry& maps = shape_.maps;
  return sample_bytes(place.map) * static_cast<std::uintmax_t>(maps.grid.count()) * maps.height *
         maps.width;
}

std::uintmax_t DraftFile::at(const Place& place, ViewIndex view, int row) const {
  const MapGeometry& maps = shape_.maps;
  const auto index =
      static_cast<std::uintmax_t>(view.v - maps.first.v) * maps.grid.u + (view.u - maps.first.u);
  return place.offset + (index * maps.height + row) * maps.width * sample_bytes(place.map);
}

std::uintmax_t DraftFile::byte_size() const {
  struct stat facts {};
  require(::fstat(file_.id(), &facts) == 0);
  return static_cast<std::uintmax_t>(facts.st_size);
}

std::vector<FileExtent> DraftFile::rest() const {
  std::vector<FileExtent> rest;
  std::uintmax_t begin = 0;
  const auto add_until = [&](std::uintmax_t end) {
    if (end <= begin) return;
    FileExtent gap{begin, std::vector<std::uint8_t>(end - begin)};
    require(read_all_at(file_.id(), gap.bytes, begin));
    rest.push_back(std::move(gap));
  };
  for (const Place& place : places_) {
    add_until(place.offset);
    begin = place.offset + map_bytes(place);
  }
  add_until(byte_size());
  return rest;
}

void DraftFile::restore(const std::filesystem::path& path, const std::vector<FileExtent>& rest,
                        std::uintmax_t byte_size) {
  const FileDescriptor file(path, O_RDWR);
  bool is_done = file.ok();
  for (const FileExtent& gap : rest) {
    is_done = is_done && write_all_at(file.id(), gap.bytes, gap.offset);
  }
  is_done = is_done && ::ftruncate(file.id(), static_cast<off_t>(byte_size)) == 0 &&
            ::fdatasync(file.id()) == 0;
  if (!is_done) throw write_error(path);
}

BlockMaps DraftFile::read(const MapBlock& block) const {
  const ViewRectangle& views = block.views;
  const auto empty = [&] {
    return ViewStack<float>(views.grid, block.rows(), shape_.maps.width, 1, views.first);
  };
  BlockMaps maps{{empty(), {}}, empty()};
  if (shape_.has_second) maps.second.disparity = empty();
  for (const Place& place : places_) {
    if (place.map == DraftMap::Valid) continue;
    for (int i = 0; i < views.grid.count(); ++i) {
      const ViewIndex view = views.grid.view_at(i, views.first);
      require(read_all_at(file_.id(), target_in(maps, place.map, view),
                          at(place, view, block.first_row)));
    }
  }
  mark_invalid(maps.second);
  return maps;
}

void DraftFile::write_strips(const FileDescriptor& to, bool is_aside, const MapBlock& block,
                             const BlockMaps& maps) const {
  Image<float> marked;
  std::uintmax_t end = 0;
  for (int i = 0; i < block.views.grid.count(); ++i) {
    const ViewIndex view = block.views.grid.view_at(i, block.views.first);
    for (const Place& place : places_) {
      if (place.map == DraftMap::Valid && maps.field.valid.empty()) continue;
      const std::span<const std::uint8_t> bytes = bytes_in(maps, place.map, view, marked);
      require(write_all_at(to.id(), bytes, is_aside ? end : at(place, view, block.first_row)));
      end += bytes.size();
    }
  }
  require(::fdatasync(to.id()) == 0);
}

void DraftFile::write(const MapBlock& block, const BlockMaps& maps) const {
  write_strips(file_, false, block, maps);
}

void DraftFile::write_aside(const FileDescriptor& aside, const MapBlock& block,
                            const BlockMaps& maps) const {
  write_strips(aside, true, block, maps);
}

void DraftFile::take_from(const FileDescriptor& aside, const MapBlock& block,
                          bool has_valid) const {
  std::vector<std::uint8_t> bytes;
  std::uintmax_t end = 0;
  for (int i = 0; i < block.views.grid.count(); ++i) {
    const ViewIndex view = block.views.grid.view_at(i, block.views.first);
    for (const Place& place : places_) {
      if (place.map == DraftMap::Valid && !has_valid) continue;
      bytes.resize(sample_bytes(place.map) * block.rows() * shape_.maps.width);
      require(read_all_at(aside.id(), bytes, end) &&
              write_all_at(file_.id(), bytes, at(place, view, block.first_row)));
      end += bytes.size();
    }
  }
  require(::fdatasync(file_.id()) == 0);
}

}  // namespace episcope::io
