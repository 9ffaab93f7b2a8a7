// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/compare_controller.h"

#include "app/gui/scene/overlay.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/session/run_estimator.h"
#include "engine/core/parallel.h"
#include "widgets/canvas/tile_wall.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/picture.h"
#include "widgets/controls/text.h"
#include "widgets/panels/overlay_bar.h"

#include <QAction>
#include <QActionGroup>

#include <limits>
#include <utility>

namespace episcope {
namespace {

using render::Quantity;

// Estimates have ids from 1.
constexpr quint64 kViewTile = 0;
constexpr quint64 kTruthTile = std::numeric_limits<quint64>::max();

QStringList value_text(const QuantityMap& map, int y, int x) {
  const auto value = map.value_at({y, x});
  return value ? QStringList(number_text(*value)) : QStringList();
}

// Runs on a worker. Throws Cancelled.
std::vector<TilePicture> make_tile_pictures(const std::vector<TileRequest>& requests,
                                            const Progress& progress) {
  std::vector<TilePicture> pictures(requests.size());
  // All tiles are of one scene.
  const auto tone = requests.empty() ? nullptr : render::table_of(requests.front().tone);
  parallel_for(static_cast<int>(requests.size()), progress, [&](int i) {
    const TileRequest& request = requests[static_cast<std::size_t>(i)];
    TilePicture& picture = pictures[static_cast<std::size_t>(i)];
    if (request.source) picture.map = make_map(*request.source);
    RgbaImage drawn = render::shade_view(*request.light_field, request.view, tone.get());
    if (picture.map) {
      drawn = over_view(std::move(drawn), *picture.map, request.shading, request.look);
    }
    picture.picture = to_qimage(std::move(drawn)).convertToFormat(QImage::Format_RGB32);
  });
  return pictures;
}

}  // namespace

CompareController::CompareController(const Workbench& bench, CompareBar* bar)
    : QObject(&bench.owner),
      bench_(bench),
      session_(bench.session),
      overlay_(bench.overlay),
      canvas_(bench.viewer_area.canvas()),
      wall_(bench.viewer_area.wall()),
      bar_(bar),
      tile_job_(this) {
  addCommands();
  connectWall();
  bench.cancels.add(CancelRank::Comparing, [this] { return leave(); });
  connect(&overlay_, &Overlay::drawn, this, &CompareController::showMode);
  connect(bench.viewer_area.overlayBar(), &OverlayBar::opacityChanged, this,
          &CompareController::showMode);
  connect(&bench.viewer_area, &ViewerArea::singleViewRequested, this, &CompareController::leave);
  connect(&bench.viewer_area, &ViewerArea::previewChanged, this, [this](bool is_previewing) {
    is_previewing ? showComparison(CompareMode::Single) : restore();
  });
  connect(canvas_, &ViewCanvas::wipeMoved, this, [this](double position) {
    wipe_position_ = position;
    showWipe();
    keep();
  });
  connect(bar_, &CompareBar::aChosen, this,
          [this](quint64 id) { session_.show_estimate(static_cast<int>(id)); });
  connect(bar_, &CompareBar::bChosen, this,
          [this](quint64 id) { session_.compare_with(static_cast<int>(id)); });
  connect(&overlay_, &Overlay::choiceChanged, this, [this] {
    // Of a light field that is just coming, the mode follows.
    const bool is_of_scene = mode_ == session_.place().comparison.mode;
    if (overlay_.showsDifference() && mode_ != CompareMode::Wall && is_of_scene) leave();
    listChoices();
  });
  listChoices();
  session_.on_changed([this](Parts parts) { update(parts); });
}

void CompareController::connectWall() {
  TileWall* wall = wall_;
  ViewCanvas* canvas = canvas_;
  connect(wall, &TileWall::zoomChanged, canvas,
          [canvas](const LinkedZoom& zoom) { set_zoom(*canvas, zoom); });
  connect(wall, &TileWall::chosen, this, [this](quint64 tile) {
    // Side by side, the two stay where they are.
    if (mode_ == CompareMode::Wall) session_.show_estimate(static_cast<int>(tile));
  });
  connect(wall, &TileWall::opened, this, &CompareController::open);
  // The rest is answered as if it had happened in the canvas.
  connect(wall, &TileWall::crossHairRequested, canvas, &ViewCanvas::crossHairRequested);
  connect(wall, &TileWall::focusRequested, canvas, &ViewCanvas::focusRequested);
  connect(wall, &TileWall::menuRequested, canvas, &ViewCanvas::menuRequested);
  connect(wall, &TileWall::cursorMoved, canvas, &ViewCanvas::cursorMoved);
  connect(wall, &TileWall::spaceTapped, canvas, &ViewCanvas::spaceTapped);
  connect(wall, &TileWall::focusStepped, canvas, &ViewCanvas::focusStepped);
}

void CompareController::update(Parts parts) {
  const bool is_other_scene = parts.has(Part::Scene) && session_.scene();
  const bool is_other_mode = parts.has(Part::Display) &&
                             session_.place().comparison.mode != mode_ &&
                             !bench_.viewer_area.isPreviewing();
  if (is_other_scene || is_other_mode) {
    restore();
  } else if (parts.has_any(Part::Scene | Part::Estimates | Part::Shown | Part::Live) &&
             !isAvailable(mode_)) {
    showComparison(CompareMode::Single);
  }
  if (parts.has_any(Part::Evaluations | Part::Estimates | Part::Shown | Part::Tone)) showMode();
  if (parts.has(Part::CrossHair) && session_.scene()) {
    wall_->setCrossHair(session_.cross_hair());
  }
}

void CompareController::listChoices() {
  std::vector<CompareBar::Choice> choices;
  const auto add = [&choices](const EstimateEntry& entry) {
    choices.push_back(
        {static_cast<quint64>(entry.id), QString::fromStdString(entry.name), foreign_text(entry)});
  };
  if (const EstimateEntry* live = session_.live()) add(*live);
  for (const EstimateEntry& entry : session_.estimates()) add(entry);
  const EstimateEntry* shown = session_.side_a();
  const EstimateEntry* compared = session_.side_b();
  bar_->setChoices(choices, shown ? static_cast<quint64>(shown->id) : 0,
                   compared ? static_cast<quint64>(compared->id) : 0, overlay_.nameB());
}

bool CompareController::isAvailable(CompareMode mode) const {
  if (mode == CompareMode::Single) return true;
  if (!session_.scene()) return false;
  return session_.side_a() || (mode == CompareMode::Wall && session_.has_truth(session_.view()));
}

void CompareController::setMode(CompareMode mode) {
  showComparison(mode);
  keep();
}

// A scene is compared as it was left.
void CompareController::restore() {
  const Comparison& kept = session_.place().comparison;
  wipe_position_ = kept.wipe_position;
  showComparison(isAvailable(kept.mode) ? kept.mode : CompareMode::Single);
}

// It comes back with the scene and the project.
void CompareController::keep() {
  session_.set_comparison({mode_, wipe_position_, session_.place().comparison.shows_difference});
}

void CompareController::showComparison(CompareMode mode) {
  if (mode == mode_ || !isAvailable(mode)) return;
  mode_ = mode;
  const bool has_wall = mode == CompareMode::Sides || mode == CompareMode::Wall;
  if (mode != CompareMode::Wipe) {
    canvas_->endWipe();
    wipe_picture_ = {};
  }
  if (mode == CompareMode::Wipe || mode == CompareMode::Sides) overlay_.setDifference(false);
  if (mode != CompareMode::Single && overlay_.quantity() == Quantity::View) {
    overlay_.setQuantity(session_.side_a() ? Quantity::Disparity : Quantity::Truth);
  }
  bench_.viewer_area.setWallShown(has_wall);
  if (!has_wall) {
    entries_.clear();
    tile_job_.drop();
    wall_->setTiles({});
  }
  showMode();
  bench_.commands.refresh();
}

bool CompareController::leave() {
  if (mode_ == CompareMode::Single) return false;
  setMode(CompareMode::Single);
  return true;
}

void CompareController::showMode() {
  if (!session_.scene() || canvas_->state() != ViewCanvas::State::Picture) return;
  if (mode_ == CompareMode::Wipe) {
    showWipe();
  } else if (mode_ != CompareMode::Single) {
    showTiles();
  }
}

void CompareController::showWipe() {
  const MapChoice other = overlay_.choiceB();
  if (auto picture = overlay_.pictureOf(other)) wipe_picture_ = *std::move(picture);
  canvas_->setWipe(wipe_position_, wipe_picture_, overlay_.describeB());
}

TileRequest CompareController::request(const std::optional<MapChoice>& choice) const {
  TileRequest made{session_.light_field(), session_.view(), {}, {}, {}, session_.place().tone};
  if (!choice) return made;
  made.source = overlay_.sourceOf(*choice);
  made.shading = overlay_.shadingOf(choice->quantity);
  made.look = overlay_.lookOf(choice->quantity);
  return made;
}

std::vector<CompareController::Entry> CompareController::sides() const {
  std::vector<Entry> entries;
  for (const Side side : {Side::A, Side::B}) {
    const MapChoice choice = side == Side::A ? overlay_.choiceA() : overlay_.choiceB();
    const QString caption = side == Side::A ? overlay_.describe(choice) : overlay_.describeB();
    entries.push_back({static_cast<quint64>(side),
                       caption,
                       side,
                       request(choice),
                       {},
                       choice.quantity == Quantity::View});
  }
  return entries;
}

// With the range of its colors, unless they are those of the legend.
QString CompareController::withRange(const QString& caption, render::Quantity quantity) const {
  const render::Shading shading = overlay_.shadingOf(quantity);
  if (render::is_same(shading, overlay_.shadingOf(overlay_.choice().quantity))) return caption;
  const QString range =
      tr("%1 · %2 … %3")
          .arg(caption, number_text(shading.range.min, 2), number_text(shading.range.max, 2));
  return (range + ' ' + quantity_unit(quantity)).trimmed();
}

// Beside differences, one is no name of what is shown.
QString CompareController::captionOf(const EstimateEntry& entry, const MapChoice& choice) const {
  if (overlay_.showsDifference()) return withRange(overlay_.describe(choice), choice.quantity);
  const QString name = QString::fromStdString(entry.name);
  const auto evaluation =
      session_.evaluation({entry.id, judged_view(*session_.scene()), Protocol::Vmv2013});
  const auto mse = evaluation ? find_metric(evaluation->metrics, "mse_100") : std::nullopt;
  return mse ? tr("%1 · MSE×100 %2").arg(name, number_text(*mse, 2)) : name;
}

std::vector<CompareController::Entry> CompareController::everything() const {
  std::vector<Entry> entries = {
      {kViewTile, tr("view"), Side::None, request(std::nullopt), {}, true}};
  if (session_.has_truth(session_.view())) {
    entries.push_back({kTruthTile,
                       withRange(tr("ground truth"), Quantity::Truth),
                       Side::None,
                       request(MapChoice{Quantity::Truth, 0, 0}),
                       {}});
  }
  const EstimateEntry* shown = session_.side_a();
  const EstimateEntry* compared = session_.side_b();
  const Quantity quantity =
      is_of_result(overlay_.quantity()) ? overlay_.quantity() : Quantity::Disparity;
  std::vector<const EstimateEntry*> results;
  for (const EstimateEntry& entry : session_.estimates()) results.push_back(&entry);
  if (const EstimateEntry* live = session_.live()) results.push_back(live);
  for (const EstimateEntry* result : results) {
    const EstimateEntry& entry = *result;
    const bool is_compared = compared && compared->id == entry.id;
    MapChoice choice{quantity, entry.id, 0};
    if (overlay_.showsDifference() && compared && !is_compared) {
      choice = {Quantity::Difference, entry.id, compared->id};
    }
    const Side side = is_compared                         ? Side::B
                      : compared && shown->id == entry.id ? Side::A
                                                          : Side::None;
    entries.push_back(
        {static_cast<quint64>(entry.id), captionOf(entry, choice), side, request(choice), {}});
  }
  return entries;
}

void CompareController::showTiles() {
  std::vector<Entry> entries = mode_ == CompareMode::Sides ? sides() : everything();
  std::vector<TileRequest> missing;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    for (const Entry& known : entries_) {
      if (!known.picture.picture.isNull() && is_same(known.request, entries[i].request)) {
        entries[i].picture = known.picture;
      }
    }
    if (!entries[i].picture.picture.isNull()) continue;
    missing.push_back(entries[i].request);
    places.push_back(i);
  }
  if (missing.empty()) {
    tile_job_.drop();
    entries_ = std::move(entries);
    fillWall();
    return;
  }
  using Pictures = std::vector<TilePicture>;
  tile_job_.start<Pictures>(
      [missing](const Progress& progress) { return make_tile_pictures(missing, progress); },
      [this, entries, places](const Pictures& pictures) {
        entries_ = entries;
        for (std::size_t i = 0; i < places.size(); ++i) entries_[places[i]].picture = pictures[i];
        fillWall();
      });
}

