// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/epi_measurement.h"

#include <fmt/format.h>

#include <cmath>

namespace episcope {
namespace {

// As RFC 4180: quotes around a text that needs them.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char each : text) {
    if (each == '"') quoted += '"';
    quoted += each;
  }
  return quoted + '"';
}

}  // namespace

const EpiMeasurement* current_of(const Measurements& measurements) {
  const auto count = static_cast<int>(measurements.list.size());
  const bool is_chosen = measurements.current >= 0 && measurements.current < count;
  return is_chosen ? &measurements.list[static_cast<std::size_t>(measurements.current)] : nullptr;
}

std::optional<double> depth_of(const EpiMeasurement& measurement, const CameraGrid& camera) {
  if (!camera.is_known()) return std::nullopt;
  const double depth = camera.depth_from_disparity(measurement.disparity_px);
  return std::isfinite(depth) ? std::optional(depth) : std::nullopt;
}

std::string measurements_csv(const std::vector<EpiMeasurement>& list, const CameraGrid& camera) {
  std::string csv = "name,direction,v,u,y,x,slope_px_per_view,disparity_px,depth\n";
  for (const EpiMeasurement& each : list) {
    const auto depth = depth_of(each, camera);
    csv += fmt::format("{},{},{},{},{},{},{:.4f},{:.4f},{}\n", field(each.name),
                       each.direction == EpiDirection::Horizontal ? "row" : "column", each.view.v,
                       each.view.u, each.pixel.y, each.pixel.x, -each.disparity_px,
                       each.disparity_px, depth ? fmt::format("{:.6g}", *depth) : "");
  }
  return csv;
}

}  // namespace episcope
