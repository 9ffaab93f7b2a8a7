// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/browse/value_controller.h"

#include "app/gui/browse/disparity_at.h"
#include "widgets/browse/value_bar.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/style/number_text.h"

#include <algorithm>
#include <type_traits>
#include <variant>
#include <vector>

namespace episcope {
namespace {

QColor color_at(const LightField& light_field, ViewIndex view, PixelIndex pixel) {
  float normalized[3] = {};
  light_field.read_row(view, pixel.y, pixel.x, pixel.x + 1, normalized);
  if (light_field.channels() == 1) normalized[1] = normalized[2] = normalized[0];
  const auto bounded = [](float value) { return std::clamp(value, 0.0F, 1.0F); };
  return QColor::fromRgbF(bounded(normalized[0]), bounded(normalized[1]), bounded(normalized[2]));
}

// Of many results, a line has room for a few: A and B before the others.
std::vector<const EstimateEntry*> shown_first(const Session& session) {
  std::vector<const EstimateEntry*> entries;
  for (const EstimateEntry& entry : session.estimates()) entries.push_back(&entry);
  const auto rank = [&session](const EstimateEntry* entry) {
    return entry == session.shown() ? 0 : entry == session.compared() ? 1 : 2;
  };
  std::stable_sort(
      entries.begin(), entries.end(),
      [&rank](const EstimateEntry* a, const EstimateEntry* b) { return rank(a) < rank(b); });
  return entries;
}

}  // namespace

QStringList sample_texts(const LightField& light_field, ViewIndex view, PixelIndex pixel) {
  QStringList texts;
  std::visit(
      [&](const auto& stack) {
        const auto image = stack.view(view);
        for (int c = 0; c < image.channels; ++c) {
          const auto value = image.at(pixel.y, pixel.x, c);
          const int decimals = std::is_floating_point_v<decltype(value + 0)> ? 3 : 0;
          texts << QString::number(static_cast<double>(value), 'f', decimals);
        }
      },
      light_field.samples());
  return texts;
}

ValueController::ValueController(Session& session, const OverlayController& overlay,
                                 const Panels& panels, QObject* parent)
    : QObject(parent), session_(session), overlay_(overlay), panels_(panels) {
  connect(panels_.canvas, &ViewCanvas::cursorMoved, this, [this](std::optional<PixelIndex> pixel) {
    cursor_ = pixel;
    show();
  });
  panels_.canvas->setPixelText([this](int y, int x) { return pixelText({y, x}); });
  session_.on_changed([this](Parts parts) {
    if (parts.has(Part::Scene)) cursor_.reset();
    show();
  });
}

void ValueController::show() {
  const LightFieldPtr light_field = session_.light_field();
  const PixelIndex pixel = cursor_.value_or(session_.cross_hair());
  if (!light_field || pixel.y >= light_field->height() || pixel.x >= light_field->width()) {
    panels_.values->setReading(std::nullopt);
    return;
  }
  const ViewIndex view = session_.view();
  PixelReading reading;
  reading.pixel = pixel;
  reading.samples = sample_texts(*light_field, view, pixel).join(' ');
  reading.color = color_at(*light_field, view, pixel);
  const GroundTruth& truth = *session_.scene()->truth;
  const DisparityPair of_truth = disparities_at(truth, view, pixel);
  reading.has_truth = truth.field.contains(view) || truth.foreground.contains(view);
  reading.truth_px = of_truth.front;
  reading.background_truth_px = of_truth.behind;
  for (const EstimateEntry* entry : shown_first(session_)) {
    if (!entry->estimate->contains(view)) continue;
    const DisparityPair found = disparities_at(*entry->estimate, view, pixel);
    reading.estimates.push_back({QString::fromStdString(entry->name), found.front, found.behind});
  }
  panels_.values->setReading(reading);
}

QStringList ValueController::pixelText(PixelIndex pixel) const {
  const LightFieldPtr light_field = session_.light_field();
  if (!light_field || pixel.y >= light_field->height() || pixel.x >= light_field->width()) {
    return {};
  }
  if (!overlay_.picture().isNull()) {
    const auto value = overlay_.valueAt(pixel);
    if (value) return {number_text(*value)};
  }
  return sample_texts(*light_field, session_.view(), pixel);
}

}  // namespace episcope
