// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/io/archive_files.h"

#include "tests/engine/io/synthetic_scene.h"

namespace episcope::test {
namespace {

io::Hdf5Shape to_shape(std::initializer_list<int> lengths) {
  io::Hdf5Shape shape;
  for (const int length : lengths) shape.push_back(static_cast<std::size_t>(length));
  return shape;
}

void write_views(io::Hdf5Output& file, const Scene& scene, const RawArchive& form) {
  const LightField& field = *scene.light_field;
  const GridShape grid = field.grid();
  file.add_dataset<std::uint8_t>(
      "LF", to_shape({grid.v, grid.u, field.height(), field.width(), field.channels()}), "", "");
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex stored{i / grid.u, i % grid.u};
    const io::Hdf5Block block{to_shape({stored.v, stored.u, 0, 0, 0}),
                              to_shape({1, 1, field.height(), field.width(), field.channels()})};
    file.write("LF", block, bytes_of(scene).view(io::flipped(stored, grid, form.flip)).data);
  }
}

std::vector<float> depth_of(const Scene& scene, const RawArchive& form, ViewIndex stored) {
  const LightField& field = *scene.light_field;
  const ViewIndex view = io::flipped(stored, field.grid(), form.flip);
  std::vector<float> depth;
  for (int y = 0; y < field.height(); ++y) {
    for (int x = 0; x < field.width(); ++x) {
      const float d = scene.truth->field.disparity.view(view).at(y, x);
      const auto z = static_cast<float>(field.info().camera.depth_from_disparity(d));
      depth.push_back(form.depth ? form.depth(stored, y, x, z) : z);
    }
  }
  return depth;
}

void write_depth(io::Hdf5Output& file, const Scene& scene, const RawArchive& form) {
  const LightField& field = *scene.light_field;
  const GridShape grid = field.grid();
  const io::Hdf5Shape view = to_shape({field.height(), field.width()});
  if (form.is_center_only) {
    file.add_dataset<float>("GT_DEPTH", view, "", "");
    file.write("GT_DEPTH", {to_shape({0, 0}), view}, depth_of(scene, form, grid.center()).data());
    return;
  }
  file.add_dataset<float>("GT_DEPTH", to_shape({grid.v, grid.u, field.height(), field.width()}), "",
                          "");
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex stored{i / grid.u, i % grid.u};
    file.write(
        "GT_DEPTH",
        {to_shape({stored.v, stored.u, 0, 0}), to_shape({1, 1, field.height(), field.width()})},
        depth_of(scene, form, stored).data());
  }
}

}  // namespace

void write_raw_archive(const std::filesystem::path& path, const Scene& scene,
                       const RawArchive& form) {
  io::AtomicFile target(path);
  io::Hdf5Output file(target);
  write_views(file, scene, form);
  if (form.has_depth) write_depth(file, scene, form);
  if (form.has_attributes) {
    const CameraGrid& camera = scene.light_field->info().camera;
    file.set_numbers("/", "dH", {camera.baseline * form.attribute_scale});
    file.set_number("/", "focalLength", camera.focal_length);
    file.set_number("/", "shift", camera.shift * form.attribute_scale);
    if (camera.cam_distance) file.set_number("/", "camDistance", *camera.cam_distance);
  }
  if (form.more) form.more(file);
  file.close();
  target.commit();
}

void add_bytes(io::Hdf5Output& file, const std::string& name, const io::Hdf5Shape& shape,
               const std::vector<std::uint8_t>& values) {
  file.add_dataset<std::uint8_t>(name, shape, "", "");
  file.write(name, {io::Hdf5Shape(shape.size(), 0), shape}, values.data());
}

}  // namespace episcope::test