void CompareController::fillWall() {
  std::vector<Tile> tiles;
  for (const Entry& entry : entries_) {
    Tile tile{entry.id, entry.caption, entry.side, entry.picture.picture, {}};
    if (const auto map = entry.picture.map) {
      tile.pixel_text = [map](int y, int x) { return value_text(*map, y, x); };
    } else if (entry.is_view) {
      tile.pixel_text = [request = entry.request](int y, int x) {
        return sample_texts(*request.light_field, request.view, {y, x});
      };
    } else {
      tile.caption = tr("%1 · no such map for this view").arg(entry.caption);
    }
    tiles.push_back(std::move(tile));
  }
  const bool was_empty = wall_->count() == 0;
  wall_->setTiles(tiles);
  if (was_empty) wall_->setZoom(zoom_of(*canvas_));
  wall_->setCrossHair(session_.cross_hair());
}

void CompareController::open(quint64 tile) {
  if (mode_ == CompareMode::Sides) {
    const EstimateEntry* b = session_.side_b();
    if (tile == static_cast<quint64>(Side::B) && b && !session_.live()) {
      session_.show_estimate(b->id);
    }
  } else if (tile == kViewTile || tile == kTruthTile) {
    overlay_.setQuantity(tile == kViewTile ? Quantity::View : Quantity::Truth);
  } else {
    session_.show_estimate(static_cast<int>(tile));
  }
  setMode(CompareMode::Single);
}

