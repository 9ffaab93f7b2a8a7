// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/result_fit.h"

#include "app/session/command_line.h"
#include "app/session/judge.h"
#include "engine/core/disparity_field.h"
#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/numbers.h"
#include "engine/io/base/json.h"
#include "engine/io/models/order/truth_views.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace episcope {

std::string reason_against_fit(const std::string& who, const MapGeometry& maps,
                               const std::string& other_name, const MapGeometry& other) {
  if (maps.grid.count() == 0 || other.grid.count() == 0) return {};
  if (maps.height != other.height || maps.width != other.width) {
    return fmt::format("{} has {}×{} px, but {} has {}×{} px", who, maps.width, maps.height,
                       other_name, other.width, other.height);
  }
  const bool is_of_one = maps.grid.count() == 1 || other.grid.count() == 1;
  if (is_of_one || maps.grid == other.grid) return {};
  return fmt::format("{} has {}×{} views, but {} has {}×{}", who, maps.grid.v, maps.grid.u,
                     other_name, other.grid.v, other.grid.u);
}

void check_fits(const Estimate& estimate, const LightField& light_field, const std::string& file) {
  const MapGeometry maps = geometry_of(estimate.field.disparity);
  std::string reason =
      reason_against_fit("the map", maps, light_field.info().name, geometry_of(light_field));
  const ViewIndex last{maps.first.v + maps.grid.v - 1, maps.first.u + maps.grid.u - 1};
  if (reason.empty() && !light_field.grid().contains(last)) {
    reason = fmt::format("the map is of view {}, but {} has {}×{} views", view_text(last),
                         light_field.info().name, light_field.grid().v, light_field.grid().u);
  }
  if (reason.empty()) return;
  throw InvalidInput(file + ": " + reason +
                     "; name the light field of the estimate, or bring a map of another resolution "
                     "to this size (--map-resize)");
}

void check_fits(const ViewStack<std::int32_t>& labels, const LightField& light_field,
                const std::string& file) {
  const std::string reason = reason_against_fit("the labeling", geometry_of(labels),
                                                light_field.info().name, geometry_of(light_field));
  if (!reason.empty()) throw InvalidInput(file + ": " + reason + "; name its own light field");
}

bool is_of_other_samples(const Estimate& estimate, const LightField& light_field) {
  return estimate.source_hash != 0 && estimate.source_hash != light_field.sample_hash();
}

namespace {

ParameterSet without_focus(ParameterSet options) {
  std::erase_if(options, [](const auto& option) { return option.first == Reading::kFocus; });
  return options;
}

}  // namespace

std::string differing_options(const Estimate& estimate, const LightField& light_field) {
  const Reading& own = estimate.reading;
  const Reading& other = light_field.info().reading;
  if (own.reader != other.reader || own.reader.empty()) return {};
  if (without_focus(own.options) == without_focus(other.options)) return {};
  const std::string text = reading_options_text(without_focus(own.options));
  return text.empty() ? "no options" : text;
}

std::string options_missing_in(const Reading& other, const Reading& reading) {
  ParameterSet options = without_focus(reading.options);
  std::erase_if(options, [&other](const auto& option) {
    return std::ranges::count(other.options, option) > 0;
  });
  return reading_options_text(options);
}

namespace {

std::string other_samples_text(const Estimate& estimate, const LightField& light_field) {
  const Reading& own = estimate.reading;
  const Reading& other = light_field.info().reading;
  std::string text =
      "the result was estimated from other samples than " + light_field.info().name + " has";
  if (const std::string more = options_missing_in(other, own); !more.empty()) {
    text += "; its own were read with" + more;
  } else if (const std::string less = options_missing_in(own, other); !less.empty()) {
    text += "; its own were read without" + less;
  }
  return text;
}

/// The view in which a result is compared with truth and views; none if it does not fit.
std::optional<ViewIndex> compared_view(const Estimate& estimate, const Scene& scene) {
  const LightField& light_field = *scene.light_field;
  const ViewStack<float>& maps = estimate.field.disparity;
  const ViewIndex judged = judged_view(scene);
  const ViewIndex view = estimate.field.contains(judged) ? judged : maps.first();
  const bool fits = maps.height() == light_field.height() && maps.width() == light_field.width() &&
                    light_field.grid().contains(view) && estimate.layered.foreground.empty();
  return fits ? std::optional(view) : std::nullopt;
}

}  // namespace

