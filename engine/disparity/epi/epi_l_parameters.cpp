// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi/epi_l_parameters.h"

#include "engine/disparity/common/disparity_range.h"

#include <cmath>

namespace episcope {
namespace {

Schema<EpiLParameters> scales_schema() {
  using P = EpiLParameters;
  return Schema<P>()
      .real("inner_scale", &P::inner_scale,
            {"Inner scale",
             "Standard deviation of the Gaussian applied to the samples before derivatives", "px"},
            {0, 2})
      .real("outer_scale", &P::outer_scale,
            {"Outer scale",
             "Standard deviation of the Gaussian window over which orientation is averaged, along "
             "the EPI",
             "px"},
            {0, 2})
      .real("view_scale", &P::view_scale,
            {"View scale", "Standard deviation of the same window along the views", "views"},
            {0, 3})
      .real("cross_scale", &P::cross_scale,
            {"Cross scale", "Standard deviation of the same window across neighbouring EPIs", "px"},
            {0, 2});
}

}  // namespace

Schema<EpiLParameters> orientation_schema() {
  using P = EpiLParameters;
  return scales_schema()
      .real("shear_step", &P::shear_step,
            {"Shear step",
             "Spacing of the shears that bring every line close to upright before its orientation "
             "is measured; rounded to half pixels; 0 = whole pixels, and only if the range exceeds "
             "±1.2 px",
             "px"},
            {0, 1.5})
      .real("contrast", &P::contrast,
            {"Contrast limit",
             "Gradients above this are attenuated, so that silhouettes do not drown the texture "
             "beside them; 255 = off",
             "1/255"},
            {0.1, 255, true})
      .real("noise", &P::noise,
            {"Noise floor", "Texture with less contrast than this loses confidence", "1/255"},
            {0, 50})
      .choice("orientation", &P::orientation,
              {"Orientation", "How the disparity is read off the structure tensor"})
      .choice("fusion", &P::fusion,
              {"Fusion",
               "weighted: horizontal and vertical estimates that agree are averaged; winner: the "
               "more coherent one is taken"})
      .integer("fusion_power", &P::fusion_power,
               {"Fusion power",
                "Horizontal and vertical estimates are averaged with weights coherence^p"},
               {0, 32})
      .interval("range", &P::range, {"Disparity range", kRangeHelp, "px"}, {-20, 20});
}

Names<Orientation> names_of(Orientation) {
  return {{Orientation::LeastSquares, "least_squares", "least squares"},
          {Orientation::Eigenvector, "eigenvector"}};
}

Names<Fusion> names_of(Fusion) {
  return {{Fusion::Weighted, "weighted"}, {Fusion::Winner, "winner"}};
}

Schema<EpiLParameters> epi_l_schema() {
  return orientation_schema()
      .part(&EpiLParameters::profile, profile_schema())
      .begin_with(kProfileKey)
      .search("inner_scale", {0.3, 0.5, 0.8, 1.1})
      .search("outer_scale", {0.5, 1, 1.5, 2})
      .search("shear_step", {0.5, 1, 1.5})
      .preset(kProfileKey, kPaperProfile,
              {{"inner_scale", 0.8},
               {"outer_scale", 0.8},
               {"view_scale", 0.8},
               {"cross_scale", 0.0},
               {"shear_step", 0.0},
               {"contrast", 255.0},
               {"noise", 0.0},
               {"orientation", std::string("eigenvector")},
               {"fusion", std::string("winner")}})
      .preset_search(kProfileKey, kPaperProfile, "inner_scale", {0.4, 0.6, 0.8, 1, 1.2})
      .preset_search(kProfileKey, kPaperProfile, "outer_scale", {0.5, 0.8, 1, 1.3, 1.6, 2})
      .preset_search(kProfileKey, kPaperProfile, "view_scale", {0.8, 1.3});
}

TensorScales scales_of(const EpiLParameters& p) {
  return {p.inner_scale, p.outer_scale, p.view_scale, p.cross_scale, p.contrast, p.noise};
}

TensorSearch search_of(const EpiLParameters& p, Interval range) {
  const int half_steps = static_cast<int>(std::lround(2 * p.shear_step));
  TensorSearch search =
      half_steps > 0 ? cover_range(range, half_steps) : cover_range_sparsely(range);
  search.eigenvector = p.orientation == Orientation::Eigenvector;
  return search;
}

}  // namespace episcope
