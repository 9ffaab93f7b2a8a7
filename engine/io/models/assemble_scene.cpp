// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/assemble_scene.h"

#include "engine/core/finding.h"
#include "engine/core/indices.h"
#include "engine/core/text.h"
#include "engine/core/view_gain.h"
#include "engine/core/view_stack.h"
#include "engine/io/base/sample_range.h"
#include "engine/io/models/dark_views.h"
#include "engine/io/models/load_views.h"
#include "engine/io/models/order/misplaced_views.h"
#include "engine/io/models/order/truth_views.h"
#include "engine/io/models/order/view_axes.h"
#include "engine/io/models/order/warp_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace episcope::io {
namespace {

/// Views and all that belongs to them: names pair truth with views.
void swap_axes(SceneParts& parts) {
  const GridShape stored = grid_of(parts.samples);
  swap_view_axes(parts.samples);
  swap_view_axes(parts.truth);
  swap_view_axes(parts.valid);
  swap_view_axes(parts.info.positions, stored);
}

/// Of the views as they are, warped by the map of one of them.
double error_by_truth(const SceneParts& parts) {
  const DisparityField& field = parts.truth.field;
  const ViewIndex at = told_view(field, grid_of(parts.samples));
  return warp_errors(parts.samples, at, field.view(at)).best();
}

/// Swaps rows and columns of views if the truth explains far better what that makes.
AxesFinding order_axes_by_truth(SceneParts& parts) {
  constexpr double kFarBetter = 0.6;
  if (parts.truth.field.empty()) return {{}, true};
  const double as_stored = error_by_truth(parts);
  swap_axes(parts);
  const double swapped = error_by_truth(parts);
  if (swapped < kFarBetter * as_stored) {
    return {fmt::format(finding_text("order.swapped_by_truth"), swapped, as_stored)};
  }
  swap_axes(parts);
  return {{}, true};
}

/// Swaps rows and columns of views where the motion between them says so.
AxesFinding order_axes(SceneParts& parts, bool are_axes_known, ConventionReport& report,
                       const Progress& progress) {
  const ViewAxes axes = find_view_axes(parts.samples, progress);
  if (!axes.are_swapped()) return {{}, !are_axes_known && axes.are_unclear()};
  if (are_axes_known) {
    report.warnings.push_back(fmt::format(finding_text("order.swapped"), axes.evidence()));
    return {};
  }
  swap_axes(parts);
  return {axes.evidence()};
}

/// A camera that zooms or turns makes no light field, but a list that looks like a line of views.
void check_line(const SceneParts& parts, ConventionReport& report, const Progress& progress) {
  const GridShape grid = grid_of(parts.samples);
  if (grid.count() < 2 || std::min(grid.v, grid.u) > 1) return;
  const LineMotion motion = measure_line_motion(parts.samples, progress);
  if (motion.is_askew()) report.warnings.push_back(motion.warning());
}

/// The truth of one view: the disparity, or the two layers of a transparent scene. A disparity is
/// put upright first. What was estimated is no evidence.
std::vector<OrderEvidence> evidence_of(SceneParts& parts, ConventionReport& report) {
  GroundTruth& truth = parts.truth;
  if (truth.estimated) return {};
  const UprightTruth upright = put_truth_upright(parts.samples, truth.field);
  if (!upright.undone.empty()) report.warnings.push_back(turned_back_text(upright.undone));
  std::vector<OrderEvidence> found;
  for (const DisparityField* field : {&truth.field, &truth.foreground, &truth.background}) {
    if (field->empty() || (field != &truth.field && truth.has_disparity())) continue;
    const ViewIndex at = told_view(*field, grid_of(parts.samples));
    found.push_back({at, field->view(at)});
    if (field == &truth.field) found.back().errors = upright.errors;
  }
  return found;
}

void append(std::vector<std::string>& warnings, const std::vector<std::string>& more) {
  warnings.insert(warnings.end(), more.begin(), more.end());
}

/// Reverses views and truth as `find_order` determines it, and continues the report.
void put_in_order(SceneParts& parts, Flip choice, ConventionReport& report,
                  const Progress& progress) {
  const OrderFinding finding =
      find_order(parts.samples, evidence_of(parts, report), parts.expected, choice, progress);
  report.order = finding.order;
  report.order_check = finding.check;
  report.order_was_chosen = finding.was_chosen;
  report.are_axes_unclear = finding.are_axes_unclear;
  report.sign = finding.sign;
  report.sign_check = finding.sign_check;
  report.reversed_u = finding.flip.u;
  report.reversed_v = finding.flip.v;
  append(report.warnings, finding.warnings);

  const GridShape grid = grid_of(parts.samples);
  std::visit([&](auto& stack) { reverse_views(stack, grid, finding.flip); }, parts.samples);
  for (DisparityField* field :
       {&parts.truth.field, &parts.truth.foreground, &parts.truth.background}) {
    reverse_views(*field, grid, finding.flip);
  }
  reverse_views(parts.truth.labels, grid, finding.flip);
  reverse_views(parts.valid, grid, finding.flip);
  if (finding.was_chosen) return;  // truth is in the order of the views by the user's word
  append(report.warnings, put_truth_views_in_order(parts.samples, parts.truth));
}

/// Adds to what is known of order and sign: swapped axes, and where positions run.
void complete_order(SceneParts& parts, const std::string& swapped, ConventionReport& report) {
  const GridShape grid = grid_of(parts.samples);
  if (!swapped.empty()) {
    std::string order = "rows and columns swapped";
    if (report.order != "as stored") order += ", " + report.order;
    report.order = std::move(order);
    report.order_check = swapped + "; " + report.order_check;
  }
  reverse_positions(parts.info.positions, grid, flip_of(report));
  const std::string directions = position_directions(parts.info.positions, grid);
  if (!directions.empty()) report.sign_check += "; by the positions, " + directions;
}

}  // namespace

