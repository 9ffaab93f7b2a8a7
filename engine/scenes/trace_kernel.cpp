// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/light.h"

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
  __builtin_memcpy(lanes, a.part, sizeof lanes);
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
    depth = select(nearer, other, depth);
    primitive = select(nearer, Pack<R>(static_cast<R>(index)), primitive);
  }
};

void trace_centers(const RowJob& job, int x0, const RowResult& out) {
  const ViewCamera& camera = job.camera;
  Rays<double> rays;
  for (int i = 0; i < kCenters; ++i) rays.dx.set(i, x0 + i - camera.principal[0]);
  rays.dx = rays.dx / camera.focal_px;
  rays.dy = Doubles((job.y - camera.principal[1]) / camera.focal_px);
  Nearest<double> solid;
  Nearest<double> pane;
  for (int i = 0; i < job.candidate_count; ++i) {
    if (!covers(job.candidates[i], x0, x0 + kCenters)) continue;
    const int index = job.candidates[i].primitive;
    const Primitive& primitive = job.model.primitives[index];
    const Doubles depth = hit_depth(primitive, to_local(primitive, camera, rays));
    (primitive.is_pane ? pane : solid).offer(depth, index);
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
void add_fragment(const RowJob& job, const Rays<float>& rays, int index, int x, const Floats& depth,
                  const Floats& weight, Fragments& fragments) {
  const Primitive& primitive = job.model.primitives[index];
  const Texture& texture = job.model.textures[primitive.texture];
  const SurfacePoints points =
      surface_points(primitive, to_local(primitive, job.camera, rays), depth);
  Floats rgb[3];
  albedo(texture, points, job.camera.focal_px, rgb);

  const int slot = fragments.count++;
  const float total = sum(weight);
  const float scale = 1 / total;
  fragments.pixel[slot] = x;
  fragments.weight.set(slot, total / kSamples);
  fragments.label.set(slot, primitive.label);
  fragments.gloss.set(slot, texture.gloss);
  for (int c = 0; c < 3; ++c) fragments.color[c].set(slot, sum(rgb[c] * weight) * scale);
  if (!job.model.lighting.is_on) return;
  float normal[3];
  for (int i = 0; i < 3; ++i) normal[i] = sum(points.normal[i] * weight) * scale;
  const float mean_depth = sum(depth * weight) * scale;
  const float slope[3] = {sum(rays.dx * weight) * scale, sum(rays.dy * weight) * scale, 1};
  for (int k = 0; k < 3; ++k) {
    const auto origin = static_cast<float>(job.camera.origin[k]);
    fragments.position[k].set(slot, origin + mean_depth * slope[k]);
    float world = 0;
    for (int i = 0; i < 3; ++i) world += static_cast<float>(primitive.axes[i][k]) * normal[i];
    fragments.normal[k].set(slot, world);
  }
}

Rays<float> sample_rays(const RowJob& job, int x) {
  Rays<float> rays;
  const double inverse = 1 / job.camera.focal_px;
  const auto dx = static_cast<float>((x - job.camera.principal[0]) * inverse);
  const auto dy = static_cast<float>((job.y - job.camera.principal[1]) * inverse);
  for (int i = 0; i < kSamples; ++i) {
    rays.dx.set(i, static_cast<float>(i % 4) * 0.25F - 0.375F);
    rays.dy.set(i, static_cast<float>(i / 4) * 0.25F - 0.375F);
  }
  rays.dx = rays.dx * static_cast<float>(inverse) + dx;
  rays.dy = rays.dy * static_cast<float>(inverse) + dy;
  return rays;
}

void trace_samples(const RowJob& job, int x, const RowResult& out, Fragments& fragments) {
  const Rays<float> rays = sample_rays(job, x);
  Nearest<float> solid;
  Nearest<float> pane;
  for (int i = 0; i < job.candidate_count; ++i) {
    if (!covers(job.candidates[i], x, x + 1)) continue;
    const int index = job.candidates[i].primitive;
    const Primitive& primitive = job.model.primitives[index];
    const Floats depth = hit_depth(primitive, to_local(primitive, job.camera, rays));
    (primitive.is_pane ? pane : solid).offer(depth, index);
  }
  const Ints behind_pane = pane.depth < solid.depth;
  const Floats zero(0.0F);
  const Floats solid_weight = select(behind_pane, Floats(0.5F), Floats(1.0F));
  const Floats pane_weight = select(behind_pane, Floats(0.5F), zero);
  int label = 0;
  for (int i = 0; i < job.candidate_count; ++i) {
    if (!covers(job.candidates[i], x, x + 1)) continue;
    const int index = job.candidates[i].primitive;
    const Primitive& primitive = job.model.primitives[index];
    const Nearest<float>& hits = primitive.is_pane ? pane : solid;
    Ints hit = equals(convert<int>(hits.primitive), index);
    if (primitive.is_pane) hit = hit & behind_pane;
    if (!any(hit)) continue;
    if (fragments.count == Floats::kLanes) flush(fragments, job.model, out.color);
    add_fragment(job, rays, index, x, select(hit, hits.depth, Floats(1.0F)),
                 select(hit, primitive.is_pane ? pane_weight : solid_weight, zero), fragments);
    if (label != 0 && label != primitive.label && !primitive.is_pane) out.is_edge[x] = 1;
    if (!primitive.is_pane) label = primitive.label;
  }
}

}  // namespace

void trace_row(const RowJob& job, const RowResult& out) {
  for (int i = 0; i < job.width; ++i) out.is_edge[i] = 0;
  for (int i = 0; i < 3 * job.width; ++i) out.color[i] = 0;
  for (int x = 0; x < job.width; x += kCenters) trace_centers(job, x, out);
  Fragments fragments{};
  for (int x = 0; x < job.width; ++x) trace_samples(job, x, out, fragments);
  flush(fragments, job.model, out.color);
}

}  // namespace episcope::scenes::EPISCOPE_KERNEL_NAMESPACE
