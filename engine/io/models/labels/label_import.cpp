// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/labels/label_import.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/shear.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/json.h"
#include "engine/io/base/label_pages.h"
#include "engine/io/base/npy.h"
#include "engine/io/models/array_maps.h"
#include "engine/io/models/array_samples.h"
#include "engine/io/models/labels/color_table.h"
#include "engine/io/models/labels/label_json.h"
#include "engine/io/models/labels/label_views.h"
#include "engine/io/models/mat5.h"
#include "engine/io/models/names/grid_names.h"
#include "engine/io/models/numpy_file.h"
#include "engine/io/models/scribble_file.h"
#include "engine/io/models/sidecar_maps/map_name.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::array kPictures{".png", ".bmp", ".tif", ".tiff", ".pgm", ".jpg", ".jpeg"};
constexpr const char* kJson = ".json";
constexpr std::array kArrays{".npy", ".npz", ".mat", ".h5", ".hdf5"};

template <class Names>
bool is_among(const Names& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

std::vector<fs::path> sorted_files(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.is_regular_file(error)) files.push_back(entry.path());
  }
  if (error) throw IoError(folder, "the folder cannot be read; check its permissions");
  std::ranges::sort(files);
  return files;
}

/// The files of labels in a folder: of one kind, the first of these.
std::vector<fs::path> files_in(const fs::path& folder) {
  std::error_code ignored;
  const fs::path voc = folder / "SegmentationClass";
  if (fs::is_directory(voc, ignored)) return files_in(voc);
  const fs::path coco = folder / "annotations";
  if (fs::is_directory(coco, ignored)) return files_in(coco);
  const std::vector<fs::path> all = sorted_files(folder);
  const auto those = [&](const auto& is_wanted) {
    std::vector<fs::path> files;
    std::ranges::copy_if(all, std::back_inserter(files), is_wanted);
    return files;
  };
  const auto is_own = [](const fs::path& path) {
    return view_of_scribble_picture(path.filename().string()).has_value();
  };
  if (auto own = those(is_own); !own.empty()) return own;
  for (const char* suffix :
       {kJson, ".npy", ".png", ".tif", ".tiff", ".bmp", ".pgm", ".npz", ".mat", ".h5", ".hdf5"}) {
    auto files = those([&](const fs::path& path) { return suffix_of(path) == suffix; });
    if (!files.empty()) return files;
  }
  throw IoError(folder, "there are no files of labels here; choose another folder");
}

std::vector<fs::path> listed(const std::vector<fs::path>& paths) {
  std::error_code ignored;
  if (paths.size() == 1 && fs::is_directory(paths.front(), ignored)) return files_in(paths.front());
  return paths;
}

/// Files that are being read, and what they hold so far.
struct Import {
  const LabelPlaces& places;
  LabelNames names;
  std::vector<LabelInfo> stated{};  ///< Names and colors by id.
  std::vector<ViewPicture> pictures{};
  std::vector<std::string> notes{};
  bool in_order = false;  ///< Views are told by their order alone.

