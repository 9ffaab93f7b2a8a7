// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/estimator.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/version.h"
#include "engine/cuda/device.h"
#include "engine/disparity/disparity_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

void mark(const LightField& light_field, DisparityField& field, int first_row = 0) {
  if (light_field.valid().empty() || field.empty()) return;
  field.require_mask();
  clear_invalid(light_field, field.valid, first_row);
}

// For a parameter `range` that asked to find it, for a range found that may be too narrow, and for
// one given that holds nothing.
void note_range(const LightField& light_field, Provenance& estimate) {
  for (const auto& [key, value] : estimate.parameters) {
    const auto* const wanted = std::get_if<IntervalOrAuto>(&value);
    if (key != "range" || !wanted) continue;
    if (wanted->is_found) estimate.notes.push_back(found_range_note(estimate.range));
    const RangeSource source = range_source(light_field, *wanted);
    if (source == RangeSource::Promised) continue;
    std::string doubt = source == RangeSource::Given
                            ? foreign_range_note(light_field, **wanted)
                            : limited_range_note(light_field, estimate.range);
    if (!doubt.empty()) estimate.notes.push_back(std::move(doubt));
  }
}

// For a method without a parameter `positions`: that it takes cameras for equidistant.
void note_positions(const LightField& light_field, Provenance& estimate) {
  const auto is_choice = [](const auto& entry) { return entry.first == "positions"; };
  if (std::ranges::any_of(estimate.parameters, is_choice)) return;
  const ViewPlaces stated = view_places(light_field.info(), light_field.grid());
  if (stated.kind != PlacesKind::Irregular) return;
  estimate.notes.push_back(
      fmt::format(finding_text("positions.regular"), stated.largest_deviation));
}

constexpr const char* kCpu = "CPU";

// Method, seconds, version, source and camera; and what parameters leave open: a range that was to
// be found, cameras taken for equidistant.
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
    result.notes.push_back(fmt::format(finding_text("run.gpu"), known_cuda_device().name));
    return result;
  } catch (const DeviceFailure& failure) {
    if (device == Device::Cuda) throw;
    Estimate result = on_cpu();
    result.notes.push_back(fmt::format(finding_text("run.cpu"), failure.what()));
    return result;
  }
}

using EvenLightFieldPtr = std::shared_ptr<const EvenLightField>;

// What a method sees instead of the light field; null if it sees that.
EvenLightFieldPtr equalized_for(const EstimatorInfo& info, const LightField& light_field,
                                EvenViews& even, const Progress& progress) {
  if (!info.sees_even_views) return nullptr;
  progress.step("comparing the brightness of views");
  return even.of(light_field, progress);
}

// Share of a run that comparing and correcting brightness may take.
constexpr double kEqualizing = 0.1;

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

// Bands of fewer rows would mostly compute what they need around them.
constexpr int kFewestRows = 8;

int most_at_once(const BlockPass& pass, const MapGeometry& maps) {
  const int views = pass.only.empty() ? maps.grid.u : 1;
  return pass.unit == BlockUnit::Rows ? maps.height : views;
}

int fewest_at_once(const BlockPass& pass, const MapGeometry& maps) {
  return std::min(pass.unit == BlockUnit::Rows ? kFewestRows : 1, most_at_once(pass, maps));
}

class BlockRunner {
 public:
  BlockRunner(const LightField& light_field, const BlockwiseRun& run, BlockStore& store,
              BlockMemory memory)
      : light_field_(light_field),
        run_(run),
        store_(store),
        wanted_(static_cast<double>(memory.wanted)),
        state_(store.progress()),
        seconds_before_(state_.seconds) {}

  void make(const Progress& progress) {
    const auto passes = static_cast<double>(run_.passes.size());
    while (state_.pass < static_cast<int>(run_.passes.size())) {
      make_pass(progress.part(state_.pass / passes, (state_.pass + 1) / passes));
    }
  }

  [[nodiscard]] Provenance provenance() const {
    Provenance made = run_.provenance;
    made.seconds = state_.seconds;
    std::vector<std::string> notes = state_.notes;
    if (run_.notes) {
      for (std::string& note : run_.notes(state_)) notes.push_back(std::move(note));
    }
    made.notes.insert(made.notes.begin(), notes.begin(), notes.end());
    return made;
  }

 private:
  [[nodiscard]] bool is_last() const {
    return state_.pass + 1 == static_cast<int>(run_.passes.size());
  }
  [[nodiscard]] int count_of(const BlockPass& pass) const {
    if (pass.unit == BlockUnit::Rows) return run_.maps.height;
    return pass.only.empty() ? run_.maps.grid.count() : static_cast<int>(pass.only.size());
  }

  // How many rows or views at once.
  [[nodiscard]] int block_size(const BlockPass& pass) const {
    int few = fewest_at_once(pass, run_.maps);
    int many = most_at_once(pass, run_.maps) + 1;  // few fit, many do not
    while (many - few > 1) {
      const int middle = few + (many - few) / 2;
      (pass.bytes(middle) <= wanted_ ? few : many) = middle;
    }
    return few;
  }

  // The next block: bands of all views, or views of one row of the grid.
  [[nodiscard]] MapBlock next_block(const BlockPass& pass, int size) const {
    const MapGeometry& maps = run_.maps;
    if (pass.unit == BlockUnit::Rows) {
      return {{maps.first, maps.grid}, state_.done, std::min(state_.done + size, maps.height)};
    }
    if (!pass.only.empty()) return {{pass.only[state_.done], {1, 1}}, 0, maps.height};
    const ViewIndex view = maps.grid.view_at(state_.done, maps.first);
    const int left = maps.first.u + maps.grid.u - view.u;
    return {{view, {1, std::min(size, left)}}, 0, maps.height};
  }

