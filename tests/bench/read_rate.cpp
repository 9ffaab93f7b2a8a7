// SPDX-License-Identifier: BSD-3-Clause
// read_rate FOLDER [MIB]: how fast a light field in HDF5 is read, view by view, beside a plain loop
// over the same file in the same run, nothing of either in memory: samples one after the other, in
// chunks of a view, and in chunks packed by deflate. The files are made in FOLDER and removed.
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/scenes/builtin.h"

#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <variant>
#include <vector>

namespace {

using namespace episcope;
namespace fs = std::filesystem;

enum class Form { Contiguous, Chunked, Deflated };

constexpr hsize_t kSide = 1024, kChannels = 3;
constexpr int kTile = 256;
constexpr int kRounds = 3;

// Views of a built-in scene, repeated: as compressible as pictures are.
static_assert(kSide % kTile == 0);

void write(const fs::path& path, Form form, hsize_t view_count) {
  scenes::RenderOptions options;
  options.grid = {1, 1};
  options.height = options.width = kTile;
  const Scene tile = scenes::render_builtin("demo", options, Progress());
  const auto view = tile.light_field->view<std::uint8_t>({0, 0});
  std::vector<std::uint8_t> samples(kSide * kSide * kChannels);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto y = static_cast<int>(i / (kSide * kChannels) % kTile);
    samples[i] = view.row(y)[i % (kTile * kChannels)];
  }
  const hsize_t shape[]{1, view_count, kSide, kSide, kChannels};
  const hsize_t one[]{1, 1, kSide, kSide, kChannels};
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t space = H5Screate_simple(5, shape, nullptr);
  const hid_t memory = H5Screate_simple(5, one, nullptr);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  if (form != Form::Contiguous) H5Pset_chunk(creation, 5, one);
  if (form == Form::Deflated) H5Pset_deflate(creation, 4);
  const hid_t set =
      H5Dcreate2(file, "LF", H5T_NATIVE_UINT8, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  for (hsize_t i = 0; i < view_count; ++i) {
    const hsize_t start[]{0, i, 0, 0, 0};
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, one, nullptr);
    H5Dwrite(set, H5T_NATIVE_UINT8, memory, space, H5P_DEFAULT, samples.data());
  }
  for (const hid_t id : {creation, space, memory}) H5Idec_ref(id);
  H5Dclose(set);
  H5Fclose(file);
}

void drop_from_memory(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  fdatasync(file);
  posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
  close(file);
}

double plain_seconds(const fs::path& path) {
  drop_from_memory(path);
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  std::vector<char> buffer(std::size_t{8} << 20);
  const Stopwatch watch;
  while (read(file, buffer.data(), buffer.size()) > 0) {
  }
  const double seconds = watch.seconds();
  close(file);
  return seconds;
}

double reader_seconds(const fs::path& path) {
  drop_from_memory(path);
  const Stopwatch watch;
  const io::Hdf5Input file(path);
  const io::Hdf5Shape shape = file.dataset("LF").shape;
  std::vector<std::uint8_t> samples(shape[2] * shape[3] * shape[4]);
  for (std::size_t i = 0; i < shape[1]; ++i) {
    file.read("LF", {{0, i, 0, 0, 0}, {1, 1, shape[2], shape[3], shape[4]}}, samples.data());
  }
  return watch.seconds();
}

void measure(const fs::path& path, const char* name, Form form, hsize_t view_count) {
  write(path, form, view_count);
  double plain = 1e9, reader = 1e9;
  for (int i = 0; i < kRounds; ++i) {
    plain = std::min(plain, plain_seconds(path));
    reader = std::min(reader, reader_seconds(path));
  }
  const double stored = static_cast<double>(fs::file_size(path)) / 1e6;
  const double samples = static_cast<double>(view_count * kSide * kSide * kChannels) / 1e6;
  std::printf(
      "%-12s file %6.0f MB: plain %5.0f MB/s, reader %5.0f MB/s of it (%.2f), %5.0f MB/s of "
      "samples\n",
      name, stored, stored / plain, stored / reader, plain / reader, samples / reader);
  std::fflush(stdout);
  fs::remove(path);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const hsize_t mebibytes = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 2000;
  const hsize_t views = std::max<hsize_t>(1, (mebibytes << 20) / (kSide * kSide * kChannels));
  const fs::path path = fs::path(argv[1]) / "read_rate.h5";
  measure(path, "contiguous", Form::Contiguous, views);
  measure(path, "chunked", Form::Chunked, views);
  measure(path, "deflated", Form::Deflated, views);
  return 0;
}
