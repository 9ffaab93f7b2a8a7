// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/planes/plane_labeling.h"

#include "engine/core/error.h"
#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace episcope {
namespace {

constexpr float kDiagonal = 0.70710678F;
constexpr int kRandomCandidates = 2;

struct Way {
  int y = 0, x = 0;
  float share = 1;
};
constexpr Way kWays[] = {{0, 1, 1},          {0, -1, 1},         {1, 0, 1},
                         {-1, 0, 1},         {1, 1, kDiagonal},  {1, -1, kDiagonal},
                         {-1, 1, kDiagonal}, {-1, -1, kDiagonal}};

void check(const PlaneProblem& problem, ImageView<const Plane> planes) {
  const auto& cost = problem.cost;
  const bool fits =
      !cost.empty() && planes.height == cost.height && planes.width == cost.width &&
      (problem.g.empty() || (problem.g.height == cost.height && problem.g.width == cost.width));
  if (!fits) throw InvalidInput("planes, costs and weights must be of one size");
  if (cost.layers < 4 || !(problem.step > 0) || !(problem.truncation > 0)) {
    throw InvalidInput("planes need at least 4 labels, a positive step and a positive truncation");
  }
}

// A number in [−1, 1) from integers (the finaliser of MurmurHash3).
float noise(std::uint32_t key) {
  key ^= key >> 16;
  key *= 0x85ebca6bU;
  key ^= key >> 13;
  key *= 0xc2b2ae35U;
  key ^= key >> 16;
  return static_cast<float>(key) * (2.0F / 4294967296.0F) - 1.0F;
}

class Sweep {
 public:
  Sweep(const PlaneProblem& problem, ImageView<Plane> planes)
      : problem_(problem), planes_(planes) {}

  // One row's pixels from column `first`, every second.
  void visit_row(int y, int first, const PlaneOptions& options, int number) const {
    for (int x = first; x < planes_.width; x += 2) visit(y, x, options, number);
  }

  [[nodiscard]] float data(int y, int x, float value) const {
    const VolumeView<const float>& cost = problem_.cost;
    const float place = (value - problem_.first) / problem_.step;
    const int label = std::clamp(static_cast<int>(place), 0, cost.layers - 2);
    const float t = place - static_cast<float>(label);
    const float* const here = cost.row(y, label) + x;
    const float a = here[0], b = here[cost.width];
    const float before = label > 0 ? here[-cost.width] : a;
    const float after = label + 2 < cost.layers ? here[2 * cost.width] : b;
    return a + 0.5F * t *
                   (b - before +
                    t * (2 * before - 5 * a + 4 * b - after + t * (3 * (a - b) + after - before)));
  }

  // Of one pair, `far` at `way` from the pixel of `near`.
  [[nodiscard]] float bend(const Plane& near, const Plane& far, const Way& way) const {
    const auto y = static_cast<float>(way.y), x = static_cast<float>(way.x);
    const float off = std::abs(near.at(y, x) - far.value) + std::abs(far.at(-y, -x) - near.value);
    return std::min(0.5F * off, problem_.truncation);
  }

  [[nodiscard]] float weight(int y, int x, const Way& way) const {
    const float share = problem_.smoothness * way.share;
    if (problem_.g.empty()) return share;
    return share * std::sqrt(problem_.g.at(y, x) * problem_.g.at(y + way.y, x + way.x));
  }

  [[nodiscard]] bool contains(int y, int x) const {
    return y >= 0 && x >= 0 && y < planes_.height && x < planes_.width;
  }

 private:
  struct Neighbour {
    Plane plane;
    Way way;
    float weight = 0;
  };
  struct Neighbours {
    Neighbour item[8];
    int count = 0;
  };

  [[nodiscard]] Neighbours neighbours(int y, int x) const {
    Neighbours all;
    for (const Way& way : kWays) {
      if (!contains(y + way.y, x + way.x)) continue;
      all.item[all.count++] = {planes_.at(y + way.y, x + way.x), way, weight(y, x, way)};
    }
    return all;
  }

  [[nodiscard]] Plane limited(Plane plane) const {
    const float last =
        problem_.first + problem_.step * static_cast<float>(problem_.cost.layers - 1);
    plane.value = std::clamp(plane.value, problem_.first, last);
    return plane;
  }

