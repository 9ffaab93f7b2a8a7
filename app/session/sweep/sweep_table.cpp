// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/sweep/sweep_table.h"

#include "app/session/sweep/sweep_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace episcope {
namespace {

std::optional<double> find_any(const Metrics& metrics, const std::string& key) {
  for (const char* end : {"", "_lowres", "_foreground", "_lowres_foreground"}) {
    if (const auto value = find_metric(metrics, key + end)) return value;
  }
  return std::nullopt;
}

const ParameterValue* value_at(const ParameterSet& point, const std::string& key) {
  const auto found = std::ranges::find(point, key, &ParameterSet::value_type::first);
  return found == point.end() ? nullptr : &found->second;
}

bool is_tried(const ParameterSet& point, const SweptParameter& swept) {
  const ParameterValue* value = value_at(point, swept.key);
  return value && std::ranges::count(swept.values, *value) > 0;
}

SweepLine line_of(const std::vector<SweepPoint>& points, const std::vector<SweptParameter>& swept,
                  const ParameterValue* second) {
  SweepLine line;
  if (second) line.name = swept[1].key + " " + to_text(*second);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ParameterSet& point = points[i].point;
    if (!std::ranges::all_of(swept, [&](const auto& each) { return is_tried(point, each); }) ||
        (second && *value_at(point, swept[1].key) != *second)) {
      continue;
    }
    line.places.push_back({number_of(*value_at(point, swept[0].key)), i});
  }
  std::ranges::sort(line.places, {}, &SweepLine::Place::x);
  return line;
}

struct NamedMetrics {
  const char* name;
  Metrics SweepPoint::*metrics;
};
constexpr std::array kMetrics = {NamedMetrics{"vmv2013", &SweepPoint::vmv2013},
                                 NamedMetrics{"benchmark2016", &SweepPoint::benchmark2016}};

std::string text_of(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : std::string();
}

using MetricKeys = std::array<std::vector<std::string>, kMetrics.size()>;

// Of all points, in the order in which they are met first.
MetricKeys metric_keys(const std::vector<SweepScene>& scenes) {
  MetricKeys keys;
  for (std::size_t i = 0; i < kMetrics.size(); ++i) {
    for (const SweepScene& scene : scenes) {
      for (const SweepPoint& point : scene.points) {
        for (const auto& [key, value] : point.*kMetrics[i].metrics) {
          if (std::ranges::count(keys[i], key) == 0) keys[i].push_back(key);
        }
      }
    }
  }
  return keys;
}

void add_cells(const SweepPoint& point, const MetricKeys& keys, std::vector<std::string>& cells) {
  for (const auto& [key, value] : point.point) cells.push_back(to_text(value));
  for (std::size_t i = 0; i < kMetrics.size(); ++i) {
    for (const auto& key : keys[i]) {
      cells.push_back(text_of(find_metric(point.*kMetrics[i].metrics, key)));
    }
  }
  cells.push_back(text_of(measure_of(point, SweepMeasure::Seconds)));
  cells.push_back(text_of(point.change_px));
  cells.push_back(point.problem);
}

}  // namespace

std::optional<double> measure_of(const SweepPoint& point, SweepMeasure measure) {
  switch (measure) {
    case SweepMeasure::MseTimes100:
      return find_any(point.vmv2013, "mse_100");
    case SweepMeasure::BadPix007:
      return find_any(point.benchmark2016, "badpix_0070");
    case SweepMeasure::BadPix003:
      return find_any(point.benchmark2016, "badpix_0030");
    case SweepMeasure::BadPix001:
      return find_any(point.benchmark2016, "badpix_0010");
    case SweepMeasure::Change:
      return point.change_px;
    case SweepMeasure::Seconds:
      break;
  }
  return point.seconds > 0 ? std::optional(point.seconds) : std::nullopt;
}

std::vector<SweepLine> lines_of(const std::vector<SweepPoint>& points,
                                const std::vector<SweptParameter>& swept) {
  if (swept.size() < 2) return {line_of(points, swept, nullptr)};
  std::vector<SweepLine> lines;
  for (const ParameterValue& second : swept[1].values) {
    lines.push_back(line_of(points, swept, &second));
  }
  return lines;
}

std::optional<double> mean_of(const std::vector<SweepScene>& scenes, std::size_t point,
                              SweepMeasure measure) {
  double sum = 0;
  for (const SweepScene& scene : scenes) {
    if (point >= scene.points.size()) return std::nullopt;
    const auto value = measure_of(scene.points[point], measure);
    if (!value) return std::nullopt;
    sum += *value;
  }
  if (scenes.empty()) return std::nullopt;
  return sum / static_cast<double>(scenes.size());
}

std::size_t common_count(const std::vector<SweepScene>& scenes) {
  if (scenes.empty()) return 0;
  return std::ranges::min_element(scenes, {},
                                  [](const SweepScene& each) { return each.points.size(); })
      ->points.size();
}

TextTable sweep_table(const std::vector<SweepScene>& scenes,
                      const std::vector<std::pair<std::string, std::string>>& columns_of_all) {
  TextTable table;
  table.header.emplace_back("scene");
  for (const auto& [key, value] : columns_of_all) table.header.push_back(key);
  const auto judged =
      std::ranges::find_if(scenes, [](const SweepScene& each) { return !each.points.empty(); });
  if (judged == scenes.end()) return table;
  for (const auto& [key, value] : judged->points.front().point) table.header.push_back(key);
  const MetricKeys keys = metric_keys(scenes);
  for (std::size_t i = 0; i < kMetrics.size(); ++i) {
    for (const auto& key : keys[i]) table.header.push_back(kMetrics[i].name + ("." + key));
  }
  table.header.insert(table.header.end(), {"seconds", "change_px", "problem"});
  for (const SweepScene& scene : scenes) {
    for (const SweepPoint& point : scene.points) {
      auto& cells = table.rows.emplace_back();
      cells.push_back(scene.name);
      for (const auto& [key, value] : columns_of_all) cells.push_back(value);
      add_cells(point, keys, cells);
    }
  }
  return table;
}

}  // namespace episcope
