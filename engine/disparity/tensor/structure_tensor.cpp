// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/tensor/structure_tensor.h"

#include "engine/core/error.h"
#include "engine/core/parallel/isa.h"
#include "engine/disparity/tensor/eigenvector_kernel.h"
#include "engine/disparity/tensor/sample_planes.h"
#include "engine/disparity/tensor/structure_tensor_kernel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace episcope {
namespace {

// Lanes that a kernel may read or write beyond what it is asked for.
constexpr int kSlack = 128;
// Of the widest instruction set: rows begin at whole vectors, where strides allow it.
constexpr int kVectorLanes = 16;

// How far beyond the range noisy estimates are followed, in px: cut off at the range itself, noise
// about a disparity near its end would no longer average out.
constexpr double kOvershoot = 0.35;

int rounded(int lanes) {
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

// A wanted row integrates over neighbours, whose gradients reach to their neighbours: each step
// along the views moves by the shear.
int reach_along(const TensorFilterSet& set, const TensorSearch& search) {
  const int reach =
      (set.view_reach * largest_shear(search) + 1) / 2 + set.filters.integrate.radius + 3;
  return reach + set.filters.smooth.radius + 4;
}

}  // namespace

TensorSearch cover_range(Interval range, int step_half_px) {
  const double step = 0.5 * step_half_px;
  TensorSearch search;
  search.limit = 0.5 * step + 0.1;
  const int first = static_cast<int>(std::floor(range.min / step + 0.5));
  const int last = static_cast<int>(std::ceil(range.max / step - 0.5));
  for (int i = first; i <= std::max(first, last); ++i) {
    search.half_step_shears.push_back(i * step_half_px);
  }
  search.accepted = {std::min(range.min, first * step) - kOvershoot,
                     std::max(range.max, last * step) + kOvershoot};
  return search;
}

TensorSearch cover_range_sparsely(Interval range) {
  constexpr double kUnsheared = 1.2;
  constexpr double kLimit = 1.1;
  constexpr double kNoLimit = 1000;
  TensorSearch search = cover_range(range, 2);
  search.accepted = {range.min - kOvershoot, range.max + kOvershoot};
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
  int columns = kBlockColumns;  // Lanes of a pixel row of a vertical block, neighbours included.
  int payload_pixels = 0;       // Along the EPI, at most.
  bool with_half = false;
  std::vector<float> memory;
  SamplePlanes planes;
  std::vector<float*> slots;  // Best tensors: of neighbouring lines (horizontal) or of the block.
  float* result[2] = {};

  State(const LightField& lf, Direction dir, const TensorScales& scales, TensorSearch wanted);
  [[nodiscard]] bool horizontal() const { return direction == Direction::Horizontal; }
  void size_block();
  void allocate();
  void use_slot(float* slot);
  void run_shears(const TensorTask& task, int count);
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
  block.tensor_margin =
      rounded((largest * block.rows / 2 + filters.integrate.radius + 2) * block.stride + kSlack);
}

void StructureTensor::State::allocate() {
  const int payload = payload_pixels * block.stride;
  block.pitch = rounded(2 * block.margin + payload + kSlack);
  block.tensor_pitch = rounded(2 * block.tensor_margin + payload + kSlack);
  block.best_pitch = rounded(payload + kSlack);
  const auto rows = static_cast<std::size_t>(block.rows);
  const std::size_t image = rows * block.pitch * block.channels;
  const std::size_t tensor = rows * block.tensor_pitch;
  const std::size_t best = 4 * rows * block.best_pitch;
  const std::size_t slot_count = horizontal() ? 2 * across.radius + 1 : 1;
  memory.assign(image * (with_half ? 5 : 3) + 2 * block.pitch + 3 * tensor + slot_count * best +
                    2 * block.best_pitch + 2 * kSlack + kVectorLanes,
                0.0F);
  const auto misaligned = reinterpret_cast<std::uintptr_t>(memory.data()) / sizeof(float);
  float* next = memory.data() + kSlack + (kVectorLanes - misaligned % kVectorLanes) % kVectorLanes;
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

void StructureTensor::State::gather_horizontal(const TensorTask& task, int y) {
  const int x0 = std::max(0, task.begin.x - block.margin);
  const int x1 = std::min(light_field.width(), task.begin.x + task.width + block.margin);
  for (int u = 0; u < block.rows; ++u) {
    std::array<float*, 3> rows{};
    std::array<float*, 3> inside{};
    for (int c = 0; c < block.channels; ++c) {
      rows[c] = block.samples + (static_cast<std::size_t>(c) * block.rows + u) * block.pitch;
      inside[c] = rows[c] + block.margin + x0 - task.begin.x;
    }
    planes.read({task.camera_line, u}, y, x0, x1, inside.data());
    for (int c = 0; c < block.channels; ++c) {
      std::fill(rows[c], inside[c], inside[c][0]);
      std::fill(inside[c] + (x1 - x0), rows[c] + block.pitch, inside[c][x1 - x0 - 1]);
    }
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
      std::array<float*, 3> lanes{};
      std::array<float*, 3> inside{};
      for (int c = 0; c < block.channels; ++c) {
        lanes[c] = block.samples + (static_cast<std::size_t>(c) * block.rows + v) * block.pitch +
                   static_cast<std::ptrdiff_t>(margin + i) * columns;
        inside[c] = lanes[c] + (x0 - left);
      }
      prefetch_pixels({v, task.camera_line}, y, x0);
      planes.read({v, task.camera_line}, y, x0, x1, inside.data());
      for (int c = 0; c < block.channels; ++c) {
        std::fill(lanes[c], inside[c], inside[c][0]);
        std::fill(inside[c] + (x1 - x0), lanes[c] + columns, inside[c][x1 - x0 - 1]);
      }
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

}  // namespace episcope
