// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/labels/label_json.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/version.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/json.h"
#include "engine/io/base/label_pages.h"
#include "engine/io/models/labels/label_shapes.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kLongestSide = 1 << 16;                        ///< In px.
constexpr std::int64_t kMostPixels = std::int64_t{1} << 29;  ///< Of all pictures of a file.
constexpr const char* kOwn = "episcope";

std::string fault_of(const Json::exception& error) {
  const std::string text = error.what();
  const std::size_t begin = text.find("key '"), end = text.find('\'', begin + 5);
  if (begin == std::string::npos || end == std::string::npos) {
    return "a value is of another kind than it should be";
  }
  return text.substr(begin + 4, end - begin - 3) + " is missing";
}

/// Runs `read`, and says of failures that the file is no file of `form`.
template <class Read>
auto reading(const fs::path& path, const char* form, const Read& read) {
  try {
    return read();
  } catch (const Json::exception& error) {
    throw IoError(path,
                  fmt::format("is no file of {}: {}; export it again", form, fault_of(error)));
  } catch (const InvalidInput& error) {
    throw IoError(path, fmt::format("is no file of {}: {}; export it again", form, error.what()));
  }
}

/// Without labels, of the size that `json` states under these names, else of `shape`.
Image<std::int32_t> empty_map(const Json& json, const char* height, const char* width,
                              const FieldShape& shape) {
  const auto length = [&](const char* name, int usual) {
    const bool is_stated = json.contains(name) && !json[name].is_null();
    if (!is_stated && usual == 0) throw InvalidInput(fmt::format("{} is missing", name));
    return is_stated ? int_of(json[name]) : usual;
  };
  const int rows = length(height, shape.height), columns = length(width, shape.width);
  const bool is_sound = rows > 0 && columns > 0 && rows <= kLongestSide &&
                        columns <= kLongestSide &&
                        static_cast<std::int64_t>(rows) * columns <= kMostPixels;
  if (!is_sound) throw InvalidInput(fmt::format("a picture has {}×{} px", columns, rows));
  return {rows, columns};
}

Polygon corners_of(const Json& points) {
  Polygon corners;
  for (const Json& point : points) {
    corners.push_back({point.at(0).get<double>(), point.at(1).get<double>()});
  }
  return corners;
}

void draw_mask(const fs::path& path, const Json& shape, const Polygon& corners,
               Image<std::int32_t>& map, std::int32_t label) {
  const Image<std::uint8_t> mask =
      decode_mask(path, from_base64(shape.at("mask").get<std::string>()));
  const auto corner = [](double value) { return static_cast<int>(std::clamp(value, -1e6, 1e6)); };
  const int y0 = corner(corners.at(0).y), x0 = corner(corners.at(0).x);
  for (int y = std::max(0, -y0); y < mask.height() && y + y0 < map.height(); ++y) {
    for (int x = std::max(0, -x0); x < mask.width() && x + x0 < map.width(); ++x) {
      if (mask.at(y, x) != 0) map.at(y + y0, x + x0) = label;
    }
  }
}

/// False if labelme knows no such shape.
bool draw_shape(const fs::path& path, const Json& shape, Image<std::int32_t>& map,
                std::int32_t label) {
  constexpr double kRadius = 5;  // px, of labelme's lines and points
  const std::string type = shape.value("shape_type", "polygon");
  const Polygon corners = corners_of(shape.at("points"));
  if (corners.empty()) throw InvalidInput("a shape has no points");
  const Corner& first = corners.front();
  const Corner& last = corners.back();
  if (type == "polygon") {
    fill_polygon(map, corners, label);
  } else if (type == "rectangle") {
    fill_polygon(map, {{first.x, first.y}, {last.x, first.y}, {last.x, last.y}, {first.x, last.y}},
                 label);
  } else if (type == "circle") {
    draw_line(map, {first}, std::hypot(last.x - first.x, last.y - first.y), label);
  } else if (type == "line" || type == "linestrip") {
    draw_line(map, corners, kRadius, label);
  } else if (type == "point") {
    draw_line(map, {first}, kRadius, label);
  } else if (type == "points") {
    for (const Corner& one : corners) draw_line(map, {one}, kRadius, label);
  } else if (type == "mask") {
    draw_mask(path, shape, corners, map, label);
  } else {
    return false;
  }
  return true;
}