  void add(const fs::path& path, ViewIndex view, LabelPicture picture) {
    const FieldShape& shape = places.shape;
    if (!shape.grid.contains(view)) {
      throw IoError(path, "the light field has no view (" + view_text(view) +
                              "); choose pictures of this light field");
    }
    if (picture.height() != shape.height || picture.width() != shape.width) {
      throw IoError(path,
                    fmt::format("the labels have {}×{} px, but views have {}×{} px (width × "
                                "height); choose labels of this light field",
                                picture.width(), picture.height(), shape.width, shape.height));
    }
    const bool is_own = view_of_scribble_picture(path.filename().string()).has_value();
    pictures.push_back({path, view, std::move(picture), is_own});
  }
  /// The center view. Says so if the name has numbers, of another view.
  ViewIndex view_without_name(const fs::path& path) {
    const ViewIndex center = places.shape.grid.center();
    if (numbered_name(path.stem().string()).numbers.size() >= 2) {
      notes.push_back(fmt::format(finding_text("labels.no_view"), path.filename().string(),
                                  places.shape.grid.v, places.shape.grid.u, view_text(center)));
    }
    return center;
  }
  /// All views, row by row, or one.
  void add_all(const NamedFile& file, std::vector<LabelPicture> maps) {
    const GridShape grid = places.shape.grid;
    const auto count = static_cast<int>(maps.size());
    if (count != 1 && count != grid.count()) {
      throw IoError(file.path, fmt::format("holds labels of {} pictures, but the light field has "
                                           "{}×{} views; save one or all of them",
                                           count, grid.v, grid.u));
    }
    const ViewIndex alone = file.view ? *file.view : view_without_name(file.path);
    if (count > 1) in_order = true;
    for (int i = 0; i < count; ++i) {
      add(file.path, count == 1 ? alone : grid.view_at(i),
          std::move(maps[static_cast<std::size_t>(i)]));
    }
  }
};

/// JPEG mixes the colors of labels with those beside them.
void require_exact_colors(const fs::path& path) {
  constexpr std::array<char, 3> kJpeg{'\xFF', '\xD8', '\xFF'};
  std::array<char, 3> begin{};
  std::ifstream(path, std::ios::binary).read(begin.data(), begin.size());
  if (begin != kJpeg) return;
  throw IoError(path, "is a JPEG picture, which changes the colors of labels; save it as PNG");
}

/// Axes of vigra, as ilastik states them: "tyxc"; empty for other datasets.
std::string vigra_axes(const Hdf5Input& file, const std::string& dataset) {
  const auto text = file.text(dataset, "axistags");
  if (!text) return {};
  std::string axes;
  const auto json = json_or_null<nlohmann::json>(*text);
  if (!json.is_object() || !json.contains("axes")) return {};
  for (const auto& axis : json["axes"]) {
    const std::string key = axis.is_object() ? axis.value("key", "") : "";
    if (key.size() != 1) return {};
    axes += key;
  }
  return axes;
}

/// An array of labels, whose axes are known.
struct LabelArray {
  ArrayEntry entry;
  ArrayLayout layout;
};

/// Meaning of the axes that are longer than 1, in the order of indices: of one view, of all views
/// in a row, or in a grid.
std::optional<std::string> axes_of(const ArrayShape& lengths, const FieldShape& shape) {
  const auto v = static_cast<std::size_t>(shape.grid.v), u = static_cast<std::size_t>(shape.grid.u);
  const auto y = static_cast<std::size_t>(shape.height), x = static_cast<std::size_t>(shape.width);
  const std::vector<std::pair<ArrayShape, std::string>> known{
      {{y, x}, "yx"},         {{x, y}, "xy"},         {{v * u, y, x}, "nyx"},
      {{y, x, v * u}, "yxn"}, {{x, y, v * u}, "xyn"}, {{v, u, y, x}, "vuyx"},
      {{y, x, v, u}, "yxvu"}, {{x, y, u, v}, "xyuv"}};
  for (const auto& [expected, axes] : known) {
    ArrayShape longer;
    std::string letters;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const bool is_pixel = axes[i] == 'y' || axes[i] == 'x';
      if (expected[i] == 1 && !is_pixel) continue;
      longer.push_back(expected[i]);
      letters += axes[i];
    }
    if (longer == lengths) return letters;
  }
  return std::nullopt;
}

/// Axes that a program states, of those longer than 1; t and z count views, both of them rows and
/// columns.
std::optional<std::string> stated_axes(std::string axes, const ArrayShape& lengths) {
  const bool has_both = axes.find('t') != std::string::npos && axes.find('z') != std::string::npos;
  std::ranges::replace(axes, 't', has_both ? 'v' : 'n');
  std::ranges::replace(axes, 'z', has_both ? 'u' : 'n');
  const bool is_map = axes.find('y') != std::string::npos && axes.find('x') != std::string::npos;
  if (!is_map || axes.size() != lengths.size()) return std::nullopt;
  const bool is_known = axes.find_first_not_of("vunyx") == std::string::npos;
  return is_known ? std::optional(axes) : std::nullopt;
}

