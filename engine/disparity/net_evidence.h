// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/cuda/net_task.h"
#include "engine/disparity/kernels/net_kernel.h"
#include "engine/disparity/kernels/shared_constants.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace episcope {

/// Most views that are looked at of a sector.
inline constexpr int kNetSectorViews = 12;

/// Where cameras stand, view by view in canonical order (view_places); null = on the regular grid.
using NetPlaces = std::shared_ptr<const std::vector<ViewPlace>>;

/// The views of each sector around a reference, at most kNetSectorViews of each, spread over the
/// distance. Sector k is in the direction of 45 k degrees of the grid, from u to v. Views without a
/// valid pixel are left out.
[[nodiscard]] std::array<std::vector<cuda::NetNeighbor>, kNetSectors> net_sectors(
    const LightField& light_field, ViewIndex reference, const NetPlaces& places);

/// What `net` is told of the reference view: R, G, B − 0.4, 4 (grey(x + 1) − grey(x − 1)), likewise
/// along y, samples in [0, 1], the border repeated. The pixel itself stands for an invalid
/// neighbor; invalid pixels are as stored.
[[nodiscard]] Image<float> net_guide(const LightField& light_field, ViewIndex reference);

/// What evidence is asked for: disparities that all pixels share, or maps.
enum class NetEvidenceOf { Planes, Maps };

/// How unlike the views are at disparities: E(d) of `net` (resources/training/README.md). A view
/// does not count where its sample lies outside the image or an invalid pixel enters it. Holds the
/// rows that a sweep down the image needs, 20 bytes a pixel and view, 32 for maps. The light field
/// must live longer.
class NetEvidence {
 public:
  /// For disparities within `disparities`; cameras stand at `places`.
  NetEvidence(const LightField& light_field, ViewIndex reference, Interval disparities,
              NetEvidenceOf kind, const NetPlaces& places = nullptr);

  /// Reads what rows [first, end) need, and drops what rows before do. Later calls go on from
  /// there. Throws Cancelled.
  void hold(int first, int end, const Progress& progress);

  /// Evidence of a held row: kNetEvidence numbers a pixel. Up to kNetAtOnce disparities, all with
  /// maps or all without, as promised. Thread-safe.
  void compute(int y, std::span<const NetDisparity> disparities) const;

  [[nodiscard]] int height() const { return light_field_.height(); }
  [[nodiscard]] int width() const { return light_field_.width(); }

 private:
  // Numbers of a pixel, on a boundary that loads do not cross.
  struct alignas(4 * kNetPixel) Pixel {
    Pixel() {}  // Leaves them unset.
    std::array<float, kNetPixel> values;
  };
  // Some rows of a view.
  struct Window {
    cuda::NetNeighbor neighbor;
    int first = 0;
    int end = 0;
    std::vector<Pixel> pixels;

    [[nodiscard]] float* data() { return pixels.front().values.data(); }
  };

  void move_window(Window& window, int first, int end) const;
  void read_rows(Window& window, int first) const;
  [[nodiscard]] long row_pixels() const;

  const LightField& light_field_;
  ViewIndex reference_;
  Interval disparities_;
  NetEvidenceOf kind_;
  std::array<int, kNetSectors + 1> sector_begin_{};
  std::vector<Window> windows_;  // Of the reference, then of the views sector by sector.
  std::vector<NetView> views_;
};

}  // namespace episcope