bool are_axes_stated(const OpenOptions& options) {
  return !options.axes.empty() || !options.pattern.empty() || !options.grid.empty();
}

namespace {

/// Brings views, truth, valid pixels and positions into canonical order (`put_in_order`), after
/// rows and columns of views were swapped where the motion between them says so without doubt,
/// unless that was done already.
/// Adds to `report` what was done, and in which directions positions run. Throws Cancelled.
void bring_in_order(SceneParts& parts, const OpenOptions& options, ConventionReport& report,
                    const Progress& progress) {
  progress.step("checking the order of views");
  const bool are_axes_known = parts.expected.are_axes_known || are_axes_stated(options);
  AxesFinding axes =
      parts.axes ? *parts.axes : order_axes(parts, are_axes_known, report, progress.part(0, 0.4));
  if (axes.are_unclear) axes = order_axes_by_truth(parts);
  parts.expected.are_axes_unclear = axes.are_unclear;
  check_line(parts, report, progress.part(0.4, 0.5));
  put_in_order(parts, options.flip, report, progress.part(0.5, 1));
  complete_order(parts, axes.swapped, report);
}

/// Gains that differ by less from 1 are within the accuracy of their measurement.
constexpr double kMeasurableGain = 0.01;
constexpr double kShownGain = 0.0005;  ///< Less is 0.0 % in a sentence.

// `text`: of a finding with the view of the largest gain.
std::string difference_text(std::string_view text, const PhotometricCorrection& gains) {
  const ViewIndex view = gains.most_different();
  return fmt::format(fmt::runtime(text), 100 * std::abs(gains.of(view) - 1), view_text(view),
                     gains.of(view));
}

bool is_mapped(const LightField::Samples& samples) {
  return std::visit([](const auto& stack) { return stack.kind() == LargeKind::File; }, samples);
}

int count_unknown(const PhotometricCorrection& gains) {
  int unknown = 0;
  for (const double gain : gains.overall) unknown += std::isnan(gain) ? 1 : 0;
  return unknown;
}

/// Tells `report` how much the brightness of the views differs from the center view
/// (measure_view_gains). With `options.equalize` takes it out, unless all gains are within
/// kMeasurableGain; else says that methods even out what is notable, unless
/// `options.keep_brightness`. Of a single view there is nothing to tell. Throws Cancelled.
void equalize_views(SceneParts& parts, const OpenOptions& options, ConventionReport& report,
                    const Progress& progress) {
  const bool is_wanted = options.equalize;
  if (!is_wanted && is_mapped(parts.samples)) {
    report.gain = "not measured, since that would read the whole file";
    return;
  }
  // What is divided by gains needs them as exactly as can be; a report does not.
  const bool is_quick = !is_wanted && has_many_views(grid_of(parts.samples));
  const PhotometricCorrection gains =
      measure_view_gains(parts.samples, parts.valid, progress.part(0, is_wanted ? 0.5 : 1),
                         is_quick ? GainBlocks::OneOfFour : GainBlocks::All);
  const int views = gains.grid.count();
  if (views == 1) return;
  const int unknown = count_unknown(gains);
  if (unknown == views - 1) {
    report.gain = "not known: the views are too dark, too bright or too small to compare";
    return;
  }
  if (is_wanted && gains.largest_difference() > kMeasurableGain) {
    const double clipped = divide_by_gains(parts.samples, gains, progress.part(0.5, 1));
    report.gain = difference_text(finding_text("gain.evened"), gains);
    if (clipped > 0) {
      report.gain += "; " + fmt::format(finding_text("gain.clipped"), 100 * clipped);
    }
  } else {
    const bool is_same = std::abs(gains.of(gains.most_different()) - 1) < kShownGain;
    report.gain = is_same ? std::string(finding_text("gain.same"))
                          : difference_text(finding_text("gain.differs"), gains);
    if (is_wanted && !is_same) report.gain.append("; ").append(finding_text("gain.little"));
  }
  if (unknown > 0) {
    report.gain += "; " + fmt::format(finding_text("gain.unknown"), unknown);
  }
  if (is_wanted || !gains.is_notable()) return;
  report.warnings.push_back(difference_text(
      options.keep_brightness ? finding_text("brightness.off") : finding_text("brightness.differs"),
      gains));
}

std::string place_text(const LightField::Samples& samples) {
  switch (std::visit([](const auto& stack) { return stack.kind(); }, samples)) {
    case LargeKind::File:
      return "; mapped: read from the file when they are looked at";
    case LargeKind::Scratch:
      return "; unpacked to a scratch file, too large for memory";
    default:
      return "";
  }
}

void crop_positions(std::vector<CameraPosition>& positions, const ViewCrop& crop) {
  if (positions.size() != static_cast<std::size_t>(crop.stored.count())) return;
  std::vector<CameraPosition> kept;
  kept.reserve(static_cast<std::size_t>(crop.kept.count()));
  for (int i = 0; i < crop.kept.count(); ++i) {
    const ViewIndex stored = crop.kept.view_at(i, crop.first);
    kept.push_back(positions[static_cast<std::size_t>(stored.v * crop.stored.u + stored.u)]);
  }
  positions = std::move(kept);
}

/// Parts in canonical order.
void crop_parts(SceneParts& parts, const ViewCrop& crop) {
  std::visit([&](auto& stack) { stack = cropped(std::move(stack), crop); }, parts.samples);
  crop_truth(parts.truth, crop);
  crop_positions(parts.info.positions, crop);
  parts.valid = cropped(std::move(parts.valid), crop);
}

/// What was looked at so far of views that are on disk need not be held.
void forget(const LightField::Samples& samples) {
  std::visit(
      [](const auto& stack) {
        for (int i = 0; i < stack.grid().count(); ++i) forget_view(stack, stack.view_at(i));
      },
      samples);
}

template <class T>
CenterEpis center_epis(const ViewStack<T>& stack) {
  const GridShape grid = stack.grid();
  const ViewIndex center = grid.center();
  const int height = stack.height(), width = stack.width(), channels = stack.channels();
  Image<T> horizontal(grid.u, width, channels), vertical(grid.v, height, channels);
  for (int u = 0; u < grid.u; ++u) {
    std::copy_n(stack.view({center.v, u}).row(height / 2), width * channels, horizontal.row(u));
  }
  for (int v = 0; v < grid.v; ++v) {
    const auto view = stack.view({v, center.u});
    for (int y = 0; y < height; ++y) {
      std::copy_n(&view.at(y, width / 2), channels, &vertical.at(v, y));
    }
  }
  return {preview_rgb<T>(std::as_const(horizontal).view()),
          preview_rgb<T>(std::as_const(vertical).view())};
}

ViewCrop find_crop(const std::string& option, GridShape stored, const ViewBrightness& brightness) {
  if (option == "all") return central_crop(stored, stored);
  return option.empty() ? filled_crop(brightness) : parse_crop(option, stored);
}

bool are_on_disk(const LightField::Samples& samples) {
  return std::visit([](const auto& stack) { return stack.is_on_disk(); }, samples);
}

/// All of a light field that is on disk would take as long to look at as to read, and all of one of
/// many views is more than is needed: where a first look finds nothing dark, that is all.
ViewBrightness find_brightness(const SceneParts& parts, const Progress& progress) {
  if (are_on_disk(parts.samples) || has_many_views(grid_of(parts.samples))) {
    ViewBrightness brightness =
        measure_brightness(parts.samples, parts.valid, BrightnessRows::Few, progress.part(0, 0.3));
    if (!brightness.has_dark_parts()) return brightness;
  }
  return measure_brightness(parts.samples, parts.valid, BrightnessRows::EverySecond,
                            progress.part(0.3, 1));
}

/// Leaves out views that are dark, or that the user does not want, and marks dark pixels of the
/// others.
void keep_what_was_seen(SceneParts& parts, const OpenOptions& options, ConventionReport& report,
                        const Progress& progress) {
  progress.step("looking for dark views");
  ViewBrightness brightness = find_brightness(parts, progress.part(0, 0.6));
  forget(parts.samples);
  const ViewCrop crop = find_crop(options.crop, grid_of(parts.samples), brightness);
  if (crop.leaves_out()) {
    if (options.crop.empty()) report.warnings.push_back(crop_text(crop, brightness));
    crop_parts(parts, crop);
    brightness.cells = cropped(std::move(brightness.cells), crop);
    report.crop = crop;
  }
  const auto [height, width] = std::visit(
      [](const auto& stack) { return std::pair(stack.height(), stack.width()); }, parts.samples);
  for (std::string text :
       {mark_empty_pixels(brightness, height, width, parts.valid, progress.part(0.6, 0.7)),
        mark_black_corners(parts.samples, parts.valid, progress.part(0.7, 1))}) {
    if (!text.empty()) report.warnings.push_back(std::move(text));
  }
  if (parts.valid.empty()) return;
  const std::uint8_t* valid = parts.valid.data();
  const bool is_whole =
      std::all_of(valid, valid + parts.valid.size(), [](std::uint8_t pixel) { return pixel != 0; });
  if (is_whole) parts.valid = {};
}

/// Says whether rows of cameras are farther apart than columns, and which views do not fit their
/// neighbors.
void tell_what_is_misplaced(const SceneParts& parts, ConventionReport& report,
                            const Progress& progress) {
  constexpr double kEqual = 0.05;
  const GridShape grid = grid_of(parts.samples);
  const ViewPlaces places = view_places(parts.info, grid);
  const double step = places.row_step;
  if (std::max(step, 1 / step) > 1 + kEqual) {
    report.warnings.push_back(places.kind == PlacesKind::Irregular
                                  ? fmt::format(finding_text("camera.unequal"), step, grid.u)
                                  : fmt::format(finding_text("camera.too_unequal"), step, grid.u));
  }
  if (is_mapped(parts.samples)) return;
  append(report.warnings, find_misplaced_views(parts.samples, progress));
}

}  // namespace

