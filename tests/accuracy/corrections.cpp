// SPDX-License-Identifier: BSD-3-Clause
#include "tests/accuracy/corrections.h"

#include "engine/io/base/npy.h"
#include "engine/labeling/pixel_features.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace episcope::accuracy {
namespace {

std::set<std::int32_t> painted_in(const Image<std::int32_t>& strokes) {
  std::set<std::int32_t> labels(strokes.begin(), strokes.end());
  labels.erase(0);
  return labels;
}

double right_share(ImageView<const std::int32_t> labels, ImageView<const std::int32_t> truth) {
  std::size_t right = 0, all = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth.data[i] <= 0) continue;
    ++all;
    if (labels.data[i] == truth.data[i]) ++right;
  }
  return all == 0 ? 1 : static_cast<double>(right) / static_cast<double>(all);
}

constexpr double kLeastTolerance = 0.02;
constexpr int kDoublings = 6;

// Paints what the wand selects; false, and nothing, if it never shows what is wanted.
bool wave(const RaySuperpixels& wand, ViewIndex view, ImageView<const std::int32_t> labels,
          ImageView<const std::int32_t> truth, ImageView<std::int32_t> strokes) {
  const auto at = middle_of_wrong(labels, truth);
  if (!at) return false;
  const ImageView<const std::uint16_t> ids = wand.ids().view(view);
  const std::int32_t label = truth.at(at->y, at->x);
  std::vector<std::uint8_t> best;
  int most = 0;
  for (int i = 0; i <= kDoublings; ++i) {
    const auto selected =
        wand.alike(ids.at(at->y, at->x), static_cast<float>(std::ldexp(kLeastTolerance, i)));
    int all = 0, wrong = 0, wanted = 0, found = 0;
    for (std::size_t p = 0; p < truth.size(); ++p) {
      const bool is_selected = strokes.data[p] == 0 && selected[ids.data[p]] != 0;
      const bool is_wanted = truth.data[p] == label && labels.data[p] != label;
      wanted += is_wanted;
      found += is_wanted && is_selected;
      all += is_selected && truth.data[p] > 0;
      wrong += is_selected && truth.data[p] > 0 && truth.data[p] != label;
    }
    if (found <= most || found < wanted / 2 || wrong > kWrongSelected * all) continue;
    most = found;
    best = selected;
  }
  if (best.empty()) return false;
  for (std::size_t p = 0; p < truth.size(); ++p) {
    if (strokes.data[p] == 0 && best[ids.data[p]] != 0) strokes.data[p] = label;
  }
  return true;
}

}  // namespace

CorrectionCounts count_corrections(const PaintedScene& painted, const LabelerParameters& parameters,
                                   const LabelingDisparity& disparity, const RaySuperpixels* wand) {
  const LightFieldPtr& lf = painted.scene.light_field;
  const ViewIndex center = lf->center();
  const ImageView<const std::int32_t> truth = painted.truth.view(center);
  Labeler labeler(lf, disparity.field, nullptr, disparity.confidence());
  Scribbles strokes;
  strokes.views.push_back({center, Image<std::int32_t>(lf->height(), lf->width())});
  Image<std::int32_t>& painted_pixels = strokes.views[0].labels;
  ViewStack<std::int32_t> labels({1, 1}, lf->height(), lf->width(), 1, center);
  CorrectionCounts counts;
  for (int stroke = 1; stroke <= kMostCorrections && !counts.back(); ++stroke) {
    const bool is_selected =
        wand && wave(*wand, center, labels.view(center), truth, painted_pixels.view());
    if (!is_selected && !add_correction(labels.view(center), truth, painted_pixels.view())) break;
    if (const auto only = painted_in(painted_pixels); only.size() == 1) {
      std::fill_n(labels.data(), labels.size(), *only.begin());
      continue;
    }
    labels = labeler.label(strokes, parameters, {center, {1, 1}}, Progress()).labels;
    const double share = right_share(labels.view(center), truth);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (!counts[i] && share >= kWantedShares[i]) counts[i] = stroke;
    }
  }
  return counts;
}

CorrectionCounts least_corrections(ImageView<const std::int32_t> truth) {
  std::map<std::int32_t, std::size_t> of_label;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth.data[i] > 0) ++of_label[truth.data[i]];
  }
  std::vector<std::size_t> areas;
  for (const auto& [label, area] : of_label) areas.push_back(area);
  std::ranges::sort(areas, std::greater<>());
  const auto all = static_cast<double>(std::accumulate(areas.begin(), areas.end(), std::size_t{0}));
  CorrectionCounts counts;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    double right = 0;
    int strokes = 0;
    for (const std::size_t area : areas) {
      if (right >= kWantedShares[i] * all) break;
      right += static_cast<double>(area);
      ++strokes;
    }
    counts[i] = strokes;
  }
  return counts;
}

std::optional<int> median_count(std::vector<std::optional<int>> counts) {
  if (counts.empty()) return std::nullopt;
  const auto middle = counts.begin() + static_cast<std::ptrdiff_t>((counts.size() - 1) / 2);
  std::ranges::nth_element(counts, middle, {}, [](const std::optional<int>& count) {
    return count.value_or(std::numeric_limits<int>::max());
  });
  return *middle;
}

void export_features(const PaintedScene& painted, const std::filesystem::path& folder) {
  const LightField& lf = *painted.scene.light_field;
  const ViewIndex center = lf.center();
  const PixelFeatures features = compute_pixel_features(lf, center, {}, {}, Progress());
  std::vector<float> planes;
  for (int f = 0; f < features.layers(); ++f) {
    for (int y = 0; y < lf.height(); ++y) {
      const float* row = features.view().row(y, f);
      planes.insert(planes.end(), row, row + lf.width());
    }
  }
  const std::filesystem::path own = folder / file_stem(painted.name);
  std::filesystem::create_directories(own);
  const auto size = [](int count) { return static_cast<std::size_t>(count); };
  io::write_npy<float>(own / "features.npy",
                       {size(features.layers()), size(lf.height()), size(lf.width())}, planes);
  const ImageView<const std::int32_t> truth = painted.truth.view(center);
  io::write_npy<std::int32_t>(own / "truth.npy", {size(truth.height), size(truth.width)},
                              {truth.data, truth.size()});
}

}  // namespace episcope::accuracy
