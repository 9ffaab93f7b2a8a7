// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/tv_l2.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/solvers/shared_constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace episcope {
namespace {

constexpr int kPlanes = 10;

// Stands for "this edge exists" until `penalize` gives it its value.
constexpr float kOpenEdge = 1;

void open_edges(const TvL2Level& level) {
  const int evens = (level.width + 1) / 2, odds = level.width / 2;
  for (int y = 0; y < level.height; ++y) {
    const long at = y * level.pitch;
    const float down = y + 1 < level.height ? kOpenEdge : 0.0F;
    std::fill_n(level.rx + at, evens, kOpenEdge);
    std::fill_n(level.rx + at + level.odd, odds, kOpenEdge);
    level.rx[level.at(y, level.width - 1)] = 0;
    std::fill_n(level.ry + at, evens, down);
    std::fill_n(level.ry + at + level.odd, odds, down);
  }
}

// A row of cells between the coarse rows `here` and `beside`, in the order of their columns.
void blend_rows(const TvL2Level& level, const float* here, const float* beside, float share,
                float* out) {
  const auto blend = [=](long i) { return (1 - share) * here[i] + share * beside[i]; };
  const long odds = level.width / 2;
  for (long i = 0; i < odds; ++i) {
    out[2 * i] = blend(i);
    out[2 * i + 1] = blend(level.odd + i);
  }
  if (level.width > 2 * odds) out[2 * odds] = blend(odds);
}

// Cell centers: a pixel lies a quarter of a cell beside the center of its cell.
void stretch_centres(const float* cells, const TvL2Level& fine, float* out) {
  const int odds = fine.width / 2, evens = (fine.width + 1) / 2;
  float* const odd = out + fine.odd;
  const auto value = [=](int cell, int beside) {
    return 0.75F * cells[cell] + 0.25F * cells[beside];
  };
  out[0] = cells[0];
  for (int cell = 1; cell < evens; ++cell) out[cell] = value(cell, cell - 1);
  for (int cell = 0; cell + 1 < evens; ++cell) odd[cell] = value(cell, cell + 1);
  if (odds == evens) odd[odds - 1] = cells[odds - 1];
}

// Faces: the right face of a cell is that of its odd pixel; the even pixel's lies midway.
void stretch_faces(const float* cells, const TvL2Level& fine, float* out) {
  const int odds = fine.width / 2, evens = (fine.width + 1) / 2;
  std::copy_n(cells, odds, out + fine.odd);
  out[0] = 0.5F * cells[0];
  for (int cell = 1; cell < evens; ++cell) out[cell] = 0.5F * (cells[cell] + cells[cell - 1]);
}

// Data term and weights of a coarser image such that minimizing there approximates minimizing on
// `fine`: cells of 2×2, whose variation counts their side of 2 pixels.
void coarsen_problem(const TvL2Level& fine, const TvL2Level& coarse) {
  for (int y = 0; y < coarse.height; ++y) {
    const long below = 2 * y + 1 < fine.height ? fine.pitch : 0;
    for (int x = 0; x < coarse.width; ++x) {
      const long i = fine.at(2 * y, 2 * x);
      // Cells at an odd border count their pixels twice.
      const long right = 2 * x + 1 < fine.width ? fine.odd : 0;
      const auto sum = [=](const float* plane) {
        return plane[i] + plane[i + right] + plane[i + below] + plane[i + below + right];
      };
      const long to = coarse.at(y, x);
      coarse.c[to] = 0.5F * sum(fine.c);
      coarse.cf[to] = 0.5F * sum(fine.cf);
      coarse.g[to] = 0.25F * sum(fine.g);
    }
  }
}

// u = f, z = p = 0, rx and ry as `prolong`.
void start_from_data(const TvL2Level& level) {
  for (int y = 0; y < level.height; ++y) {
    for (int x = 0; x < level.width; ++x) {
      const long i = level.at(y, x);
      level.u[i] = level.cf[i] / level.c[i];
      level.zx[i] = level.zy[i] = 0;
    }
  }
  open_edges(level);
}

// Between Galerkin's coarse edges (1, always stable) and those right for smooth corrections (½),
// and ADMM's over-relaxation. Should the gap grow, the safe values take their place.
struct Pace {
  float coarse_edge = 0.75F;
  float relaxation = 1.7F;
};

constexpr Pace kSafePace = {kTvL2SafePace, kTvL2SafePace};

template <class T>
void require_shape(const ImageView<T>& image, int height, int width, const char* what) {
  if (image.height != height || image.width != width || image.channels != 1 || image.empty()) {
    throw InvalidInput(fmt::format("TV-L2 needs {} as one channel of {} by {}, not {} of {} by {}",
                                   what, width, height, image.channels, image.width, image.height));
  }
}

// Σ c, Σ c·f and Σ c·f² over pixels, in several sums at a time that processors can add together.
class Moments {
 public:
  void add(const float* c, const float* cf, int count) {
    for (int i = 0; i < count; ++i) {
      double* const sums = sums_[i % kSums].data();
      const double weight = c[i], value = cf[i];
      sums[0] += weight;
      sums[1] += value;
      sums[2] += value * value / weight;
    }
  }
  [[nodiscard]] double weight() const { return total(0); }
  [[nodiscard]] double sum() const { return total(1); }
  [[nodiscard]] double squares() const { return total(2); }

