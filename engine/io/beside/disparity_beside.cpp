// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/disparity_beside.h"

#include "engine/core/error.h"
#include "engine/core/text/text_table.h"
#include "engine/io/arrays/array_maps.h"
#include "engine/io/beside/baseline_file.h"
#include "engine/io/beside/depth_fit.h"
#include "engine/io/beside/map_file.h"
#include "engine/io/beside/map_scale.h"
#include "engine/io/beside/near_side.h"
#include "engine/io/beside/read_set.h"
#include "engine/io/beside/settle_values.h"
#include "engine/io/beside/truth_sign.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

/// Maps as stored, and where from.
struct StoredMaps {
  DisparityField field;
  const MapSet* set = nullptr;
  double scale = 1;  ///< Pixels of the map as stored in a pixel of the views.

  /// The map by which the others are judged.
  [[nodiscard]] ViewIndex at(GridShape grid) const {
    return field.contains(grid.center()) ? grid.center() : field.disparity.first();
  }
};

StoredMaps read_first(const std::vector<const MapSet*>& sets, const std::string& kind,
                      const BesideViews& views, const BesideNotes& notes,
                      const Progress& progress) {
  StoredMaps found;
  for (const MapSet* set : sets) {
    if (found.set != nullptr) {
      notes.account.leave_out(set->files(), kind + " once more");
      continue;
    }
    SetOutcome outcome;
    found.field = read_value_set(*set, views, outcome, progress);
    if (!found.field.empty()) found.set = set;
    found.scale = outcome.map_scale;
    outcome.tell(kind, notes);
  }
  return found;
}

std::string grey(double error) {
  return fixed_text(error, 2);
}

std::string warp_text(const SettledUnit& settled) {
  const Explanation& found = settled.explanation;
  std::string text = "mean grey error of neighbouring views after warping " + grey(found.error) +
                     ", unwarped " + grey(found.unwarped);
  if (settled.unit.factor != 1 && settled.first.error != found.error) {
    text += ", with the values as stored " + grey(settled.first.error);
  }
  return text;
}

std::string fit_text(const DepthFit& fit) {
  return fmt::format("{:.1f} % of the depth map agree within 0.01 px with d = {:.6g}/Z {} {:.6g}",
                     100 * fit.exact_share, fit.a, fit.b < 0 ? "+" : "−", std::abs(fit.b));
}

/// Depth beside it tells the sign of disparity where no pixel hides another.
TruthSign sign_of(const LightField::Samples& samples, const NearSide& side, const DepthFit& fit,
                  const Explanation& explanation) {
  if (!side.is_decided() && fit.is_exact()) return {fit.a < 0, true, {}};
  return find_truth_sign(samples, side, explanation);
}

void append(std::string& text, const std::string& more) {
  text += (text.empty() ? "" : "; ") + more;
}

DepthFit fit_of(const StoredMaps& depth, const StoredMaps& maps, ViewIndex at, double factor) {
  const bool has_both = depth.field.contains(at) && maps.field.contains(at);
  if (!has_both) return {};
  return fit_depth(maps.field.view(at), factor, depth.field.view(at));
}

/// For the report.
std::string name_of(const MapSet& set) {
  return set.is_named_labels ? fmt::format("{} ({})", set.pattern, kNamedLabels) : set.pattern;
}

/// Depth maps of the view by which the disparity is judged.
StoredMaps read_one_depth(const RankedSets& sets, const BesideViews& views, ViewIndex at) {
  for (const MapSet* set : sets.fit) {
    const int view = at.v * views.grid().u + at.u;
    MapSet one{set->kind, set->pattern, {{view, set->file_of(view)}}, {}};
    if (one.entries.front().file.empty()) continue;
    SetOutcome outcome;
    StoredMaps maps{read_value_set(one, views, outcome, Progress(1)), set, 1};
    if (!maps.field.empty()) return maps;
  }
  return {};
}

void tell_depth(const RankedSets& sets, const MapSet* used, const DepthFit& fit,
                const BesideNotes& notes) {
  for (const MapSet* set : sets.fit) {
    if (set == used && fit.is_exact()) {
      notes.account.use(set->files(), "depth maps");
    } else {
      notes.account.leave_out(set->files(), "depth maps, as disparity is there");
    }
  }
}

/// Values of maps of another size may count their own pixels, or those of the views: first that
/// which explains the views better.
void add_unit_of_size(const StoredMaps& maps, const BesideViews& views,
                      std::vector<MapUnit>& units) {
  if (maps.scale == 1) return;
  const MapUnit own{1 / maps.scale, fmt::format("px of the map as stored, {:.4g} of which are one "
                                                "of the views, per view step",
                                                maps.scale)};
  const ViewIndex at = maps.at(views.grid());
  const auto error = [&](const MapUnit& unit) {
    return explain_views(views.samples, at, maps.field.view(at), unit.factor).error;
  };
  const bool is_better = error(own) < error(units.front());
  units.insert(is_better ? units.begin() : units.begin() + 1, own);
}

