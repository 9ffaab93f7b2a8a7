// SPDX-License-Identifier: BSD-3-Clause
// chunk_shapes FOLDER [SIDE]: how long light fields of 9x9 views of SIDE² px (default 512) take to
// open whose HDF5 chunks have several shapes, packed by deflate, beside one H5Dread of everything
// by the library, and by h5py where python3 has it, in the same run. Opening one array without
// chunks, the first line, takes the time of the checks of the order of views; "read" is what others
// take beyond that. Files are made in FOLDER and removed.
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/io/open.h"
#include "engine/scenes/builtin.h"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace episcope;
namespace fs = std::filesystem;
using Extent = std::array<hsize_t, 5>;

constexpr int kViews = 9;
constexpr int kRounds = 2;

Scene scene_of(int side) {
  scenes::RenderOptions options;
  options.grid = {kViews, kViews};
  options.height = options.width = side;
  return scenes::render_builtin("demo", options, Progress());
}

Extent shape_of(const LightField& field) {
  return {kViews, kViews, static_cast<hsize_t>(field.height()), static_cast<hsize_t>(field.width()),
          3};
}

/// Without chunks if the first side is 0.
void write(const fs::path& path, const LightField& field, const Extent& chunk) {
  const Extent shape = shape_of(field);
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t space = H5Screate_simple(5, shape.data(), nullptr);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  if (chunk[0] > 0) {
    H5Pset_chunk(creation, 5, chunk.data());
    H5Pset_deflate(creation, 1);
  }
  const hid_t set =
      H5Dcreate2(file, "LF", H5T_NATIVE_UINT8, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  H5Dwrite(set, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT,
           std::get<ViewStack<std::uint8_t>>(field.samples()).data());
  H5Dclose(set);
  H5Pclose(creation);
  H5Sclose(space);
  H5Fclose(file);
}

double open_seconds(const fs::path& path) {
  io::OpenOptions options;
  options.needs_truth = false;
  const Stopwatch watch;
  static_cast<void>(io::open_scene(path, options, Progress()));
  return watch.seconds();
}

double library_seconds(const fs::path& path, std::size_t bytes) {
  std::vector<std::uint8_t> samples(bytes);
  const Stopwatch watch;
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t set = H5Dopen2(file, "LF", H5P_DEFAULT);
  H5Dread(set, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, samples.data());
  H5Dclose(set);
  H5Fclose(file);
  return watch.seconds();
}

/// 0 where there is no h5py.
double h5py_seconds(const fs::path& path) {
  const std::string command =
      "python3 -c 'import h5py, sys, time; t = time.time(); f = h5py.File(sys.argv[1], \"r\"); "
      "f[\"LF\"][()]; print(time.time() - t)' '" +
      path.string() + "' 2>/dev/null";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> answer(popen(command.c_str(), "r"), pclose);
  double seconds = 0;
  return answer && std::fscanf(answer.get(), "%lf", &seconds) == 1 ? seconds : 0;
}

std::size_t count_of(const Extent& shape, const Extent& chunk) {
  std::size_t count = 1;
  for (std::size_t i = 0; i < shape.size() && chunk[0] > 0; ++i) {
    count *= (shape[i] + chunk[i] - 1) / chunk[i];
  }
  return count;
}

/// Returns how long opening took; `checks`: what of that is no reading.
double measure(const fs::path& path, const LightField& field, const Extent& chunk, double checks) {
  write(path, field, chunk);
  double open = 1e9, library = 1e9, h5py = 1e9;
  for (int i = 0; i < kRounds; ++i) {
    open = std::min(open, open_seconds(path));
    library = std::min(library, library_seconds(path, field.byte_size()));
    h5py = std::min(h5py, h5py_seconds(path));
  }
  std::printf(
      "%2llux%llux%3llux%3llux%llu %8zu chunks: open %6.2f s, read %6.2f s, library %6.2f s, "
      "h5py %6.2f s",
      static_cast<unsigned long long>(chunk[0]), static_cast<unsigned long long>(chunk[1]),
      static_cast<unsigned long long>(chunk[2]), static_cast<unsigned long long>(chunk[3]),
      static_cast<unsigned long long>(chunk[4]), count_of(shape_of(field), chunk), open,
      open - checks, library, h5py);
  if (checks > 0) std::printf(" (%.2f)", (open - checks) / (h5py > 0 ? h5py : library));
  std::printf("\n");
  std::fflush(stdout);
  fs::remove(path);
  return open;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const int side = argc > 2 ? std::atoi(argv[2]) : 512;
  const Scene scene = scene_of(side);
  const auto whole = static_cast<hsize_t>(side);
  const Extent chunks[] = {{0, 0, 0, 0, 0},     {1, 1, whole, whole, 3}, {9, 9, 8, 8, 3},
                           {1, 1, 32, 32, 3},   {1, 1, 16, 16, 3},       {1, 9, 1, whole, 3},
                           {1, 1, 1, whole, 3}, {9, 9, 1, whole, 3},     {3, 3, 64, 64, 1},
                           {1, 1, 8, 8, 1}};
  double checks = 0;
  for (const Extent& chunk : chunks) {
    const double open = measure(fs::path(argv[1]) / "lf.h5", *scene.light_field, chunk, checks);
    if (checks == 0) checks = open;
  }
}
