// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/seed_scene.h"

#include "engine/io/models/reader.h"
#include "engine/io/open.h"
#include "engine/io/write.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/fuzz/harness.h"

namespace episcope::fuzz {

const Scene& seed_scene() {
  static const Scene scene = test::plane_scene({.grid = {3, 3}, .height = 6, .width = 8});
  return scene;
}

void write_seed(const std::string& writer, const std::filesystem::path& path) {
  io::writer_named(writer)->write(path, seed_scene(), Progress(1));
}

void look_at_light_field(const std::filesystem::path& path) {
  tolerate([&] {
    const io::FoundReader found = io::find_reader(path, {});
    if (found.reader && found.reader->probe) (void)found.reader->probe(found.path, {});
  });
}

void open_light_field(const std::filesystem::path& path) {
  look_at_light_field(path);
  (void)io::open_scene(path, {}, progress_of_reading());
}

}  // namespace episcope::fuzz
