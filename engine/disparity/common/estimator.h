// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/core/parallel/stopwatch.h"
#include "engine/core/parameter/schema.h"
#include "engine/disparity/common/blockwise.h"
#include "engine/disparity/common/invalid_pixels.h"
#include "engine/disparity/common/run_options.h"

#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace episcope {

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

  /// The same block by block (blockwise.h), where the method can: finds what blocks have in common,
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
