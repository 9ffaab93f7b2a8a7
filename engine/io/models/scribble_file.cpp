// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/scribble_file.h"

#include "engine/core/error.h"
#include "engine/core/hash.h"
#include "engine/core/numbers.h"
#include "engine/core/shear.h"
#include "engine/core/version.h"
#include "engine/io/base/json.h"
#include "engine/io/models/result_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScribbles = "SCRIBBLES";
constexpr const char* kOwner = "light_field";

FieldShape shape_of(const Scene& scene) {
  const LightField& field = *scene.light_field;
  return {field.grid(), field.height(), field.width()};
}

/// With the views that were left out on opening.
FieldShape stored_shape_of(const Scene& scene) {
  FieldShape shape = shape_of(scene);
  if (scene.convention.crop.leaves_out()) shape.grid = scene.convention.crop.stored;
  return shape;
}

/// Name of the light-field file, if it is one that labels may lie beside.
std::string owner_name(const Scene& scene) {
  const fs::path source = scene.light_field->info().source;
  std::error_code ignored;
  return fs::is_regular_file(source, ignored) ? source.filename().string() : std::string();
}

/// What must stay of the file that is there; empty if there is none.
std::unique_ptr<Hdf5Input> open_former(const fs::path& path, const Scene& scene) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return nullptr;
  auto former = std::make_unique<Hdf5Input>(path);
  if (former->has("LF")) {
    throw IoError(path,
                  "this file holds a light field and is not overwritten; save scribbles beside it, "
                  "for example as labels.h5");
  }
  const auto owner = former->text("/", kOwner);
  const std::string name = owner_name(scene);
  if (owner && !name.empty() && *owner != name) {
    throw IoError(path, "these labels belong to the light field " + *owner + ", not to " + name +
                            "; choose another name");
  }
  return former;
}

void require_fitting(const fs::path& path, const Scribbles& scribbles, const FieldShape& shape) {
  for (const auto& [view, labels] : scribbles.views) {
    if (shape.grid.contains(view) && labels.height() == shape.height &&
        labels.width() == shape.width) {
      continue;
    }
    throw IoError(path, fmt::format("scribbles of {}×{} px on view ({}) do not fit the light field "
                                    "of {}×{} views of {}×{} px; open the one that they belong to",
                                    labels.width(), labels.height(), view_text(view), shape.grid.v,
                                    shape.grid.u, shape.width, shape.height));
  }
}

std::uintmax_t scribble_bytes(const Scribbles& scribbles, const FieldShape& shape,
                              const fs::path& former) {
  std::error_code error;
  const std::uintmax_t kept = fs::file_size(former, error);
  const int views = scribbles.views.size() > 1 ? shape.grid.count() : 1;
  return (error ? 0 : kept) +
         static_cast<std::uintmax_t>(views) * shape.height * shape.width +  // deflated
         (1 << 16);
}

/// In canonical order, on all views as they are stored.
Scribbles read_stored_scribbles(const Hdf5Input& file, const Scene& scene,
                                const Progress& progress) {
  const FieldShape shape = stored_shape_of(scene);
  StoredScribbles stored =
      read_scribble_dataset(file, shape, scene.convention.raised_labels, progress);
  put_in_order(stored.scribbles, shape.grid, flip_of(scene.convention));
  return std::move(stored.scribbles);
}

/// On the views of the scene, as these are stored.
Scribbles read_unmoved(const Hdf5Input& file, const Scene& scene, const Progress& progress) {
  Scribbles stored = read_stored_scribbles(file, scene, progress);
  const ViewCrop& crop = scene.convention.crop;
  return crop.leaves_out() ? cropped(std::move(stored), crop) : stored;
}

