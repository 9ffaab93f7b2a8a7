// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/sidecar_maps.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/text_table.h"
#include "engine/io/base/files.h"
#include "engine/io/models/array_maps.h"
#include "engine/io/models/sidecar_maps/depth_fit.h"
#include "engine/io/models/sidecar_maps/map_file.h"
#include "engine/io/models/sidecar_maps/map_places.h"
#include "engine/io/models/sidecar_maps/scene_files.h"
#include "engine/io/models/sidecar_maps/sidecar_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestParameters = 1 << 16;

/// The number after a name, with anything but digits and letters between: "base_x = 0.05".
std::optional<double> number_after(const std::string& text, std::string_view name) {
  const std::size_t found = text.find(name);
  if (found == std::string::npos) return std::nullopt;
  const std::size_t begin = text.find_first_not_of(" \t\r\n\"':=,[(", found + name.size());
  if (begin == std::string::npos) return std::nullopt;
  const std::size_t end = text.find_first_not_of("0123456789.+-eE", begin);
  return parse_number(text.substr(begin, end == std::string::npos ? end : end - begin));
}

struct StoredMaps {
  DisparityField field;
  const MapSet* set = nullptr;
  double scale = 1;  ///< Pixels of the map as stored in a pixel of the views.
};

StoredMaps read_first(const std::vector<const MapSet*>& sets, const std::string& kind,
                      const SidecarViews& views, const SidecarNotes& notes,
                      const Progress& progress) {
  StoredMaps found;
  for (const MapSet* set : sets) {
    if (found.set != nullptr) {
      notes.account.leave_out(set->files(), kind + " once more");
      tell_equal_names(*found.set, *set, notes.report);
      continue;
    }
    SetOutcome outcome;
    found.field = read_value_set(*set, views, outcome, progress);
    if (!found.field.empty()) {
      found.set = set;
      notes.report.truth_files = outcome.read;
    }
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
  if (settled.unit.factor != 1 && settled.first.error != found.error) {
    return fmt::format(finding_text("units.warp_stored"), grey(found.error), grey(found.unwarped),
                       grey(settled.first.error));
  }
  return fmt::format(finding_text("units.warp"), grey(found.error), grey(found.unwarped));
}

std::string fit_text(const DepthFit& fit) {
  return fmt::format(finding_text("units.fit"), 100 * fit.exact_share, fit.a, fit.b < 0 ? "+" : "−",
                     std::abs(fit.b));
}

/// Depth beside it tells the sign of disparity where no pixel hides another.
TruthSign sign_of(const LightField::Samples& samples, const OcclusionOrder& side,
                  const DepthFit& fit, const Explanation& explanation) {
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
StoredMaps read_one_depth(const RankedSets& sets, const SidecarViews& views, ViewIndex at) {
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
                const SidecarNotes& notes) {
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
void add_unit_of_size(const StoredMaps& maps, const SidecarViews& views,
                      std::vector<MapUnit>& units) {
  if (maps.scale == 1) return;
  const MapUnit own{1 / maps.scale, fmt::format("px of the map as stored, {:.4g} of which are one "
                                                "of the views, per view step",
                                                maps.scale)};
  const ViewIndex at = told_view(maps.field, views.grid());
  const auto error = [&](const MapUnit& unit) {
    return explain_views(views.samples, at, maps.field.view(at), unit.factor).error;
  };
  const bool is_better = error(own) < error(units.front());
  units.insert(is_better ? units.begin() : units.begin() + 1, own);
}

/// Disparity found beside views, in px per view step, positive = nearer, in the stored order of
/// views.
struct SidecarDisparity {
  DisparityField field;          ///< Empty if there is none that can be used.
  CameraGrid camera;             ///< That of the views, or what disparity and depth say together.
  bool is_sign_assumed = false;  ///< Nothing tells near from far.
};

SidecarDisparity from_disparity(StoredMaps maps, const RankedSets& depths,
                                const SidecarViews& views, const SidecarNotes& notes) {
  const ViewIndex at = told_view(maps.field, views.grid());
  std::vector<MapUnit> units = common_units(views.grid(), views.width());
  if (const auto stated = stated_unit(views.folder, notes.account)) {
    units.insert(units.begin(), *stated);
  }
  add_unit_of_size(maps, views, units);
  const SettledUnit settled =
      infer_units(views.samples, units, {maps.field, name_of(*maps.set)}, notes.report);
  const double factor = settled.unit.factor;
  OcclusionOrder side;
  if (settled.explanation.is_good()) {
    side =
        find_occlusion_order(views.samples, at, maps.field.view(at), factor, settled.explanation);
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
  SidecarDisparity found{std::move(maps.field), views.camera, !told.is_known};
  if (fit.is_exact() && sign * fit.a > 0 && !views.camera.is_known()) {
    found.camera = DepthFit{sign * fit.a, sign * fit.b, fit.exact_share, fit.pixels}.camera();
    append(report.units_check, std::string(finding_text("units.camera")));
  }
  return found;
}

/// Leaves out maps of which no file says what their numbers mean: "depth maps, as …". Where there
/// is no disparity (`is_missed`), a warning says what to do.
void leave_out_unknown(const std::vector<const MapSet*>& sets, const std::string& what,
                       bool is_missed, const SidecarNotes& notes) {
  for (const MapSet* set : sets) {
    if (set->entries.empty()) continue;
    notes.account.leave_out(set->files(), what);
    if (!is_missed) continue;
    notes.report.warnings.push_back(fmt::format(finding_text("map.unused"), set->pattern, what));
  }
}

ViewStack<float> disparity_of(ViewStack<float> depth, const CameraGrid& camera) {
  std::transform(depth.data(), depth.data() + depth.size(), depth.data(), [&](float value) {
    return static_cast<float>(camera.disparity_from_depth(value));
  });
  return depth;
}

/// Whether depth of the center view, by the camera as it is, explains the views; also where there
/// is none.
bool camera_explains(const RankedSets& depths, const SidecarViews& views) {
  const ViewIndex at = views.grid().center();
  StoredMaps depth = read_one_depth(depths, views, at);
  if (depth.field.empty()) return true;
  depth.field.disparity = disparity_of(std::move(depth.field.disparity), views.camera);
  tidy_valid(depth.field);
  return explain_views(views.samples, at, depth.field.view(at), 1).is_good();
}

SidecarDisparity from_depth(const RankedSets& sets, const SidecarViews& views,
                            const SidecarNotes& notes, const Progress& progress) {
  StoredMaps maps = read_first(sets.fit, kind_text(MapKind::Depth), views, notes, progress);
  if (maps.field.empty()) return {{}, views.camera};
  maps.field.disparity = disparity_of(std::move(maps.field.disparity), views.camera);
  tidy_valid(maps.field);
  const ViewIndex at = told_view(maps.field, views.grid());
  const SettledUnit settled =
      settle_unit(views.samples, at, maps.field.view(at), {{1, "px per view step"}});
  notes.report.units = "disparity from " + maps.set->pattern + " and the camera";
  notes.report.units_check = warp_text(settled);
  return {std::move(maps.field), views.camera};
}

/// Reads disparity maps, else depth maps where the camera is known. Unit and sign are checked: by
/// warping views next to the center (`settle_unit`), by occlusion (`find_occlusion_order`),
/// and by depth maps; what was found, with the numbers, goes to `units` and `units_check` of the
/// report. Maps that are damaged or do not fit are left out with a warning. Throws Cancelled.
SidecarDisparity read_sidecar_disparity(const std::vector<MapSet>& sets, const SidecarViews& views,
                                        const SidecarNotes& notes, const Progress& progress) {
  const RankedSets disparities = rank_sets(sets, MapKind::Disparity, can_hold_values);
  const RankedSets depths = rank_sets(sets, MapKind::Depth, can_hold_values);
  const bool has_camera =
      views.camera.is_known() && (!views.is_shift_unknown || camera_explains(depths, views));
  SidecarDisparity found{{}, views.camera};
  StoredMaps maps =
      read_first(disparities.fit, kind_text(MapKind::Disparity), views, notes, progress);
  const bool has_disparity = !maps.field.empty();
  if (has_disparity) {
    found = from_disparity(std::move(maps), depths, views, notes);
  } else if (has_camera) {
    found = from_depth(depths, views, notes, progress);
  }
  const bool is_missed = found.field.empty();
  if (!has_disparity && !has_camera) {
    leave_out_unknown(depths.fit, "depth maps, as no camera parameters are known", is_missed,
                      notes);
  }
  leave_out_unknown(disparities.unfit, "pictures of disparity, of unknown scale", is_missed, notes);
  leave_out_unknown(depths.unfit, "pictures of depth, of unknown scale", is_missed, notes);
  return found;
}

Image<std::uint8_t> read_fitting_mask(const fs::path& path, const SidecarViews& views) {
  Image<std::uint8_t> mask = io::read_mask(path);
  require_view_size(path, mask.height(), mask.width(), views);
  return mask;
}

/// Pixels that had a value, and those of them that a mask took away.
struct MaskedPixels {
  std::size_t known = 0;
  std::size_t lost = 0;
};

/// Clears pixels of a view; nothing is done if no pixel would be left.
MaskedPixels apply(const Image<std::uint8_t>& mask, bool marks_valid,
                   ImageView<std::uint8_t> valid) {
  const auto keeps = [&](std::size_t i) { return (mask.data()[i] != 0) == marks_valid; };
  MaskedPixels pixels;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    pixels.known += valid.data[i] != 0 ? 1 : 0;
    pixels.lost += valid.data[i] != 0 && !keeps(i) ? 1 : 0;
  }
  if (pixels.lost == pixels.known) return pixels;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (!keeps(i)) valid.data[i] = 0;
  }
  return pixels;
}

void read_validity(const MapSet& set, const SidecarViews& views, const SidecarNotes& notes,
                   DisparityField& field) {
  SetOutcome outcome;
  MaskedPixels all;
  for (const MapSet::Entry& entry : set.entries) {
    const ViewIndex view = views.grid().view_at(entry.view);
    if (!field.contains(view)) {
      notes.account.leave_out({entry.file}, "masks of views without disparity");
      continue;
    }
    try {
      const Image<std::uint8_t> mask = read_fitting_mask(entry.file, views);
      field.require_mask();
      const MaskedPixels one = apply(mask, set.kind == MapKind::Valid, field.valid.view(view));
      if (one.lost == one.known) {
        throw IoError(entry.file,
                      "this mask would leave no pixel with a disparity; remove or replace it");
      }
      all = {all.known + one.known, all.lost + one.lost};
      outcome.read.push_back(entry.file);
    } catch (const IoError& error) {
      outcome.failed.push_back(entry.file);
      if (outcome.first_error.empty()) outcome.first_error = error.what();
    }
  }
  outcome.note = masked_text(set.pattern, all.lost, all.known);
  outcome.tell(kind_text(set.kind), notes);
}

void read_region(const MapSet& set, const SidecarViews& views, const SidecarNotes& notes,
                 GroundTruth& truth) {
  SetOutcome outcome;
  const fs::path& path = set.entries.front().file;
  try {
    truth.regions.insert_or_assign(set.region, read_fitting_mask(path, views));
    outcome.read.push_back(path);
  } catch (const IoError& error) {
    outcome.failed.push_back(path);
    outcome.first_error = error.what();
  }
  outcome.tell(kind_text(set.kind), notes);
}

/// Reads masks beside views: of valid and of invalid pixels, which go to the validity of `truth`'s
/// disparity, and regions of the center view. Masks of views without disparity and
/// such that leave nothing valid are left out. Throws Cancelled.
void read_sidecar_masks(const std::vector<MapSet>& sets, const SidecarViews& views,
                        const SidecarNotes& notes, GroundTruth& truth) {
  for (const MapSet& set : sets) {
    if (set.entries.empty() || !can_hold_labels(set.entries.front().file)) continue;
    if (set.kind == MapKind::Valid || set.kind == MapKind::Invalid) {
      read_validity(set, views, notes, truth.field);
    } else if (set.kind == MapKind::Region && set.entries.size() == 1 &&
               set.entries.front().view == views.center()) {
      read_region(set, views, notes, truth);
    }
  }
}

/// Removes what is no truth, or belongs to no view, from the sets.
void set_aside(std::vector<MapSet>& sets, const SidecarNotes& notes) {
  for (MapSet& set : sets) {
    notes.account.leave_out(set.strays, std::string(kind_text(set.kind)) + " of no view");
    notes.account.leave_out(set.of_left_out,
                            std::string(kind_text(set.kind)) + " of views left out");
    if (!set.strays.empty()) {
      notes.report.warnings.push_back(fmt::format(
          finding_text("map.no_view"), set.strays.size(), set.strays.size() + set.entries.size(),
          set.pattern, set.strays.front().filename().string()));
    }
    set.strays.clear();
    std::erase_if(set.entries, [&](const MapSet::Entry& entry) {
      const OwnFile own = own_file(entry.file);
      if (own == OwnFile::Scribbles) notes.account.use(entry.file, "scribble files");
      if (own == OwnFile::Segmentation) notes.account.leave_out({entry.file}, "segmentations");
      if (own == OwnFile::Result) notes.account.leave_out({entry.file}, "results");
      return own != OwnFile::None;
    });
  }
  std::erase_if(sets, [](const MapSet& set) { return set.entries.empty(); });
}

/// Where they would be the only truth.
void tell_computed(const std::vector<ComputedMap>& maps, const fs::path& folder,
                   ConventionReport& report) {
  const auto is_value = [](const ComputedMap& map) {
    const bool is_named_so = map.kind == MapKind::Disparity || map.kind == MapKind::Depth;
    return is_named_so && can_hold_values(map.file) && own_file(map.file) == OwnFile::None;
  };
  const auto first = std::ranges::find_if(maps, is_value);
  if (first == maps.end()) return;
  const fs::path& file = first->file;
  const bool is_beside = file.parent_path() == folder;
  const fs::path name =
      is_beside ? file.filename() : file.parent_path().filename() / file.filename();
  report.warnings.push_back(fmt::format(finding_text("map.computed_name"), name.string()));
}

}  // namespace

std::optional<MapUnit> stated_unit(const fs::path& folder, FileUsage& account) {
  const fs::path path = folder / kBaselineFile;
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  std::string text(kLongestParameters, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  const std::optional<double> baseline = number_after(text, "base_x");
  if (!baseline || *baseline <= 0) return std::nullopt;
  account.use(path, "parameter files");
  return MapUnit{*baseline, fmt::format("px for a baseline of 1; that of neighboring views is {} "
                                        "({})",
                                        *baseline, kBaselineFile)};
}

SidecarMaps read_sidecar_maps(const SidecarViews& views, const SidecarNotes& notes,
                              const Progress& progress) {
  FoundMapSets maps = find_maps(views.files, views.folder, views.own);
  SidecarMaps found{{}, {}, views.camera};
  for (const fs::path& folder : maps.folders) notes.account.add_folder(folder);
  if (maps.sets.empty() && maps.computed.empty()) return found;
  progress.step("reading ground truth");
  set_aside(maps.sets, notes);
  for (const ComputedMap& map : maps.computed) {
    const bool is_result = own_file(map.file) != OwnFile::None;
    notes.account.leave_out({map.file}, is_result ? "results" : "maps of methods, by their names");
  }
  settle_fractional_labels(maps.sets, views, notes);
  SidecarDisparity disparity =
      read_sidecar_disparity(maps.sets, views, notes, progress.part(0, 0.6));
  found.truth.field = std::move(disparity.field);
  found.camera = disparity.camera;
  found.is_sign_assumed = disparity.is_sign_assumed;
  if (found.truth.field.empty()) tell_computed(maps.computed, views.folder, notes.report);
  if (!views.needs_truth) return found;
  SidecarLabels labels = read_sidecar_labels(maps.sets, views, notes, progress.part(0.6, 0.9));
  found.truth.labels = std::move(labels.labels);
  found.label_infos = std::move(labels.infos);
  read_sidecar_masks(maps.sets, views, notes, found.truth);
  return found;
}

std::vector<LabelInfo> add_maps_named_after(const fs::path& file, const OpenOptions& options,
                                            SceneParts& parts, const SidecarNotes& notes,
                                            const Progress& progress) {
  const SceneFiles own({file.stem().string()}, light_fields_beside(file), false,
                       file.filename().string());
  const ViewFiles views{grid_of(parts.samples), {}};
  SidecarMaps beside =
      read_sidecar_maps({.files = views,
                         .folder = file.has_parent_path() ? file.parent_path() : fs::path("."),
                         .samples = parts.samples,
                         .camera = parts.info.camera,
                         .map_views = options.map_views(),
                         .needs_truth = options.needs_truth,
                         .own = own},
                        notes, progress);
  if (parts.truth.labels.empty()) parts.truth.labels = std::move(beside.truth.labels);
  parts.truth.regions.merge(beside.truth.regions);
  if (beside.truth.field.empty()) return std::move(beside.label_infos);
  parts.truth.field = std::move(beside.truth.field);
  parts.expected.is_truth_sign_assumed = beside.is_sign_assumed;
  parts.info.camera = beside.camera;
  return std::move(beside.label_infos);
}

void apply_masks_beside(const SidecarViews& views, const SidecarNotes& notes,
                        DisparityField& field) {
  if (field.empty()) return;
  for (const MapSet& set : find_maps(views.files, views.folder, views.own).sets) {
    const bool is_mask = set.kind == MapKind::Valid || set.kind == MapKind::Invalid;
    const bool is_picture = !set.entries.empty() && can_hold_labels(set.entries.front().file);
    if (is_mask && is_picture) read_validity(set, views, notes, field);
  }
}

}  // namespace episcope::io
