// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/structure_tensor.h"

#include "engine/core/error.h"
#include "engine/core/isa.h"
#include "engine/disparity/view_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace episcope {
namespace {

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

// The same filter evaluated half a sample further: the mean of two neighboring positions.
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

Matrix zero_matrix(int rows) {
  return Matrix(rows, std::vector<double>(rows, 0));
}

// A filter along the views, truncated at the first and last view and renormalized.
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

// Energy of a contrast given in 1/255, over all channels.
float sample_energy(double contrast, int channels) {
  return static_cast<float>(channels * contrast * contrast / (255.0 * 255.0));
}

// Weights of contrast/(energy + contrast) are 1 for all energies that samples have.
float contrast_energy(double contrast, int channels) {
  constexpr float kNoLimit = 1e20F;
  return contrast >= 255 ? kNoLimit : sample_energy(contrast, channels);
}

// The farthest row that any row takes in.
int filter_reach(const std::vector<RowTaps>& filter) {
  int reach = 0;
  for (int r = 0; r < static_cast<int>(filter.size()); ++r) {
    reach = std::max({reach, r - filter[r].first, filter[r].first + filter[r].count - 1 - r});
  }
  return reach;
}

// Lanes that a kernel may read or write beyond what it is asked for.
constexpr int kTensorSlack = 128;
// Of the widest instruction set: rows begin at whole vectors, where strides allow it.
constexpr int kVectorLanes = 16;

// How far beyond the range noisy estimates are followed, in px: cut off at the range itself, noise
// about a disparity near its end would no longer average out.
constexpr double kTensorOvershoot = 0.35;

int rounded_pitch(int lanes) {
  return (lanes + kVectorLanes - 1) / kVectorLanes * kVectorLanes;
}

// A vertical block: whole vectors wide, so that shears move it by whole vectors.
constexpr int kBlockColumns = 4 * kVectorLanes;

// The views are cut into blocks of about equal height.
int block_height(const LightField& lf) {
  constexpr int kMaxBlockRows = 128;
  const int blocks = (lf.height() + kMaxBlockRows - 1) / kMaxBlockRows;
  return (lf.height() + blocks - 1) / blocks;
}

int largest_shear(const TensorSearch& search) {
  int largest = 0;
  for (const int shear : search.half_step_shears) largest = std::max(largest, std::abs(shear));
  return largest;
}

// A wanted row integrates over neighbors, whose gradients reach to their neighbors: each step
// along the views moves by the shear.
int reach_along(const TensorFilterSet& set, const TensorSearch& search) {
  const int reach =
      (set.view_reach * largest_shear(search) + 1) / 2 + set.filters.integrate.radius + 3;
  return reach + set.filters.smooth.radius + 4;
}

std::vector<cuda::ViewFilter> view_filters(const std::vector<RowTaps>& rows) {
  std::vector<cuda::ViewFilter> filters(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    filters[i].first = rows[i].first;
    filters[i].count = rows[i].count;
    std::copy_n(rows[i].values, rows[i].count, filters[i].taps);
  }
  return filters;
}

cuda::ViewFilters view_filters(const TensorFilterSet& set) {
  return {view_filters(set.row_smooth), view_filters(set.row_derivative),
          view_filters(set.row_integrate), set.view_reach};
}

std::vector<float> lane_filter(const Taps& taps, int more = 0) {
  return {taps.values, taps.values + 2 * taps.radius + 1 + more};
}

void set_shears(const std::vector<int>& shears, cuda::TensorSettings& settings) {
  settings.first_shear = shears.front();
  settings.shear_count = static_cast<int>(shears.size());
  settings.shear_step = shears.size() > 1 ? shears[1] - shears[0] : 0;
  assert(shears.back() == shears.front() + (settings.shear_count - 1) * settings.shear_step);
}

}  // namespace

// Cut at 2σ, where the Gaussian has fallen to 13 %.
int gaussian_radius(double sigma) {
  return static_cast<int>(std::ceil(2 * sigma));
}

