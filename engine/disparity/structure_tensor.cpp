// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/structure_tensor.h"

#include "engine/core/error.h"
#include "engine/core/isa.h"
#include "engine/disparity/structure_tensor_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <utility>

namespace episcope {
namespace {

// Lanes that a kernel may read or write beyond what it is asked for.
constexpr int kSlack = 64;
constexpr int kMaxRows = 32;

const TensorKernel& tensor_kernel() {
#ifdef EPISCOPE_BASELINE_ONLY
  return baseline::kTensorKernel;
#else
  switch (best_isa()) {
    case Isa::Avx512: return avx512::kTensorKernel;
    case Isa::Avx2: return avx2::kTensorKernel;
    default: return baseline::kTensorKernel;
  }
#endif
}

int gaussian_radius(double sigma) { return sigma > 0 ? 2 * static_cast<int>(std::ceil(sigma)) : 0; }

double gaussian(double sigma, int offset) {
  return sigma > 0 ? std::exp(-0.5 * offset * offset / (sigma * sigma)) : (offset == 0 ? 1 : 0);
}

Taps gaussian_taps(double sigma) {
  Taps taps;
  taps.radius = gaussian_radius(sigma);
  double sum = 0;
  for (int i = -taps.radius; i <= taps.radius; ++i) sum += gaussian(sigma, i);
  for (int i = -taps.radius; i <= taps.radius; ++i) {
    taps.values[i + taps.radius] = static_cast<float>(gaussian(sigma, i) / sum);
  }
  return taps;
}

// The same filter evaluated half a sample further: the mean of two neighbouring positions.
Taps half_sample(const Taps& taps) {
  Taps half = taps;
  const int count = 2 * taps.radius + 1;
  half.values[count] = 0;
  for (int i = count; i >= 0; --i) {
    const float here = i < count ? taps.values[i] : 0;
    half.values[i] = 0.5F * (here + (i > 0 ? taps.values[i - 1] : 0));
  }
  return half;
}

using Matrix = std::vector<std::vector<double>>;

Matrix zero_matrix(int rows) { return Matrix(rows, std::vector<double>(rows, 0)); }

// A filter along the views, truncated at the first and last view and renormalised.
Matrix smoothing_matrix(int rows, int radius, const std::function<double(int)>& weight) {
  Matrix matrix = zero_matrix(rows);
  for (int r = 0; r < rows; ++r) {
    double sum = 0;
    for (int i = std::max(0, r - radius); i <= std::min(rows - 1, r + radius); ++i) {
      sum += matrix[r][i] = weight(i - r);
    }
    for (double& value : matrix[r]) value /= sum;
  }
  return matrix;
}

// d/ds with s = −u: central inside, one-sided at the ends.
Matrix derivative_matrix(int rows) {
  Matrix matrix = zero_matrix(rows);
  for (int r = 0; r < rows; ++r) {
    const int before = std::max(0, r - 1);
    const int after = std::min(rows - 1, r + 1);
    matrix[r][before] += 1.0 / (after - before);
    matrix[r][after] -= 1.0 / (after - before);
  }
  return matrix;
}

Matrix product(const Matrix& a, const Matrix& b) {
  const int rows = static_cast<int>(a.size());
  Matrix matrix = zero_matrix(rows);
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < rows; ++k) {
      for (int j = 0; j < rows; ++j) matrix[i][j] += a[i][k] * b[k][j];
    }
  }
  return matrix;
}

std::vector<RowTaps> banded(const Matrix& matrix, int radius) {
  const int rows = static_cast<int>(matrix.size());
  std::vector<RowTaps> taps(rows);
  for (int r = 0; r < rows; ++r) {
    taps[r].first = std::max(0, r - radius);
    taps[r].count = std::min(rows - 1, r + radius) - taps[r].first + 1;
    for (int i = 0; i < taps[r].count; ++i) {
      taps[r].values[i] = static_cast<float>(matrix[r][taps[r].first + i]);
    }
  }
  return taps;
}

struct RowFilters {
  std::vector<RowTaps> smooth, derivative, integrate;
};

RowFilters make_row_filters(int rows, const TensorScales& scales) {
  const int inner = gaussian_radius(scales.inner);
  const int outer = gaussian_radius(scales.outer);
  const Matrix before = smoothing_matrix(
      rows, inner, [&](int i) { return gaussian(scales.inner, i); });
  const Matrix scharr = smoothing_matrix(rows, 1, [](int i) { return i == 0 ? 10.0 : 3.0; });
  RowFilters filters;
  filters.smooth = banded(product(scharr, before), inner + 1);
  filters.derivative = banded(product(derivative_matrix(rows), before), inner + 1);
  filters.integrate = banded(
      smoothing_matrix(rows, outer, [&](int i) { return gaussian(scales.outer, i); }), outer);
  return filters;
}

}  // namespace