Rgb color_of(const Json& json, std::int32_t id) {
  if (!json.is_array() || json.size() != 3) return label_color(id);
  Rgb color{};
  for (std::size_t c = 0; c < color.size(); ++c) {
    color[c] = static_cast<std::uint8_t>(std::clamp(int_of(json[c]), 0, 255));
  }
  return color;
}

Json json_of(const Rgb& color) {
  return Json::array({color[0], color[1], color[2]});
}

}  // namespace

LabelNames::LabelNames(const std::vector<LabelInfo>& known) {
  for (const LabelInfo& label : known) {
    by_name_.emplace(label.name, label);
    names_.emplace(label.id, label.name);
  }
}

void LabelNames::state(const LabelInfo& label, const std::string& name) {
  const auto known = names_.find(label.id);
  const bool is_other = known != names_.end() && known->second != label.name;
  if (label.id < 1 || by_name_.contains(name) || is_other) return;
  by_name_.emplace(name, label);
  names_.emplace(label.id, label.name);
}

std::int32_t LabelNames::id_of(const std::string& name) {
  auto known = by_name_.find(name);
  if (known == by_name_.end()) {
    std::int32_t id = 1;
    while (names_.contains(id)) ++id;
    known = by_name_.emplace(name, LabelInfo{id, name, label_color(id)}).first;
    names_.emplace(id, name);
  }
  if (std::ranges::find(used_, known->second.id, &LabelInfo::id) == used_.end()) {
    used_.push_back(known->second);
  }
  return known->second.id;
}

std::vector<LabelInfo> LabelNames::labels() const {
  std::vector<LabelInfo> labels = used_;
  std::ranges::sort(labels, {}, &LabelInfo::id);
  return labels;
}

