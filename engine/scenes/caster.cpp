// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/caster.h"

#include "engine/core/isa.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/scenes/trace_kernel.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

namespace episcope::scenes {
namespace {

struct View {
  ViewCamera camera;
  std::vector<Bounds> bounds;  // Of every primitive.
};

View make_view(const Stage& stage, const Model& model, double scale, CameraPosition at) {
  const double parallax = stage.parallax * scale;
  const double baseline = parallax / stage.focal_px;
  const double shift = parallax / stage.zero_depth;
  View view;
  view.camera.origin[0] = baseline * at.x;
  view.camera.origin[1] = baseline * at.y;
  view.camera.principal[0] = (stage.width - 1) / 2.0 + shift * at.x;
  view.camera.principal[1] = (stage.height - 1) / 2.0 + shift * at.y;
  view.camera.focal_px = stage.focal_px;
  for (const Primitive& primitive : model.primitives) {
    view.bounds.push_back(bounds_in_view(primitive, view.camera, stage.width, stage.height));
  }
  return view;
}

// In steps from the center view.
CameraPosition position_of(const RenderOptions& options, int index) {
  if (!options.positions.empty()) return options.positions[index];
  const ViewIndex view = options.grid.view_at(index), center = options.grid.center();
  return {static_cast<double>(view.u - center.u), static_cast<double>(view.v - center.v)};
}

struct RowBuffers {
  explicit RowBuffers(int width)
      : color(3 * static_cast<std::size_t>(width)),
        primitive(width),
        depth(width),
        pane(width),
        pane_depth(width),
        is_edge(width) {}

  [[nodiscard]] RowResult result() {
    return {color.data(), primitive.data(),  depth.data(),
            pane.data(),  pane_depth.data(), is_edge.data()};
  }

  std::vector<float> color;
  std::vector<int> primitive;
  std::vector<double> depth;
  std::vector<int> pane;
  std::vector<double> pane_depth;
  std::vector<unsigned char> is_edge;
  std::vector<Candidate> candidates;
};

// One cast of all views: what every row needs and where it writes.
class ViewsCast {
 public:
  ViewsCast(const Stage& stage, const Model& model, const RenderOptions& options)
      : stage_(stage),
        model_(model),
        options_(options),
        trace_row_(trace_row_for(best_isa())),
        exposure_(model.sensor, {stage.height, stage.width, options.channels, options.noise_sigma,
                                 options.seed}) {
    assert(model.primitives.size() <= kMaxCandidates);
    for (int i = 0; i < options.grid.count(); ++i) {
      views_.push_back(make_view(stage, model, options.disparity_scale, position_of(options, i)));
    }
    has_panes_ = std::any_of(model.primitives.begin(), model.primitives.end(),
                             [](const Primitive& p) { return p.is_pane; });
    cast_.samples = stack<std::uint8_t>(options.channels);
    cast_.truth.field.disparity = stack<float>();
    cast_.truth.field.valid = stack<std::uint8_t>();
    cast_.truth.labels = stack<std::int32_t>();
    if (has_panes_) {
      for (DisparityField* field : {&cast_.truth.foreground, &cast_.truth.background}) {
        field->disparity = stack<float>();
        field->valid = stack<std::uint8_t>();
      }
    }
    edges_ = Image<std::uint8_t>(stage.height, stage.width);
    surfaces_ = Image<std::int32_t>(stage.height, stage.width, 1, -1);
  }

  Cast run(const Progress& progress) {
    const int width = round_up(stage_.width, kTraceGroup);
    parallel_for_workers(options_.grid.count() * stage_.height, progress, [this, width] {
      return [this, buffers = RowBuffers(width)](int item) mutable {
        cast_row(options_.grid.view_at(item / stage_.height), item % stage_.height, buffers);
      };
    });
    add_regions();
    return std::move(cast_);
  }

 private:
  template <class T>
  [[nodiscard]] ViewStack<T> stack(int channels = 1) const {
    return ViewStack<T>(options_.grid, stage_.height, stage_.width, channels);
  }

  void cast_row(ViewIndex index, int y, RowBuffers& buffers) {
    const View& view = views_[static_cast<std::size_t>(index.v) * options_.grid.u + index.u];
    buffers.candidates.clear();
    for (std::size_t i = 0; i < view.bounds.size(); ++i) {
      const Bounds& bounds = view.bounds[i];
      if (y >= bounds.y_begin && y < bounds.y_end) {
        buffers.candidates.push_back({static_cast<int>(i), bounds.x_begin, bounds.x_end});
      }
    }
    RowJob job;
    job.model = model_.view();
    job.camera = view.camera;
    job.candidates = buffers.candidates.data();
    job.candidate_count = static_cast<int>(buffers.candidates.size());
    job.y = y;
    job.fill = model_.sensor.fill;
    job.width = static_cast<int>(buffers.primitive.size());
    trace_row_(job, buffers.result());
    write_samples(index, y, buffers);
    write_truth(index, y, buffers);
    if (index == options_.grid.center()) {
      std::copy_n(buffers.is_edge.data(), stage_.width, edges_.row(y));
      std::copy_n(buffers.primitive.data(), stage_.width, surfaces_.row(y));
    }
  }

