// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/array_reader.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/light_field.h"
#include "engine/core/text.h"
#include "engine/io/base/array_layout.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/npy.h"
#include "engine/io/base/sample_range.h"
#include "engine/io/formats/archive_depth.h"
#include "engine/io/formats/multi_field_file.h"
#include "engine/io/models/array_maps.h"
#include "engine/io/models/array_samples.h"
#include "engine/io/models/choose_layout.h"
#include "engine/io/models/mat5.h"
#include "engine/io/models/names/grid_names.h"
#include "engine/io/models/numpy_file.h"
#include "engine/io/models/order/list_layout.h"
#include "engine/io/models/sidecar_maps/map_name.h"
#include "engine/io/models/sidecar_maps/sidecar_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace episcope::io {
namespace {

/// What a file holds beside arrays that `read_array_maps` knows.
struct OtherArrays {
  std::function<bool(const ArrayEntry&)> owns{};  ///< Arrays that it alone reads.
  /// Adds them to the parts, which hold samples and maps in the order of the file.
  std::function<void(SceneParts&, ConventionReport&, const Progress&)> add{};
  bool is_in_memory = false;  ///< No file is there, and nothing beside it.
};

constexpr double kVideoBlack = 16.0 / 255;
constexpr double kVideoWhite = 235.0 / 255;
constexpr double kVideoChroma = 224.0 / 255;
constexpr double kTolerance = 0.5 / 255;

template <class T>
constexpr double kFull = std::is_floating_point_v<T> ? 1.0 : double(std::numeric_limits<T>::max());

template <class T>
bool has_video_range(const ViewStack<T>& stack) {
  for (std::size_t i = 0; i < stack.size(); i += 3) {
    const double luma = static_cast<double>(stack.data()[i]) / kFull<T>;
    if (luma < kVideoBlack - kTolerance || luma > kVideoWhite + kTolerance) return false;
  }
  return true;
}

template <class T>
void decode(ViewStack<T>& stack, bool is_video) {
  constexpr double kMiddle = 128.0 / 255;
  const auto stored = [](double value) {
    const double whole = kFull<T> * std::clamp(value, 0.0, 1.0);
    return static_cast<T>(std::is_floating_point_v<T> ? whole : whole + 0.5);
  };
  for (std::size_t i = 0; i < stack.size(); i += 3) {
    T* pixel = stack.data() + i;
    double luma = static_cast<double>(pixel[0]) / kFull<T>;
    double blue = static_cast<double>(pixel[1]) / kFull<T> - kMiddle;
    double red = static_cast<double>(pixel[2]) / kFull<T> - kMiddle;
    if (is_video) {
      luma = (luma - kVideoBlack) / (kVideoWhite - kVideoBlack);
      blue /= kVideoChroma;
      red /= kVideoChroma;
    }
    pixel[0] = stored(luma + 1.402 * red);
    pixel[1] = stored(luma - 0.344136 * blue - 0.714136 * red);
    pixel[2] = stored(luma + 1.772 * blue);
  }
}

/// Turns samples of an array whose name says that they are Y, Cb, Cr (ITU-R BT.601, as data sets
/// for super-resolution store them) into red, green and blue, and says so in a warning. With Y in
/// 16 … 235 of 255 throughout the range is that of video, as MATLAB's rgb2ycbcr writes it, else the
/// full one, as in JPEG. Linear in the samples.
void decode_luma_chroma(const std::string& name, LightField::Samples& samples,
                        ConventionReport& report) {
  if (lower_case(name).find("ycbcr") == std::string::npos) return;
  std::visit(
      [&](auto& stack) {
        if (stack.channels() != 3 || stack.kind() == LargeKind::File) return;
        const bool is_video = has_video_range(stack);
        decode(stack, is_video);
        report.warnings.push_back(fmt::format(finding_text("samples.y_cb_cr"), name,
                                              is_video ? "video (16 … 235)" : "the full range"));
      },
      samples);
}

constexpr std::size_t kYuvPlanes = 3;
constexpr std::size_t kFewestListed = 4;

/// 3N×H×W as N×3×H×W.
ArrayShape grouped(const ArrayShape& list) {
  return {list[0] / kYuvPlanes, kYuvPlanes, list[1], list[2]};
}

class GroupedInput : public ArrayInput {
 public:
  explicit GroupedInput(std::unique_ptr<ArrayInput> list)
      : ArrayInput(list->path(), grouped(list->shape()), list->type()), list_(std::move(list)) {}
  [[nodiscard]] bool is_sequential() const override { return list_->is_sequential(); }

