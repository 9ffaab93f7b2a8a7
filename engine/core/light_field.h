// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/camera_grid.h"
#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/parameter.h"
#include "engine/core/view_stack.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace episcope {

enum class SampleType { UInt8, UInt16, Float32 };

/// One step of a stored sample type in [0, 1]: 1/255, 1/65535; 1 for float.
template <class T>
inline constexpr float kSampleStep = std::is_integral_v<T>
                                         ? 1.0F / static_cast<float>(std::numeric_limits<T>::max())
                                         : 1.0F;

/// Position of a camera on the plane of cameras, in `LightFieldInfo::position_unit`.
struct CameraPosition {
  double x = 0;
  double y = 0;
  friend bool operator==(const CameraPosition&, const CameraPosition&) = default;
};

/// Facts about a light field besides its samples.
struct LightFieldInfo {
  std::string name;    ///< Short name for lists and titles, e.g. "still_life".
  std::string source;  ///< Path it was read from, or "demo:<scene>"; what a command line can open.
  CameraGrid camera;
  /// Disparity range that the files promise (`disp_min`/`disp_max` of a cfg); never from truth.
  std::optional<Interval> disparity_range;
  Reading reading{};  ///< How it was read from `source`.
  /// As stored in names or files of the camera, view by view in canonical order; empty = unknown.
  std::vector<CameraPosition> positions{};
  std::string position_unit{};  ///< "mm"; empty = unknown.
};

/// A sample in [0, 1] as uint16 of 65535, rounded to the nearest; others are clamped.
[[nodiscard]] inline std::uint16_t to_word_sample(float sample) {
  return static_cast<std::uint16_t>(std::clamp(sample, 0.0F, 1.0F) * 65535 + 0.5F);
}

/// A 4D light field: equally sized views on a regular camera grid, `[v][u][y][x][c]`, immutable.
/// Samples stay in the type they were stored in; a view is borrowed, never copied. `c` is 1 (grey)
/// or 3 (RGB). A scene point at (x, y) in the center view appears in view (u, v) at
/// (x − d·(u − u_c), y − d·(v − v_c)): see CameraGrid for d.
class LightField {
 public:
  using Samples = std::variant<ViewStack<std::uint8_t>, ViewStack<std::uint16_t>, ViewStack<float>>;

  /// `valid`: 0 where a pixel holds nothing that was seen (vignetting, weight 0), of the shape of
  /// the views; empty = all valid. Throws InvalidInput if the stack is empty, has other than 1 or 3
  /// channels or does not begin at view (0, 0), or if `valid` does not fit.
  LightField(Samples samples, LightFieldInfo info, ViewStack<std::uint8_t> valid = {});

  /// Takes the samples of `other` and gives them other facts.
  LightField(LightField&& other, LightFieldInfo info);

