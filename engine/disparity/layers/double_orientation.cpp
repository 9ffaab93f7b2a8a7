// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/layers/double_orientation.h"

#include "engine/core/error.h"
#include "engine/core/parallel/flush_denormals.h"
#include "engine/core/parallel/isa.h"
#include "engine/disparity/layers/double_filters.h"
#include "engine/disparity/layers/double_orientation_kernel.h"
#include "engine/disparity/tensor/sample_planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace episcope {
namespace {

using Direction = DoubleOrientation::Direction;

// Along and across the EPIs: planes of a tile stay in the cache.
constexpr PixelIndex kHorizontalTile = {16, 96};
constexpr PixelIndex kVerticalTile = {64, 32};
// Lanes that a kernel may touch beyond a plane, besides the neighbours it needs.
constexpr int kSlack = 64;

int views_along(const LightField& lf, Direction direction) {
  const int views = direction == Direction::Horizontal ? lf.grid().u : lf.grid().v;
  if (views < DoubleOrientation::kMinViews || views > DoubleOrientation::kMaxViews) {
    throw InvalidInput(
        fmt::format("two orientations need {} to {} views along an EPI, but the grid has {}",
                    DoubleOrientation::kMinViews, DoubleOrientation::kMaxViews, views));
  }
  return views;
}

long rounded(long lanes) {
  return (lanes + 15) / 16 * 16;
}

}  // namespace

struct DoubleOrientation::State {
  Direction direction;
  DoubleSearch search;
  SamplePlanes samples;
  const DoubleOrientationKernel& kernel =
      EPISCOPE_CHOOSE_KERNEL(best_isa(), kDoubleOrientationKernel);
  const DoubleFilterSet set;
  const SecondOrderFilters& filters = set.filters;
  const std::vector<int> steps;  // shears
  DoubleBlock block;
  int margin_x = 0, margin_y = 0;
  int plane_height = 0, plane_width = 0;
  long result_pitch = 0;
  std::vector<float> memory;
  std::vector<float> best;  // [view][near, far, confidence][y][x] of a tile

  State(const LightField& lf, Direction dir, const TensorScales& scales,
        const DoubleSearch& wanted);
  [[nodiscard]] bool horizontal() const { return direction == Direction::Horizontal; }
  void allocate();
  void gather(const Task& task);
  template <class Body>
  void each_run(const Task& task, const Body& body);
  void estimate(const Task& task, const Sink& sink);
};

DoubleOrientation::State::State(const LightField& lf, Direction dir, const TensorScales& scales,
                                const DoubleSearch& wanted)
    : direction(dir),
      search(wanted),
      samples(lf, InvalidSamples::AsNan),
      set(make_double_filters(views_along(lf, dir), lf.channels(), scales)),
      steps(double_steps(wanted)) {
  block.rows = views_along(lf, dir);
  block.channels = lf.channels();
  block.has_invalid = !lf.valid().empty();
  block.first_product = set.first_product;
  block.last_product = set.last_product;
  allocate();
}

void DoubleOrientation::State::allocate() {
  int largest = 0;
  for (const int step : steps) largest = std::max(largest, std::abs(step));
  // A view integrates over product rows, whose derivatives reach to further views: each step along
  // the views moves by the shear.
  const int margin =
      largest * (block.rows - 1) + filters.integrate.radius + filters.along[0].radius;
  margin_x = horizontal() ? margin : filters.across.radius;
  margin_y = horizontal() ? filters.across.radius : margin;
  const PixelIndex largest_tile = tile(direction);
  plane_height = largest_tile.y + 2 * margin_y;
  plane_width = largest_tile.x + 2 * margin_x;
  block.along = horizontal() ? 1 : plane_width;
  block.across = horizontal() ? plane_width : 1;
  block.lanes = static_cast<long>(plane_height) * plane_width;
  block.pitch = rounded(block.lanes + kSlack);
  result_pitch = rounded(largest_tile.x);
  const int product_rows = block.last_product - block.first_product;
  const std::size_t image = static_cast<std::size_t>(block.rows) * block.channels * block.pitch;
  const std::size_t product = static_cast<std::size_t>(product_rows) * block.pitch;
  // Lanes at the ends of the first and last plane look this far beyond.
  const std::size_t outside =
      static_cast<std::size_t>(largest + filters.along[0].radius + filters.across.radius + 8) *
          plane_width +
      block.pitch;
  memory.assign(4 * image + 6 * product + block.pitch + 2 * outside, 0.0F);
  float* next = memory.data() + outside;
  const auto take = [&next](std::size_t count) { return std::exchange(next, next + count); };
  block.samples = take(image);
  for (float*& plane : block.derivative) plane = take(image);
  for (float*& plane : block.product) plane = take(product);
  block.scratch = take(block.pitch);
  best.resize(static_cast<std::size_t>(3) * block.rows * largest_tile.y * result_pitch + kSlack);
}

