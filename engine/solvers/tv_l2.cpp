// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/tv_l2.h"

#include "engine/core/error.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace episcope {

struct TvL2Solver::State {
  int height = 0, width = 0;
  std::vector<float> f, c, g, u, extrapolated, px, py;
};

TvL2Solver::TvL2Solver(int height, int width, Isa) : state_(std::make_unique<State>()) {
  if (height < 1 || width < 1) {
    throw InvalidInput("TV-L2 needs an image of at least one pixel, not " + std::to_string(width) +
                       " by " + std::to_string(height));
  }
  state_->height = height;
  state_->width = width;
}
TvL2Solver::~TvL2Solver() = default;
TvL2Solver::TvL2Solver(TvL2Solver&&) noexcept = default;

TvL2Result TvL2Solver::solve(const TvL2Problem& problem, const TvL2Options& options,
                             const Progress& progress, ImageView<float> u) {
  State& s = *state_;
  const int height = s.height, width = s.width, count = height * width;
  s.f.resize(count);
  s.c.resize(count);
  s.g.assign(count, 1.0F);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int i = y * width + x;
      const float f = problem.f.at(y, x);
      const bool known = std::isfinite(f);
      const float w = problem.w.empty() ? 1.0F : problem.w.at(y, x);
      s.f[i] = known ? f : 0.0F;
      s.c[i] = (known ? std::max(w, 1e-4F) : 1e-4F) / static_cast<float>(problem.lambda);
      if (!problem.g.empty()) s.g[i] = problem.g.at(y, x);
    }
  }
  s.u = s.extrapolated = s.f;
  s.px.assign(count, 0.0F);
  s.py.assign(count, 0.0F);
  const float tau = 0.3F, sigma = 0.4F;
  TvL2Result result;
  while (result.iterations < options.max_iterations && !result.converged) {
    progress.check();
    ++result.iterations;
    for (int y = 0, i = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x, ++i) {
        const float dx = x + 1 < width ? s.extrapolated[i + 1] - s.extrapolated[i] : 0.0F;
        const float dy = y + 1 < height ? s.extrapolated[i + width] - s.extrapolated[i] : 0.0F;
        const float a = s.px[i] + sigma * dx, b = s.py[i] + sigma * dy;
        const float scale = std::min(1.0F, s.g[i] / std::sqrt(a * a + b * b + 1e-30F));
        s.px[i] = a * scale;
        s.py[i] = b * scale;
        const float div = s.px[i] - (x ? s.px[i - 1] : 0) + s.py[i] - (y ? s.py[i - width] : 0);
        const float next = (s.u[i] + tau * (div + s.c[i] * s.f[i])) / (1 + tau * s.c[i]);
        s.extrapolated[i] = 2 * next - s.u[i];
        s.u[i] = next;
      }
    }
    if (result.iterations % options.check_every != 0) continue;
    double primal = 0, dual = 0;
    for (int y = 0, i = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x, ++i) {
        const double dx = x + 1 < width ? s.u[i + 1] - s.u[i] : 0.0F;
        const double dy = y + 1 < height ? s.u[i + width] - s.u[i] : 0.0F;
        const double div = s.px[i] - (x ? s.px[i - 1] : 0) + s.py[i] - (y ? s.py[i - width] : 0);
        const double off = s.u[i] - s.f[i];
        primal += s.g[i] * std::sqrt(dx * dx + dy * dy) + 0.5 * s.c[i] * off * off;
        dual -= s.f[i] * div + 0.5 * div * div / s.c[i];
      }
    }
    result.energy = primal;
    result.gap = primal - dual;
    result.converged = result.gap <= options.gap * primal;
  }
  for (int y = 0; y < height; ++y) std::copy_n(&s.u[static_cast<std::size_t>(y) * width], width, u.row(y));
  return result;
}

}  // namespace episcope
