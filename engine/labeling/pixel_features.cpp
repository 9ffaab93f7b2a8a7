// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/pixel_features.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/labeling/feature_kernel.h"
#include "engine/labeling/forest_kernel.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <vector>

namespace episcope {
namespace {

// Jumps of disparity that are none, and how soon larger ones count in full.
constexpr float kNoEdgeJump_px = 0.02F;
constexpr float kJumpSharpness = 10;
constexpr int kNearJump_px = 2;

// Length of the disparity's forward differences, 0 where one of the pixels is invalid.
float disparity_jump(const DisparityView& map, int y, int x) {
  const int right = std::min(x + 1, map.disparity.width - 1);
  const int below = std::min(y + 1, map.disparity.height - 1);
  if (!map.is_valid(y, x) || !map.is_valid(y, right) || !map.is_valid(below, x)) return 0;
  const float d = map.disparity.at(y, x);
  return std::hypot(map.disparity.at(y, right) - d, map.disparity.at(below, x) - d);
}

// The largest value within kNearJump_px in every direction.
Image<float> widened(const Image<float>& map) {
  const int height = map.height(), width = map.width();
  Image<float> across(height, width);
  Image<float> out(height, width);
  for (int y = 0; y < height; ++y) {
    const float* in = map.row(y);
    for (int x = 0; x < width; ++x) {
      const int end = std::min(x + kNearJump_px + 1, width);
      across.at(y, x) = *std::max_element(in + std::max(x - kNearJump_px, 0), in + end);
    }
  }
  for (int y = 0; y < height; ++y) {
    float* to = out.row(y);
    for (int i = std::max(y - kNearJump_px, 0); i < std::min(y + kNearJump_px + 1, height); ++i) {
      const float* from = across.row(i);
      std::transform(from, from + width, to, to, [](float a, float b) { return std::max(a, b); });
    }
  }
  return out;
}

// What image edges count at each pixel; `trust` in disparity may be empty.
Image<float> edge_trust(const Image<float>& jumps, const Image<float>& trust, float texture) {
  Image<float> gaps(jumps.height(), jumps.width());
  std::transform(jumps.begin(), jumps.end(), gaps.begin(), [](float jump) {
    return 1 - std::exp(-kJumpSharpness * std::max(jump - kNoEdgeJump_px, 0.F));
  });
  Image<float> count = widened(gaps);
  for (float& c : count) c = texture + (1 - texture) * c;
  if (!trust.empty()) {
    std::transform(count.begin(), count.end(), trust.begin(), count.begin(),
                   [](float c, float t) { return std::lerp(1.0F, c, t); });
  }
  return count;
}

Image<float> disparity_jumps(const DisparityView& map) {
  Image<float> jumps(map.disparity.height, map.disparity.width);
  for (int y = 0; y < jumps.height(); ++y) {
    for (int x = 0; x < jumps.width(); ++x) jumps.at(y, x) = disparity_jump(map, y, x);
  }
  return jumps;
}

void fill_view(const LightField& lf, ViewIndex view, const DisparityField& disparity,
               const EdgeParameters& parameters, const ViewStack<float>* confidence,
               ImageView<float> out) {
  gradient_magnitude(lf, view, out);
  const auto beta = static_cast<float>(parameters.image);
  const auto gamma = static_cast<float>(parameters.disparity);
  if (!disparity.contains(view)) {
    for (int y = 0; y < out.height; ++y) {
      float* const row = out.row(y);
      std::transform(row, row + out.width, row,
                     [=](float edge) { return 1 - std::exp(-beta * edge); });
    }
    return;
  }
  Image<float> jumps = disparity_jumps(disparity.view(view));
  Image<float> trust;
  if (confidence != nullptr && confidence->contains(view)) {
    trust = disparity_trust(confidence->view(view));
    std::transform(jumps.begin(), jumps.end(), trust.begin(), jumps.begin(), std::multiplies<>());
  }
  const Image<float> count = edge_trust(jumps, trust, static_cast<float>(parameters.texture));
  for (int y = 0; y < out.height; ++y) {
    float* const row = out.row(y);
    const float *const jump = jumps.row(y), *const m = count.row(y);
    for (int x = 0; x < out.width; ++x) {
      row[x] = 1 - std::exp(-beta * m[x] * row[x] - gamma * jump[x]);
    }
  }
}

void check_sizes(const LightField& lf, const DisparityField& disparity) {
  if (disparity.empty() ||
      (disparity.disparity.height() == lf.height() && disparity.disparity.width() == lf.width())) {
    return;
  }
  throw InvalidInput("edges need disparities of the size of the light field");
}

constexpr float kSureTrust = 0.43F;
constexpr double kScale_px = 2;

// What a tenth of the pixels exceed.
float surest_tenth(ImageView<const float> confidence) {
  std::vector<float> sorted(confidence.data, confidence.data + confidence.size());
  const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 9 / 10);
  std::ranges::nth_element(sorted, at);
  return *at;
}

constexpr double kFineScale = 1;
/// Differences of Lab/100 that the filters that keep edges take for the same surface.
constexpr double kSurfaceContrast = 0.06;
constexpr double kWiderSurfaceContrast = 0.15;
constexpr double kSurfaceScale = 6;
constexpr int kSurfaceRadius_px = 6;
constexpr int kSurfacePasses = 2;
constexpr double kDisparityScale = 2;

// First layers of the groups, in the order of `pixel_feature_names`.
constexpr int kSurfaceLayer = 9;
constexpr int kShapeLayer = 15;

cv::Mat smoothed(const cv::Mat& plane, double sigma) {
  cv::Mat out;
  cv::GaussianBlur(plane, out, {}, sigma, sigma, cv::BORDER_REPLICATE);
  return out;
}

/// Shares the samples, which nobody writes to.
cv::Mat wrapped(const Image<float>& plane) {
  return {plane.height(), plane.width(), CV_32F, const_cast<float*>(plane.data())};
}

cv::Mat derivative(const cv::Mat& plane, int dx, int dy) {
  cv::Mat out;
  // The kernels of Sobel weigh 8 for a first and 4 for a second derivative, the mixed one 4.
  cv::Sobel(plane, out, CV_32F, dx, dy, 3, dx + dy == 1 ? 1.0 / 8 : 1.0 / 4, 0,
            cv::BORDER_REPLICATE);
  return out;
}

cv::Mat magnitude(const cv::Mat& dx, const cv::Mat& dy) {
  cv::Mat out;
  cv::magnitude(dx, dy, out);
  return out;
}

/// Fills layers of a volume one after the other, from `first` on.
class LayerWriter {
 public:
  LayerWriter(VolumeView<float> features, int first) : features_(features), layer_(first) {}

