// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/run/open_scene.h"

#include "app/benchmark/run/label_runs.h"
#include "app/benchmark/run/scene_fingerprint.h"
#include "app/session/scene/scene_range.h"
#include "engine/core/error.h"

#include <fmt/format.h>

namespace episcope {

std::string OpenScene::whole_fingerprint() const {
  return labels_fingerprint.empty() ? fingerprint : text_fingerprint(labels_fingerprint);
}

OpenScene open_benchmark_scene(const BenchmarkOptions& options, const std::string& input,
                               const SceneLoader& load, const std::set<std::string>& taken,
                               const Progress& progress) {
  OpenScene open{load(input, progress), {}, input, {}, {}, {}};
  open.name = unused_name(open.scene.light_field->info().name, taken);
  open.fingerprint = scene_fingerprint(open.scene);
  if (!options.labels.empty()) {
    open.labels_fingerprint = open.fingerprint + label_fingerprint(open.scene);
  }
  open.range = known_disparity_range(open.scene);
  return open;
}

void require_unchanged(const OpenScene& open, const std::string& whole_fingerprint) {
  if (open.whole_fingerprint() == whole_fingerprint) return;
  throw InvalidInput(open.input +
                     ": the scene has changed since the plan was made; make the plan again with "
                     "--plan or --slurm, which keeps what is still valid");
}

std::string unused_name(const std::string& wanted, const std::set<std::string>& taken) {
  std::string name = wanted;
  for (int copy = 2; taken.contains(name); ++copy) name = fmt::format("{}-{}", wanted, copy);
  return name;
}

}  // namespace episcope