namespace {

/// What labelme leaves unlabeled in the labels that it writes for VOC.
bool is_unlabeled(const std::string& name) {
  return name == "__ignore__" || name == "_background_";
}

JsonPicture labelme_of(const fs::path& path, const Json& json, const FieldShape& shape,
                       LabelNames& names) {
  if (json.contains(kOwn)) {
    for (const Json& label : json.at(kOwn).at("labels")) {
      const std::int32_t id = int_of(label.at("id"));
      const auto name = label.at("name").get<std::string>();
      names.state({id, label.value("label", name), color_of(label.at("color"), id)}, name);
    }
  }
  JsonPicture picture{json.value("imagePath", ""),
                      empty_map(json, "imageHeight", "imageWidth", shape)};
  std::map<std::string, std::int32_t> drawn;
  for (const Json& one : json.at("shapes")) {
    const auto name = one.at("label").get<std::string>();
    const std::int32_t id = is_unlabeled(name) ? 0 : names.id_of(name);
    if (!draw_shape(path, one, picture.labels, id)) {
      picture.unknown.insert(one.at("shape_type").get<std::string>());
    } else if (id != 0) {
      drawn[name] = id;
    }
  }
  for (const auto& [name, id] : drawn) {
    if (std::ranges::find(picture.labels, id) == picture.labels.end()) {
      picture.unseen.push_back(name);
    }
  }
  return picture;
}

/// False if there is neither an outline nor a mask.
bool draw_segmentation(const Json& segmentation, Image<std::int32_t>& map, std::int32_t label) {
  if (segmentation.is_object()) {
    const Json& size = segmentation.at("size");
    if (int_of(size.at(0)) != map.height() || int_of(size.at(1)) != map.width()) {
      throw InvalidInput("a mask has another size than its picture");
    }
    const Json& counts = segmentation.at("counts");
    const Runs runs = counts.is_string() ? unpacked_runs(counts.get<std::string>())
                                         : counts.get<std::vector<std::uint32_t>>();
    fill_runs(map, runs, label);
    return true;
  }
  for (const Json& flat : segmentation) {
    Polygon polygon;
    for (std::size_t i = 0; i + 1 < flat.size(); i += 2) {
      polygon.push_back({flat[i].get<double>(), flat[i + 1].get<double>()});
    }
    fill_polygon(map, polygon, label);
  }
  return !segmentation.empty();
}

/// Id of a picture or a category, which other programs write as number or text.
std::string key_of(const Json& id) {
  return id.is_string() ? id.get<std::string>() : json_text(id);
}

/// As listed, else those of the annotations.
Json categories_in(const Json& json) {
  if (json.contains("categories")) return json["categories"];
  Json categories = Json::array();
  for (const Json& annotation : json.at("annotations")) {
    Json category{{"id", annotation.at("category_id")}};
    if (std::ranges::find(categories, category) == categories.end()) {
      categories.push_back(std::move(category));
    }
  }
  return categories;
}

std::vector<LabelInfo> categories_of(const Json& categories, std::vector<std::string>& notes) {
  std::vector<LabelInfo> labels;
  for (const Json& category : categories) {
    LabelInfo label{int_of(category.at("id")), category.value("name", ""), {}};
    label.color =
        category.contains("color") ? color_of(category["color"], label.id) : label_color(label.id);
    labels.push_back(std::move(label));
  }
  const bool has_zero = std::ranges::find(labels, 0, &LabelInfo::id) != labels.end();
  if (has_zero) notes.emplace_back(finding_text("labels.raised_coco"));
  for (LabelInfo& label : labels) {
    if (has_zero) ++label.id;
    if (label.name.empty()) label.name = "label " + std::to_string(label.id);
  }
  return labels;
}

CocoLabels coco_of(const Json& json, const FieldShape& shape) {
  CocoLabels coco;
  const Json categories = categories_in(json);
  coco.labels = categories_of(categories, coco.notes);
  std::map<std::string, std::int32_t> ids;
  for (std::size_t i = 0; i < coco.labels.size(); ++i) {
    ids[key_of(categories[i].at("id"))] = coco.labels[i].id;
  }
  std::map<std::string, std::size_t> places;
  std::int64_t pixels = 0;
  for (const Json& image : json.at("images")) {
    Image<std::int32_t> map = empty_map(image, "height", "width", shape);
    pixels += static_cast<std::int64_t>(map.size());
    if (pixels > kMostPixels) throw InvalidInput("its pictures are too large");
    places[key_of(image.at("id"))] = coco.pictures.size();
    coco.pictures.push_back({image.value("file_name", ""), std::move(map)});
  }
  int without = 0;
  for (const Json& annotation : json.at("annotations")) {
    const auto place = places.find(key_of(annotation.at("image_id")));
    const auto id = ids.find(key_of(annotation.at("category_id")));
    if (place == places.end() || id == ids.end()) {
      throw InvalidInput("an annotation names a picture or a category that is not there");
    }
    const bool is_drawn = annotation.contains("segmentation") &&
                          draw_segmentation(annotation["segmentation"],
                                            coco.pictures[place->second].labels, id->second);
    if (!is_drawn) ++without;
  }
  if (without > 0) {
    coco.notes.push_back(fmt::format("{} annotations have no outline and are left out", without));
  }
  return coco;
}

}  // namespace

LabelJson read_label_json(const fs::path& path, LabelNames& names, const FieldShape& shape) {
  const Json json = reading(path, "labels", [&] { return read_json<Json>(path); });
  if (json.is_array() && !json.empty() && json[0].is_object() && json[0].contains("image_id")) {
    throw IoError(path,
                  "lists results of COCO without their pictures; add them to the file of "
                  "annotations, which has `images`, as its `annotations`");
  }
  if (!json.is_object()) return {};
  if (json.contains("shapes")) {
    return reading(path, "labelme", [&] { return labelme_of(path, json, shape, names); });
  }
  const bool is_coco = json.contains("images") && json.contains("annotations");
  if (!is_coco) return {};
  return reading(path, "COCO", [&] { return coco_of(json, shape); });
}

