// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/isa.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/schema.h"
#include "engine/core/view_gain.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace episcope {

/// Whether a method runs with the settings that are best here, or as published.
enum class Profile { Tuned, Paper };
[[nodiscard]] Names<Profile> names_of(Profile);

/// The key of the parameter, and its value for the method as published.
inline constexpr const char* kProfileKey = "profile";
inline constexpr const char* kPaperProfile = "paper";

/// Chooses defaults of other parameters (Schema::preset): each method names the defaults of the
/// paper. Values given beside the profile win.
struct ProfileChoice {
  Profile profile = Profile::Tuned;
};
[[nodiscard]] Schema<ProfileChoice> profile_schema();

/// Which views an estimate should cover.
enum class ViewSelection { All, Center };
[[nodiscard]] Names<ViewSelection> names_of(ViewSelection);

[[nodiscard]] Names<Device> names_of(Device);

/// Options of a run that all methods share.
struct RunOptions {
  ViewSelection views = ViewSelection::All;  ///< A method for single views estimates one anyway.
  Device device = Device::Auto;
  int threads = 0;  ///< At most so many; 0 = as many as its Progress allows.
};

[[nodiscard]] Schema<RunOptions> run_schema();

/// Reads the state of a block: the maps of the previous pass, as long as this pass has not replaced
/// them.
using ReadBlock = std::function<BlockMaps(const MapBlock&)>;

/// Cut of the maps: bands of rows of all views, or single views.
enum class BlockUnit { Rows, Views };

/// Result of a block.
struct FinishedBlock {
  BlockMaps maps;
  double finding = 0;                ///< Value whose maximum over all blocks is reported.
  std::vector<double> facts{};       ///< Passed on to all further blocks; empty = nothing new.
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
  bool has_second = false;  ///< Whether blocks have BlockMaps::second.
  Provenance provenance;    ///< With the range; the notes are completed by `notes`.
  std::vector<BlockPass> passes;
  /// Of the largest finding of the last pass and the facts at the end; may be empty.
  std::function<std::vector<std::string>(const BlockProgress& end)> notes;
};

/// Invalid pixels (LightField::valid) in estimates. A light field without a mask changes nothing.

/// Sets maps of some views of the light field, whole or rows from `first_row` on, to 0 where its
/// pixels are invalid.
template <class T>  // float, std::uint8_t
void clear_invalid(const LightField& light_field, ViewStack<T>& maps, int first_row = 0);

/// Marks the results of invalid pixels as not valid; sets their confidence and number of layers to
/// 0.
void mark_invalid(const LightField& light_field, Estimate& estimate);
/// Marks a block that begins with row `first_row`.
void mark_invalid(const LightField& light_field, int first_row, BlockMaps& block);

/// Number of valid pixels of a view.
[[nodiscard]] std::size_t count_valid(const LightField& light_field, ViewIndex view);

/// The description of a method in lists.
struct EstimatorInfo {
  std::string id;          ///< As on the command line: "epi_l".
  std::string name;        ///< As in the paper: "EPI_L".
  std::string summary;     ///< One line.
  std::string reference;   ///< Authors, year, key in resources/references.bib.
  bool all_views = false;  ///< Estimates every view at once; else one, the center by default.
  bool iterative = false;  ///< Ends early with what it has (Progress::finish_requested).
  int revision = 1;  ///< Grows whenever results change: kept benchmark results are then renewed.
  std::vector<Device> devices = {Device::Cpu};  ///< Where it can compute.
  /// Views are equalized before it runs (EvenViews); else it does so itself.
  bool sees_even_views = true;
  std::string weights{};  ///< Of a learned method: their file (installed_weights).
  std::vector<std::string> main_parameters{};  ///< Keys of the two or three that users set first.
};

/// Throws Unavailable if the method cannot compute there; with Device::Auto it always can.
void require_device(Device device, const EstimatorInfo& info);

/// The device that a method runs on: the CPU or CUDA. Auto takes CUDA where the method and the
/// machine have it.
[[nodiscard]] Device chosen_device(Device device, const EstimatorInfo& info);

/// A disparity estimator: pure, no globals, no files. Values of this type come from
/// `registered_estimators()`; `make_estimator` makes one from a parameter struct and a function.
struct Estimator {
  EstimatorInfo info;
  std::vector<ParameterDescription> parameters;

  /// The method alone, on views as they are: returns maps, confidence, range, notes and the values
  /// of all parameters. The device is never Auto.
  std::function<Estimate(const LightField&, const ParameterSet& values, ViewSelection,
                         const Progress&, Device)>
      estimate;
  /// The method alone in blocks; empty if it cannot, and then what does not fit into memory is on
  /// disk (memory.h).
  std::function<BlockwiseRun(const LightField&, const ParameterSet& values, ViewSelection,
                             const Progress&)>
      blocks;

