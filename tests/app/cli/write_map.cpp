// SPDX-License-Identifier: BSD-3-Clause
// write_map MAP.pfm OUT.h5 VIEWS DATASET…: an HDF5 file as other programs write them, with the map
// in each dataset named: [y][x] if VIEWS is 0, else [v][u][y][x] with VIEWS × VIEWS equal maps.
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/base/pfm.h"

#include <cstdlib>

int main(int argc, char** argv) {
  using namespace episcope;
  if (argc < 5) return 2;
  const Image<float> map = io::read_pfm(argv[1]);
  const auto height = static_cast<std::size_t>(map.height());
  const auto width = static_cast<std::size_t>(map.width());
  const auto views = static_cast<std::size_t>(std::atoi(argv[3]));
  io::AtomicFile target(argv[2]);
  io::Hdf5Output out(target);
  for (int i = 4; i < argc; ++i) {
    if (views == 0) {
      out.add_dataset<float>(argv[i], {height, width}, "", "");
      out.write(argv[i], {{0, 0}, {height, width}}, map.data());
      continue;
    }
    out.add_dataset<float>(argv[i], {views, views, height, width}, "", "");
    for (std::size_t view = 0; view < views * views; ++view) {
      out.write(argv[i], {{view / views, view % views, 0, 0}, {1, 1, height, width}}, map.data());
    }
  }
  out.close();
  target.commit();
  return 0;
}
