// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/result_file.h"

#include "engine/core/error.h"
#include "engine/core/hash.h"
#include "engine/core/numbers.h"
#include "engine/core/version.h"
#include "engine/io/base/json.h"
#include "engine/io/models/external_result.h"
#include "engine/io/models/open_options.h"
#include "engine/io/models/stored_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace episcope::io {
namespace {

/// Bytes of all maps, with some room for the structure of the file.
std::uintmax_t result_bytes(const Estimate& estimate) {
  std::uintmax_t bytes = 1 << 16;
  for (const DisparityField* field : {&estimate.field, &estimate.layered.foreground,
                                      &estimate.layered.background, &estimate.second}) {
    if (!field->empty()) bytes += field->disparity.size() * sizeof(float);
    if (!field->valid.empty()) bytes += field->valid.size();
  }
  if (!estimate.confidence.empty()) bytes += estimate.confidence.size() * sizeof(float);
  if (!estimate.layered.layers.empty()) bytes += estimate.layered.layers.size();
  return bytes;
}

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

/// Writes the maps of an estimate.
class ResultWriter {
 public:
  ResultWriter(Hdf5Output& file, Hdf5Storage floats) : file_(file), floats_(floats) {}

  void write(const Estimate& estimate, const Progress& progress) {
    write_field(estimate.field, "disparity", "valid", progress.part(0, 0.6));
    if (!estimate.confidence.empty()) {
      file_.set_storage(floats_);
      write_stack(file_, in_group("confidence"), estimate.confidence, kNoUnit,
                  progress.part(0.6, 0.9));
    }
    const LayeredDisparity& layered = estimate.layered;
    const Progress last = progress.part(0.9, 1);
    if (!estimate.second.empty()) {
      file_.set_storage(floats_);
      write_disparity(file_, in_group("disparity_second"), estimate.second,
                      geometry_of(estimate.second.disparity), last);
    }
    write_field(layered.foreground, "disparity_foreground", "valid_foreground", last);
    write_field(layered.background, "disparity_background", "valid_background", last);
    if (layered.layers.empty()) return;
    file_.set_storage(Hdf5Storage::Deflated);
    write_stack(file_, in_group("layers"), layered.layers, "surfaces", last);
  }

 private:
  void write_field(const DisparityField& field, const char* name, const char* valid,
                   const Progress& progress) {
    if (field.empty()) return;
    file_.set_storage(floats_);
    write_disparity(file_, in_group(name), field, geometry_of(field.disparity),
                    progress.part(0, 0.85));
    if (field.valid.empty()) return;
    file_.set_storage(Hdf5Storage::Deflated);
    write_stack(file_, in_group(valid), field.valid, kNoUnit, progress.part(0.85, 1));
  }

  Hdf5Output& file_;
  Hdf5Storage floats_;
};

/// Reads the maps of an own result file, which all have the same views, in the order of axes that
/// the file states: other programs may have written it again.
class ResultReader {
 public:
  ResultReader(const std::filesystem::path& path, GridShape grid) : file_(path), grid_(grid) {}

  [[nodiscard]] Estimate read() const {
    Estimate estimate;
    estimate.field = read_field("disparity", "valid");
    estimate.confidence = read_if_there<float>("confidence");
    estimate.layered.foreground = read_field_if_there("disparity_foreground", "valid_foreground");
    estimate.layered.background = read_field_if_there("disparity_background", "valid_background");
    estimate.layered.layers = read_if_there<std::uint8_t>("layers");
    estimate.second.disparity = read_if_there<float>("disparity_second");
    mark_invalid(estimate.second);
    read_provenance(estimate);
    return estimate;
  }

 private:
  [[nodiscard]] ViewIndex first_view(bool is_single) const {
    const std::vector<double> view = file_.numbers(kResultGroup, is_single ? "view" : "first_view");
    if (view.size() == 2) return {whole_int(view[0]).value_or(-1), whole_int(view[1]).value_or(-1)};
    return is_single ? grid_.center() : ViewIndex{};
  }

  template <class T>
  [[nodiscard]] ViewStack<T> read_stack(const char* name) const {
    const Hdf5Dataset map = file_.dataset(in_group(name));
    const std::size_t rank = map.shape.size();
    if (rank != 2 && rank != 4) {
      throw IoError(
          file_.path(),
          fmt::format("the dataset {} has {} axes, but 2 or 4 are expected; write the result again",
                      map.name, rank));
    }
    const ArrayLayout layout = stated_map_layout(file_, map);
    const GridShape views = layout.grid();
    const ViewIndex first = first_view(layout.has_one_view());
    const bool fits = views.v > 0 && views.u > 0 && grid_.contains(first) &&
                      views.v <= grid_.v - first.v && views.u <= grid_.u - first.u;
    if (!fits || layout.height() < 1 || layout.width() < 1) {
      throw IoError(file_.path(),
                    fmt::format("the dataset {} of {} does not fit a light field of {}×{} views; "
                                "name the light field that it belongs to",
                                map.name, shape_text(map.shape), grid_.v, grid_.u));
    }
    return read_laid_out<T>(file_, map.name, layout, first);
  }

