// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/sweep.h"

#include "app/session/judge.h"
#include "app/session/open_scene.h"
#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/core/text.h"
#include "engine/disparity/registry.h"
#include "engine/evaluation/parameter_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <sstream>

namespace episcope {
namespace {

std::optional<double> median_change(const DisparityView& a, const DisparityView& b) {
  std::vector<float> changes;
  for (int y = 0; y < a.disparity.height; ++y) {
    for (int x = 0; x < a.disparity.width; ++x) {
      if (!a.is_valid(y, x) || !b.is_valid(y, x)) continue;
      changes.push_back(std::abs(a.disparity.at(y, x) - b.disparity.at(y, x)));
    }
  }
  if (changes.empty()) return std::nullopt;
  return quantile(changes, 0.5);
}

void fill(const Scene& scene, const EstimateRequest& request, const Estimate* reference,
          const Progress& progress, SweepPoint& point) {
  const FinishedEstimate finished =
      run_estimator(scene, find_estimator(request.method), request.parameters, request.options,
                    progress.part(0, 0.97));
  point.estimate = finished.estimate;
  point.display_range = finished.display_range;
  point.seconds = finished.estimate->seconds;
  const ViewIndex center = scene.light_field->center();
  const Estimate& other = reference ? *reference : *finished.estimate;
  if (finished.estimate->contains(center) && other.contains(center)) {
    point.change_px =
        median_change(finished.estimate->field.view(center), other.field.view(center));
  }
  const GroundTruth& truth = *scene.truth;
  if (!truth.has_disparity() && !truth.has_layers()) return;
  ResultScores scores = judge_by_both(*finished.estimate, scene, progress);
  point.vmv2013 = std::move(scores.vmv2013);
  point.benchmark2016 = std::move(scores.benchmark2016);
  point.problem = std::move(scores.problem);
}

}  // namespace

bool has_truth(const SweepScene& scene) {
  return std::ranges::any_of(scene.points, [](const SweepPoint& point) {
    return !point.vmv2013.empty() || !point.benchmark2016.empty();
  });
}

bool is_of_scene(const Sweep& sweep, std::uint64_t scene) {
  return std::ranges::count(sweep.scenes, scene, &SweepScene::scene) > 0;
}

std::size_t point_count(const Sweep& sweep) {
  std::size_t count = 0;
  for (const SweepScene& scene : sweep.scenes) count += scene.points.size();
  return count;
}

ParameterSet values_at(const ParameterSet& values, const ParameterSet& point) {
  ParameterSet changed = values;
  for (const auto& [key, value] : point) set_value(changed, key, value);
  return changed;
}

std::vector<ParameterSet> sweep_points(const std::vector<ParameterDescription>& descriptions,
                                       const ParameterSet& base,
                                       const std::vector<SweptParameter>& swept) {
  std::vector<ParameterDescription> grid;
  std::size_t count = 1;
  for (const SweptParameter& each : swept) {
    const auto known = std::ranges::find(descriptions, each.key, &ParameterDescription::key);
    if (known == descriptions.end()) throw InvalidInput("there is no parameter " + each.key);
    grid.push_back(*known);
    grid.back().searched = each.values;
    if (const auto* present = find_value(base, each.key)) grid.back().default_value = *present;
    count *= each.values.size();
  }
  if (count > kMaxSearchPoints) {
    throw InvalidInput(fmt::format("{} points are too many: give fewer values, for {} at most",
                                   count, kMaxSearchPoints));
  }
  return search_grid(grid);
}

SweepPoint run_sweep_point(const Scene& scene, const EstimateRequest& base,
                           const ParameterSet& point, const Estimate* reference,
                           const Progress& progress) {
  SweepPoint result;
  result.point = point;
  const EstimateRequest request{
      base.method, values_at(base.parameters, point), {.views = ViewSelection::Center}};
  try {
    fill(scene, request, reference, progress, result);
  } catch (const Error& error) {
    progress.check();
    result.problem = error.what();
  } catch (const std::bad_alloc&) {
    result.problem = kNotEnoughMemory;
  }
  return result;
}

namespace {

std::size_t map_bytes(const std::vector<Sweep>& sweeps) {
  std::size_t bytes = 0;
  for (const Sweep& sweep : sweeps) {
    for (const SweepScene& scene : sweep.scenes) {
      for (const SweepPoint& point : scene.points) {
        if (point.estimate) bytes += byte_size(*point.estimate);
      }
    }
  }
  return bytes;
}

}  // namespace

const Sweep* SweepList::find(std::uint64_t id) const {
  const auto found = std::ranges::find(sweeps_, id, &Sweep::id);
  return found == sweeps_.end() ? nullptr : &*found;
}

Sweep* SweepList::find_own(std::uint64_t id) {
  return const_cast<Sweep*>(std::as_const(*this).find(id));
}

const SweepPoint* SweepList::find(std::uint64_t id, SweepPlace place) const {
  const Sweep* sweep = find(id);
  if (!sweep || place.scene >= sweep->scenes.size()) return nullptr;
  const auto& points = sweep->scenes[place.scene].points;
  return place.point < points.size() ? &points[place.point] : nullptr;
}

std::uint64_t SweepList::add(Sweep sweep) {
  for (SweepScene& scene : sweep.scenes) {
    for (SweepPoint& point : scene.points) point.estimate = nullptr;
  }
  sweep.id = ++last_id_;
  sweeps_.push_back(std::move(sweep));
  changed();
  return last_id_;
}

void SweepList::keep_map(SweepPoint& point, EstimatePtr map) const {
  point.estimate = nullptr;
  if (map && map_bytes(sweeps_) + byte_size(*map) <= kMapBudget) point.estimate = std::move(map);
}

void SweepList::add_point(std::uint64_t id, std::uint64_t scene, SweepPoint point) {
  Sweep* sweep = find_own(id);
  if (!sweep) return;
  const auto found = std::ranges::find(sweep->scenes, scene, &SweepScene::scene);
  if (found == sweep->scenes.end()) return;
  EstimatePtr map = std::exchange(point.estimate, nullptr);
  found->points.push_back(std::move(point));
  keep_map(found->points.back(), std::move(map));
  sweep->is_saved = false;
  changed();
}

void SweepList::set_map(std::uint64_t id, SweepPlace place, EstimatePtr map) {
  if (!find(id, place)) return;
  keep_map(find_own(id)->scenes[place.scene].points[place.point], std::move(map));
}

void SweepList::remove(std::uint64_t id) {
  if (std::erase_if(sweeps_, [id](const Sweep& each) { return each.id == id; }) > 0) changed();
}

void SweepList::mark_saved(const Sweep& written) {
  Sweep* sweep = find_own(written.id);
  if (sweep && point_count(*sweep) == point_count(written)) sweep->is_saved = true;
}

void SweepList::keep_scenes(const std::vector<std::uint64_t>& open) {
  std::size_t gone = 0;
  for (Sweep& each : sweeps_) {
    gone += std::erase_if(each.scenes, [&open](const SweepScene& part) {
      return std::ranges::count(open, part.scene) == 0;
    });
  }
  std::erase_if(sweeps_, [](const Sweep& each) { return each.scenes.empty(); });
  if (gone > 0) changed();
}

namespace {

std::optional<double> find_any(const Metrics& metrics, const std::string& key) {
  for (const char* end : {"", "_lowres", "_foreground", "_lowres_foreground"}) {
    if (const auto value = find_metric(metrics, key + end)) return value;
  }
  return std::nullopt;
}

bool is_tried(const ParameterSet& point, const SweptParameter& swept) {
  const ParameterValue* value = find_value(point, swept.key);
  return value && std::ranges::count(swept.values, *value) > 0;
}

SweepLine line_of(const std::vector<SweepPoint>& points, const std::vector<SweptParameter>& swept,
                  const ParameterValue* second) {
  SweepLine line;
  if (second) line.second = *second;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ParameterSet& point = points[i].point;
    if (!std::ranges::all_of(swept, [&](const auto& each) { return is_tried(point, each); }) ||
        (second && *find_value(point, swept[1].key) != *second)) {
      continue;
    }
    line.places.push_back({number_of(*find_value(point, swept[0].key)), i});
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

namespace {

constexpr int kProposed = 5;
constexpr double kEvenReach = 0.2;  // of the domain, to both sides of the present value
constexpr double kPowerReach = 4;   // factor, likewise
constexpr int kMostOfRange = 1000;

std::vector<std::string> split(std::string text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(std::move(text));
  for (std::string part; std::getline(stream, part, separator);) {
    part.erase(0, part.find_first_not_of(' '));
    part.erase(part.find_last_not_of(' ') + 1);
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

ParameterValue like(const ParameterDescription& description, double value) {
  if (std::holds_alternative<int>(description.default_value)) {
    return static_cast<int>(std::lround(value));
  }
  // A user reads these: four digits will do.
  return std::stod(fmt::format("{:.4g}", value));
}

std::vector<ParameterValue> spread(const ParameterDescription& description, double begin,
                                   double end, int count) {
  const bool in_powers = description.logarithmic && begin > 0 && end > 0;
  std::vector<ParameterValue> values;
  for (int i = 0; i < count; ++i) {
    const double share = count == 1 ? 0 : static_cast<double>(i) / (count - 1);
    values.push_back(like(description, in_powers ? begin * std::pow(end / begin, share)
                                                 : begin + share * (end - begin)));
  }
  return values;
}

std::vector<ParameterValue> parse_range(const ParameterDescription& description,
                                        const std::string& text) {
  const std::vector<std::string> parts = split(text, ':');
  const auto wrong = [&] {
    return InvalidInput("'" + text + "' is no range: write first:last:number, as 0.1:1.6:5");
  };
  if (parts.size() != 3) throw wrong();
  const double begin = number_of(parse_parameter(description, parts[0]));
  const double end = number_of(parse_parameter(description, parts[1]));
  ParameterDescription counting;
  counting.key = "number of values";
  counting.default_value = 0;
  counting.min = 1;
  counting.max = kMostOfRange;
  return spread(description, begin, end, std::get<int>(parse_parameter(counting, parts[2])));
}

std::vector<ParameterValue> sorted(std::vector<ParameterValue> values) {
  const auto is_less = [](const ParameterValue& a, const ParameterValue& b) {
    return number_of(a) < number_of(b);
  };
  std::sort(values.begin(), values.end(), is_less);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}  // namespace

bool can_sweep(const ParameterDescription& description) {
  return std::holds_alternative<int>(description.default_value) ||
         std::holds_alternative<double>(description.default_value);
}

double number_of(const ParameterValue& value) {
  if (const int* number = std::get_if<int>(&value)) return *number;
  return std::get<double>(value);
}

std::vector<ParameterValue> parse_sweep_values(const ParameterDescription& description,
                                               const std::string& text) {
  if (text.find(':') != std::string::npos) return sorted(parse_range(description, text));
  std::string spaced = text;
  std::replace(spaced.begin(), spaced.end(), ',', ' ');
  std::replace(spaced.begin(), spaced.end(), ';', ' ');
  std::vector<ParameterValue> values;
  for (const std::string& part : split(spaced, ' ')) {
    values.push_back(parse_parameter(description, part));
  }
  if (values.empty()) {
    throw InvalidInput("there are no values of " + description.label +
                       ": write some, as 0.1, 0.2, 0.4, or a range, as 0.1:1.6:5");
  }
  return sorted(std::move(values));
}

std::string proposed_sweep_values(const ParameterDescription& description) {
  std::vector<ParameterValue> values = description.searched;
  if (values.empty()) {
    const double present = number_of(description.default_value);
    const double reach = kEvenReach * (description.max - description.min);
    const bool in_powers = description.logarithmic && present > 0;
    const double begin = in_powers ? present / kPowerReach : present - reach;
    const double end = in_powers ? present * kPowerReach : present + reach;
    values = spread(description, std::max(begin, description.min), std::min(end, description.max),
                    kProposed);
  }
  return joined(sorted(std::move(values)), ", ",
                [](const ParameterValue& value) { return to_text(value); });
}

}  // namespace episcope