 private:
  void read_block(const ArrayShape& start, const ArrayShape& count,
                  std::uint8_t* out) const override {
    const ArrayShape part{count[1], count[2], count[3]};
    const std::size_t bytes = element_count(part) * byte_size(type());
    for (std::size_t i = 0; i < count[0]; ++i, out += bytes) {
      list_->read_raw({(start[0] + i) * kYuvPlanes + start[1], start[2], start[3]}, part, out);
    }
  }

  std::unique_ptr<ArrayInput> list_;
};

class GroupedFile : public ArrayFile {
 public:
  GroupedFile(const ArrayFile& file, const std::string& list)
      : ArrayFile(file.path(), file.form()), file_(file), list_(list) {
    for (ArrayEntry entry : file.entries()) {
      entry.parts.clear();  // the file itself puts them together
      if (entry.name == list) entry.shape = grouped(entry.shape);
      add(std::move(entry));
    }
  }

 private:
  [[nodiscard]] std::unique_ptr<ArrayInput> open_stored(const ArrayEntry& entry) const override {
    const auto& all = file_.entries();
    auto array = file_.open(*std::ranges::find(all, entry.name, &ArrayEntry::name));
    if (entry.name != list_) return array;
    return std::make_unique<GroupedInput>(std::move(array));
  }

  const ArrayFile& file_;
  std::string list_;
};

bool may_be_stacked(const ArrayEntry& entry) {
  constexpr std::size_t kAxes = 3;
  return entry.shape.size() == kAxes && entry.order == IndexOrder::C && entry.stated_axes.empty() &&
         entry.parts.empty() && entry.shape[0] % kYuvPlanes == 0 &&
         entry.shape[0] / kYuvPlanes >= kFewestListed;
}

/// The file as if a list of 3N grey pictures in C order, 3N×H×W, were one of N colored ones,
/// N×3×H×W, if the pictures are the channels of views one after the other, as networks take them:
/// then views move, and channels do not. Null for other files, and where options say what is meant.
/// `file` must outlive it.
std::unique_ptr<ArrayFile> with_stacked_channels(const ArrayFile& file,
                                                 const OpenOptions& options) {
  if (!options.axes.empty() || !options.dataset.empty()) return nullptr;
  const std::vector<const ArrayEntry*> fields = light_fields_of(file, {});
  if (fields.size() != 1 || !may_be_stacked(*fields.front())) return nullptr;
  const ArrayEntry& list = *fields.front();
  const std::vector<ArrayLayout> layouts = possible_layouts(list.shape, list.order);
  if (layouts.size() != 1 || layouts.front().axes != "nyx") return nullptr;
  const ArrayLayout as_grid{grouped(list.shape), "vuyx"};
  const ViewAxes axes = measure_parallax(GroupedInput(file.open(list)), as_grid);
  if (!are_rather_channels(axes.along_u, axes.along_v)) return nullptr;
  return std::make_unique<GroupedFile>(file, list.name);
}

namespace fs = std::filesystem;

/// The only file of a folder that is meant, if there are no images beside it; else empty.
fs::path only_file_in(const fs::path& folder,
                      const std::function<bool(const fs::path&)>& is_meant) {
  fs::path found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (is_image_name(entry.path())) return {};
    if (!is_meant(entry.path())) continue;
    if (!found.empty()) return {};
    found = entry.path();
  }
  return found;
}

constexpr const char* kArrayOptions[] = {"flip", "grid",  "crop",  "dataset",
                                         "axes", "frame", "levels"};

