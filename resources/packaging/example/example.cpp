// SPDX-License-Identifier: BSD-3-Clause
// Opens a light field, runs a method, writes the disparity: example lf.h5 out.h5
#include "engine/disparity/registry.h"
#include "engine/io/models/result_file.h"
#include "engine/io/open.h"

int main(int argc, char** argv) {
  using namespace episcope;
  if (argc != 3) return 2;
  const Progress progress;
  const Scene scene = io::open_scene(argv[1], {}, progress);
  const Estimator method = find_estimator("epi_l");
  io::write_result(argv[2], method.run(*scene.light_field, {}, {}, progress), progress);
}