void show_epis(const LightField::Samples& samples, const OpenOptions& options) {
  if (!options.on_center_epis) return;
  options.on_center_epis(std::visit([](const auto& stack) { return center_epis(stack); }, samples));
}

void assemble(SceneParts parts, const OpenOptions& options, Scene& scene,
              const Progress& progress) {
  show_epis(parts.samples, options);
  bring_in_order(parts, options, scene.convention, progress.part(0, 0.3));
  show_epis(parts.samples, options);  // in another order, perhaps
  scene.convention.files = std::move(parts.files);
  drop_nonfinite_samples(parts.samples, parts.valid, scene.convention);
  keep_what_was_seen(parts, options, scene.convention, progress.part(0.3, 0.6));
  tell_what_is_misplaced(parts, scene.convention, progress.part(0.6, 0.7));
  equalize_views(parts, options, scene.convention, progress.part(0.7, 1));
  std::string& samples_text = scene.convention.samples;
  if (samples_text.empty()) samples_text = stored_samples_text(parts.samples);
  samples_text += place_text(parts.samples);
  parts.info.reading.options = given_options(options);
  parts.info.reading.set_focus(0);  // baked in afterwards, if at all
  scene.light_field = std::make_shared<LightField>(std::move(parts.samples), std::move(parts.info),
                                                   std::move(parts.valid));
  if (!options.needs_truth) parts.truth = {};
  scene.truth = std::make_shared<GroundTruth>(std::move(parts.truth));
}

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostUnusedKinds =
    20;  ///< Of files not used; more are told apart less finely.