TensorSearch cover_range(Interval range, int step_half_px) {
  TensorSearch search;
  search.range = range;
  search.limit = 0.25 * step_half_px + 0.1;
  const double step = 0.5 * step_half_px;
  const int first = static_cast<int>(std::floor(range.min / step + 0.5));
  const int last = static_cast<int>(std::ceil(range.max / step - 0.5));
  for (int i = first; i <= std::max(first, last); ++i) {
    search.half_step_shears.push_back(i * step_half_px);
  }
  return search;
}

struct StructureTensor::State {
  const LightField& light_field;
  Direction direction;
  TensorSearch search;
  const TensorKernel& kernel = tensor_kernel();
  RowFilters row_filters;
  TensorFilters filters;
  TensorBlock block;
  int payload_pixels = 0;  // capacity
  int margin_pixels = 0;
  bool with_half = false;
  std::vector<float> memory;
  std::vector<std::uint8_t> line_u8;
  std::vector<float> line_float;

  State(const LightField& lf, Direction dir, const TensorScales& scales, TensorSearch wanted);
  void allocate();
  void gather(const EpiStretch& stretch, int begin, int count);
  void gather_horizontal(const EpiStretch& stretch, int begin, int count);
  void gather_vertical(const EpiStretch& stretch, int begin, int count);
  void gather_pixels(ViewIndex view, int y, int x0, int x1, float* const* out);
};

StructureTensor::State::State(const LightField& lf, Direction dir, const TensorScales& scales,
                              TensorSearch wanted)
    : light_field(lf), direction(dir), search(std::move(wanted)) {
  const bool horizontal = direction == Direction::Horizontal;
  block.rows = horizontal ? lf.grid().u : lf.grid().v;
  if (block.rows < 2 || block.rows > kMaxRows) {
    throw InvalidInput("the structure tensor needs 2 to 32 views along an EPI, but the grid has " +
                       std::to_string(block.rows));
  }
  block.channels = lf.channels();
  block.stride = horizontal ? 1 : kColumns;
  row_filters = make_row_filters(block.rows, scales);
  filters.smooth = gaussian_taps(scales.inner);
  filters.integrate = gaussian_taps(scales.outer);
  filters.integrate_half = half_sample(filters.integrate);
  filters.row_smooth = row_filters.smooth.data();
  filters.row_derivative = row_filters.derivative.data();
  filters.row_integrate = row_filters.integrate.data();
  const double noise = scales.noise / 255;
  filters.noise_energy = static_cast<float>(block.channels * noise * noise);
  int largest = 0;
  for (const int shear : search.half_step_shears) {
    largest = std::max(largest, std::abs(shear));
    with_half = with_half || (shear & 1) != 0;
  }
  // Seen from the outermost wanted row to the outermost row of the other end.
  const int shear_reach = largest * (block.rows - 1) / 2 + 2;
  margin_pixels = 2 * shear_reach + filters.smooth.radius + filters.integrate.radius + 8;
  allocate();
}

void StructureTensor::State::allocate() {
  constexpr int kMaxBandPixels = 128;
  payload_pixels = direction == Direction::Horizontal
                       ? light_field.width()
                       : std::min(light_field.height(), kMaxBandPixels);
  block.margin = (margin_pixels * block.stride + 15) / 16 * 16;
  block.pitch = (2 * block.margin + payload_pixels * block.stride + kSlack + 15) / 16 * 16;
  const std::size_t plane = static_cast<std::size_t>(block.rows) * block.pitch;
  const std::size_t image = plane * block.channels;
  memory.assign(image * (with_half ? 5 : 3) + 2 * block.pitch + 5 * plane + 2 * kSlack, 0.0F);
  float* next = memory.data() + kSlack;
  const auto take = [&next](std::size_t count) { return std::exchange(next, next + count); };
  block.samples = take(image);
  for (int half = 0; half < (with_half ? 2 : 1); ++half) {
    block.along[half] = take(image);
    block.across[half] = take(image);
  }
  block.line = take(2 * static_cast<std::size_t>(block.pitch));
  for (float*& tensor : block.tensor) tensor = take(plane);
  block.disparity = take(plane);
  block.coherence = take(plane);
}

