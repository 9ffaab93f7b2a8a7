// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/array_scene.h"

#include "engine/core/error.h"
#include "engine/core/text/join.h"
#include "engine/io/arrays/array_maps.h"
#include "engine/io/arrays/array_preview.h"
#include "engine/io/arrays/array_samples.h"
#include "engine/io/arrays/choose_layout.h"
#include "engine/io/arrays/list_grid.h"
#include "engine/io/arrays/luma_chroma.h"
#include "engine/io/arrays/several_fields.h"
#include "engine/io/arrays/stacked_channels.h"
#include "engine/io/maps/sample_range.h"
#include "engine/io/open/assemble_scene.h"
#include "engine/io/open/grid_option.h"
#include "engine/io/open/scene_name.h"

#include <fmt/format.h>

namespace episcope::io {
namespace {

constexpr const char* kOptions[] = {"flip", "grid", "crop", "dataset", "axes", "frame", "levels"};

/// As the light field itself says which pixels hold something, or a mask beside it.
void combine(ViewStack<std::uint8_t>& valid, ViewStack<std::uint8_t> mask) {
  if (valid.empty()) {
    valid = std::move(mask);
  } else if (!mask.empty()) {
    std::transform(valid.data(), valid.data() + valid.size(), mask.data(), valid.data(),
                   [](std::uint8_t a, std::uint8_t b) { return std::min(a, b); });
  }
}

const ArrayEntry& light_field_of(const ArrayFile& file, const OpenOptions& options) {
  const ArrayEntry* entry = find_light_field(file, options.dataset, options.axes);
  if (entry) return *entry;
  if (!options.axes.empty()) {
    throw InvalidInput(fmt::format("{}: no array of this file has the {} axes {}; state others",
                                   file.path().string(), options.axes.size(), options.axes));
  }
  const std::string held = joined(file.entries(), "; ", [](const ArrayEntry& one) {
    return one.name + ", " + content_text(one);
  });
  throw IoError(file.path(), fmt::format("no array of this file has the shape of a light field; if "
                                         "one is, name it with --dataset and its axes with --axes "
                                         "(there {})",
                                         held.empty() ? "is none" : "are: " + held.substr(0, 300)));
}

LightFieldInfo info_of(const ArrayFile& file, const char* reader) {
  LightFieldInfo info;
  info.name = scene_name(file.path());
  info.source = file.path().string();
  info.reading.reader = reader;
  return info;
}

void report_form(const ArrayFile& file, const ArrayEntry& entry, const ChosenLayout& chosen,
                 ConventionReport& report) {
  const std::string name = entry.name.empty() ? "" : entry.name + ", ";
  report.format =
      fmt::format("{} ({}{} {}; axes {})", file.form(), name,
                  layout_text(chosen.layout, entry.order), number_name(entry.type), chosen.reason);
  if (!entry.warning.empty()) report.warnings.push_back(entry.warning);
  if (!chosen.warning.empty()) report.warnings.push_back(chosen.warning);
}

SceneProbe probe_single(const ArrayFile& file, const OpenOptions& options) {
  const ArrayEntry* entry = find_light_field(file, options.dataset, options.axes);
  if (!entry) throw NoLightField(file.path(), "no array of this file has the shape of one");
  const ArrayLayout layout = choose_layout(file, *entry, options.axes).layout;
  SceneProbe probe{.grid = layout.grid(),
                   .height = layout.height(),
                   .width = layout.width(),
                   .channels = layout.length('c') < 3 ? 1 : 3};
  if (layout.has('n')) {
    probe.list = probe.grid.count();
    probe.grid = given_grid(options).value_or(GridShape());
  }
  if (entry->type == NumberType::UInt8) probe.sample_type = SampleType::UInt8;
  if (entry->type == NumberType::UInt16) probe.sample_type = SampleType::UInt16;
  return probe;
}

Scene read_single(const ArrayFile& file, const char* reader, const OpenOptions& options,
                  const Progress& progress, const OtherArrays& more) {
  const ArrayEntry& entry = light_field_of(file, options);
  ChosenLayout chosen = choose_layout(file, entry, options.axes);
  const std::unique_ptr<ArrayInput> array = file.open(entry);
  SceneParts parts;
  parts.info = info_of(file, reader);
  if (options.on_center_view && !array->is_sequential()) {
    const GridShape grid = chosen.layout.grid();
    options.on_center_view(array_preview(*array, chosen.layout, grid.center()), parts.info, grid);
  }
  progress.check();
  check_layout(*array, entry.order, chosen, progress);

  Scene scene;
  progress.step("reading views");
  ArraySamples read = read_samples(*array, chosen.layout, progress.part(0, 0.7));
  settle_range(read.samples, options.levels, scene.convention);
  if (!read.left_out.empty()) {
    scene.convention.warnings.push_back(fmt::format(
        "The fourth channel of {} is left out: it is no weight of pixels, for {}. If it is depth "
        "or disparity, store it as an array of its own, as disparity or depth.",
        entry.name, read.left_out));
  }
  decode_luma_chroma(entry.name, read.samples, scene.convention);
  progress.step("reading maps");
  std::vector<const ArrayEntry*> others;
  for (const ArrayEntry& other : file.entries()) {
    const bool is_owned = more.owns && more.owns(other);
    if (&other != &entry && !is_owned) others.push_back(&other);
  }
  ArrayMaps maps = read_array_maps(file, others, {chosen.layout, entry.order}, options.needs_truth,
                                   progress.part(0.7, 0.8));
  parts.samples = std::move(read.samples);
  parts.valid = std::move(read.valid);
  combine(parts.valid, std::move(maps.valid));
  parts.truth = std::move(maps.truth);
  if (chosen.layout.has('n')) {
    const bool is_row = chosen.layout.has(kSingle) && options.axes.empty();
    const auto stored = is_row ? std::optional(chosen.layout.grid()) : std::nullopt;
    arrange_list(file.path(), options, parts, chosen.reason, progress, stored);
  }
  settle_disparity(parts.samples, maps, parts.truth.field, parts.info.camera, scene.convention);
  report_form(file, entry, chosen, scene.convention);
  parts.files = std::move(maps.uses);
  parts.files.insert(parts.files.begin(), {"light field", 1, entry.name, true});
  parts.expected.is_truth_sign_assumed = maps.is_sign_assumed;
  parts.expected.reason = "arrays do not say how their views are ordered";
  if (more.add) more.add(parts, scene.convention, progress);
  assemble(std::move(parts), options, scene, progress.part(0.8, 1));
  return scene;
}

}  // namespace

std::span<const char* const> array_options() {
  return kOptions;
}

SceneProbe probe_arrays(const ArrayFile& file, const OpenOptions& options) {
  const auto several = SeveralFields::find(file, options);
  if (!several) {
    const auto colours = with_stacked_channels(file, options);
    return probe_single(colours ? *colours : file, options);
  }
  SceneProbe probe = probe_single(*several->one(file, several->index(file, options)), options);
  if (!several->is_named(options)) probe.frames = several->count();
  return probe;
}

Scene read_array_scene(const ArrayFile& file, const char* reader, const OpenOptions& options,
                       const Progress& progress, const OtherArrays& more) {
  const auto several = SeveralFields::find(file, options);
  if (!several) {
    const auto colours = with_stacked_channels(file, options);
    return read_single(colours ? *colours : file, reader, options, progress, more);
  }
  const int index = several->index(file, options);
  Scene scene = read_single(*several->one(file, index), reader, options, progress, {});
  if (!several->is_named(options)) scene.sequence = {index, several->count()};
  scene.convention.warnings.insert(scene.convention.warnings.begin(), several->text(index));
  return scene;
}

}  // namespace episcope::io
