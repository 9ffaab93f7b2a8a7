// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/archive_companions.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/io/base/hdf5_output.h"
#include "engine/io/models/stored_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace episcope::io {

namespace {

struct KnownFile {
  const char* file;
  CompanionKind kind;
  const char* dataset;
};

constexpr const char* kEdgeWeights = "EDGE_WEIGHTS";
constexpr const char* kProbabilityData = "Probabilities";

constexpr std::array kKnownFiles{
    KnownFile{"edge_weights.h5", CompanionKind::EdgeProbabilities, kEdgeWeights},
    KnownFile{"feature_single_view_probabilities.h5", CompanionKind::ImageProbabilities,
              kProbabilityData},
    KnownFile{"feature_depth_probabilities.h5", CompanionKind::DepthProbabilities,
              kProbabilityData},
    KnownFile{"feature_gt_depth_probabilities.h5", CompanionKind::TrueDepthProbabilities,
              kProbabilityData}};

Hdf5Shape view_shape(const LightField& field) {
  return {static_cast<std::size_t>(field.height()), static_cast<std::size_t>(field.width())};
}

Hdf5Shape stack_shape(const LightField& field) {
  const Hdf5Shape view = view_shape(field);
  return {static_cast<std::size_t>(field.grid().v), static_cast<std::size_t>(field.grid().u),
          view[0], view[1]};
}

/// The axis left besides the axes of views and pixels.
std::optional<std::size_t> label_axis(const Hdf5Shape& shape, const LightField& field) {
  for (std::size_t axis = shape.size(); axis-- > 0;) {
    Hdf5Shape others = shape;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(axis));
    if (others == view_shape(field) || others == stack_shape(field)) return axis;
  }
  return std::nullopt;
}

/// Throws IoError if the dataset does not fit the light field.
void require_fit(const std::filesystem::path& path, const std::string& dataset,
                 const Hdf5Shape& shape, const LightField& field) {
  const bool is_weights = dataset == kEdgeWeights;
  const Hdf5Shape plain = stack_shape(field);
  Hdf5Shape directed = plain;
  directed.push_back(2);
  const bool fits =
      is_weights ? shape == plain || shape == directed : label_axis(shape, field).has_value();
  if (fits) return;
  throw IoError(
      path,
      "the dataset " + dataset + " has the shape " + shape_text(shape) + ", but " +
          shape_text(plain) +
          (is_weights
               ? " is expected to fit the light field; store it in this form"
               : " or one view with one more axis of labels is expected; store it in this form"));
}

}  // namespace

std::vector<Companion> find_companions(const std::filesystem::path& folder, const LightField& field,
                                       ConventionReport& report) {
  std::vector<Companion> found;
  for (const KnownFile& known : kKnownFiles) {
    const std::filesystem::path path = folder / known.file;
    if (!has_hdf5_signature(path)) continue;
    try {
      const Hdf5Input file(path);
      if (!file.has_numbers(known.dataset)) continue;
      const Hdf5Shape shape = file.dataset(known.dataset).shape;
      require_fit(path, known.dataset, shape, field);
      found.push_back({known.kind, path, shape_text(shape)});
    } catch (const IoError& error) {
      // An unreadable companion must not prevent the light field from opening.
      report.warnings.push_back(
          fmt::format(finding_text("companion.ignored"), companion_name(known.kind), error.what()));
    }
  }
  return found;
}

ViewStack<float> read_edge_probabilities(const std::filesystem::path& path, const Scene& scene,
                                         const Progress& progress) {
  const Hdf5Input file(path);
  const LightField& field = *scene.light_field;
  const Hdf5Shape shape = file.dataset(kEdgeWeights).shape;
  require_fit(path, kEdgeWeights, shape, field);
  const bool is_plain = shape == stack_shape(field);
  const GridShape grid = field.grid();
  ViewStack<float> weights(grid, field.height(), field.width(), is_plain ? 1 : 2);
  for (int i = 0; i < grid.count(); ++i) {
    progress.check();
    const ViewIndex stored = grid.view_at(i);
    file.read(kEdgeWeights, view_block(shape, stored),
              weights.view(flipped(stored, grid, flip_of(scene.convention))).data);
    progress.report((i + 1.0) / grid.count());
  }
  return weights;
}