TensorFilterSet make_tensor_filters(int rows, int channels, const TensorScales& scales) {
  const int inner = gaussian_radius(scales.inner);
  const int views = gaussian_radius(scales.views);
  const Matrix before =
      smoothing_matrix(rows, inner, [&](int i) { return gaussian(scales.inner, i); });
  const Matrix scharr = smoothing_matrix(rows, 1, [](int i) { return i == 0 ? 10.0 : 3.0; });
  const Matrix after =
      smoothing_matrix(rows, views, [&](int i) { return gaussian(scales.views, i); });
  TensorFilterSet set;
  set.row_smooth = banded(product(scharr, before), inner + 1);
  set.row_derivative = banded(product(derivative_matrix(rows), before), inner + 1);
  set.row_integrate = banded(after, views);
  set.view_reach = filter_reach(set.row_smooth) + filter_reach(set.row_integrate);
  set.filters.smooth = gaussian_taps(scales.inner);
  set.filters.integrate = gaussian_taps(scales.outer);
  set.filters.integrate_half = half_sample(set.filters.integrate);
  set.filters.row_smooth = set.row_smooth.data();
  set.filters.row_derivative = set.row_derivative.data();
  set.filters.row_integrate = set.row_integrate.data();
  set.filters.contrast_energy = contrast_energy(scales.contrast, channels);
  set.filters.noise_energy = sample_energy(scales.noise, channels);
  set.across = gaussian_taps(scales.across);
  return set;
}

TensorSearch cover_range(Interval range, int step_half_px) {
  const double step = 0.5 * step_half_px;
  TensorSearch search;
  search.limit = 0.5 * step + 0.1;
  const int first = static_cast<int>(std::floor(range.min / step + 0.5));
  const int last = static_cast<int>(std::ceil(range.max / step - 0.5));
  for (int i = first; i <= std::max(first, last); ++i) {
    search.half_step_shears.push_back(i * step_half_px);
  }
  search.accepted = {std::min(range.min, first * step) - kTensorOvershoot,
                     std::max(range.max, last * step) + kTensorOvershoot};
  return search;
}

TensorSearch cover_range_sparsely(Interval range) {
  constexpr double kUnsheared = 1.2;
  constexpr double kLimit = 1.1;
  constexpr double kNoLimit = 1000;
  TensorSearch search = cover_range(range, 2);
  search.accepted = {range.min - kTensorOvershoot, range.max + kTensorOvershoot};
  search.limit = kLimit;
  if (range.min < -kUnsheared || range.max > kUnsheared) return search;
  search.half_step_shears = {0};
  search.limit = kNoLimit;
  return search;
}

struct StructureTensor::State {
  const LightField& light_field;
  Direction direction;
  TensorSearch search;
  const TensorKernel& tensors = EPISCOPE_CHOOSE_KERNEL(best_isa(), kTensorKernel);
  const OrientationKernel& orientations = EPISCOPE_CHOOSE_KERNEL(best_isa(), kOrientationKernel);
  const EigenvectorKernel& eigenvectors = EPISCOPE_CHOOSE_KERNEL(best_isa(), kEigenvectorKernel);
  const TensorFilterSet set;
  const TensorFilters& filters = set.filters;
  const Taps& across = set.across;
  TensorBlock block;
  int columns = kBlockColumns;  // Lanes of a pixel row of a vertical block, neighbors included.
  int payload_pixels = 0;       // Along the EPI, at most.
  bool with_half = false;
  std::vector<float> memory;
  SamplePlanes planes;
  std::vector<float*> slots;  // Best tensors: of neighboring lines (horizontal) or of the block.
  float* result[2] = {};

  State(const LightField& lf, Direction dir, const TensorScales& scales, TensorSearch wanted);
  [[nodiscard]] bool horizontal() const { return direction == Direction::Horizontal; }
  void size_block();
  void allocate();
  void use_slot(float* slot);
  void run_shears(const TensorTask& task, int count);
  void gather(ViewIndex view, PixelIndex begin, int end, int row, long lane, int count, int before);
  void gather_horizontal(const TensorTask& task, int y);
  void gather_vertical(const TensorTask& task);
  void prefetch_pixels(ViewIndex view, int y, int x) const;
  void estimate_horizontal(const TensorTask& task, const Sink& sink);
  void estimate_vertical(const TensorTask& task, const Sink& sink);
  TensorAverage make_average(int length) const;
};

