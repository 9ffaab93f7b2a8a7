// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/compare/picture_export.h"

#include "app/gui/scene/overlay.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/frame.h"
#include "app/session/picture.h"
#include "app/session/session.h"
#include "engine/io/base/image_file.h"
#include "engine/render/movie.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/number_spin.h"
#include "widgets/controls/picture.h"

#include <QCheckBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QDialog>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QWidget>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

namespace episcope {

namespace {

using render::CameraPath;
using render::MovieKind;

constexpr double kFarthestFocus_px = 20;

}  // namespace

/// Kind, camera path, duration and size of a movie. Disables rows that its kind does not use.
/// Setters never emit.
class MoviePanel : public QWidget {
  Q_OBJECT

 public:
  explicit MoviePanel(QWidget* parent = nullptr)
      : QWidget(parent),
        kind_(named("movie.kind", new QComboBox(this))),
        path_(named("movie.path", new QComboBox(this))),
        nearest_(named("movie.focusTo", new NumberSpin(this))),
        farthest_(named("movie.focusFrom", new NumberSpin(this))),
        seconds_(named("movie.seconds", new NumberSpin(this))),
        width_(named("movie.width", new QSpinBox(this))),
        overlay_(named("movie.overlay", new QCheckBox(tr("With the overlay of the view"), this))) {
    setObjectName("moviePanel");
    auto* form = new QFormLayout(this);
    addKinds(*form);
    addFocus(*form);
    addSizes(*form);
    overlay_->setChecked(true);
    form->addRow(QString(), overlay_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    buttons->button(QDialogButtonBox::Cancel)->setObjectName("movie.cancel");
    QPushButton* save = buttons->addButton(tr("Save…"), QDialogButtonBox::AcceptRole);
    save->setObjectName("movie.save");
    save->setDefault(true);
    form->addRow(buttons);
    connect(buttons, &QDialogButtonBox::accepted, this, &MoviePanel::saveRequested);
    connect(buttons, &QDialogButtonBox::rejected, this, &MoviePanel::cancelRequested);
    connect(kind_, &QComboBox::currentIndexChanged, this, &MoviePanel::adapt);
    adapt();
  }

  /// Available kinds; at least the parallax.
  void setAvailable(const std::set<MovieKind>& kinds) {
    for (int i = 0; i < kind_->count(); ++i) {
      const auto kind = static_cast<MovieKind>(kind_->itemData(i).toInt());
      set_item_enabled(kind_, i, kinds.contains(kind));
      if (i == kind_->currentIndex() && !kinds.contains(kind)) kind_->setCurrentIndex(0);
    }
  }

  /// Whether there is an overlay to include.
  void setOverlayAvailable(bool is_available) {
    has_overlay_ = is_available;
    adapt();
  }

  void setFocusRange(Interval range_px) {
    farthest_->setValue(range_px.min);
    nearest_->setValue(range_px.max);
  }

  [[nodiscard]] render::MovieChoice choice() const {
    return {.kind = static_cast<MovieKind>(kind_->currentData().toInt()),
            .path = static_cast<CameraPath>(path_->currentData().toInt()),
            .focus_px = {farthest_->value(), nearest_->value()},
            .seconds = seconds_->value(),
            .width_px = width_->value()};
  }

  [[nodiscard]] bool showsOverlay() const { return overlay_->isEnabled() && overlay_->isChecked(); }

 signals:
  void saveRequested();
  void cancelRequested();

 private:
  void addKinds(QFormLayout& form) {
    kind_->addItem(tr("Parallax: the view moves"), static_cast<int>(MovieKind::Parallax));
    kind_->addItem(tr("Refocusing: the focus plane moves"), static_cast<int>(MovieKind::Refocus));
    kind_->addItem(tr("Flip: A and B alternate"), static_cast<int>(MovieKind::Flip));
    path_->addItem(tr("Around the center"), static_cast<int>(CameraPath::Circle));
    path_->addItem(tr("Along the row of the center"), static_cast<int>(CameraPath::Swing));
    path_->addItem(tr("Through all views"), static_cast<int>(CameraPath::Snake));
    form.addRow(tr("What changes"), kind_);
    form.addRow(tr("Path"), path_);
  }

  void addFocus(QFormLayout& form) {
    farthest_->setAccessibleName(tr("Focus from"));
    nearest_->setAccessibleName(tr("Focus to"));
    for (NumberSpin* each : {farthest_, nearest_}) {
      each->setDecimals(2);
      each->setSingleStep(0.1);
      each->setRange(-kFarthestFocus_px, kFarthestFocus_px);
      each->setSuffix(tr(" px"));
      each->setToolTip(tr("Disparity in focus at one end of the movement"));
    }
    auto* row = make_row({{farthest_, 1}, new QLabel(tr("to"), this), {nearest_, 1}});
    form.addRow(tr("Focus from"), row);
  }

  void addSizes(QFormLayout& form) {
    seconds_->setDecimals(1);
    seconds_->setRange(render::kMovieSeconds.min, render::kMovieSeconds.max);
    seconds_->setSuffix(tr(" s"));
    seconds_->setValue(render::MovieChoice().seconds);
    width_->setRange(0, render::kWidestMovie_px);
    width_->setSingleStep(64);
    width_->setSuffix(tr(" px"));
    width_->setSpecialValueText(tr("as the views"));
    form.addRow(tr("Duration"), seconds_);
    form.addRow(tr("Width"), width_);
  }

  void adapt() {
    const MovieKind kind = choice().kind;
    path_->setEnabled(kind == MovieKind::Parallax);
    for (NumberSpin* each : {farthest_, nearest_}) each->setEnabled(kind == MovieKind::Refocus);
    overlay_->setEnabled(kind == MovieKind::Parallax && has_overlay_);
  }

  QComboBox* kind_;
  QComboBox* path_;
  NumberSpin* nearest_;
  NumberSpin* farthest_;
  NumberSpin* seconds_;
  QSpinBox* width_;
  QCheckBox* overlay_;
  bool has_overlay_ = false;
};

namespace {

struct PictureExportText {
  Q_DECLARE_TR_FUNCTIONS(episcope::PictureExport)
};

struct DrawnMap {
  MapSource source;
  render::Shading shading;
  OverlayLook look;
};

DrawnMap drawn_as_shown(const Overlay& overlay, MapSource source) {
  const render::Quantity quantity = source.quantity;
  return {std::move(source), overlay.shadingOf(quantity), overlay.lookOf(quantity)};
}

// The overlay's map; none without an overlay.
std::optional<DrawnMap> drawn_map(const Overlay& overlay) {
  auto source = overlay.sourceOf(overlay.choice());
  if (!source) return std::nullopt;
  return drawn_as_shown(overlay, std::move(*source));
}

QString scene_name(const Session& session) {
  return QString::fromStdString(session.light_field()->info().name);
}

void ask_for_picture(const Workbench& bench) {
  ask_where_to_save(bench,
                    {.name = "save_picture",
                     .title = PictureExportText::tr("Save the picture"),
                     .filter = PictureExportText::tr("PNG (*.png)"),
                     .proposal = scene_name(bench.session) + ".png"},
                    [bench](const QString& path) { save_picture(bench, path); });
}

void ask_for_map(const Workbench& bench) {
  if (!drawn_map(bench.overlay)) {
    bench.messages.hint(
        PictureExportText::tr("No map is shown: choose one in the tool bar, then save it."));
    return;
  }
  const char* quantity = render::info_of(bench.overlay.choice().quantity).id;
  ask_where_to_save(bench,
                    {.name = "save_map",
                     .title = PictureExportText::tr("Save the map"),
                     .filter = PictureExportText::tr("PNG (*.png)"),
                     .proposal = scene_name(bench.session) + '_' + quantity + ".png"},
                    [bench](const QString& path) { save_map_picture(bench, path); });
}

}  // namespace

void add_picture_export(const Workbench& bench) {
  const auto has_scene = [&session = bench.session] { return session.scene() != nullptr; };
  bench.commands.add(
      {.menu = Menu::Export, .section = section::kPictures, .enabled = has_scene},
      {{.id = "file.save_picture",
        .text = PictureExportText::tr("Picture…"),
        .tip = PictureExportText::tr(
            "Saves the view as it is shown, with its brightness and overlay, as PNG"),
        .icon = "save",
        .keys = {PictureExportText::tr("Ctrl+Shift+E")},
        .run = [bench] { ask_for_picture(bench); }},
       {.id = "file.save_map",
        .text = PictureExportText::tr("Map…"),
        .tip = PictureExportText::tr("Saves the map drawn over the view as PNG"),
        .run = [bench] { ask_for_map(bench); }}});
}

void save_picture(const Workbench& bench, const QString& path) {
  auto picture = std::make_shared<RgbaImage>(to_picture(bench.viewer_area.canvas()->picture()));
  if (picture->empty() || !has_suffix(path, {"png"}, bench.messages)) return;
  write_in_background(
      bench.jobs, bench.messages, path,
      [file = std::filesystem::path(path.toStdString()), picture,
       drawn = drawn_map(bench.overlay)](const Progress&) {
        if (!drawn) return io::write_picture(file, picture->view());
        io::write_picture(
            file,
            over_view(*picture, *make_map(drawn->source), drawn->shading, drawn->look).view());
      });
}

void save_map_picture(const Workbench& bench, const QString& path) {
  const auto drawn = drawn_map(bench.overlay);
  if (!drawn || !has_suffix(path, {"png"}, bench.messages)) return;
  write_in_background(bench.jobs, bench.messages, path,
                      [file = std::filesystem::path(path.toStdString()), drawn](const Progress&) {
                        const QuantityMapPtr map = make_map(drawn->source);
                        io::write_picture(file, map_picture(*map, drawn->shading).view());
                      });
}

namespace {

using render::MovieKind;
using render::Quantity;

// How maps are drawn over views; held by the job that writes the movie.
struct Look {
  std::shared_ptr<const Scene> scene;
  std::map<Quantity, DrawnMap> maps;
  std::shared_ptr<const render::ToneTable> tone;