/// As they belong on the views as they are stored, where `former` may have more.
Scribbles put_back(const Scribbles& scribbles, const Hdf5Input* former, const Scene& scene,
                   const Progress& progress) {
  const bool has_more = former && former->has(kScribbles);
  const auto before = [&](auto& read) {
    return has_more ? read(*former, scene, progress) : Scribbles();
  };
  const ViewCrop& crop = scene.convention.crop;
  Scribbles unmoved = unsheared(scribbles, before(read_unmoved), scene.light_field->center(),
                                scene.convention.focus_px);
  return crop.leaves_out() ? uncropped(std::move(unmoved), before(read_stored_scribbles), crop)
                           : unmoved;
}

}  // namespace

Scribbles read_scribbles(const fs::path& path, const Scene& scene, const Progress& progress) {
  Scribbles stored = read_unmoved(Hdf5Input(path), scene, progress);
  const double focus_px = scene.convention.focus_px;
  return focus_px == 0 ? std::move(stored) : sheared(stored, scene.light_field->center(), focus_px);
}

void write_scribbles(const fs::path& path, const Scribbles& scribbles, const Scene& scene,
                     const Progress& progress) {
  progress.check();
  require_fitting(path, scribbles, shape_of(scene));
  const FieldShape shape = stored_shape_of(scene);
  const std::unique_ptr<Hdf5Input> former = open_former(path, scene);
  const bool is_as_stored = scene.convention.focus_px == 0 && !scene.convention.crop.leaves_out();
  const Scribbles moved =
      is_as_stored ? Scribbles() : put_back(scribbles, former.get(), scene, progress);
  const Scribbles& stored = is_as_stored ? scribbles : moved;
  AtomicFile target(path, scribble_bytes(stored, shape, path));
  Hdf5Output file(target);
  const std::string owner = owner_name(scene);
  if (former) {
    file.copy_all(*former, {kScribbles, "scribble_view"});
  } else if (!owner.empty()) {
    file.set_text("/", kOwner, owner);
  }
  const bool raises_labels = former && former->has(kTrueLabels) && scene.convention.raised_labels;
  add_scribbles(file, stored, {shape, flip_of(scene.convention), raises_labels}, progress);
  file.close();
  progress.check();
  target.commit();
}

namespace {

using LabelSamples = std::function<const std::int32_t*(ViewIndex)>;

template <class T>
void write_narrowed(Hdf5Output& file, const std::string& name, const MapGeometry& maps,
                    const Progress& progress, const LabelSamples& samples) {
  std::vector<T> narrowed(static_cast<std::size_t>(maps.height) * maps.width);
  write_maps<T>(file, name, maps, "", progress, [&](ViewIndex view) {
    const std::int32_t* labels = samples(view);
    std::transform(labels, labels + narrowed.size(), narrowed.begin(),
                   [](std::int32_t label) { return static_cast<T>(label); });
    return narrowed.data();
  });
}

}  // namespace

void write_label_maps(Hdf5Output& file, const std::string& name, const MapGeometry& maps,
                      const Progress& progress, const LabelSamples& samples) {
  const std::size_t size = static_cast<std::size_t>(maps.height) * maps.width;
  std::int32_t least = 0, most = 0;
  for (int i = 0; i < maps.grid.count(); ++i) {
    progress.check();
    const std::int32_t* labels = samples(maps.grid.view_at(i, maps.first));
    const auto [low, high] = std::minmax_element(labels, labels + size);
    least = std::min(least, *low);
    most = std::max(most, *high);
  }
  file.set_storage(Hdf5Storage::Deflated);
  if (least >= 0 && most <= std::numeric_limits<std::uint8_t>::max()) {
    write_narrowed<std::uint8_t>(file, name, maps, progress, samples);
  } else if (least >= 0 && most <= std::numeric_limits<std::uint16_t>::max()) {
    write_narrowed<std::uint16_t>(file, name, maps, progress, samples);
  } else {
    write_maps<std::int32_t>(file, name, maps, "", progress, samples);
  }
  file.set_storage(Hdf5Storage::Plain);
}

void write_label_maps(Hdf5Output& file, const std::string& name,
                      const ViewStack<std::int32_t>& labels, const Progress& progress) {
  write_label_maps(file, name, geometry_of(labels), progress,
                   [&](ViewIndex view) { return labels.view(view).data; });
}

