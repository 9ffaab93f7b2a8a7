// SPDX-License-Identifier: BSD-3-Clause
// big_light_field OUT.h5 ROWSxCOLUMNS WIDTHxHEIGHT [SCENE]: a light field of any size in the
// archive form, as large files are tried with: a built-in scene of 256×256 px, repeated over the
// views, so that a view is made at the speed of the disk. 27x27 4096x2160 takes 19.3 GB.
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/hdf5_output.h"
#include "engine/scenes/builtin.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>

namespace {

using namespace episcope;

constexpr int kTile = 256;

struct Extent {
  int first = 0, second = 0;
};

Extent extent_in(const char* text) {
  Extent extent;
  return std::sscanf(text, "%dx%d", &extent.first, &extent.second) == 2 ? extent : Extent{};
}

// A view of the tile, repeated.
void repeat(ImageView<const std::uint8_t> tile, ImageView<std::uint8_t> view) {
  const int row_size = view.width * view.channels, tile_size = tile.width * tile.channels;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < row_size; x += tile_size) {
      std::copy_n(tile.row(y % tile.height), std::min(tile_size, row_size - x), view.row(y) + x);
    }
  }
}

void write(const char* path, const LightField& tile, Extent size) {
  const GridShape grid = tile.grid();
  const auto length = [](int value) { return static_cast<std::size_t>(value); };
  Image<std::uint8_t> view(size.second, size.first, tile.channels());
  io::AtomicFile target(path, view.size() * length(grid.count()));
  io::Hdf5Output file(target);
  file.set_text("/", "convention", "as Episcope writes it");
  file.set_text("/", "name", "big");
  file.add_dataset<std::uint8_t>("LF",
                                 {length(grid.v), length(grid.u), length(size.second),
                                  length(size.first), length(tile.channels())},
                                 "v,u,y,x,c", "");
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex at = grid.view_at(i);
    repeat(tile.view<std::uint8_t>(at), view.view());
    file.write("LF",
               {{length(at.v), length(at.u), 0, 0, 0},
                {1, 1, length(size.second), length(size.first), length(tile.channels())}},
               view.data());
  }
  file.close();
  target.commit();
}

}  // namespace

int main(int argc, char** argv) {
  const Extent views = argc > 3 ? extent_in(argv[2]) : Extent{};
  const Extent size = argc > 3 ? extent_in(argv[3]) : Extent{};
  if (views.first < 1 || views.second < 1 || size.first < 1 || size.second < 1) {
    std::fputs("big_light_field OUT.h5 ROWSxCOLUMNS WIDTHxHEIGHT [SCENE]\n", stderr);
    return 2;
  }
  scenes::RenderOptions options;
  options.grid = {views.first, views.second};
  options.height = options.width = kTile;
  const Scene tile = scenes::render_builtin(argc > 4 ? argv[4] : "demo", options, Progress());
  write(argv[1], *tile.light_field, size);
  return 0;
}