 private:
  static constexpr int kSums = 4;

  [[nodiscard]] double total(int which) const {
    double sum = 0;
    for (const auto& sums : sums_) sum += sums[which];
    return sum;
  }

  std::array<std::array<double, 3>, kSums> sums_{};
};

constexpr int kBandRows = 16;

void check_shape(ImageView<const float> image, ImageView<const float> f) {
  if (image.empty()) return;
  if (image.height == f.height && image.width == f.width && image.channels == 1) return;
  throw InvalidInput("TGV needs f, w, g and u of one size and one channel each");
}

void check(const TgvL2Problem& problem, ImageView<const float> u) {
  if (problem.f.empty() || u.empty())
    throw InvalidInput("TGV needs an image of at least one pixel");
  check_shape(problem.f, problem.f);
  check_shape(u, problem.f);
  check_shape(problem.w, problem.f);
  check_shape(problem.g, problem.f);
  if (!(problem.lambda > 0) || !(problem.bend > 0)) {
    throw InvalidInput("TGV needs a positive lambda and a positive bend");
  }
}

// Unknowns and duals of one image. q is the dual of ∇u − p, r of ℰp (xx, yy, and xy twice).
class Iteration {
 public:
  explicit Iteration(const TgvL2Problem& problem)
      : problem_(problem),
        height_(problem.f.height),
        width_(problem.f.width),
        u_(height_, width_),
        ahead_u_(height_, width_),
        p_(height_, 2 * width_),
        ahead_p_(height_, 2 * width_),
        q_(height_, 2 * width_),
        r_(height_, 3 * width_) {
    for (int y = 0; y < height_; ++y) {
      std::copy_n(problem.f.row(y), width_, u_.row(y));
      std::copy_n(problem.f.row(y), width_, ahead_u_.row(y));
    }
  }

  void run(const Progress& progress) {
    const int bands = (height_ + kBandRows - 1) / kBandRows;
    const auto each_row = [&](const auto& work) {
      parallel_for(bands, progress, [&](int band) {
        const FlushDenormals flush;
        const int end = std::min(height_, (band + 1) * kBandRows);
        for (int y = band * kBandRows; y < end; ++y) work(y);
      });
    };
    each_row([&](int y) { move_duals(y); });
    each_row([&](int y) { move_unknowns(y); });
  }

  [[nodiscard]] double energy() const {
    std::vector<double> rows(height_);
    for (int y = 0; y < height_; ++y) rows[y] = energy_of_row(y);
    return std::accumulate(rows.begin(), rows.end(), 0.0);
  }

  void copy_to(ImageView<float> out) const {
    for (int y = 0; y < height_; ++y) std::copy_n(u_.row(y), width_, out.row(y));
  }

 private:
  [[nodiscard]] float weight_of_variation(int y, int x) const {
    return problem_.g.empty() ? 1.0F : problem_.g.at(y, x);
  }
  [[nodiscard]] float weight_of_data(int y, int x) const {
    return problem_.w.empty() ? 1.0F : problem_.w.at(y, x);
  }