void StructureTensor::State::gather_pixels(ViewIndex view, int y, int x0, int x1,
                                           float* const* out) {
  const int channels = block.channels;
  if (light_field.sample_type() == SampleType::UInt8) {
    kernel.deinterleave(light_field.view<std::uint8_t>(view).row(y) +
                            static_cast<std::size_t>(x0) * channels,
                        x1 - x0, channels, out);
    return;
  }
  line_float.resize(static_cast<std::size_t>(x1 - x0) * channels);
  light_field.read_row(view, y, x0, x1, line_float.data());
  for (int i = 0; i < x1 - x0; ++i) {
    for (int c = 0; c < channels; ++c) out[c][i] = line_float[i * channels + c];
  }
}

void StructureTensor::State::gather_horizontal(const EpiStretch& stretch, int begin, int count) {
  const int width = light_field.width();
  const int x0 = std::max(0, begin - block.margin);
  const int x1 = std::min(width, begin + count + block.margin);
  for (int u = 0; u < block.rows; ++u) {
    std::array<float*, 3> rows{};
    std::array<float*, 3> inside{};
    for (int c = 0; c < block.channels; ++c) {
      rows[c] = block.samples + (static_cast<std::size_t>(c) * block.rows + u) * block.pitch;
      inside[c] = rows[c] + block.margin + x0 - begin;
    }
    gather_pixels({stretch.line, u}, stretch.first, x0, x1, inside.data());
    for (int c = 0; c < block.channels; ++c) {
      std::fill(rows[c], inside[c], inside[c][0]);
      std::fill(inside[c] + (x1 - x0), rows[c] + block.pitch, inside[c][x1 - x0 - 1]);
    }
  }
}

void StructureTensor::State::gather_vertical(const EpiStretch& stretch, int begin, int count) {
  const int x0 = stretch.first;
  const int x1 = std::min(light_field.width(), x0 + kColumns);
  const int last = light_field.height() - 1;
  const int margin = block.margin / kColumns;
  for (int v = 0; v < block.rows; ++v) {
    for (int i = -margin; i < count + margin; ++i) {
      const int y = std::clamp(begin + i, 0, last);
      std::array<float*, 3> lanes{};
      for (int c = 0; c < block.channels; ++c) {
        lanes[c] = block.samples + (static_cast<std::size_t>(c) * block.rows + v) * block.pitch +
                   static_cast<std::ptrdiff_t>(margin + i) * kColumns;
      }
      gather_pixels({v, stretch.line}, y, x0, x1, lanes.data());
      for (int c = 0; c < block.channels; ++c) {
        std::fill(lanes[c] + (x1 - x0), lanes[c] + kColumns, lanes[c][x1 - x0 - 1]);
      }
    }
  }
}

void StructureTensor::State::gather(const EpiStretch& stretch, int begin, int count) {
  if (direction == Direction::Horizontal) {
    gather_horizontal(stretch, begin, count);
  } else {
    gather_vertical(stretch, begin, count);
  }
}

StructureTensor::StructureTensor(const LightField& light_field, Direction direction,
                                 const TensorScales& scales, const TensorSearch& search)
    : state_(std::make_unique<State>(light_field, direction, scales, search)) {}
StructureTensor::~StructureTensor() = default;
StructureTensor::StructureTensor(StructureTensor&&) noexcept = default;

void StructureTensor::estimate(const EpiStretch& stretch, int begin, int end) {
  State& state = *state_;
  TensorBlock& block = state.block;
  const int count = end - begin;
  block.first_row = stretch.first_row;
  block.last_row = stretch.last_row;
  block.length = count * block.stride;
  state.gather(stretch, begin, count);
  state.kernel.differentiate(block, state.filters, state.with_half);
  for (int r = block.first_row; r < block.last_row; ++r) {
    const std::size_t row = static_cast<std::size_t>(r) * block.pitch;
    std::fill_n(block.coherence + row, block.length, 0.0F);
    std::fill_n(block.disparity + row, block.length, 0.0F);
  }
  for (const int half_steps : state.search.half_step_shears) {
    const Shear shear{half_steps, block.rows / 2, static_cast<float>(state.search.limit),
                      static_cast<float>(state.search.range.min),
                      static_cast<float>(state.search.range.max)};
    state.kernel.accumulate(block, state.filters, shear);
    state.kernel.orient(block, state.filters, shear);
  }
}

const float* StructureTensor::disparity(int row) const {
  return state_->block.disparity + static_cast<std::size_t>(row) * state_->block.pitch;
}

const float* StructureTensor::coherence(int row) const {
  return state_->block.coherence + static_cast<std::size_t>(row) * state_->block.pitch;
}

}  // namespace episcope