  void add(const cv::Mat& plane, float unit = 1) {
    for (int y = 0; y < features_.height; ++y) {
      const auto* in = plane.ptr<float>(y);
      std::transform(in, in + features_.width, features_.row(y, layer_),
                     [unit](float value) { return value * unit; });
    }
    ++layer_;
  }

  void add(const std::vector<cv::Mat>& planes) {
    for (const cv::Mat& plane : planes) add(plane);
  }

  /// The larger and the smaller eigenvalue of [a b; b c] in each pixel.
  void add_eigenvalues(const cv::Mat& a, const cv::Mat& b, const cv::Mat& c) {
    for (int y = 0; y < features_.height; ++y) {
      const auto *pa = a.ptr<float>(y), *pb = b.ptr<float>(y), *pc = c.ptr<float>(y);
      float* larger = features_.row(y, layer_);
      float* smaller = features_.row(y, layer_ + 1);
      for (int x = 0; x < features_.width; ++x) {
        const float mean = 0.5F * (pa[x] + pc[x]);
        const float half = 0.5F * (pa[x] - pc[x]);
        const float spread = std::sqrt(half * half + pb[x] * pb[x]);
        larger[x] = mean + spread;
        smaller[x] = mean - spread;
      }
    }
    layer_ += 2;
  }

