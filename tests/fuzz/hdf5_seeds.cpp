// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/hdf5_seeds.h"

#include "engine/io/base/hdf5_output.h"
#include "tests/engine/io/formats/array_files.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/fuzz/seed_scene.h"

#include <fmt/format.h>
#include <hdf5.h>
#include <lzf.h>

#include <functional>
#include <vector>

namespace episcope::fuzz {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::function<void(io::Hdf5Output&)>& fill) {
  io::AtomicFile target(path);
  io::Hdf5Output file(target);
  fill(file);
  file.close();
  target.commit();
}

template <class T>
void add(io::Hdf5Output& file, const std::string& name, const io::Hdf5Shape& shape,
         const T* samples) {
  file.add_dataset<T>(name, shape, "", "");
  file.write(name, {io::Hdf5Shape(shape.size(), 0), shape}, samples);
}

const ViewStack<std::uint8_t>& views() {
  return test::bytes_of(seed_scene());
}

io::Hdf5Shape shape_of(const std::string& axes) {
  return test::lengths_of(views(), axes);
}

void add_light_field(io::Hdf5Output& file, const std::string& name) {
  add(file, name, shape_of("vuyxc"), views().data());
}

void add_disparity(io::Hdf5Output& file, const std::string& name) {
  add(file, name, shape_of("vuyx"), seed_scene().truth->field.disparity.data());
}

void add_labels(io::Hdf5Output& file, const std::string& name) {
  add(file, name, shape_of("vuyx"), seed_scene().truth->labels.data());
}

void write_joined(const fs::path& folder) {
  write(folder / "views.h5", [](io::Hdf5Output& file) {
    file.add_group("disparity");
    const GridShape grid = views().grid();
    for (int i = 0; i < grid.count(); ++i) {
      const ViewIndex view = views().view_at(i);
      const std::string place = fmt::format("{}_{}", view.v, view.u);
      add(file, "view_" + place, shape_of("yxc"), views().view(view).data);
      add(file, "disparity/" + place, shape_of("yx"),
          seed_scene().truth->field.disparity.view(view).data);
    }
  });
  write(folder / "planes.h5", [](io::Hdf5Output& file) {
    const std::vector<std::uint8_t> planes = test::in_axes(views(), "cvuyx");
    std::size_t first = 0;
    for (const char* name : {"r", "g", "b"}) {
      add(file, name, shape_of("vuyx"), planes.data() + first);
      first += planes.size() / 3;
    }
  });
}

void write_maps(const fs::path& folder) {
  write(folder / "maps.h5", [](io::Hdf5Output& file) {
    add_light_field(file, "LF");
    add_disparity(file, "disparity");
    add_labels(file, "labels");
    file.set_text("/", "dH", "0.5");
  });
  write(folder / "fractions.h5", [](io::Hdf5Output& file) {
    add_light_field(file, "LF");
    add_disparity(file, "label");
  });
  write(folder / "group.h5", [](io::Hdf5Output& file) {
    file.add_group("scene");
    add_light_field(file, "scene/LF");
    add_disparity(file, "scene/GT_DEPTH");
    add_labels(file, "scene/GT_LABELS");
    for (const char* name : {"dH", "focalLength", "shift"}) file.set_number("scene", name, 2);
  });
}

/// Floats around 0, and views side by side in one picture, as data for learning are kept.
void write_floats(const fs::path& folder) {
  std::vector<float> samples;
  for (const std::uint8_t sample : test::in_axes(views(), "vuyxc")) {
    samples.push_back(static_cast<float>(sample) / 127.5F - 1);
  }
  write(folder / "around_zero.h5",
        [&](io::Hdf5Output& file) { add(file, "LF", shape_of("vuyxc"), samples.data()); });
  write(folder / "pair.h5", [&](io::Hdf5Output& file) {
    add(file, "Hr_SAI_y", {24, 18}, samples.data());
    add(file, "Lr_SAI_y", {12, 9}, samples.data());
    file.set_numbers("/", "grid", {3, 3});
  });
}

/// A chunk a view, packed by deflate or, as h5py does it, by LZF.
void write_packed(const fs::path& path, bool is_lzf) {
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const io::Hdf5Shape lengths = shape_of("vuyxc");
  const std::vector<hsize_t> shape(lengths.begin(), lengths.end());
  const std::vector<hsize_t> chunk{1, 1, shape[2], shape[3], shape[4]};
  const auto bytes = static_cast<unsigned>(views().view_size());
  const unsigned values[]{4, 0x0105, bytes};
  const hid_t space = H5Screate_simple(5, shape.data(), nullptr);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(creation, 5, chunk.data());
  if (is_lzf) H5Pset_filter(creation, 32000, H5Z_FLAG_OPTIONAL, 3, values);
  if (!is_lzf) H5Pset_shuffle(creation);
  if (!is_lzf) H5Pset_deflate(creation, 9);
  const hid_t set =
      H5Dcreate2(file, "LF", H5T_NATIVE_UINT8, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  if (!is_lzf) H5Dwrite(set, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, views().data());
  for (int i = 0; is_lzf && i < views().grid().count(); ++i) {
    const ViewIndex view = views().view_at(i);
    // Stripes, or LZF would find nothing.
    const std::vector<std::uint8_t> samples(bytes, static_cast<std::uint8_t>(20 * i));
    std::vector<std::uint8_t> packed(bytes);
    const unsigned size = lzf_compress(samples.data(), bytes, packed.data(), bytes - 1);
    const hsize_t at[]{static_cast<hsize_t>(view.v), static_cast<hsize_t>(view.u), 0, 0, 0};
    H5Dwrite_chunk(set, H5P_DEFAULT, 0, at, size, packed.data());
  }
  H5Dclose(set);
  H5Pclose(creation);
  H5Sclose(space);
  H5Fclose(file);
}

}  // namespace

void write_hdf5_seeds(const fs::path& folder) {
  write_joined(folder);
  write_maps(folder);
  write_floats(folder);
  write_packed(folder / "deflate.h5", false);
  write_packed(folder / "lzf.h5", true);
}

}  // namespace episcope::fuzz
