// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/scene_summary.h"

#include "engine/render/shade.h"

#include <algorithm>
#include <limits>
#include <set>

namespace episcope {
namespace {

template <class T>
std::string covered_views(const ViewStack<T>& stack, const LightField& light_field) {
  if (stack.grid() == light_field.grid()) return "all";
  if (stack.grid().count() != 1) {
    return std::to_string(stack.grid().v) + "×" + std::to_string(stack.grid().u);
  }
  return stack.first() == light_field.center() ? "center" : view_text(stack.first());
}

/// Disparities seen so far.
struct Spread {
  Interval range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  std::size_t valid = 0;

  void add(const DisparityView& view) {
    for (int y = 0; y < view.disparity.height; ++y) {
      for (int x = 0; x < view.disparity.width; ++x) {
        if (!view.is_valid(y, x)) continue;
        const double value = view.disparity.at(y, x);
        range = {std::min(range.min, value), std::max(range.max, value)};
        ++valid;
      }
    }
  }
  [[nodiscard]] Interval interval() const { return valid > 0 ? range : Interval{}; }
};

SceneSummary::Truth summarize_truth(const DisparityField& field, const LightField& light_field) {
  const MapSummary all = summarize(field);
  SceneSummary::Truth truth{
      covered_views(field.disparity, light_field), all.valid_percent, {}, all.range};
  Spread center;
  if (field.contains(light_field.center())) center.add(field.view(light_field.center()));
  if (center.valid > 0) truth.center = center.interval();
  return truth;
}

}  // namespace

MapSummary summarize(const DisparityField& field) {
  Spread all;
  const ViewStack<float>& maps = field.disparity;
  for (int i = 0; i < maps.grid().count(); ++i) all.add(field.view(maps.view_at(i)));
  return {all.interval(),
          100.0 * static_cast<double>(all.valid) / static_cast<double>(maps.size())};
}

std::size_t collect_ids(std::span<const std::int32_t> labels, std::vector<int>& ids) {
  std::set<int> found(ids.begin(), ids.end());
  std::size_t painted = 0;
  int last = 0;
  for (const std::int32_t label : labels) {
    if (label <= 0) continue;
    ++painted;
    if (label != last) found.insert(last = label);
  }
  ids.assign(found.begin(), found.end());
  return painted;
}

const char* sample_type_name(SampleType type) {
  switch (type) {
    case SampleType::UInt8:
      return "uint8";
    case SampleType::UInt16:
      return "uint16";
    case SampleType::Float32:
      break;
  }
  return "float32";
}

SceneSummary summarize(const Scene& scene) {
  SceneSummary summary;
  const GroundTruth& truth = *scene.truth;
  summary.sample_type = sample_type_name(scene.light_field->sample_type());
  if (truth.has_disparity()) summary.truth = summarize_truth(truth.field, *scene.light_field);
  summary.has_layers = truth.has_layers();
  if (!truth.labels.empty()) {
    summary.label_views = covered_views(truth.labels, *scene.light_field);
    collect_ids({truth.labels.data(), truth.labels.size()}, summary.label_ids);
  }
  std::size_t painted = 0;
  std::size_t pixels = 0;
  for (const auto& [view, labels] : scene.scribbles.views) {
    painted += collect_ids({labels.data(), labels.size()}, summary.scribble_ids);
    pixels += labels.size();
    summary.painted_views += summary.painted_views.empty() ? "" : " ";
    summary.painted_views += view_text(view);
  }
  if (pixels > 0) {
    summary.painted_percent = 100.0 * static_cast<double>(painted) / static_cast<double>(pixels);
  }
  return summary;
}

std::string samples_text(const Scene& scene) {
  if (!scene.convention.samples.empty()) return scene.convention.samples;
  return stored_samples_text(scene.light_field->samples());
}

double valid_percent(const LightField& light_field) {
  const ViewStack<std::uint8_t>& valid = light_field.valid();
  if (valid.empty()) return 100;
  const auto invalid = std::count(valid.data(), valid.data() + valid.size(), std::uint8_t{0});
  return 100 * (1 - static_cast<double>(invalid) / static_cast<double>(valid.size()));
}

std::vector<std::string> order_warnings(const ConventionReport& report) {
  std::vector<std::string> warnings;
  if (report.are_axes_unclear) {
    warnings.emplace_back(
        "Rows and columns of views could not be told apart; if they are exchanged, state them with "
        "--pattern or --axes.");
  }
  if (!report.sign.empty() || report.order_was_chosen) return warnings;
  const std::string reason = report.sign_check.empty() ? "" : " (" + report.sign_check + ")";
  warnings.push_back("Near and far could not be told apart" + reason +
                     "; if they are exchanged, reverse both axes with --flip both.");
  return warnings;
}

std::string singular_kind(std::string kind) {
  const std::size_t end = std::min(kind.find(" of "), kind.size());
  if (end > 0 && kind[end - 1] == 's') kind.erase(end - 1, 1);
  return kind;
}

std::string files_text(const ConventionReport& report,
                       const std::function<std::string(const std::string&)>& words) {
  std::string used;
  std::string unused;
  for (const FileUse& use : report.files) {
    std::string& text = use.is_used ? used : unused;
    const std::string kind = use.is_used && use.count == 1 ? singular_kind(use.kind) : use.kind;
    text += (text.empty() ? "" : ", ") + std::to_string(use.count) + " " + words(kind);
    if (!use.is_used && use.kind != use.example) text += " (" + use.example + ")";
  }
  if (unused.empty()) return used;
  return (used.empty() ? "" : used + "; ") + words(kNotUsed) + unused;
}

Interval extent(const DisparityView& view) {
  Spread spread;
  spread.add(view);
  return spread.interval();
}

Interval known_disparity_range(const Scene& scene) {
  const GroundTruth& truth = *scene.truth;
  const ViewIndex center = scene.light_field->center();
  Spread known;
  for (const DisparityField* field : {&truth.field, &truth.foreground, &truth.background}) {
    if (field->empty()) continue;
    known.add(field->view(field->contains(center) ? center : field->disparity.first()));
  }
  const Interval range = known.interval();
  // A point that moves farther than the image from view to view is a mark for "nothing".
  if (range.length() > 0 && range.length() < scene.light_field->width()) return range;
  return scene.light_field->info().disparity_range.value_or(Interval{});
}

Interval display_range(const Estimate& estimate) {
  const DisparityField& field = estimate.field;
  const ViewIndex first = field.disparity.first();
  const ViewIndex middle = field.disparity.grid().center();
  const DisparityView view = field.view({first.v + middle.v, first.u + middle.u});
  return render::robust_range(view.disparity, view.valid);
}

Interval shown_range(Interval known, Interval of_estimate) {
  if (known.length() > 0) return known;
  return of_estimate.length() > 0 ? of_estimate : Interval{-1, 1};
}

}  // namespace episcope
