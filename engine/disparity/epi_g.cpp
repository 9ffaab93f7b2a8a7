// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi_g.h"

#include "engine/core/parallel.h"
#include "engine/disparity/denoise.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/matching_cost.h"
#include "engine/disparity/view_samples.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace episcope {
namespace {

// No pixel gets weight 0 when it is placed between labels.
constexpr float kLabelMinWeight = 0.01F;

struct WeightedDirection {
  Image<float> disparity, weight;

  WeightedDirection(const Estimate& estimate, ViewIndex view, double power) {
    const auto d = estimate.field.disparity.view(view), r = estimate.confidence.view(view);
    disparity = Image<float>(d.height, d.width);
    weight = Image<float>(d.height, d.width);
    std::copy_n(d.data, disparity.size(), disparity.data());
    fill_data_weights(r, {power, 0}, weight);
  }
};

class DirectionalData {
 public:
  DirectionalData(const DirectionalOrientations& orientations, ViewIndex view, double power)
      : directions_{WeightedDirection(orientations.horizontal, view, power),
                    WeightedDirection(orientations.vertical, view, power)} {}

  [[nodiscard]] Volume<float> costs(const std::vector<float>& labels,
                                    const EpiGParameters& parameters,
                                    const Progress& progress) const {
    const Image<float>& shape = directions_[0].disparity;
    Volume<float> volume(shape.height(), static_cast<int>(labels.size()), shape.width());
    const auto most = static_cast<float>(parameters.truncation);
    const bool least = parameters.direction_costs == DirectionCosts::Least;
    parallel_for(shape.height(), progress, [&](int y) {
      for (std::size_t l = 0; l < labels.size(); ++l) {
        float* const cost = volume.view().row(y, static_cast<int>(l));
        for (std::size_t i = 0; i < 2; ++i) {
          const float* const d = directions_[i].disparity.row(y);
          const float* const w = directions_[i].weight.row(y);
          for (int x = 0; x < shape.width(); ++x) {
            const float own = w[x] * std::min(std::fabs(labels[l] - d[x]), most);
            cost[x] = i == 0 ? own : least ? std::min(cost[x], own) : cost[x] + own;
          }
        }
      }
    });
    return volume;
  }

  [[nodiscard]] double mean_weight(std::size_t pixels) const {
    double sum = 0;
    for (const WeightedDirection& direction : directions_) {
      sum = std::accumulate(direction.weight.begin(), direction.weight.end(), sum);
    }
    return sum / (2.0 * static_cast<double>(pixels));
  }

  // The mean of the directions that agree with the label.
  [[nodiscard]] Placement place(int y, int x, float label, float step) const {
    float sum = kLabelMinWeight * label, weight = kLabelMinWeight;
    for (const WeightedDirection& direction : directions_) {
      const float d = direction.disparity.at(y, x);
      if (std::fabs(d - label) > step) continue;
      sum += direction.weight.at(y, x) * d;
      weight += direction.weight.at(y, x);
    }
    return {sum / weight, std::min(weight, 1.0F)};
  }