std::optional<io::BetterReading> find_better_reading(const Estimate& estimate, const Scene& scene) {
  const LightField& light_field = *scene.light_field;
  const DisparityField& truth = scene.truth->field;
  const auto view = compared_view(estimate, scene);
  if (!view) return std::nullopt;
  const bool has_truth = truth.contains(*view);
  if (!has_truth && !estimate.version.empty()) return std::nullopt;
  io::MapEvidence evidence{light_field, *view};
  if (!has_truth) return io::find_better_reading(estimate.field.view(*view), evidence);
  const ShownDisparity shown(truth.view(*view), light_field.valid_of(*view));
  evidence.truth = shown.view();
  auto better = io::find_better_reading(estimate.field.view(*view), evidence);
  // This program writes NaN where nothing is known: a value that many pixels have ends its range.
  const bool is_own = !estimate.version.empty();
  return better && is_own && !better->reading.missing.empty() ? std::nullopt : std::move(better);
}

namespace {

/// "MSE×100 0.08 instead of 194", "1.9 instead of 6.3 grey levels between views".
std::string both_numbers(const io::BetterReading& found) {
  std::string text;
  if (found.as_read.mse_100 && found.better.mse_100) {
    text = fmt::format("MSE×100 {:.3g} instead of {:.3g}", *found.better.mse_100,
                       *found.as_read.mse_100);
  }
  if (found.better.grey_levels) {
    text +=
        fmt::format("{}{:.3g} instead of {} grey levels between the views",
                    text.empty() ? "" : ", ", *found.better.grey_levels,
                    found.as_read.grey_levels ? fmt::format("{:.3g}", *found.as_read.grey_levels)
                                              : "any number of");
  }
  return text;
}

// Options that read a map so, as on the command line: " --map-transpose --map-scale=0.01".
std::string map_options_text(const io::MapReading& reading) {
  return options_text(io::given_options(reading), io::map_schema().descriptions());
}

}  // namespace

std::string better_reading_finding(const io::BetterReading& found) {
  const std::string reading = io::reading_text(found.reading);
  const std::string numbers = both_numbers(found);
  if (!found.as_read.mse_100) {
    return fmt::format(finding_text("map.nearer_to_views"), reading, numbers);
  }
  return found.is_contradicted()
             ? fmt::format(finding_text("map.nearer_to_truth_alone"), reading, numbers)
             : fmt::format(finding_text("map.nearer_to_truth"), reading, numbers);
}

std::string better_reading_text(const io::BetterReading& found) {
  const char* remedy =
      found.is_contradicted() ? ": check the ground truth, or add" : "; if it is stored so, add";
  return better_reading_finding(found) + remedy + map_options_text(found.reading);
}