std::optional<LabelArray> label_array(const ArrayEntry& entry, const std::string& stated,
                                      const FieldShape& shape) {
  if (!entry.other_kind.empty()) return std::nullopt;
  const ArrayShape indexed = in_index_order(entry.shape, entry.order);
  ArrayShape lengths;
  std::string letters;  // of `stated` where the array is longer than 1
  std::string axes(indexed.size(), kSingle);
  for (std::size_t i = 0; i < indexed.size(); ++i) {
    const char letter = i < stated.size() ? stated[i] : '?';
    if (indexed[i] == 1 && letter != 'y' && letter != 'x') continue;
    lengths.push_back(indexed[i]);
    letters += letter;
    axes[i] = '?';
  }
  auto meaning = stated.size() == indexed.size() ? stated_axes(letters, lengths) : std::nullopt;
  if (!meaning && stated.empty()) meaning = axes_of(lengths, shape);
  if (!meaning) return std::nullopt;
  for (std::size_t i = 0, next = 0; i < axes.size(); ++i) {
    if (axes[i] == '?') axes[i] = (*meaning)[next++];
  }
  return LabelArray{entry, {entry.shape, in_index_order(axes, entry.order)}};
}

std::string array_text(const ArrayEntry& entry) {
  return entry.name + " (" + content_text(entry) + ")";
}

/// The only array that fits, or the only one of them that is named after labels.
LabelArray choose_array(const ArrayFile& file, std::vector<LabelArray> fitting,
                        const FieldShape& shape) {
  if (fitting.size() > 1) {
    std::vector<LabelArray> named;
    std::ranges::copy_if(fitting, std::back_inserter(named), [](const LabelArray& one) {
      return map_kind(last_name(one.entry.name)) == MapKind::Labels;
    });
    if (named.size() == 1) fitting = std::move(named);
  }
  if (fitting.size() == 1) return fitting.front();
  const std::string held = joined(file.entries(), ", ", array_text);
  throw IoError(file.path(),
                fmt::format("holds {}, and {} labels of one view, {}×{} px (height × width), or of "
                            "{}×{} views; store the labels alone",
                            held.empty() ? "no array" : held,
                            fitting.empty() ? "none of them is" : "several of them may be",
                            shape.height, shape.width, shape.grid.v, shape.grid.u));
}

/// Of a file of arrays, with the axes that vigra states.
LabelArray find_array(const ArrayFile& file, const Hdf5Input* tagged, const FieldShape& shape) {
  std::vector<LabelArray> fitting;
  for (const ArrayEntry& entry : file.entries()) {
    const std::string axes = tagged ? vigra_axes(*tagged, entry.name) : entry.stated_axes;
    std::string letters;
    std::ranges::copy_if(axes, std::back_inserter(letters), is_letter);
    if (auto one = label_array(entry, letters, shape)) fitting.push_back(std::move(*one));
  }
  return choose_array(file, std::move(fitting), shape);
}

ViewStack<std::int32_t> read_whole(const ArrayInput& array, const ArrayLayout& layout,
                                   const Progress& progress) {
  if (is_float(array.type()) && has_fractions(read_map_stack<float>(array, layout, progress))) {
    throw IoError(array.path(), "labels are whole numbers, but this array has others; save labels");
  }
  ViewStack<std::int32_t> maps = read_map_stack<std::int32_t>(array, layout, progress);
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  if (std::find(maps.data(), maps.data() + maps.size(), kMost) != maps.data() + maps.size()) {
    throw IoError(array.path(),
                  fmt::format("ids of labels are at most {}, but this array has larger numbers; "
                              "number the labels anew",
                              kMost - 1));
  }
  return maps;
}