  /// Equalizes the views (EvenViews), estimates with `values` over the defaults on the chosen
  /// device, marks invalid pixels and completes the provenance: every field of Estimate but
  /// `source_hash`. If a device that was not demanded fails, or has too little memory, the CPU
  /// takes over. Throws Unavailable as `require_device`, InvalidInput for bad parameters or a light
  /// field that the method cannot use, Cancelled on a stop request (within 200 ms).
  /// `even` keeps the equalized views for further runs.
  [[nodiscard]] Estimate run(const LightField& light_field, EvenViews& even,
                             const ParameterSet& values, const RunOptions& options,
                             const Progress& progress) const;
  /// Keeps nothing for further runs.
  [[nodiscard]] Estimate run(const LightField& light_field, const ParameterSet& values,
                             const RunOptions& options, const Progress& progress) const {
    EvenViews even;
    return run(light_field, even, values, options, progress);
  }

  [[nodiscard]] bool can_run_in_blocks() const { return static_cast<bool>(blocks); }
  /// As `run`, block by block: finds what blocks have in common, and throws likewise. The run
  /// refers to the light field. Precondition: can_run_in_blocks().
  [[nodiscard]] BlockwiseRun in_blocks(const LightField& light_field, EvenViews& even,
                                       const ParameterSet& values, const RunOptions& options,
                                       const Progress& progress) const;
  [[nodiscard]] BlockwiseRun in_blocks(const LightField& light_field, const ParameterSet& values,
                                       const RunOptions& options, const Progress& progress) const {
    EvenViews even;
    return in_blocks(light_field, even, values, options, progress);
  }
};

/// Adapts a typed method to the interface. `method(light_field, P, ViewSelection, Progress)`,
/// followed by a Device where it has a choice of devices, returns an Estimate with maps,
/// confidence, range and notes.
template <class P, class F>
Estimator make_estimator(EstimatorInfo info, Schema<P> schema, F method) {
  Estimator estimator{std::move(info), schema.descriptions(), {}, {}};
  estimator.estimate = [schema = std::move(schema), method = std::move(method)](
                           const LightField& light_field, const ParameterSet& values,
                           ViewSelection views, const Progress& progress, Device device) {
    const P parameters = schema.parse(values);
    Estimate result = [&] {
      if constexpr (std::is_invocable_v<F, const LightField&, const P&, ViewSelection,
                                        const Progress&, Device>) {
        return method(light_field, parameters, views, progress, device);
      } else {
        return method(light_field, parameters, views, progress);
      }
    }();
    result.parameters = schema.values(parameters);
    return result;
  };
  return estimator;
}

/// Adapts a method that can also run in blocks: `blocks(light_field, P, ViewSelection, Progress)`
/// returns a BlockwiseRun with maps, passes and range.
template <class P, class F, class B>
Estimator make_estimator(EstimatorInfo info, Schema<P> schema, F method, B blocks) {
  Estimator estimator = make_estimator<P>(std::move(info), schema, std::move(method));
  estimator.blocks = [schema = std::move(schema), blocks = std::move(blocks)](
                         const LightField& light_field, const ParameterSet& values,
                         ViewSelection views, const Progress& progress) {
    const P parameters = schema.parse(values);
    BlockwiseRun run = blocks(light_field, parameters, views, progress);
    run.provenance.parameters = schema.values(parameters);
    return run;
  };
  return estimator;
}

/// Keeps the maps of an unfinished estimate and its progress beyond the end of the program.
class BlockStore {
 public:
  virtual ~BlockStore() = default;
  /// Progress of a former program.
  [[nodiscard]] virtual BlockProgress progress() const = 0;
  [[nodiscard]] virtual BlockMaps read(const MapBlock& block) const = 0;
  /// Records progress alone.
  virtual void note(const BlockProgress& after) = 0;
  /// Keeps a block, then notes the progress; `replaces` if the pass needs what was there to make
  /// the block again. If the program ends in between, either both or neither is found again.
  virtual void write(const MapBlock& block, const BlockMaps& maps, const BlockProgress& after,
                     bool replaces) = 0;
};

/// Bytes of memory for blocks: maps, samples on disk and intermediate results. The program itself
/// and a light field in memory come on top.
struct BlockMemory {
  std::size_t wanted = 0;  ///< Blocks are as large as this allows,
  std::size_t most = 0;    ///< but the smallest may take this.
};

/// Throws InvalidInput, with the least that will do, if the smallest block of a pass exceeds the
/// memory. For callers that have something to prepare, or to replace, before a run.
void require_memory(const BlockwiseRun& run, BlockMemory memory);

/// Completes an estimate and returns its notes and seconds. The last pass marks invalid pixels.
/// Throws as require_memory, before anything is made; Cancelled; what the method and the store
/// throw.
[[nodiscard]] Provenance run_blocks(const LightField& light_field, const BlockwiseRun& run,
                                    BlockStore& store, BlockMemory memory,
                                    const Progress& progress);

}  // namespace episcope