  template <class T>
  [[nodiscard]] ViewStack<T> read_if_there(const char* name) const {
    return file_.has(in_group(name)) ? read_stack<T>(name) : ViewStack<T>();
  }

  [[nodiscard]] DisparityField read_field(const char* name, const char* valid) const {
    DisparityField field{read_stack<float>(name), read_if_there<std::uint8_t>(valid)};
    if (!field.valid.empty() && field.valid.size() != field.disparity.size()) {
      throw IoError(file_.path(), "the datasets " + in_group(name) + " and " + in_group(valid) +
                                      " differ in size; write the result again");
    }
    mark_invalid(field);
    return field;
  }

  [[nodiscard]] DisparityField read_field_if_there(const char* name, const char* valid) const {
    return file_.has(in_group(name)) ? read_field(name, valid) : DisparityField{};
  }

  void read_provenance(Estimate& estimate) const {
    const auto text = [&](const char* name) { return file_.text(kResultGroup, name).value_or(""); };
    estimate.method = text("method");
    estimate.parameters = parameters_from_json(text("parameters"));
    estimate.seconds = file_.number(kResultGroup, "seconds").value_or(0);
    estimate.version = text("version");
    estimate.source = text("source");
    estimate.source_hash = hash_from_digits(text("source_hash"));
    estimate.reading = reading_in(file_, kResultGroup);
    estimate.camera = camera_in(file_, kResultGroup);
    estimate.device = text("device");
    estimate.commit = text("commit");
    estimate.date = text("date");
    estimate.notes = split_lines(text("notes"));
    constexpr int widest = 1 << 16;
    const double border_px = file_.number(kResultGroup, "border_px").value_or(0);
    estimate.border_px = std::clamp(whole_int(border_px).value_or(0), 0, widest);
    const std::vector<double> range = file_.numbers(kResultGroup, "range");
    if (range.size() == 2) estimate.range = {range[0], range[1]};
  }

  Hdf5Input file_;
  GridShape grid_;
};

}  // namespace

void write_result(const std::filesystem::path& path, const Estimate& estimate,
                  const Progress& progress, const ResultForm& form) {
  if (estimate.field.empty()) throw InvalidInput("an estimate without disparity cannot be written");
  progress.check();
  AtomicFile target(path, result_bytes(estimate));
  Hdf5Output file(target);
  file.add_group(kResultGroup);
  ResultWriter(file, form.floats).write(estimate, progress);
  const MapGeometry maps = geometry_of(estimate.field.disparity);
  describe_maps(file, maps);
  write_provenance(file, estimate, maps, form.source.value_or(estimate.source));
  file.close();
  progress.check();
  target.commit();
}

Estimate read_result(const std::filesystem::path& path, GridShape grid, const std::string& scene) {
  if (is_result_file(path)) return ResultReader(path, grid).read();
  return read_external_result(path, grid, scene);
}

Reading read_reading(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path) || !has_hdf5_signature(path)) return {};
  const Hdf5Input file(path);
  return reading_in(file, file.has(kResultGroup) ? kResultGroup : "/");
}

bool is_result_file(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path) || !has_hdf5_signature(path)) return false;
  return Hdf5Input(path).has(kResultGroup);
}

namespace {

std::string join_lines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

constexpr std::pair<const char*, const char*> kMapMeanings[] = {
    {"disparity", "disparity; NaN = not known"},
    {"confidence", "confidence, 0 to 1"},
    {"valid", "1 where the disparity is known, else 0"},
    {"disparity_foreground", "disparity of the surface in front; NaN = not known"},
    {"disparity_background", "disparity of the surface behind; NaN = not known"},
    {"valid_foreground", "1 where the disparity of the surface in front is known, else 0"},
    {"valid_background", "1 where the disparity of the surface behind is known, else 0"},
    {"layers", "number of surfaces: 1 or 2"},
};

constexpr const char* kSign =
    "positive disparity = nearer than the plane of zero disparity; a point at (x, y) of view "
    "(v, u) is at (x - d, y) of view (v, u + 1) and at (x, y - d) of view (v + 1, u)";
constexpr const char* kAxisOrder =
    "v = row of views, counted downwards; u = column of views, counted to the right; y = row of "
    "pixels, counted downwards; x = column of pixels, counted to the right; all from 0; x varies "
    "fastest; MATLAB and Octave show the axes in the opposite order";
constexpr const char* kDepthFormula =
    "Z = dH * focalLength / (disparity + shift), distance to the image plane in units of the scene";
constexpr const char* kHashName = "FNV-1a of 64 bits over the sizes and samples of the light field";

void write_run(Hdf5Output& file, const Provenance& estimate) {
  const auto write = [&](const char* name, const std::string& text) {
    if (!text.empty()) file.set_text(kResultGroup, name, text);
  };
  write("program", "Episcope");
  write("version", estimate.version.empty() ? kVersion : estimate.version);
  write("commit", estimate.commit);
  write("date", estimate.date);
  write("device", estimate.device);
  file.set_number(kResultGroup, "seconds", estimate.seconds);
}

}  // namespace

