// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/estimate/measured_range.h"

#include "app/gui/frame/commands.h"
#include "app/gui/frame/messages.h"
#include "app/session/session.h"
#include "widgets/estimate/method_panel.h"
#include "widgets/style/number_text.h"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

constexpr const char* kRange = "range";  // in the schema of every method
constexpr double kLeastLength_px = 0.5;
constexpr double kSteps = 100;       // per px
constexpr int kMeasuredSection = 2;  // of the menu Estimate

struct Text {
  Q_DECLARE_TR_FUNCTIONS(episcope::MeasuredRange)
};

void take(const Workbench& bench, MethodPanel* panel, RangeEnd end) {
  const EpiMeasurement* measured = current_of(bench.session.place().measured);
  RunRequest request = panel->request();
  const auto found = std::ranges::find(request.values, kRange, &ParameterSet::value_type::first);
  if (!measured || found == request.values.end()) return;
  const auto& chosen = std::get<IntervalOrAuto>(found->second);
  const Interval range =
      with_end(chosen ? *chosen : bench.session.known_range(), end, measured->disparity_px);
  found->second = IntervalOrAuto(range);
  panel->setRequest(request);
  bench.messages.hint(Text::tr("Disparity range of the next run: %1 … %2 px")
                          .arg(number_text(range.min, 2), number_text(range.max, 2)));
}

}  // namespace

Interval with_end(Interval range, RangeEnd end, double disparity_px) {
  if (range.length() <= 0) range = {disparity_px, disparity_px};
  if (end == RangeEnd::Lower) {
    range.min = std::floor(disparity_px * kSteps) / kSteps;
    if (range.max <= range.min) range.max = range.min + kLeastLength_px;
  } else {
    range.max = std::ceil(disparity_px * kSteps) / kSteps;
    if (range.min >= range.max) range.min = range.max - kLeastLength_px;
  }
  return range;
}

void add_measured_range(const Workbench& bench, MethodPanel* panel) {
  struct Row {
    const char* id;
    QString text;
    QString tip;
    RangeEnd end;
  };
  for (const Row& row : std::initializer_list<Row>{
           {"estimate.range_from", Text::tr("Range begins at the chosen measurement"),
            Text::tr("Makes the chosen measured line the lower end of the disparity range of the "
                     "method"),
            RangeEnd::Lower},
           {"estimate.range_to", Text::tr("Range ends at the chosen measurement"),
            Text::tr("Makes the chosen measured line the upper end of the disparity range of the "
                     "method"),
            RangeEnd::Upper}}) {
    bench.commands.add(
        {.id = row.id,
         .menu = Menu::Estimate,
         .text = row.text,
         .tip = row.tip,
         .run = [bench, panel, end = row.end] { take(bench, panel, end); },
         .section = kMeasuredSection,
         .enabled = [bench] { return current_of(bench.session.place().measured) != nullptr; }});
  }
}

}  // namespace episcope
