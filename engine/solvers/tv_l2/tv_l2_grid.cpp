// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/tv_l2/tv_l2_grid.h"

#include "engine/core/array/round_up.h"

#include <algorithm>
#include <cstdint>

namespace episcope {
namespace {

constexpr int kPlanes = 10;

// Stands for "this edge exists" until `penalise` gives it its value.
constexpr float kOpenEdge = 1;

void open_edges(const TvL2Level& level) {
  for (int y = 0; y < level.height; ++y) {
    const long at = y * level.pitch;
    std::fill_n(level.rx + at, level.width - 1, kOpenEdge);
    level.rx[at + level.width - 1] = 0;
    std::fill_n(level.ry + at, level.width, y + 1 < level.height ? kOpenEdge : 0.0F);
  }
}

// One row between the coarse rows `here` and `beside`: ¾ and ¼ of the way.
void blend_rows(const float* here, const float* beside, int count, float* out) {
  for (int x = 0; x < count; ++x) out[x] = 0.75F * here[x] + 0.25F * beside[x];
}

// Cell centres: a pixel lies a quarter of a cell beside the centre of its cell.
void stretch_centres(const float* cells, int count, int width, float* out) {
  const auto value = [=](int cell, int beside) {
    return 0.75F * cells[cell] + 0.25F * cells[beside];
  };
  for (int cell = 1; cell + 1 < count; ++cell) {
    out[2 * cell] = value(cell, cell - 1);
    out[2 * cell + 1] = value(cell, cell + 1);
  }
  const int last = count - 1;
  out[0] = cells[0];
  if (width > 1) out[1] = value(0, std::min(1, last));
  out[2 * last] = value(last, std::max(last - 1, 0));
  if (2 * last + 1 < width) out[2 * last + 1] = cells[last];
}

// Faces: the right face of a cell is that of its odd pixel; the even pixel's lies midway.
void stretch_faces(const float* cells, int width, float* out) {
  out[0] = 0.5F * cells[0];
  for (int cell = 0; 2 * cell + 1 < width; ++cell) out[2 * cell + 1] = cells[cell];
  for (int cell = 1; 2 * cell < width; ++cell)
    out[2 * cell] = 0.5F * (cells[cell] + cells[cell - 1]);
}

}  // namespace

TvL2Grid::TvL2Grid(int height, int width) {
  level.height = height;
  level.width = width;
  level.pitch = round_up(width, kTvL2RowUnit) + 2L * kTvL2Margin;
  const std::size_t plane = static_cast<std::size_t>(height + 3) * level.pitch + kTvL2Margin;
  memory_.assign(kPlanes * plane + 16, 0.0F);
  const auto misaligned = reinterpret_cast<std::uintptr_t>(memory_.data()) / sizeof(float) % 16;
  float* next = memory_.data() + (16 - misaligned) % 16 + level.pitch + kTvL2Margin;
  for (float** to : {&level.f, &level.c, &level.g, &level.u, &level.zx, &level.zy, &level.rx,
                     &level.ry, &level.inverse, &level.b}) {
    *to = next;
    next += plane;
  }
}

void coarsen_problem(const TvL2Level& fine, const TvL2Level& coarse) {
  for (int y = 0; y < coarse.height; ++y) {
    const long below = 2 * y + 1 < fine.height ? fine.pitch : 0;
    for (int x = 0; x < coarse.width; ++x) {
      const long i = 2L * y * fine.pitch + 2L * x;
      const long right = 2 * x + 1 < fine.width ? 1 : 0;
      // Cells at an odd border count their pixels twice.
      float c = 0, cf = 0, g = 0;
      for (const long j : {i, i + right, i + below, i + below + right}) {
        c += fine.c[j];
        cf += fine.c[j] * fine.f[j];
        g += fine.g[j];
      }
      const long to = y * coarse.pitch + x;
      coarse.c[to] = 0.5F * c;
      coarse.f[to] = cf / c;
      coarse.g[to] = 0.25F * g;
    }
  }
}

void coarsen_penalty(const TvL2Level& fine, const TvL2Level& coarse, float edge_factor) {
  for (int y = 0; y < coarse.height; ++y) {
    const long row = 2L * y * fine.pitch;
    for (int x = 0; x < coarse.width; ++x) {  // the padding right and below holds zeros
      const long i = row + 2L * x;
      const long to = y * coarse.pitch + x;
      coarse.rx[to] = edge_factor * (fine.rx[i + 1] + fine.rx[i + fine.pitch + 1]);
      coarse.ry[to] = edge_factor * (fine.ry[i + fine.pitch] + fine.ry[i + fine.pitch + 1]);
    }
  }
}

void invert_diagonal(const TvL2Level& level) {
  for (int y = 0; y < level.height; ++y) {
    const long at = y * level.pitch;
    const float* const c = level.c + at;
    const float* const rx = level.rx + at;
    const float* const ry = level.ry + at;
    float* const inverse = level.inverse + at;
    for (int x = 0; x < level.width; ++x) {
      inverse[x] =
          1.0F / (level.data_scale * c[x] + rx[x] + rx[x - 1] + ry[x] + ry[x - level.pitch]);
    }
  }
}

void prolong(const TvL2Level& coarse, const TvL2Level& fine) {
  std::vector<float> row(coarse.width);
  const int last = coarse.height - 1;
  for (int y = 0; y < fine.height; ++y) {
    const long cell = y / 2 * coarse.pitch;
    const long beside =
        ((y & 1) != 0 ? std::min(y / 2 + 1, last) : std::max(y / 2 - 1, 0)) * coarse.pitch;
    const long to = y * fine.pitch;
    blend_rows(coarse.u + cell, coarse.u + beside, coarse.width, row.data());
    stretch_centres(row.data(), coarse.width, fine.width, fine.u + to);
    blend_rows(coarse.zx + cell, coarse.zx + beside, coarse.width, row.data());
    stretch_faces(row.data(), fine.width, fine.zx + to);
    fine.zx[to + fine.width - 1] = 0;
    // The row above the first one is padding: p = 0 there.
    const float* const below = coarse.zy + cell;
    const float* const above = (y & 1) != 0 ? below : below - coarse.pitch;
    for (int x = 0; x < coarse.width; ++x) row[x] = 0.5F * (below[x] + above[x]);
    stretch_centres(row.data(), coarse.width, fine.width, fine.zy + to);
    if (y + 1 == fine.height) std::fill_n(fine.zy + to, fine.width, 0.0F);
  }
  open_edges(fine);
}

void start_from_data(const TvL2Level& level) {
  for (int y = 0; y < level.height; ++y) {
    const long at = y * level.pitch;
    std::copy_n(level.f + at, level.width, level.u + at);
    std::fill_n(level.zx + at, level.width, 0.0F);
    std::fill_n(level.zy + at, level.width, 0.0F);
  }
  open_edges(level);
}

}  // namespace episcope
