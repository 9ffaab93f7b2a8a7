// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/estimator.h"

#include "engine/core/error.h"
#include "engine/core/progress.h"
#include "engine/core/version.h"
#include "engine/core/view_places.h"
#include "engine/cuda/device.h"
#include "engine/disparity/disparity_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace episcope {

Names<Profile> names_of(Profile) {
  return {{Profile::Tuned, "tuned"}, {Profile::Paper, kPaperProfile}};
}

Schema<ProfileChoice> profile_schema() {
  return Schema<ProfileChoice>().choice(
      kProfileKey, &ProfileChoice::profile,
      {"Profile",
       "Defaults of the other parameters: tuned, the best known; paper, the method as published. "
       "Parameters that are given keep their value"});
}

namespace {

constexpr int kMaxThreads = 1024;

}  // namespace

Names<ViewSelection> names_of(ViewSelection) {
  return {{ViewSelection::Center, "center"}, {ViewSelection::All, "all"}};
}

Names<Device> names_of(Device) {
  return {{Device::Auto, "auto"}, {Device::Cpu, "cpu"}, {Device::Cuda, "cuda"}};
}

Schema<RunOptions> run_schema() {
  Schema<RunOptions> schema;
  schema
      .choice("views", &RunOptions::views,
              {"Views", "Views to estimate; by default all views if the method supports it"})
      .choice("device", &RunOptions::device, {"Device", "Device to compute on"})
      .integer("threads", &RunOptions::threads,
               {"Threads", "Number of threads; 0 = one per processor"}, {0, kMaxThreads});
  return schema;
}

namespace {

// Maps of whole views or of rows from `first_row` on.
template <class T>
void clear_invalid_of(const LightField& light_field, ViewStack<T>& maps, int first_row = 0) {
  if (light_field.valid().empty() || maps.empty()) return;
  for (int i = 0; i < maps.grid().count(); ++i) {
    const ViewIndex view = maps.grid().view_at(i, maps.first());
    const std::uint8_t* const valid = light_field.valid().view(view).row(first_row);
    T* const map = maps.view(view).data;
    for (std::size_t n = 0; n < maps.view_size(); ++n) {
      if (valid[n] == 0) map[n] = 0;
    }
  }
}

void mark(const LightField& light_field, DisparityField& field, int first_row = 0) {
  if (light_field.valid().empty() || field.empty()) return;
  field.require_mask();
  clear_invalid_of(light_field, field.valid, first_row);
}

}  // namespace

void clear_invalid(const LightField& light_field, ViewStack<float>& maps, int first_row) {
  clear_invalid_of(light_field, maps, first_row);
}

void clear_invalid(const LightField& light_field, ViewStack<std::uint8_t>& maps, int first_row) {
  clear_invalid_of(light_field, maps, first_row);
}

void mark_invalid(const LightField& light_field, Estimate& estimate) {
  mark(light_field, estimate.field);
  mark(light_field, estimate.layered.foreground);
  mark(light_field, estimate.layered.background);
  mark(light_field, estimate.second);
  clear_invalid_of(light_field, estimate.layered.layers);
  clear_invalid_of(light_field, estimate.confidence);
}

void mark_invalid(const LightField& light_field, int first_row, BlockMaps& block) {
  mark(light_field, block.field, first_row);
  mark(light_field, block.second, first_row);
  clear_invalid_of(light_field, block.confidence, first_row);
}

std::size_t count_valid(const LightField& light_field, ViewIndex view) {
  const auto pixels = static_cast<std::size_t>(light_field.height()) * light_field.width();
  if (light_field.valid().empty()) return pixels;
  const std::uint8_t* const valid = light_field.valid().view(view).data;
  return pixels - std::count(valid, valid + pixels, 0);
}

void require_device(Device device, const EstimatorInfo& info) {
  if (device == Device::Auto) return;
  if (std::ranges::count(info.devices, device) == 0) {
    throw Unavailable(fmt::format("{} runs on the CPU only; use --device cpu or auto", info.name));
  }
  if (device != Device::Cuda || has_cuda_device()) return;
  throw Unavailable(fmt::format("there is no GPU to use: {}; use --device cpu or auto",
                                known_cuda_device().why_not));
}

Device chosen_device(Device device, const EstimatorInfo& info) {
  if (device != Device::Auto) return device;
  const bool can_use = std::ranges::count(info.devices, Device::Cuda) > 0 && has_cuda_device();
  return can_use ? Device::Cuda : Device::Cpu;
}