StructureTensor::State::State(const LightField& lf, Direction dir, const TensorScales& scales,
                              TensorSearch wanted)
    : light_field(lf),
      direction(dir),
      search(std::move(wanted)),
      set(make_tensor_filters(views_along(lf, dir), lf.channels(), scales)),
      planes(lf, InvalidSamples::AsNan) {
  block.rows = views_along(lf, dir);
  block.channels = lf.channels();
  block.has_invalid = !lf.valid().empty();
  size_block();
  allocate();
}

void StructureTensor::State::size_block() {
  block.stride = horizontal() ? 1 : columns;
  payload_pixels = horizontal() ? light_field.width() : block_height(light_field);
  for (const int shear : search.half_step_shears) with_half = with_half || (shear & 1) != 0;
  const int largest = largest_shear(search);
  block.margin = reach_along(set, search) * block.stride;
  block.tensor_margin = rounded_pitch(
      (largest * block.rows / 2 + filters.integrate.radius + 2) * block.stride + kTensorSlack);
}

void StructureTensor::State::allocate() {
  const int payload = payload_pixels * block.stride;
  block.pitch = rounded_pitch(2 * block.margin + payload + kTensorSlack);
  block.tensor_pitch = rounded_pitch(2 * block.tensor_margin + payload + kTensorSlack);
  block.best_pitch = rounded_pitch(payload + kTensorSlack);
  const auto rows = static_cast<std::size_t>(block.rows);
  const std::size_t image = rows * block.pitch * block.channels;
  const std::size_t tensor = rows * block.tensor_pitch;
  const std::size_t best = 4 * rows * block.best_pitch;
  const std::size_t slot_count = horizontal() ? 2 * across.radius + 1 : 1;
  memory.assign(image * (with_half ? 5 : 3) + 2 * block.pitch + 3 * tensor + slot_count * best +
                    2 * block.best_pitch + 2 * kTensorSlack + kVectorLanes,
                0.0F);
  const auto misaligned = reinterpret_cast<std::uintptr_t>(memory.data()) / sizeof(float);
  float* next =
      memory.data() + kTensorSlack + (kVectorLanes - misaligned % kVectorLanes) % kVectorLanes;
  const auto take = [&next](std::size_t count) { return std::exchange(next, next + count); };
  block.samples = take(image);
  for (int half = 0; half < (with_half ? 2 : 1); ++half) {
    block.along[half] = take(image);
    block.across[half] = take(image);
  }
  block.line = take(2 * static_cast<std::size_t>(block.pitch));
  for (float*& plane : block.tensor) plane = take(tensor);
  for (std::size_t i = 0; i < slot_count; ++i) slots.push_back(take(best));
  for (float*& line : result) line = take(block.best_pitch);
}

void StructureTensor::State::use_slot(float* slot) {
  const std::size_t plane = static_cast<std::size_t>(block.rows) * block.best_pitch;
  for (int j = 0; j < 4; ++j) block.best[j] = slot + j * plane;
  std::fill_n(slot, 4 * plane, 0.0F);
}

// The hardware does not prefetch across steps of a whole image row.
void StructureTensor::State::prefetch_pixels(ViewIndex view, int y, int x) const {
  constexpr int kRowsAhead = 12;
  constexpr int kCacheLine = 64;
  if (light_field.sample_type() != SampleType::UInt8) return;
  const int row = std::min(y + kRowsAhead, light_field.height() - 1);
  const std::uint8_t* first =
      light_field.view<std::uint8_t>(view).row(row) + static_cast<std::size_t>(x) * block.channels;
  for (int i = 0; i < columns * block.channels; i += kCacheLine) __builtin_prefetch(first + i);
}