  struct Gradient {
    float x = 0, y = 0;
  };
  // ∇u − p.
  [[nodiscard]] Gradient slope_left(const Image<float>& u, const Image<float>& p, int y,
                                    int x) const {
    const float here = u.at(y, x);
    Gradient g;
    if (x + 1 < width_) g.x = u.at(y, x + 1) - here - p.at(y, x);
    if (y + 1 < height_) g.y = u.at(y + 1, x) - here - p.at(y, width_ + x);
    return g;
  }

  struct Bend {
    float xx = 0, yy = 0, xy = 0;
  };
  [[nodiscard]] Bend bend(const Image<float>& p, int y, int x) const {
    const float* const px = p.row(y);
    const float* const py = px + width_;
    const float* const above = y > 0 ? p.row(y - 1) : px;
    const int left = std::max(x - 1, 0);
    return {px[x] - px[left], py[x] - above[width_ + x],
            0.5F * (px[x] - above[x] + py[x] - py[left])};
  }

  void move_duals(int y) {
    const auto kappa = static_cast<float>(problem_.bend);
    float* const q = q_.row(y);
    float* const r = r_.row(y);
    for (int x = 0; x < width_; ++x) {
      const float limit = weight_of_variation(y, x);
      const Gradient slope = slope_left(ahead_u_, ahead_p_, y, x);
      const float qx = q[x] + kTgvStep * slope.x, qy = q[width_ + x] + kTgvStep * slope.y;
      const float shrink = 1 / std::max(1.0F, std::sqrt(qx * qx + qy * qy) / limit);
      q[x] = qx * shrink;
      q[width_ + x] = qy * shrink;
      const Bend b = bend(ahead_p_, y, x);
      const float xx = r[x] + kTgvStep * b.xx, yy = r[width_ + x] + kTgvStep * b.yy;
      const float xy = r[2 * width_ + x] + kTgvStep * b.xy;
      const float size = std::sqrt(xx * xx + yy * yy + 2 * xy * xy);
      const float shrink_r = 1 / std::max(1.0F, size / (kappa * limit));
      r[x] = xx * shrink_r;
      r[width_ + x] = yy * shrink_r;
      r[2 * width_ + x] = xy * shrink_r;
    }
  }

  // div q at (y, x): minus the adjoint of the forward difference.
  [[nodiscard]] float divergence(int y, int x) const {
    const float* const q = q_.row(y);
    float sum = x + 1 < width_ ? q[x] : 0;
    if (x > 0) sum -= q[x - 1];
    if (y + 1 < height_) sum += q[width_ + x];
    if (y > 0) sum -= q_.at(y - 1, width_ + x);
    return sum;
  }

  // Of r, minus the adjoint of ℰ: backward differences, none across the first row and column.
  [[nodiscard]] Gradient divergence_of_bend(int y, int x) const {
    const float* const r = r_.row(y);
    const float* const below = y + 1 < height_ ? r_.row(y + 1) : nullptr;
    const auto along = [&](int k) {
      return (x + 1 < width_ ? r[k * width_ + x + 1] : 0) - (x > 0 ? r[k * width_ + x] : 0);
    };
    const auto down = [&](int k) {
      return (below ? below[k * width_ + x] : 0) - (y > 0 ? r[k * width_ + x] : 0);
    };
    return {along(0) + down(2), along(2) + down(1)};
  }

  void move_unknowns(int y) {
    const float inverse_lambda = static_cast<float>(1 / problem_.lambda);
    float* const u = u_.row(y);
    float* const p = p_.row(y);
    const float* const q = q_.row(y);
    for (int x = 0; x < width_; ++x) {
      const float c = kTgvStep * inverse_lambda * weight_of_data(y, x);
      const float moved = (u[x] + kTgvStep * divergence(y, x) + c * problem_.f.at(y, x)) / (1 + c);
      ahead_u_.at(y, x) = 2 * moved - u[x];
      u[x] = moved;
      const Gradient b = divergence_of_bend(y, x);
      const float px = p[x] + kTgvStep * ((x + 1 < width_ ? q[x] : 0) + b.x);
      const float py = p[width_ + x] + kTgvStep * ((y + 1 < height_ ? q[width_ + x] : 0) + b.y);
      ahead_p_.at(y, x) = 2 * px - p[x];
      ahead_p_.at(y, width_ + x) = 2 * py - p[width_ + x];
      p[x] = px;
      p[width_ + x] = py;
    }
  }

