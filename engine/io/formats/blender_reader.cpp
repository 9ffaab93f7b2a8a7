// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/blender_reader.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/io/base/files.h"
#include "engine/io/base/json.h"
#include "engine/io/base/npy.h"
#include "engine/io/formats/image_grid.h"
#include "engine/io/models/assemble_scene.h"
#include "engine/io/models/load_views.h"
#include "engine/io/models/open_options.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <utility>

namespace episcope::io {
namespace {

/// The views at most `radius` rows and columns from the center.
ViewCrop around_center(GridShape stored, int radius) {
  const ViewIndex center = stored.center();
  const ViewIndex first{std::max(0, center.v - radius), std::max(0, center.u - radius)};
  const ViewIndex last{std::min(stored.v - 1, center.v + radius),
                       std::min(stored.u - 1, center.u + radius)};
  return {stored, first, {last.v - first.v + 1, last.u - first.u + 1}};
}

/// The largest grid around the center whose views are all complete: the add-on renders rings around
/// the center one after another. Throws IoError if not even the center is complete.
ViewCrop complete_crop(const RenderManifest& manifest) {
  const GridShape grid = manifest.grid;
  std::vector<std::uint8_t> is_complete(static_cast<std::size_t>(grid.count()), 0);
  for (const ViewIndex view : manifest.complete) {
    is_complete[static_cast<std::size_t>(view.v) * grid.u + view.u] = 1;
  }
  const auto is_whole = [&](const ViewCrop& crop) {
    for (int i = 0; i < crop.kept.count(); ++i) {
      const ViewIndex view = crop.kept.view_at(i, crop.first);
      if (is_complete[static_cast<std::size_t>(view.v) * grid.u + view.u] == 0) return false;
    }
    return true;
  };
  if (!is_whole(around_center(grid, 0))) {
    throw IoError(manifest.folder,
                  "no view is rendered yet: the center comes first; open the folder again later, "
                  "or start the rendering anew if it was stopped");
  }
  int radius = 0;
  while (radius < std::max(grid.v, grid.u) && is_whole(around_center(grid, radius + 1))) ++radius;
  return around_center(grid, radius);
}

/// "31 of 81 views are rendered so far; …", for the report; empty if all are.
std::string progress_text(const RenderManifest& manifest, const ViewCrop& crop) {
  if (!crop.leaves_out()) return {};
  return fmt::format(finding_text("render.part"), manifest.complete.size(), manifest.grid.count(),
                     crop.kept.v, crop.kept.u);
}

namespace fs = std::filesystem;

template <class T>
Image<T> of_size(const fs::path& path, const RenderManifest& manifest, Image<T> map) {
  if (map.height() == manifest.height && map.width() == manifest.width) return map;
  throw IoError(path, fmt::format("this map has {}×{} px, but the views have {}×{} px; render the "
                                  "folder anew",
                                  map.width(), map.height(), manifest.width, manifest.height));
}

Image<float> read_depth(const RenderManifest& manifest, const char* part, ViewIndex stored) {
  const fs::path path = manifest.file(part, stored);
  return of_size(path, manifest, read_npy_map(path));
}

/// Where a part of the views is stored, and where it goes.
struct Block {
  GridShape grid;
  ViewIndex first;   ///< Of the stack.
  ViewIndex stored;  ///< The same view in the folder.

