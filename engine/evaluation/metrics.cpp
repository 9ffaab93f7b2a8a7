// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/metrics.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/core/point_cloud.h"
#include "engine/evaluation/region_metrics.h"
#include "engine/evaluation/resolved_errors.h"

#include <fmt/format.h>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope {
namespace {

template <class T>
std::string size_text(const ImageView<const T>& image) {
  return fmt::format("{}×{}", image.width, image.height);
}

/// The smallest, that is farthest, true disparity: what a missing estimate counts as.
float farthest_disparity(const DisparityView& truth) {
  float farthest = std::numeric_limits<float>::infinity();
  for (int y = 0; y < truth.disparity.height; ++y) {
    for (int x = 0; x < truth.disparity.width; ++x) {
      if (truth.is_valid(y, x)) farthest = std::min(farthest, truth.disparity.at(y, x));
    }
  }
  return farthest;
}

Evaluation measure_errors(const DisparityView& estimate, const DisparityView& truth, int border,
                          InvalidEstimates invalid) {
  const int height = truth.disparity.height;
  const int width = truth.disparity.width;
  Evaluation evaluation{{},
                        Image<float>(height, width),
                        Image<std::uint8_t>(height, width),
                        Image<std::uint8_t>(height, width)};
  const float farthest = farthest_disparity(truth);
  for (int y = border; y < height - border; ++y) {
    for (int x = border; x < width - border; ++x) {
      if (!truth.is_valid(y, x)) continue;
      const float d = truth.disparity.at(y, x);
      evaluation.judged.at(y, x) = 1;
      if (estimate.is_valid(y, x)) {
        evaluation.signed_error.at(y, x) = d - estimate.disparity.at(y, x);
      } else {
        evaluation.missing.at(y, x) = 1;
        if (invalid == InvalidEstimates::Bad) evaluation.signed_error.at(y, x) = d - farthest;
      }
    }
  }
  return evaluation;
}

void append(Metrics& metrics, const char* key, std::optional<double> value) {
  if (value) metrics.emplace_back(key, *value);
}

void append(Metrics& metrics, const Metrics& more) {
  metrics.insert(metrics.end(), more.begin(), more.end());
}

/// Those of vmv2013, with and without a border.
void append_squared_errors(Metrics& metrics, const RegionInput& input) {
  const Image<float> truth = marked(input.truth);
  const ResolvedErrors errors(input.estimate, truth.view(), 1, input.options);
  append(metrics, "mse_100", errors.mse_100(nullptr, 0));
  append(metrics, "mse_100_inset15", errors.mse_100(nullptr, kBenchmarkBorder));
}

std::optional<double> density(const Evaluation& evaluation) {
  const auto missing_share =
      bad_percentage(evaluation, nullptr, InvalidEstimates::Bad, [](float) { return false; });
  if (!missing_share) return std::nullopt;
  return 100 - *missing_share;
}

/// Sums over the judged pixels where the estimate has a value, or not.
struct PixelErrors {
  double squares = 0;
  double bad = 0;  ///< By kBadPixelThreshold_px.
  double count = 0;
};

PixelErrors sum_errors(const Evaluation& evaluation, bool of_missing) {
  const auto threshold = static_cast<float>(kBadPixelThreshold_px);
  PixelErrors sums;
  for (std::size_t i = 0; i < evaluation.judged.size(); ++i) {
    if (evaluation.judged.data()[i] == 0) continue;
    if ((evaluation.missing.data()[i] != 0) != of_missing) continue;
    const float error = evaluation.signed_error.data()[i];
    sums.squares += double{error} * error;
    sums.bad += std::abs(error) > threshold ? 1 : 0;
    sums.count += 1;
  }
  return sums;
}

std::string missing_text(const PixelErrors& present, const PixelErrors& missing, double farthest,
                         const EvaluationOptions& options) {
  const double all = present.count + missing.count;
  const auto* const protocol = protocol_name(options.protocol);
  const double share = 100 * missing.count / all;
  if (options.invalid == InvalidEstimates::Compatible) {
    return fmt::format(finding_text("missing.good"), protocol, share);
  }
  if (present.count == 0) {
    return fmt::format(finding_text("missing.all"), protocol, share, farthest);
  }
  return fmt::format(finding_text("missing.bad"), protocol, share, farthest,
                     100 * (present.squares + missing.squares) / all,
                     100 * present.squares / present.count);
}

/// Numbers without the pixels that have no value, if there are such pixels that count as bad; a
/// note if they are more than a few.
void add_missing_values(Evaluation& evaluation, const DisparityView& truth,
                        const EvaluationOptions& options) {
  constexpr double few = 0.001;
  const PixelErrors missing = sum_errors(evaluation, true);
  if (missing.count == 0) return;
  const PixelErrors present = sum_errors(evaluation, false);
  if (missing.count > few * (present.count + missing.count)) {
    evaluation.notes.push_back(missing_text(present, missing, farthest_disparity(truth), options));
  }
  if (options.invalid != InvalidEstimates::Bad || present.count == 0) return;
  const bool is_high_res =
      find_metric(evaluation.metrics, std::string("mse_100") + kLowResSuffix).has_value();
  const std::string suffix = is_high_res ? std::string("_present") + kLowResSuffix : "_present";
  evaluation.metrics.emplace_back("mse_100" + suffix, 100 * present.squares / present.count);
  if (options.protocol == Protocol::Benchmark2016) {
    evaluation.metrics.emplace_back("badpix_0070" + suffix, 100 * present.bad / present.count);
  }
}

void require_comparable(const DisparityView& estimate, const DisparityView& truth) {
  const auto& a = estimate.disparity;
  const auto& b = truth.disparity;
  if (a.height != b.height || a.width != b.width) {
    throw InvalidInput(
        "the estimate is " + size_text(a) + " px, but the truth is " + size_text(b) +
        " px: they belong to different light fields; name the light field of the "
        "estimate, or bring a map of another resolution to this size (--map-resize)");
  }
}

void require_sizes(const std::map<std::string, Image<std::uint8_t>>& regions,
                   const DisparityView& truth) {
  for (const auto& [name, mask] : regions) {
    if (mask.height() == truth.disparity.height && mask.width() == truth.disparity.width) continue;
    throw InvalidInput(fmt::format("the region mask {} is {} px, but the truth is {} px", name,
                                   size_text(mask.view()), size_text(truth.disparity)));
  }
}

/// Percentage of the pixels with truth that the light field shows.
std::optional<double> shown_percentage(const DisparityView& truth, const DisparityView& shown) {
  double all = 0, seen = 0;
  for (int y = 0; y < truth.disparity.height; ++y) {
    for (int x = 0; x < truth.disparity.width; ++x) {
      all += truth.is_valid(y, x) ? 1 : 0;
      seen += shown.is_valid(y, x) ? 1 : 0;
    }
  }
  if (all == 0) return std::nullopt;
  return 100 * seen / all;
}

/// None if no pixel can be judged.
std::optional<Evaluation> evaluate_if_any(const DisparityView& estimate,
                                          const DisparityView& whole_truth,
                                          const std::map<std::string, Image<std::uint8_t>>& regions,
                                          const EvaluationOptions& options) {
  require_comparable(estimate, whole_truth);
  require_sizes(regions, whole_truth);
  const ShownDisparity shown(whole_truth, options.shown);
  const DisparityView& truth = shown.view();
  const bool is_benchmark = options.protocol == Protocol::Benchmark2016;
  Evaluation evaluation =
      measure_errors(estimate, truth, is_benchmark ? kBenchmarkBorder : 0, options.invalid);
  if (std::find(evaluation.judged.begin(), evaluation.judged.end(), 1) == evaluation.judged.end()) {
    return std::nullopt;
  }
  const RegionInput input{estimate, truth, regions, options};
  BenchmarkMetrics scores;
  if (is_benchmark) {
    scores = benchmark_metrics(input);
    append(evaluation.metrics, scores.general);
    evaluation.notes = std::move(scores.notes);
  } else {
    append_squared_errors(evaluation.metrics, input);
  }
  append(evaluation.metrics, "density", density(evaluation));
  add_missing_values(evaluation, truth, options);
  if (!options.shown.empty()) {
    append(evaluation.metrics, "shown", shown_percentage(whole_truth, truth));
  }
  append(evaluation.metrics, scores.masked);
  if (is_benchmark) append_region_metrics(evaluation, input);
  return evaluation;
}

// The center view: the truth covers all views or that one.
ViewIndex center_of(const DisparityField& truth) {
  const ViewIndex first = truth.disparity.first(), center = truth.disparity.grid().center();
  return {first.v + center.v, first.u + center.u};
}

// Whether a map has a value there; a map that is missing has none.
bool has_value(const DisparityField& field, ViewIndex view, int y, int x) {
  return field.contains(view) && field.view(view).is_valid(y, x);
}

std::optional<double> layers_right(const LayeredDisparity& estimate, const GroundTruth& truth,
                                   ViewIndex view, ImageView<const std::uint8_t> shown) {
  if (estimate.layers.empty() || !estimate.layers.contains(view)) return std::nullopt;
  const ImageView<const std::uint8_t> layers = estimate.layers.view(view);
  double judged = 0, right = 0;
  for (int y = 0; y < layers.height; ++y) {
    for (int x = 0; x < layers.width; ++x) {
      if (!shown.empty() && shown.at(y, x) == 0) continue;
      const bool near = has_value(truth.foreground, view, y, x);
      const bool far = has_value(truth.background, view, y, x);
      if (!near && !far && !has_value(truth.field, view, y, x)) continue;
      judged += 1;
      if (layers.at(y, x) == (near && far ? 2 : 1)) right += 1;
    }
  }
  if (judged == 0) return std::nullopt;
  return 100 * right / judged;
}

namespace geometry = boost::geometry;

using Point = geometry::model::point<float, 3, geometry::cs::cartesian>;
using Tree = geometry::index::rtree<Point, geometry::index::rstar<16>>;

/// Rows of a search tree: it is built in 20 ms, so that a stop request is heard in between.
constexpr int kBandRows = 32;
/// Where reference and estimate have the same units, z is anyway not a matter of taste.
constexpr double kNoStretch = 1;

std::optional<Point> point_at(const DisparityView& view, const BackProjection& project, int y,
                              int x) {
  if (!view.is_valid(y, x)) return std::nullopt;
  const auto place = project(y, x, view.disparity.at(y, x));
  if (!std::isfinite(place[2])) return std::nullopt;
  return Point(float(place[0]), float(place[1]), float(place[2]));
}

std::vector<Tree> trees_of(const DisparityView& view, const BackProjection& project,
                           const Progress& progress) {
  const int height = view.disparity.height;
  std::vector<Tree> trees((height + kBandRows - 1) / kBandRows);
  parallel_for(static_cast<int>(trees.size()), progress, [&](int band) {
    std::vector<Point> points;
    const int end = std::min((band + 1) * kBandRows, height);
    for (int y = band * kBandRows; y < end; ++y) {
      for (int x = 0; x < view.disparity.width; ++x) {
        if (const auto point = point_at(view, project, y, x)) points.push_back(*point);
      }
    }
    trees[band] = Tree(points);
  });
  std::erase_if(trees, [](const Tree& tree) { return tree.empty(); });
  return trees;
}

/// Squared distance to the nearest point of all trees; the search begins at tree `first`.
class Nearest {
 public:
  explicit Nearest(const std::vector<Tree>& trees) : trees_(trees) {
    for (const Tree& tree : trees) boxes_.push_back(tree.bounds());
  }