/// As the light field itself says which pixels hold something, or a mask beside it.
void combine(ViewStack<std::uint8_t>& valid, ViewStack<std::uint8_t> mask) {
  if (valid.empty()) {
    valid = std::move(mask);
  } else if (!mask.empty()) {
    std::transform(valid.data(), valid.data() + valid.size(), mask.data(), valid.data(),
                   [](std::uint8_t a, std::uint8_t b) { return std::min(a, b); });
  }
}

const ArrayEntry& light_field_of(const ArrayFile& file, const OpenOptions& options) {
  const ArrayEntry* entry = find_light_field(file, options.dataset, options.axes);
  if (entry) return *entry;
  if (!options.axes.empty()) {
    throw InvalidInput(fmt::format("{}: no array of this file has the {} axes {}; state others",
                                   file.path().string(), options.axes.size(), options.axes));
  }
  const std::string held = joined(file.entries(), "; ", [](const ArrayEntry& one) {
    return one.name + ", " + content_text(one);
  });
  throw IoError(file.path(), fmt::format("no array of this file has the shape of a light field; if "
                                         "one is, name it with --dataset and its axes with --axes "
                                         "(there {})",
                                         held.empty() ? "is none" : "are: " + held.substr(0, 300)));
}

LightFieldInfo info_of(const ArrayFile& file, const char* reader) {
  LightFieldInfo info;
  info.name = scene_name(file.path());
  info.source = file.path().string();
  info.reading.reader = reader;
  return info;
}

void report_form(const ArrayFile& file, const ArrayEntry& entry, const ChosenLayout& chosen,
                 ConventionReport& report) {
  const std::string name = entry.name.empty() ? "" : entry.name + ", ";
  report.format =
      fmt::format("{} ({}{} {}; axes {})", file.form(), name,
                  layout_text(chosen.layout, entry.order), number_name(entry.type), chosen.reason);
  if (!entry.warning.empty()) report.warnings.push_back(entry.warning);
}

/// Exchanges rows and columns of views, unless they were stated, if only that makes the grid that
/// is asked for. Throws InvalidInput for any other grid than that of the array.
void fit_to_grid(const ArrayFile& file, const OpenOptions& options, ChosenLayout& chosen) {
  const auto wanted = given_grid(options);
  if (!wanted || chosen.layout.has('n') || chosen.layout.grid() == *wanted) return;
  if (chosen.reason.starts_with("by shape") && chosen.layout.crossed().grid() == *wanted) {
    chosen.layout = chosen.layout.crossed();
    chosen.reason = "by shape and the grid as chosen";
    chosen.warning.clear();
    return;
  }
  throw InvalidInput(fmt::format("{}: the array has {} views, not {}; leave out --grid",
                                 file.path().string(), grid_text(chosen.layout.grid()),
                                 grid_text(*wanted)));
}

std::vector<const ArrayEntry*> arrays_beside(const ArrayFile& file, const ArrayEntry& light_field) {
  std::vector<const ArrayEntry*> others;
  for (const ArrayEntry& each : file.entries()) {
    if (&each != &light_field) others.push_back(&each);
  }
  return others;
}

SceneProbe probe_single(const ArrayFile& file, const OpenOptions& options) {
  const ArrayEntry* entry = find_light_field(file, options.dataset, options.axes);
  if (!entry) throw NoLightField(file.path(), "no array of this file has the shape of one");
  const ArrayLayout layout = choose_layout(file, *entry, options.axes).layout;
  SceneProbe probe{.grid = layout.grid(),
                   .height = layout.height(),
                   .width = layout.width(),
                   .channels = layout.length('c') < 3 ? 1 : 3};
  if (layout.has('n')) {
    probe.list = probe.grid.count();
    probe.grid = given_grid(options).value_or(GridShape());
  }
  if (entry->type == NumberType::UInt8) probe.sample_type = SampleType::UInt8;
  if (entry->type == NumberType::UInt16) probe.sample_type = SampleType::UInt16;
  ListedMaps maps = list_array_maps(arrays_beside(file, *entry), {layout, entry->order});
  probe.truth = std::move(maps.disparity);
  probe.labels = std::move(maps.labels);
  return probe;
}