  [[nodiscard]] float energy(int y, int x, const Plane& plane, const Neighbours& around,
                             float limit) const {
    float sum = data(y, x, plane.value);
    for (int i = 0; i < around.count && sum < limit; ++i) {
      sum += around.item[i].weight * bend(plane, around.item[i].plane, around.item[i].way);
    }
    return sum;
  }

  void visit(int y, int x, const PlaneOptions& options, int number) const {
    const Neighbours around = neighbours(y, x);
    Plane best = planes_.at(y, x);
    float least = energy(y, x, best, around, 1e30F);
    const auto propose = [&](const Plane& plane) {
      const Plane candidate = limited(plane);
      const float cost = energy(y, x, candidate, around, least);
      if (cost < least) {
        least = cost;
        best = candidate;
      }
    };
    for (int i = 0; i < around.count; ++i) {
      const Neighbour& n = around.item[i];
      const float value = n.plane.at(-static_cast<float>(n.way.y), -static_cast<float>(n.way.x));
      propose({value, n.plane.dx, n.plane.dy});
    }
    propose(with_differences(y, x));
    const float shrink = std::ldexp(1.0F, -number);
    for (int i = 0; i < kRandomCandidates; ++i) {
      const auto key = static_cast<std::uint32_t>(
          ((y * planes_.width + x) * 16 + number) * 3 * kRandomCandidates + 3 * i);
      const Plane from = best;
      propose({from.value + shrink * options.value_noise * noise(key ^ options.seed),
               from.dx + shrink * options.slope_noise * noise((key + 1) ^ options.seed),
               from.dy + shrink * options.slope_noise * noise((key + 2) ^ options.seed)});
    }
    planes_.at(y, x) = best;
  }

  // The pixel's value with the slope of its neighbours' values.
  [[nodiscard]] Plane with_differences(int y, int x) const {
    Plane plane = planes_.at(y, x);
    if (x > 0 && x + 1 < planes_.width) {
      plane.dx = 0.5F * (planes_.at(y, x + 1).value - planes_.at(y, x - 1).value);
    }
    if (y > 0 && y + 1 < planes_.height) {
      plane.dy = 0.5F * (planes_.at(y + 1, x).value - planes_.at(y - 1, x).value);
    }
    return plane;
  }

  const PlaneProblem& problem_;
  ImageView<Plane> planes_;
};

double energy_of_row(const PlaneProblem& problem, ImageView<const Plane> planes, int y) {
  // Only reads: the pixels are not visited.
  const ImageView<Plane> all{const_cast<Plane*>(planes.data), planes.height, planes.width, 1,
                             planes.row_stride};
  const Sweep sweep(problem, all);
  double sum = 0;
  for (int x = 0; x < planes.width; ++x) {
    sum += sweep.data(y, x, planes.at(y, x).value);
    for (const Way& way : kWays) {
      const bool once = way.y > 0 || (way.y == 0 && way.x > 0);
      if (!once || !sweep.contains(y + way.y, x + way.x)) continue;
      sum += sweep.weight(y, x, way) *
             sweep.bend(planes.at(y, x), planes.at(y + way.y, x + way.x), way);
    }
  }
  return sum;
}

}  // namespace

double plane_energy(const PlaneProblem& problem, ImageView<const Plane> planes) {
  check(problem, planes);
  double sum = 0;
  for (int y = 0; y < planes.height; ++y) sum += energy_of_row(problem, planes, y);
  return sum;
}

double improve_planes(const PlaneProblem& problem, const PlaneOptions& options,
                      const Progress& progress, ImageView<Plane> planes) {
  check(problem, planes);
  const Sweep sweep(problem, planes);
  const int parts = 4 * options.sweeps;
  for (int i = 0; i < parts && !(i % 4 == 0 && progress.finish_requested()); ++i) {
    const int first_row = i % 4 / 2, first_column = i % 2;
    const int rows = (planes.height - first_row + 1) / 2;
    parallel_for(rows, progress.part(1.0 * i / parts, (i + 1.0) / parts), [&](int row) {
      sweep.visit_row(2 * row + first_row, first_column, options, i / 4);
    });
  }
  return plane_energy(problem, planes);
}

}  // namespace episcope
