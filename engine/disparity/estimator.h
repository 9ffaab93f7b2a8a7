// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/isa.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/schema.h"

#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace episcope {

/// Whether a method runs with the settings that are best here, or as published.
enum class Profile { Tuned, Paper };
[[nodiscard]] Names<Profile> names_of(Profile);

/// The key of the parameter, and its value for the method as published.
inline constexpr const char* kProfileKey = "profile";
inline constexpr const char* kPaperProfile = "paper";

/// Chooses defaults of other parameters (Schema::preset): each method says which are those of the
/// paper. What is given beside the profile wins.
struct ProfileChoice {
  Profile profile = Profile::Tuned;
};
[[nodiscard]] Schema<ProfileChoice> profile_schema();

/// Which views an estimate should cover.
enum class ViewSelection { All, Center };
[[nodiscard]] Names<ViewSelection> names_of(ViewSelection);

[[nodiscard]] Names<Device> names_of(Device);

/// How a method is run, whichever it is.
struct RunOptions {
  ViewSelection views = ViewSelection::All;  ///< A method for single views estimates one anyway.
  Device device = Device::Auto;
  int threads = 0;  ///< At most so many; 0 = as many as its Progress allows.
};

[[nodiscard]] Schema<RunOptions> run_schema();

/// Reads what has been made of a block so far: the maps of the pass before, as long as the pass has
/// not replaced them, and one of those that were kept.
struct ReadBlock {
  std::function<BlockMaps(const MapBlock&)> maps;
  std::function<ViewStack<float>(const MapBlock&, int number)> kept;
  [[nodiscard]] BlockMaps operator()(const MapBlock& block) const { return maps(block); }
};

/// How the maps are cut: into bands of rows of all views, or into views.
enum class BlockUnit { Rows, Views };

/// What a block becomes.
struct FinishedBlock {
  BlockMaps maps;
  double finding = 0;                ///< Something of which the largest of all blocks is wanted.
  std::vector<double> facts{};       ///< For all further blocks; empty = nothing new.
  std::vector<std::string> notes{};  ///< For the estimate.
};

/// One pass over all maps. What it makes of a block depends on samples, on the facts, and on the
/// maps that the pass before left of the same block: not on how the maps are cut.
struct BlockPass {
  std::string step;  ///< For Progress.
  BlockUnit unit = BlockUnit::Rows;
  /// Of BlockUnit::Views: only these, one after the other. Empty = all.
  std::vector<ViewIndex> only{};
  /// Bytes of memory that a block of so many rows or views takes, samples that have to be looked at
  /// included if they are on disk.
  std::function<double(int count)> bytes;
  /// What all blocks have to know, found before the first from what passes before have found. If
  /// empty, they know just that.
  std::function<std::vector<double>(const ReadBlock&, const std::vector<double>& facts,
                                    const Progress&)>
      prepare;
  /// Throws Cancelled.
  std::function<FinishedBlock(const MapBlock&, const ReadBlock&, const std::vector<double>& facts,
                              const Progress&)>
      compute;
};

/// An estimate that can be made block by block, equal bit by bit to the one that is made at once.
/// Refers to its light field.
struct BlockwiseRun {
  MapGeometry maps;
  bool has_layers = false;  ///< Whether blocks have BlockMaps::layered.
  /// How many maps are kept for later passes. A pass that keeps a block must not read what was kept
  /// of it before: where the program ended, the block is made and kept once more.
  int kept = 0;
  Provenance provenance;  ///< With the range; the notes are completed by `notes`.
  std::vector<BlockPass> passes;
  /// Of the largest finding of the last pass and the facts at the end; may be empty.
  std::function<std::vector<std::string>(const BlockProgress& end)> notes;
};

/// What pixels that hold nothing (LightField::valid) mean for estimates. A light field without a
/// mask leaves everything as it is.

/// Sets maps of some views of the light field, whole or rows from `first_row` on, to 0 where its
/// pixels are invalid.
void clear_invalid(const LightField& light_field, ViewStack<float>& maps, int first_row = 0);
void clear_invalid(const LightField& light_field, ViewStack<std::uint8_t>& maps, int first_row = 0);

/// Marks the results of invalid pixels as not valid; sets their confidence and number of layers to
/// 0.
void mark_invalid(const LightField& light_field, Estimate& estimate);
/// The same of a block that begins with row `first_row`.
void mark_invalid(const LightField& light_field, int first_row, BlockMaps& block);

/// Number of valid pixels of a view.
[[nodiscard]] std::size_t count_valid(const LightField& light_field, ViewIndex view);

/// The description of a method in lists.
struct EstimatorInfo {
  std::string id;          ///< As on the command line: "epi_l".
  std::string name;        ///< As in the paper: "EPI_L".
  std::string summary;     ///< One line.
  std::string reference;   ///< Authors, year, key in resources/references.bib.
  bool all_views = false;  ///< Estimates every view at once; else one, the centre by default.
  bool iterative = false;  ///< Ends early with what it has (Progress::finish_requested).
  int revision = 1;  ///< Grows whenever results change: kept benchmark results are then renewed.
  std::vector<Device> devices = {Device::Cpu};  ///< Where it can compute.
};