using render::Quantity;
using render::QuantityInfo;

void CompareController::addOverlayCommands() {
  for (const QuantityInfo& info : render::quantities()) {
    const bool is_of_labels = info.subject == render::Subject::Segmentation;
    if (is_of_labels || info.quantity == Quantity::Difference) continue;  // elsewhere
    const QString id = info.quantity == Quantity::View ? "none" : info.id;
    bench_.commands.add(map_command(overlay_, info.quantity, "overlay." + id));
  }
  QAction* color = bench_.commands.add(
      {.id = "overlay.color",
       .menu = Menu::Map,
       .text = tr("Colored view under maps"),
       .tip = tr("Keeps the colors of the view under maps. Otherwise it is grey, so that only the "
                 "map has colors"),
       .icon = "color",
       .run = [this] { overlay_.setViewColored(!overlay_.isViewColored()); },
       .section = section::kMapLook,
       .checked = [this] { return overlay_.isViewColored(); }});
  bench_.viewer_area.overlayBar()->addOpacityAction(color);
}

void CompareController::addChoiceCommands() {
  bench_.commands.add({.id = "compare.next_map",
                       .menu = Menu::Map,
                       .text = tr("Next map"),
                       .tip = tr("Shows the next map over the view"),
                       .keys = {Qt::Key_M},
                       .run = [this] { overlay_.selectNextQuantity(); },
                       .section = section::kMapLook});
  bench_.commands.add(
      {.id = "compare.flip",
       .menu = Menu::Compare,
       .text = tr("Flip to B"),
       .tip = tr("Shows B, the compared result, while the key is held in the view or a list"),
       .keys = {Qt::Key_Tab},
       .run = [this] { overlay_.setFlipped(!overlay_.isFlipped()); },
       .section = compare_section::kChoice,
       .scope = KeyScope::Held,
       .enabled = [this] { return session_.side_a() != nullptr; },
       .hold =
           [this](bool is_held) {
             if (mode_ == CompareMode::Single || !is_held) overlay_.setFlipped(is_held);
           }});
  bench_.commands.hearHeldKeys(canvas_);
}