  [[nodiscard]] ViewIndex stored_at(ViewIndex view) const {
    return {view.v - first.v + stored.v, view.u - first.u + stored.u};
  }
};

Block block_of(const ViewCrop& crop, MapViews views) {
  if (views == MapViews::All) return {crop.kept, {}, crop.first};
  const ViewIndex center = crop.kept.center();
  return {{1, 1}, center, {crop.first.v + center.v, crop.first.u + center.u}};
}

DisparityField empty_field(const RenderManifest& manifest, const Block& block) {
  return {ViewStack<float>(block.grid, manifest.height, manifest.width, 1, block.first),
          ViewStack<std::uint8_t>(block.grid, manifest.height, manifest.width, 1, block.first)};
}

/// Disparity of a depth map where `is_there(pixel)`; invalid elsewhere, and where there is no
/// surface.
template <class IsThere>
void store(const CameraGrid& camera, const Image<float>& depth, ViewIndex view,
           DisparityField& field, const IsThere& is_there) {
  float* disparity = field.disparity.view(view).data;
  std::uint8_t* valid = field.valid.view(view).data;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const auto d = static_cast<float>(camera.disparity_from_depth(depth.data()[i]));
    valid[i] = is_there(i) && std::isfinite(d) ? 1 : 0;
    disparity[i] = std::isfinite(d) ? d : 0;
  }
}

void read_view(const RenderManifest& manifest, const Block& block, ViewIndex view,
               GroundTruth& truth) {
  const ViewIndex stored = block.stored_at(view);
  const Image<float> front = read_depth(manifest, "depth", stored);
  if (truth.foreground.empty()) {
    store(manifest.camera, front, view, truth.field, [](std::size_t) { return true; });
    return;
  }
  // NaN: there is no transparent surface; infinite: there is nothing behind it.
  const Image<float> behind = read_depth(manifest, "depth_behind", stored);
  const auto is_layered = [&](std::size_t i) { return !std::isnan(behind.data()[i]); };
  store(manifest.camera, front, view, truth.field, [&](std::size_t i) { return !is_layered(i); });
  store(manifest.camera, front, view, truth.foreground, is_layered);
  store(manifest.camera, behind, view, truth.background, is_layered);
}

void read_labels(const RenderManifest& manifest, const Block& block, ViewIndex view,
                 GroundTruth& truth) {
  const fs::path path = manifest.file("labels", block.stored_at(view));
  const Image<std::int32_t> labels = of_size(path, manifest, read_npy_labels(path));
  std::copy_n(labels.data(), labels.size(), truth.labels.view(view).data);
}

/// Disparity, layers and labels of the views of `crop`, or with MapViews::Center the disparity of
/// the center view alone. Pixels in which a transparent surface is seen before another have layers
/// and no one disparity. Throws IoError for maps that are missing or of another size; Cancelled.
GroundTruth read_render_truth(const RenderManifest& manifest, const ViewCrop& crop, MapViews views,
                              bool needs_labels, const Progress& progress) {
  const Block block = block_of(crop, views);
  GroundTruth truth;
  const bool has_depth = manifest.has("depth");
  const bool has_labels = needs_labels && manifest.has("labels");
  if (has_depth) truth.field = empty_field(manifest, block);
  if (has_depth && manifest.has("depth_behind")) {
    truth.foreground = empty_field(manifest, block);
    truth.background = empty_field(manifest, block);
  }
  if (has_labels) {
    truth.labels =
        ViewStack<std::int32_t>(block.grid, manifest.height, manifest.width, 1, block.first);
  }
  parallel_for(block.grid.count(), progress, [&](int i) {
    const ViewIndex view = block.grid.view_at(i, block.first);
    if (has_depth) read_view(manifest, block, view, truth);
    if (has_labels) read_labels(manifest, block, view, truth);
  });
  return truth;
}

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

FileUsage account_of(const RenderManifest& manifest, const ViewCrop& crop, bool needs_truth) {
  FileUsage account(manifest.folder);
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
  LoadedViews loaded = load_views(
      views,
      [&](const Image<std::uint8_t>& center) {
        if (options.on_center_view) options.on_center_view(center, info, views.grid);
      },
      progress.part(0, 0.5));
  require_size(manifest, loaded.samples);
  progress.step("reading ground truth");
  SceneParts parts;
  parts.truth = read_render_truth(manifest, crop, options.map_views(), options.needs_truth,
                                  progress.part(0.5, 0.8));
  parts.samples = std::move(loaded.samples);
  parts.valid = std::move(loaded.valid);
  parts.info = std::move(info);
  parts.expected = {{}, "the add-on renders views in canonical order", true};
  parts.files = account_of(manifest, crop, options.needs_truth).uses();
  if (options.needs_truth) scene.scribbles.labels = manifest.labels;
  assemble(std::move(parts), options, scene, progress.part(0.8, 1));
  return scene;
}

/// The folder itself, or the folder of its manifest or of one of its views.
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

constexpr const char* kBlenderOptions[] = {"flip", "crop"};

}  // namespace

Reader blender_reader() {
  return {.id = kReader,
          .name = "a light field rendered by the Blender add-on",
          .options = kBlenderOptions,
          .find = find_blender,
          .read = read_blender,
          .probe = probe_blender};
}