// The tile with its margins.
void DoubleOrientation::State::gather(const Task& task) {
  const int left = task.begin.x - margin_x;
  for (int row = 0; row < block.rows; ++row) {
    const ViewIndex view =
        horizontal() ? ViewIndex{task.camera_line, row} : ViewIndex{row, task.camera_line};
    for (int i = 0; i < task.height + 2 * margin_y; ++i) {
      std::array<float*, 3> lanes{};
      for (int c = 0; c < block.channels; ++c) {
        lanes[c] = block.samples + (static_cast<long>(c) * block.rows + row) * block.pitch +
                   static_cast<long>(i) * plane_width;
      }
      samples.read_clamped(view, task.begin.y - margin_y + i, left, left + plane_width,
                           lanes.data());
    }
  }
}

// Every line of the tile in every wanted view, lines first.
template <class Body>
void DoubleOrientation::State::each_run(const Task& task, const Body& body) {
  const std::size_t plane = static_cast<std::size_t>(task.height) * result_pitch;
  for (int view = task.first_view; view < task.last_view; ++view) {
    float* const of_view = best.data() + 3 * plane * (view - task.first_view);
    for (int y = 0; y < task.height; ++y) {
      float* const near = of_view + y * result_pitch;
      body(DoubleRun{view, static_cast<long>(y + margin_y) * plane_width + margin_x, task.width,
                     near, near + plane, near + 2 * plane});
    }
  }
}

void DoubleOrientation::State::estimate(const Task& task, const Sink& sink) {
  const FlushDenormals flush;
  gather(task);
  kernel.differentiate(block, filters);
  best.assign(best.size(), 0.0F);
  for (const int step : steps) {
    kernel.accumulate(block, filters, step);
    each_run(task, [&](const DoubleRun& run) {
      kernel.select(
          block, filters,
          {step, kDoubleShearReach, static_cast<float>(search.accepted.min),
           static_cast<float>(search.accepted.max), static_cast<float>(search.min_distance)},
          run);
    });
  }
  PixelIndex at = task.begin;
  each_run(task, [&](const DoubleRun& run) {
    sink(run.row, at, task.width, run.near, run.far, run.confidence);
    at.y = at.y + 1 < task.begin.y + task.height ? at.y + 1 : task.begin.y;
  });
}

DoubleOrientation::DoubleOrientation(const LightField& light_field, Direction direction,
                                     const TensorScales& scales, const DoubleSearch& search)
    : state_(std::make_unique<State>(light_field, direction, scales, search)) {}
DoubleOrientation::~DoubleOrientation() = default;
DoubleOrientation::DoubleOrientation(DoubleOrientation&&) noexcept = default;

PixelIndex DoubleOrientation::tile(Direction direction) {
  return direction == Direction::Horizontal ? kHorizontalTile : kVerticalTile;
}

void DoubleOrientation::estimate(const Task& task, const Sink& sink) {
  state_->estimate(task, sink);
}

std::size_t DoubleOrientation::byte_size() const {
  return sizeof(float) * (state_->memory.size() + state_->best.size());
}

int DoubleOrientation::reach() const {
  return state_->margin_y;
}

}  // namespace episcope