// Columns [begin.x, end) of a row of the view, from `before` on in the `count` lanes that begin at
// `lane` of the block's row, which continue the first and the last of them.
void StructureTensor::State::gather(ViewIndex view, PixelIndex begin, int end, int row, long lane,
                                    int count, int before) {
  std::array<float*, 3> inside{};
  for (int c = 0; c < block.channels; ++c) {
    inside[c] = block.samples + (static_cast<std::size_t>(c) * block.rows + row) * block.pitch +
                lane + before;
  }
  planes.read(view, begin.y, begin.x, end, inside.data());
  const int width = end - begin.x;
  for (int c = 0; c < block.channels; ++c) {
    std::fill(inside[c] - before, inside[c], inside[c][0]);
    std::fill(inside[c] + width, inside[c] - before + count, inside[c][width - 1]);
  }
}

void StructureTensor::State::gather_horizontal(const TensorTask& task, int y) {
  const int x0 = std::max(0, task.begin.x - block.margin);
  const int x1 = std::min(light_field.width(), task.begin.x + task.width + block.margin);
  for (int u = 0; u < block.rows; ++u) {
    gather({task.camera_line, u}, {y, x0}, x1, u, 0, block.pitch, block.margin + x0 - task.begin.x);
  }
}

void StructureTensor::State::gather_vertical(const TensorTask& task) {
  const int left = task.begin.x - across.radius;
  const int x0 = std::max(0, left);
  const int x1 = std::min(light_field.width(), left + columns);
  const int margin = block.margin / columns;
  for (int v = 0; v < block.rows; ++v) {
    for (int i = -margin; i < task.height + margin; ++i) {
      const int y = std::clamp(task.begin.y + i, 0, light_field.height() - 1);
      prefetch_pixels({v, task.camera_line}, y, x0);
      gather({v, task.camera_line}, {y, x0}, x1, v, (margin + i) * columns, columns, x0 - left);
    }
  }
}

void StructureTensor::State::run_shears(const TensorTask& task, int count) {
  block.first_row = task.first_view;
  block.last_row = task.last_view;
  block.length = count * block.stride;
  tensors.differentiate(block, filters, with_half);
  for (const int half_steps : search.half_step_shears) {
    const Shear shear{half_steps, block.rows / 2, static_cast<float>(search.limit),
                      static_cast<float>(search.accepted.min),
                      static_cast<float>(search.accepted.max)};
    tensors.accumulate(block, filters, shear);
    if (search.eigenvector || search.limit >= 1) {
      eigenvectors.select(block, filters, shear, search.eigenvector);
    } else {
      orientations.select(block, filters, shear);
    }
  }
}

TensorAverage StructureTensor::State::make_average(int length) const {
  TensorAverage average;
  average.count = 2 * across.radius + 1;
  std::copy_n(across.values, average.count, average.weights);
  average.length = length;
  average.noise_energy = filters.noise_energy;
  average.min = static_cast<float>(search.accepted.min);
  average.max = static_cast<float>(search.accepted.max);
  average.disparity = result[0];
  average.coherence = result[1];
  return average;
}

void StructureTensor::State::estimate_horizontal(const TensorTask& task, const Sink& sink) {
  const int last = light_field.height() - 1;
  const int end = task.begin.y + task.height;
  const auto slot_of = [this](int y) { return slots[y % slots.size()]; };
  const std::size_t plane = static_cast<std::size_t>(block.rows) * block.best_pitch;
  TensorAverage average = make_average(task.width);
  int next = std::max(0, task.begin.y - across.radius);
  for (int y = task.begin.y; y < end; ++y) {
    for (; next <= std::min(last, y + across.radius); ++next) {
      use_slot(slot_of(next));
      gather_horizontal(task, next);
      run_shears(task, task.width);
    }
    for (int u = task.first_view; u < task.last_view; ++u) {
      for (int i = 0; i < average.count; ++i) {
        const float* slot = slot_of(std::clamp(y + i - across.radius, 0, last));
        for (int j = 0; j < 3; ++j) {
          average.tensor[i][j] = slot + j * plane + static_cast<std::size_t>(u) * block.best_pitch;
        }
      }
      orientations.resolve(average);
      sink(u, {y, task.begin.x}, task.width, result[0], result[1]);
    }
  }
}