  void write_samples(ViewIndex index, int y, const RowBuffers& buffers) {
    const auto out = cast_.samples.view(index);
    const ViewIndex center = options_.grid.center();
    exposure_.write_row({index.v - center.v, index.u - center.u}, y, buffers.color.data(),
                        static_cast<std::uint64_t>(out.row(y) - cast_.samples.data()), out.row(y));
  }

  void write_truth(ViewIndex index, int y, const RowBuffers& buffers) {
    GroundTruth& truth = cast_.truth;
    for (int x = 0; x < stage_.width; ++x) {
      const int solid = buffers.primitive[x];
      const int pane = buffers.pane[x];
      const bool is_seen = solid >= 0;
      const float behind = is_seen ? disparity(buffers.depth[x]) : 0;
      const float before = pane >= 0 ? disparity(buffers.pane_depth[x]) : behind;
      const int front = pane >= 0 ? pane : solid;
      truth.labels.view(index).at(y, x) = front >= 0 ? model_.primitives[front].label : 0;
      truth.field.disparity.view(index).at(y, x) = before;
      // Where two surfaces are seen there is no one disparity.
      truth.field.valid.view(index).at(y, x) = is_seen && pane < 0;
      if (!has_panes_) continue;
      truth.foreground.disparity.view(index).at(y, x) = before;
      truth.foreground.valid.view(index).at(y, x) = pane >= 0;
      truth.background.disparity.view(index).at(y, x) = behind;
      truth.background.valid.view(index).at(y, x) = is_seen && pane >= 0;
    }
  }

  [[nodiscard]] float disparity(double depth) const {
    const double parallax = stage_.parallax * options_.disparity_scale;
    return static_cast<float>(parallax / depth - parallax / stage_.zero_depth);  // eq. 1
  }

  // Rays that leave out parts of a pixel miss edges in it.
  void add_edges_between_pixels() {
    for (int y = 0; y < stage_.height; ++y) {
      for (int x = 0; x < stage_.width; ++x) {
        const int surface = surfaces_.at(y, x);
        const int right = surfaces_.at(y, std::min(x + 1, stage_.width - 1));
        const int below = surfaces_.at(std::min(y + 1, stage_.height - 1), x);
        if (surface != right || surface != below) edges_.at(y, x) = 1;
      }
    }
  }

  void add_regions() {
    if (model_.sensor.fill < 1) add_edges_between_pixels();
    constexpr int reach = 2;  // px around an edge that an estimator's window mixes.
    Image<std::uint8_t> discontinuities(stage_.height, stage_.width);
    Image<std::uint8_t> planes(stage_.height, stage_.width);
    Image<std::uint8_t> smooth(stage_.height, stage_.width);
    for (int y = 0; y < stage_.height; ++y) {
      for (int x = 0; x < stage_.width; ++x) {
        discontinuities.at(y, x) = is_near_edge(y, x, reach);
        const int surface = surfaces_.at(y, x);
        if (surface < 0 || discontinuities.at(y, x) != 0) continue;
        const bool is_curved = model_.primitives[surface].shape == Shape::Revolution;
        (is_curved ? smooth : planes).at(y, x) = 1;
      }
    }
    add_region("discontinuities", std::move(discontinuities));
    add_region("planes", std::move(planes));
    add_region("smooth_surfaces", std::move(smooth));
  }

  [[nodiscard]] bool is_near_edge(int y, int x, int reach) const {
    for (int j = std::max(y - reach, 0); j <= std::min(y + reach, stage_.height - 1); ++j) {
      for (int i = std::max(x - reach, 0); i <= std::min(x + reach, stage_.width - 1); ++i) {
        if (edges_.at(j, i) != 0) return true;
      }
    }
    return false;
  }

  void add_region(const std::string& name, Image<std::uint8_t> mask) {
    if (std::any_of(mask.begin(), mask.end(), [](std::uint8_t m) { return m != 0; })) {
      cast_.truth.regions.emplace(name, std::move(mask));
    }
  }

  const Stage& stage_;
  const Model& model_;
  const RenderOptions& options_;
  TraceRow trace_row_;
  Exposure exposure_;
  std::vector<View> views_;
  bool has_panes_ = false;
  Cast cast_;
  Image<std::uint8_t> edges_;     // Of the center view.
  Image<std::int32_t> surfaces_;  // Primitives of the center view.
};

}  // namespace

CameraGrid camera_grid_of(const Stage& stage, double disparity_scale) {
  const double side = std::max(stage.width, stage.height);
  CameraGrid camera;
  camera.baseline = stage.parallax * disparity_scale / stage.focal_px * side;  // eq. 2: b · xRes
  camera.focal_length = stage.focal_px / side;
  camera.shift = stage.parallax * disparity_scale / stage.zero_depth;
  camera.cam_distance = stage.zero_depth;
  return camera;
}

Cast cast_views(const Stage& stage, const Model& model, const RenderOptions& options,
                const Progress& progress) {
  return ViewsCast(stage, model, options).run(progress);
}

EPISCOPE_DECLARE_KERNEL(void trace_row(const RowJob& job, const RowResult& result));

TraceRow trace_row_for([[maybe_unused]] Isa isa) {
  return EPISCOPE_CHOOSE_KERNEL(isa, trace_row);
}

}  // namespace episcope::scenes
