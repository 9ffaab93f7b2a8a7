// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/labels/label_export.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/text.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/label_pages.h"
#include "engine/io/models/labels/color_table.h"
#include "engine/io/models/labels/label_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace episcope::io {

Names<LabelForm> names_of(LabelForm) {
  return {{LabelForm::Indexed, "labels", "PNG with a palette"},
          {LabelForm::Voc, "voc", "PASCAL VOC"},
          {LabelForm::Coco, "coco", "COCO"},
          {LabelForm::Labelme, "labelme", "labelme"}};
}

namespace {

namespace fs = std::filesystem;

constexpr std::int32_t kLargestIndex = 255;
constexpr std::int32_t kLargestGray = 65535;

std::string name_of(ViewIndex view, const LabelPlaces& places) {
  if (places.names.empty()) return fmt::format("{:02}_{:02}", view.v, view.u);
  return places.names[static_cast<std::size_t>(view.v * places.shape.grid.u + view.u)];
}

/// Labels that are painted or have a name, by id.
std::vector<LabelInfo> infos_of(const LabelSource& source) {
  std::set<std::int32_t> ids;
  std::int32_t last = 0;
  for (std::size_t i = 0; i < source.maps.size(); ++i) {
    const std::int32_t id = source.maps.data()[i];
    if (id != last && id > 0) ids.insert(id);
    last = id;
  }
  std::vector<LabelInfo> infos = source.infos;
  std::erase_if(infos, [](const LabelInfo& label) { return label.id <= 0; });
  for (LabelInfo& label : infos) {
    if (label.name.empty()) label.name = default_label(label.id).name;
  }
  for (const std::int32_t id : ids) {
    if (std::ranges::find(infos, id, &LabelInfo::id) != infos.end()) continue;
    infos.push_back(default_label(id));
  }
  std::ranges::sort(infos, {}, &LabelInfo::id);
  return infos;
}

/// A view in 8 bits.
void write_view(const fs::path& path, const LightField& field, ViewIndex view) {
  if (field.sample_type() == SampleType::UInt8) {
    return write_png(path, field.view<std::uint8_t>(view));
  }
  Image<std::uint8_t> picture(field.height(), field.width(), field.channels());
  std::vector<float> row(static_cast<std::size_t>(field.width()) * field.channels());
  for (int y = 0; y < field.height(); ++y) {
    field.read_row(view, y, 0, field.width(), row.data());
    std::ranges::transform(row, picture.row(y), [](float sample) {
      return static_cast<std::uint8_t>(std::lround(std::clamp(sample, 0.0F, 1.0F) * 255));
    });
  }
  write_png(path, picture.view());
}

/// Folder that is being filled.
struct LabelFolder {
  fs::path place;
  std::vector<LabelInfo> infos;
  std::int32_t largest = 0;  ///< Of the ids.
  std::vector<std::array<std::uint8_t, 3>> palette{};

  LabelFolder(fs::path folder, std::vector<LabelInfo> labels)
      : place(std::move(folder)), infos(std::move(labels)) {
    if (!infos.empty()) largest = infos.back().id;
    for (std::int32_t id = 0; id <= std::min(largest, kLargestIndex); ++id) {
      const auto known = std::ranges::find(infos, id, &LabelInfo::id);
      palette.push_back(known == infos.end() ? label_color(id) : known->color);
    }
  }

  void write_picture(const fs::path& path, ImageView<const std::int32_t> labels) const {
    if (largest > kLargestIndex) return write_png(path, narrowed<std::uint16_t>(labels).view());
    write_indexed_png(path, narrowed<std::uint8_t>(labels).view(), palette);
  }

