// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/tv_l2_grid.h"

#include "engine/core/numbers.h"

#include <algorithm>
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

}  // namespace episcope
