// SPDX-License-Identifier: BSD-3-Clause

#include "engine/cuda/device.cuh"
#include "engine/cuda/simplex_moves.cuh"
#include "engine/solvers/shared_constants.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope::cuda {
namespace {

constexpr int kThreads = 128;

struct Place {
  int problem, y, x;
  bool inside;
};

__device__ Place place_of(const SimplexFields& fields) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  return {static_cast<int>(blockIdx.z), static_cast<int>(blockIdx.y), x, x < fields.width};
}

dim3 blocks(const SimplexFields& fields) {
  return dim3(blocks_for(fields.width, kThreads), static_cast<unsigned>(fields.height),
              static_cast<unsigned>(fields.problems));
}

// Of the two or four values under a coarse one, `below` and `beside` the way to the next.
__device__ float halved(const float* from, long beside, long below) {
  if (beside == 0) return 0.5F * (from[0] + from[below]);
  return 0.25F * (from[0] + from[beside] + from[below] + from[below + beside]);
}

__global__ void halve(SimplexFields fine, SimplexFields coarse) {
  const auto [problem, y, x, inside] = place_of(coarse);
  if (!inside) return;
  const bool has_below = 2 * y + 1 < fine.height;
  const long beside = 2 * x + 1 < fine.width ? 1 : 0;
  coarse.weights[coarse.pixel(problem, y, x)] =
      halved(fine.weights + fine.pixel(problem, 2 * y, 2 * x), beside, has_below ? fine.width : 0);
  const long from = fine.unknown(problem, 2 * y, 2 * x), to = coarse.unknown(problem, y, x);
  for (int l = 0; l < fine.layers; ++l) {
    coarse.cost[to + static_cast<long>(l) * coarse.width] = halved(
        fine.cost + from + static_cast<long>(l) * fine.width, beside, has_below ? fine.row() : 0);
  }
}

__global__ void take_cheapest(SimplexFields fields) {
  const auto [problem, y, x, inside] = place_of(fields);
  if (!inside) return;
  const long first = fields.unknown(problem, y, x);
  int best = 0;
  for (int l = 1; l < fields.layers; ++l) {
    const long i = first + static_cast<long>(l) * fields.width;
    if (fields.cost[i] < fields.cost[first + static_cast<long>(best) * fields.width]) best = l;
  }
  for (int l = 0; l < fields.layers; ++l) {
    const long i = first + static_cast<long>(l) * fields.width;
    fields.u[i] = l == best ? 1.0F : 0.0F;
    for (float* const dual : fields.duals) dual[i] = 0;
  }
}

// Pairs that lead to the end within a coarse pixel: the flow between that which enters it and that
// which leaves.
__global__ void spread(SimplexFields coarse, SimplexFields fine) {
  const auto [problem, y, x, inside] = place_of(fine);
  if (!inside) return;
  const long from = coarse.unknown(problem, y / 2, x / 2), to = fine.unknown(problem, y, x);
  const bool has_left = x / 2 > 0, has_above = y / 2 > 0;
  for (int l = 0; l < fine.layers; ++l) {
    const long i = from + static_cast<long>(l) * coarse.width;
    const long o = to + static_cast<long>(l) * fine.width;
    const float right = coarse.duals[0][i], down = coarse.duals[1][i];
    const float left = x % 2 != 0 ? right : has_left ? coarse.duals[0][i - 1] : 0.0F;
    const float above = y % 2 != 0 ? down : has_above ? coarse.duals[1][i - coarse.row()] : 0.0F;
    fine.u[o] = coarse.u[i];
    fine.duals[0][o] = right + left;
    fine.duals[1][o] = down + above;
    fine.duals[2][o] = 2.0F * coarse.duals[2][i];
    fine.duals[3][o] = 2.0F * coarse.duals[3][i];
  }
}

__global__ void gather(SimplexFields from, const std::int32_t* places, SimplexFields to) {
  const auto [problem, y, x, inside] = place_of(to);
  if (!inside) return;
  const std::int32_t named = places[to.pixel(problem, y, x)];
  const int width = to.width;
  const long source =
      named < 0 ? from.unknown(problem, y, x) : from.unknown(problem, named / width, named % width);
  const long target = to.unknown(problem, y, x);
  for (int l = 0; l < to.layers; ++l) {
    const long layer = static_cast<long>(l) * width;
    to.u[target + layer] = from.u[source + layer];
    for (int k = 0; k < kPairKinds; ++k) {
      to.duals[k][target + layer] = from.duals[k][source + layer];
    }
  }
}