namespace {

Json shape_of(const LabelRegion& region, const std::string& name) {
  Json points = Json::array();
  const PixelRect& box = region.box;
  if (region.has_holes) {
    points = {{box.x0, box.y0}, {box.x1 - 1, box.y1 - 1}};
  } else {
    for (const Corner& corner : region.outline) points.push_back({corner.x, corner.y});
  }
  Json shape{{"label", name},
             {"points", std::move(points)},
             {"group_id", nullptr},
             {"description", ""},
             {"shape_type", region.has_holes ? "mask" : "polygon"},
             {"flags", Json::object()},
             {"mask", nullptr}};
  if (!region.has_holes) return shape;
  Image<std::uint8_t> mask(box.y1 - box.y0, box.x1 - box.x0);
  for (const auto [y, x] : region.pixels) mask.at(y - box.y0, x - box.x0) = 255;
  const std::vector<std::uint8_t> png = encode_mask(mask.view());
  shape["mask"] = to_base64({png.begin(), png.end()});
  return shape;
}

std::string text_of(const Json& json) {
  return json_text(json);
}

}  // namespace

std::vector<std::string> distinct_names(const std::vector<LabelInfo>& infos) {
  std::set<std::string> used;
  for (const LabelInfo& label : infos) used.insert(label.name);
  std::set<std::string> given;
  std::vector<std::string> names;
  for (const LabelInfo& label : infos) {
    std::string name = label.name;
    const bool is_free = !is_unlabeled(name) && given.insert(name).second;
    if (!is_free) {
      do {
        name += fmt::format("_{}", label.id);
      } while (!used.insert(name).second);
    }
    names.push_back(std::move(name));
  }
  return names;
}

void write_labelme(const fs::path& path, const std::string& picture,
                   ImageView<const std::int32_t> labels, const std::vector<LabelInfo>& infos) {
  const std::vector<std::string> distinct = distinct_names(infos);
  std::map<std::int32_t, std::string> names;
  Json own = Json::array();
  for (std::size_t i = 0; i < infos.size(); ++i) {
    const LabelInfo& label = infos[i];
    names[label.id] = distinct[i];
    own.push_back({{"id", label.id}, {"name", distinct[i]}, {"color", json_of(label.color)}});
    if (distinct[i] != label.name) own.back()["label"] = label.name;
  }
  Json shapes = Json::array();
  for (const LabelRegion& region : regions_of(labels)) {
    shapes.push_back(shape_of(region, names.at(region.label)));
  }
  const Json json{{"version", "5.5.0"},          {"flags", Json::object()},
                  {"shapes", std::move(shapes)}, {"imagePath", picture},
                  {"imageData", nullptr},        {"imageHeight", labels.height},
                  {"imageWidth", labels.width},  {kOwn, {{"labels", std::move(own)}}}};
  write_atomically(path, text_of(json));
}

void CocoFile::add(const std::string& file_name, ImageView<const std::int32_t> labels) {
  const Json image{{"id", ++image_count_},
                   {"width", labels.width},
                   {"height", labels.height},
                   {"file_name", file_name}};
  images_ += (images_.empty() ? "" : ",\n") + text_of(image);
  std::map<std::int32_t, std::pair<PixelRect, std::int64_t>> found;
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      if (labels.at(y, x) <= 0) continue;
      auto& [box, pixels] = found[labels.at(y, x)];
      box.include({y, x, y + 1, x + 1});
      ++pixels;
    }
  }
  for (const auto& [id, region] : found) {
    const auto& [box, pixels] = region;
    const Json annotation{
        {"id", ++annotation_count_},
        {"image_id", image_count_},
        {"category_id", id},
        {"segmentation",
         {{"size", {labels.height, labels.width}}, {"counts", packed_runs(runs_of(labels, id))}}},
        {"area", pixels},
        {"bbox", {box.x0, box.y0, box.x1 - box.x0, box.y1 - box.y0}},
        {"iscrowd", 0}};
    annotations_ += (annotations_.empty() ? "" : ",\n") + text_of(annotation);
  }
}

void CocoFile::write(const fs::path& path) const {
  Json categories = Json::array();
  for (const LabelInfo& label : labels_) {
    categories.push_back({{"id", label.id},
                          {"name", label.name},
                          {"supercategory", ""},
                          {"color", json_of(label.color)}});
  }
  const Json info{
      {"description", std::string("Labels of light-field views, Episcope ") + kVersion}};
  write_atomically(path, "{\"info\": " + text_of(info) + ",\n\"licenses\": [],\n\"images\": [\n" +
                             images_ + "\n],\n\"annotations\": [\n" + annotations_ +
                             "\n],\n\"categories\": " + text_of(categories) + "}\n");
}

}  // namespace episcope::io