namespace {

/// Both numbers, as read and by the options that would fit better.
nlohmann::ordered_json better_reading_json(const io::BetterReading& found) {
  nlohmann::ordered_json json;
  json["options"] = map_options_text(found.reading).substr(1);
  json["reading"] = io::parameters_json(io::given_options(found.reading));
  const auto add = [&json](const char* key, std::optional<double> value) {
    if (value) json[key] = *value;
  };
  add("mse_100", found.better.mse_100);
  add("mse_100_as_read", found.as_read.mse_100);
  add("grey_levels", found.better.grey_levels);
  add("grey_levels_as_read", found.as_read.grey_levels);
  return json;
}

/// Map − truth where both hold values.
std::vector<double> differences_of(const DisparityView& map, const DisparityView& truth) {
  std::vector<double> differences;
  for (int y = 0; y < truth.disparity.height; ++y) {
    for (int x = 0; x < truth.disparity.width; ++x) {
      if (!truth.is_valid(y, x) || !map.is_valid(y, x)) continue;
      differences.push_back(map.disparity.at(y, x) - truth.disparity.at(y, x));
    }
  }
  return differences;
}

io::Misfit squares_of(const std::vector<double>& differences, double offset = 0) {
  io::Misfit sum;
  for (const double each : differences) sum += {(each - offset) * (each - offset), 1};
  return sum;
}

/// NaN without a pixel that both know.
double mse_100(const DisparityView& map, const DisparityView& truth) {
  const io::Misfit sum = squares_of(differences_of(map, truth));
  return 100 * sum.sum / sum.count;
}

bool all_views_are_known(const DisparityField& field) {
  for (int i = 0; i < field.disparity.grid().count(); ++i) {
    const DisparityView view = field.view(field.disparity.view_at(i));
    bool is_known = false;
    for (int y = 0; y < view.disparity.height && !is_known; ++y) {
      for (int x = 0; x < view.disparity.width; ++x) is_known |= view.is_valid(y, x);
    }
    if (!is_known) return false;
  }
  return true;
}

/// Of the error as read, below which another view or another constant explains a map far better.
constexpr double kFarBetter = 0.25;
constexpr double kSmallOffset_px = 0.1;

/// Whether maps of all views are in another order.
std::string other_order_text(const DisparityField& maps, const Scene& scene) {
  const DisparityField& truth = scene.truth->field;
  const GridShape grid = scene.light_field->grid();
  if (grid.count() == 1 || !(maps.disparity.grid() == grid && truth.disparity.grid() == grid) ||
      !all_views_are_known(maps) || !all_views_are_known(truth)) {
    return {};
  }
  const auto found = io::find_better_order(grid, 0, [&](ViewIndex view, ViewIndex place) {
    return squares_of(differences_of(maps.view(place), truth.view(view)));
  });
  if (!found) return {};
  return fmt::format(finding_text("map.views_exchanged"), found->order.text(), 100 * found->misfit,
                     100 * found->as_stored);
}

/// Whether a single map is of another view.
std::string other_view_text(const DisparityView& map, ViewIndex view, const Scene& scene) {
  const DisparityField& truth = scene.truth->field;
  const double as_read = mse_100(map, truth.view(view));
  double least = kFarBetter * as_read;
  std::optional<ViewIndex> best;
  for (int i = 0; i < truth.disparity.grid().count(); ++i) {
    const ViewIndex other = truth.disparity.view_at(i);
    const double mse = mse_100(map, truth.view(other));
    if (!(mse < least)) continue;  // also where they share no pixel
    least = mse;
    best = other;
  }
  if (!best) return {};
  return fmt::format(finding_text("map.of_other_view"), view_text(*best), view_text(view), least,
                     as_read);
}

/// That a constant is off, unless the map would explain little without it, too; or that the map
/// explains little.
std::string misfit_text(const DisparityView& map, const DisparityView& truth) {
  std::vector<double> differences = differences_of(map, truth);
  if (differences.empty()) return {};
  const double as_read = 100 * squares_of(differences).mean();
  const double offset = quantile(differences, 0.5);
  const double without = 100 * squares_of(differences, offset).mean();
  const auto poor = io::find_poor_fit(map, truth);
  const bool is_enough = !poor || without < kFarBetter * poor->constant_mse_100;
  if (std::abs(offset) >= kSmallOffset_px && without < kFarBetter * as_read && is_enough) {
    return fmt::format(finding_text("map.offset"), offset, without, as_read);
  }
  if (!poor) return {};
  return fmt::format(finding_text("map.poor"), poor->mse_100, poor->constant_mse_100);
}

}  // namespace

