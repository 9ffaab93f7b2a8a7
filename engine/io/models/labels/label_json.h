// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/scene.h"
#include "engine/io/models/stored_maps.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace episcope::io {

/// Labels of one picture, as they stand in a JSON file.
struct JsonPicture {
  std::string file_name;  ///< Of the picture; may be empty.
  Image<std::int32_t> labels;
  std::vector<std::string> unseen{};  ///< Names of shapes that no pixel belongs to.
  std::set<std::string> unknown{};    ///< Types of shapes that are not read.
};

/// Ids of labels that files know by name: of `known` labels, else free ones in the order in which
/// names appear.
class LabelNames {
 public:
  explicit LabelNames(const std::vector<LabelInfo>& known);
  /// Takes the id of a label that a file calls `name`; ignored if either is in use.
  void state(const LabelInfo& label, const std::string& name);
  [[nodiscard]] std::int32_t id_of(const std::string& name);
  /// Of the names that were asked for or stated.
  [[nodiscard]] std::vector<LabelInfo> labels() const;

 private:
  std::map<std::string, LabelInfo> by_name_;
  std::map<std::int32_t, std::string> names_;
  std::vector<LabelInfo> used_;
};

/// Pictures of a COCO file, with the ids of its categories.
struct CocoLabels {
  std::vector<JsonPicture> pictures;
  std::vector<LabelInfo> labels;
  std::vector<std::string> notes;  ///< On annotations without an outline, as sentences.
};

/// Reads a JSON file of labels; nothing for other JSON. Throws IoError for what is no JSON, and for
/// unsound content.
///
/// Of labelme: polygons, rectangles, circles, masks; lines are 10 px wide and points discs of
/// 10 px, as labelme draws them. Later shapes cover earlier ones. A pixel belongs to a shape if its
/// center lies inside.
///
/// Of object detection by COCO: polygons, and runs as numbers or packed. Later annotations cover
/// earlier ones; ids of categories are raised by one if one of them is 0.
/// Pictures without a size have that of the views of `shape`, and categories that are not listed
/// are named after their ids. What labelme calls `__ignore__` or `_background_` is unlabeled.
using LabelJson = std::variant<std::monostate, JsonPicture, CocoLabels>;
[[nodiscard]] LabelJson read_label_json(const std::filesystem::path& path, LabelNames& names,
                                        const FieldShape& shape = {});

/// Names of labels by which labelme can tell them apart: of labels of one name, and of names that
/// mean unlabeled there, all but the first have their id behind it.
[[nodiscard]] std::vector<std::string> distinct_names(const std::vector<LabelInfo>& infos);

/// Writes a file of labelme for one picture, with a polygon for each region, or a mask if it has
/// holes; ids and colors stand under `episcope`, which labelme keeps. Shapes have the
/// `distinct_names`. Atomic. Throws IoError.
void write_labelme(const std::filesystem::path& path, const std::string& picture,
                   ImageView<const std::int32_t> labels, const std::vector<LabelInfo>& infos);

/// A COCO file that is being made.
class CocoFile {
 public:
  explicit CocoFile(const std::vector<LabelInfo>& labels) : labels_(labels) {}
  /// Adds a picture with an annotation, in packed runs, for each label in it.
  void add(const std::string& file_name, ImageView<const std::int32_t> labels);
  /// Atomic. Throws IoError.
  void write(const std::filesystem::path& path) const;

 private:
  std::vector<LabelInfo> labels_;
  std::string images_;
  std::string annotations_;
  int image_count_ = 0;
  int annotation_count_ = 0;
};

}  // namespace episcope::io