__global__ void find_near(SimplexFields fields, const std::int32_t* labels, float behind,
                          SimplexRace race) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const auto y = static_cast<int>(blockIdx.y), problem = static_cast<int>(blockIdx.z);
  if (x >= fields.width) return;
  const float* const cost = fields.cost + fields.unknown(problem, y, x);
  float least = cost[0];
  for (int l = 1; l < fields.layers; ++l) {
    least = fminf(least, cost[static_cast<long>(l) * fields.width]);
  }
  const int label = labels[fields.pixel(problem, y, x)];
  std::uint8_t* const near =
      race.near + race.tile(problem, y / kRaceRows, x / kRaceColumns) * race.layers;
  for (int l = 0; l < fields.layers; ++l) {
    // All that write there write the same.
    if (l == label || cost[static_cast<long>(l) * fields.width] - least < behind) near[l] = 1;
  }
}

__device__ bool is_near(const SimplexRace& race, int problem, int first_row, int last_row,
                        int first_column, int last_column, int layer) {
  for (int row = max(first_row, 0); row <= min(last_row, race.down - 1); ++row) {
    for (int column = first_column; column <= min(last_column, race.across - 1); ++column) {
      if (race.near[race.tile(problem, row, column) * race.layers + layer] != 0) return true;
    }
  }
  return false;
}

// A thread for each tile.
__global__ void list_layers(SimplexRace race) {
  const int column = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const auto row = static_cast<int>(blockIdx.y), problem = static_cast<int>(blockIdx.z);
  if (column >= race.across) return;
  std::uint16_t* const moving =
      race.lists + race.list_begin(problem, row, column, SimplexRace::Moving);
  std::uint16_t* const paired =
      race.lists + race.list_begin(problem, row, column, SimplexRace::Paired);
  int moving_count = 0, paired_count = 0;
  for (int l = 0; l < race.layers; ++l) {
    // What moves in the tile, and in those to the right and below.
    if (is_near(race, problem, row - 1, row + 1, column, column, l)) {
      moving[++moving_count] = static_cast<std::uint16_t>(l);
    }
    if (is_near(race, problem, row - 1, row + 2, column, column + 1, l)) {
      paired[++paired_count] = static_cast<std::uint16_t>(l);
    }
  }
  moving[0] = static_cast<std::uint16_t>(moving_count);
  paired[0] = static_cast<std::uint16_t>(paired_count);
}

__global__ void clear_others(SimplexFields fields, SimplexRace race) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const auto y = static_cast<int>(blockIdx.y), problem = static_cast<int>(blockIdx.z);
  if (x >= fields.width) return;
  const std::uint16_t* const moving = race.list(problem, y, x, SimplexRace::Moving);
  const std::uint16_t* const paired = race.list(problem, y, x, SimplexRace::Paired);
  int next_moving = 1, next_paired = 1;
  for (int l = 0; l < fields.layers; ++l) {
    const long i = fields.unknown(problem, y, x) + static_cast<long>(l) * fields.width;
    fields.ahead[i] = 0;
    if (next_moving <= moving[0] && moving[next_moving] == l) {
      ++next_moving;
    } else {
      fields.u[i] = 0;
    }
    if (next_paired <= paired[0] && paired[next_paired] == l) {
      ++next_paired;
      continue;
    }
    for (float* const dual : fields.duals) dual[i] = 0;
  }
}

__global__ void take_labels(SimplexFields fields, const std::int32_t* labels,
                            const std::int32_t* places, std::int32_t* moved) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const auto y = static_cast<int>(blockIdx.y), problem = static_cast<int>(blockIdx.z);
  if (x >= fields.width) return;
  const long at = fields.pixel(problem, y, x);
  moved[at] = places[at] < 0 ? labels[at] : labels[fields.pixel(problem, 0, 0) + places[at]];
}

// Floats of each unknown: costs, ahead, u and its duals; what is taken over is u and duals.
constexpr std::size_t kKeptFloats = 1 + kPairKinds;
constexpr std::size_t kFloats = 2 + kKeptFloats;

