// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi/epi_s.h"

namespace episcope {
namespace {

// Pixels that the views contradict should follow their neighbours.
constexpr float kMinWeight = 0.003F;

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
  Estimate estimate =
      estimate_orientations(lf, parameters.tensor, views, progress.part(0, 0.4), device);
  check_lines(lf, parameters.line_check, estimate, progress.part(0.4, 0.5), device);
  denoise(lf, parameters.denoising, estimate, progress.part(0.5, 0.98),
          parameters.line_check.is_on ? kMinWeight : DataWeight{}.minimum, 0, device);
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
