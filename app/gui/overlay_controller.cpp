// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/overlay_controller.h"

#include "app/gui/queued_post.h"
#include "app/session/run/thread_priority.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/compare/color_bar.h"
#include "widgets/compare/overlay_bar.h"
#include "widgets/style/picture.h"
#include "widgets/style/quantity_text.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace episcope {
namespace {

using render::Quantity;

constexpr std::size_t kKeptPictures = 4;

// The range belongs to the quantity; all disparities share one.
Quantity range_key(Quantity quantity) {
  const bool is_disparity = render::info_of(quantity).rule == render::RangeRule::Disparity;
  return is_disparity ? Quantity::Disparity : quantity;
}

bool is_of_results(Quantity quantity) {
  const render::Subject subject = render::info_of(quantity).subject;
  return subject == render::Subject::Result || subject == render::Subject::Error;
}

}  // namespace

OverlayController::OverlayController(Session& session, const Panels& panels, QObject* parent)
    : QObject(parent), session_(session), panels_(panels), runner_(queued_post(this)) {
  connect(panels_.overlay_bar, &OverlayBar::quantitySelected, this,
          &OverlayController::setQuantity);
  connect(panels_.overlay_bar, &OverlayBar::opacityChanged, panels_.canvas,
          &ViewCanvas::setOverlayOpacity);
  connect(panels_.color_bar, &ColorBar::rangeEdited, this,
          [this](Interval range) { setRange(range); });
  connect(panels_.color_bar, &ColorBar::ownRangeRequested, this, &OverlayController::useOwnRange);
  connect(panels_.canvas, &ViewCanvas::cursorMoved, this, [this](std::optional<PixelIndex> pixel) {
    const auto value = pixel ? valueAt(*pixel) : std::nullopt;
    panels_.color_bar->setMarker(value.value_or(std::numeric_limits<double>::quiet_NaN()));
  });
  panels_.canvas->setOverlayOpacity(panels_.overlay_bar->opacity());
  session_.on_changed([this](Parts parts) { update(parts); });
  showAvailable();
  draw();
}

void OverlayController::update(Parts parts) {
  if (parts.has(Part::Scene)) {
    is_suspended_ = is_flipped_ = shows_difference_ = false;
    known_estimates_ = 0;
    shaded_.clear();
    if (!panels_.color_bar->isRangeLocked()) edited_ranges_.clear();
  }
  if (parts.has_any(Part::Scene | Part::Estimates)) {
    // Who ran a method wants to see what it found.
    const std::size_t count = session_.estimates().size();
    if (count > std::exchange(known_estimates_, count) && quantity_ == Quantity::View) {
      quantity_ = Quantity::Disparity;
    }
  }
  const Parts of_labels = Part::Segmentation | Part::TrueLabels;
  if (parts.has_any(Part::Scene | Part::Estimates | Part::Shown | of_labels)) {
    if (!isAvailable(quantity_)) quantity_ = Quantity::View;
    if (!session_.compared()) shows_difference_ = false;
    showAvailable();
  }
  if (parts.has_any(Part::Scene | Part::Estimates | Part::Shown | Part::View | Part::Evaluations |
                    of_labels)) {
    draw();
  }
}

bool OverlayController::isAvailable(Quantity quantity) const {
  return is_available(session_, quantity);
}

void OverlayController::showAvailable() {
  std::vector<Quantity> available;
  for (const render::QuantityInfo& info : render::quantities()) {
    if (isAvailable(info.quantity)) available.push_back(info.quantity);
  }
  panels_.overlay_bar->setAvailable(available);
  panels_.overlay_bar->setQuantity(quantity_);
  emit choiceChanged();
}

void OverlayController::setQuantity(Quantity quantity) {
  if (!isAvailable(quantity)) return;
  quantity_ = quantity;
  shows_difference_ = false;
  panels_.overlay_bar->setQuantity(quantity);
  draw();
  emit choiceChanged();
}

void OverlayController::selectNextQuantity() {
  panels_.overlay_bar->selectNextQuantity();
}

void OverlayController::setDifference(bool shows_difference) {
  shows_difference_ = shows_difference && session_.compared();
  draw();
  emit choiceChanged();
}

void OverlayController::setFlipped(bool is_flipped) {
  if (std::exchange(is_flipped_, is_flipped) != is_flipped) draw();
}

void OverlayController::setSuspended(bool is_suspended) {
  is_suspended_ = is_suspended;
  if (!is_suspended) draw();
}

MapChoice OverlayController::choice() const {
  if (is_flipped_) return choiceB();
  const EstimateEntry* compared = session_.compared();
  if (!shows_difference_ || !compared) return choiceA();
  return {Quantity::Difference, session_.shown()->id, compared->id};
}

MapChoice OverlayController::choiceA() const {
  const EstimateEntry* shown = session_.shown();
  return {quantity_, shown && is_of_results(quantity_) ? shown->id : 0, 0};
}

MapChoice OverlayController::choiceB() const {
  const EstimateEntry* compared = session_.compared();
  if (is_of_results(quantity_) && compared) return {quantity_, compared->id, 0};
  const Quantity other = quantity_ == Quantity::Disparity      ? Quantity::Truth
                         : quantity_ == Quantity::Segmentation ? Quantity::TrueLabels
                                                               : Quantity::View;
  return {isAvailable(other) ? other : Quantity::View, 0, 0};
}

render::Shading OverlayController::shadingOf(const MapChoice& choice) const {
  const auto edited = edited_ranges_.find(range_key(choice.quantity));
  return shading_of(
      choice.quantity, session_.disparity_range(),
      {.range = edited == edited_ranges_.end() ? std::nullopt : std::optional(edited->second)});
}