void add_array(Import& import, const NamedFile& file, const Progress& progress) {
  const fs::path& path = file.path;
  std::shared_ptr<const Hdf5Input> hdf5;
  std::unique_ptr<const ArrayFile> arrays;
  if (suffix_of(path) == ".mat") {
    arrays = open_matlab_file(path);
  } else if (has_hdf5_name(path)) {
    hdf5 = std::make_shared<const Hdf5Input>(path);
    arrays = std::make_unique<const Hdf5Arrays>(hdf5);
  } else {
    arrays = std::make_unique<const NumpyFile>(path);
  }
  const LabelArray found = find_array(*arrays, hdf5.get(), import.places.shape);
  const std::string axes = in_index_order(found.layout.axes, found.entry.order);
  const FieldShape& shape = import.places.shape;
  const bool are_stated =
      hdf5 ? !vigra_axes(*hdf5, found.entry.name).empty() : !found.entry.stated_axes.empty();
  if (axes.find('x') < axes.find('y') && !are_stated) {
    import.notes.push_back(fmt::format(finding_text("labels.exchanged"), path.filename().string(),
                                       shape.height, shape.width, shape.width, shape.height));
  }
  const ViewStack<std::int32_t> maps =
      read_whole(*arrays->open(found.entry), found.layout, progress);
  std::vector<LabelPicture> pictures;
  for (int i = 0; i < maps.grid().count(); ++i) {
    Image<std::int32_t> numbers(maps.height(), maps.width());
    std::copy_n(maps.view(maps.view_at(i)).data, maps.view_size(), numbers.data());
    pictures.push_back({std::move(numbers), {}, {}, {}});
  }
  import.add_all(file, std::move(pictures));
}

LabelPicture picture_of(Image<std::int32_t> numbers) {
  return {std::move(numbers), {}, {}, {}};
}

/// Of the pictures that are views; the others are left out with a note.
std::vector<NamedFile> views_of_coco(Import& import, const fs::path& path,
                                     const std::vector<fs::path>& names) {
  std::vector<NamedFile> views = named_views(names, import.places, import.notes);
  const auto is_foreign = [](const NamedFile& file) { return !file.view; };
  if (names.size() == 1 || std::ranges::none_of(views, is_foreign)) return views;
  if (auto all = counted_views(names, import.places.shape.grid)) return *all;
  std::vector<std::string> foreign;
  for (const NamedFile& file : views) {
    if (!file.view) foreign.push_back(file.path.string());
  }
  std::erase_if(views, is_foreign);
  const std::string list = joined(foreign, ", ", [](const std::string& one) { return one; });
  if (views.empty()) {
    throw IoError(path, "holds labels of pictures that are no views of this light field: " + list +
                            "; name them by row and column, as in 03_04.png");
  }
  import.notes.push_back(
      fmt::format(finding_text("labels.foreign"), path.filename().string(), list));
  return views;
}

void add_coco(Import& import, const fs::path& path, CocoLabels coco) {
  std::vector<fs::path> names;
  for (const JsonPicture& picture : coco.pictures) names.emplace_back(picture.file_name);
  if (names.empty()) throw IoError(path, "has no pictures; export it again");
  const std::vector<NamedFile> views = views_of_coco(import, path, names);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto place =
        std::ranges::find(coco.pictures, views[i].path.string(), &JsonPicture::file_name);
    const auto& view = views[i].view;
    import.add(path, view ? *view : import.view_without_name(views[i].path),
               picture_of(std::move(place->labels)));
    place->file_name.clear();  // another of that name is another picture
  }
  import.stated = std::move(coco.labels);
  std::ranges::move(coco.notes, std::back_inserter(import.notes));
}

