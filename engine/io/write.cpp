// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/write.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/core/text.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/npy.h"
#include "engine/io/formats/mosaic_layout.h"
#include "engine/io/formats/quilt.h"
#include "engine/io/formats/write_arrays.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/models/stored_maps.h"

#include <fmt/format.h>

#include <algorithm>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

/// Names of the files of one view: row and column from 0 on, padded to the same width.
class GridFileNames {
 public:
  explicit GridFileNames(GridShape grid)
      : digits_(std::max<std::size_t>(2, std::to_string(std::max(grid.v, grid.u) - 1).size())) {}

  [[nodiscard]] std::string of(ViewIndex view) const {
    return fmt::format("{:0{}}_{:0{}}", view.v, digits_, view.u, digits_);
  }

 private:
  std::size_t digits_;
};

void write_view_image(const fs::path& stem, const LightField& field, ViewIndex view) {
  const fs::path png = stem.string() + ".png";
  if (field.sample_type() == SampleType::UInt8) {
    write_png(png, field.view<std::uint8_t>(view));
  } else if (field.sample_type() == SampleType::UInt16) {
    write_png(png, field.view<std::uint16_t>(view));
  } else {
    write_tiff(stem.string() + ".tiff", field.view<float>(view));
  }
}

template <class T>
void write_npy_map(const fs::path& path, ImageView<const T> map) {
  write_npy<T>(path, {static_cast<std::size_t>(map.height), static_cast<std::size_t>(map.width)},
               {map.data, map.size()});
}

std::uintmax_t grid_folder_bytes(const Scene& scene) {
  const GroundTruth& truth = *scene.truth;
  const std::size_t disparities = truth.field.empty() ? 0 : truth.field.disparity.size();
  const std::size_t labels = truth.labels.empty() ? 0 : truth.labels.size();
  return scene.light_field->byte_size() + 4 * (disparities + labels);
}

/// Writes a folder of images, one for each view, named `RR_CC.png` by row and column from 0 on:
/// PNG of 8 or 16 bit, or TIFF of 32-bit float. Beside them, for every view that has them,
/// `disparity_RR_CC.npy` (float, px per view step, NaN = invalid) and `label_RR_CC.npy` (int32),
/// and region masks of the center view as `mask_<name>.npy` (uint8). Atomic. Throws IoError (also
/// if the folder holds other files), Cancelled.
void write_grid_folder(const fs::path& folder, const Scene& scene, const Progress& progress) {
  progress.check();
  progress.step("writing " + folder.filename().string());
  const LightField& field = *scene.light_field;
  const GroundTruth& truth = *scene.truth;
  const GridFileNames names(field.grid());
  AtomicFolder target(folder, grid_folder_bytes(scene));
  const fs::path& place = target.temporary();
  parallel_for(field.grid().count(), progress, [&](int i) {
    const ViewIndex view = field.grid().view_at(i);
    const std::string name = names.of(view);
    write_view_image(place / name, field, view);
    if (truth.field.contains(view)) {
      write_npy_map<float>(place / ("disparity_" + name + ".npy"),
                           marked_map(truth.field.view(view)).view());
    }
    if (!truth.labels.empty() && truth.labels.contains(view)) {
      write_npy_map(place / ("label_" + name + ".npy"), truth.labels.view(view));
    }
  });
  for (const auto& [name, region] : truth.regions) {
    write_npy_map<std::uint8_t>(place / ("mask_" + name + ".npy"), region.view());
  }
  progress.check();
  target.commit();
  progress.report(1);
}

constexpr const char* kHdf5[] = {".h5", ".hdf5"};
constexpr const char* kNpy[] = {".npy"};
constexpr const char* kNpz[] = {".npz"};
constexpr const char* kMat[] = {".mat"};
constexpr const char* kPng[] = {".png"};
constexpr const char* kEslfSuffixes[] = {"_eslf.png", ".png"};