  [[nodiscard]] double energy_of_row(int y) const {
    double sum = 0;
    for (int x = 0; x < width_; ++x) {
      const float g = weight_of_variation(y, x);
      const Gradient s = slope_left(u_, p_, y, x);
      const Bend b = bend(p_, y, x);
      const double off = u_.at(y, x) - problem_.f.at(y, x);
      sum += g * std::sqrt(s.x * s.x + s.y * s.y) +
             problem_.bend * g * std::sqrt(b.xx * b.xx + b.yy * b.yy + 2 * b.xy * b.xy) +
             0.5 / problem_.lambda * weight_of_data(y, x) * off * off;
    }
    return sum;
  }

  const TgvL2Problem& problem_;
  int height_, width_;
  Image<float> u_, ahead_u_, p_, ahead_p_, q_, r_;
};

}  // namespace

TvL2Grid::TvL2Grid(int height, int width) {
  level.height = height;
  level.width = width;
  level.odd = round_up((width + 1) / 2, kTvL2RowUnit) + kTvL2Margin;
  level.pitch = 2 * level.odd;
  const std::size_t plane = static_cast<std::size_t>(height + 3) * level.pitch + kTvL2Margin;
  const std::size_t size = kPlanes * plane + 2 * level.pitch + 2 * kTvL2Margin;
  memory_ = make_large<float>(size);
  std::fill_n(memory_.get(), size, 0.0F);
  float* next = memory_.get() + level.pitch + kTvL2Margin;
  for (float** to : {&level.cf, &level.c, &level.g, &level.u, &level.zx, &level.zy, &level.rx,
                     &level.ry, &level.inverse, &level.b}) {
    *to = next;
    next += plane;
  }
  row = next;
}

void prolong(const TvL2Level& coarse, const TvL2Level& fine) {
  std::vector<float> row(coarse.width);
  const int last = coarse.height - 1;
  for (int y = 0; y < fine.height; ++y) {
    const bool lower = (y & 1) != 0;
    const long cell = y / 2 * coarse.pitch;
    const long beside = (lower ? std::min(y / 2 + 1, last) : std::max(y / 2 - 1, 0)) * coarse.pitch;
    const long to = y * fine.pitch;
    blend_rows(coarse, coarse.u + cell, coarse.u + beside, 0.25F, row.data());
    stretch_centres(row.data(), fine, fine.u + to);
    blend_rows(coarse, coarse.zx + cell, coarse.zx + beside, 0.25F, row.data());
    stretch_faces(row.data(), fine, fine.zx + to);
    fine.zx[fine.at(y, fine.width - 1)] = 0;
    // The row above the first one is padding: p = 0 there.
    const float* const below = coarse.zy + cell;
    blend_rows(coarse, below, lower ? below : below - coarse.pitch, 0.5F, row.data());
    if (y + 1 == fine.height) std::fill(row.begin(), row.end(), 0.0F);
    stretch_centres(row.data(), fine, fine.zy + to);
  }
  open_edges(fine);
}

struct TvL2Solver::State {
  const TvL2Kernel& kernel;
  const TvL2PenaltyKernel& penalties;
  std::vector<TvL2Grid> grids;
  float offset = 0;  // weighted mean of f, taken off for the sake of float32
  TvL2Penalty penalty;
  Pace pace;
  bool paused = true;  // whether z of the level being solved is z itself: TvL2Step

  State(int height, int width, Isa isa);
  void load(const TvL2Problem& problem);
  void center(const Moments& moments);
  void renew_penalty(std::size_t stage, bool first);
  void correct(std::size_t stage);
  void iterate(std::size_t stage, int iteration, bool pauses, const Progress& progress);
  void climb(const Progress& progress);
  TvL2Result finish(const TvL2Options& options, const Progress& progress);
  void copy_to(ImageView<float> u) const;
};

TvL2Solver::State::State(int height, int width, Isa isa)
    : kernel(EPISCOPE_CHOOSE_KERNEL(isa, kTvL2Kernel)),
      penalties(EPISCOPE_CHOOSE_KERNEL(isa, kTvL2PenaltyKernel)) {
  grids.emplace_back(height, width);
  // Down to a single pixel, whose equation is the mean of all: no smoother would ever find that.
  while (std::max(height, width) > 1 || grids.size() < 2) {
    height = (height + 1) / 2;
    width = (width + 1) / 2;
    grids.emplace_back(height, width);
  }
}

