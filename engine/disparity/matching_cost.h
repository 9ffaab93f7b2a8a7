// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/schema.h"
#include "engine/core/view_stack.h"
#include "engine/disparity/kernels/shared_constants.h"

#include <array>
#include <limits>
#include <memory>
#include <numeric>
#include <vector>

namespace episcope {

/// Views that are compared with the reference view: all (ST_AV), or the views of its row and column
/// of the camera grid, the cross-hair (ST_CH).
enum class MatchedViews { All, CrossHair };

/// How views are sampled between pixels. Cubic (Catmull-Rom) blurs less than bilinear, which makes
/// labels that move a view by whole pixels look better than their neighbors.
enum class Interpolation { Bilinear, Cubic };
[[nodiscard]] Names<Interpolation> names_of(Interpolation);

/// Known surfaces that stand before the points of a view.
struct Occluders {
  /// The nearest surface in every view, px of disparity; −∞ where none is known.
  ViewStack<float> nearest;
  /// A sample counts in full while the surface is nearer by at most `tolerance`, and not at all
  /// from `tolerance + softness` on, px of disparity.
  float tolerance = 0.1F;
  float softness = 0.05F;
};

/// What a matching cost is made of.
struct MatchingCost {
  MatchedViews views = MatchedViews::All;
  Interpolation interpolation = Interpolation::Cubic;
  /// ε: no single view costs more; infinity = uncapped.
  double cap = std::numeric_limits<double>::infinity();
  /// Variance of the noise of one sample at each pixel of the reference view, `[y][x]`; null =
  /// none.
  std::shared_ptr<const Image<float>> noise = nullptr;
  /// Where the views stand, one after the other; null = on the regular grid.
  std::shared_ptr<const std::vector<ViewPlace>> places = nullptr;
  /// ε at each pixel of the reference view, `[y][x]`, instead of `cap`; null = the same everywhere.
  std::shared_ptr<const Image<float>> caps = nullptr;
  /// Null = every sample counts.
  std::shared_ptr<const Occluders> occluders = nullptr;
};

/// Throws InvalidInput if the view is not in the grid or there is no other view to compare it with.
void check_matching(const LightField& light_field, ViewIndex reference);

/// Computes matching costs for some rows of a reference view, for callers that do not hold the
/// whole volume. Not thread-safe: use one object per thread.
class MatchingCostRows {
 public:
  /// Throws InvalidInput as `check_matching`, or if there is no label or the cap is not positive.
  MatchingCostRows(const LightField& light_field, ViewIndex reference, const MatchingCost& cost,
                   const std::vector<float>& labels);
  ~MatchingCostRows();
  MatchingCostRows(MatchingCostRows&&) noexcept;

  /// Costs of rows [y, y + costs.height) into `costs` (layers = labels, width of a view).
  /// Throws Cancelled on a stop request (checked every few milliseconds).
  void compute(int y, VolumeView<float> costs, const Progress& progress);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Matching costs of every pixel of view `reference` and every label, `[y][label][x]`:
/// ρ(x, d) = 1/n Σ min(ε, |I_n(x + d v_n) − I_c(x)|) over the n views whose sample lies within the
/// image, samples in [0, 1], Euclidean norm over the channels, v_n the way from the reference to
/// view n (canonical u and v axes: a point moves by −d per step), that of `cost.places` if given.
/// Labels are disparities, px per view step. Where no view sees the point at a label, the cost is
/// the largest possible. Samples that an invalid pixel (LightField::valid) enters count as outside
/// the image; an invalid pixel of the reference costs the largest possible at every label. With
/// `cost.noise` σ², |…| is √(|…|² + c σ² (1 − Σw²)) for c channels and weights w of the
/// interpolation: what noise it averages away is put back. Otherwise, where noise outweighs
/// texture, labels that move views by whole pixels cost more than those between (Σw² = 0.41 at half
/// a pixel on both axes), whatever the truth is.
/// Memory: height · width · labels · 4 bytes. Throws InvalidInput as MatchingCostRows, Cancelled.
///
/// The paper's equations leave open what happens to samples outside the image. They are skipped and
/// the remaining ones renormalized; repeating the border would pull estimates towards it. Division
/// by n keeps later weights independent of the number of views.
/// Reference: the paper, equations (3) and (4).
[[nodiscard]] Volume<float> matching_costs(const LightField& light_field, ViewIndex reference,
                                           const MatchingCost& cost,
                                           const std::vector<float>& labels,
                                           const Progress& progress);

/// `count` equidistant disparities from one end of the range to the other; 1 = the middle.
[[nodiscard]] std::vector<float> equidistant_labels(Interval range, int count);

/// The longest interpolation, in taps.
inline constexpr int kMaxShiftTaps = 4;

/// How one axis of a view is sampled at one label.
struct AxisShift {
  int origin = 0;   ///< Pixels from the reference pixel to the first tap,
  int nearest = 0;  ///< and to the pixel next to the sample, one of the taps.
  int taps = 1;
  std::array<float, kMaxShiftTaps> weights{1};
  /// Share of the variance of noise that the weights leave.
  [[nodiscard]] double noise_left() const {
    return std::inner_product(weights.begin(), weights.end(), weights.begin(), 0.0);
  }
  int first = 0, last = 0;  ///< Reference pixels whose sample lies within the image.
};

/// The ways along one axis from a reference, in steps: to every row (or column) of a regular grid,
[[nodiscard]] std::vector<double> regular_ways(int places, int reference);
/// and to every view, which stand at `places`.
[[nodiscard]] std::vector<double> stated_ways(const std::vector<ViewPlace>& places,
                                              std::size_t reference, double ViewPlace::*axis);

/// Shifts of one axis of `extent` pixels for every way along it and every label, `[way][label]`.
[[nodiscard]] std::vector<AxisShift> make_shifts(const std::vector<double>& ways, int extent,
                                                 Interpolation interpolation,
                                                 const std::vector<float>& labels);

/// For each label and reference pixel of one axis: in how many places it is seen, `[label][pixel]`.
[[nodiscard]] std::vector<float> count_seen(const std::vector<AxisShift>& shifts, int labels,
                                            int extent);

/// What the surface that is seen from one view covers in every view of the grid: the disparity of
/// the nearest of its points at each pixel, `[v][u][y][x]`; `kNothingNear` where none falls. The
/// point of pixel (x, y) falls to x − d·(u − u_ref), y − d·(v − v_ref), and covers what pixels its
/// square of 1 px overlaps by more than a quarter along both axes, so that a surface that the
/// other view sees slightly larger has no holes. Pixels of disparity
/// `kNothingNear` show no surface. Throws Cancelled.
[[nodiscard]] ViewStack<float> surfaces_in_views(ImageView<const float> disparity,
                                                 ViewIndex reference, GridShape grid,
                                                 const Progress& progress);

}  // namespace episcope