namespace {

struct Census {
  std::size_t zeros = 0;
  std::size_t nones = 0;  ///< −1 or 255.
  std::size_t painted = 0;
};

bool is_none(std::int32_t label) {
  return label == -1 || label == 255;
}

void count(const Image<std::int32_t>& labels, Census& census) {
  for (const std::int32_t label : labels) {
    if (label == 0) {
      ++census.zeros;
    } else if (is_none(label)) {
      ++census.nones;
    } else {
      ++census.painted;
    }
  }
}

/// A view of nothing but one value that means "none" somewhere is not painted.
bool is_painted(const Image<std::int32_t>& labels) {
  Census census;
  count(labels, census);
  return census.painted > 0 || (census.zeros > 0 && census.nones > 0);
}

ViewIndex stated_view(const Hdf5Input& file, const FieldShape& shape, ViewIndex otherwise) {
  const std::vector<double> stated = file.numbers("/", "scribble_view");
  if (stated.size() != 2) return otherwise;
  const ViewIndex view{whole_int(stated[0]).value_or(-1), whole_int(stated[1]).value_or(-1)};
  if (!shape.grid.contains(view)) {
    throw IoError(file.path(), fmt::format("the attribute scribble_view names view ({}, {}), which "
                                           "the light field does not have; correct it",
                                           view.v, view.u));
  }
  return view;
}

std::vector<ViewScribbles> read_views(const Hdf5Input& file, const FieldShape& shape,
                                      const Progress& progress) {
  const ViewStack<std::int32_t> stack = read_maps<std::int32_t>(file, kScribbles, shape, progress);
  std::vector<ViewScribbles> views;
  for (int i = 0; i < stack.grid().count(); ++i) {
    const ViewIndex view = stack.view_at(i);
    Image<std::int32_t> labels(shape.height, shape.width);
    std::copy_n(stack.view(view).data, labels.size(), labels.data());
    views.push_back({view, std::move(labels)});
  }
  if (views.size() == 1) views[0].view = stated_view(file, shape, views[0].view);
  return views;
}

/// Ids of other programs. Returns whether they were raised.
bool decode(std::vector<ViewScribbles>& views, bool has_label_zero) {
  std::erase_if(views, [](const ViewScribbles& one) { return !is_painted(one.labels); });
  Census census;
  for (const ViewScribbles& one : views) count(one.labels, census);
  const bool is_zero_a_label = census.zeros > 0 && census.nones > census.zeros && has_label_zero;
  for (ViewScribbles& one : views) {
    for (std::int32_t& label : one.labels) {
      if (is_none(label)) {
        label = 0;
      } else if (is_zero_a_label) {
        raise_label(label);
      }
    }
  }
  return is_zero_a_label;
}

}  // namespace

StoredScribbles read_scribble_dataset(const Hdf5Input& file, const FieldShape& shape,
                                      bool has_label_zero, const Progress& progress) {
  StoredScribbles stored;
  std::vector<ViewScribbles>& views = stored.scribbles.views;
  views = read_views(file, shape, progress);
  if (const auto unpainted = file.number(kScribbles, "unpainted")) {
    const std::int32_t none = whole_int(*unpainted).value_or(0);
    for (ViewScribbles& one : views) std::ranges::replace(one.labels, none, 0);
    stored.raises_labels = file.number(kScribbles, "raises_labels").value_or(0) != 0;
  } else {
    stored.raises_labels = decode(views, has_label_zero);
  }
  std::erase_if(views, [](const ViewScribbles& one) {
    return std::ranges::all_of(one.labels, [](std::int32_t label) { return label == 0; });
  });
  stored.scribbles.labels = read_label_list(file, kScribbles);
  return stored;
}

void put_in_order(Scribbles& scribbles, GridShape grid, ViewFlip flip) {
  for (ViewScribbles& one : scribbles.views) one.view = flipped(one.view, grid, flip);
  std::ranges::sort(scribbles.views, {},
                    [](const ViewScribbles& one) { return std::pair(one.view.v, one.view.u); });
}