void add_json(Import& import, const NamedFile& file) {
  LabelJson labels = read_label_json(file.path, import.names, import.places.shape);
  if (auto* const coco = std::get_if<CocoLabels>(&labels)) {
    return add_coco(import, file.path, std::move(*coco));
  }
  auto* const picture = std::get_if<JsonPicture>(&labels);
  if (!picture) {
    throw IoError(file.path,
                  "is JSON, but neither of labelme (shapes) nor of COCO (images, "
                  "annotations); choose another file");
  }
  std::optional<ViewIndex> view = file.view;
  if (!view && !picture->file_name.empty()) {
    view = named_views({picture->file_name}, import.places, import.notes).front().view;
  }
  if (!view) view = import.view_without_name(picture->file_name);
  if (!picture->unknown.empty()) {
    import.notes.push_back(fmt::format(finding_text("labels.unknown_shapes"),
                                       joined(picture->unknown, ", "),
                                       file.path.filename().string()));
  }
  if (!picture->unseen.empty()) {
    import.notes.push_back(fmt::format(finding_text("labels.shapes"), joined(picture->unseen, ", "),
                                       file.path.filename().string()));
  }
  import.add(file.path, *view, picture_of(std::move(picture->labels)));
  import.stated = import.names.labels();
}

void add_file(Import& import, const NamedFile& file, const Progress& progress) {
  const std::string suffix = suffix_of(file.path);
  if (suffix == kJson) return add_json(import, file);
  if (is_among(kArrays, suffix)) return add_array(import, file, progress);
  if (!is_among(kPictures, suffix)) {
    throw IoError(file.path,
                  "is no file of labels by its name; choose PNG, TIFF, BMP, PGM, .npy, "
                  ".npz, .mat, HDF5, or JSON of labelme or COCO");
  }
  require_exact_colors(file.path);
  import.add_all(file, decode_label_pages(file.path));
}

/// What `labelmap.txt` beside the files says, unless a table is given.
LabelReading with_label_map(LabelReading reading, const Import& import, const fs::path& path) {
  const fs::path map = label_map_beside(path.parent_path());
  if (!reading.table.empty() || map.empty()) return reading;
  const auto has_palette = [](const ViewPicture& one) { return !one.picture.palette.empty(); };
  const bool are_indices = std::ranges::all_of(import.pictures, has_palette);
  const auto has_colors = [](const ViewPicture& one) { return !one.picture.colors.empty(); };
  if (are_indices) {
    reading.palette_names = read_color_table(map);
  } else if (std::ranges::all_of(import.pictures, has_colors)) {
    reading.table = read_color_table(map);
  }
  return reading;
}

void require_distinct_views(std::vector<ViewPicture>& pictures) {
  std::ranges::stable_sort(
      pictures, {}, [](const ViewPicture& one) { return std::pair(one.view.v, one.view.u); });
  const auto twice = std::ranges::adjacent_find(pictures, {}, &ViewPicture::view);
  if (twice == pictures.end()) return;
  throw IoError(twice->path, "and " + std::next(twice)->path.filename().string() +
                                 " are of the same view (" + view_text(twice->view) +
                                 "); choose one of them");
}

/// Whether arrays hold labels of views of this shape, by their sizes and names; floats do by their
/// name alone.
bool fits_as_labels(const ArrayFile& file, const Hdf5Input* tagged, const FieldShape& shape) {
  try {
    const ArrayEntry entry = find_array(file, tagged, shape).entry;
    const auto kind = map_kind(last_name(entry.name));
    return kind ? *kind == MapKind::Labels : !is_float(entry.type);
  } catch (const IoError&) {
    return false;
  }
}

bool holds_label_arrays(const fs::path& path, const FieldShape* shape) {
  constexpr std::size_t kAxes = 5;  // of a light field in color
  const std::string suffix = suffix_of(path);
  if (suffix == ".npy") return NpyFile(path).shape().size() < kAxes;
  if (suffix == ".npz") return shape && fits_as_labels(NumpyFile(path), nullptr, *shape);
  if (suffix == ".mat") return shape && fits_as_labels(*open_matlab_file(path), nullptr, *shape);
  if (!has_hdf5_name(path) || !has_hdf5_signature(path)) return false;
  const auto file = std::make_shared<const Hdf5Input>(path);
  if (file->has("LF")) return false;
  constexpr std::array kLabels{"SCRIBBLES", "LABELS", kTrueLabels, "exported_data"};
  return std::ranges::any_of(kLabels, [&](const char* name) { return file->has(name); }) ||
         (shape && fits_as_labels(Hdf5Arrays(file), file.get(), *shape));
}