 private:
  VolumeView<float> features_;
  int layer_;
};

// Repeats samples of one channel three times; returns three channels unchanged.
cv::Mat rgb_colors(const cv::Mat& samples) {
  if (samples.channels() == 3) return samples;
  cv::Mat rgb;
  cv::cvtColor(samples, rgb, cv::COLOR_GRAY2RGB);
  return rgb;
}

cv::Mat color_image(const LightField& lf, ViewIndex view) {
  Image<float> samples = lf.view_as_float(view);
  const cv::Mat wrapped(lf.height(), lf.width(), CV_32FC(lf.channels()), samples.data());
  return lf.channels() == 3 ? wrapped.clone() : rgb_colors(wrapped);
}

void add_color(LayerWriter& layers, const cv::Mat& rgb, const std::vector<cv::Mat>& lab) {
  std::vector<cv::Mat> channels;
  cv::split(rgb, channels);
  layers.add(channels);
  layers.add(lab);
  for (const cv::Mat& channel : lab) layers.add(smoothed(channel, kFineScale));
}

/// Colors averaged within a surface and not across its outline.
void add_surface(LayerWriter layers, const std::vector<cv::Mat>& lab, double contrast,
                 const Progress& progress) {
  ColorPlanes flat;
  for (std::size_t c = 0; c < flat.size(); ++c) {
    flat[c] = Image<float>(lab[c].rows, lab[c].cols);
    std::copy_n(lab[c].ptr<float>(), flat[c].size(), flat[c].data());
  }
  for (int pass = 0; pass < kSurfacePasses; ++pass) {
    flat = filter_surfaces(flat, {contrast, kSurfaceScale, kSurfaceRadius_px}, progress);
  }
  for (const Image<float>& plane : flat) layers.add(wrapped(plane));
}

void add_shape(LayerWriter& layers, const cv::Mat& lightness) {
  const cv::Mat smooth = smoothed(lightness, kFineScale);
  const cv::Mat dx = derivative(smooth, 1, 0);
  const cv::Mat dy = derivative(smooth, 0, 1);
  const cv::Mat dxx = derivative(smooth, 2, 0);
  const cv::Mat dyy = derivative(smooth, 0, 2);
  layers.add(magnitude(dx, dy));
  layers.add(dxx + dyy);
  layers.add_eigenvalues(dxx, derivative(smooth, 1, 1), dyy);
  layers.add_eigenvalues(smoothed(dx.mul(dx), 2 * kFineScale), smoothed(dx.mul(dy), 2 * kFineScale),
                         smoothed(dy.mul(dy), 2 * kFineScale));
}

void add_place(LayerWriter& layers, const cv::Mat& disparity, ViewIndex step) {
  const float unit = 1.0F / static_cast<float>(std::max(disparity.rows, disparity.cols));
  cv::Mat column(disparity.size(), CV_32F);
  cv::Mat row(disparity.size(), CV_32F);
  for (int y = 0; y < disparity.rows; ++y) {
    const auto* d = disparity.ptr<float>(y);
    for (int x = 0; x < disparity.cols; ++x) {
      column.at<float>(y, x) = static_cast<float>(x) + d[x] * static_cast<float>(step.u);
      row.at<float>(y, x) = static_cast<float>(y) + d[x] * static_cast<float>(step.v);
    }
  }
  layers.add(column, unit);
  layers.add(row, unit);
}

void add_disparity(LayerWriter& layers, const cv::Mat& disparity) {
  const cv::Mat smooth = smoothed(disparity, kDisparityScale);
  const DisparitySlopes slopes = disparity_slopes(
      {smooth.ptr<float>(), smooth.rows, smooth.cols, 1, static_cast<long>(smooth.step1())});
  layers.add(smoothed(wrapped(slopes.x), kFineScale));
  layers.add(smoothed(wrapped(slopes.y), kFineScale));
}

constexpr int kDistances_px[] = {3, 6};
constexpr float kUnknown = std::numeric_limits<float>::max();

/// Replaces slopes by those between `from` and `to` that are less inclined.
void take_less(const float* from, const float* to, float scale, int count, float* slope) {
  for (int i = 0; i < count; ++i) {
    const float other = scale * (to[i] - from[i]);
    slope[i] = std::abs(other) < std::abs(slope[i]) ? other : slope[i];
  }
}

void end_row(int width, float* slope) {
  std::replace(slope, slope + width, kUnknown, 0.0F);
}

void slopes_along_row(const float* row, int width, float* slope) {
  std::fill_n(slope, width, kUnknown);
  for (const int distance : kDistances_px) {
    const float scale = 1.0F / static_cast<float>(distance);
    const int count = width - distance;
    if (count <= 0) continue;
    take_less(row, row + distance, scale, count, slope);
    take_less(row, row + distance, scale, count, slope + distance);
  }
  end_row(width, slope);
}

void slopes_down(ImageView<const float> map, int y, float* slope) {
  std::fill_n(slope, map.width, kUnknown);
  for (const int distance : kDistances_px) {
    const float scale = 1.0F / static_cast<float>(distance);
    if (y + distance < map.height) {
      take_less(map.row(y), map.row(y + distance), scale, map.width, slope);
    }
    if (y >= distance) take_less(map.row(y - distance), map.row(y), scale, map.width, slope);
  }
  end_row(map.width, slope);
}

// A plane with as many pixels around it as the filter looks at, equal to those at the border.
class Padded {
 public:
  Padded(const Image<float>& plane, int margin)
      : margin_(margin),
        pitch_(plane.width() + 2 * margin + kVectorLanes),
        values_(static_cast<std::size_t>(pitch_) * (plane.height() + 2 * margin) + kVectorLanes) {
    for (int y = -margin; y < plane.height() + margin; ++y) {
      const float* const from = plane.row(std::clamp(y, 0, plane.height() - 1));
      float* const to = values_.data() + (y + margin) * pitch_;
      std::fill_n(to, margin, from[0]);
      std::copy_n(from, plane.width(), to + margin);
      std::fill_n(to + margin + plane.width(), margin, from[plane.width() - 1]);
    }
  }
  [[nodiscard]] const float* row(int y) const {
    return values_.data() + (y + margin_) * pitch_ + margin_;
  }
  [[nodiscard]] long pitch() const { return pitch_; }

