// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/simplex/simplex_batch.cuh"
#include "engine/cuda/simplex/simplex_levels.cuh"
#include "engine/cuda/simplex/simplex_moves.cuh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace episcope::cuda {
namespace {

// As in simplex_labeling.cpp.
constexpr int kMinSide = 16;
constexpr int kCoarseIterations = 30;
// Floats of each unknown: costs, ahead, u and its duals; what is taken over is u and duals.
constexpr std::size_t kKeptFloats = 1 + kSimplexPairs;
constexpr std::size_t kFloats = 2 + kKeptFloats;

double gap_of(const SimplexAnswer& answer) {
  const double difference = answer.relaxed - answer.bound;
  return difference == 0 ? 0 : difference / std::abs(answer.relaxed);
}

// u and duals lie one after the other, `size` apart.
void place_unknowns(float* memory, std::size_t size, SimplexFields& fields) {
  fields.u = memory;
  for (std::size_t k = 0; k < kSimplexPairs; ++k) fields.duals[k] = memory + (k + 1) * size;
}

}  // namespace

std::size_t SimplexBatch::bytes_of_problem(int height, int layers, int width) {
  const std::size_t pixels = static_cast<std::size_t>(height) * static_cast<std::size_t>(width);
  // Coarser levels add a third.
  const std::size_t unknowns = pixels * static_cast<std::size_t>(layers);
  return sizeof(float) * (unknowns * (kFloats * 4 / 3 + 1 + kKeptFloats) + 5 * pixels);
}

SimplexBatch::Level::Level(int problems, int height, int layers, int width,
                           const DeviceStream& stream) {
  fields.problems = problems;
  fields.height = height;
  fields.layers = layers;
  fields.width = width;
  const std::size_t size = fields.size();
  const std::size_t pixels =
      static_cast<std::size_t>(problems) * static_cast<std::size_t>(fields.pixels());
  memory = {size * kFloats + pixels, stream};
  place_unknowns(memory.data(), size, fields);
  fields.cost = memory.data() + kKeptFloats * size;
  fields.ahead = fields.cost + size;
  fields.weights = fields.ahead + size;
}

SimplexBatch::SimplexBatch(int problems, int height, int layers, int width,
                           const DeviceStream& stream)
    : stream_(stream) {
  levels_.emplace_back(problems, height, layers, width, stream);
  while (std::min(height, width) >= 2 * kMinSide) {
    height = (height + 1) / 2;
    width = (width + 1) / 2;
    levels_.emplace_back(problems, height, layers, width, stream);
  }
  unknowns_ = fields().size();
  const auto pixels = static_cast<std::size_t>(fields().pixels() * problems);
  labels_ = {pixels, stream};
  best_ = {pixels, stream};
  moved_labels_ = {pixels, stream};
  partial_ = {partial_sums(fields()), stream};
  measures_ = {static_cast<std::size_t>(problems), stream};
  race_ = {fields(), stream};
}

// Each pixel is in 8 pairs, so |K|² ≤ 16; as in simplex_labeling.cpp.
void SimplexBatch::set_steps(double smoothness, SimplexFields& fields) const {
  const double dual_size = std::min(smoothness, std::sqrt(smoothness));
  fields.primal_step = static_cast<float>(1 / (2 * dual_size));
  fields.dual_step = static_cast<float>(dual_size / 8);
  fields.limit = static_cast<float>(smoothness / 2);
}

void SimplexBatch::start(double smoothness) {
  for (std::size_t k = 1; k < levels_.size(); ++k) {
    halve_problems(levels_[k - 1].fields, levels_[k].fields, stream_);
  }
  begin_from_cheapest(levels_.back().fields, stream_);
  for (std::size_t k = levels_.size(); k-- > 1;) {
    SimplexFields& fields = levels_[k].fields;
    set_steps(std::ldexp(smoothness, -static_cast<int>(k)), fields);
    for (int i = 0; i < kCoarseIterations; ++i) move_simplex(fields, 0, nullptr, stream_);
    begin_from_coarse(fields, levels_[k - 1].fields, stream_);
  }
}