constexpr FormContents kArchive{.floats = FloatsHeld::Exactly,
                                .disparity = MapsHeld::All,
                                .is_depth = true,
                                .has_origin = true,
                                .has_layers = true,
                                .labels = MapsHeld::All,
                                .has_scribbles = true,
                                .has_regions = true,
                                .has_valid = true,
                                .camera = CamerasHeld::All,
                                .has_range = true,
                                .has_positions = true};
constexpr FormContents kBenchmark{.floats = FloatsHeld::Rounded,
                                  .disparity = MapsHeld::All,
                                  .has_origin = true,
                                  .labels = MapsHeld::Center,
                                  .has_regions = true,
                                  .camera = CamerasHeld::Converging,
                                  .has_range = true};
constexpr FormContents kGrid{.floats = FloatsHeld::Exactly,
                             .disparity = MapsHeld::All,
                             .labels = MapsHeld::All,
                             .has_regions = true};

constexpr FormContents kArray{.floats = FloatsHeld::Exactly};
constexpr FormContents kArrays{.floats = FloatsHeld::Exactly,
                               .disparity = MapsHeld::All,
                               .has_origin = true,
                               .labels = MapsHeld::All,
                               .has_valid = true};

constexpr FormContents kPicture{};
constexpr FormContents kLine{.has_rows = false};

void write_named_archive(const fs::path& path, const Scene& scene, const Progress& progress) {
  write_archive(path, scene, progress, {.labels = LabelFile::NamedAfter});
}

constexpr Writer kWriters[] = {
    {"archive", "the archive form", kHdf5, kArchive, write_named_archive},
    {"benchmark", "the benchmark form", {}, kBenchmark, write_benchmark_folder},
    {"grid", "a grid of images", {}, kGrid, write_grid_folder},
    {"npy", "the .npy form", kNpy, kArray, write_npy},
    {"npz", "the .npz form", kNpz, kArrays, write_npz},
    {"mat", "the .mat form", kMat, kArrays, write_mat},
    {"eslf", "a picture of lenslets", kEslfSuffixes, kPicture, write_eslf},
    {"quilt", "a quilt", kPng, kLine, write_quilt},
};

}  // namespace

bool Writer::has_suffix_of(const std::filesystem::path& path) const {
  const std::string file = lower_case(path.filename().string());
  return std::ranges::any_of(suffixes, [&](const char* suffix) { return file.ends_with(suffix); });
}

std::span<const Writer> writers() {
  return kWriters;
}

const Writer* writer_named(const std::string& id) {
  const auto found = std::ranges::find(kWriters, id, &Writer::id);
  return found == std::end(kWriters) ? nullptr : found;
}

const Writer* writer_of(const std::filesystem::path& path) {
  if (quilt_tiles_of_name(path)) return writer_named("quilt");
  const auto found = std::ranges::find_if(
      kWriters, [&](const Writer& writer) { return writer.has_suffix_of(path); });
  return found == std::end(kWriters) ? nullptr : found;
}

namespace {

/// Gathers a sentence for each kind that a form cannot hold.
class Losses {
 public:
  Losses(const Writer& writer, const Scene& scene) : writer_(writer), scene_(scene) {}

  /// A kind that is held whole or not at all; `kind` is a plural.
  void compare(bool has_it, bool holds_it, const char* kind) {
    if (has_it && !holds_it) {
      sentences_.push_back(fmt::format("{} holds no {}; they are left out.", form(), kind));
    }
  }

  /// Maps that a form holds of all views, of the center view or not at all.
  template <class T>
  void compare_maps(const ViewStack<T>& stack, MapsHeld held, const char* kind) {
    if (stack.empty()) return;
    if (held == MapsHeld::None) return compare(true, false, kind);
    const bool has_center = stack.contains(scene_.light_field->center());
    if (held == MapsHeld::All || (has_center && stack.grid().count() == 1)) return;
    sentences_.push_back(fmt::format("{} holds {} of the center view only; {} left out.", form(),
                                     kind, has_center ? "those of the others are" : "all are"));
  }

  void add(const std::string& sentence) { sentences_.push_back(form() + sentence); }
  [[nodiscard]] std::vector<std::string> take() { return std::move(sentences_); }