render::Shading OverlayController::shadingOf(Quantity quantity) const {
  return shadingOf(MapChoice{quantity, 0, 0});
}

void OverlayController::draw() {
  if (is_suspended_) return;
  const MapChoice drawn_choice = choice();
  drawMap(drawn_choice);
  panels_.canvas->setOverlay(picture_);
  const bool has_scale = session_.scene() && render::info_of(drawn_choice.quantity).has_scale();
  panels_.color_bar->setVisible(has_scale);
  if (has_scale) {
    panels_.color_bar->setShading(quantity_label(drawn_choice.quantity),
                                  quantity_unit(drawn_choice.quantity), shadingOf(drawn_choice));
  }
  if (session_.scene()) showCaption(drawn_choice);
  emit drawn();
}

void OverlayController::drawMap(const MapChoice& choice) {
  const auto source = map_source(session_, choice, session_.view());
  if (!source) {
    // While the errors of a view are computed, what was drawn stays: a few milliseconds.
    is_up_to_date_ =
        !session_.scene() || !is_of_results(choice.quantity) || !session_.is_evaluating();
    if (!is_up_to_date_) return;
    map_ = nullptr;
    picture_ = {};
    return;
  }
  const render::Shading shading = shadingOf(choice);
  if (const Shaded* found = find(*source, shading)) {
    is_up_to_date_ = true;
    map_ = found->map->map.empty() ? nullptr : found->map;
    picture_ = found->picture;
    return;
  }
  // In another range, the numbers are known before the picture is.
  const auto known = knownMap(*source);
  is_up_to_date_ = known && !known->map.empty();
  if (is_up_to_date_) map_ = known;
  beginShading(*source, shading);
}

const OverlayController::Shaded* OverlayController::find(const MapSource& source,
                                                         const render::Shading& shading) {
  const auto found = std::find_if(shaded_.begin(), shaded_.end(), [&](const Shaded& each) {
    return each.source == source && render::is_same(each.shading, shading);
  });
  if (found == shaded_.end()) return nullptr;
  shaded_.splice(shaded_.begin(), shaded_, found);
  return &shaded_.front();
}

QuantityMapPtr OverlayController::knownMap(const MapSource& source) const {
  const auto found = std::find_if(shaded_.begin(), shaded_.end(),
                                  [&](const Shaded& each) { return each.source == source; });
  return found == shaded_.end() ? nullptr : found->map;
}

// One picture at a time: when it is there, drawing again asks for what is wanted by then. However
// fast a range is dragged, pictures keep coming.
void OverlayController::beginShading(const MapSource& source, const render::Shading& shading) {
  if (std::exchange(is_shading_, true)) return;
  runner_.start<Shaded>(
      [source, shading, map = knownMap(source)](const Progress&) mutable {
        lower_thread_priority();
        if (!map) map = make_map(source);
        return Shaded{source, shading, map, to_qimage(overlay_picture(*map, shading))};
      },
      [this, generation = session_.generation()](Outcome<Shaded> outcome) {
        is_shading_ = false;
        if (outcome.failure) return;
        if (generation == session_.generation()) finishShading(std::move(*outcome.value));
        draw();
      });
}

void OverlayController::finishShading(Shaded shaded) {
  std::erase_if(shaded_, [&](const Shaded& each) { return each.source == shaded.source; });
  shaded_.push_front(std::move(shaded));
  if (shaded_.size() > kKeptPictures) shaded_.pop_back();
}

std::optional<QImage> OverlayController::pictureOf(const MapChoice& choice) {
  const auto source = map_source(session_, choice, session_.view());
  if (!source) return session_.is_evaluating() ? std::nullopt : std::optional(QImage());
  const render::Shading shading = shadingOf(choice);
  if (const Shaded* found = find(*source, shading)) return found->picture;
  beginShading(*source, shading);
  return std::nullopt;
}

QString OverlayController::describe(const MapChoice& choice) const {
  const EstimateEntry* entry = session_.find_estimate(choice.estimate);
  const EstimateEntry* other = session_.find_estimate(choice.other);
  const auto name = [](const EstimateEntry* each) { return QString::fromStdString(each->name); };
  if (entry && other) return tr("%1 − %2").arg(name(entry), name(other));
  if (choice.quantity == Quantity::View) return tr("view");
  if (!entry) return quantity_label(choice.quantity);
  return tr("%1 of %2").arg(quantity_label(choice.quantity), name(entry));
}

void OverlayController::showCaption(const MapChoice& choice) const {
  const ViewIndex view = session_.view();
  QString caption = tr("view (v %1, u %2)").arg(view.v).arg(view.u);
  if (choice.quantity != Quantity::View) caption += tr(" · %1").arg(describe(choice));
  if (choice.quantity != Quantity::View && picture_.isNull() && is_up_to_date_) {
    caption += tr(" · no such map of this view");
  }
  const bool has_sides =
      choice.quantity != Quantity::Difference && (is_flipped_ || session_.compared());
  panels_.canvas->setCaption(caption, !has_sides ? Side::None : is_flipped_ ? Side::B : Side::A);
}

void OverlayController::setRange(std::optional<Interval> range) {
  const Quantity key = range_key(choice().quantity);
  if (range) {
    edited_ranges_[key] = *range;
  } else {
    edited_ranges_.erase(key);
  }
  draw();
}

void OverlayController::useOwnRange() {
  setRange(std::nullopt);
}

std::optional<double> OverlayController::valueAt(PixelIndex pixel) const {
  return map_ ? map_->value_at(pixel) : std::nullopt;
}

}  // namespace episcope