 private:
  int margin_;
  long pitch_;
  std::vector<float> values_;
};

struct SurfaceNeighbors {
  std::vector<long> offsets;
  std::vector<float> nearness;
};

SurfaceNeighbors neighbors_of(const SurfaceFilter& filter, long pitch) {
  SurfaceNeighbors all;
  const double share = std::numbers::log2e / (2 * filter.scale_px * filter.scale_px);
  for (int y = -filter.radius_px; y <= filter.radius_px; ++y) {
    for (int x = -filter.radius_px; x <= filter.radius_px; ++x) {
      const int square = x * x + y * y;
      if (square > filter.radius_px * filter.radius_px) continue;
      all.offsets.push_back(y * pitch + x);
      all.nearness.push_back(static_cast<float>(-square * share));
    }
  }
  return all;
}

}  // namespace

Image<float> edge_probability(const LightField& light_field, ViewIndex view,
                              const DisparityField& disparity, const EdgeParameters& parameters) {
  check_sizes(light_field, disparity);
  Image<float> edges(light_field.height(), light_field.width());
  fill_view(light_field, view, disparity, parameters, nullptr, edges.view());
  return edges;
}

ViewStack<float> edge_probabilities(const LightField& light_field, const DisparityField& disparity,
                                    const EdgeParameters& parameters, const Progress& progress) {
  return edge_probabilities(light_field, {{0, 0}, light_field.grid()}, disparity, parameters,
                            progress);
}

