// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/blender/render_manifest.h"

#include "engine/core/error.h"
#include "engine/io/durable/leads_into.h"
#include "engine/io/json/bounded_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kFormat = "episcope light field";
constexpr int kVersion = 1;
constexpr int kMostViews = 999;  ///< A side.

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
  return leads_into(folder / path.parent_path(), folder);
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
  const bool is_grid = grid.v > 0 && grid.u > 0 && grid.v <= kMostViews && grid.u <= kMostViews;
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
  if (int_of(json.at("version")) > kVersion) {
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