void add_scribbles(Hdf5Output& file, const Scribbles& scribbles, const ScribblePlace& place,
                   const Progress& progress) {
  const FieldShape& shape = place.shape;
  const Image<std::int32_t> bare(shape.height, shape.width);
  const bool has_many = scribbles.views.size() > 1;
  MapGeometry maps{{1, 1}, shape.grid.center(), shape.height, shape.width};
  if (has_many) maps = {shape.grid, {}, shape.height, shape.width};
  if (scribbles.views.size() == 1) {
    maps.first = flipped(scribbles.views[0].view, shape.grid, place.flip);
  }
  write_label_maps(file, kScribbles, maps, progress, [&](ViewIndex stored) {
    const auto painted = std::ranges::find(scribbles.views, flipped(stored, shape.grid, place.flip),
                                           &ViewScribbles::view);
    return painted == scribbles.views.end() ? bare.data() : painted->labels.data();
  });
  if (!has_many) file.set_integers("/", "scribble_view", {maps.first.v, maps.first.u});
  file.set_integers(kScribbles, "unpainted", {0});
  if (place.raises_labels) file.set_integers(kScribbles, "raises_labels", {1});
  add_label_list(file, kScribbles, scribbles.labels);
}

ViewStack<std::int32_t> read_true_labels(const std::filesystem::path& path, const Scene& scene,
                                         const Progress& progress) {
  const Hdf5Input file(path);
  const LightField& field = *scene.light_field;
  const ViewCrop& crop = scene.convention.crop;
  const FieldShape shape = stored_shape_of(scene);
  auto labels = read_maps<std::int32_t>(file, kTrueLabels, shape, progress);
  if (scene.convention.raised_labels) {
    std::for_each(labels.data(), labels.data() + labels.size(), raise_label);
  }
  reverse_views(labels, shape.grid, flip_of(scene.convention));
  if (crop.leaves_out()) labels = cropped(std::move(labels), crop);
  const double focus_px = scene.convention.focus_px;
  return focus_px == 0 ? std::move(labels) : sheared(labels, field.center(), focus_px, progress);
}

std::vector<fs::path> label_files_of(const fs::path& file) {
  std::vector<fs::path> files;
  const fs::path folder = file.parent_path();
  if (file.filename() != "lf.h5") files.push_back(folder / (file.stem().string() + "_labels.h5"));
  files.push_back(folder / "labels.h5");
  return files;
}

fs::path labels_beside(const fs::path& file) {
  const std::vector<fs::path> files = label_files_of(file);
  if (files.size() == 1 || !has_hdf5_signature(files.front())) return files.back();
  try {
    const Hdf5Input labels(files.front());
    const bool has_labels = labels.has(kTrueLabels) || labels.has(kScribbles);
    return has_labels ? files.front() : files.back();
  } catch (const IoError&) {
    return files.back();  // damaged
  }
}

std::vector<LabelInfo> read_label_list(const Hdf5Input& file, const std::string& dataset) {
  constexpr std::size_t kColorChannels = 3;
  const std::vector<double> ids = file.numbers(dataset, "label_ids");
  const std::vector<double> colors = file.numbers(dataset, "label_colors");
  std::istringstream names(file.text(dataset, "label_names").value_or(""));
  if (colors.size() != ids.size() * kColorChannels) return {};
  std::vector<LabelInfo> labels;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    LabelInfo label;
    const auto id = whole_int(ids[i]);
    if (!id || !std::getline(names, label.name)) return {};
    label.id = *id;
    for (std::size_t c = 0; c < kColorChannels; ++c) {
      const int level = whole_int(colors[i * kColorChannels + c]).value_or(0);
      label.color[c] = static_cast<std::uint8_t>(std::clamp(level, 0, 255));
    }
    labels.push_back(std::move(label));
  }
  return labels;
}