/// A name with # for each of its numbers, except in a suffix such as .h5.
std::string kind_by_numbers(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  const bool has_suffix = dot != name.npos && dot + 1 < name.size() && !is_digit(name[dot + 1]);
  const std::size_t end = has_suffix ? dot : name.size();
  std::string kind;
  for (const char c : name.substr(0, end)) {
    if (!is_digit(c)) {
      kind += c;
    } else if (kind.empty() || kind.back() != '#') {
      kind += '#';
    }
  }
  return kind + name.substr(end);
}

/// "*.txt".
std::string kind_by_suffix(const std::string& name) {
  return fmt::format("*{}", suffix_of(name));
}

std::string kind_of_others(const std::string&) {
  return "*";
}

/// In the order of the first file of each kind.
std::vector<FileUse> count_unused(const std::vector<std::string>& names,
                                  std::string (*kind_of)(const std::string&)) {
  std::vector<FileUse> kinds;
  std::unordered_map<std::string, std::size_t> places;
  for (const std::string& name : names) {
    const std::string kind = kind_of(name);
    const auto [place, is_new] = places.try_emplace(kind, kinds.size());
    if (is_new) kinds.push_back({kind, 0, name, false});
    ++kinds[place->second].count;
  }
  for (FileUse& kind : kinds) {
    if (kind.count == 1) kind.kind = kind.example;
  }
  return kinds;
}