std::string doubt_text(const Estimate& estimate, const Scene& scene, bool is_of_others) {
  const auto view = compared_view(estimate, scene);
  if (!view || !scene.truth->field.contains(*view)) return {};
  if (estimate.source_hash != 0 && !is_of_others) return {};
  const bool is_foreign = estimate.version.empty();
  std::string text = is_foreign ? other_order_text(estimate.field, scene) : std::string();
  const DisparityView map = estimate.field.view(*view);
  if (text.empty() && is_foreign && estimate.field.disparity.grid().count() == 1) {
    text = other_view_text(map, *view, scene);
  }
  const ShownDisparity shown(scene.truth->field.view(*view), scene.light_field->valid_of(*view));
  return text.empty() ? misfit_text(map, shown.view()) : text;
}

bool is_ground_truth(const Estimate& estimate, const Scene& scene) {
  const auto view = compared_view(estimate, scene);
  return estimate.version.empty() && view && scene.truth->field.contains(*view) &&
         mse_100(estimate.field.view(*view), scene.truth->field.view(*view)) == 0;
}

std::vector<std::string> ResultFit::sentences() const {
  std::vector<std::string> all = notes;
  if (better) all.push_back(better_reading_text(*better));
  return all;
}

ResultFit fit_of(const Estimate& estimate, const Scene& scene) {
  ResultFit fit;
  if (estimate.version.empty()) fit.notes = estimate.notes;
  const bool is_of_others = is_of_other_samples(estimate, *scene.light_field);
  if (is_of_others) fit.notes.push_back(other_samples_text(estimate, *scene.light_field));
  fit.better = find_better_reading(estimate, scene);
  if (!fit.better) fit.notes.push_back(doubt_text(estimate, scene, is_of_others));
  std::erase(fit.notes, std::string());
  return fit;
}

std::vector<std::string> truth_warnings(const ConventionReport& report) {
  std::vector<std::string> warnings = report.warnings;
  std::erase_if(warnings, [](const std::string& warning) {
    const auto finding = finding_of(warning);
    if (!finding || finding->code == "truth.estimated") return true;  // `judge` says it
    return !(finding->code.starts_with("truth.") || finding->code.starts_with("map.") ||
             finding->code.starts_with("depth."));
  });
  return warnings;
}

JudgedResult judge_result(const Estimate& estimate, const Scene& scene,
                          const EvaluationOptions& options, ViewIndex view) {
  JudgedResult judged{
      std::make_shared<const Evaluation>(judge(estimate, scene, options, view)), view, {}, {}};
  const ResultFit fit = fit_of(estimate, scene);
  judged.better = fit.better;
  judged.notes = fit.sentences();
  std::ranges::copy(judged.evaluation->notes, std::back_inserter(judged.notes));
  return judged;
}

nlohmann::ordered_json judged_json(const Estimate& estimate, const Scene& scene,
                                   const JudgedResult& judged, Protocol protocol,
                                   const Metrics& metrics) {
  nlohmann::ordered_json json{{"method", estimate.method}};
  const std::string& units = scene.convention.units;
  if (!units.empty()) json["truth_units"] = units;
  json["view"] = {judged.view.v, judged.view.u};
  for (const auto& [key, value] : metrics) json[key] = value;
  if (estimate.seconds > 0) {
    json["seconds"] = estimate.seconds;
    if (protocol == Protocol::Vmv2013) json["runtime_class"] = runtime_class(estimate.seconds);
  }
  json["all_views"] = estimate.field.disparity.grid() == scene.light_field->grid();
  if (judged.better) json["better_reading"] = better_reading_json(*judged.better);
  std::vector<std::string> notes = judged.notes;
  std::ranges::move(truth_warnings(scene.convention), std::back_inserter(notes));
  if (!notes.empty()) json["notes"] = notes;
  return json;
}

}  // namespace episcope