void add_label_list(Hdf5Output& file, const std::string& dataset,
                    const std::vector<LabelInfo>& labels) {
  if (labels.empty()) return;
  std::vector<int> ids;
  std::vector<int> colors;
  std::string names;
  for (const LabelInfo& label : labels) {
    ids.push_back(label.id);
    colors.insert(colors.end(), label.color.begin(), label.color.end());
    names += label.name + "\n";
  }
  file.set_integers(dataset, "label_ids", ids);
  file.set_integers(dataset, "label_colors", colors);
  file.set_text(dataset, "label_names", names);
}

namespace {

constexpr const char* kLabels = "LABELS";
constexpr const char* kProbabilityDataset = "Probabilities";
constexpr int kLongestSegmentSide = 1 << 15;  ///< In views or px: the number of views is an int.

std::size_t label_count(const StoredSegmentation& labeling) {
  return labeling.infos.size();
}

std::uintmax_t segmentation_bytes(const StoredSegmentation& labeling, bool with_probabilities) {
  const std::uintmax_t bytes = labeling.labels.size() + (1 << 16);  // deflated
  if (!with_probabilities) return bytes;
  return bytes + labeling.labels.size() * label_count(labeling) * sizeof(float);
}

/// The block of a dataset that a view of the stack takes.
Hdf5Block block_of(const Hdf5Shape& shape, ViewIndex place, bool has_views) {
  return has_views ? view_block(shape, place) : Hdf5Block{Hdf5Shape(shape.size(), 0), shape};
}

void write_probabilities(Hdf5Output& file, const StoredSegmentation& labeling,
                         const ViewProbabilities& probabilities, const Progress& progress) {
  const ViewStack<std::int32_t>& labels = labeling.labels;
  const GridShape grid = labels.grid();
  Hdf5Shape shape = map_shape(grid, labels.height(), labels.width());
  shape.push_back(label_count(labeling));
  file.add_dataset<float>(kProbabilityDataset, shape, std::string(map_axes(grid)) + ",label", "");
  Image<float> samples(labels.height(), labels.width(), static_cast<int>(label_count(labeling)));
  for (int i = 0; i < grid.count(); ++i) {
    progress.check();
    const ViewIndex place = grid.view_at(i);
    fill_samples(probabilities({labels.first().v + place.v, labels.first().u + place.u}), samples);
    file.write(kProbabilityDataset, block_of(shape, place, grid.count() > 1), samples.data());
    progress.report((i + 1.0) / grid.count());
  }
}

void write_provenance(Hdf5Output& file, const StoredSegmentation& labeling) {
  file.set_text("/", "parameters", parameters_to_json(labeling.parameters));
  file.set_text("/", "source", labeling.source);
  file.set_text("/", "version", kVersion);
  file.set_number("/", "seconds", labeling.seconds);
  write_reading(file, "/", labeling.reading);
  if (labeling.sources_hash != 0) {
    file.set_text("/", kSourcesHash, hash_digits(labeling.sources_hash));
    file.set_text("/", kSourcesHashOf,
                  "FNV-1a of 64 bits over strokes, and over disparity or probabilities if given");
  }
  const ViewIndex first = labeling.labels.first();
  file.set_integers(kLabels, "first_view", {first.v, first.u});
}

}  // namespace

void write_segmentation(const std::filesystem::path& path, const StoredSegmentation& labeling,
                        const ViewProbabilities& probabilities, const Progress& progress) {
  if (labeling.labels.empty()) {
    throw InvalidInput("a segmentation without labels cannot be written");
  }
  progress.check();
  AtomicFile target(path, segmentation_bytes(labeling, static_cast<bool>(probabilities)));
  Hdf5Output file(target);
  write_label_maps(file, kLabels, labeling.labels, progress.part(0, 0.2));
  add_label_list(file, kLabels, labeling.infos);
  if (probabilities) {
    write_probabilities(file, labeling, probabilities, progress.part(0.2, 1));
  }
  write_provenance(file, labeling);
  file.close();
  progress.check();
  target.commit();
}