/// As labelme, COCO, VOC, CVAT and Episcope write them.
bool is_label_folder(const fs::path& folder, const FieldShape& shape) {
  std::error_code ignored;
  for (const char* part : {"SegmentationClass", "annotations", kLabelMap}) {
    if (fs::exists(folder / part, ignored)) return true;
  }
  const std::vector<fs::path> files = files_in(folder);
  if (view_of_scribble_picture(files.front().filename().string())) return true;
  if (suffix_of(files.front()) != kJson) return false;
  LabelNames names({});
  return !std::holds_alternative<std::monostate>(read_label_json(files.front(), names, shape));
}

}  // namespace

bool holds_labels_only(const fs::path& path, const FieldShape* shape) {
  const std::string suffix = suffix_of(path);
  std::error_code ignored;
  try {
    if (fs::is_directory(path, ignored))
      return is_label_folder(path, shape ? *shape : FieldShape{});
    return is_among(kPictures, suffix) || suffix == kJson || holds_label_arrays(path, shape);
  } catch (const IoError&) {
    return false;  // what is wrong with it is said when it is opened
  }
}

bool has_own_labels(const fs::path& path) {
  if (!has_hdf5_signature(path) || suffix_of(path) == ".mat") return false;
  const Hdf5Input file(path);
  return file.has("SCRIBBLES") || file.has(kTrueLabels) || is_segmentation_file(path);
}

ImportedLabels read_label_files(const std::vector<fs::path>& paths, const LabelPlaces& places,
                                const LabelReading& reading, const Progress& progress) {
  if (paths.empty()) throw InvalidInput("no file of labels was named");
  for (const fs::path& path : paths) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) throw IoError(path, "there is no such file; check the path");
  }
  const std::vector<fs::path> files = listed(paths);
  Import import{places, LabelNames(reading.known)};
  const std::vector<NamedFile> named = placed_views(files, places, import.notes);
  for (std::size_t i = 0; i < named.size(); ++i) {
    const double share = 1.0 / static_cast<double>(named.size());
    add_file(import, named[i],
             progress.part(static_cast<double>(i) * share, static_cast<double>(i + 1) * share));
  }
  require_distinct_views(import.pictures);
  LabelReading known = with_label_map(reading, import, files.front());
  if (!import.stated.empty()) known.stated = std::move(import.stated);
  ImportedLabels labels = labels_of_pictures(std::move(import.pictures), known, paths.front());
  labels.notes.insert(labels.notes.end(), import.notes.begin(), import.notes.end());
  labels.in_order = import.in_order;
  return labels;
}

