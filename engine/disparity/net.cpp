// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/net.h"
#include "engine/disparity/net_evidence.h"

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/core/isa.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/disparity/kernels/net_kernel.h"
#include "engine/disparity/kernels/shared_constants.h"
#include "engine/disparity/net_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <span>
#include <string>

namespace episcope {
namespace {

// Layers one after the other.
int add_chain(NetStream& stream, const NetWeights& weights, int input,
              std::initializer_list<std::string> names) {
  for (const std::string& name : names) {
    input = stream.add_convolution(weights.layer(name), input);
  }
  return input;
}

// A tensor plus two layers of it.
int add_residual(NetStream& stream, const NetWeights& weights, int input, const std::string& name) {
  const int first = stream.add_convolution(weights.layer(name + ".0"), input);
  return stream.add_convolution(weights.layer(name + ".1"), first, {-1, input});
}

// A layer of 1×1, then its output twice as large plus another, then a layer of it.
int add_ascent(NetStream& stream, const NetWeights& weights, int input, int plus,
               const std::array<std::string, 2>& names) {
  const int reduced = stream.add_convolution(weights.layer(names[0]), input);
  const int sum = stream.add_enlarged(reduced, plus);
  return stream.add_convolution(weights.layer(names[1]), sum);
}

cuda::NetConvolution convolution_of(const NetLayer& layer) {
  const NetLayerForm& form = layer.form;
  return {.inputs = form.inputs,
          .outputs = form.outputs,
          .kernel = form.kernel,
          .depth_taps = form.depth_taps(),
          .stride = form.stride,
          .dilation = form.dilation,
          .is_leaky = form.is_leaky,
          .weights = layer.plain_weights,
          .bias = std::vector<float>(layer.bias_data(), layer.bias_data() + form.outputs)};
}

cuda::NetPart steps_of(const NetStream& stream) {
  cuda::NetPart part;
  for (const NetOperation& operation : stream.operations()) {
    part.push_back({.convolution = {},
                    .input = operation.input,
                    .before = operation.sums.before,
                    .after = operation.sums.after});
    if (operation.layer != nullptr) part.back().convolution = convolution_of(*operation.layer);
  }
  return part;
}

// A source that is only connected.
int add_unfilled(NetStream& stream, int channels, int depth = 1) {
  return stream.add_source({channels, depth, 1, 1}, {});
}

cuda::NetReduction reduction_of(const NetWeights& weights, const std::string& name) {
  return {convolution_of(weights.layer(name + "reduce.a")),
          convolution_of(weights.layer(name + "reduce.b"))};
}

template <class Better>
Image<float> window_extreme(const Image<float>& map, int size, const Better& better,
                            const Progress& progress) {
  const int radius = size / 2, width = map.width();
  Image<float> found(map.height(), width);
  parallel_for(map.height(), progress, [&](int y) {
    std::vector<float> column(map.row(y), map.row(y) + width);
    for (int i = std::max(y - radius, 0); i < std::min(y + radius + 1, map.height()); ++i) {
      for (int x = 0; x < width; ++x) column[x] = better(column[x], map.row(i)[x]);
    }
    for (int x = 0; x < width; ++x) {
      float best = column[x];
      for (int i = std::max(x - radius, 0); i < std::min(x + radius + 1, width); ++i) {
        best = better(best, column[i]);
      }
      found.at(y, x) = best;
    }
  });
  return found;
}

/// The largest number (or the smallest) of the size × size pixels around each, of those that exist.
Image<float> window_most(const Image<float>& map, int size, const Progress& progress) {
  return window_extreme(
      map, size, [](float a, float b) { return std::max(a, b); }, progress);
}

Image<float> window_least(const Image<float>& map, int size, const Progress& progress) {
  return window_extreme(
      map, size, [](float a, float b) { return std::min(a, b); }, progress);
}

/// The median of 5 × 5 pixels, `apart` px from one to the next, around each. The border is
/// repeated. All numbers must be finite.
Image<float> window_median(const Image<float>& map, int apart, const Progress& progress) {
  constexpr int kRadius = kNetWindow / 2;
  Image<float> found(map.height(), map.width());
  parallel_for(map.height(), progress, [&](int y) {
    const float* rows[kNetWindow];
    for (int i = 0; i < kNetWindow; ++i) {
      rows[i] = map.row(std::clamp(y + (i - kRadius) * apart, 0, map.height() - 1));
    }
    std::array<float, kNetWindow * kNetWindow> window;
    for (int x = 0; x < map.width(); ++x) {
      int count = 0;
      for (int j = -kRadius; j <= kRadius; ++j) {
        const int column = std::clamp(x + j * apart, 0, map.width() - 1);
        for (const float* const row : rows) window[count++] = row[column];
      }
      std::nth_element(window.begin(), window.begin() + count / 2, window.end());
      found.at(y, x) = window[count / 2];
    }
  });
  return found;
}

/// Disparities among which `net` chooses: a map, its maxima, minima and medians around each pixel,
/// a second map.
std::array<Image<float>, kNetHypotheses> net_hypotheses(const Image<float>& map,
                                                        const Image<float>& second,
                                                        const Progress& progress) {
  const Image<float> median = window_median(map, 1, progress.part(0, 0.3));
  return {map,
          window_most(map, kNetWindow, progress.part(0.3, 0.4)),
          window_least(map, kNetWindow, progress.part(0.4, 0.5)),
          median,
          window_most(median, kNetWideWindow, progress.part(0.5, 0.6)),
          window_least(median, kNetWideWindow, progress.part(0.6, 0.7)),
          window_median(map, kNetMedianApart, progress.part(0.7, 1)),
          second};
}

constexpr double kStepOfLabels = 0.1;

// A view, its guide and what the network knows by heart.
struct NetScene {
  const LightField& light_field;
  ViewIndex view;
  const NetWeights& weights;
  Image<float> guide;
  NetPlaces places;

