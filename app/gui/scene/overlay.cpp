// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/scene/overlay.h"

#include "app/gui/shell/jobs.h"
#include "app/session/command_line.h"
#include "app/session/run_estimator.h"
#include "engine/core/parallel.h"
#include "engine/disparity/registry.h"
#include "engine/evaluation/metrics.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/picture.h"
#include "widgets/controls/text.h"
#include "widgets/panels/color_bar.h"
#include "widgets/panels/overlay_bar.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <variant>

namespace episcope {
namespace {

using render::Quantity;
using render::Subject;

// The range belongs to the quantity; all disparities share one.
Quantity range_key(Quantity quantity) {
  const bool is_disparity = render::info_of(quantity).rule == render::RangeRule::Disparity;
  return is_disparity ? Quantity::Disparity : quantity;
}

bool is_error(Quantity quantity) {
  const Subject subject = render::info_of(quantity).subject;
  return subject == Subject::Error || subject == Subject::ResultPair;
}

}  // namespace

Overlay::Overlay(Session& session, ViewerArea& viewer_area, QObject* parent)
    : QObject(parent),
      session_(session),
      viewer_area_(viewer_area),
      pictures_(queued_post(this), [this] { draw(); }) {
  connectStage();
  session_.on_changed([this](Parts parts) { update(parts); });
  showAvailable();
  draw();
}

void Overlay::connectStage() {
  OverlayBar* bar = viewer_area_.overlayBar();
  ColorBar* scale = viewer_area_.colorBar();
  ViewCanvas* canvas = viewer_area_.canvas();
  connect(bar, &OverlayBar::quantitySelected, this, &Overlay::choose);
  connect(bar, &OverlayBar::opacityChanged, this, &Overlay::setOpacity);
  connect(scale, &ColorBar::rangeEdited, this, [this](Interval range) { setRange(range); });
  connect(scale, &ColorBar::ownRangeRequested, this, [this] { setRange(std::nullopt); });
  connect(canvas, &ViewCanvas::cursorMoved, this, [this, scale](std::optional<PixelIndex> pixel) {
    // Colors of bad pixels say nothing of their numbers.
    const bool has_marker = pixel && map_ && map_->measured.empty();
    const auto value = has_marker ? valueAt(*pixel) : std::nullopt;
    scale->setMarker(value.value_or(std::numeric_limits<double>::quiet_NaN()));
  });
  connect(&viewer_area_, &ViewerArea::previewChanged, this, &Overlay::draw);
  opacity_ = bar->opacity();
}

void Overlay::setProvider(Subject subject, const MapProvider* provider) {
  if (provider) {
    providers_[subject] = provider;
  } else {
    providers_.erase(subject);
  }
}

void Overlay::updateProvided() {
  leaveWhatIsGone();
  showAvailable();
  draw();
}

void Overlay::leaveWhatIsGone() {
  if (!session_.scene()) return;  // the next one may have it
  if (!isAvailable(quantity_) && !isAwaited(quantity_)) quantity_ = Quantity::View;
}

bool Overlay::isAwaited(Quantity quantity) const {
  const auto provider = providers_.find(render::info_of(quantity).subject);
  return provider != providers_.end() && provider->second->awaits_map(quantity);
}

void Overlay::update(Parts parts) {
  if (parts.has(Part::Scene)) beginScene();
  if (parts.has_any(Part::Scene | Part::Estimates)) {
    // A new result is shown.
    const std::size_t count = session_.estimates().size();
    if (count > std::exchange(known_estimates_, count) && quantity_ == Quantity::View) {
      quantity_ = Quantity::Disparity;
    }
  }
  const Parts of_choice =
      Part::Scene | Part::Estimates | Part::Shown | Part::TrueLabels | Part::Live;
  if (parts.has_any(of_choice)) {
    leaveWhatIsGone();
    if (!session_.side_b()) shows_difference_ = false;
    showAvailable();
  }
  if (parts.has_any(of_choice | Part::View | Part::Evaluations | Part::LabelLook)) draw();
}

// A scene that was shown before looks as it did.
void Overlay::beginScene() {
  is_flipped_ = shows_difference_ = false;
  known_estimates_ = 0;
  pictures_.clear();
  map_ = nullptr;  // not even for a moment over another light field
  picture_ = {};
  scene_ = session_.generation();
  const ScenePlace& place = session_.place();
  if (!viewer_area_.colorBar()->isRangeLocked()) edited_ranges_ = place.ranges;
  if (!place.quantity) return;
  quantity_ = *place.quantity;
  shows_difference_ = place.comparison.shows_difference && session_.side_b();
  known_estimates_ = session_.estimates().size();
}

bool Overlay::isAvailable(Quantity quantity) const {
  const auto provider = providers_.find(render::info_of(quantity).subject);
  return provider == providers_.end() ? is_available(session_, quantity)
                                      : provider->second->has_map(quantity);
}

void Overlay::showAvailable() {
  std::vector<Quantity> available;
  for (const render::QuantityInfo& info : render::quantities()) {
    if (isAvailable(info.quantity)) available.push_back(info.quantity);
  }
  viewer_area_.overlayBar()->setAvailable(available);
  viewer_area_.overlayBar()->setQuantity(session_.scene() ? chosenQuantity() : Quantity::View);
  emit choiceChanged();
}

void Overlay::setQuantity(Quantity quantity) {
  if (!isAvailable(quantity)) return;
  quantity_ = quantity;
  shows_difference_ = false;
  viewer_area_.overlayBar()->setQuantity(quantity);
  draw();
  emit choiceChanged();
}

void Overlay::choose(Quantity quantity) {
  quantity == Quantity::Difference ? setDifference(true) : setQuantity(quantity);
}

void Overlay::showResults() {
  if (!is_of_result(quantity_)) setQuantity(Quantity::Disparity);
}

void Overlay::selectNextQuantity() {
  viewer_area_.overlayBar()->selectNextQuantity();
}

void Overlay::setDifference(bool shows_difference) {
  shows_difference_ = shows_difference && session_.side_b();
  viewer_area_.overlayBar()->setQuantity(chosenQuantity());
  draw();
  emit choiceChanged();
}

void Overlay::setFlipped(bool is_flipped) {
  if (std::exchange(is_flipped_, is_flipped) != is_flipped) draw();
}

MapChoice Overlay::choice() const {
  if (is_flipped_) return choiceB();
  const EstimateEntry* compared = session_.side_b();
  if (!shows_difference_ || !compared) return choiceA();
  return {Quantity::Difference, session_.side_a()->id, compared->id};
}

MapChoice Overlay::choiceA() const {
  const EstimateEntry* shown = session_.side_a();
  return {quantity_, shown && is_of_result(quantity_) ? shown->id : 0, 0};
}

MapChoice Overlay::choiceB() const {
  const EstimateEntry* compared = session_.side_b();
  if (is_of_result(quantity_) && compared) return {quantity_, compared->id, 0};
  const Quantity other = quantity_ == Quantity::Disparity      ? Quantity::Truth
                         : quantity_ == Quantity::Segmentation ? Quantity::TrueLabels
                                                               : Quantity::View;
  return {isAvailable(other) ? other : Quantity::View, 0, 0};
}

render::Shading Overlay::shadingOf(Quantity quantity) const {
  const auto edited = edited_ranges_.find(range_key(quantity));
  return shading_of(
      quantity, session_.disparity_range(),
      {.range = edited == edited_ranges_.end() ? std::nullopt : std::optional(edited->second)});
}

Quantity Overlay::chosenQuantity() const {
  return shows_difference_ && session_.side_b() ? Quantity::Difference : quantity_;
}

OverlayLook Overlay::lookOf(Quantity quantity) const {
  return {is_error(quantity) ? error_opacity_ : opacity_, is_view_colored_};
}

void Overlay::setOpacity(double opacity) {
  (is_error(chosenQuantity()) ? error_opacity_ : opacity_) = opacity;
  showLook();
}

void Overlay::setViewColored(bool is_colored) {
  is_view_colored_ = is_colored;
  draw();
  emit choiceChanged();
}

void Overlay::showLook() {
  const Quantity quantity = chosenQuantity();
  const OverlayLook look = lookOf(quantity);
  viewer_area_.overlayBar()->setOpacity(look.opacity);
  viewer_area_.canvas()->setOverlayOpacity(look.opacity);
  const bool is_covered = render::info_of(quantity).has_scale() ||
                          session_.label_style().drawing != render::LabelDrawing::Contours;
  viewer_area_.canvas()->setGreyUnderOverlay(quantity != Quantity::View && is_covered &&
                                             !look.is_view_colored);
}

std::optional<MapSource> Overlay::sourceOf(const MapChoice& choice) const {
  const auto provider = providers_.find(render::info_of(choice.quantity).subject);
  return provider == providers_.end()
             ? map_source(session_, choice, session_.view())
             : provider->second->map_source(choice.quantity, session_.view());
}

void Overlay::draw() {
  if (viewer_area_.isPreviewing()) return viewer_area_.colorBar()->hide();
  const MapChoice drawn_choice = choice();
  drawMap(drawn_choice);
  viewer_area_.canvas()->setOverlay(picture_);
  if (!picture_.isNull()) {
    session_.see(drawn_choice.estimate);
    session_.see(drawn_choice.other);
  }
  showLook();
  showScale(drawn_choice);
  if (session_.scene()) showCaption(drawn_choice);
  if (session_.scene() && scene_ == session_.generation()) {
    session_.set_display(quantity_, edited_ranges_);
    Comparison comparison = session_.place().comparison;
    comparison.shows_difference = shows_difference_;
    session_.set_comparison(comparison);
  }
  emit drawn();
}

void Overlay::drawMap(const MapChoice& choice) {
  const auto source = sourceOf(choice);
  if (!source) {
    // While the errors of a view are computed, what was drawn stays: a few milliseconds.
    is_up_to_date_ =
        !session_.scene() || !is_of_result(choice.quantity) || !session_.is_evaluating();
    if (!is_up_to_date_) return;
    map_ = nullptr;
    picture_ = {};
    return;
  }
  const render::Shading shading = shadingOf(choice.quantity);
  if (const auto* found = pictures_.find(*source, shading)) {
    is_up_to_date_ = true;
    map_ = found->map->map.empty() ? nullptr : found->map;
    picture_ = found->picture;
    return;
  }
  // In another range, the numbers are known before the picture is.
  const auto known = pictures_.find_map(*source);
  is_up_to_date_ = known && !known->map.empty();
  if (is_up_to_date_) map_ = known;
  pictures_.begin(*source, shading);
}

std::optional<QImage> Overlay::pictureOf(const MapChoice& choice) {
  const auto source = sourceOf(choice);
  if (!source) return session_.is_evaluating() ? std::nullopt : std::optional(QImage());
  const render::Shading shading = shadingOf(choice.quantity);
  if (const auto* found = pictures_.find(*source, shading)) return found->picture;
  pictures_.begin(*source, shading);
  return std::nullopt;
}

QString Overlay::describe(const MapChoice& choice) const {
  const EstimateEntry* entry = session_.find_estimate(choice.estimate);
  const EstimateEntry* other = session_.find_estimate(choice.other);
  const auto name = [](const EstimateEntry* each) { return QString::fromStdString(each->name); };
  if (entry && other) return tr("%1 − %2").arg(name(entry), name(other));
  if (choice.quantity == Quantity::View) return tr("view");
  const auto provider = providers_.find(render::info_of(choice.quantity).subject);
  if (provider != providers_.end()) {
    const QString title = provider->second->title(choice.quantity);
    if (!title.isEmpty()) return title;
  }
  if (!entry) return quantity_label(choice.quantity);
  if (choice.quantity == Quantity::BadPixels) {
    return tr("%1 (> %2 px) of %3")
        .arg(quantity_label(choice.quantity), number_text(session_.bad_threshold_px(), 2),
             name(entry));
  }
  return tr("%1 of %2").arg(quantity_label(choice.quantity), name(entry));
}

bool Overlay::isTruthWithoutError(const MapChoice& choice) const {
  return choice.quantity == Quantity::View && render::info_of(quantity_).subject == Subject::Error;
}

QString Overlay::nameB() const {
  const MapChoice other = choiceB();
  return isTruthWithoutError(other) ? quantity_label(Quantity::Truth) : describe(other);
}

QString Overlay::describeB() const {
  const MapChoice other = choiceB();
  const QString name = describe(other);
  return isTruthWithoutError(other) ? name + tr(" · the ground truth has no error") : name;
}

void Overlay::showScale(const MapChoice& choice) const {
  const bool has_scale = session_.scene() && render::info_of(choice.quantity).has_scale();
  ColorBar* scale = viewer_area_.colorBar();
  scale->setVisible(has_scale);
  if (!has_scale) return;
  if (choice.quantity == Quantity::BadPixels || choice.quantity == Quantity::WrongLabels) {
    return showClasses(choice.quantity);
  }
  scale->setShading(quantity_label(choice.quantity), quantity_unit(choice.quantity),
                    shadingOf(choice.quantity));
}

// Of maps with two values, a ramp of colors would say nothing.
void Overlay::showClasses(Quantity quantity) const {
  const render::Shading shading = shadingOf(quantity);
  const auto color_of = [&shading](float value) {
    return shading.map.color(value, shading.range.min, shading.range.max);
  };
  if (quantity == Quantity::WrongLabels) {  // right ones are not tinted
    return viewer_area_.colorBar()->setSwatches(
        quantity_label(quantity), {{color_of(kBadPixel), tr("wrong")}}, shading.map.invalid);
  }
  const QString threshold = number_text(session_.bad_threshold_px(), 2);
  viewer_area_.colorBar()->setSwatches(quantity_label(quantity),
                                       {{color_of(kGoodPixel), tr("≤ %1 px").arg(threshold)},
                                        {color_of(kBadPixel), tr("> %1 px").arg(threshold)}},
                                       shading.map.invalid);
}

void Overlay::showCaption(const MapChoice& choice) const {
  const ViewIndex view = session_.view();
  QString caption = tr("view (v %1, u %2)").arg(view.v).arg(view.u);
  if (choice.quantity != Quantity::View) caption += tr(" · %1").arg(describe(choice));
  if (isTruthWithoutError(choice)) caption += tr(" · the ground truth has no error");
  if (choice.quantity != Quantity::View && picture_.isNull() && is_up_to_date_) {
    caption += tr(" · no such map for this view");
  }
  // Truth and labels are of neither.
  const bool has_sides = is_of_result(quantity_) && choice.quantity != Quantity::Difference &&
                         (is_flipped_ || session_.side_b());
  viewer_area_.canvas()->setCaption(caption, !has_sides    ? Side::None
                                             : is_flipped_ ? Side::B
                                                           : Side::A);
}

void Overlay::setRange(std::optional<Interval> range) {
  const Quantity quantity = choice().quantity;
  const Quantity key = range_key(quantity);
  if (range) {
    const double reach = std::max(std::abs(range->min), std::abs(range->max));
    // The middle of a signed map is zero.
    edited_ranges_[key] = render::info_of(quantity).is_signed() ? Interval{-reach, reach} : *range;
  } else {
    edited_ranges_.erase(key);
  }
  draw();
}

std::optional<double> Overlay::valueAt(PixelIndex pixel) const {
  return map_ ? map_->value_at(pixel) : std::nullopt;
}

namespace {

constexpr std::size_t kKeptPictures = 4;

}  // namespace

OverlayPictures::OverlayPictures(JobRunner::Post post, std::function<void()> made)
    : made_(std::move(made)), runner_(std::move(post)) {}

const OverlayPictures::Entry* OverlayPictures::find(const MapSource& source,
                                                    const render::Shading& shading) {
  const auto found = std::ranges::find_if(entries_, [&](const Entry& each) {
    return each.source == source && render::is_same(each.shading, shading);
  });
  if (found == entries_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found);
  return &entries_.front();
}

QuantityMapPtr OverlayPictures::find_map(const MapSource& source) const {
  const auto found = std::ranges::find(entries_, source, &Entry::source);
  return found == entries_.end() ? nullptr : found->map;
}

void OverlayPictures::begin(const MapSource& source, const render::Shading& shading) {
  if (std::exchange(is_making_, true)) return;
  runner_.start<Entry>(
      [source, shading, map = find_map(source)](const Progress&) mutable {
        lower_thread_priority();
        if (!map) map = make_map(source);
        return Entry{source, shading, map, to_qimage(overlay_picture(*map, shading))};
      },
      [this, generation = generation_](Outcome<Entry> outcome) {
        is_making_ = false;
        if (outcome.failure) return;
        if (generation == generation_) keep(std::move(*outcome.value));
        made_();
      });
}

void OverlayPictures::keep(Entry entry) {
  std::erase_if(entries_, [&](const Entry& each) { return each.source == entry.source; });
  entries_.push_front(std::move(entry));
  if (entries_.size() > kKeptPictures) entries_.pop_back();
}

void OverlayPictures::clear() {
  entries_.clear();
  ++generation_;
}

Command map_command(Overlay& overlay, Quantity quantity, const QString& id) {
  const auto is_available = [&overlay, quantity] { return overlay.isAvailable(quantity); };
  return {.id = id,
          .menu = Menu::Map,
          .text = quantity_button(quantity),
          .tip = quantity_tip(quantity),
          .run = [&overlay, quantity] { overlay.setQuantity(quantity); },
          .section = section::kMaps,
          .enabled = is_available,
          .checked = [&overlay, quantity] { return overlay.chosenQuantity() == quantity; },
          .choice = "overlay",
          .visible = is_available};
}

bool is_of_result(Quantity quantity) {
  const render::Subject subject = render::info_of(quantity).subject;
  return subject == render::Subject::Result || subject == render::Subject::Error;
}

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

QString foreign_text(const EstimateEntry& entry) {
  if (entry.foreign_file.empty()) return {};
  return Overlay::tr("Belongs to another light field: %1. Its errors may be meaningless.")
      .arg(QString::fromStdString(entry.foreign_file.string()));
}

QString named_value(const Estimate& estimate, const std::string& key, const ParameterValue& value) {
  static const std::vector<ParameterDescription> kNone;
  const Estimator* known = known_estimator(estimate.method);
  return labeled_value_text(known ? known->parameters : kNone, key, value);
}

QString parameter_text(const Estimate& estimate, const ParameterSet& shared) {
  QStringList texts;
  if (was_taken_early(estimate)) texts << Overlay::tr("ended early");
  for (const auto& each : changed_parameters(estimate.method, estimate.parameters)) {
    const bool is_shared = std::ranges::find(shared, each) != shared.end();
    if (!is_shared) texts << named_value(estimate, each.first, each.second);
  }
  if (!texts.isEmpty()) return texts.join(", ");
  return estimate.parameters.empty() ? QString() : Overlay::tr("defaults");
}

}  // namespace episcope

#include "moc_overlay.cpp"