  [[nodiscard]] const LightFieldInfo& info() const { return info_; }
  [[nodiscard]] GridShape grid() const { return grid_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int channels() const { return channels_; }
  [[nodiscard]] SampleType sample_type() const;
  [[nodiscard]] ViewIndex center() const { return grid_.center(); }
  [[nodiscard]] std::size_t byte_size() const;

  /// The samples of a view in their stored type: exactly one of the views is not empty.
  template <class T>
  [[nodiscard]] ImageView<const T> view(ViewIndex index) const {
    return std::get<ViewStack<T>>(samples_).view(index);
  }

  /// Samples of row `y` of a view, columns [x0, x1), as float in [0, 1] (uint8/255, uint16/65535,
  /// float unchanged), channels interleaved, into `out` of (x1 − x0)·channels elements.
  void read_row(ViewIndex index, int y, int x0, int x1, float* out) const;

  /// Column `x`, rows [y0, y1), likewise: (y1 − y0)·channels elements.
  void read_column(ViewIndex index, int x, int y0, int y1, float* out) const;

  /// A whole view as float, as `read_row`.
  [[nodiscard]] Image<float> view_as_float(ViewIndex index) const;

  /// 64-bit FNV-1a hash of shape and samples, which identifies the light field in result files.
  /// Linear in the size. Samples on disk are dropped from memory once they were read.
  [[nodiscard]] std::uint64_t sample_hash() const;

  [[nodiscard]] const Samples& samples() const { return samples_; }

  /// Number of this light field, unique in the program and kept when it is moved. Copies of the
  /// samples on a device use it to tell whether they are still valid.
  [[nodiscard]] std::uint64_t identity() const { return identity_; }
  /// Whether samples are in a file that the system reads when they are looked at.
  [[nodiscard]] bool is_on_disk() const;
  /// Starts reading rows [first_row, end_row) of a view from disk, without waiting. Call it for all
  /// places of interest before looking at the first.
  void fetch_samples(ViewIndex index, int first_row, int end_row) const;
  /// Starts reading these rows of all views.
  void fetch_samples(int first_row, int end_row) const {
    for (int i = 0; is_on_disk() && i < grid_.count(); ++i) {
      fetch_samples(grid_.view_at(i), first_row, end_row);
    }
  }
  /// Drops samples that lie on disk from memory; they are read again on access. Long computations
  /// call it now and then to bound their memory.
  void forget_samples() const;

  /// `[v][u][y][x]`, 0 = invalid; empty if all pixels are valid.
  [[nodiscard]] const ViewStack<std::uint8_t>& valid() const { return valid_; }
  [[nodiscard]] bool is_valid(ViewIndex index, int y, int x) const {
    return valid_.empty() || valid_.view(index).at(y, x) != 0;
  }
  /// The mask of one view; empty if all pixels of all views are valid.
  [[nodiscard]] ImageView<const std::uint8_t> valid_of(ViewIndex index) const {
    return valid_.empty() ? ImageView<const std::uint8_t>{} : valid_.view(index);
  }

 private:
  Samples samples_;
  ViewStack<std::uint8_t> valid_;
  LightFieldInfo info_;
  GridShape grid_;
  int height_ = 0;
  int width_ = 0;
  int channels_ = 1;
  std::uint64_t identity_ = 0;
};

/// The grid that views cover.
[[nodiscard]] inline GridShape grid_of(const LightField::Samples& samples) {
  return std::visit([](const auto& stack) { return stack.grid(); }, samples);
}

using LightFieldPtr = std::shared_ptr<const LightField>;

/// |∇I| of one view, `[y][x]` ≥ 0 per px: the norm of the forward differences over all channels,
/// samples in [0, 1]; nothing beyond the last row and column. `out` has the size of a view.
void gradient_magnitude(const LightField& light_field, ViewIndex view, ImageView<float> out);

/// Epipolar plane images (EPIs), gathered as float in [0, 1], with rows along the view axis.
///
/// On an EPI a scene point is a line whose slope dx/du (dy/dv) is −d in canonical axes: views to
/// the right see it further left. `focus_px` shears the EPI about the row of `view`: a point of
/// disparity `focus_px` stands upright. Sheared samples are interpolated linearly, clamped at the
/// border. Source: Bolles, Baker, Marimont 1987 [BBM87]; refocusing by Ng 2006 [Ng06].

/// Direction of an EPI: along the row or the column of views through the current view.
enum class EpiDirection { Horizontal, Vertical };

/// `[u][x][c]` of image row `y` through the views of camera row `view.v`.
/// Throws InvalidInput if view or row lies outside.
[[nodiscard]] Image<float> horizontal_epi(const LightField& light_field, ViewIndex view, int y,
                                          double focus_px = 0);

/// `[v][y][c]` of image column `x` through the views of camera column `view.u`.
/// Throws InvalidInput if view or column lies outside.
[[nodiscard]] Image<float> vertical_epi(const LightField& light_field, ViewIndex view, int x,
                                        double focus_px = 0);

/// Position of a view on the plane of cameras, in mean steps of the grid, along v and u.
struct ViewPlace {
  double v = 0;
  double u = 0;
};

/// Relation of the stated positions of cameras to a grid.
enum class PlacesKind {
  Unknown,      ///< There are none.
  Regular,      ///< Equidistant to within 0.02 steps.
  Irregular,    ///< Near a grid, but not on it: `places` holds them.
  Implausible,  ///< They make no grid in the order of the views.
};

/// Views of a grid at their stated positions.
struct ViewPlaces {
  PlacesKind kind = PlacesKind::Unknown;
  std::vector<ViewPlace> places;  ///< View by view in canonical order; empty unless irregular.
  double largest_deviation = 0;   ///< From the regular grid about the center view, in steps.
  int outliers = 0;               ///< Positions not believed and replaced by the place in the grid.
  /// Distance of rows in distances of columns; 1 if there are no two of either.
  double row_step = 1;
};

/// Turns stated positions into places. The step is the mean distance of neighbors along u (least
/// squares), or along v of a single column. Both directions share it, as disparity is px per step:
/// rows twice as far apart as columns lie two steps apart. The direction and the unit of positions
/// do not matter. A position farther than half a step from the plane through all of them is an
/// outlier. Positions are implausible if fewer than nine tenths fit, if steps are zero or not
/// finite, if the grid is skewed by more than a third, or if the ratio of the steps is beyond 2.
[[nodiscard]] ViewPlaces view_places(const LightFieldInfo& info, GridShape grid);

}  // namespace episcope