DisparityBeside from_disparity(StoredMaps maps, const RankedSets& depths, const BesideViews& views,
                               const BesideNotes& notes) {
  const ViewIndex at = maps.at(views.grid());
  std::vector<MapUnit> units = common_units(views.grid(), views.width());
  if (const auto stated = stated_unit(views.folder, notes.account)) {
    units.insert(units.begin(), *stated);
  }
  add_unit_of_size(maps, views, units);
  const SettledUnit settled =
      settle_values(views.samples, units, {maps.field, name_of(*maps.set)}, notes.report);
  const double factor = settled.unit.factor;
  NearSide side;
  if (settled.explanation.is_good()) {
    side = find_near_side(views.samples, at, maps.field.view(at), factor, settled.explanation);
  }
  const StoredMaps depth = read_one_depth(depths, views, at);
  const DepthFit fit = fit_of(depth, maps, at, factor);
  tell_depth(depths, depth.set, fit, notes);

  const TruthSign told = sign_of(views.samples, side, fit, settled.explanation);
  const double sign = told.is_negated ? -1 : 1;
  scale_values(maps.field, sign * factor);
  ConventionReport& report = notes.report;
  report.units = "disparity of " + name_of(*maps.set) + ": " + settled.unit.text +
                 (sign < 0 ? ", negative = nearer" : "");
  report.units_check = warp_text(settled);
  if (!told.evidence.empty()) append(report.units_check, told.evidence);
  if (fit.is_exact()) append(report.units_check, fit_text(fit));
  DisparityBeside found{std::move(maps.field), views.camera, !told.is_known};
  if (fit.is_exact() && sign * fit.a > 0 && !views.camera.is_known()) {
    found.camera = DepthFit{sign * fit.a, sign * fit.b, fit.exact_share, fit.pixels}.camera();
    append(report.units_check, "the camera follows from disparity and depth");
  }
  return found;
}

/// Maps of which no file says what their numbers mean.
struct UnknownSets {
  const std::vector<const MapSet*>& sets;
  std::string name;
  std::vector<ValueForm> forms;
  std::string left_out;  ///< Why they are not used if the views do not tell either.
};

/// Takes the first set whose numbers the views explain, unless there is disparity already; the
/// others are left out.
void add_unknown(const UnknownSets& unknown, const BesideViews& views, const BesideNotes& notes,
                 DisparityBeside& found) {
  for (const MapSet* set : unknown.sets) {
    if (set->entries.empty()) continue;
    SetOutcome outcome;
    DisparityField field;
    if (found.field.empty()) field = read_value_set(*set, views, outcome, Progress(1));
    std::optional<FittedMeaning> meaning;
    if (!field.empty()) {
      const NamedValues values{field, set->pattern};
      meaning = settle_unknown_values(views.samples, unknown.forms, values, notes.report);
    }
    if (!meaning) {
      notes.account.leave_out(set->files(), unknown.left_out);
      continue;
    }
    outcome.tell(unknown.name, notes);
    found.field = std::move(field);
    found.is_sign_assumed = meaning->is_sign_assumed;
    if (!views.camera.is_known() || views.is_shift_unknown) found.camera = meaning->camera();
  }
}

ViewStack<float> disparity_of(ViewStack<float> depth, const CameraGrid& camera) {
  std::transform(depth.data(), depth.data() + depth.size(), depth.data(), [&](float value) {
    return static_cast<float>(camera.disparity_from_depth(value));
  });
  return depth;
}

/// Whether depth of the centre view, by the camera as it is, explains the views; also where there
/// is none.
bool camera_explains(const RankedSets& depths, const BesideViews& views) {
  const ViewIndex at = views.grid().center();
  StoredMaps depth = read_one_depth(depths, views, at);
  if (depth.field.empty()) return true;
  depth.field.disparity = disparity_of(std::move(depth.field.disparity), views.camera);
  tidy_valid(depth.field);
  return explain_views(views.samples, at, depth.field.view(at), 1).is_good();
}

DisparityBeside from_depth(const RankedSets& sets, const BesideViews& views,
                           const BesideNotes& notes, const Progress& progress) {
  StoredMaps maps = read_first(sets.fit, kind_text(MapKind::Depth), views, notes, progress);
  if (maps.field.empty()) return {{}, views.camera};
  maps.field.disparity = disparity_of(std::move(maps.field.disparity), views.camera);
  tidy_valid(maps.field);
  const ViewIndex at = maps.at(views.grid());
  const SettledUnit settled =
      settle_unit(views.samples, at, maps.field.view(at), {{1, "px per view step"}});
  notes.report.units = "disparity from " + maps.set->pattern + " and the camera";
  notes.report.units_check = warp_text(settled);
  return {std::move(maps.field), views.camera};
}

}  // namespace

DisparityBeside read_disparity_beside(const std::vector<MapSet>& sets, const BesideViews& views,
                                      const BesideNotes& notes, const Progress& progress) {
  const RankedSets disparities = rank_sets(sets, MapKind::Disparity, can_hold_values);
  const RankedSets depths = rank_sets(sets, MapKind::Depth, can_hold_values);
  const bool has_camera =
      views.camera.is_known() && (!views.is_shift_unknown || camera_explains(depths, views));
  DisparityBeside found{{}, views.camera};
  StoredMaps maps =
      read_first(disparities.fit, kind_text(MapKind::Disparity), views, notes, progress);
  const bool has_disparity = !maps.field.empty();
  if (has_disparity) {
    found = from_disparity(std::move(maps), depths, views, notes);
  } else if (has_camera) {
    found = from_depth(depths, views, notes, progress);
  }
  const std::vector<ValueForm> depth_forms{ValueForm::Inverse, ValueForm::Linear};
  if (!has_disparity && !has_camera) {
    add_unknown({depths.fit, kind_text(MapKind::Depth), depth_forms,
                 "depth maps, as no camera parameters are known"},
                views, notes, found);
  }
  add_unknown({disparities.unfit,
               "pictures of disparity",
               {ValueForm::Linear},
               "pictures of disparity, of unknown scale"},
              views, notes, found);
  add_unknown(
      {depths.unfit, "pictures of depth", depth_forms, "pictures of depth, of unknown scale"},
      views, notes, found);
  return found;
}

}  // namespace episcope::io