void TvL2Solver::State::load(const TvL2Problem& problem) {
  const TvL2Level& level = grids[0].level;
  const float inverse_lambda = static_cast<float>(1 / problem.lambda);
  Moments moments;
  for (int y = 0; y < level.height; ++y) {
    const float* const f = problem.f.row(y);
    const float* const w = problem.w.empty() ? nullptr : problem.w.row(y);
    const float* const g = problem.g.empty() ? nullptr : problem.g.row(y);
    for (int odd = 0; odd < 2; ++odd) {
      const int count = (level.width + 1 - odd) / 2;
      const long at = y * level.pitch + odd * level.odd;
      for (int i = 0; i < count; ++i) {
        const float value = f[2 * i + odd];
        const bool known = std::abs(value) <= std::numeric_limits<float>::max();
        const float weight = known ? (w != nullptr ? w[2 * i + odd] : 1.0F) : 0.0F;
        level.c[at + i] = std::max(weight, kTvL2MinWeight) * inverse_lambda;
        level.cf[at + i] = known ? level.c[at + i] * value : 0.0F;
        level.g[at + i] = g != nullptr ? std::max(g[2 * i + odd], kTvL2MinWeight) : 1.0F;
      }
      moments.add(level.c + at, level.cf + at, count);
    }
  }
  center(moments);
  for (std::size_t k = 1; k < grids.size(); ++k)
    coarsen_problem(grids[k - 1].level, grids[k].level);
}

void TvL2Solver::State::center(const Moments& moments) {
  const TvL2Level& level = grids[0].level;
  const double weight = moments.weight(), mean = moments.sum() / weight;
  offset = static_cast<float>(mean);
  const double variance = moments.squares() / weight - mean * mean;
  const float spread = variance > 1e-12 ? static_cast<float>(std::sqrt(variance)) : 1.0F;
  for (int y = 0; y < level.height; ++y) {
    for (int odd = 0; odd < 2; ++odd) {
      const long at = y * level.pitch + odd * level.odd;
      for (int i = 0; i < (level.width + 1 - odd) / 2; ++i) {
        level.cf[at + i] -= offset * level.c[at + i];
      }
    }
  }
  penalty = {kTvL2PenaltyScale / spread, kTvL2PenaltyKnee * spread, kTvL2PenaltySpread, false};
}

void TvL2Solver::State::renew_penalty(std::size_t stage, bool first) {
  TvL2Level& level = grids[stage].level;
  penalty.first = first;
  penalties.penalise(level, penalty);
  level.data_scale = 1;
  penalties.invert_diagonal(level);
  for (std::size_t k = stage + 1; k < grids.size(); ++k) {
    // A multigrid cell weighs as much as its pixels together; coarsen_problem halves that.
    grids[k].level.data_scale = 2 * grids[k - 1].level.data_scale;
    penalties.coarsen_penalty(grids[k - 1].level, grids[k].level, pace.coarse_edge);
    penalties.invert_diagonal(grids[k].level);
  }
}

void TvL2Solver::State::correct(std::size_t stage) {
  const std::size_t last = grids.size() - 1;
  for (std::size_t k = stage + 1; k < last; ++k) {
    kernel.descend(grids[k].level, grids[k + 1].level);
  }
  kernel.solve(grids[last].level);
  for (std::size_t k = last; --k > stage;) kernel.ascend(grids[k].level, grids[k + 1].level);
}

void TvL2Solver::State::iterate(std::size_t stage, int iteration, bool pauses,
                                const Progress& progress) {
  progress.check();
  if (iteration % kTvL2PenaltyEvery == 0) renew_penalty(stage, iteration == 0);
  if (iteration > 0) correct(stage);
  pauses = pauses || (iteration + 1) % kTvL2PenaltyEvery == 0;
  kernel.iterate(grids[stage].level, grids[stage + 1].level,
                 {pace.relaxation, iteration == 0, !paused, pauses, grids[stage].row});
  paused = pauses;
}

// Coarse to fine, up to the start of the finest level.
void TvL2Solver::State::climb(const Progress& progress) {
  pace = {};
  paused = true;
  // The single pixel below has no level to correct it.
  std::size_t stage = grids.size() - 2;
  start_from_data(grids[stage].level);
  for (; stage > 0; --stage) {
    for (int i = 0; i < kTvL2CoarseCycles; ++i) {
      iterate(stage, i, i + 1 == kTvL2CoarseCycles, progress);
    }
    penalties.project(grids[stage].level);
    prolong(grids[stage].level, grids[stage - 1].level);
    penalties.project(grids[stage - 1].level);
  }
}

