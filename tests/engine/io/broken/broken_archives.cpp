// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/result_file.h"
#include "tests/engine/io/archive_files.h"
#include "tests/engine/io/broken/broken.h"
#include "tests/engine/io/synthetic_scene.h"

#include <hdf5.h>

#include <fstream>

namespace episcope::test {
namespace in_broken_archives {

namespace fs = std::filesystem;

fs::path archive_with(const fs::path& folder, const RawArchive& form) {
  write_raw_archive(folder / "lf.h5", plane_scene(), form);
  return folder / "lf.h5";
}

fs::path cut_archive(const fs::path& folder, std::uintmax_t bytes) {
  const fs::path path = archive_with(folder, {});
  fs::resize_file(path, bytes);
  return path;
}

fs::path archive_of(const fs::path& folder,
                    const std::vector<std::pair<std::string, io::Hdf5Shape>>& datasets) {
  io::AtomicFile target(folder / "lf.h5");
  io::Hdf5Output file(target);
  for (const auto& [name, shape] : datasets) {
    std::size_t count = 1;
    for (const std::size_t length : shape) count *= length;
    add_bytes(file, name, shape, std::vector<std::uint8_t>(count, 7));
  }
  file.close();
  target.commit();
  return folder / "lf.h5";
}

/// A dataset LF of bytes whose creation and size are up to the caller; nothing is written to it.
fs::path unwritten_archive(const fs::path& folder, const std::vector<hsize_t>& shape,
                           const std::function<void(hid_t creation)>& prepare) {
  const fs::path path = folder / "lf.h5";
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  prepare(creation);
  const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
  const hid_t dataset =
      H5Dcreate2(file, "LF", H5T_STD_U8LE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  H5Dclose(dataset);
  H5Sclose(space);
  H5Pclose(creation);
  H5Fclose(file);
  return path;
}

void use_chunks(hid_t creation) {
  const hsize_t chunk[] = {1, 1, 100, 100, 3};
  H5Pset_chunk(creation, 5, chunk);
  H5Pset_deflate(creation, 9);
}

/// A filter that changes nothing, known only while a file is written.
std::size_t pass_through(unsigned, std::size_t, const unsigned*, std::size_t bytes, std::size_t*,
                         void**) {
  return bytes;
}

struct UnknownFilter {
  H5Z_filter_t id = 32100;
  const char* name = "rare-codec";
};

/// LF is stored through a filter that a reader does not know; `flag`: whether it had to be.
fs::path archive_of_unknown_filter(const fs::path& folder, unsigned flag,
                                   UnknownFilter unknown = {}) {
  const H5Z_filter_t kFilter = unknown.id;
  const H5Z_class2_t filter{H5Z_CLASS_T_VERS, kFilter, 1,       1,
                            unknown.name,     nullptr, nullptr, pass_through};
  H5Zregister(&filter);
  const fs::path path = unwritten_archive(folder, {3, 3, 8, 9, 3}, [=](hid_t creation) {
    const hsize_t chunk[] = {1, 1, 8, 9, 3};
    H5Pset_chunk(creation, 5, chunk);
    H5Pset_filter(creation, kFilter, flag, 0, nullptr);
  });
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t dataset = H5Dopen2(file, "LF", H5P_DEFAULT);
  const std::vector<std::uint8_t> samples(3 * 3 * 8 * 9 * 3, 100);
  H5Dwrite(dataset, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, samples.data());
  H5Dclose(dataset);
  H5Fclose(file);
  H5Zunregister(kFilter);
  return path;
}

fs::path archive_of_text(const fs::path& folder) {
  const fs::path path = folder / "lf.h5";
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hsize_t shape[] = {3, 3, 8, 9, 3};
  const hid_t space = H5Screate_simple(5, shape, nullptr);
  const hid_t type = H5Tcopy(H5T_C_S1);
  const hid_t dataset = H5Dcreate2(file, "LF", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dclose(dataset);
  H5Tclose(type);
  H5Sclose(space);
  H5Fclose(file);
  return path;
}

/// LF lies in another file, as a link or by its samples.
fs::path archive_elsewhere(const fs::path& folder, const std::function<void(hid_t file)>& add) {
  fs::create_directory(folder / "lf");
  archive_of(folder, {{"LF", {3, 3, 8, 9, 3}}});
  fs::rename(folder / "lf.h5", folder / "other.h5");
  const fs::path path = folder / "lf" / "lf.h5";
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  add(file);
  H5Fclose(file);
  return path;
}

void add_dataset(hid_t file, const std::function<void(hid_t creation, hid_t space)>& prepare) {
  const hsize_t shape[] = {3, 3, 8, 9, 3};
  const hid_t space = H5Screate_simple(5, shape, nullptr);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  prepare(creation, space);
  H5Dclose(H5Dcreate2(file, "LF", H5T_STD_U8LE, space, H5P_DEFAULT, creation, H5P_DEFAULT));
  H5Pclose(creation);
  H5Sclose(space);
}

fs::path archive_of_link(const fs::path& folder) {
  return archive_elsewhere(folder, [](hid_t file) {
    H5Lcreate_external("../other.h5", "LF", file, "LF", H5P_DEFAULT, H5P_DEFAULT);
  });
}

fs::path archive_of_raw_file(const fs::path& folder) {
  return archive_elsewhere(folder, [](hid_t file) {
    add_dataset(file, [](hid_t creation, hid_t) {
      H5Pset_external(creation, "../other.h5", 0, H5F_UNLIMITED);
    });
  });
}

fs::path archive_of_virtual_samples(const fs::path& folder) {
  return archive_elsewhere(folder, [](hid_t file) {
    add_dataset(file, [](hid_t creation, hid_t space) {
      H5Pset_virtual(creation, space, "../other.h5", "LF", space);
    });
  });
}

Estimate estimate_of(const Scene& scene) {
  Estimate estimate;
  estimate.field.disparity = scene.truth->field.disparity.clone();
  estimate.method = "test";
  return estimate;
}

}  // namespace in_broken_archives

std::vector<Broken> broken_archives() {
  using namespace in_broken_archives;
  return {
      {"text named .h5",
       [](const fs::path& f) {
         std::ofstream(f / "lf.h5") << "this is no HDF5";
         return f / "lf.h5";
       },
       "not an HDF5 file"},
      {"text named .h5 in its folder",
       [](const fs::path& f) {
         std::ofstream(f / "lf.h5") << "this is no HDF5";
         return f;
       },
       "not an HDF5 file"},
      {"empty file named .h5",
       [](const fs::path& f) {
         std::ofstream give(f / "lf.h5");
         return f / "lf.h5";
       },
       "the file is empty; copy or download it again"},
      {"HDF5 cut in its header", [](const fs::path& f) { return cut_archive(f, 90); },
       "truncated or damaged"},
      {"HDF5 cut in its samples", [](const fs::path& f) { return cut_archive(f, 200000); },
       "truncated or damaged"},
      {"LF is a link to another file", archive_of_link, "is a link to another file"},
      {"LF in a raw file elsewhere", archive_of_raw_file, "episcope-cli convert --repack"},
      {"LF made of another file", archive_of_virtual_samples, "episcope-cli convert --repack"},
      {"sides that are huge beside an empty one",
       [](const fs::path& f) {
         return unwritten_archive(f, {60000, 60000, 0, 1, 1}, [](hid_t) {});
       },
       "claims"},
      {"no dataset LF",
       [](const fs::path& f) {
         return archive_of(f, {{"IMAGES", {2, 2}}});
       },
       "no dataset LF in this file, which holds IMAGES"},
      {"HDF5 without datasets", [](const fs::path& f) { return archive_of(f, {}); },
       "no dataset at all"},
      {"LF of rank 3",
       [](const fs::path& f) {
         return archive_of(f, {{"LF", {3, 8, 9}}});
       },
       "3 axes (3×8×9)"},
      {"LF of 2 channels",
       [](const fs::path& f) {
         return archive_of(f, {{"LF", {3, 3, 8, 9, 2}}});
       },
       "2 channels"},
      {"LF without views",
       [](const fs::path& f) {
         return archive_of(f, {{"LF", {0, 3, 8, 9, 3}}});
       },
       "not that of a light field"},
      {"GT_DEPTH of rank 3",
       [](const fs::path& f) {
         return archive_of(f, {{"LF", {3, 3, 8, 9, 3}}, {"GT_DEPTH", {3, 8, 9}}});
       },
       "GT_DEPTH has 3 axes"},
      {"GT_DEPTH of another size",
       [](const fs::path& f) {
         return archive_of(f, {{"LF", {3, 3, 8, 9, 3}}, {"GT_DEPTH", {9, 9}}});
       },
       "GT_DEPTH has the shape 9×9, but 3×3×8×9 or 8×9"},
      {"GT_LABELS of another size",
       [](const fs::path& f) {
         return archive_of(f, {{"LF", {3, 3, 8, 9, 3}}, {"GT_LABELS", {3, 3, 8, 8}}});
       },
       "GT_LABELS has the shape 3×3×8×8"},
      {"result instead of a light field",
       [](const fs::path& f) {
         io::write_result(f / "r.h5", estimate_of(plane_scene()), Progress(1));
         return f / "r.h5";
       },
       "disparity result, not a light field"},
      {"HDF5 of 10^12 samples in chunks, none written",
       [](const fs::path& f) {
         return unwritten_archive(f, {10, 10, 60000, 60000, 3}, use_chunks);
       },
       "LF claims 1.08e+12 bytes"},
      {"HDF5 of 10^12 samples, none written",
       [](const fs::path& f) {
         return unwritten_archive(f, {10, 10, 60000, 60000, 3}, [](hid_t) {});
       },
       "LF claims 1.08e+12 bytes"},
      {"LF compressed by an unknown filter",
       [](const fs::path& f) { return archive_of_unknown_filter(f, H5Z_FLAG_MANDATORY); },
       "not known here (32100, rare-codec); install hdf5plugin of Python, name the folder"},
      {"LF compressed by Blosc",
       [](const fs::path& f) {
         return archive_of_unknown_filter(f, H5Z_FLAG_MANDATORY, {32001, "blosc"});
       },
       "(32001, blosc); install the package hdf5-filter-plugin-blosc-serial, name the folder of "
       "plug-ins in HDF5_PLUGIN_PATH"},
      {"LF compressed by LZ4",
       [](const fs::path& f) {
         return archive_of_unknown_filter(f, H5Z_FLAG_MANDATORY, {32004, "lz4"});
       },
       "(32004, lz4); install the package hdf5-filter-plugin, name"},
      {"LF compressed by bitshuffle",
       [](const fs::path& f) {
         return archive_of_unknown_filter(f, H5Z_FLAG_MANDATORY, {32008, "bitshuffle"});
       },
       "(32008, bitshuffle); install the package bitshuffle, name"},
      {"LF compressed by Zstandard",
       [](const fs::path& f) {
         return archive_of_unknown_filter(f, H5Z_FLAG_MANDATORY, {32015, "zstd"});
       },
       "(32015, zstd); install hdf5plugin of Python, name"},
      {"LF compressed by an unknown filter that is marked as optional, as h5py marks LZF",
       [](const fs::path& f) { return archive_of_unknown_filter(f, H5Z_FLAG_OPTIONAL); },
       "a filter that is not known here (32100, rare-codec)"},
      {"LF of text", archive_of_text, "holds no numbers"},
      {"LF that is a group",
       [](const fs::path& f) {
         io::AtomicFile target(f / "lf.h5");
         io::Hdf5Output file(target);
         file.add_group("LF");
         file.close();
         target.commit();
         return f / "lf.h5";
       },
       "LF is a group"},
      {"positions of other views",
       [](const fs::path& f) {
         return archive_with(f, {.more = [](io::Hdf5Output& file) {
                               file.set_numbers("/", "camera_positions", {1, 2, 3});
                             }});
       },
       "camera_positions holds 3 numbers, but 50 are expected"},
      {"mask of valid pixels of another size",
       [](const fs::path& f) {
         return archive_of(f, {{"LF", {3, 3, 8, 9, 3}}, {"VALID", {8, 9}}});
       },
       "VALID has the shape 8×9"},
      {"region mask of another size",
       [](const fs::path& f) {
         return archive_of(f, {{"LF", {3, 3, 8, 9, 3}}, {"REGION_fine", {9, 9}}});
       },
       "REGION_fine has the shape 9×9, but 8×9"},
  };
}

}  // namespace episcope::test