 private:
  WeightedDirection directions_[2];
};

void check_directions(const LightField& lf, const LineCheck& check,
                      DirectionalOrientations& directions, const Progress& progress,
                      Device device) {
  if (!check.does_anything()) return;
  if (device == Device::Cuda) {
    check_lines(lf, check, directions.horizontal, progress.part(0, 0.5), device);
    check_lines(lf, check, directions.vertical, progress.part(0.5, 1), device);
    return;
  }
  const PackedViews views = pack_views(lf, progress.part(0, 0.2));
  check_lines(views, check, directions.horizontal, progress.part(0.2, 0.6));
  check_lines(views, check, directions.vertical, progress.part(0.6, 1));
}

Schema<EpiGParameters> epi_g_schema() {
  using P = EpiGParameters;
  return Schema<P>()
      .part(&P::labeling, global_labeling_schema())
      .integer("labels", &P::labels,
               {"Disparity steps", "Number of equidistant disparities tested"}, {2, 512, true})
      .choice("direction_costs", &P::direction_costs,
              {"Combine directions",
               "sum: horizontal and vertical estimates both count, each truncated; least: the one "
               "that is nearer to the label counts"})
      .real("truncation", &P::truncation,
            {"Truncation κ", "Estimates farther than this from the label are treated as outliers",
             "px"},
            {0.01, 5, true})
      .real("weight_power", &P::weight_power,
            {"Coherence exponent p", "The data term is weighted by coherence^p"}, {0, 16})
      .part(&P::line_check, line_check_schema())
      .part(&P::tensor, epi_l_schema())
      .begin_with(kProfileKey)
      .preset(kProfileKey, kPaperProfile, plain_labeling())
      .preset(kProfileKey, kPaperProfile,
              {{"smoothness", 0.75},
               {"direction_costs", std::string("least")},
               {"truncation", 5.0},
               {"weight_power", 1.0},
               {"choose_sides", false},
               {"check_lines", false}})
      .preset_search(kProfileKey, kPaperProfile, "smoothness", {0.05, 0.1, 0.2, 0.4, 0.75, 1.5})
      .search("smoothness", {0.75, 1.5, 3, 6, 12})
      .search("weight_power", {0, 2, 8})
      .search("truncation", {0.1, 0.3, 1});
}

}  // namespace

Names<DirectionCosts> names_of(DirectionCosts) {
  return {{DirectionCosts::Sum, "sum"}, {DirectionCosts::Least, "least"}};
}

Estimate estimate_epi_g(const LightField& lf, const EpiGParameters& parameters,
                        const Progress& progress, Device device) {
  DirectionalOrientations directions =
      estimate_directions(lf, parameters.tensor, progress.part(0, 0.06), device);
  check_directions(lf, parameters.line_check, directions, progress.part(0.06, 0.1), device);
  const ViewIndex view = lf.center();
  Estimate estimate;
  estimate.range = directions.horizontal.range;
  estimate.confidence = ViewStack<float>({1, 1}, lf.height(), lf.width(), 1, view);
  const float* const r_h = directions.horizontal.confidence.data();
  std::transform(r_h, r_h + estimate.confidence.size(), directions.vertical.confidence.data(),
                 estimate.confidence.data(), [](float a, float b) { return std::max(a, b); });
  const DirectionalData data(directions, view, parameters.weight_power);
  const std::vector<float> labels = equidistant_labels(estimate.range, parameters.labels);
  const Volume<float> costs = data.costs(labels, parameters, progress.part(0.1, 0.12));
  const float step = labels[1] - labels[0];
  const auto place = [&](const Image<int>& chosen, const Progress& part) {
    return place_pixels(
        chosen, [&](int y, int x, int label) { return data.place(y, x, labels[label], step); },
        part);
  };
  const double scale = data.mean_weight(std::max<std::size_t>(1, count_valid(lf, view)));
  const double noise = view_noise_variance(lf, view, progress.part(0.12, 0.121));
  cuda::SharedVolume on_device;
  if (device == Device::Cuda)
    on_device = cuda::upload_volume(costs.view(), progress.part(0.121, 0.121));
  label_globally(lf, {view, labels, costs.view(), scale, place, noise, on_device},
                 parameters.labeling, estimate, progress.part(0.121, 1));
  return estimate;
}

Estimator epi_g_estimator() {
  return make_estimator<EpiGParameters>(
      {.id = "epi_g",
       .name = "EPI_G",
       .summary = "Globally optimal labeling from the orientations on epipolar plane images",
       .reference = "Wanner and Goldluecke 2012 [WG12]",
       .iterative = true,
       .revision = 7,
       .devices = {Device::Cpu, Device::Cuda},
       .main_parameters = {"range", "labels", "smoothness"}},
      epi_g_schema(),
      [](const LightField& light_field, const EpiGParameters& parameters, ViewSelection,
         const Progress& progress,
         Device device) { return estimate_epi_g(light_field, parameters, progress, device); });
}

}  // namespace episcope