void CompareController::addPairCommands() {
  const auto is_available = [this] { return session_.side_b() != nullptr; };
  bench_.commands.add(
      {.id = "compare.difference",
       .menu = Menu::Map,
       .text = tr("Difference A − B"),
       .tip = tr("Shows A minus B, the result shown minus the one it is compared with"),
       .icon = "difference",
       .keys = {Qt::Key_D},
       .run = [this] { overlay_.setDifference(!overlay_.showsDifference()); },
       .section = section::kMaps,
       .enabled = is_available,
       .checked = [this] { return overlay_.showsDifference(); },
       .choice = "overlay",
       .visible = is_available});
  bench_.commands.add(
      {.id = "compare.swap",
       .menu = Menu::Compare,
       .text = tr("Swap A and B"),
       .tip = tr("Shows B and compares it with A"),
       .icon = "swap",
       .keys = {Qt::Key_QuoteLeft},
       .run = [this] { session_.show_estimate(session_.compared()->id); },
       .section = compare_section::kChoice,
       .enabled = [this] { return !session_.live() && session_.compared() != nullptr; }});
}

void CompareController::addModeCommands() {
  struct Row {
    CompareMode mode;
    QString id;
    QString text;
    QString tip;
    Qt::Key key;
    BarSection bar = BarSection::None;
  };
  for (const Row& row : std::initializer_list<Row>{
           {CompareMode::Wipe, "wipe", tr("Wipe"),
            tr("Shows A to the left and B to the right of a divider that can be dragged"),
            Qt::Key_W},
           {CompareMode::Sides, "sides", tr("Side by side"), tr("Shows A beside B"), Qt::Key_H},
           {CompareMode::Wall, "tiles", tr("Tiles"),
            tr("Shows the view, the ground truth and every result"), Qt::Key_G,
            BarSection::Compare}}) {
    bench_.commands.add({.id = "compare." + row.id,
                         .menu = Menu::Compare,
                         .text = row.text,
                         .tip = row.tip,
                         .icon = row.id,
                         .keys = {row.key},
                         .run = [this, mode = row.mode] { toggleMode(mode); },
                         .section = compare_section::kModes,
                         .bar = row.bar,
                         .enabled = [this, mode = row.mode] { return isAvailable(mode); },
                         .checked = [this, mode = row.mode] { return mode_ == mode; },
                         .choice = "compare.mode"});
  }
}

void CompareController::addCommands() {
  addOverlayCommands();
  addModeCommands();
  addChoiceCommands();
  addPairCommands();
  for (const char* id :
       {"overlay.disparity", "overlay.error", "overlay.absolute_error", "overlay.bad_pixels"}) {
    bar_->addMap(bench_.commands.find(id));
  }
  for (const char* id :
       {"compare.wipe", "compare.sides", "compare.tiles", "compare.difference", "compare.swap"}) {
    bar_->addAction(bench_.commands.find(id));
  }
  connect(&overlay_, &Overlay::choiceChanged, &bench_.commands, &Commands::refresh);
}

bool is_same(const TileRequest& a, const TileRequest& b) {
  return a.light_field == b.light_field && a.view == b.view && a.source == b.source &&
         render::is_same(a.shading, b.shading) && a.look == b.look && a.tone == b.tone;
}

}  // namespace episcope

#include "moc_compare_controller.cpp"
