// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/archive_companions.h"
#include "engine/io/models/scribble_file.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/seed_scene.h"

namespace episcope::fuzz {
namespace {

void write_seeds(const std::filesystem::path& folder) {
  const Scene& scene = seed_scene();
  io::write_scribbles(folder / "scribbles.h5", scene.scribbles, scene, Progress(1));
  io::StoredSegmentation labeling{scene.truth->labels.clone(),
                                  {{1, "left", {255, 0, 0}}, {2, "right", {0, 255, 0}}},
                                  {},
                                  "lf.h5"};
  const Volume<std::uint8_t> even = io::bytes_of(Image<float>(6, 8, 2, 0.5F));
  io::write_segmentation(
      folder / "segmentation.h5", labeling, [&](ViewIndex) { return even.view(); }, Progress(1));
  write_seed("archive", folder / "lf.h5");
  std::filesystem::remove(folder / "lf.h5");  // labels.h5 is beside it
  io::write_edge_probabilities(folder / "edges.h5", ViewStack<float>({3, 3}, 6, 8), scene,
                               Progress(1));
}

void read_segmentation(const std::filesystem::path& path) {
  const io::SegmentationFile file(path);
  if (!file.contains(file.first())) return;
  (void)file.labels(file.first());
  if (file.has_probabilities()) (void)file.probabilities(file.first());
  (void)file.reading();
}

/// All that may be asked of a file of labels.
void read(const std::filesystem::path& file) {
  const Scene& scene = seed_scene();
  tolerate([&] { (void)io::read_scribbles(file, scene, Progress(1)); });
  tolerate([&] { (void)io::read_true_labels(file, scene, Progress(1)); });
  tolerate([&] { read_segmentation(file); });
  tolerate([&] { (void)io::read_edge_probabilities(file, scene, Progress(1)); });
  const io::ProbabilityFile probabilities(file, scene);
  const ViewIndex center = scene.light_field->center();
  if (probabilities.contains(center)) (void)probabilities.view(center);
}

}  // namespace

const Harness kHarness{[](std::string_view) { return std::string("labels.h5"); }, read,
                       write_seeds};

}  // namespace episcope::fuzz
