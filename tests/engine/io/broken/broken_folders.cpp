// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/formats/write_scene.h"
#include "tests/engine/io/broken/broken.h"
#include "tests/engine/io/synthetic_scene.h"

#include <fmt/format.h>

#include <array>
#include <fstream>

namespace episcope::test {
namespace in_broken_folders {

namespace fs = std::filesystem;

/// Views of that grid without which no part of it is worth opening.
constexpr std::array kTooMany{"0_0.png", "0_2.png", "1_1.png", "2_0.png"};

fs::path image_grid(const fs::path& folder) {
  for (int i = 0; i < 9; ++i) {
    const Image<std::uint8_t> view(8, 9, 3, static_cast<std::uint8_t>(i));
    io::write_png(folder / (std::to_string(i / 3) + "_" + std::to_string(i % 3) + ".png"),
                  view.view());
  }
  return folder;
}

fs::path benchmark(const fs::path& folder) {
  PlaneOptions options;
  options.grid = {3, 3};
  io::write_benchmark_folder(folder / "scene", plane_scene(options), Progress(1));
  return folder / "scene";
}

/// Changes width and height in the header of a PNG, and its checksum with them.
void claim_size(const fs::path& path, std::uint32_t side) {
  constexpr std::size_t kHeader = 12;  // signature and length come before the type of the chunk
  std::array<std::uint8_t, 4 + 13> header{};
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(kHeader);
  file.read(reinterpret_cast<char*>(header.data()), header.size());
  const auto put = [](std::uint8_t* to, std::uint32_t number) {
    for (int i = 0; i < 4; ++i) to[i] = static_cast<std::uint8_t>(number >> (24 - 8 * i));
  };
  put(header.data() + 4, side);
  put(header.data() + 8, side);
  std::array<std::uint8_t, 4> sum{};
  put(sum.data(), io::checksum(header));
  file.seekp(kHeader);
  file.write(reinterpret_cast<const char*>(header.data()), header.size());
  file.write(reinterpret_cast<const char*>(sum.data()), sum.size());
}

}  // namespace in_broken_folders

std::vector<Broken> broken_folders() {
  using namespace in_broken_folders;
  return {
      {"no such path", [](const fs::path& f) { return f / "none"; }, "no such file"},
      {"empty folder", [](const fs::path& f) { return f; }, "the folder is empty"},
      {"folder of something else",
       [](const fs::path& f) {
         std::ofstream(f / "note.txt") << "x";
         return f;
       },
       "no light field in this folder"},
      {"another kind of file",
       [](const fs::path& f) {
         std::ofstream(f / "scene.xyz") << "x";
         return f / "scene.xyz";
       },
       "not a light field"},
      {"grid with views of another size",
       [](const fs::path& f) {
         image_grid(f);
         for (const char* name : kTooMany) {
           io::write_png(f / name, Image<std::uint8_t>(8, 8, 3).view());
         }
         return f;
       },
       "8×8 px, RGB, 8 bit, but 0_1.png has 9×8 px"},
      {"grid of other samples in some views",
       [](const fs::path& f) {
         image_grid(f);
         for (const char* name : kTooMany) {
           io::write_png(f / name, Image<std::uint16_t>(8, 9, 3).view());
         }
         return f;
       },
       "all views must match"},
      {"grid with damaged views",
       [](const fs::path& f) {
         image_grid(f);
         for (const char* name : kTooMany) std::ofstream(f / name) << "no picture";
         return f;
       },
       "0_0.png: the image cannot be decoded"},
      {"list with a gap",
       [](const fs::path& f) {
         for (const int i : {0, 1, 2, 3, 4, 6, 7, 8}) {
           io::write_png(f / (std::to_string(i) + ".png"), Image<std::uint8_t>(2, 2).view());
         }
         return f;
       },
       "view 5 is missing (pattern {index}.png matches 8 of 8 images"},
      {"grid with many missing views",
       [](const fs::path& f) {
         image_grid(f);
         for (const char* name : kTooMany) fs::remove(f / name);
         return f;
       },
       "4 views are missing: 0,0 0,2 1,1 2,0 (row,column as in the names; pattern {row}_{col}.png "
       "matches 5 of 5 images"},
      {"list that may be anything",
       [](const fs::path& f) {
         for (int i = 0; i < 6; ++i) {
           io::write_png(f / (std::to_string(i) + ".png"), Image<std::uint8_t>(9, 9).view());
         }
         return f;
       },
       "give --grid 2x3 (2 rows of 3 views), or --grid 3x2"},
      {"two grids of equal right",
       [](const fs::path& f) {
         for (const char* side : {"left", "right"}) {
           for (const char* place : {"0_0", "0_1", "1_0", "1_1"}) {
             io::write_png(f / (std::string(side) + place + ".png"),
                           Image<std::uint8_t>(2, 2).view());
           }
         }
         return f;
       },
       "two sets of 4 images could be the views, left{row}_{col}.png and right{row}_{col}.png"},
      {"several light fields in a folder",
       [](const fs::path& f) {
         for (int i = 0; i < 4; ++i) {
           io::write_png(f / ("IMG_" + std::to_string(i) + "_macpi.png"),
                         Image<std::uint8_t>(2, 2).view());
         }
         return f;
       },
       "IMG_0_macpi.png"},
      {"one picture",
       [](const fs::path& f) {
         io::write_png(f / "a.png", Image<std::uint8_t>(2, 2).view());
         return f;
       },
       "a.png: this is a single picture of 2×2 px and not recognized as a light field"},
      {"picture that claims more than its file can hold",
       [](const fs::path& f) {
         io::write_png(f / "a_eslf.png", Image<std::uint8_t>(2, 2).view());
         claim_size(f / "a_eslf.png", 60000);
         return f / "a_eslf.png";
       },
       "a_eslf.png: the image cannot be decoded"},
      {"several light fields, each in one picture",
       [](const fs::path& f) {
         for (const char* name : {"a_eslf.png", "b_eslf.png", "c_eslf.png", "d_eslf.png"}) {
           io::write_png(f / name, Image<std::uint8_t>(28, 28).view());
         }
         return f;
       },
       "the folder holds 4 light fields, each in one image (a_eslf.png, b_eslf.png, …)"},
      {"benchmark with many missing views",
       [](const fs::path& f) {
         const fs::path scene = benchmark(f);
         for (const int i : {0, 2, 4, 6}) fs::remove(scene / fmt::format("input_Cam00{}.png", i));
         return scene;
       },
       "input_Cam000.png: this view is missing: 5 of 9"},
      {"benchmark without cfg and with a missing view",
       [](const fs::path& f) {
         const fs::path scene = benchmark(f);
         fs::remove(scene / "parameters.cfg");
         fs::remove(scene / "input_Cam004.png");
         return scene;
       },
       "view 4 is missing"},
      {"benchmark with folders in place of views",
       [](const fs::path& f) {
         const fs::path scene = benchmark(f);
         for (const int i : {0, 2, 4, 6}) {
           const fs::path view = scene / fmt::format("input_Cam00{}.png", i);
           fs::remove(view);
           fs::create_directory(view);
         }
         return scene;
       },
       "this is a folder where a file is needed"},
      {"benchmark with empty views",
       [](const fs::path& f) {
         const fs::path scene = benchmark(f);
         for (const int i : {0, 2, 4, 6}) {
           fs::resize_file(scene / fmt::format("input_Cam00{}.png", i), 0);
         }
         return scene;
       },
       "input_Cam000.png: the file is empty"},
      {"benchmark of more views than there are numbers",
       [](const fs::path& f) {
         const fs::path scene = benchmark(f);
         std::ofstream(scene / "parameters.cfg") << "num_cams_x = 1e300\nnum_cams_y = 3\n";
         return scene;
       },
       "which is not possible"},
      {"grid with a picture that claims 100000×100000 px",
       [](const fs::path& f) {
         image_grid(f);
         fs::remove(f / "1_1.png");
         for (const auto& entry : fs::directory_iterator(f)) {
           fs::path other = entry.path();
           fs::rename(entry.path(), other.replace_extension(".ppm"));
         }
         for (int i = 0; i < 9; ++i) {
           std::ofstream(f / (std::to_string(i / 3) + "_" + std::to_string(i % 3) + ".ppm"))
               << "P6 100000 100000 255\n0123456789";
         }
         return f;
       },
       "the image cannot be decoded"},
      {"grid with a view that is a link to itself",
       [](const fs::path& f) {
         image_grid(f);
         for (const char* name : kTooMany) fs::remove(f / name);
         fs::create_symlink("2_0.png", f / "2_0.png");
         return f;
       },
       "views are missing: 0,0 0,2 1,1 2,0"},
      {"names that are not UTF-8",
       [](const fs::path& f) {
         for (const char* name : {"\xff\xfe.png", "\xc3\x28.png"}) {
           io::write_png(f / name, Image<std::uint8_t>(2, 2).view());
         }
         return f;
       },
       "do not form a grid of views"},
  };
}

}  // namespace episcope::test