  [[nodiscard]] double squared(const Point& point, std::size_t first) const {
    double best = in_tree(point, first);
    for (std::size_t i = 0; i < trees_.size(); ++i) {
      if (i == first || geometry::comparable_distance(point, boxes_[i]) >= best) continue;
      best = std::min(best, in_tree(point, i));
    }
    return best;
  }

 private:
  [[nodiscard]] double in_tree(const Point& point, std::size_t tree) const {
    Point found;
    trees_[tree].query(geometry::index::nearest(point, 1), &found);
    return geometry::comparable_distance(point, found);
  }

  const std::vector<Tree>& trees_;
  std::vector<Tree::bounds_type> boxes_;
};

CloudDistance summarised(Image<float> distance) {
  CloudDistance result;
  std::vector<float> values;
  std::copy_if(distance.data(), distance.data() + distance.size(), std::back_inserter(values),
               [](float value) { return std::isfinite(value); });
  if (values.empty()) {
    throw InvalidInput("the estimate has no pixel with a depth, so it has no distance to another");
  }
  double sum = 0;
  for (const float value : values) sum += value;
  result.distance = std::move(distance);
  result.points = values.size();
  result.mean = sum / static_cast<double>(values.size());
  result.median = quantile(values, 0.5);
  result.percentile95 = quantile(values, 0.95);
  return result;
}

void check(const DisparityView& estimate, const DisparityView& reference,
           const CameraGrid& camera) {
  if (!camera.is_known()) {
    throw InvalidInput(
        "the camera of this light field is not known, so distances in space cannot be measured");
  }
  if (estimate.disparity.height != reference.disparity.height ||
      estimate.disparity.width != reference.disparity.width) {
    throw InvalidInput("point clouds can be compared only if their maps have the same size");
  }
}

}  // namespace