  void begin_pass(const BlockPass& pass, const Progress& progress) {
    if (!pass.prepare || state_.is_prepared) return;
    state_.facts = pass.prepare(read_, state_.facts, progress);
    state_.is_prepared = true;
    light_field_.forget_samples();
    state_.seconds = seconds();
    store_.note(state_);
  }

  void make_pass(const Progress& progress) {
    const BlockPass& pass = run_.passes[static_cast<std::size_t>(state_.pass)];
    progress.step(pass.step);
    begin_pass(pass, progress.part(0, 0.02));
    const int size = block_size(pass), count = count_of(pass);
    while (state_.done < count) {
      const MapBlock block = next_block(pass, size);
      const int done =
          state_.done + (pass.unit == BlockUnit::Rows ? block.rows() : block.views.grid.count());
      const auto share = [&](int of) { return 0.02 + 0.98 * of / count; };
      make_block(pass, block, done, progress.part(share(state_.done), share(done)));
    }
    if (is_last()) {
      ++state_.pass;
      return;
    }
    end_pass();
  }

  void end_pass() {
    ++state_.pass;
    state_.done = 0;
    state_.finding = 0;
    state_.is_prepared = false;
    state_.seconds = seconds();
    store_.note(state_);
  }

  void make_block(const BlockPass& pass, const MapBlock& block, int done,
                  const Progress& progress) {
    progress.check();
    FinishedBlock made = pass.compute(block, read_, state_.facts, progress);
    progress.check();
    if (is_last()) mark_invalid(light_field_, block.first_row, made.maps);
    light_field_.forget_samples();
    state_.done = done;
    state_.finding = std::max(state_.finding, made.finding);
    if (!made.facts.empty()) state_.facts = std::move(made.facts);
    state_.notes.insert(state_.notes.end(), made.notes.begin(), made.notes.end());
    state_.seconds = seconds();
    store_.write(block, made.maps, state_, state_.pass > 0);
  }

  [[nodiscard]] double seconds() const { return seconds_before_ + watch_.seconds(); }

  const LightField& light_field_;
  const BlockwiseRun& run_;
  BlockStore& store_;
  double wanted_;
  BlockProgress state_;
  double seconds_before_;
  Stopwatch watch_;
  ReadBlock read_{[this](const MapBlock& block) { return store_.read(block); }};
};

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

template <class T>
void clear_invalid(const LightField& light_field, ViewStack<T>& maps, int first_row) {
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

template void clear_invalid(const LightField&, ViewStack<float>&, int);
template void clear_invalid(const LightField&, ViewStack<std::uint8_t>&, int);

void mark_invalid(const LightField& light_field, Estimate& estimate) {
  mark(light_field, estimate.field);
  mark(light_field, estimate.layered.foreground);
  mark(light_field, estimate.layered.background);
  mark(light_field, estimate.second);
  clear_invalid(light_field, estimate.layered.layers);
  clear_invalid(light_field, estimate.confidence);
}

void mark_invalid(const LightField& light_field, int first_row, BlockMaps& block) {
  mark(light_field, block.field, first_row);
  mark(light_field, block.second, first_row);
  clear_invalid(light_field, block.confidence, first_row);
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

Estimate Estimator::run(const LightField& given, EvenViews& even, const ParameterSet& values,
                        const RunOptions& options, const Progress& progress) const {
  require_device(options.device, info);
  const Progress limited = progress.limited_to(options.threads);
  const EvenLightFieldPtr equalized =
      equalized_for(info, given, even, limited.part(0, kEqualizing));
  const LightField& light_field = equalized ? equalized->light_field : given;
  const Stopwatch watch;
  Estimate result = estimate_on_device(options.device, info, [&](Device device) {
    return estimate(light_field, values, options.views, limited.part(kEqualizing, 1), device);
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
  const EvenLightFieldPtr equalized = equalized_for(info, given, even, limited.part(0, 0.5));
  const LightField& light_field = equalized ? equalized->light_field : given;
  BlockwiseRun run = blocks(light_field, values, options.views, limited.part(0.5, 1));
  complete_provenance(run.provenance, info.id, light_field, 0);
  run.provenance.device = kCpu;
  if (!equalized) return run;
  run.provenance.notes.push_back(equalized->note);
  for (BlockPass& pass : run.passes) pass = forgetting(equalized, std::move(pass));
  return run;
}

void require_memory(const BlockwiseRun& run, BlockMemory memory) {
  constexpr double kMegabyte = 1e6;
  const auto most = static_cast<double>(memory.most);
  double least = 0;
  for (const BlockPass& pass : run.passes) {
    least = std::max(least, pass.bytes(fewest_at_once(pass, run.maps)));
  }
  if (least <= most) return;
  throw InvalidInput(
      fmt::format("{} of this light field needs {:.0f} MB of memory at least, but only {:.0f} "
                  "MB may be used; allow more",
                  run.provenance.method, std::ceil(least / kMegabyte), most / kMegabyte));
}

Provenance run_blocks(const LightField& lf, const BlockwiseRun& run, BlockStore& store,
                      BlockMemory memory, const Progress& progress) {
  require_memory(run, memory);
  BlockRunner blocks(lf, run, store, memory);
  blocks.make(progress);
  return blocks.provenance();
}

}  // namespace episcope