  [[nodiscard]] int height() const { return light_field.height(); }
  [[nodiscard]] int width() const { return light_field.width(); }
  [[nodiscard]] NetShape shape(int channels, int depth = 1) const {
    return {channels, depth, height(), width()};
  }
};

// The labels of the volume and what it makes of them.
struct Labels {
  float first = 0;
  float step = 0;
  int count = 0;
};

struct Beliefs {
  Labels labels;
  Volume<float> log;  // Log-probabilities.
  Image<float> own;
  Image<float> second;
};

struct Selected {
  Image<float> mode;
  Image<float> probability;
  Image<float> second;
  Image<float> second_probability;
  Image<float> to_mean;  // From the mode to the mean of all hypotheses.
};

Interval range_of(const Image<float>& map) {
  const auto [least, most] = std::minmax_element(map.begin(), map.end());
  return {*least, *most};
}

// Volume.

// The disparity of the labels around one of them, weighted by their probabilities.
float peak_at(std::span<const float> probabilities, int at, const Labels& labels) {
  const int begin = std::max(at - kNetPeak, 0), end = std::min(at + kNetPeak + 1, labels.count);
  float sum = 0, weighted = 0;
  for (int i = begin; i < end; ++i) {
    sum += probabilities[i];
    weighted += probabilities[i] * static_cast<float>(i);
  }
  return labels.first + weighted / sum * labels.step;
}

// Softmax and modes of one pixel; `logits` become log-probabilities.
void find_modes(std::span<float> logits, std::span<float> probabilities, const Labels& labels,
                float& own, float& second) {
  const float most = *std::ranges::max_element(logits);
  float sum = 0;
  for (int i = 0; i < labels.count; ++i) sum += probabilities[i] = std::exp(logits[i] - most);
  const float log_sum = std::log(sum);
  for (float& logit : logits) logit = logit - most - log_sum;
  const int first = static_cast<int>(std::ranges::max_element(logits) - logits.begin());
  int other = -1;
  for (int i = 0; i < labels.count; ++i) {
    if (std::abs(i - first) > kNetModesApart && (other < 0 || logits[i] > logits[other])) other = i;
  }
  own = peak_at(probabilities, first, labels);
  second = peak_at(probabilities, other, labels);
}

void take_logits(const NetRows& rows, int y, Beliefs& beliefs) {
  const int count = beliefs.labels.count;
  std::vector<float> logits(count), probabilities(count);
  const VolumeView<float> log = beliefs.log.view();
  for (int x = 0; x < log.width; ++x) {
    for (int i = 0; i < count; ++i) logits[i] = rows.at(y, i)[x * rows.step()];
    find_modes(logits, probabilities, beliefs.labels, beliefs.own.at(y, x),
               beliefs.second.at(y, x));
    for (int i = 0; i < count; ++i) log.at(y, i, x) = logits[i];
  }
}

Beliefs run_volume(const NetScene& scene, Interval range, const Progress& progress) {
  progress.step("volume");
  const int count = net_label_count(range);
  const auto first = static_cast<float>(range.min), last = static_cast<float>(range.max);
  Beliefs beliefs{{first, (last - first) / static_cast<float>(count - 1), count},
                  Volume<float>(scene.height(), count, scene.width()),
                  Image<float>(scene.height(), scene.width()),
                  Image<float>(scene.height(), scene.width())};
  NetEvidence evidence(scene.light_field, scene.view, range, NetEvidenceOf::Planes, scene.places);
  const auto label = [&](int i) {
    return first + (last - first) * (static_cast<float>(i) / static_cast<float>(count - 1));
  };
  NetStream stream;
  const int volume = stream.add_source(
      scene.shape(kNetEvidence, count),
      [&](int y, int z, NetRows& rows) {
        std::array<NetDisparity, kNetAtOnce> disparities;
        for (int i = 0; i < kNetAtOnce; ++i) disparities[i] = {{}, label(z + i), rows.at(y, z + i)};
        evidence.compute(y, disparities);
      },
      [&](int begin, int end, const Progress& part) { evidence.hold(begin, end, part); },
      kNetAtOnce);
  const int image = stream.add_source(scene.shape(kNetGuide), [&](int y, int, NetRows& rows) {
    for (int x = 0; x < scene.width(); ++x) {
      std::copy_n(&scene.guide.at(y, x), kNetGuide, rows.at(y, 0) + x * kNetGroup);
    }
  });
  stream.run(
      add_net_volume(stream, scene.weights, volume, image), kNetBand,
      [&](int y, const NetRows& rows) { take_logits(rows, y, beliefs); }, progress);
  return beliefs;
}

// Log-probability of a disparity, linear between labels.
float log_at(const Beliefs& beliefs, int y, int x, float disparity) {
  const Labels& labels = beliefs.labels;
  const float at = std::clamp((disparity - labels.first) / labels.step, 0.0F,
                              static_cast<float>(labels.count - 1));
  const int i = std::min(static_cast<int>(at), labels.count - 2);
  const float part = at - static_cast<float>(i);
  const VolumeView<const float> log = beliefs.log.view();
  return log.at(y, i, x) * (1 - part) + log.at(y, i + 1, x) * part;
}

// Selection and refinement.

float squash(float disparity) {
  return std::copysign(kNetSquash * std::log1p(std::abs(disparity) / kNetSquashUnit), disparity);
}

// The two layers of 1×1 that reduce evidence at a pixel, row by row.
class Reduction {
 public:
  Reduction(const NetWeights& weights, const std::string& name, int width)
      : first_(weights.layer(name + "reduce.a")),
        second_(weights.layer(name + "reduce.b")),
        width_(width),
        inner_(static_cast<std::size_t>(width) * kNetGroup),
        reduced_(inner_.size()) {}

