// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/line_check/line_check.cuh"

#include "engine/cuda/device/transfer.cuh"
#include "engine/cuda/line_check/line_trust.cuh"
#include "engine/cuda/line_check/residual_noise.cuh"
#include "engine/cuda/line_check/see_through.cuh"
#include "engine/cuda/line_check/side_choice.cuh"
#include "engine/cuda/maps/map_memory.cuh"

namespace episcope::cuda {
namespace {

void copy(const float* from, float* to, std::size_t count, const DeviceStream& stream) {
  check(cudaMemcpyAsync(to, from, count * sizeof(float), cudaMemcpyDeviceToDevice, stream.get()));
}

void choose_sides_in_place(const PackedField& field, const MapPointers& maps,
                           const DeviceStream& stream) {
  const std::size_t size = static_cast<std::size_t>(maps.grid.count()) * field.height * field.width;
  DeviceArray<float> disparity(size, stream), confidence(size, stream);
  const MapPointers before{maps.grid, maps.first, disparity.data(), confidence.data()};
  copy(maps.disparity, before.disparity, size, stream);
  copy(maps.confidence, before.confidence, size, stream);
  choose_sides(field, before, residual_noise(field, before, stream), maps, stream);
}

}  // namespace

void check_lines_on_device(const DeviceSamples& samples, const LineCheckSteps& steps,
                           const MapPointers& maps, const DeviceStream& stream,
                           const Progress& progress) {
  if (!steps.chooses_sides && !steps.reduces_confidence) return;
  progress.step("checking lines");
  const PackedFieldMemory packed(samples, stream);
  if (steps.chooses_sides) choose_sides_in_place(packed.field(), maps, stream);
  stream.wait();
  progress.check();
  progress.report(0.7);
  if (!steps.reduces_confidence) return;
  const float variance = residual_noise(packed.field(), maps, stream);
  reduce_confidence(packed.field(), maps, variance, stream);
}

void check_lines(const LightField& lf, const LineCheckSteps& steps, ViewStack<float>& disparity,
                 ViewStack<float>& confidence, const Progress& progress) {
  const auto light_field = on_device(lf, progress.part(0, 0));
  const DeviceStream stream;
  const Progress silent = progress.part(0, 0);
  auto d = upload(disparity.data(), disparity.size(), stream, silent);
  auto r = upload(confidence.data(), confidence.size(), stream, silent);
  check_lines_on_device(light_field->samples(), steps,
                        {disparity.grid(), disparity.first(), d.data(), r.data()}, stream,
                        progress);
  download(disparity, d, stream, silent);
  download(confidence, r, stream, silent);
}

void check_lines(const LightField& lf, const LineCheckSteps& steps, DeviceMaps& maps,
                 const Progress& progress) {
  MapMemory& memory = maps.memory();
  check_lines_on_device(memory.samples(lf, progress), steps, memory.pointers(), memory.stream,
                        progress);
}

void replace_occluded(const LightField& lf, ViewStack<float>& disparity,
                      const ViewStack<float>& confidence, const Progress& progress) {
  const auto light_field = on_device(lf, progress.part(0, 0));
  const DeviceStream stream;
  auto d = upload(disparity.data(), disparity.size(), stream, progress);
  auto r = upload(confidence.data(), confidence.size(), stream, progress);
  DeviceArray<float> out(disparity.size(), stream);
  const PackedFieldMemory packed(light_field->samples(), stream);
  const MapPointers maps{disparity.grid(), disparity.first(), d.data(), r.data()};
  const float variance = residual_noise(packed.field(), maps, stream);
  replace_seen_through(packed.field(), maps, variance, out.data(), stream);
  download(disparity, out, stream, progress);
}

}  // namespace episcope::cuda