namespace {

// For a parameter `range` that asked to find it, and for a range found that may be too narrow.
void note_range(const LightField& light_field, Provenance& estimate) {
  for (const auto& [key, value] : estimate.parameters) {
    const auto* const wanted = std::get_if<IntervalOrAuto>(&value);
    if (key != "range" || !wanted) continue;
    if (wanted->is_found) estimate.notes.push_back(found_range_note(estimate.range));
    if (range_source(light_field, *wanted) != RangeSource::Found) continue;
    const std::string limited = limited_range_note(light_field, estimate.range);
    if (!limited.empty()) estimate.notes.push_back(limited);
  }
}

// For a method without a parameter `positions`: that it takes cameras for equidistant.
void note_positions(const LightField& light_field, Provenance& estimate) {
  const auto is_choice = [](const auto& entry) { return entry.first == "positions"; };
  if (std::ranges::any_of(estimate.parameters, is_choice)) return;
  const ViewPlaces stated = view_places(light_field.info(), light_field.grid());
  if (stated.kind != PlacesKind::Irregular) return;
  estimate.notes.push_back(fmt::format(
      "cameras stand up to {:.2f} steps off the regular grid, which this method takes for granted; "
      "stereo methods can use their positions",
      stated.largest_deviation));
}

constexpr const char* kCpu = "CPU";

// Method, seconds, version, source and camera; and what parameters leave open: a range that was to be
// found, cameras taken for equidistant.
void complete_provenance(Provenance& estimate, const std::string& method,
                         const LightField& light_field, double seconds) {
  estimate.method = method;
  estimate.seconds = seconds;
  estimate.version = kVersion;
  estimate.commit = built_commit();
  estimate.source = light_field.info().source;
  estimate.reading = light_field.info().reading;
  estimate.camera = light_field.info().camera;
  note_range(light_field, estimate);
  note_positions(light_field, estimate);
}

// Notes where it computed, unless there was no choice.
Estimate estimate_on_device(Device device, const EstimatorInfo& info,
                            const std::function<Estimate(Device)>& estimate) {
  const auto on_cpu = [&] {
    Estimate result = estimate(Device::Cpu);
    result.device = kCpu;
    return result;
  };
  if (chosen_device(device, info) == Device::Cpu) return on_cpu();
  try {
    Estimate result = estimate(Device::Cuda);
    result.device = known_cuda_device().name;
    result.notes.push_back(fmt::format("computed on {}", known_cuda_device().name));
    return result;
  } catch (const DeviceFailure& failure) {
    if (device == Device::Cuda) throw;
    Estimate result = on_cpu();
    result.notes.push_back(fmt::format("computed on the CPU: {}", failure.what()));
    return result;
  }
}

using EvenLightFieldPtr = std::shared_ptr<const EvenLightField>;

// What a method sees instead of the light field; null if it sees that.
EvenLightFieldPtr equalized_for(const EstimatorInfo& info, const LightField& light_field,
                                EvenViews& even, const Progress& progress) {
  return info.sees_even_views ? even.of(light_field, progress) : nullptr;
}

// A pass refers to the equalized light field, which lives as long as the pass, and of which it
// holds nothing between blocks.
BlockPass forgetting(const EvenLightFieldPtr& seen, BlockPass pass) {
  if (pass.prepare) {
    pass.prepare = [seen, prepare = std::move(pass.prepare)](const ReadBlock& read,
                                                             const std::vector<double>& facts,
                                                             const Progress& progress) {
      std::vector<double> found = prepare(read, facts, progress);
      seen->light_field.forget_samples();
      return found;
    };
  }
  pass.compute = [seen, compute = std::move(pass.compute)](
                     const MapBlock& block, const ReadBlock& read, const std::vector<double>& facts,
                     const Progress& progress) {
    FinishedBlock made = compute(block, read, facts, progress);
    seen->light_field.forget_samples();
    return made;
  };
  return pass;
}

}  // namespace

Estimate Estimator::run(const LightField& given, EvenViews& even, const ParameterSet& values,
                        const RunOptions& options, const Progress& progress) const {
  require_device(options.device, info);
  const Progress limited = progress.limited_to(options.threads);
  const EvenLightFieldPtr equalized = equalized_for(info, given, even, limited);
  const LightField& light_field = equalized ? equalized->light_field : given;
  const Stopwatch watch;
  Estimate result = estimate_on_device(options.device, info, [&](Device device) {
    return estimate(light_field, values, options.views, limited, device);
  });
  mark_invalid(light_field, result);
  complete_provenance(result, info.id, light_field, watch.seconds());
  if (equalized) result.notes.push_back(equalized->note);
  return result;
}

BlockwiseRun Estimator::in_blocks(const LightField& given, EvenViews& even,
                                  const ParameterSet& values, const RunOptions& options,
                                  const Progress& progress) const {
  require_device(options.device, info);
  const Progress limited = progress.limited_to(options.threads);
  const EvenLightFieldPtr equalized = equalized_for(info, given, even, limited);
  const LightField& light_field = equalized ? equalized->light_field : given;
  BlockwiseRun run = blocks(light_field, values, options.views, limited);
  complete_provenance(run.provenance, info.id, light_field, 0);
  run.provenance.device = kCpu;
  if (!equalized) return run;
  run.provenance.notes.push_back(equalized->note);
  for (BlockPass& pass : run.passes) pass = forgetting(equalized, std::move(pass));
  return run;
}

}  // namespace episcope
