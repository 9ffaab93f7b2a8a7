// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/overlay_controller.h"

#include "app/gui/queued_post.h"
#include "app/session/thread_priority.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/compare/color_bar.h"
#include "widgets/compare/overlay_bar.h"
#include "widgets/style/picture.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace episcope {
namespace {

using render::Quantity;

constexpr Quantity kQuantities[] = {
    Quantity::Disparity, Quantity::Background,   Quantity::Layers,        Quantity::Confidence,
    Quantity::Truth,     Quantity::SignedError,  Quantity::AbsoluteError, Quantity::BadPixels,
    Quantity::Labels,    Quantity::Segmentation, Quantity::Probability,   Quantity::Uncertainty,
    Quantity::Edges,     Quantity::WrongLabels};

constexpr std::size_t kKeptPictures = 4;

// The range belongs to the quantity: disparity and truth share one, a difference has its own.
int range_key(const OverlayChoice& choice) {
  if (choice.subtracted != 0) return -1;
  const bool is_disparity =
      choice.quantity == Quantity::Truth || choice.quantity == Quantity::Background;
  return static_cast<int>(is_disparity ? Quantity::Disparity : choice.quantity);
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
  const auto& scene = session_.scene();
  if (!scene) return quantity == Quantity::View;
  const EstimateEntry* shown = session_.shown();
  const bool is_segmented = session_.segmentation() && session_.segmentation()->labeling;
  switch (quantity) {
    case Quantity::View:
      return true;
    case Quantity::Disparity:
      return shown != nullptr;
    case Quantity::Confidence:
      return shown && !shown->estimate->confidence.empty();
    case Quantity::Truth:
      return scene->truth->has_disparity();
    case Quantity::Labels:
      return session_.true_labels() != nullptr;
    case Quantity::Edges:
      return true;
    case Quantity::Segmentation:
    case Quantity::Probability:
    case Quantity::Uncertainty:
      return is_segmented;
    case Quantity::WrongLabels:
      return is_segmented && session_.true_labels() != nullptr;
    case Quantity::Background:
      return shown && !shown->estimate->layered.background.empty();
    case Quantity::Layers:
      return shown && !shown->estimate->layered.layers.empty();
    default:
      return shown && scene->truth->has_disparity();
  }
}

void OverlayController::showAvailable() {
  std::vector<Quantity> available;
  for (const Quantity quantity : kQuantities) {
    if (isAvailable(quantity)) available.push_back(quantity);
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

OverlayChoice OverlayController::choice() const {
  if (is_flipped_) return choiceB();
  const EstimateEntry* compared = session_.compared();
  if (!shows_difference_ || !compared) return choiceA();
  return {Quantity::Disparity, session_.shown()->id, compared->id};
}

OverlayChoice OverlayController::choiceA() const {
  const EstimateEntry* shown = session_.shown();
  return {quantity_, shown && !is_of_segmentation(quantity_) ? shown->id : 0, 0};
}

OverlayChoice OverlayController::choiceB() const {
  if (is_of_segmentation(quantity_)) {
    const bool shows_truth = quantity_ == Quantity::Segmentation && isAvailable(Quantity::Labels);
    return {shows_truth ? Quantity::Labels : Quantity::View, 0, 0};
  }
  if (const EstimateEntry* compared = session_.compared()) return {quantity_, compared->id, 0};
  const bool shows_truth = quantity_ == Quantity::Disparity && isAvailable(Quantity::Truth);
  return {shows_truth ? Quantity::Truth : Quantity::View, choiceA().estimate, 0};
}

render::Shading OverlayController::shadingOf(const OverlayChoice& choice) const {
  const bool is_difference = choice.subtracted != 0;
  render::Shading shading = render::default_shading(
      is_difference ? Quantity::SignedError : choice.quantity, session_.disparity_range());
  if (const auto edited = edited_ranges_.find(range_key(choice)); edited != edited_ranges_.end()) {
    shading.range = edited->second;
  }
  return shading;
}

render::Shading OverlayController::shadingOf(Quantity quantity) const {
  return shadingOf(OverlayChoice{quantity, 0, 0});
}

void OverlayController::draw() {
  if (is_suspended_) return;
  const OverlayChoice drawn_choice = choice();
  drawMap(drawn_choice);
  panels_.canvas->setOverlay(picture_);
  const bool has_scale = session_.scene() && drawn_choice.quantity != Quantity::View &&
                         drawn_choice.quantity != Quantity::Labels &&
                         drawn_choice.quantity != Quantity::Segmentation;
  panels_.color_bar->setVisible(has_scale);
  if (has_scale) {
    panels_.color_bar->setShading(
        drawn_choice.subtracted != 0 ? tr("difference") : quantity_label(drawn_choice.quantity),
        quantity_unit(drawn_choice.quantity), shadingOf(drawn_choice));
  }
  if (session_.scene()) showCaption(drawn_choice);
  emit drawn();
}

void OverlayController::drawMap(const OverlayChoice& choice) {
  const auto source = overlay_source(session_, choice, session_.view());
  if (!source) {
    // While the errors of a view are computed, what was drawn stays: a few milliseconds.
    is_up_to_date_ = !session_.scene() || choice.quantity == Quantity::View ||
                     choice.quantity == Quantity::Labels || !session_.is_evaluating();
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

const OverlayController::Shaded* OverlayController::find(const OverlaySource& source,
                                                         const render::Shading& shading) {
  const auto found = std::find_if(shaded_.begin(), shaded_.end(), [&](const Shaded& each) {
    return each.source == source && render::is_same(each.shading, shading);
  });
  if (found == shaded_.end()) return nullptr;
  shaded_.splice(shaded_.begin(), shaded_, found);
  return &shaded_.front();
}

std::shared_ptr<const OverlayMap> OverlayController::knownMap(const OverlaySource& source) const {
  const auto found = std::find_if(shaded_.begin(), shaded_.end(),
                                  [&](const Shaded& each) { return each.source == source; });
  return found == shaded_.end() ? nullptr : found->map;
}

// One picture at a time: when it is there, drawing again asks for what is wanted by then. However
// fast a range is dragged, pictures keep coming.
void OverlayController::beginShading(const OverlaySource& source, const render::Shading& shading) {
  if (std::exchange(is_shading_, true)) return;
  runner_.start<Shaded>(
      [source, shading, map = knownMap(source)](const Progress&) mutable {
        lower_thread_priority();
        if (!map) map = make_overlay_map(source);
        return Shaded{source, shading, map, to_qimage(shade_overlay(*map, shading))};
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

std::optional<QImage> OverlayController::pictureOf(const OverlayChoice& choice) {
  const auto source = overlay_source(session_, choice, session_.view());
  if (!source) return session_.is_evaluating() ? std::nullopt : std::optional(QImage());
  const render::Shading shading = shadingOf(choice);
  if (const Shaded* found = find(*source, shading)) return found->picture;
  beginShading(*source, shading);
  return std::nullopt;
}

QString OverlayController::describe(const OverlayChoice& choice) const {
  const EstimateEntry* entry = session_.find_estimate(choice.estimate);
  const EstimateEntry* other = session_.find_estimate(choice.subtracted);
  const auto name = [](const EstimateEntry* each) { return QString::fromStdString(each->name); };
  if (entry && other) return tr("%1 − %2").arg(name(entry), name(other));
  if (choice.quantity == Quantity::View) return tr("view");
  if (!entry || choice.quantity == Quantity::Truth || choice.quantity == Quantity::Labels) {
    return quantity_label(choice.quantity);
  }
  return tr("%1 of %2").arg(quantity_label(choice.quantity), name(entry));
}

void OverlayController::showCaption(const OverlayChoice& choice) const {
  const ViewIndex view = session_.view();
  QString caption = tr("view (v %1, u %2)").arg(view.v).arg(view.u);
  if (choice.quantity != Quantity::View) caption += tr(" · %1").arg(describe(choice));
  if (choice.quantity != Quantity::View && picture_.isNull() && is_up_to_date_) {
    caption += tr(" · no such map of this view");
  }
  const bool has_sides = choice.subtracted == 0 && (is_flipped_ || session_.compared());
  panels_.canvas->setCaption(caption, !has_sides ? Side::None : is_flipped_ ? Side::B : Side::A);
}

void OverlayController::setRange(std::optional<Interval> range) {
  const int key = range_key(choice());
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