TvL2Result TvL2Solver::State::finish(const TvL2Options& options, const Progress& progress) {
  const int check_every = std::max(1, options.check_every);
  TvL2Result result;
  double gap_before = std::numeric_limits<double>::infinity();
  bool is_last = false;
  while (!is_last && !result.converged) {
    is_last = result.iterations + 1 >= options.max_iterations || progress.finish_requested();
    const bool checks = is_last || (result.iterations + 1) % check_every == 0;
    iterate(0, result.iterations++, checks, progress);
    if (!checks) continue;
    const TvL2Sums sums = penalties.measure(grids[0].level, grids[0].row);
    result.energy = sums.energy;
    result.gap = sums.energy - sums.dual;
    result.converged = result.gap <= options.gap * sums.energy;
    if (result.gap > 2 * gap_before) {
      pace = kSafePace;
      renew_penalty(0, false);
    }
    gap_before = result.gap;
  }
  return result;
}

void TvL2Solver::State::copy_to(ImageView<float> u) const {
  const TvL2Level& level = grids[0].level;
  for (int y = 0; y < level.height; ++y) {
    for (int odd = 0; odd < 2; ++odd) {
      const float* const from = level.u + level.at(y, odd);
      float* const to = u.row(y) + odd;
      for (int i = 0; i < (level.width + 1 - odd) / 2; ++i) to[2 * i] = from[i] + offset;
    }
  }
}

TvL2Solver::TvL2Solver(int height, int width, Isa isa) {
  if (height < 1 || width < 1) {
    throw InvalidInput(
        fmt::format("TV-L2 needs an image of at least one pixel, not {} by {}", width, height));
  }
  state_ = std::make_unique<State>(height, width, isa);
}
TvL2Solver::~TvL2Solver() = default;
TvL2Solver::TvL2Solver(TvL2Solver&&) noexcept = default;

TvL2Result TvL2Solver::solve(const TvL2Problem& problem, const TvL2Options& options,
                             const Progress& progress, ImageView<float> u) {
  State& state = *state_;
  const TvL2Level& finest = state.grids[0].level;
  require_shape(problem.f, finest.height, finest.width, "f");
  require_shape(u, finest.height, finest.width, "u");
  if (!problem.w.empty()) require_shape(problem.w, finest.height, finest.width, "w");
  if (!problem.g.empty()) require_shape(problem.g, finest.height, finest.width, "g");
  if (!(problem.lambda > 0)) throw InvalidInput("TV-L2 needs a positive lambda");
  const FlushDenormals flush;
  state.load(problem);
  state.climb(progress);
  const TvL2Result result = state.finish(options, progress);
  state.copy_to(u);
  return result;
}

TvL2Result segment_binary(TvL2Solver& solver, const BinarySegmentationProblem& problem,
                          const TvL2Options& options, const Progress& progress,
                          ImageView<float> scratch, ImageView<std::uint8_t> region) {
  const TvL2Result result = solver.solve(
      {problem.score, problem.weight, problem.border, problem.lambda}, options, progress, scratch);
  if (region.height != scratch.height || region.width != scratch.width || region.channels != 1) {
    throw InvalidInput("the region and the score of a segmentation must have the same size");
  }
  for (int y = 0; y < region.height; ++y) {
    const float* const from = scratch.row(y);
    std::uint8_t* const to = region.row(y);
    for (int x = 0; x < region.width; ++x) to[x] = from[x] > 0 ? 1 : 0;
  }
  return result;
}

TgvL2Result solve_tgv_l2(const TgvL2Problem& problem, int iterations, const Progress& progress,
                         ImageView<float> u) {
  check(problem, u);
  Iteration state(problem);
  TgvL2Result result;
  const Progress silent = progress.part(0, 0);
  while (result.iterations < iterations && !progress.finish_requested()) {
    state.run(silent);
    ++result.iterations;
    progress.report(static_cast<double>(result.iterations) / iterations);
  }
  result.energy = state.energy();
  state.copy_to(u);
  return result;
}

}  // namespace episcope