SegmentationFile::SegmentationFile(const std::filesystem::path& path) : file_(path) {
  shape_ = file_.dataset(kLabels).shape;
  require_sound_shape();
  if (shape_.size() == 4) grid_ = {static_cast<int>(shape_[0]), static_cast<int>(shape_[1])};
  read_first();
  infos_ = read_label_list(file_, kLabels);
}

void SegmentationFile::require_sound_shape() const {
  const auto refused = [&](const std::string& why) {
    return IoError(file_.path(), "the dataset LABELS has the shape " + shape_text(shape_) +
                                     ", but " + why + " are expected; write it again");
  };
  if (shape_.size() != 2 && shape_.size() != 4) throw refused("2 or 4 axes");
  const bool is_sound = std::ranges::all_of(
      shape_, [](std::size_t side) { return side > 0 && side <= kLongestSegmentSide; });
  if (!is_sound) throw refused("sides of 1 to " + std::to_string(kLongestSegmentSide));
}

void SegmentationFile::read_first() {
  const std::vector<double> stated = file_.numbers(kLabels, "first_view");
  if (stated.size() != 2) return;
  first_ = {whole_int(stated[0]).value_or(-1), whole_int(stated[1]).value_or(-1)};
  constexpr int last = kLongestSegmentSide;
  if (first_.v >= 0 && first_.v <= last && first_.u >= 0 && first_.u <= last) return;
  throw IoError(file_.path(), "the attribute first_view of LABELS names no view; write it again");
}

bool SegmentationFile::has_probabilities() const {
  if (!file_.has(kProbabilityDataset)) return false;
  Hdf5Shape expected = shape_;
  expected.push_back(infos_.size());
  return file_.dataset(kProbabilityDataset).shape == expected;
}

Image<std::int32_t> SegmentationFile::labels(ViewIndex view) const {
  Image<std::int32_t> labels(height(), width());
  file_.read(kLabels, block_of(shape_, place(view), shape_.size() == 4), labels.data());
  return labels;
}

Image<float> SegmentationFile::probabilities(ViewIndex view) const {
  Hdf5Shape shape = shape_;
  shape.push_back(infos_.size());
  Image<float> samples(height(), width(), static_cast<int>(infos_.size()));
  file_.read(kProbabilityDataset, block_of(shape, place(view), shape_.size() == 4), samples.data());
  return samples;
}

Reading SegmentationFile::reading() const {
  return reading_in(file_, "/");
}

bool is_segmentation_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored) || !has_hdf5_signature(path)) return false;
  const Hdf5Input file(path);
  return file.has(kLabels) && !file.has("LF") && !file.has(kScribbles) && !file.has(kTrueLabels);
}

void fill_samples(VolumeView<const std::uint8_t> probabilities, Image<float>& samples) {
  const int labels = probabilities.layers;
  for (int y = 0; y < probabilities.height; ++y) {
    for (int l = 0; l < labels; ++l) {
      const std::uint8_t* in = probabilities.row(y, l);
      float* out = samples.row(y) + l;
      for (int x = 0; x < probabilities.width; ++x) {
        out[static_cast<std::ptrdiff_t>(x) * labels] = in[x] * (1.0F / 255);
      }
    }
  }
}

Volume<std::uint8_t> bytes_of(const Image<float>& samples) {
  Volume<std::uint8_t> map(samples.height(), samples.channels(), samples.width());
  for (int y = 0; y < samples.height(); ++y) {
    for (int l = 0; l < samples.channels(); ++l) {
      std::uint8_t* out = map.view().row(y, l);
      for (int x = 0; x < samples.width(); ++x) {
        const float sample = samples.at(y, x, l);
        const float bounded = std::isnan(sample) ? 0.0F : std::clamp(sample, 0.0F, 1.0F);
        out[x] = static_cast<std::uint8_t>(std::lround(bounded * 255));
      }
    }
  }
  return map;
}

}  // namespace episcope::io