void write_edge_probabilities(const std::filesystem::path& path, const ViewStack<float>& weights,
                              const Scene& scene, const Progress& progress) {
  progress.check();
  const LightField& field = *scene.light_field;
  const Hdf5Shape shape{
      static_cast<std::size_t>(weights.grid().v), static_cast<std::size_t>(weights.grid().u),
      static_cast<std::size_t>(weights.height()), static_cast<std::size_t>(weights.width())};
  if (weights.channels() != 1 || shape != stack_shape(field)) {
    throw IoError(path, "edge weights of the shape " + shape_text(shape) +
                            " do not fit the light field of " + shape_text(stack_shape(field)) +
                            "; write those of all its views");
  }
  AtomicFile target(path, weights.size() * sizeof(float) + (1 << 16));
  Hdf5Output file(target);
  write_maps<float>(
      file, kEdgeWeights, geometry_of(weights), "probability", progress, [&](ViewIndex stored) {
        return weights.view(flipped(stored, field.grid(), flip_of(scene.convention))).data;
      });
  file.close();
  progress.check();
  target.commit();
}

std::string companion_file(CompanionKind kind) {
  return std::ranges::find(kKnownFiles, kind, &KnownFile::kind)->file;
}

void write_label_probabilities(const std::filesystem::path& path, int label_count,
                               const ViewProbabilities& probabilities, const Scene& scene,
                               const Progress& progress) {
  progress.check();
  const LightField& field = *scene.light_field;
  const GridShape grid = field.grid();
  Hdf5Shape shape = stack_shape(field);
  shape.push_back(static_cast<std::size_t>(label_count));
  Image<float> samples(field.height(), field.width(), label_count);
  const std::uintmax_t views = static_cast<std::uintmax_t>(grid.count());
  AtomicFile target(path, views * samples.size() * sizeof(float) + (1 << 16));
  Hdf5Output file(target);
  file.add_dataset<float>(kProbabilityData, shape, "v,h,y,x,label", "probability");
  for (int i = 0; i < grid.count(); ++i) {
    progress.check();
    const ViewIndex stored = grid.view_at(i);
    fill_samples(probabilities(flipped(stored, grid, flip_of(scene.convention))), samples);
    file.write(kProbabilityData, view_block(shape, stored), samples.data());
    progress.report((i + 1.0) / grid.count());
  }
  file.close();
  progress.check();
  target.commit();
}

ProbabilityFile::ProbabilityFile(const std::filesystem::path& path, const Scene& scene)
    : file_(path), grid_(scene.light_field->grid()), flip_(flip_of(scene.convention)) {
  layout_.shape = file_.dataset(kProbabilityData).shape;
  require_fit(path, kProbabilityData, layout_.shape, *scene.light_field);
  layout_.axes = layout_.shape.size() == 5 ? "vuyx" : "yx";
  layout_.axes.insert(*label_axis(layout_.shape, *scene.light_field), 1, 'c');
}

Image<float> ProbabilityFile::view(ViewIndex view) const {
  Hdf5Block block{Hdf5Shape(layout_.shape.size(), 0), layout_.shape};
  if (layout_.has('v')) {
    const ViewIndex stored = flipped(view, grid_, flip_);
    const std::size_t v_axis = layout_.axes.find('v'), u_axis = layout_.axes.find('u');
    block.start[v_axis] = static_cast<std::size_t>(stored.v);
    block.start[u_axis] = static_cast<std::size_t>(stored.u);
    block.count[v_axis] = block.count[u_axis] = 1;
  }
  std::vector<float> stored(element_count(block.count));
  file_.read(kProbabilityData, block, stored.data());
  const ArrayLayout read{block.count, layout_.axes};
  Image<float> out(read.height(), read.width(), label_count());
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      for (int label = 0; label < out.channels(); ++label) {
        out.at(y, x, label) = stored[static_cast<std::size_t>(y) * read.stride('y') +
                                     static_cast<std::size_t>(x) * read.stride('x') +
                                     static_cast<std::size_t>(label) * read.stride('c')];
      }
    }
  }
  return out;
}

}  // namespace episcope::io