const char* protocol_name(Protocol protocol) {
  return protocol == Protocol::Vmv2013 ? "vmv2013" : "benchmark2016";
}

Names<Protocol> names_of(Protocol) {
  return {{Protocol::Vmv2013, protocol_name(Protocol::Vmv2013)},
          {Protocol::Benchmark2016, protocol_name(Protocol::Benchmark2016)}};
}

Names<InvalidEstimates> names_of(InvalidEstimates) {
  return {{InvalidEstimates::Bad, "bad"}, {InvalidEstimates::Compatible, "compatible"}};
}

std::optional<double> find_metric(const Metrics& metrics, const std::string& key) {
  const auto found = std::find_if(metrics.begin(), metrics.end(),
                                  [&key](const auto& metric) { return metric.first == key; });
  if (found == metrics.end()) return std::nullopt;
  return found->second;
}

Evaluation evaluate(const DisparityView& estimate, const DisparityView& truth,
                    const std::map<std::string, Image<std::uint8_t>>& regions,
                    const EvaluationOptions& options) {
  auto evaluation = evaluate_if_any(estimate, truth, regions, options);
  if (evaluation) return std::move(*evaluation);
  throw InvalidInput(
      "no pixel of the " + size_text(truth.disparity) + " px can be evaluated by " +
      protocol_name(options.protocol) +
      (options.protocol == Protocol::Benchmark2016 ? ", which ignores a border of 15 px" : "") +
      ": the truth has no value there" +
      (options.shown.empty() ? "" : ", or the light field shows nothing"));
}