  // kNetReduced numbers for each pixel into `out`, `step` apart.
  void operator()(const float* evidence, float* out, int step) {
    convolve(first_, evidence, inner_.data());
    convolve(second_, inner_.data(), reduced_.data());
    for (int x = 0; x < width_; ++x) {
      std::copy_n(&reduced_[static_cast<std::size_t>(x) * kNetGroup], kNetReduced,
                  out + static_cast<long>(x) * step);
    }
  }

 private:
  void convolve(const NetLayer& layer, const float* from, float* to) const {
    NetConvolutionRow row;
    row.taps[0] = {from, layer.weights_data()};
    row.tap_count = 1;
    row.inputs = layer.form.inputs;
    row.columns = width_;
    row.outputs = whole_groups(layer.form.outputs);
    row.group_stride = layer.group_stride();
    row.bias = layer.bias_data();
    row.is_leaky = true;
    row.out.out = to;
    EPISCOPE_CHOOSE_KERNEL(best_isa(), kNetKernel).convolve(row);
  }

  const NetLayer& first_;
  const NetLayer& second_;
  int width_;
  std::vector<float> inner_;
  std::vector<float> reduced_;
};

// Room for the evidence of a row at some disparities.
template <int kCount>
struct EvidenceRows {
  std::vector<float> values;
  std::array<NetDisparity, kCount> disparities;

