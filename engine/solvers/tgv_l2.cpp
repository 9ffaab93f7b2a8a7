// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/tgv_l2.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/solvers/shared_constants.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace episcope {
namespace {

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

TgvL2Result solve_tgv_l2(const TgvL2Problem& problem, int iterations, const Progress& progress,
                         ImageView<float> u) {
  check(problem, u);
  Iteration state(problem);
  TgvL2Result result;
  result.start_energy = state.energy();
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
