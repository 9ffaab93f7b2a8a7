// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/transfer.cuh"
#include "engine/cuda/rays/view_rays.cuh"

namespace episcope::cuda {
namespace {

// One map after the other; empty if the first view has none.
template <class T, class Map>
DeviceArray<T> upload_views(const RayLabelsTask& task, std::size_t each, const Map& map_of,
                            const DeviceStream& stream, const Progress& progress) {
  if (map_of(task.views.front()) == nullptr) return {};
  DeviceArray<T> maps(each * task.views.size(), stream);
  for (std::size_t i = 0; i < task.views.size(); ++i) {
    upload_bytes(maps.data() + i * each, map_of(task.views[i]), each * sizeof(T), stream, progress);
  }
  return maps;
}

}  // namespace

ViewRaysMemory::ViewRaysMemory(const RayLabelsTask& task, const DeviceStream& stream,
                               const Progress& progress) {
  const auto& first = task.views.front().probabilities;
  const std::size_t pixels =
      static_cast<std::size_t>(first.height) * static_cast<std::size_t>(first.width);
  const auto upload_maps = [&]<class T>(const T* RayView::*map, std::size_t each) {
    return upload_views<T>(
        task, each, [map](const RayView& view) { return view.*map; }, stream, progress);
  };
  probabilities_ = upload_views<std::uint8_t>(
      task, first.size(), [](const RayView& view) { return view.probabilities.data; }, stream,
      progress);
  weights_ = upload_maps(&RayView::weights, pixels);
  disparity_ = upload_maps(&RayView::disparity, pixels);
  valid_ = upload_maps(&RayView::valid, pixels);
  colors_ = upload_maps(&RayView::colors, pixels * static_cast<std::size_t>(task.channels));
  costs_ = upload(task.costs.data(), task.costs.size(), stream, progress);
  if (!colors_.empty()) {
    trusts_ = upload(task.trusts.data(), task.trusts.size(), stream, progress);
  }
  rays_.grid = task.grid;
  rays_.height = first.height;
  rays_.width = first.width;
  rays_.layers = first.layers;
  rays_.channels = task.channels;
  rays_.probabilities = probabilities_.data();
  rays_.weights = weights_.data();
  rays_.disparity = disparity_.data();
  rays_.valid = valid_.data();
  rays_.colors = colors_.data();
  rays_.costs = costs_.data();
  rays_.trusts = trusts_.data();
  rays_.most_difference = static_cast<int>(task.trusts.size()) - 1;
  rays_.tolerance_px = task.tolerance_px;
}

}  // namespace episcope::cuda
