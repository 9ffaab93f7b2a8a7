// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/cast/light.h"

namespace episcope::scenes::EPISCOPE_KERNEL_NAMESPACE {
namespace {

constexpr int kSamples = 16;
constexpr int kCenters = Doubles::kLanes;
constexpr double kNoHit = 0.5 * kMiss;

bool covers(const Candidate& candidate, int begin, int end) {
  return candidate.begin < end && candidate.end > begin;
}

// The sum of all lanes, in the same order on every instruction set.
float sum(const Floats& a) {
  float lanes[Floats::kLanes];
  store(lanes, a);
  for (int half = Floats::kLanes / 2; half > 0; half /= 2) {
    for (int i = 0; i < half; ++i) lanes[i] += lanes[i + half];
  }
  return lanes[0];
}

template <class R>
struct Nearest {
  Pack<R> depth = Pack<R>(R(kMiss));
  Pack<R> primitive = Pack<R>(R(-1));

  void offer(const Pack<R>& other, int index) {
    const auto nearer = other < depth;
    depth = choose(nearer, other, depth);
    primitive = choose(nearer, Pack<R>(static_cast<R>(index)), primitive);
  }
};

// One row in progress.
struct Row {
  const RowJob& job;
  const RowResult& out;
  Frame<double> centers[kMaxCandidates];
  Frame<float> samples[kMaxCandidates];
  Fragments fragments{};

  Row(const RowJob& row_job, const RowResult& result) : job(row_job), out(result) {
    for (int i = 0; i < job.candidate_count; ++i) {
      const Primitive& primitive = job.model.primitives[job.candidates[i].primitive];
      centers[i] = frame_of<double>(primitive, job.camera);
      samples[i] = frame_of<float>(primitive, job.camera);
    }
  }