/// Of a map in a file of its own, beside a NumPy array or in its folder.
void note_truth_file(const ArrayFile& file, const std::string& name, ConventionReport& report) {
  const bool is_folder = fs::is_directory(file.path());
  if (!is_folder && suffix_of(file.path()) != ".npy") return;
  const fs::path folder = is_folder ? file.path() : file.path().parent_path();
  const fs::path map = folder / (name + ".npy");
  if (is_there(map)) report.truth_files.push_back(map);
}

// Reads a light field of one array step by step.
class SingleReading {
 public:
  SingleReading(const ArrayFile& file, const char* reader, const OpenOptions& options,
                const OtherArrays& more)
      : file_(file),
        options_(options),
        more_(more),
        entry_(light_field_of(file, options)),
        chosen_(choose_layout(file, entry_, options.axes)),
        array_(file.open(entry_)) {
    parts_.info = info_of(file, reader);
  }

  Scene read(const Progress& progress) {
    show_center();
    progress.check();
    check_layout(*array_, entry_.order, chosen_, progress.part(0, 0.05));
    fit_to_grid(file_, options_, chosen_);
    progress.step("reading views");
    read_views(progress.part(0.05, 0.65));
    progress.step("reading maps");
    read_maps(progress.part(0.65, 0.75));
    read_others(progress.part(0.75, 0.8));
    assemble(std::move(parts_), options_, scene_, progress.part(0.8, 1));
    if (report_.are_axes_unclear && !chosen_.warning.empty()) {
      report_.warnings.push_back(std::move(chosen_.warning));
    }
    return std::move(scene_);
  }

 private:
  void show_center() const {
    if (!options_.on_center_view || array_->is_sequential()) return;
    const GridShape grid = chosen_.layout.grid();
    options_.on_center_view(array_preview(*array_, chosen_.layout, grid.center()), parts_.info,
                            grid);
  }
  void read_views(const Progress& progress) {
    ArraySamples read = read_samples(*array_, chosen_.layout, progress);
    if (settle_range(read.samples, options_.levels, report_)) {
      report_.warnings.push_back(
          fmt::format(finding_text("samples.disparity"), file_.path().filename().string()));
    }
    if (!read.left_out.empty()) {
      report_.warnings.push_back(
          fmt::format(finding_text("samples.fourth"), entry_.name, read.left_out));
    }
    decode_luma_chroma(entry_.name, read.samples, report_);
    parts_.samples = std::move(read.samples);
    parts_.valid = std::move(read.valid);
  }
  void read_maps(const Progress& progress) {
    std::vector<const ArrayEntry*> others = arrays_beside(file_, entry_);
    std::erase_if(others,
                  [this](const ArrayEntry* each) { return more_.owns && more_.owns(*each); });
    ArrayMaps maps = read_array_maps(file_, others, {chosen_.layout, entry_.order},
                                     options_.needs_truth, progress.part(0, 0.5));
    std::ranges::move(maps.notes, std::back_inserter(report_.warnings));
    combine(parts_.valid, std::move(maps.valid));
    parts_.truth = std::move(maps.truth);
    if (chosen_.layout.has('n')) {
      const bool is_row = chosen_.layout.has(kSingle) && options_.axes.empty();
      const auto stored = is_row ? std::optional(chosen_.layout.grid()) : std::nullopt;
      arrange_list(file_.path(), options_, parts_, chosen_.reason, progress.part(0.5, 1), stored);
    }
    settle_disparity(parts_.samples, maps, parts_.truth.field, report_);
    if (!parts_.truth.field.empty()) {
      note_truth_file(file_, maps.disparity_name, report_);
      parts_.truth.estimated = file_.estimated(maps.disparity_name);
    }
    if (parts_.truth.estimated) {
      report_.warnings.push_back(
          fmt::format(finding_text("truth.estimated"), estimated_text(*parts_.truth.estimated)));
    }
    report_form(file_, entry_, chosen_, report_);
    parts_.files = std::move(maps.uses);
    parts_.files.insert(parts_.files.begin(), {"light field", 1, entry_.name, true});
    parts_.expected.is_truth_sign_assumed = maps.is_sign_assumed;
    parts_.expected.reason = finding_text("order.of_arrays");
  }
  void read_others(const Progress& progress) {
    if (more_.add) more_.add(parts_, report_, progress);
    const bool is_alone = !more_.is_in_memory && !fs::is_directory(file_.path());
    if (!parts_.truth.field.empty() || !is_alone) return;
    FileUsage account(file_.path());
    scene_.scribbles.labels =
        add_maps_named_after(file_.path(), options_, parts_, {account, report_}, progress);
    std::ranges::move(account.uses(), std::back_inserter(parts_.files));
  }