  explicit EvidenceRows(int width)
      : values(static_cast<std::size_t>(width) * kNetEvidence * kCount) {
    for (int i = 0; i < kCount; ++i) {
      disparities[i].out = values.data() + static_cast<std::size_t>(i) * width * kNetEvidence;
    }
  }
};

using Hypotheses = std::array<Image<float>, kNetHypotheses>;

// Inputs of the selection besides the evidence, at one pixel.
void write_hypotheses(const NetScene& scene, const Hypotheses& hypotheses, const Beliefs* beliefs,
                      int y, int x, float* out) {
  for (int i = 0; i < kNetHypotheses; ++i) {
    const float log = beliefs ? log_at(*beliefs, y, x, hypotheses[i].at(y, x)) : 0;
    *out++ = std::clamp(log, kNetLeastLog, 0.0F) / kNetLogScale;
  }
  for (int i = 1; i < kNetHypotheses; ++i) {
    *out++ = squash(hypotheses[i].at(y, x) - hypotheses[0].at(y, x));
  }
  *out++ = beliefs ? 1 : 0;
  std::copy_n(&scene.guide.at(y, x), kNetGuide, out);
}

float kernel_of(float distance) {
  return std::exp(-(distance / kNetSame) * (distance / kNetSame));
}

void decide(const float* logits, const std::array<float, kNetHypotheses>& h, Selected& selected,
            int y, int x) {
  std::array<float, kNetHypotheses> weight, score{};
  const float most = *std::max_element(logits, logits + kNetHypotheses);
  float sum = 0, mean = 0;
  for (int i = 0; i < kNetHypotheses; ++i) sum += weight[i] = std::exp(logits[i] - most);
  for (int i = 0; i < kNetHypotheses; ++i) {
    weight[i] /= sum;
    mean += weight[i] * h[i];
  }
  for (int i = 0; i < kNetHypotheses; ++i) {
    for (int j = 0; j < kNetHypotheses; ++j) score[i] += kernel_of(h[i] - h[j]) * weight[j];
  }
  const auto best = std::ranges::max_element(score) - score.begin();
  float near = 0, weighted = 0;
  int other = -1;
  for (int i = 0; i < kNetHypotheses; ++i) {
    const float share = weight[i] * kernel_of(h[i] - h[best]);
    near += share;
    weighted += share * h[i];
    const bool is_far = !(std::abs(h[i] - h[best]) < kNetOther);
    if (is_far && (other < 0 || score[i] > score[other])) other = i;
  }
  const float mode = weighted / std::max(near, kNetLeastShare);
  const bool has_other = other >= 0 && score[other] > 0;
  selected.mode.at(y, x) = mode;
  selected.probability.at(y, x) = std::min(score[best], 1.0F);
  selected.second.at(y, x) = has_other ? h[other] : mode;
  selected.second_probability.at(y, x) = has_other ? std::min(score[other], 1.0F) : 0;
  selected.to_mean.at(y, x) = mean - mode;
}

void take_selection(const NetRows& rows, int y, const Hypotheses& hypotheses, Selected& selected) {
  for (int x = 0; x < selected.mode.width(); ++x) {
    std::array<float, kNetHypotheses> h;
    for (int i = 0; i < kNetHypotheses; ++i) h[i] = hypotheses[i].at(y, x);
    decide(rows.at(y, 0) + x * rows.step(), h, selected, y, x);
  }
}

Interval range_of(const Hypotheses& hypotheses) {
  Interval all = range_of(hypotheses[0]);
  for (const Image<float>& map : hypotheses) {
    const Interval one = range_of(map);
    all = {std::min(all.min, one.min), std::max(all.max, one.max)};
  }
  return all;
}

Selected run_selection(const NetScene& scene, const Hypotheses& hypotheses, const Beliefs* beliefs,
                       const Progress& progress) {
  progress.step("selection");
  const Image<float> blank(scene.height(), scene.width());
  Selected selected{blank, blank, blank, blank, blank};
  NetEvidence evidence(scene.light_field, scene.view, range_of(hypotheses), NetEvidenceOf::Maps,
                       scene.places);
  NetStream stream;
  const int step = whole_groups(kNetSelectionInputs);
  const int input = stream.add_source(
      scene.shape(kNetSelectionInputs),
      [&](int y, int, NetRows& rows) {
        float* const out = rows.at(y, 0);
        Reduction reduce(scene.weights, kNetSelection, scene.width());
        EvidenceRows<kNetHypotheses> all(scene.width());
        for (int i = 0; i < kNetHypotheses; ++i) all.disparities[i].map = hypotheses[i].row(y);
        evidence.compute(y, all.disparities);
        for (int i = 0; i < kNetHypotheses; ++i) {
          reduce(all.disparities[i].out, out + i * kNetReduced, step);
        }
        for (int x = 0; x < scene.width(); ++x) {
          write_hypotheses(scene, hypotheses, beliefs, y, x,
                           out + x * step + kNetHypotheses * kNetReduced);
        }
      },
      [&](int begin, int end, const Progress& part) { evidence.hold(begin, end, part); });
  stream.run(
      add_net_selection(stream, scene.weights, input), kNetBand,
      [&](int y, const NetRows& rows) { take_selection(rows, y, hypotheses, selected); }, progress);
  return selected;
}

struct Refined {
  Image<float> disparity;
  Image<float> confidence;
};

// What a refinement begins with.
struct Unrefined {
  const Image<float>& disparity;
  const Image<float>& probability;
  std::array<Image<float>, kNetWindows> windows;
};

// Reduced evidence of a row at offsets from its disparities, the first as it is, others less the
// first.
void write_offsets(const NetEvidence& evidence, Reduction& reduce, std::span<const float> row,
                   int y, float step, float* out, int out_step) {
  EvidenceRows<kNetOffsets> all(static_cast<int>(row.size()));
  std::array<std::vector<float>, kNetOffsets> maps;
  for (int i = 0; i < kNetOffsets; ++i) {
    for (const float disparity : row) maps[i].push_back(disparity + kNetOffset[i] * step);
    all.disparities[i].map = maps[i].data();
  }
  evidence.compute(y, all.disparities);
  const float* const first = all.disparities[0].out;
  for (int i = 0; i < kNetOffsets; ++i) {
    float* const other = all.disparities[i].out;
    for (std::size_t j = 0; i > 0 && j < row.size() * kNetEvidence; ++j) {
      other[j] = (other[j] - first[j]) * kNetOffsetGain;
    }
    reduce(other, out + i * kNetReduced, out_step);
  }
}

void write_surroundings(const NetScene& scene, const Unrefined& from, int y, int x, float* out) {
  for (const Image<float>& window : from.windows) {
    *out++ = squash(window.at(y, x) - from.disparity.at(y, x));
  }
  *out++ = from.probability.at(y, x);
  std::copy_n(&scene.guide.at(y, x), kNetGuide, out);
}

void take_refined(const NetRows& rows, int y, float step, const Image<float>& from,
                  Refined& refined) {
  for (int x = 0; x < from.width(); ++x) {
    const float* const out = rows.at(y, 0) + x * rows.step();
    refined.disparity.at(y, x) = from.at(y, x) + step * kNetReach * std::tanh(out[0]);
    refined.confidence.at(y, x) = 1 / (1 + std::exp(-out[1]));
  }
}

Refined run_refinement(const NetScene& scene, int number, const Image<float>& disparity,
                       const Image<float>& probability, const Progress& progress) {
  progress.step("refinement");
  const std::string name = net_refinement(number);
  const float step = kNetSteps[number];
  const Unrefined from{disparity,
                       probability,
                       {window_most(disparity, kNetWindow, progress.part(0, 0)),
                        window_least(disparity, kNetWindow, progress.part(0, 0)),
                        window_median(disparity, 1, progress.part(0, 0))}};
  const Interval range = range_of(disparity);
  NetEvidence evidence(scene.light_field, scene.view, {range.min - step, range.max + step},
                       NetEvidenceOf::Maps, scene.places);
  Refined refined{disparity, disparity};
  NetStream stream;
  const int out_step = whole_groups(kNetRefinementInputs);
  const int input = stream.add_source(
      scene.shape(kNetRefinementInputs),
      [&](int y, int, NetRows& rows) {
        float* const out = rows.at(y, 0);
        Reduction reduce(scene.weights, name, scene.width());
        write_offsets(evidence, reduce, {disparity.row(y), static_cast<std::size_t>(scene.width())},
                      y, step, out, out_step);
        for (int x = 0; x < scene.width(); ++x) {
          write_surroundings(scene, from, y, x, out + x * out_step + kNetOffsets * kNetReduced);
        }
      },
      [&](int begin, int end, const Progress& part) { evidence.hold(begin, end, part); });
  stream.run(
      add_net_refinement(stream, scene.weights, input, number), kNetBand,
      [&](int y, const NetRows& rows) { take_refined(rows, y, step, disparity, refined); },
      progress);
  return refined;
}

NetMaps refine(const NetScene& scene, Selected selected, Silhouettes silhouettes,
               const Progress& progress) {
  const Refined coarse =
      run_refinement(scene, 0, selected.mode, selected.probability, progress.part(0, 0.5));
  Refined fine =
      run_refinement(scene, 1, coarse.disparity, selected.probability, progress.part(0.5, 1));
  if (silhouettes == Silhouettes::Mean) {
    std::transform(fine.disparity.begin(), fine.disparity.end(), selected.to_mean.begin(),
                   fine.disparity.begin(), std::plus<>());
  }
  return {std::move(fine.disparity), std::move(fine.confidence), std::move(selected.second),
          std::move(selected.second_probability)};
}

void require_views(const LightField& light_field, ViewIndex view) {
  const GridShape grid = light_field.grid();
  if (!grid.contains(view)) {
    throw InvalidInput(
        fmt::format("view {} is not in the grid of {}×{} views", view_text(view), grid.v, grid.u));
  }
  if (grid.count() < 2) throw InvalidInput("net compares views, but there is only one");
}

// What the device is told but for the labels or the map that it begins with.
cuda::NetTask device_task(const LightField& light_field, ViewIndex view,
                          const NetParameters& parameters) {
  return {.light_field = light_field,
          .view = view,
          .sectors = net_sectors(light_field, view, parameters.places),
          .takes_mean = parameters.silhouettes == Silhouettes::Mean};
}

// The whole, on the device.
NetMaps run_on_device(const cuda::DeviceNet& net, const cuda::NetTask& task,
                      const Progress& progress) {
  cuda::NetAnswer answer = net.run(task, progress);
  return {std::move(answer.disparity), std::move(answer.confidence), std::move(answer.second),
          std::move(answer.second_probability)};
}

}  // namespace

std::string net_refinement(int number) {
  return "refinement." + std::to_string(number) + ".";
}

int add_net_volume(NetStream& stream, const NetWeights& weights, int evidence, int guide) {
  const std::string v = "volume.";
  const int map = add_chain(stream, weights, guide, {v + "image.0", v + "image.1", v + "image.2"});
  const int input = stream.add_convolution(weights.layer(v + "input"), evidence, {map, -1});
  const int x0 = stream.add_convolution(weights.layer(v + "e0"), input, {-1, input});
  const int x1 = add_chain(stream, weights, x0, {v + "d1", v + "e1"});
  const int e2 = add_chain(stream, weights, x1, {v + "d2", v + "e2.0", v + "e2.1"});
  const int x2 = add_residual(stream, weights, e2, v + "r2");
  const int e3 = add_chain(stream, weights, x2, {v + "d3", v + "e3.0", v + "e3.1"});
  const int x3 = add_residual(stream, weights, e3, v + "r3");
  const int f2 = add_ascent(stream, weights, x3, x2, {v + "u2", v + "f2"});
  const int y2 = add_residual(stream, weights, f2, v + "s2");
  const int y1 = add_ascent(stream, weights, y2, x1, {v + "u1", v + "f1"});
  const int y0 = add_ascent(stream, weights, y1, x0, {v + "u0", v + "f0"});
  return stream.add_convolution(weights.layer(v + "head"), y0);
}

int add_net_selection(NetStream& stream, const NetWeights& weights, int input) {
  const std::string s = kNetSelection;
  const int i = add_chain(stream, weights, input, {s + "i.0", s + "i.1"});
  const int x0 = add_residual(stream, weights, i, s + "r0");
  const int d1 = add_chain(stream, weights, x0, {s + "d1.0", s + "d1.1"});
  const int x1 = add_residual(stream, weights, d1, s + "r1");
  const int d2 = add_chain(stream, weights, x1, {s + "d2.0", s + "d2.1", s + "d2.2", s + "d2.3"});
  const int d3 = add_chain(stream, weights, d2, {s + "d3.0", s + "d3.1", s + "d3.2", s + "u2"});
  const int x2 = stream.add_enlarged(d3, d2);
  const int f1 = add_ascent(stream, weights, x2, x1, {s + "u1", s + "f1"});
  const int y1 = add_residual(stream, weights, f1, s + "s1");
  const int y0 = add_ascent(stream, weights, y1, x0, {s + "u0", s + "f0"});
  return stream.add_convolution(weights.layer(s + "head"), y0);
}

int add_net_refinement(NetStream& stream, const NetWeights& weights, int input, int number) {
  const std::string r = net_refinement(number);
  const int i = add_chain(stream, weights, input, {r + "i.0", r + "i.1"});
  const int x0 = add_residual(stream, weights, i, r + "r0");
  const int d1 = add_chain(stream, weights, x0, {r + "d1.0", r + "d1.1", r + "d1.2", r + "d1.3"});
  const int x1 = add_residual(stream, weights, d1, r + "r1");
  const int y = stream.add_convolution(weights.layer(r + "u0"), x1);
  return add_chain(stream, weights, stream.add_enlarged(y, x0),
                   {r + "f0.0", r + "f0.1", r + "head"});
}

cuda::NetParts net_parts(const NetWeights& weights) {
  cuda::NetParts parts;
  NetStream volume, selection;
  constexpr int kLabels = 8;  // Of any number that is a multiple.
  const int evidence = add_unfilled(volume, kNetEvidence, kLabels);
  static_cast<void>(add_net_volume(volume, weights, evidence, add_unfilled(volume, kNetGuide)));
  parts.volume = steps_of(volume);
  static_cast<void>(
      add_net_selection(selection, weights, add_unfilled(selection, kNetSelectionInputs)));
  parts.selection = steps_of(selection);
  parts.selection_reduction = reduction_of(weights, kNetSelection);
  for (int i = 0; i < kNetRefinements; ++i) {
    NetStream refinement;
    static_cast<void>(
        add_net_refinement(refinement, weights, add_unfilled(refinement, kNetRefinementInputs), i));
    parts.refinements[i] = steps_of(refinement);
    parts.refinement_reductions[i] = reduction_of(weights, net_refinement(i));
  }
  return parts;
}

int net_label_count(Interval range) {
  const double steps = std::min(std::ceil(range.length() / kStepOfLabels - 1e-6), 63.0);
  return std::clamp((static_cast<int>(steps) + 1 + 7) / 8 * 8, 32, 64);
}

NetMaps estimate_net(const LightField& light_field, ViewIndex view, const NetWeights& weights,
                     const NetParameters& parameters, const Progress& progress,
                     const cuda::DeviceNet* device) {
  require_views(light_field, view);
  if (!(parameters.range.length() > 0) || parameters.rounds < 1) {
    throw InvalidInput(
        fmt::format("net needs a range of disparities and at least one round, but "
                    "was given {} to {} px and {}",
                    parameters.range.min, parameters.range.max, parameters.rounds));
  }
  if (device != nullptr) {
    cuda::NetTask task = device_task(light_field, view, parameters);
    task.labels = net_label_count(parameters.range);
    task.first = static_cast<float>(parameters.range.min);
    task.last = static_cast<float>(parameters.range.max);
    task.rounds = parameters.rounds;
    return run_on_device(*device, task, progress);
  }
  const NetScene scene{light_field, view, weights, net_guide(light_field, view), parameters.places};
  Beliefs beliefs = run_volume(scene, parameters.range, progress.part(0, 0.65));
  Selected selected;
  for (int round = 0; round < parameters.rounds; ++round) {
    const auto at = [&](double part) { return 0.65 + 0.25 * (round + part) / parameters.rounds; };
    const Hypotheses hypotheses =
        net_hypotheses(beliefs.own, beliefs.second, progress.part(at(0), at(0)));
    selected = run_selection(scene, hypotheses, &beliefs, progress.part(at(0), at(1)));
    beliefs.own = selected.mode;
    beliefs.second = selected.second;
  }
  return refine(scene, std::move(selected), parameters.silhouettes, progress.part(0.9, 1));
}

NetMaps polish_by_net(const LightField& light_field, ViewIndex view, const Image<float>& disparity,
                      const NetWeights& weights, const NetParameters& parameters,
                      const Progress& progress, const cuda::DeviceNet* device) {
  require_views(light_field, view);
  if (disparity.height() != light_field.height() || disparity.width() != light_field.width()) {
    throw InvalidInput(fmt::format("the map has {}×{} px, but views have {}×{}", disparity.width(),
                                   disparity.height(), light_field.width(), light_field.height()));
  }
  if (device != nullptr) {
    cuda::NetTask task = device_task(light_field, view, parameters);
    task.start = &disparity;
    return run_on_device(*device, task, progress);
  }
  const NetScene scene{light_field, view, weights, net_guide(light_field, view), parameters.places};
  const Hypotheses hypotheses = net_hypotheses(disparity, disparity, progress.part(0, 0));
  Selected selected = run_selection(scene, hypotheses, nullptr, progress.part(0, 0.5));
  return refine(scene, std::move(selected), parameters.silhouettes, progress.part(0.5, 1));
}

}  // namespace episcope