double gap_of(const SimplexAnswer& answer) {
  const double difference = answer.relaxed - answer.bound;
  return difference == 0 ? 0 : difference / std::abs(answer.relaxed);
}

// u and duals lie one after the other, `size` apart.
void place_unknowns(float* memory, std::size_t size, SimplexFields& fields) {
  fields.u = memory;
  for (std::size_t k = 0; k < kPairKinds; ++k) fields.duals[k] = memory + (k + 1) * size;
}

}  // namespace

void halve_problems(const SimplexFields& fine, const SimplexFields& coarse,
                    const DeviceStream& stream) {
  const auto values = static_cast<double>(fine.size());
  launch(stream, {"labels: halve", 5 * values, values},
         [&] { halve<<<blocks(coarse), kThreads, 0, stream.get()>>>(fine, coarse); });
}

void begin_from_cheapest(const SimplexFields& fields, const DeviceStream& stream) {
  const auto values = static_cast<double>(fields.size());
  launch(stream, {"labels: cheapest", 24 * values, values},
         [&] { take_cheapest<<<blocks(fields), kThreads, 0, stream.get()>>>(fields); });
}

void begin_from_coarse(const SimplexFields& coarse, const SimplexFields& fine,
                       const DeviceStream& stream) {
  const auto values = static_cast<double>(fine.size());
  launch(stream, {"labels: from coarse", 25 * values, 4 * values},
         [&] { spread<<<blocks(fine), kThreads, 0, stream.get()>>>(coarse, fine); });
}

void begin_from_moved(const SimplexFields& from, const std::int32_t* places,
                      const SimplexFields& to, const DeviceStream& stream) {
  const auto values = static_cast<double>(to.size());
  launch(stream, {"labels: from last view", 40 * values, 0},
         [&] { gather<<<blocks(to), kThreads, 0, stream.get()>>>(from, places, to); });
}

SimplexRaceMemory::SimplexRaceMemory(const SimplexFields& fields, const DeviceStream& stream) {
  race_.across = static_cast<int>(blocks_for(fields.width, kRaceColumns));
  race_.down = static_cast<int>(blocks_for(fields.height, kRaceRows));
  race_.layers = fields.layers;
  const auto tiles = static_cast<std::size_t>(race_.tile(fields.problems, 0, 0));
  near_ = {tiles * static_cast<std::size_t>(fields.layers), stream};
  lists_ = {tiles * SimplexRace::Kinds * (static_cast<std::size_t>(fields.layers) + 1), stream};
  race_.near = near_.data();
  race_.lists = lists_.data();
}

void SimplexRaceMemory::choose(const SimplexFields& fields, const std::int32_t* labels,
                               float behind, const DeviceStream& stream) {
  const auto values = static_cast<double>(fields.size());
  near_.clear();
  launch(stream, {"labels: near ones", 8 * values, 2 * values}, [&] {
    find_near<<<blocks(fields), kThreads, 0, stream.get()>>>(fields, labels, behind, race_);
  });
  const dim3 tiles(blocks_for(race_.across, kThreads), static_cast<unsigned>(race_.down),
                   static_cast<unsigned>(fields.problems));
  launch(stream, {"labels: lists of near ones", static_cast<double>(near_.size()), 0},
         [&] { list_layers<<<tiles, kThreads, 0, stream.get()>>>(race_); });
  launch(stream, {"labels: leave out far ones", 24 * values, 0},
         [&] { clear_others<<<blocks(fields), kThreads, 0, stream.get()>>>(fields, race_); });
}

void move_labels(const SimplexFields& fields, const std::int32_t* labels,
                 const std::int32_t* places, std::int32_t* moved, const DeviceStream& stream) {
  const double pixels = static_cast<double>(fields.pixels()) * fields.problems;
  launch(stream, {"labels: of last view", 12 * pixels, 0}, [&] {
    take_labels<<<blocks(fields), kThreads, 0, stream.get()>>>(fields, labels, places, moved);
  });
}

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
  while (std::min(height, width) >= 2 * kSimplexMinSide) {
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
    for (int i = 0; i < kSimplexCoarseMoves; ++i) move_simplex(fields, 0, nullptr, stream_);
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