namespace {

/// Names of the files of the views, if they lie in a folder and their names tell the grid.
std::vector<std::string> names_of_views(const Scene& scene) {
  const LightField& field = *scene.light_field;
  const fs::path source = field.info().source;
  std::error_code ignored;
  std::vector<std::string> names;
  if (!fs::is_directory(source, ignored) || scene.convention.crop.leaves_out()) return names;
  try {
    const ViewFiles views = name_grid(source, {}).placed.views;
    const bool is_row = views.grid.v == 1 && views.grid.u == field.grid().count();
    if (!(views.grid == field.grid()) && !is_row) return names;
    for (int i = 0; i < field.grid().count(); ++i) {
      const ViewIndex view =
          flipped(field.grid().view_at(i), field.grid(), flip_of(scene.convention));
      names.push_back(
          views.files[static_cast<std::size_t>(view.v * field.grid().u + view.u)].stem().string());
    }
  } catch (const Error&) {
    names.clear();  // read by a pattern that the user named
  }
  const bool are_distinct = std::set(names.begin(), names.end()).size() == names.size();
  return are_distinct ? names : std::vector<std::string>();
}

Scribbles scribbles_of(const ViewStack<std::int32_t>& maps) {
  Scribbles labels;
  for (int i = 0; i < maps.grid().count(); ++i) {
    const ViewIndex view = maps.view_at(i);
    Image<std::int32_t> map(maps.height(), maps.width());
    std::copy_n(maps.view(view).data, map.size(), map.data());
    labels.views.push_back({view, std::move(map)});
  }
  return labels;
}

Scribbles read_own_segmentation(const fs::path& path, const Scene& scene) {
  const SegmentationFile file(path);
  const LightField& field = *scene.light_field;
  Scribbles labels;
  labels.labels = file.infos();
  for (int i = 0; i < file.grid().count(); ++i) {
    const ViewIndex view = file.grid().view_at(i, file.first());
    labels.views.push_back({view, file.labels(view)});
    const Image<std::int32_t>& map = labels.views.back().labels;
    if (field.grid().contains(view) && map.height() == field.height() &&
        map.width() == field.width()) {
      continue;
    }
    throw IoError(path,
                  fmt::format("holds labels of view ({}) of {}×{} px, but the light field has "
                              "{}×{} views of {}×{} px (width × height); choose its labels",
                              view_text(view), map.width(), map.height(), field.grid().v,
                              field.grid().u, field.width(), field.height()));
  }
  return labels;
}

/// Labels in the form of Episcope or the archive; nothing for another file.
std::optional<Scribbles> read_own_labels(const fs::path& path, const Scene& scene,
                                         bool prefers_truth, const Progress& progress) {
  if (!has_own_labels(path)) return std::nullopt;
  const Hdf5Input file(path);
  const bool takes_truth = prefers_truth && file.has(kTrueLabels);
  if (file.has("SCRIBBLES") && !takes_truth) return read_scribbles(path, scene, progress);
  if (is_segmentation_file(path)) return read_own_segmentation(path, scene);
  Scribbles labels = scribbles_of(read_true_labels(path, scene, progress));
  labels.labels = read_label_list(file, kTrueLabels);
  return labels;
}

}  // namespace

LabelPlaces label_places(const Scene& scene) {
  const LightField& field = *scene.light_field;
  return {{field.grid(), field.height(), field.width()}, names_of_views(scene)};
}

ImportedLabels read_labels(const std::vector<fs::path>& paths, const Scene& scene,
                           const LabelReading& reading, const Progress& progress) {
  if (paths.size() == 1) {
    auto own = read_own_labels(paths.front(), scene, reading.prefers_truth, progress);
    if (own) return {std::move(*own), {}};
  }
  const LightField& field = *scene.light_field;
  ImportedLabels labels = read_label_files(paths, label_places(scene), reading, progress);
  if (labels.in_order && flip_of(scene.convention) != ViewFlip{}) {
    labels.notes.push_back(fmt::format(finding_text("labels.order"), scene.convention.order));
  }
  const double focus_px = scene.convention.focus_px;
  if (focus_px != 0) labels.scribbles = sheared(labels.scribbles, field.center(), focus_px);
  return labels;
}

ViewStack<std::int32_t> stack_of(const Scribbles& labels, const FieldShape& shape) {
  if (labels.views.empty()) return {};
  const bool is_single = labels.views.size() == 1;
  const GridShape grid = is_single ? GridShape{1, 1} : shape.grid;
  ViewStack<std::int32_t> maps(grid, shape.height, shape.width, 1,
                               is_single ? labels.views.front().view : ViewIndex{});
  std::fill_n(maps.data(), maps.size(), 0);
  for (const ViewScribbles& one : labels.views) {
    std::ranges::copy(one.labels, maps.view(one.view).data);
  }
  return maps;
}