  const ArrayFile& file_;
  const OpenOptions& options_;
  const OtherArrays& more_;
  const ArrayEntry& entry_;
  ChosenLayout chosen_;
  std::unique_ptr<ArrayInput> array_;
  SceneParts parts_;
  Scene scene_;
  ConventionReport& report_ = scene_.convention;
};

/// What the shape of the light field of a file of arrays tells. Throws NoLightField if none of them
/// can be one; IoError, Undecided.
SceneProbe probe_arrays(const ArrayFile& file, const OpenOptions& options) {
  const auto several = MultiFieldFile::find(file, options);
  if (!several) {
    const auto colored = with_stacked_channels(file, options);
    return probe_single(colored ? *colored : file, options);
  }
  SceneProbe probe = probe_single(*several->one(file, several->index(file, options)), options);
  if (!several->is_named(options)) probe.frames = several->count();
  return probe;
}

}  // namespace

/// Reads the light field of a file of arrays, and the maps beside it; then, if given, what else
/// there is. A picture of the center view is given first. Throws IoError, InvalidInput for options
/// that do not fit, Cancelled.
Scene read_array_scene(const ArrayFile& file, const char* reader, const OpenOptions& options,
                       const Progress& progress, const OtherArrays& more = {}) {
  const auto several = MultiFieldFile::find(file, options);
  if (!several) {
    if (options.frame != 0) {
      throw InvalidInput(
          fmt::format("{} holds a single light field, but number {} was asked for; "
                      "leave out --frame",
                      file.path().string(), options.frame));
    }
    const auto colored = with_stacked_channels(file, options);
    return SingleReading(colored ? *colored : file, reader, options, more).read(progress);
  }
  const int index = several->index(file, options);
  Scene scene = SingleReading(*several->one(file, index), reader, options, {}).read(progress);
  if (!several->is_named(options)) scene.sequence = {index, several->count()};
  scene.convention.warnings.insert(scene.convention.warnings.begin(), several->text(index));
  return scene;
}

namespace {

template <class T>
void arrange(ViewStack<T>& stack, const ListLayout& layout) {
  if (stack.empty()) return;
  if (stack.grid().count() == 1) {
    ViewStack<T> center({1, 1}, stack.height(), stack.width(), stack.channels(),
                        layout.grid.center());
    std::copy_n(stack.data(), stack.size(), center.data());
    stack = std::move(center);
    return;
  }
  ViewStack<T> grid(layout.grid, stack.height(), stack.width(), stack.channels());
  for (int i = 0; i < layout.grid.count(); ++i) {
    std::copy_n(stack.view({0, i}).data, stack.view_size(), grid.view(layout.place(i)).data);
  }
  stack = std::move(grid);
}

}  // namespace