/// Throws Unavailable if the method cannot compute there; with Device::Auto it always can.
void require_device(Device device, const EstimatorInfo& info);

/// Where a method computes that was asked to on `device`: the CPU or CUDA. Auto takes CUDA where
/// the method and the machine have it.
[[nodiscard]] Device chosen_device(Device device, const EstimatorInfo& info);

/// Runs `estimate(device)` where `chosen_device` says. If a device that was not demanded fails, or
/// has too little memory, the CPU takes over. Notes which, unless there was no choice.
[[nodiscard]] Estimate estimate_on_device(Device device, const EstimatorInfo& info,
                                          const std::function<Estimate(Device)>& estimate);

/// A disparity estimator: pure, no globals, no files. Values of this type come from
/// `registered_estimators()`; `make_estimator` makes one from a parameter struct and a function.
struct Estimator {
  EstimatorInfo info;
  std::vector<ParameterDescription> parameters;

  /// Estimates with `values` over the defaults. Fills every field of Estimate but `source_hash`.
  /// Throws Unavailable as `require_device`, InvalidInput for bad parameters or a light field that
  /// the method cannot use, Cancelled on a stop request (within 200 ms).
  std::function<Estimate(const LightField&, const ParameterSet& values, const RunOptions&,
                         const Progress&)>
      run;

  /// The same block by block, where the method can: finds what blocks have in common,
  /// and throws likewise. The run refers to the light field. Empty if it cannot, and then what does
  /// not fit into memory is on disk (memory_budget.h).
  std::function<BlockwiseRun(const LightField&, const ParameterSet& values, const RunOptions&,
                             const Progress&)>
      in_blocks;
};

/// Adapts a typed method to the interface. `estimate(light_field, P, ViewSelection, Progress)`,
/// followed by a Device that is never Auto where the method has a choice of devices, returns an
/// Estimate with maps, confidence, range and notes; the rest is filled in here. Pixels that the
/// light field marks as invalid get no valid result.
template <class P, class F>
Estimator make_estimator(EstimatorInfo info, Schema<P> schema, F estimate);

/// The same for a method that can also run in blocks: `blocks(light_field, P, ViewSelection,
/// Progress)` returns a BlockwiseRun with maps, passes and range.
template <class P, class F, class B>
Estimator make_estimator(EstimatorInfo info, Schema<P> schema, F estimate, B blocks);

/// Fills provenance (method, seconds, version, source) of an estimate begun `seconds` ago, and
/// notes what its parameters leave open: a range that was to be found, cameras taken for
/// equidistant.
void complete_estimate(Provenance& estimate, const std::string& method,
                       const LightField& light_field, double seconds);

template <class P, class F>
Estimator make_estimator(EstimatorInfo info, Schema<P> schema, F estimate) {
  Estimator estimator;
  estimator.info = info;
  estimator.parameters = schema.descriptions();
  estimator.run = [info = std::move(info), schema = std::move(schema),
                   estimate = std::move(estimate)](
                      const LightField& light_field, const ParameterSet& values,
                      const RunOptions& options, const Progress& progress) {
    require_device(options.device, info);
    const Stopwatch watch;
    const P parameters = schema.parse(values);
    const Progress limited = progress.limited_to(options.threads);
    constexpr bool knows_devices =
        std::is_invocable_v<F, const LightField&, const P&, ViewSelection, const Progress&, Device>;
    Estimate result = [&] {
      if constexpr (knows_devices) {
        return estimate_on_device(options.device, info, [&](Device device) {
          return estimate(light_field, parameters, options.views, limited, device);
        });
      } else {
        return estimate(light_field, parameters, options.views, limited);
      }
    }();
    mark_invalid(light_field, result);
    result.parameters = schema.values(parameters);
    complete_estimate(result, info.id, light_field, watch.seconds());
    return result;
  };
  return estimator;
}

template <class P, class F, class B>
Estimator make_estimator(EstimatorInfo info, Schema<P> schema, F estimate, B blocks) {
  Estimator estimator = make_estimator<P>(info, schema, std::move(estimate));
  estimator.in_blocks = [=](const LightField& light_field, const ParameterSet& values,
                            const RunOptions& options, const Progress& progress) {
    require_device(options.device, info);
    const P parameters = schema.parse(values);
    const Progress limited = progress.limited_to(options.threads);
    BlockwiseRun run = blocks(light_field, parameters, options.views, limited);
    run.provenance.parameters = schema.values(parameters);
    complete_estimate(run.provenance, info.id, light_field, 0);
    return run;
  };
  return estimator;
}

}  // namespace episcope