ViewStack<float> edge_probabilities(const LightField& light_field, ViewRectangle views,
                                    const DisparityField& disparity,
                                    const EdgeParameters& parameters, const Progress& progress,
                                    const ViewStack<float>* confidence) {
  check_sizes(light_field, disparity);
  ViewStack<float> edges(views.grid, light_field.height(), light_field.width(), 1, views.first);
  parallel_for(views.grid.count(), progress, [&](int i) {
    const ViewIndex view = views.grid.view_at(i, views.first);
    fill_view(light_field, view, disparity, parameters, confidence, edges.view(view));
  });
  return edges;
}

Image<float> disparity_trust(ImageView<const float> confidence) {
  Image<float> trust(confidence.height, confidence.width);
  // OpenCV has no constant matrices; this one is only read.
  const cv::Mat in(confidence.height, confidence.width, CV_32F,
                   const_cast<float*>(confidence.data));
  cv::Mat out(confidence.height, confidence.width, CV_32F, trust.data());
  cv::GaussianBlur(in, out, {}, kScale_px, kScale_px, cv::BORDER_REPLICATE);
  const float sure = kSureTrust * surest_tenth(confidence);
  for (float& t : trust) {
    const float share = sure > 0 ? std::min(t / sure, 1.0F) : 0.0F;
    t = share * share;
  }
  return trust;
}

std::vector<std::string> pixel_feature_names(PixelFeatureSet set) {
  std::vector<std::string> names{"red", "green", "blue"};
  const auto add_lab = [&](const std::string& what) {
    for (const char* channel : {"lightness", "Lab a", "Lab b"}) {
      names.push_back(channel + what);
    }
  };
  add_lab("");
  add_lab(", smoothed");
  add_lab(", of the surface");
  add_lab(", of the wider surface");
  names.insert(names.end(),
               {"gradient", "Laplacian", "Hessian, larger", "Hessian, smaller", "structure, larger",
                "structure, smaller", "column in the center view", "row in the center view"});
  if (set.with_disparity) {
    names.insert(names.end(), {"disparity, slope along x", "disparity, slope along y"});
  }
  return names;
}

PixelFeatures compute_pixel_features(const LightField& lf, ViewIndex view,
                                     const DisparityView& disparity, PixelFeatureSet set,
                                     const Progress& progress) {
  if (set.with_disparity && disparity.disparity.empty()) {
    throw InvalidInput("disparity features were requested, but view " + view_text(view) +
                       " has no disparity; estimate all views first");
  }
  PixelFeatures features(lf.height(), static_cast<int>(pixel_feature_names(set).size()),
                         lf.width());
  const cv::Mat rgb = color_image(lf, view);
  std::vector<cv::Mat> lab;
  cv::split(lab_colors(rgb), lab);
  Image<float> filled(lf.height(), lf.width());
  if (!disparity.disparity.empty()) filled = filled_disparity(disparity);
  const cv::Mat map(lf.height(), lf.width(), CV_32F, filled.data());

  const auto writer = [&](int first) { return LayerWriter(features.view(), first); };
  add_surface(writer(kWiderSurfaceLayer), lab, kWiderSurfaceContrast, progress);
  add_surface(writer(kSurfaceLayer), lab, kSurfaceContrast, progress);
  const std::function<void()> groups[] = {
      [&] {
        auto layers = writer(0);
        add_color(layers, rgb, lab);
      },
      [&] {
        auto layers = writer(kShapeLayer);
        add_shape(layers, lab[0]);
        add_place(layers, map, {view.v - lf.center().v, view.u - lf.center().u});
        if (set.with_disparity) add_disparity(layers, map);
      },
  };
  parallel_for(static_cast<int>(std::size(groups)), progress, [&](int i) { groups[i](); });
  return features;
}