std::string in_group(const char* name) {
  return std::string(kResultGroup) + "/" + name;
}

void write_provenance(Hdf5Output& file, const Provenance& estimate, const MapGeometry& maps,
                      const std::string& source) {
  file.set_text(kResultGroup, "method", estimate.method);
  file.set_text(kResultGroup, "parameters", parameters_to_json(estimate.parameters));
  write_run(file, estimate);
  file.set_text(kResultGroup, "sign", kSign);
  file.set_text(kResultGroup, "axis_order", kAxisOrder);
  if (estimate.camera.is_known()) {
    write_camera(file, kResultGroup, estimate.camera);
    file.set_text(kResultGroup, "depth", kDepthFormula);
  }
  file.set_text(kResultGroup, "source", source);
  if (estimate.source_hash != 0) {
    file.set_text(kResultGroup, "source_hash", hash_digits(estimate.source_hash));
    file.set_text(kResultGroup, "source_hash_of", kHashName);
  }
  write_reading(file, kResultGroup, estimate.reading);
  if (!(estimate.range == Interval{})) {
    file.set_numbers(kResultGroup, "range", {estimate.range.min, estimate.range.max});
  }
  if (maps.grid.count() == 1) {
    file.set_integers(kResultGroup, "view", {maps.first.v, maps.first.u});
  } else if (!(maps.first == ViewIndex{})) {
    file.set_integers(kResultGroup, "first_view", {maps.first.v, maps.first.u});
  }
  if (!estimate.notes.empty()) file.set_text(kResultGroup, "notes", join_lines(estimate.notes));
  if (estimate.border_px > 0) file.set_number(kResultGroup, "border_px", estimate.border_px);
}

void describe_maps(Hdf5Output& file, const MapGeometry& maps) {
  for (const auto& [name, meaning] : kMapMeanings) {
    if (file.has(in_group(name))) file.set_text(in_group(name), "long_name", meaning);
  }
  std::vector<Hdf5Axis> axes;
  if (maps.grid.count() > 1) {
    axes = {{"v", "view", "row of views, counted downwards", maps.first.v, maps.grid.v},
            {"u", "view", "column of views, counted to the right", maps.first.u, maps.grid.u}};
  }
  axes.push_back({"y", "px", "row of pixels, counted downwards", 0, maps.height});
  axes.push_back({"x", "px", "column of pixels, counted to the right", 0, maps.width});
  file.add_axes(kResultGroup, axes);
}

void write_camera(Hdf5Output& file, const std::string& group, const CameraGrid& camera) {
  file.set_number(group, "dH", camera.baseline);
  file.set_number(group, "focalLength", camera.focal_length);
  file.set_number(group, "shift", camera.shift);
  if (camera.cam_distance) file.set_number(group, "camDistance", *camera.cam_distance);
  if (const auto& pinhole = camera.pinhole) {
    file.set_numbers(group, kPinhole, {pinhole->focal_px, pinhole->center_x, pinhole->center_y});
  }
}

CameraGrid camera_in(const Hdf5Input& file, const std::string& group) {
  CameraGrid camera;
  camera.baseline = file.number(group, "dH").value_or(0);
  camera.focal_length = file.number(group, "focalLength").value_or(0);
  camera.shift = file.number(group, "shift").value_or(0);
  camera.cam_distance = file.number(group, "camDistance");
  const std::vector<double> pinhole = file.numbers(group, kPinhole);
  if (pinhole.size() == 3) camera.pinhole = Pinhole{pinhole[0], pinhole[1], pinhole[2]};
  const bool is_sound = std::isfinite(camera.baseline) && std::isfinite(camera.focal_length) &&
                        std::isfinite(camera.shift);
  return is_sound ? camera : CameraGrid{};
}

void write_reading(Hdf5Output& file, const std::string& group, const Reading& reading) {
  if (reading.reader.empty()) return;
  file.set_text(group, "reader", reading.reader);
  file.set_text(group, "reading", parameters_to_json(reading.options));
}

Reading reading_in(const Hdf5Input& file, const std::string& group) {
  const auto options = file.text(group, "reading");
  return {file.text(group, "reader").value_or(""),
          options ? stored_options(parameters_from_json(*options)) : ParameterSet()};
}

}  // namespace episcope::io