 private:
  /// The name of the form at the beginning of a sentence.
  [[nodiscard]] std::string form() const {
    std::string name = writer_.name;
    name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
    return name;
  }

  const Writer& writer_;
  const Scene& scene_;
  std::vector<std::string> sentences_;
};

/// Valid pixels whose disparity belongs to no positive depth.
std::size_t beyond_infinity(const DisparityField& field, const CameraGrid& camera) {
  if (field.empty() || !camera.is_known()) return 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < field.disparity.size(); ++i) {
    const bool is_valid = field.valid.empty() || field.valid.data()[i] != 0;
    const float d = field.disparity.data()[i];
    if (is_valid && std::isfinite(d) && !(camera.depth_from_disparity(d) > 0)) ++count;
  }
  return count;
}

void compare_camera(const LightFieldInfo& info, const FormContents& holds, Losses& losses) {
  const bool is_known = info.camera.is_known();
  if (is_known && holds.camera == CamerasHeld::Converging && !(info.camera.shift > 0)) {
    losses.add(" holds no parallel cameras whose shift is 0 or negative; the camera is left out.");
  } else if (is_known && holds.camera == CamerasHeld::None) {
    losses.add(" holds no camera; it is left out.");
  }
  if (info.disparity_range && !holds.has_range) {
    losses.add(" holds no range of disparities; it is left out.");
  }
  losses.compare(!info.positions.empty(), holds.has_positions, "positions of cameras");
}

}  // namespace

std::vector<std::string> unsupported_parts(const Writer& writer, const Scene& scene) {
  const LightField& field = *scene.light_field;
  const GroundTruth& truth = *scene.truth;
  const FormContents& holds = writer.holds;
  Losses losses(writer, scene);
  if (field.sample_type() == SampleType::Float32 && holds.floats == FloatsHeld::Rounded) {
    losses.add(" holds no float samples; they are rounded to 16 bit, and clamped to 0 … 1.");
  }
  if (field.grid().v > 1 && !holds.has_rows) {
    losses.add(fmt::format(" holds one row of views; row {} is written, the others are left out.",
                           field.center().v));
  }
  compare_camera(field.info(), holds, losses);
  losses.compare_maps(truth.field.disparity, holds.disparity, "disparities");
  if (holds.is_depth) {
    const std::size_t lost = beyond_infinity(truth.field, field.info().camera);
    if (lost > 0) {
      losses.add(
          fmt::format(" holds depth, and {} pixels have disparities that belong to none; "
                      "they are left out.",
                      lost));
    }
  }
  losses.compare(truth.has_layers(), holds.has_layers, "layers");
  losses.compare_maps(truth.labels, holds.labels, "labels");
  losses.compare(!truth.regions.empty(), holds.has_regions, "region masks");
  losses.compare(truth.high_res != nullptr, false, "ground truth in high resolution");
  losses.compare(truth.estimated && holds.disparity != MapsHeld::None, holds.has_origin,
                 "facts on how disparities were estimated, which read as ground truth then");
  // The archive form alone holds both.
  losses.compare(truth.labels_estimated && holds.labels != MapsHeld::None,
                 holds.has_origin && holds.has_scribbles,
                 "facts on how labels were computed, which read as ground truth then");
  losses.compare(!scene.scribbles.empty(), holds.has_scribbles, "scribbles");
  losses.compare(!field.valid().empty(), holds.has_valid, "masks of valid pixels");
  return losses.take();
}

void write_eslf(const std::filesystem::path& path, const Scene& scene, const Progress& progress) {
  progress.check();
  progress.step("writing " + path.filename().string());
  std::visit(
      [&]<class T>(const ViewStack<T>& views) {
        if constexpr (std::is_same_v<T, float>) {
          throw IoError(
              path,
              "a picture of lenslets holds 8 or 16 bit, but these views are float; choose "
              "a form that holds float samples, for example .npy");
        } else {
          const Image<T> picture = join_lenslets(views, progress.part(0, 0.3));
          progress.check();
          write_png(path, picture.view());
        }
      },
      scene.light_field->samples());
  progress.report(1);
}

}  // namespace episcope::io