void arrange_list(const std::filesystem::path& path, const OpenOptions& options, SceneParts& parts,
                  std::string& reason, const Progress& progress, std::optional<GridShape> stored) {
  const int count =
      std::visit([](const auto& stack) { return stack.grid().count(); }, parts.samples);
  ListLayout layout;
  if (const auto given = given_grid(options)) {
    if (given->count() != count) {
      throw InvalidInput(
          fmt::format("{}: there are {} views, but a grid of {} has {}; state "
                      "another grid",
                      path.string(), count, grid_text(*given), given->count()));
    }
    layout.grid = *given;
    reason += fmt::format("; list of {} views, grid {} as chosen", count, grid_text(*given));
  } else {
    progress.step("arranging the views of the list");
    layout = find_list_layout(parts.samples, progress);
    if (!layout.is_decided && stored && stored->count() == count) {
      layout.grid = *stored;
      layout.order = ListOrder::Rows;
      layout.evidence = "as stored, for the views do not tell: " + layout.evidence;
    } else if (!layout.is_decided) {
      throw Undecided(path,
                      fmt::format("this is a list of {} views, and how they lie on a grid is "
                                  "not certain ({})",
                                  count, layout.evidence),
                      "grid", possible_grids(count));
    }
    reason +=
        fmt::format("; list of {} views, {}: {}", count, layout_text(layout), layout.evidence);
  }
  std::visit([&](auto& stack) { arrange(stack, layout); }, parts.samples);
  arrange(parts.valid, layout);
  arrange(parts.truth.field.disparity, layout);
  arrange(parts.truth.field.valid, layout);
  arrange(parts.truth.labels, layout);
}

namespace {

constexpr const char* kHdf5Reader = "hdf5";

/// Of three axes, with enough views to be no picture with channels.
bool is_list_of_views(const ArrayEntry& entry) {
  const ArrayShape& shape = entry.shape;
  return shape.size() == 3 && std::min(shape.front(), shape.back()) >= kFewestListed;
}

/// `[v][h][y][x]` or `[v][h][y][x][c]`, whose reader also explains what is wrong with it.
bool is_archive_form(const ArrayEntry& light_field) {
  if (can_be_stack(light_field)) return false;
  if (!can_be_light_field(light_field)) return true;
  const std::size_t axes = light_field.shape.size();
  const std::string& stated = light_field.stated_axes;
  if (axes == 4 && stated.empty()) {
    return possible_layouts(light_field.shape, light_field.order).front().axes == "vuyx";
  }
  if (axes != 5) return !is_list_of_views(light_field);
  const std::size_t last = light_field.shape.back();
  return (last == 1 || last == 3 || last == 4) && (stated.empty() || stated.starts_with("v,u,y,x"));
}

/// Maps and results have fewer axes, too, but no colors, and names that tell what they are.
bool is_like_views(const ArrayEntry& entry) {
  if (can_be_stack(entry)) return !has_other_name(entry);
  if (entry.is_of_views()) return !map_kind(telling_name(entry));
  if (!can_be_light_field(entry)) return false;
  if (entry.shape.size() >= 5) return true;
  if (has_light_field_name(entry)) return entry.shape.size() == 4 || is_list_of_views(entry);
  const bool is_list = entry.shape.size() == 4 && entry.shape.back() == 3;
  const bool is_grey = (entry.shape.size() == 4 || is_list_of_views(entry)) &&
                       entry.type == NumberType::UInt8 && entry.name != "SCRIBBLES";
  return (is_list || is_grey) && !map_kind(telling_name(entry)) && !has_other_name(entry);
}

bool is_meant(const fs::path& path, const OpenOptions& options) {
  if (!has_hdf5_signature(path)) return false;
  const auto file = std::make_shared<const Hdf5Input>(path);
  if (!options.dataset.empty() || !options.axes.empty()) return true;
  // Results, and what lies beside a light field of the archive.
  if (file->has("estimate")) return false;
  if (!archive_group(*file).empty()) return false;
  const bool is_beside = path.filename() != "lf.h5" && is_there(path.parent_path() / "lf.h5");
  const Hdf5Arrays arrays(file);
  const auto& entries = arrays.entries();
  const auto light_field = std::ranges::find(entries, "LF", &ArrayEntry::name);
  if (light_field != entries.end()) return !is_beside && !is_archive_form(*light_field);
  return std::ranges::any_of(entries, [&](const ArrayEntry& entry) {
    return is_like_views(entry) && (!is_beside || has_light_field_name(entry));
  });
}

fs::path find_hdf5_array(const fs::path& path, const OpenOptions& options) {
  if (!fs::is_directory(path)) return is_meant(path, options) ? path : fs::path();
  const fs::path file = only_file_in(path, has_hdf5_name);
  return !file.empty() && is_meant(file, options) ? file : fs::path();
}

/// Depth and camera of an archive file whose light field has other axes than the archive's, as
/// where MATLAB wrote it.
OtherArrays archive_depth(const Hdf5Input& file, const OpenOptions& options) {
  if (!file.has("GT_DEPTH") || !read_camera(file).is_known()) return {};
  const auto add = [&file, options](SceneParts& parts, ConventionReport& report,
                                    const Progress& progress) {
    const bool fits = holds_maps(file, "GT_DEPTH", field_shape(parts.samples));
    parts.files.push_back({kind_text(MapKind::Depth), 1, "GT_DEPTH", fits});
    if (!fits) return;
    ArchiveTruth truth = read_archive_depth(file, parts.samples, options, report, progress);
    parts.truth.field = std::move(truth.field);
    parts.info.camera = truth.camera;
    parts.expected = expected_order(file);
    parts.expected.are_axes_known = false;
  };
  return {[](const ArrayEntry& entry) { return entry.name.starts_with("GT_DEPTH"); }, add};
}

Scene read_hdf5_array(const fs::path& path, const OpenOptions& options, const Progress& progress) {
  const auto input = std::make_shared<const Hdf5Input>(path);
  return read_array_scene(Hdf5Arrays(input), kHdf5Reader, options, progress,
                          archive_depth(*input, options));
}

constexpr const char* kMatlabReader = "matlab";

bool has_mat_name(const fs::path& path) {
  return suffix_of(path) == ".mat";
}

fs::path find_matlab(const fs::path& path, const OpenOptions&) {
  if (fs::is_directory(path)) return only_file_in(path, has_mat_name);
  if (has_mat_name(path) || is_mat5_file(path)) return path;
  return has_hdf5_signature(path) && is_matlab_hdf5(Hdf5Input(path)) ? path : fs::path();
}

}  // namespace