/// One key for all ways to write a path.
fs::path key_of(const fs::path& path) {
  return fs::absolute(path).lexically_normal();
}

void count_one(std::vector<FileUse>& uses, FileUse one) {
  const auto found = std::ranges::find(uses, one.kind, &FileUse::kind);
  if (found == uses.end()) {
    uses.push_back(std::move(one));
  } else {
    ++found->count;
  }
}

}  // namespace

FileUsage::FileUsage(const fs::path& folder) {
  add_folder(folder);
}

void FileUsage::add_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (!is_hidden && entry.is_regular_file(error)) files_.try_emplace(key_of(entry.path()), false);
  }
}

void FileUsage::use(const fs::path& file, const std::string& kind) {
  files_[key_of(file)] = true;
  count_one(used_, {kind, 1, file.filename().string(), true});
}

void FileUsage::use(const std::vector<fs::path>& files, const std::string& kind) {
  for (const fs::path& file : files) use(file, kind);
}

void FileUsage::leave_out(const std::vector<fs::path>& files, const std::string& kind) {
  for (const fs::path& file : files) {
    bool& is_noted = files_[key_of(file)];
    if (!is_noted) count_one(left_out_, {kind, 1, file.filename().string(), false});
    is_noted = true;
  }
}

std::vector<FileUse> FileUsage::uses() const {
  std::vector<std::string> unused;
  for (const auto& [path, is_noted] : files_) {
    if (!is_noted) unused.push_back(path.filename().string());
  }
  std::vector<FileUse> all = used_;
  all.insert(all.end(), left_out_.begin(), left_out_.end());
  for (const auto& kind_of : {kind_by_numbers, kind_by_suffix, kind_of_others}) {
    const std::vector<FileUse> kinds = count_unused(unused, kind_of);
    if (kinds.size() > kMostUnusedKinds) continue;
    all.insert(all.end(), kinds.begin(), kinds.end());
    break;
  }
  return all;
}

}  // namespace episcope::io