namespace {

using Json = nlohmann::json;

constexpr const char* kFormat = "episcope light field";
constexpr int kManifestVersion = 1;
constexpr int kMostRenderedViews = 999;  ///< A side.

IoError problem(const fs::path& file, const std::string& what) {
  return {file, what + "; render the folder anew"};
}

/// "{row:02}" and "{column:02}" become the numbers of the view.
void replace(std::string& pattern, const std::string& field, int number) {
  const auto at = pattern.find(field);
  if (at != std::string::npos) pattern.replace(at, field.size(), fmt::format("{:02}", number));
}

/// Whether a path from the folder stays in it, also where its folders are links.
bool is_inside(const fs::path& folder, const fs::path& path) {
  if (path.is_absolute() || path.string().find("..") != std::string::npos) return false;
  return is_inside_folder(folder / path.parent_path(), folder);
}

void require_fields(const fs::path& file, const std::map<std::string, std::string>& patterns) {
  if (!patterns.contains("views")) throw problem(file, "the manifest names no files of views");
  for (const auto& [part, pattern] : patterns) {
    const bool has_numbers = pattern.find("{row:02}") != std::string::npos &&
                             pattern.find("{column:02}") != std::string::npos;
    if (has_numbers && is_inside(file.parent_path(), pattern)) continue;
    throw problem(file, "the names '" + pattern + "' of " + part +
                            " must lie in the folder and hold {row:02} and {column:02}");
  }
}

void require_sizes(const fs::path& file, const RenderManifest& manifest) {
  const GridShape grid = manifest.grid;
  const bool is_grid =
      grid.v > 0 && grid.u > 0 && grid.v <= kMostRenderedViews && grid.u <= kMostRenderedViews;
  if (!is_grid || manifest.height < 1 || manifest.width < 1) {
    throw problem(file, fmt::format("the manifest states {}×{} views of {}×{} px", grid.v, grid.u,
                                    manifest.width, manifest.height));
  }
  for (const ViewIndex view : manifest.complete) {
    if (!grid.contains(view)) {
      throw problem(file, fmt::format("the complete view {} is outside the grid of {}×{} views",
                                      view_text(view), grid.v, grid.u));
    }
  }
}

CameraGrid read_camera(const Json& json, int width) {
  BlenderCamera camera;
  camera.camera_distance_step = json.at("baseline").get<double>();
  camera.field_of_view = 2 * std::atan(width / (2 * json.at("focal_length_px").get<double>()));
  camera.origin_distance = json.at("zero_plane").get<double>();
  camera.width = width;
  return camera_grid_from_blender(camera);
}

/// By id, each once; names in one line.
std::vector<LabelInfo> read_labels(const Json& json) {
  std::map<int, LabelInfo> labels;
  for (const Json& label : json) {
    const int id = int_of(label.at("value"));
    auto name = label.at("name").get<std::string>();
    std::ranges::replace_if(
        name, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    if (id > 0) labels.try_emplace(id, LabelInfo{id, std::move(name), label_color(id)});
  }
  std::vector<LabelInfo> list;
  for (auto& [id, label] : labels) list.push_back(std::move(label));
  return list;
}

RenderManifest parse(const fs::path& folder, const Json& json) {
  RenderManifest manifest;
  manifest.folder = folder;
  if (int_of(json.at("version")) > kManifestVersion) {
    throw IoError(folder / kRenderManifest,
                  "the manifest was written by a newer add-on; use a newer version of Episcope");
  }
  manifest.blender = json.value("blender", "");
  manifest.grid = {int_of(json.at("grid").at("rows")), int_of(json.at("grid").at("columns"))};
  manifest.width = int_of(json.at("size").at("width"));
  manifest.height = int_of(json.at("size").at("height"));
  manifest.camera = read_camera(json.at("camera"), manifest.width);
  if (const auto range = json.find("disparity_range"); range != json.end()) {
    const Interval stated{range->at(0).get<double>(), range->at(1).get<double>()};
    if (stated.min < stated.max) manifest.disparity_range = stated;
  }
  manifest.files = json.at("files").get<std::map<std::string, std::string>>();
  if (json.contains("labels")) manifest.labels = read_labels(json.at("labels"));
  for (const Json& view : json.at("complete")) {
    manifest.complete.push_back({int_of(view.at(0)), int_of(view.at(1))});
  }
  return manifest;
}

}  // namespace

fs::path RenderManifest::file(const std::string& part, ViewIndex view) const {
  std::string name = files.at(part);
  replace(name, "{row:02}", view.v);
  replace(name, "{column:02}", view.u);
  return folder / name;
}

bool has_render_manifest(const fs::path& folder) {
  std::ifstream file(folder / kRenderManifest, std::ios::binary);
  std::string beginning(1024, '\0');
  file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(file.gcount()));
  return beginning.find(fmt::format("\"{}\"", kFormat)) != std::string::npos;
}

RenderManifest read_render_manifest(const fs::path& folder) {
  const fs::path path = folder / kRenderManifest;
  try {
    RenderManifest manifest = parse(folder, read_json<Json>(path));
    require_fields(path, manifest.files);
    require_sizes(path, manifest);
    return manifest;
  } catch (const Json::exception& error) {
    throw problem(path, fmt::format("the manifest is damaged ({})", error.what()));
  } catch (const InvalidInput& error) {
    throw problem(path, error.what());
  }
}

}  // namespace episcope::io
