// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/blender/blender_reader.h"

#include "engine/core/error.h"
#include "engine/io/blender/complete_views.h"
#include "engine/io/blender/render_manifest.h"
#include "engine/io/blender/render_truth.h"
#include "engine/io/grid/decode_image.h"
#include "engine/io/grid/image_grid_probe.h"
#include "engine/io/grid/load_views.h"
#include "engine/io/open/assemble_scene.h"
#include "engine/io/open/folder_account.h"
#include "engine/io/open/scene_folder.h"
#include "engine/io/open/scene_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReader = "blender";

/// What the parts of a manifest are called in the account of the files.
const char* kind_of(const std::string& part) {
  if (part == "views") return "views";
  if (part == "depth") return "depth maps";
  if (part == "depth_behind") return "depth maps behind transparent surfaces";
  if (part == "labels") return "label maps";
  return nullptr;
}

/// Of views that are complete; throws if one of them was removed.
ViewFiles files_of(const RenderManifest& manifest, const ViewCrop& crop) {
  ViewFiles views{crop.kept, {}};
  for (int i = 0; i < crop.kept.count(); ++i) {
    views.files.push_back(manifest.file("views", crop.kept.view_at(i, crop.first)));
    if (is_there(views.files.back())) continue;
    throw IoError(views.files.back(),
                  fmt::format("{} says that this view is complete, but it is missing; render the "
                              "folder again",
                              kRenderManifest));
  }
  return views;
}

FolderAccount account_of(const RenderManifest& manifest, const ViewCrop& crop, bool needs_truth) {
  FolderAccount account(manifest.folder);
  account.use(manifest.folder / kRenderManifest, "manifests");
  for (const auto& [part, pattern] : manifest.files) {
    account.add_folder((manifest.folder / pattern).parent_path());
    const char* kind = kind_of(part);
    if (kind == nullptr || (part != "views" && !needs_truth)) continue;
    for (int i = 0; i < crop.kept.count(); ++i) {
      account.use(manifest.file(part, crop.kept.view_at(i, crop.first)), kind);
    }
    for (const ViewIndex view : manifest.complete) {
      account.leave_out({manifest.file(part, view)},
                        std::string(kind) + " of a ring of views that is not complete yet");
    }
  }
  return account;
}

bool is_linear(const RenderManifest& manifest) {
  return manifest.files.at("views").ends_with(".exr");
}

std::string format_of(const RenderManifest& manifest) {
  std::string format = "Blender light field";
  if (!manifest.blender.empty()) format += " (rendered by Blender " + manifest.blender + ")";
  return is_linear(manifest) ? format + ", linear float samples" : format;
}

void require_size(const RenderManifest& manifest, const LightField::Samples& samples) {
  std::visit(
      [&](const auto& stack) {
        if (stack.height() == manifest.height && stack.width() == manifest.width) return;
        throw IoError(manifest.folder,
                      fmt::format("the views have {}×{} px, but {} states {}×{} px; render the "
                                  "folder anew",
                                  stack.width(), stack.height(), kRenderManifest, manifest.width,
                                  manifest.height));
      },
      samples);
}

Scene read_blender(const fs::path& folder, const OpenOptions& options, const Progress& progress) {
  const RenderManifest manifest = read_render_manifest(folder);
  const ViewCrop crop = complete_crop(manifest);
  const ViewFiles views = files_of(manifest, crop);
  Scene scene;
  ConventionReport& report = scene.convention;
  report.format = format_of(manifest);
  report.units = manifest.has("depth")
                     ? "disparity from depth and the camera of the manifest, eq. 2"
                     : "no depth was rendered";
  if (std::string text = progress_text(manifest, crop); !text.empty()) {
    report.warnings.push_back(std::move(text));
  }
  LightFieldInfo info{scene_name(folder),
                      folder.string(),
                      manifest.camera,
                      manifest.disparity_range,
                      {.reader = kReader, .options = {}}};
  progress.step("reading views");
  LightField::Samples samples = load_views(
      views,
      [&](const Image<std::uint8_t>& center) {
        if (options.on_center_view) options.on_center_view(center, info, views.grid);
      },
      progress.part(0, 0.6));
  require_size(manifest, samples);
  progress.step("reading truth");
  SceneParts parts;
  parts.truth = read_render_truth(manifest, crop, options.map_views(), options.needs_truth,
                                  progress.part(0.6, 0.9));
  parts.samples = std::move(samples);
  parts.info = std::move(info);
  parts.expected = {{}, "the add-on renders views in canonical order", true};
  parts.files = account_of(manifest, crop, options.needs_truth).uses();
  if (options.needs_truth) scene.scribbles.labels = manifest.labels;
  assemble(std::move(parts), options, scene, progress);
  return scene;
}

/// The folder itself, that of its manifest, or that of one of its views.
fs::path find_blender(const fs::path& path, const OpenOptions& options) {
  if (wants_image_grid(options)) return {};
  if (fs::is_directory(path)) return has_render_manifest(path) ? path : fs::path();
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (path.filename() == kRenderManifest) return has_render_manifest(folder) ? folder : fs::path();
  if (!is_image_name(path)) return {};
  const fs::path around = fs::absolute(folder).lexically_normal().parent_path();
  return has_render_manifest(around) ? around : fs::path();
}

SceneProbe probe_blender(const fs::path& folder, const OpenOptions&) {
  const RenderManifest manifest = read_render_manifest(folder);
  SceneProbe probe = probe_views(files_of(manifest, complete_crop(manifest)));
  if (manifest.has("depth")) probe.truth = "depth of all views";
  if (manifest.has("depth_behind")) probe.truth += " in two layers";
  if (manifest.has("labels")) probe.labels = "labels of all views";
  return probe;
}

constexpr const char* kOptions[] = {"flip", "crop"};

}  // namespace

Reader blender_reader() {
  return {.id = kReader,
          .name = "a light field rendered by the Blender add-on",
          .options = kOptions,
          .find = find_blender,
          .read = read_blender,
          .probe = probe_blender};
}

}  // namespace episcope::io
