// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/labels/scribble_file.h"

#include "engine/core/error.h"
#include "engine/core/light_field/shear.h"
#include "engine/io/labels/label_list.h"
#include "engine/io/labels/scribble_dataset.h"
#include "engine/io/open/view_crop.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

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
                                    labels.height(), labels.width(), view_text(view), shape.grid.v,
                                    shape.grid.u, shape.height, shape.width));
  }
}

std::uintmax_t file_bytes(const Scribbles& scribbles, const FieldShape& shape,
                          const fs::path& former) {
  std::error_code error;
  const std::uintmax_t kept = fs::file_size(former, error);
  const int views = scribbles.views.size() > 1 ? shape.grid.count() : 1;
  return (error ? 0 : kept) +
         sizeof(std::int32_t) * static_cast<std::uintmax_t>(views) * shape.height * shape.width +
         (1 << 16);
}

/// In canonical order, on all views as they are stored.
Scribbles read_stored(const Hdf5Input& file, const Scene& scene, const Progress& progress) {
  const FieldShape shape = stored_shape_of(scene);
  StoredScribbles stored =
      read_scribble_dataset(file, shape, scene.convention.raised_labels, progress);
  put_in_order(stored.scribbles, shape.grid, flip_of(scene.convention));
  return std::move(stored.scribbles);
}

/// On the views of the scene, as these are stored.
Scribbles read_unmoved(const Hdf5Input& file, const Scene& scene, const Progress& progress) {
  Scribbles stored = read_stored(file, scene, progress);
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
  return crop.leaves_out() ? uncropped(std::move(unmoved), before(read_stored), crop) : unmoved;
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
  AtomicFile target(path, file_bytes(stored, shape, path));
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

}  // namespace episcope::io
