// SPDX-License-Identifier: BSD-3-Clause
// write_map MAP.pfm OUT FORM DATASET…: a file as other programs write them, with the map in each
// dataset named. FORM is the number of views: HDF5 with [y][x] if it is 0, else [v][u][y][x] with
// FORM × FORM equal maps; or a way to write HDF5 with [x][y]: "x,y" states it as we do, "matlab" as
// MATLAB does, "reversed" not at all; or "hundredths": .npy of integers.
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/hdf5_output.h"
#include "engine/io/base/npy.h"

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace episcope;

std::size_t length(int pixels) {
  return static_cast<std::size_t>(pixels);
}

void write_views(io::Hdf5Output& out, const char* name, const Image<float>& map,
                 std::size_t views) {
  const std::size_t height = length(map.height()), width = length(map.width());
  if (views == 0) {
    out.add_dataset<float>(name, {height, width}, "", "");
    out.write(name, {{0, 0}, {height, width}}, map.data());
    return;
  }
  out.add_dataset<float>(name, {views, views, height, width}, "", "");
  for (std::size_t view = 0; view < views * views; ++view) {
    out.write(name, {{view / views, view % views, 0, 0}, {1, 1, height, width}}, map.data());
  }
}

void write_reversed(io::Hdf5Output& out, const char* name, const Image<float>& map,
                    const std::string& form) {
  std::vector<float> columns;
  for (int x = 0; x < map.width(); ++x) {
    for (int y = 0; y < map.height(); ++y) columns.push_back(map.at(y, x));
  }
  const io::Hdf5Shape shape{length(map.width()), length(map.height())};
  out.add_dataset<float>(name, shape, form == "x,y" ? form : "", "");
  out.write(name, {{0, 0}, shape}, columns.data());
  if (form == "matlab") out.set_ascii(name, "MATLAB_class", "single");
}

void write_hundredths(const char* path, const Image<float>& map) {
  std::vector<std::int32_t> values;
  for (const float d : map) values.push_back(static_cast<std::int32_t>(std::lround(100 * d)));
  io::write_npy<std::int32_t>(path, {length(map.height()), length(map.width())}, values);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) return 2;
  const Image<float> map = io::read_pfm(argv[1]);
  const std::string form = argv[3];
  if (form == "hundredths") {
    write_hundredths(argv[2], map);
    return 0;
  }
  io::AtomicFile target(argv[2]);
  io::Hdf5Output out(target);
  const bool is_reversed = form == "x,y" || form == "matlab" || form == "reversed";
  for (int i = 4; i < argc; ++i) {
    if (is_reversed) {
      write_reversed(out, argv[i], map, form);
    } else {
      write_views(out, argv[i], map, static_cast<std::size_t>(std::atoi(argv[3])));
    }
  }
  out.close();
  target.commit();
  return 0;
}
