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
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/picture.h"

#include <QCoreApplication>

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

namespace episcope {
namespace {

struct PictureExportText {
  Q_DECLARE_TR_FUNCTIONS(episcope::PictureExport)
};

struct DrawnMap {
  MapSource source;
  render::Shading shading;
};

// The overlay's map; none without an overlay.
std::optional<DrawnMap> drawn_map(const Overlay& overlay) {
  const MapChoice choice = overlay.choice();
  auto source = overlay.sourceOf(choice);
  if (!source) return std::nullopt;
  return DrawnMap{std::move(*source), overlay.shadingOf(choice.quantity)};
}

QString scene_name(const Session& session) {
  return QString::fromStdString(session.light_field()->info().name);
}

void ask_for_picture(const Workbench& bench) {
  ask_where_to_save(&bench.window,
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
  ask_where_to_save(&bench.window,
                    {.name = "save_map",
                     .title = PictureExportText::tr("Save the map"),
                     .filter = PictureExportText::tr("PNG (*.png)"),
                     .proposal = scene_name(bench.session) + '_' + quantity + ".png"},
                    [bench](const QString& path) { save_map_picture(bench, path); });
}

}  // namespace

void add_picture_export(const Workbench& bench) {
  const auto has_scene = [&session = bench.session] { return session.scene() != nullptr; };
  bench.commands.add({.id = "file.save_picture",
                      .menu = Menu::File,
                      .text = PictureExportText::tr("Save picture…"),
                      .tip = PictureExportText::tr(
                          "Saves the view as it is shown, with its brightness and overlay, as PNG"),
                      .icon = "save",
                      .keys = {PictureExportText::tr("Ctrl+Shift+E")},
                      .run = [bench] { ask_for_picture(bench); },
                      .section = section::kExport,
                      .enabled = has_scene});
  bench.commands.add({.id = "file.save_map",
                      .menu = Menu::File,
                      .text = PictureExportText::tr("Save map…"),
                      .tip = PictureExportText::tr("Saves the map drawn over the view as PNG"),
                      .run = [bench] { ask_for_map(bench); },
                      .section = section::kExport,
                      .enabled = has_scene});
}

void save_picture(const Workbench& bench, const QString& path) {
  auto picture = std::make_shared<RgbaImage>(to_picture(bench.viewer_area.canvas()->picture()));
  if (picture->empty() || !has_suffix(path, {"png"}, bench.messages)) return;
  write_in_background(
      bench.jobs, bench.messages, path,
      [file = std::filesystem::path(path.toStdString()), picture, drawn = drawn_map(bench.overlay),
       opacity = bench.viewer_area.canvas()->overlayOpacity()](const Progress&) {
        if (!drawn) return io::write_picture(file, picture->view());
        const RgbaImage over = overlay_picture(*make_map(drawn->source), drawn->shading);
        io::write_picture(file, blended(*picture, over, opacity).view());
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

}  // namespace episcope
