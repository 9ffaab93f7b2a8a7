// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/tv_l2_grid.h"

#include <algorithm>
#include <cmath>
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
  for (int x = 0; x < width; ++x) {
    const int cell = x / 2;
    const int beside = (x & 1) != 0 ? std::min(cell + 1, count - 1) : std::max(cell - 1, 0);
    out[x] = 0.75F * cells[cell] + 0.25F * cells[beside];
  }
}

// Faces: the right face of a cell is that of its odd pixel; the even pixel's lies midway.
void stretch_faces(const float* cells, int width, float* out) {
  for (int x = 0; x < width; ++x) {
    const int cell = x / 2;
    const float before = cell > 0 ? cells[cell - 1] : 0.0F;
    out[x] = (x & 1) != 0 ? cells[cell] : 0.5F * (cells[cell] + before);
  }
}

struct Dual {
  std::vector<float> x, y;
};

// p of a whole level, the projection of z.
Dual project(const TvL2Level& level) {
  const std::size_t count = static_cast<std::size_t>(level.height) * level.width;
  Dual p{std::vector<float>(count), std::vector<float>(count)};
  for (int y = 0; y < level.height; ++y) {
    for (int x = 0; x < level.width; ++x) {
      const long i = y * level.pitch + x;
      const std::size_t to = static_cast<std::size_t>(y) * level.width + x;
      const float norm = std::sqrt(level.zx[i] * level.zx[i] + level.zy[i] * level.zy[i] + 1e-30F);
      const float keep = std::min(1.0F, level.g[i] / norm);
      p.x[to] = level.zx[i] * keep;
      p.y[to] = level.zy[i] * keep;
    }
  }
  return p;
}

void project_row(const TvL2Level& level, int y) {
  for (int x = 0; x < level.width; ++x) {
    const long i = y * level.pitch + x;
    const float norm = std::sqrt(level.zx[i] * level.zx[i] + level.zy[i] * level.zy[i] + 1e-30F);
    const float keep = std::min(1.0F, level.g[i] / norm);
    level.zx[i] *= keep;
    level.zy[i] *= keep;
  }
}

}  // namespace

TvL2Grid::TvL2Grid(int height, int width) {
  level.height = height;
  level.width = width;
  level.pitch = (width + kTvL2RowUnit - 1) / kTvL2RowUnit * kTvL2RowUnit + 2L * kTvL2Margin;
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
  const Dual p = project(coarse);
  std::vector<float> row(coarse.width);
  const int last = coarse.height - 1;
  for (int y = 0; y < fine.height; ++y) {
    const int cell = y / 2;
    const int beside = (y & 1) != 0 ? std::min(cell + 1, last) : std::max(cell - 1, 0);
    const long to = y * fine.pitch;
    const auto p_row = [&](const std::vector<float>& plane, int at) {
      return plane.data() + static_cast<std::size_t>(at) * coarse.width;
    };
    blend_rows(coarse.u + cell * coarse.pitch, coarse.u + beside * coarse.pitch, coarse.width,
               row.data());
    stretch_centres(row.data(), coarse.width, fine.width, fine.u + to);
    blend_rows(p_row(p.x, cell), p_row(p.x, beside), coarse.width, row.data());
    stretch_faces(row.data(), fine.width, fine.zx + to);
    const float* const here = p_row(p.y, cell);
    for (int x = 0; x < coarse.width; ++x) {
      const float before = cell > 0 ? p_row(p.y, cell - 1)[x] : 0.0F;
      row[x] = (y & 1) != 0 ? here[x] : 0.5F * (here[x] + before);
    }
    stretch_centres(row.data(), coarse.width, fine.width, fine.zy + to);
    fine.zx[to + fine.width - 1] = 0;
    if (y + 1 == fine.height) std::fill_n(fine.zy + to, fine.width, 0.0F);
    project_row(fine, y);
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