LayeredEvaluation evaluate_layers(const LayeredDisparity& estimate, const GroundTruth& truth,
                                  ViewIndex view, const EvaluationOptions& options) {
  for (const auto* field :
       {&estimate.foreground, &estimate.background, &truth.foreground, &truth.background}) {
    if (!field->contains(view)) {
      throw InvalidInput(fmt::format(
          "view {},{} does not have two layers in both estimate and truth", view.v, view.u));
    }
  }
  const std::map<std::string, Image<std::uint8_t>> no_regions;
  const auto& regions = view == center_of(truth.foreground) ? truth.regions : no_regions;
  const DisparityView near = estimate.foreground.view(view);
  LayeredEvaluation evaluation{
      evaluate(near, truth.foreground.view(view), regions, options),
      evaluate(estimate.background.view(view), truth.background.view(view), regions, options),
      {},
      layers_right(estimate, truth, view, options.shown)};
  if (truth.field.contains(view)) {
    evaluation.single = evaluate_if_any(near, truth.field.view(view), regions, options);
  }
  return evaluation;
}

Metrics layered_metrics(const LayeredEvaluation& evaluation) {
  Metrics metrics;
  if (evaluation.single) metrics = evaluation.single->metrics;
  const auto append_layer = [&metrics](const Metrics& layer, const char* suffix) {
    for (const auto& [key, value] : layer) metrics.emplace_back(key + suffix, value);
  };
  append_layer(evaluation.foreground.metrics, "_foreground");
  append_layer(evaluation.background.metrics, "_background");
  append(metrics, "layers_right", evaluation.layers_right);
  return metrics;
}

const char* runtime_class(double seconds) {
  if (seconds < 5) return "fast";
  return seconds <= 60 ? "medium" : "slow";
}

Image<std::uint8_t> present_mask(const Evaluation& evaluation) {
  const Image<float>& error = evaluation.signed_error;
  Image<std::uint8_t> mask(error.height(), error.width(), 1, 1);
  if (evaluation.missing.empty()) return mask;
  std::transform(evaluation.missing.begin(), evaluation.missing.end(), mask.begin(),
                 [](std::uint8_t missing) { return static_cast<std::uint8_t>(missing == 0); });
  return mask;
}

Image<float> absolute_error_map(const Evaluation& evaluation) {
  Image<float> map = evaluation.signed_error;
  for (float& error : map) error = std::abs(error);
  return map;
}

Image<float> bad_pixel_map(const Evaluation& evaluation, double threshold_px) {
  const auto threshold = static_cast<float>(threshold_px);
  Image<float> map = evaluation.signed_error;
  auto missing = evaluation.missing.begin();
  for (float& error : map) {
    const bool is_missing = *missing++ != 0;
    error = is_missing || std::abs(error) > threshold ? kBadPixel : kGoodPixel;
  }
  return map;
}

CloudDistance cloud_distance(const DisparityView& estimate, const DisparityView& reference,
                             const CameraGrid& camera, const Progress& progress) {
  check(estimate, reference, camera);
  const int height = estimate.disparity.height;
  const int width = estimate.disparity.width;
  const BackProjection project(camera, height, width, kNoStretch);
  const std::vector<Tree> trees = trees_of(reference, project, progress.part(0, 0.3));
  if (trees.empty()) {
    throw InvalidInput("the reference has no pixel with a depth, so nothing has a distance to it");
  }
  const Nearest nearest(trees);
  Image<float> distance(height, width, 1, std::numeric_limits<float>::quiet_NaN());
  parallel_for(height, progress.part(0.3, 1), [&](int y) {
    const std::size_t first = trees.size() * y / height;
    for (int x = 0; x < width; ++x) {
      const auto point = point_at(estimate, project, y, x);
      if (point) distance.at(y, x) = static_cast<float>(std::sqrt(nearest.squared(*point, first)));
    }
  });
  return summarised(std::move(distance));
}

}  // namespace episcope