  [[nodiscard]] RgbaImage draw(const MapSource& source) const {
    RgbaImage view = render::shade_view(*scene->light_field, source.view, tone.get());
    if (source.quantity == Quantity::View) return view;
    const DrawnMap& drawn = maps.at(source.quantity);
    return over_view(std::move(view), *make_map(source), drawn.shading, drawn.look);
  }
};

// Falls back to the view alone without a map.
MapSource source_of(const Workbench& bench, const MapChoice& choice) {
  auto source = bench.overlay.sourceOf(choice);
  if (source) return std::move(*source);
  return {.view = bench.session.view(), .light_field = bench.session.light_field()};
}

std::shared_ptr<const Look> look_of(const Workbench& bench, const MovieSubject& subject) {
  auto look = std::make_shared<Look>();
  look->scene = bench.session.scene();
  look->tone = render::table_of(bench.session.place().tone);
  for (const auto* source : {&subject.source, subject.other ? &*subject.other : nullptr}) {
    if (!source || source->quantity == Quantity::View) continue;
    look->maps.try_emplace(source->quantity, drawn_as_shown(bench.overlay, *source));
  }
  return look;
}

bool is_flippable(const Overlay& overlay) {
  return overlay.sourceOf(overlay.choiceA()) && !(overlay.choiceA() == overlay.choiceB());
}

MovieSubject subject_of(const Workbench& bench, MovieKind kind, bool with_overlay) {
  MovieSubject subject;
  const Overlay& overlay = bench.overlay;
  if (kind == MovieKind::Flip) {
    subject.source = source_of(bench, overlay.choiceA());
    subject.other = source_of(bench, overlay.choiceB());
  } else {
    const bool has_map = kind == MovieKind::Parallax && with_overlay;
    subject.source = source_of(bench, has_map ? overlay.choice() : MapChoice{});
  }
  return subject;
}

}  // namespace

MovieExport::MovieExport(const Workbench& bench)
    : QObject(&bench.owner),
      bench_(bench),
      dialog_(named("movie", new QDialog(&bench.window))),
      panel_(new MoviePanel(dialog_)) {
  dialog_->setWindowTitle(tr("Save a movie"));
  auto* layout = make_column(dialog_, {panel_}, {.margins = kStyleMargins});
  layout->setSizeConstraint(QLayout::SetFixedSize);
  connect(panel_, &MoviePanel::saveRequested, this, &MovieExport::ask);
  connect(panel_, &MoviePanel::cancelRequested, dialog_, &QDialog::reject);
  bench.commands.add({.id = "file.save_movie",
                      .menu = Menu::Export,
                      .text = tr("Movie…"),
                      .tip = tr("Parallax, refocusing or flips as MP4, WebM or GIF"),
                      .keys = {tr("Ctrl+Shift+M")},
                      .run = [this] { open(); },
                      .section = section::kPictures,
                      .enabled = [this] { return bench_.session.scene() != nullptr; }});
}

void MovieExport::open() {
  std::set<MovieKind> kinds{MovieKind::Parallax, MovieKind::Refocus};
  if (is_flippable(bench_.overlay)) kinds.insert(MovieKind::Flip);
  panel_->setAvailable(kinds);
  panel_->setOverlayAvailable(bench_.overlay.sourceOf(bench_.overlay.choice()).has_value());
  panel_->setFocusRange(bench_.overlay.shadingOf(Quantity::Disparity).range);
  dialog_->show();
}

void MovieExport::ask() {
  ask_where_to_save(
      bench_,
      {.name = "save_movie_file",
       .title = tr("Save the movie"),
       .filter = tr("MP4 (*.mp4);;WebM (*.webm);;GIF (*.gif)"),
       .proposal = QString::fromStdString(bench_.session.light_field()->info().name) + ".mp4"},
      [this](const QString& path) { save(path); });
}

void MovieExport::save(const QString& path) {
  if (!has_suffix(path, {"mp4", "webm", "gif"}, bench_.messages)) return;
  const render::MovieChoice choice = panel_->choice();
  MovieSubject subject = subject_of(bench_, choice.kind, panel_->showsOverlay());
  const std::shared_ptr<const Look> look = look_of(bench_, subject);
  subject.scene = look->scene.get();
  subject.tone = look->tone.get();
  subject.draw = [look](const MapSource& source) { return look->draw(source); };
  write_in_background(bench_.jobs, bench_.messages, path,
                      [file = std::filesystem::path(path.toStdString()), choice,
                       subject](const Progress& progress) {
                        write_movie(file, make_movie(choice, subject), choice.width_px, progress);
                      });
  dialog_->close();
}

}  // namespace episcope

#include "moc_picture_export.cpp"
#include "picture_export.moc"