Reader hdf5_array_reader() {
  return {.id = kHdf5Reader,
          .name = "an array of an HDF5 file",
          .options = kArrayOptions,
          .find = find_hdf5_array,
          .read = read_hdf5_array,
          .probe = [](const fs::path& path, const OpenOptions& options) {
            return probe_arrays(Hdf5Arrays(std::make_shared<const Hdf5Input>(path)), options);
          }};
}

Reader matlab_reader() {
  return {.id = kMatlabReader,
          .name = "a MATLAB file",
          .options = kArrayOptions,
          .find = find_matlab,
          .read =
              [](const fs::path& path, const OpenOptions& options, const Progress& progress) {
                return read_array_scene(*open_matlab_file(path), kMatlabReader, options, progress);
              },
          .probe =
              [](const fs::path& path, const OpenOptions& options) {
                return probe_arrays(*open_matlab_file(path), options);
              }};
}

namespace {

constexpr const char* kNumpyReader = "numpy";

/// Of the `.npy` files of a folder, most hold maps.
bool can_hold_views(const fs::path& path) {
  const std::string suffix = suffix_of(path);
  if (suffix == ".npz") return true;
  if (suffix != ".npy" || map_kind(path.stem().string())) return false;
  try {
    return NpyFile(path).shape().size() > 3;
  } catch (const IoError&) {
    return false;
  }
}

fs::path find_numpy(const fs::path& path, const OpenOptions&) {
  if (fs::is_directory(path)) {
    fs::path only = only_file_in(path, can_hold_views);
    return only.empty() && is_folder_of_views(path) ? path : only;
  }
  return is_numpy_file(path) ? path : fs::path();
}

}  // namespace

Scene read_arrays(const ArrayFile& file, const OpenOptions& options, const Progress& progress) {
  return read_array_scene(file, kNumpyReader, options, progress, {.is_in_memory = true});
}

Reader numpy_reader() {
  return {
      .id = kNumpyReader,
      .name = "a NumPy array",
      .options = kArrayOptions,
      .find = find_numpy,
      .read =
          [](const fs::path& path, const OpenOptions& options, const Progress& progress) {
            return read_array_scene(NumpyFile(path), kNumpyReader, options, progress);
          },
      .probe = [](const fs::path& path,
                  const OpenOptions& options) { return probe_arrays(NumpyFile(path), options); }};
}

}  // namespace episcope::io