 private:
  template <class T>
  [[nodiscard]] static Image<T> narrowed(ImageView<const std::int32_t> labels) {
    Image<T> ids(labels.height, labels.width);
    std::transform(labels.data, labels.data + labels.size(), ids.begin(),
                   [](std::int32_t id) { return static_cast<T>(std::max(id, 0)); });
    return ids;
  }
};

fs::path picture_folder(LabelForm form) {
  return form == LabelForm::Voc ? "JPEGImages" : form == LabelForm::Coco ? "images" : "";
}

void write_views(const LabelFolder& folder, LabelForm form, const LabelSource& source,
                 const Progress& progress) {
  const fs::path labels_in =
      form == LabelForm::Voc ? folder.place / "SegmentationClass" : folder.place;
  CocoFile coco(folder.infos);
  std::string list;
  const int count = source.maps.grid().count();
  for (int i = 0; i < count; ++i) {
    progress.report(static_cast<double>(i) / count);
    progress.check();
    const ViewIndex view = source.maps.view_at(i);
    const std::string name = name_of(view, source.places);
    const std::string picture = name + ".png";
    const ImageView<const std::int32_t> labels = source.maps.view(view);
    if (form == LabelForm::Coco) {
      coco.add(picture, labels);
    } else if (form == LabelForm::Labelme) {
      write_labelme(labels_in / (name + ".json"), picture, labels, folder.infos);
    } else {
      folder.write_picture(labels_in / picture, labels);
    }
    if (source.pictures && form != LabelForm::Indexed) {
      write_view(folder.place / picture_folder(form) / picture, *source.pictures, view);
    }
    list += name + "\n";
  }
  if (form == LabelForm::Coco) coco.write(folder.place / "annotations" / "instances_default.json");
  if (form == LabelForm::Voc) {
    write_atomically(folder.place / "ImageSets" / "Segmentation" / "default.txt", list);
  }
}

std::string told_apart(const std::vector<std::string>& changes) {
  if (changes.empty()) return {};
  return fmt::format(finding_text("labels.told_apart"),
                     joined(changes, ", ", [](const std::string& one) { return one; }));
}

/// Colors that another label has, and black, which is unlabeled, become the next free ones.
std::string tell_colors_apart(std::vector<LabelInfo>& infos) {
  std::set<Rgb> used{Rgb{}};
  for (const LabelInfo& label : infos) used.insert(label.color);
  std::set<Rgb> given{Rgb{}};
  std::vector<std::string> changes;
  for (LabelInfo& label : infos) {
    if (given.insert(label.color).second) continue;
    while (!used.insert(label.color).second) {
      for (std::size_t c = 3; c-- > 0 && ++label.color[c] == 0;) {
      }
    }
    changes.push_back(fmt::format("{} ({}) is {}", label.id, label.name, color_text(label.color)));
  }
  return told_apart(changes);
}

std::string names_told_apart(const std::vector<LabelInfo>& infos) {
  const std::vector<std::string> names = distinct_names(infos);
  std::vector<std::string> changes;
  for (std::size_t i = 0; i < infos.size(); ++i) {
    if (names[i] != infos[i].name)
      changes.push_back(fmt::format("{} is {}", infos[i].id, names[i]));
  }
  return told_apart(changes);
}

}  // namespace

std::string write_label_folder(const fs::path& folder, LabelForm form, const LabelSource& source,
                               const Progress& progress) {
  progress.check();
  progress.step("writing " + folder.filename().string());
  std::vector<LabelInfo> infos = infos_of(source);
  const bool has_pictures = form == LabelForm::Voc || form == LabelForm::Indexed;
  if (has_pictures && !infos.empty() && infos.back().id > kLargestGray) {
    throw IoError(folder, fmt::format("pictures hold ids up to {}, but a label has {}; choose COCO "
                                      "or labelme",
                                      kLargestGray, infos.back().id));
  }
  const std::string told = has_pictures                 ? tell_colors_apart(infos)
                           : form == LabelForm::Labelme ? names_told_apart(infos)
                                                        : "";
  AtomicFolder target(folder);
  const LabelFolder filled(target.temporary(), std::move(infos));
  if (source.pictures) make_folder(filled.place / picture_folder(form));
  if (form == LabelForm::Voc) {
    make_folder(filled.place / "SegmentationClass");
    make_folder(filled.place / "ImageSets" / "Segmentation");
  }
  if (form == LabelForm::Coco) make_folder(filled.place / "annotations");
  write_views(filled, form, source, progress);
  if (has_pictures) {
    write_label_map_text(filled.place / kLabelMap, filled.infos);
  }
  progress.check();
  target.commit();
  progress.report(1);
  return told;
}

}  // namespace episcope::io