void StructureTensor::State::estimate_vertical(const TensorTask& task, const Sink& sink) {
  use_slot(slots[0]);
  gather_vertical(task);
  run_shears(task, task.height);
  TensorAverage average = make_average(task.width);
  for (int v = task.first_view; v < task.last_view; ++v) {
    for (int y = 0; y < task.height; ++y) {
      const std::size_t row =
          static_cast<std::size_t>(v) * block.best_pitch + static_cast<std::size_t>(y) * columns;
      for (int i = 0; i < average.count; ++i) {
        for (int j = 0; j < 3; ++j) average.tensor[i][j] = block.best[j] + row + i;
      }
      orientations.resolve(average);
      sink(v, {task.begin.y + y, task.begin.x}, task.width, result[0], result[1]);
    }
  }
}

StructureTensor::StructureTensor(const LightField& light_field, Direction direction,
                                 const TensorScales& scales, const TensorSearch& search)
    : state_(std::make_unique<State>(light_field, direction, scales, search)) {}
StructureTensor::~StructureTensor() = default;
StructureTensor::StructureTensor(StructureTensor&&) noexcept = default;

int StructureTensor::views_along(const LightField& lf, Direction direction) {
  const bool horizontal = direction == Direction::Horizontal;
  const int views = horizontal ? lf.grid().u : lf.grid().v;
  if (views < 2 || views > kMaxTensorViews) {
    throw InvalidInput(
        fmt::format("the structure tensor needs 2 to {} views along an EPI, but the grid has {}",
                    kMaxTensorViews, views));
  }
  return views;
}

TensorExtent StructureTensor::largest_task(const LightField& lf, Direction direction,
                                           const TensorScales& scales) {
  if (direction == Direction::Horizontal) return {lf.height(), lf.width()};
  return {block_height(lf), kBlockColumns - 2 * gaussian_radius(scales.across)};
}

int StructureTensor::reach(const LightField& lf, Direction direction, const TensorScales& scales,
                           const TensorSearch& search) {
  return reach_along(make_tensor_filters(views_along(lf, direction), lf.channels(), scales),
                     search);
}

void StructureTensor::estimate(const TensorTask& task, const Sink& sink) {
  if (state_->horizontal()) {
    state_->estimate_horizontal(task, sink);
  } else {
    state_->estimate_vertical(task, sink);
  }
}

void merge_orientations(const float* disparity, const float* coherence, int count, int power,
                        float* to_disparity, float* to_coherence) {
  EPISCOPE_CHOOSE_KERNEL(best_isa(), kOrientationKernel)
      .merge(disparity, coherence, count, power, to_disparity, to_coherence);
}

cuda::TensorSettings device_tensor_settings(const LightField& lf, const TensorScales& scales,
                                            const TensorSearch& search) {
  using Direction = StructureTensor::Direction;
  cuda::TensorSettings settings;
  const auto add_direction = [&](Direction direction, cuda::ViewFilters& filters) {
    const TensorFilterSet set =
        make_tensor_filters(StructureTensor::views_along(lf, direction), lf.channels(), scales);
    filters = view_filters(set);
    settings.smooth = lane_filter(set.filters.smooth);
    settings.integrate = lane_filter(set.filters.integrate);
    settings.integrate_half = lane_filter(set.filters.integrate_half, 1);
    settings.across = lane_filter(set.across);
    settings.contrast_energy = set.filters.contrast_energy;
    settings.noise_energy = set.filters.noise_energy;
  };
  if (lf.grid().u > 1) add_direction(Direction::Horizontal, settings.horizontal);
  if (lf.grid().v > 1) add_direction(Direction::Vertical, settings.vertical);
  set_shears(search.half_step_shears, settings);
  settings.limit = static_cast<float>(search.limit);
  settings.min = static_cast<float>(search.accepted.min);
  settings.max = static_cast<float>(search.accepted.max);
  settings.eigenvector = search.eigenvector;
  return settings;
}

}  // namespace episcope
