// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/picture/result_map.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace episcope {
namespace {

using render::Quantity;
using Map = std::shared_ptr<QuantityMap>;

Map counted_map(ImageView<const std::uint8_t> counts) {
  auto made = std::make_shared<QuantityMap>();
  made->computed = Image<float>(counts.height, counts.width);
  std::copy_n(counts.data, counts.size(), made->computed.data());
  made->map = made->computed;
  return made;
}

constexpr ResultMap kResultMaps[] = {
    {Quantity::Disparity, "disparity",
     [](const Estimate& estimate) { return coverage_of(estimate.field.disparity); },
     [](const EstimatePtr& estimate, ViewIndex view) {
       return borrowed_map(estimate->field.view(view), estimate);
     }},
    {Quantity::Confidence, "confidence",
     [](const Estimate& estimate) { return coverage_of(estimate.confidence); },
     [](const EstimatePtr& estimate, ViewIndex view) {
       return borrowed_map({estimate->confidence.view(view), {}}, estimate);
     }},
    {Quantity::Background, "background",
     [](const Estimate& estimate) { return coverage_of(estimate.layered.background.disparity); },
     [](const EstimatePtr& estimate, ViewIndex view) {
       return borrowed_map(estimate->layered.background.view(view), estimate);
     }},
    {Quantity::Layers, "number of layers",
     [](const Estimate& estimate) { return coverage_of(estimate.layered.layers); },
     [](const EstimatePtr& estimate, ViewIndex view) {
       return counted_map(estimate->layered.layers.view(view));
     }}};

}  // namespace

const ResultMap& result_map_of(Quantity quantity) {
  const auto* found = std::ranges::find(kResultMaps, quantity, &ResultMap::quantity);
  return found == std::end(kResultMaps) ? kResultMaps[0] : *found;
}

Map borrowed_map(const DisparityView& view, std::shared_ptr<const void> owner) {
  auto made = std::make_shared<QuantityMap>();
  made->map = view.disparity;
  made->valid = view.valid;
  made->owner = std::move(owner);
  return made;
}

}  // namespace episcope
