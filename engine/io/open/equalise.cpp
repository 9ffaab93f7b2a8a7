// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/equalise.h"

#include "engine/core/light_field/many_views.h"
#include "engine/core/light_field/view_gain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace episcope::io {
namespace {

constexpr double kShownGain = 0.0005;  ///< Less is 0.0 % in a sentence.

std::string difference_text(const ViewGains& gains) {
  const ViewIndex view = gains.most_different();
  return fmt::format("up to {:.1f} % (view {}: {:.3f})", 100 * std::abs(gains.of(view) - 1),
                     view_text(view), gains.of(view));
}

// Of any channel.
double largest_difference(const ViewGains& gains) {
  double largest = 0;
  for (const double gain : gains.channel) {
    if (!std::isnan(gain)) largest = std::max(largest, std::abs(gain - 1));
  }
  return largest;
}

bool is_mapped(const LightField::Samples& samples) {
  return std::visit([](const auto& stack) { return stack.kind() == LargeKind::File; }, samples);
}

int count_unknown(const ViewGains& gains) {
  int unknown = 0;
  for (const double gain : gains.overall) unknown += std::isnan(gain) ? 1 : 0;
  return unknown;
}

}  // namespace

void equalise_views(SceneParts& parts, const OpenOptions& options, ConventionReport& report,
                    const Progress& progress) {
  const bool is_wanted = options.equalise;
  if (!is_wanted && is_mapped(parts.samples)) {
    report.gain = "not measured, since that would read the whole file";
    return;
  }
  // What is divided by gains needs them as exactly as can be; a report does not.
  const bool is_quick = !is_wanted && has_many_views(grid_of(parts.samples));
  const ViewGains gains =
      measure_view_gains(parts.samples, parts.valid, progress.part(0, is_wanted ? 0.5 : 1),
                         is_quick ? GainBlocks::OneOfFour : GainBlocks::All);
  const int views = gains.grid.count();
  if (views == 1) return;
  const int unknown = count_unknown(gains);
  if (unknown == views - 1) {
    report.gain = "not known: the views are too dark, too bright or too small to compare";
    return;
  }
  const bool is_notable = std::abs(gains.of(gains.most_different()) - 1) > kNotableGain;
  if (is_wanted && largest_difference(gains) > kMeasurableGain) {
    const double clipped = divide_by_gains(parts.samples, gains, progress.part(0.5, 1));
    report.gain = "evened out; it differed by " + difference_text(gains);
    if (clipped > 0) report.gain += fmt::format("; {:.2g} % of the samples clipped", 100 * clipped);
  } else {
    const bool is_same = std::abs(gains.of(gains.most_different()) - 1) < kShownGain;
    report.gain = is_same ? "the same in all views" : "differs by " + difference_text(gains);
    if (is_wanted && !is_same) report.gain += "; too little to even it out";
  }
  if (unknown > 0) report.gain += fmt::format("; of {} views not known", unknown);
  if (is_wanted || !is_notable) return;
  report.warnings.push_back(
      "The brightness of the views differs by " + difference_text(gains) +
      (options.keep_brightness
           ? "; without --no-equalise, methods even it out."
           : "; methods even it out, --equalise for pictures as well, --no-equalise for none."));
}

}  // namespace episcope::io