Image<float> filled_disparity(const DisparityView& disparity) {
  const ImageView<const float> map = disparity.disparity;
  Image<float> filled(map.height, map.width);
  for (int y = 0; y < map.height; ++y) {
    float* row = filled.row(y);
    int last = -1;
    for (int x = 0; x < map.width; ++x) {
      if (!disparity.is_valid(y, x)) continue;
      row[x] = map.at(y, x);
      // Holes are filled half from either side.
      const int middle = last < 0 ? 0 : (last + x + 1) / 2;
      for (int hole = last + 1; hole < x; ++hole) row[hole] = hole < middle ? row[last] : row[x];
      last = x;
    }
    if (last < 0) {
      if (y > 0) std::copy_n(filled.row(y - 1), map.width, row);
      continue;
    }
    std::fill(row + last + 1, row + map.width, row[last]);
  }
  return filled;
}

DisparitySlopes disparity_slopes(ImageView<const float> disparity) {
  DisparitySlopes slopes{Image<float>(disparity.height, disparity.width),
                         Image<float>(disparity.height, disparity.width)};
  for (int y = 0; y < disparity.height; ++y) {
    slopes_along_row(disparity.row(y), disparity.width, slopes.x.row(y));
    slopes_down(disparity, y, slopes.y.row(y));
  }
  return slopes;
}

cv::Mat lab_colors(const cv::Mat& samples) {
  constexpr double kUnit = 0.01;
  cv::Mat lab;
  cv::cvtColor(rgb_colors(samples), lab, cv::COLOR_RGB2Lab);
  lab *= kUnit;
  return lab;
}

ColorPlanes filter_surfaces(const ColorPlanes& colors, const SurfaceFilter& filter,
                            const Progress& progress) {
  const SurfaceKernel& kernel = EPISCOPE_CHOOSE_KERNEL(filter.isa, kSurfaceKernel);
  const int height = colors[0].height(), width = colors[0].width();
  const std::array<Padded, 3> padded{Padded(colors[0], filter.radius_px),
                                     Padded(colors[1], filter.radius_px),
                                     Padded(colors[2], filter.radius_px)};
  const SurfaceNeighbors neighbors = neighbors_of(filter, padded[0].pitch());
  ColorPlanes out{Image<float>(height, width), Image<float>(height, width),
                  Image<float>(height, width)};
  const std::size_t size = static_cast<std::size_t>(width) + kVectorLanes;
  parallel_for_workers(height, progress, [&] {
    return [&, rows = std::vector<float>(3 * size)](int y) mutable {
      SurfaceTaps taps;
      float* to[3];
      for (std::size_t c = 0; c < 3; ++c) {
        taps.channels[c] = padded[c].row(y);
        to[c] = rows.data() + c * size;
      }
      taps.offsets = neighbors.offsets.data();
      taps.nearness = neighbors.nearness.data();
      taps.count = static_cast<int>(neighbors.offsets.size());
      taps.contrast =
          static_cast<float>(std::numbers::log2e / (2 * filter.contrast * filter.contrast));
      taps.width = width;
      kernel.filter(taps, to);
      for (std::size_t c = 0; c < 3; ++c) std::copy_n(to[c], width, out[c].row(y));
    };
  });
  return out;
}

void append_samples(const ViewScribbles& painted, VolumeView<const float> features,
                    const std::vector<std::int32_t>& ids, ForestSamples& samples) {
  samples.occasional = {kPlaceLayer, kPlaceLayer + 1};
  for (int layer = kDisparitySlopeLayer; layer < features.layers; ++layer) {
    samples.occasional.push_back(layer);
  }
  for (int y = 0; y < features.height; ++y) {
    for (int x = 0; x < features.width; ++x) {
      const std::int32_t label = painted.labels.at(y, x);
      if (label <= 0) continue;
      const auto place = std::ranges::lower_bound(ids, label);
      samples.labels.push_back(static_cast<std::int32_t>(place - ids.begin()));
      for (int f = 0; f < features.layers; ++f) samples.features.push_back(features.at(y, f, x));
    }
  }
}

}  // namespace episcope
