// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi_s.h"

#include "engine/cuda/host_pages.h"
#include "engine/cuda/orientations.h"
#include "engine/disparity/view_samples.h"

#include <algorithm>
#include <future>
#include <utility>

namespace episcope {
namespace {

// Pixels that the views contradict should follow their neighbors.
constexpr float kDenoisedMinWeight = 0.003F;

float least_weight(const EpiSParameters& parameters) {
  return parameters.line_check.is_on ? kDenoisedMinWeight : DataWeight{}.minimum;
}

// The second pass of a run in blocks: some views of a row of the grid.
class DenoisedViews {
 public:
  DenoisedViews(const LightField& light_field, const EpiSParameters& parameters, Interval range)
      : light_field_(light_field), parameters_(parameters), range_(range) {}

  [[nodiscard]] FinishedBlock compute(const MapBlock& block, const ReadBlock& read,
                                      const std::vector<double>& noise,
                                      const Progress& progress) const {
    FinishedBlock made{read(block)};
    const LineCheck& check = parameters_.line_check;
    if (check.does_anything()) {
      const PackedViews packed =
          pack_around(light_field_, block.views, kMaxArmViews, progress.part(0, 0.1));
      check_lines(packed, check, noise, made.maps, progress.part(0.1, 0.4));
    }
    ViewStack<float>& disparity = made.maps.field.disparity;
    made.finding = denoise(light_field_, parameters_.denoising, {least_weight(parameters_)},
                           disparity, made.maps.confidence, progress.part(0.4, 0.98));
    clamp_to_range(disparity, range_, progress.part(0.98, 1));
    return made;
  }

  // Packed views, maps, and what denoising a view takes, for as many views as there are threads.
  [[nodiscard]] double bytes(int count, int threads) const {
    constexpr double kPacked = 4, kMaps = 9, kDenoised = 96, kChecked = 24;
    const double pixels = static_cast<double>(light_field_.height()) * light_field_.width();
    const int views = packed_around(count, kMaxArmViews);
    const double looked_at =
        light_field_.is_on_disk()
            ? static_cast<double>(light_field_.byte_size()) / light_field_.grid().count()
            : 0;
    return views * (kPacked * pixels + looked_at) +
           pixels * (kMaps * count + kChecked + kDenoised * std::min(count, threads));
  }

 private:
  const LightField& light_field_;
  EpiSParameters parameters_;
  Interval range_;
};

// On the device from the samples to the result.
Estimate estimate_on_gpu(const LightField& lf, const EpiSParameters& parameters,
                         ViewSelection views, const Progress& progress) {
  Estimate estimate = begin_orientations(lf, parameters.tensor, views, progress.part(0, 0.05));
  const Interval range = estimate.range;
  const auto of_disparity = cuda::begin_pages(estimate.field.disparity, progress);
  const auto of_confidence = cuda::begin_pages(estimate.confidence, progress);
  cuda::DeviceMaps maps(estimate.field.disparity);
  cuda::find_orientations(lf, orientation_settings(lf, parameters.tensor, range), maps,
                          progress.part(0.05, 0.15));
  const LineCheck& lines = parameters.line_check;
  cuda::check_lines(lf, {lines.chooses_sides, lines.is_on}, maps, progress.part(0.15, 0.25));
  progress.step("denoising");
  std::future<void> confidence =
      maps.begin_confidence(estimate.confidence, progress.part(0.25, 0.25));
  const std::vector<double> gaps =
      cuda::denoise_maps(lf, map_denoising(parameters.denoising, least_weight(parameters)), maps,
                         progress.part(0.25, 0.9));
  estimate.notes.push_back(gap_note(*std::ranges::max_element(gaps)));
  maps.clamp(static_cast<float>(range.min), static_cast<float>(range.max));
  maps.download_disparity(estimate.field.disparity, progress.part(0.9, 1));
  confidence.get();
  return estimate;
}

// Runs EPI_S block by block: orientations in bands of rows, then single views, each of which needs
// up to 16 others.
BlockwiseRun epi_s_in_blocks(const LightField& lf, const EpiSParameters& parameters,
                             ViewSelection views, const Progress& progress) {
  BlockwiseRun run = orientations_in_blocks(lf, parameters.tensor, views, progress);
  const DenoisedViews denoised(lf, parameters, run.provenance.range);
  BlockPass pass;
  pass.step = "checking lines and denoising";
  pass.unit = BlockUnit::Views;
  pass.bytes = [denoised, threads = progress.threads()](int count) {
    return denoised.bytes(count, threads);
  };
  pass.prepare = [&lf, check = parameters.line_check](
                     const ReadBlock& read, const std::vector<double>&, const Progress& part) {
    return line_check_noise(lf, check, read({{lf.center(), {1, 1}}, 0, lf.height()}), part);
  };
  pass.compute = [denoised](const MapBlock& block, const ReadBlock& read,
                            const std::vector<double>& noise, const Progress& part) {
    return denoised.compute(block, read, noise, part);
  };
  run.passes.push_back(std::move(pass));
  run.notes = [](const BlockProgress& end) {
    return std::vector<std::string>{gap_note(end.finding)};
  };
  return run;
}

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

}  // namespace

Estimate estimate_epi_s(const LightField& lf, const EpiSParameters& parameters, ViewSelection views,
                        const Progress& progress, Device device) {
  if (device == Device::Cuda) return estimate_on_gpu(lf, parameters, views, progress);
  Estimate estimate = estimate_orientations(lf, parameters.tensor, views, progress.part(0, 0.4));
  check_lines(lf, parameters.line_check, estimate, progress.part(0.4, 0.5));
  denoise(lf, parameters.denoising, estimate, progress.part(0.5, 0.98), least_weight(parameters));
  clamp_to_range(estimate.field.disparity, estimate.range, progress.part(0.98, 1));
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
       .revision = 6,
       .devices = {Device::Cpu, Device::Cuda},
       .main_parameters = {"range", "lambda", "outer_scale"}},
      epi_s_schema(), estimate_epi_s, epi_s_in_blocks);
}

}  // namespace episcope
