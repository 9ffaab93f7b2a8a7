// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi/epi_s.h"

#include "engine/cuda/line_check/line_check.h"

#include <algorithm>

namespace episcope {
namespace {

// Pixels that the views contradict should follow their neighbours.
constexpr float kMinWeight = 0.003F;

float min_weight(const EpiSParameters& parameters) {
  return parameters.line_check.is_on ? kMinWeight : DataWeight{}.minimum;
}

// On the device from the samples to the result.
Estimate estimate_on_gpu(const LightField& lf, const EpiSParameters& parameters,
                         ViewSelection views, const Progress& progress) {
  Estimate estimate = begin_orientations(lf, parameters.tensor, views, progress.part(0, 0.05));
  const Interval range = estimate.range;
  cuda::DeviceMaps maps(estimate.field.disparity);
  cuda::find_orientations(lf, orientation_settings(lf, parameters.tensor, range), maps,
                          progress.part(0.05, 0.15));
  const LineCheck& lines = parameters.line_check;
  cuda::check_lines(lf, {lines.chooses_sides, lines.is_on}, maps, progress.part(0.15, 0.25));
  progress.step("denoising");
  const std::vector<double> gaps =
      cuda::denoise_maps(lf, map_denoising(parameters.denoising, min_weight(parameters)), maps,
                         progress.part(0.25, 0.9));
  estimate.notes.push_back(gap_note(*std::ranges::max_element(gaps)));
  maps.clamp(static_cast<float>(range.min), static_cast<float>(range.max));
  maps.download(estimate.field.disparity, estimate.confidence, progress.part(0.9, 1));
  return estimate;
}

}  // namespace

Schema<EpiSParameters> epi_s_schema() {
  return Schema<EpiSParameters>()
      .part(&EpiSParameters::denoising, denoise_schema())
      .part(&EpiSParameters::line_check, line_check_schema())
      .part(&EpiSParameters::tensor, epi_l_schema())
      .begin_with(kProfileKey)
      .preset(kProfileKey, kPaperProfile, plain_denoising())
      .preset(kProfileKey, kPaperProfile,
              {{"lambda", 0.2}, {"choose_sides", false}, {"check_lines", false}})
      .preset_search(kProfileKey, kPaperProfile, "lambda", {0.02, 0.05, 0.1, 0.2, 0.4, 0.8})
      .search("lambda", {0.05, 0.1, 0.2, 0.4, 0.8})
      .search("weight_power", {0, 2, 4, 8})
      .search("edge_strength", {0, 15, 30});
}

Estimate estimate_epi_s(const LightField& lf, const EpiSParameters& parameters, ViewSelection views,
                        const Progress& progress, Device device) {
  if (device == Device::Cuda) return estimate_on_gpu(lf, parameters, views, progress);
  Estimate estimate = estimate_orientations(lf, parameters.tensor, views, progress.part(0, 0.4));
  check_lines(lf, parameters.line_check, estimate, progress.part(0.4, 0.5));
  denoise(lf, parameters.denoising, estimate, progress.part(0.5, 0.98), min_weight(parameters));
  clamp_to_range(estimate, progress.part(0.98, 1));
  return estimate;
}

Estimator epi_s_estimator() {
  return make_estimator<EpiSParameters>(
      {.id = "epi_s",
       .name = "EPI_S",
       .summary = "EPI_L, denoised view by view with total variation (TV-L2)",
       .reference = "Wanner and Goldluecke 2013 [WG13]",
       .all_views = true,
       .iterative = true,
       .revision = 5,
       .devices = {Device::Cpu, Device::Cuda}},
      epi_s_schema(),
      [](const LightField& lf, const EpiSParameters& parameters, const RunOptions& options,
         const Progress& progress) {
        return estimate_epi_s(lf, parameters, options.views, progress, options.device);
      });
}

}  // namespace episcope