namespace {

/// Whether somebody gave a label its name.
bool is_named(const LabelInfo& label) {
  return !label.name.empty() && label.name != default_label(label.id).name &&
         label.name != color_text(label.color);
}

/// The id that a label has among those that are `taken`, which knows it by its name, else by its
/// id if it has no name; 0 = another one.
std::int32_t known_id(const LabelInfo& label, std::int32_t most,
                      const std::vector<LabelInfo>& taken) {
  const auto same = std::ranges::find(taken, label.id, &LabelInfo::id);
  const bool is_free = same == taken.end() || same->name == label.name || !is_named(label);
  if (is_free && same != taken.end()) return label.id;
  if (is_named(label)) {
    const auto named = std::ranges::find(taken, label.name, &LabelInfo::name);
    if (named != taken.end()) return named->id;
  }
  return is_free && label.id <= most ? label.id : 0;
}

/// Labels of all ids that are painted or named, by id.
std::vector<LabelInfo> all_labels(const Scribbles& labels) {
  std::set<std::int32_t> ids;
  for (const ViewScribbles& one : labels.views) ids.insert(one.labels.begin(), one.labels.end());
  for (const LabelInfo& one : labels.labels) ids.insert(one.id);
  std::vector<LabelInfo> all;
  for (auto id = ids.upper_bound(0); id != ids.end(); ++id) {
    const auto known = std::ranges::find(labels.labels, *id, &LabelInfo::id);
    all.push_back(known == labels.labels.end() ? default_label(*id) : *known);
  }
  return all;
}

/// New ids of all labels, by their former ones; each new id once. Names go first.
std::map<std::int32_t, std::int32_t> new_ids(std::vector<LabelInfo> all, std::int32_t most,
                                             const std::vector<LabelInfo>& taken) {
  std::stable_partition(all.begin(), all.end(), is_named);
  std::map<std::int32_t, std::int32_t> ids;
  std::set<std::int32_t> used;
  for (const LabelInfo& label : all) {
    const std::int32_t id = known_id(label, most, taken);
    if (id > 0 && used.insert(id).second) ids[label.id] = id;
  }
  for (const LabelInfo& label : taken) used.insert(label.id);
  std::int32_t next = 1;
  for (const LabelInfo& label : all) {
    if (ids.contains(label.id)) continue;
    if (label.id <= most && used.insert(label.id).second) {
      ids[label.id] = label.id;
      continue;
    }
    while (used.contains(next)) ++next;
    if (next > most) {
      throw InvalidInput(
          fmt::format("the labels have {} ids, but only {} can be painted with; join some of them",
                      all.size(), most));
    }
    ids[label.id] = next++;
  }
  return ids;
}

}  // namespace

std::string renumber_labels(Scribbles& labels, std::int32_t most,
                            const std::vector<LabelInfo>& taken) {
  std::vector<LabelInfo> all = all_labels(labels);
  const std::map<std::int32_t, std::int32_t> ids = new_ids(all, most, taken);
  std::vector<std::string> changes;
  for (LabelInfo& label : all) {
    const std::int32_t id = ids.at(label.id);
    if (id == label.id) continue;
    changes.push_back(
        fmt::format("{}{} is {}", label.id, is_named(label) ? " (" + label.name + ")" : "", id));
    if (!is_named(label)) label.color = label_color(id);
    const auto known = std::ranges::find(labels.labels, label.id, &LabelInfo::id);
    if (known == labels.labels.end()) labels.labels.push_back(label);
  }
  if (changes.empty()) return {};
  for (ViewScribbles& one : labels.views) {
    for (std::int32_t& id : one.labels) {
      if (id > 0) id = ids.at(id);
    }
  }
  for (LabelInfo& label : labels.labels) {
    if (label.id > 0) label.id = ids.at(label.id);
  }
  std::ranges::sort(labels.labels, {}, &LabelInfo::id);
  return fmt::format(finding_text("labels.renumbered"), most,
                     joined(changes, ", ", [](const std::string& one) { return one; }));
}

}  // namespace episcope::io