// What the call before left is moved to where this one begins.
void SimplexBatch::take_over(const std::int32_t* places) {
  SimplexFields& fields = levels_.front().fields;
  if (last_.empty()) last_ = {unknowns_ * kKeptFloats, stream_};
  SimplexFields to = fields;
  const bool is_in_last = fields.u == last_.data();
  place_unknowns(is_in_last ? levels_.front().memory.data() : last_.data(), unknowns_, to);
  begin_from_moved(fields, places, to, stream_);
  fields = to;
}

// Those of the labels reached so far take part in any case: of the call before, or of the coarser
// levels.
void SimplexBatch::choose_layers(const std::int32_t* places, float behind) {
  if (places != nullptr) {
    move_labels(fields(), labels_.data(), places, moved_labels_.data(), stream_);
  } else {
    read_labels(fields(), 0, moved_labels_.data(), stream_);
  }
  race_.choose(fields(), moved_labels_.data(), behind, stream_);
}

void SimplexBatch::measure(int count, SolvedMask solved, std::vector<SimplexAnswer>& answers) {
  measure_simplex(fields(), solved, labels_.data(), partial_.data(), measures_.data(), stream_);
  std::vector<SimplexMeasure> measured(static_cast<std::size_t>(count));
  check(cudaMemcpyAsync(measured.data(), measures_.data(), measured.size() * sizeof(SimplexMeasure),
                        cudaMemcpyDeviceToHost, stream_.get()));
  stream_.wait();
  for (int problem = 0; problem < count; ++problem) {
    if ((solved >> problem & 1U) != 0) continue;
    const auto [bound, relaxed, energy] = measured[static_cast<std::size_t>(problem)];
    SimplexAnswer& answer = answers[static_cast<std::size_t>(problem)];
    answer.bound = std::max(answer.bound, bound);
    // A labeling is a u as well, and often better than the one it was read from.
    answer.relaxed = std::min({answer.relaxed, relaxed, energy});
    if (energy >= answer.energy) continue;
    answer.energy = energy;
    const long first = fields().pixels() * problem;
    check(cudaMemcpyAsync(best_.data() + first, labels_.data() + first,
                          static_cast<std::size_t>(fields().pixels()) * sizeof(std::int32_t),
                          cudaMemcpyDeviceToDevice, stream_.get()));
  }
}

std::vector<SimplexAnswer> SimplexBatch::solve(int count, const std::int32_t* places,
                                               const SimplexSettings& settings,
                                               const Progress& progress) {
  for (Level& level : levels_) level.fields.problems = count;
  if (places != nullptr) {
    take_over(places);
  } else {
    start(settings.smoothness);
  }
  set_steps(settings.smoothness, levels_.front().fields);
  if (settings.racing_iterations > 0) choose_layers(places, settings.behind);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<SimplexAnswer> answers(static_cast<std::size_t>(count),
                                     {0, kInfinity, kInfinity, -kInfinity});
  const SolvedMask all = count == kMostProblems ? ~SolvedMask{0} : (SolvedMask{1} << count) - 1;
  SolvedMask solved = ~all;
  for (int iteration = 1; solved != ~SolvedMask{0}; ++iteration) {
    progress.check();
    const bool races = iteration <= settings.racing_iterations;
    move_simplex(fields(), solved, races ? &race_.race() : nullptr, stream_);
    const bool is_last = iteration >= settings.max_iterations || progress.finish_requested();
    const bool is_due = !races && iteration % std::max(1, settings.check_every) == 0;
    if (!is_last && !is_due) continue;
    measure(count, solved, answers);
    for (int problem = 0; problem < count; ++problem) {
      SimplexAnswer& answer = answers[static_cast<std::size_t>(problem)];
      if ((solved >> problem & 1U) != 0) continue;
      answer.iterations = iteration;
      if (is_last || gap_of(answer) <= settings.gap) solved |= SolvedMask{1} << problem;
    }
  }
  return answers;
}

}  // namespace episcope::cuda
