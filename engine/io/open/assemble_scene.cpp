// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/assemble_scene.h"

#include "engine/io/maps/float_samples.h"
#include "engine/io/open/equalise.h"

#include <utility>

namespace episcope::io {

void assemble(SceneParts parts, const OpenOptions& options, Scene& scene,
              const Progress& progress) {
  put_in_order(parts.samples, parts.truth, parts.expected, options.flip, scene.convention,
               progress);
  const GridShape grid = parts.valid.grid();
  reverse_views(parts.valid, grid, flip_of(scene.convention));
  scene.convention.files = std::move(parts.files);
  zero_nonfinite_samples(parts.samples, scene.convention);
  equalise_views(parts, options.equalise, scene.convention, progress);
  std::string& samples_text = scene.convention.samples;
  if (samples_text.empty()) samples_text = stored_samples_text(parts.samples);
  parts.info.reading.options = given_options(options);
  parts.info.reading.set_focus(0);  // baked in afterwards, if at all
  scene.light_field = std::make_shared<LightField>(std::move(parts.samples), std::move(parts.info),
                                                   std::move(parts.valid));
  if (!options.needs_truth) parts.truth = {};
  scene.truth = std::make_shared<GroundTruth>(std::move(parts.truth));
}

}  // namespace episcope::io