  void trace_centers(int x0) const;
  void trace_samples(int x);
  void add_fragment(const Frame<float>& frame, const Rays<float>& rays, int x, const Floats& depth,
                    const Floats& weight);
  [[nodiscard]] Rays<float> sample_rays(int x) const;
  // Direction through pixel `at` along an axis.
  [[nodiscard]] float center_slope(int at, int axis) const {
    return static_cast<float>((at - job.camera.principal[axis]) / job.camera.focal_px);
  }
};

void Row::trace_centers(int x0) const {
  const ViewCamera& camera = job.camera;
  Rays<double> rays;
  for (int i = 0; i < kCenters; ++i) rays.dx[i] = x0 + i - camera.principal[0];
  rays.dx = rays.dx / camera.focal_px;
  rays.dy = Doubles((job.y - camera.principal[1]) / camera.focal_px);
  Nearest<double> solid;
  Nearest<double> pane;
  for (int i = 0; i < job.candidate_count; ++i) {
    if (!covers(job.candidates[i], x0, x0 + kCenters)) continue;
    const Primitive& primitive = *centers[i].primitive;
    const Doubles depth = hit_depth(primitive, to_local(centers[i], rays));
    (primitive.is_pane ? pane : solid).offer(depth, job.candidates[i].primitive);
  }
  for (int i = 0; i < kCenters; ++i) {
    out.primitive[x0 + i] = solid.depth[i] < kNoHit ? static_cast<int>(solid.primitive[i]) : -1;
    out.depth[x0 + i] = solid.depth[i];
    const bool has_pane = pane.depth[i] < kNoHit && pane.depth[i] < solid.depth[i];
    out.pane[x0 + i] = has_pane ? static_cast<int>(pane.primitive[i]) : -1;
    out.pane_depth[x0 + i] = pane.depth[i];
  }
}

// Adds the samples of one primitive in one pixel as a fragment.
void Row::add_fragment(const Frame<float>& frame, const Rays<float>& rays, int x,
                       const Floats& depth, const Floats& weight) {
  const Primitive& primitive = *frame.primitive;
  const Texture& texture = job.model.textures[primitive.texture];
  const SurfacePoints points = surface_points(frame, to_local(frame, rays), depth);
  Floats rgb[3];
  albedo(texture, points, job.camera.focal_px, rgb);

  const int slot = fragments.count++;
  const float total = sum(weight);
  const float scale = 1 / total;
  fragments.pixel[slot] = x;
  fragments.weight[slot] = total / kSamples;
  for (int c = 0; c < 3; ++c) fragments.color[c][slot] = sum(rgb[c] * weight) * scale;
  if (!job.model.lighting.is_on) return;
  fragments.label[slot] = primitive.label;
  fragments.gloss[slot] = texture.gloss;
  const bool has_one_normal = is_flat(primitive.shape);
  float normal[3];
  for (int i = 0; i < 3; ++i) {
    normal[i] = has_one_normal ? points.normal[i][0] : sum(points.normal[i] * weight) * scale;
  }
  const float mean_depth = sum(depth * weight) * scale;
  const bool is_whole = total == static_cast<float>(kSamples);
  const float slope[3] = {is_whole ? center_slope(x, 0) : sum(rays.dx * weight) * scale,
                          is_whole ? center_slope(job.y, 1) : sum(rays.dy * weight) * scale, 1};
  for (int k = 0; k < 3; ++k) {
    const auto origin = static_cast<float>(job.camera.origin[k]);
    fragments.position[k][slot] = origin + mean_depth * slope[k];
    float world = 0;
    for (int i = 0; i < 3; ++i) world += frame.axes[i][k] * normal[i];
    fragments.normal[k][slot] = world;
  }
}

Rays<float> Row::sample_rays(int x) const {
  Rays<float> rays;
  for (int i = 0; i < kSamples; ++i) {
    rays.dx[i] = static_cast<float>(i % 4) * 0.25F - 0.375F;
    rays.dy[i] = static_cast<float>(i / 4) * 0.25F - 0.375F;
  }
  const auto pixel = static_cast<float>(job.fill / job.camera.focal_px);
  rays.dx = rays.dx * pixel + center_slope(x, 0);
  rays.dy = rays.dy * pixel + center_slope(job.y, 1);
  return rays;
}

void Row::trace_samples(int x) {
  const Rays<float> rays = sample_rays(x);
  Nearest<float> solid;
  Nearest<float> pane;
  for (int i = 0; i < job.candidate_count; ++i) {
    if (!covers(job.candidates[i], x, x + 1)) continue;
    const Primitive& primitive = *samples[i].primitive;
    const Floats depth = hit_depth(primitive, to_local(samples[i], rays));
    (primitive.is_pane ? pane : solid).offer(depth, i);
  }
  const Ints behind_pane = pane.depth < solid.depth;
  const Floats zero(0.0F);
  const Floats solid_weight = choose(behind_pane, Floats(0.5F), Floats(1.0F));
  const Floats pane_weight = choose(behind_pane, Floats(0.5F), zero);
  int label = 0;
  for (int i = 0; i < job.candidate_count; ++i) {
    if (!covers(job.candidates[i], x, x + 1)) continue;
    const Primitive& primitive = *samples[i].primitive;
    const Nearest<float>& hits = primitive.is_pane ? pane : solid;
    Ints hit = convert<int>(hits.primitive) == i;
    if (primitive.is_pane) hit = hit & behind_pane;
    if (!any(hit)) continue;
    if (fragments.count == Floats::kLanes) flush(fragments, job.model, job.camera, out.color);
    add_fragment(samples[i], rays, x, choose(hit, hits.depth, Floats(1.0F)),
                 choose(hit, primitive.is_pane ? pane_weight : solid_weight, zero));
    if (label != 0 && label != primitive.label && !primitive.is_pane) out.is_edge[x] = 1;
    if (!primitive.is_pane) label = primitive.label;
  }
}

}  // namespace

void trace_row(const RowJob& job, const RowResult& out) {
  for (int i = 0; i < job.width; ++i) out.is_edge[i] = 0;
  for (int i = 0; i < 3 * job.width; ++i) out.color[i] = 0;
  Row row(job, out);
  for (int x = 0; x < job.width; x += kCenters) row.trace_centers(x);
  for (int x = 0; x < job.width; ++x) row.trace_samples(x);
  flush(row.fragments, job.model, job.camera, out.color);
}

}  // namespace episcope::scenes::EPISCOPE_KERNEL_NAMESPACE
