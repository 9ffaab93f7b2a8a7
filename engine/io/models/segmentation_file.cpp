// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/segmentation_file.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/core/version.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/base/json.h"
#include "engine/io/models/result_file.h"
#include "engine/io/models/scribble_file.h"
#include "engine/io/models/stored_maps.h"

#include <algorithm>
#include <cmath>

namespace episcope::io {
namespace {

constexpr const char* kLabels = "LABELS";
constexpr const char* kProbabilityDataset = "Probabilities";
constexpr int kLongestSegmentSide = 1 << 15;  ///< In views or px: the number of views is an int.

std::size_t label_count(const StoredSegmentation& labeling) {
  return labeling.infos.size();
}

std::uintmax_t segmentation_bytes(const StoredSegmentation& labeling, bool with_probabilities) {
  const std::uintmax_t bytes = labeling.labels.size() * sizeof(std::int32_t) + (1 << 16);
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
  write_stack(file, kLabels, labeling.labels, "", progress.part(0, 0.2));
  add_label_list(file, kLabels, labeling.infos);
  if (probabilities) {
    write_probabilities(file, labeling, probabilities, progress.part(0.2, 1));
  }
  write_provenance(file, labeling);
  file.close();
  progress.check();
  target.commit();
}

struct SegmentationFile::State {
  explicit State(const std::filesystem::path& path) : file(path) {}

  Hdf5Input file;
  Hdf5Shape shape;
  std::vector<LabelInfo> infos;
  GridShape grid{1, 1};
  ViewIndex first;

  [[nodiscard]] bool has_views() const { return shape.size() == 4; }
  [[nodiscard]] int height() const { return static_cast<int>(shape[shape.size() - 2]); }
  [[nodiscard]] int width() const { return static_cast<int>(shape.back()); }
  [[nodiscard]] ViewIndex place(ViewIndex view) const {
    return {view.v - first.v, view.u - first.u};
  }

  void require_sides() const {
    const bool is_sound = std::ranges::all_of(
        shape, [](std::size_t side) { return side > 0 && side <= kLongestSegmentSide; });
    if (is_sound) return;
    throw IoError(file.path(), "the dataset LABELS has the shape " + shape_text(shape) +
                                   ", but sides of 1 to " + std::to_string(kLongestSegmentSide) +
                                   " are expected; write it again");
  }
  void read_first() {
    const std::vector<double> stated = file.numbers(kLabels, "first_view");
    if (stated.size() != 2) return;
    first = {whole_int(stated[0]).value_or(-1), whole_int(stated[1]).value_or(-1)};
    constexpr int last = kLongestSegmentSide;
    if (first.v >= 0 && first.v <= last && first.u >= 0 && first.u <= last) return;
    throw IoError(file.path(), "the attribute first_view of LABELS names no view; write it again");
  }
};

SegmentationFile::SegmentationFile(const std::filesystem::path& path)
    : state_(std::make_unique<State>(path)) {
  State& state = *state_;
  state.shape = state.file.dataset(kLabels).shape;
  if (state.shape.size() != 2 && state.shape.size() != 4) {
    throw IoError(path, "the dataset LABELS has the shape " + shape_text(state.shape) +
                            ", but 2 or 4 axes are expected; write it again");
  }
  state.require_sides();
  if (state.has_views()) {
    state.grid = {static_cast<int>(state.shape[0]), static_cast<int>(state.shape[1])};
  }
  state.read_first();
  state.infos = read_label_list(state.file, kLabels);
}

SegmentationFile::~SegmentationFile() = default;

GridShape SegmentationFile::grid() const {
  return state_->grid;
}

ViewIndex SegmentationFile::first() const {
  return state_->first;
}

bool SegmentationFile::contains(ViewIndex view) const {
  return state_->grid.contains(state_->place(view));
}

const std::vector<LabelInfo>& SegmentationFile::infos() const {
  return state_->infos;
}

bool SegmentationFile::has_probabilities() const {
  const State& state = *state_;
  if (!state.file.has(kProbabilityDataset)) return false;
  Hdf5Shape expected = state.shape;
  expected.push_back(state.infos.size());
  return state.file.dataset(kProbabilityDataset).shape == expected;
}

Image<std::int32_t> SegmentationFile::labels(ViewIndex view) const {
  const State& state = *state_;
  Image<std::int32_t> labels(state.height(), state.width());
  state.file.read(kLabels, block_of(state.shape, state.place(view), state.has_views()),
                  labels.data());
  return labels;
}

Image<float> SegmentationFile::probabilities(ViewIndex view) const {
  const State& state = *state_;
  Hdf5Shape shape = state.shape;
  shape.push_back(state.infos.size());
  Image<float> samples(state.height(), state.width(), static_cast<int>(state.infos.size()));
  state.file.read(kProbabilityDataset, block_of(shape, state.place(view), state.has_views()),
                  samples.data());
  return samples;
}

std::string SegmentationFile::source() const {
  return state_->file.text("/", "source").value_or("");
}

Reading SegmentationFile::reading() const {
  return reading_in(state_->file, "/");
}

bool is_segmentation_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored) || !has_hdf5_signature(path)) return false;
  const Hdf5Input file(path);
  return file.has(kLabels) && !file.has("LF") && !file.has("SCRIBBLES") && !file.has(kTrueLabels);
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
