// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/reader.h"

#include "engine/io/archive/archive_reader.h"
#include "engine/io/archive/excerpt_reader.h"
#include "engine/io/arrays/hdf5_array_reader.h"
#include "engine/io/arrays/matlab_reader.h"
#include "engine/io/arrays/numpy_reader.h"
#include "engine/io/benchmark/benchmark_reader.h"
#include "engine/io/blender/blender_reader.h"
#include "engine/io/durable/system_error.h"
#include "engine/io/frames/frames_reader.h"
#include "engine/io/grid/image_grid_reader.h"
#include "engine/io/mosaic/mosaic_reader.h"
#include "engine/io/sequence/sequence_reader.h"

#include <algorithm>

namespace episcope::io {

namespace fs = std::filesystem;

std::span<const Reader> readers() {
  static const Reader kReaders[] = {blender_reader(), sequence_reader(),  frames_reader(),
                                    mosaic_reader(),  matlab_reader(),    hdf5_array_reader(),
                                    numpy_reader(),   archive_reader(),   benchmark_reader(),
                                    excerpt_reader(), image_grid_reader()};
  return kReaders;
}

bool Reader::has_option(std::string_view key) const {
  const bool is_of_all = key == "equalise" || key == "no-equalise";  // assemble_scene.h
  return is_of_all || std::ranges::find(options, key) != options.end();
}

FoundReader find_reader(const fs::path& path, const OpenOptions& options) {
  if (!fs::is_directory(path)) require_readable_file(path);
  for (const Reader& reader : readers()) {
    if (fs::path found = reader.find(path, options); !found.empty()) {
      return {&reader, std::move(found)};
    }
  }
  return {};
}

const Reader* reader_named(const std::string& id) {
  const auto all = readers();
  const auto found = std::ranges::find(all, id, &Reader::id);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace episcope::io
