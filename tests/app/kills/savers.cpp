// SPDX-License-Identifier: BSD-3-Clause
#include "tests/app/kills/savers.h"

#include "app/session/project_file.h"
#include "engine/capture/camera.h"
#include "engine/capture/solve_pose.h"
#include "engine/core/point_cloud.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/formats/archive_companions.h"
#include "engine/io/formats/movie.h"
#include "engine/io/models/result_file.h"
#include "engine/io/models/scribble_file.h"
#include "engine/io/write.h"
#include "tests/app/session/tiny_scene.h"

#include <utility>

namespace episcope::test {
namespace {

namespace fs = std::filesystem;

constexpr int kLabels = 3;

const Scene& scene_of(Variant variant) {
  static const auto a = tiny_scene("edge"), b = tiny_scene("slant");
  return variant == Variant::A ? *a : *b;
}

// Differs between variants in every number.
double number_of(Variant variant) {
  return variant == Variant::A ? 0.125 : 0.875;
}

ViewStack<float> flat_views(Variant variant) {
  const LightField& lf = *scene_of(variant).light_field;
  ViewStack<float> views(lf.grid(), lf.height(), lf.width(), 1, {});
  std::fill_n(views.data(), views.size(), static_cast<float>(number_of(variant)));
  return views;
}

io::ViewProbabilities probabilities_of(Variant variant) {
  const LightField& lf = *scene_of(variant).light_field;
  auto votes = std::make_shared<Volume<std::uint8_t>>(lf.height(), kLabels, lf.width());
  std::fill_n(votes->view().data, votes->view().size(),
              static_cast<std::uint8_t>(100 * number_of(variant)));
  return [votes](ViewIndex) { return std::as_const(*votes).view(); };
}

std::vector<LabelInfo> label_infos() {
  std::vector<LabelInfo> infos;
  for (int id = 1; id <= kLabels; ++id) {
    infos.push_back({id, "label " + std::to_string(id), label_color(id)});
  }
  return infos;
}

void save_segmentation(const fs::path& path, Variant variant) {
  io::StoredSegmentation stored;
  stored.labels = scene_of(variant).truth->labels.clone();
  stored.infos = label_infos();
  stored.seconds = number_of(variant);
  io::write_segmentation(path, stored, probabilities_of(variant), Progress());
}

void save_scribbles(const fs::path& path, Variant variant) {
  const Scene& scene = scene_of(variant);
  Image<std::int32_t> painted(scene.light_field->height(), scene.light_field->width(), 1);
  std::fill_n(painted.data(), painted.size() / 2, variant == Variant::A ? 1 : 2);
  Scribbles scribbles;
  scribbles.views.push_back({{1, 1}, std::move(painted)});
  scribbles.labels = label_infos();
  io::write_scribbles(path, scribbles, scene, Progress());
}

void save_cloud(const fs::path& path, Variant variant) {
  PointCloud cloud;
  for (int i = 0; i < 20000; ++i) {
    cloud.positions.push_back({static_cast<float>(i), static_cast<float>(number_of(variant)), 0});
    cloud.colors.push_back({1, 2, 3});
  }
  io::write_ply(path, cloud);
}

void save_movie(const fs::path& path, Variant variant) {
  io::MovieFile movie(path, {.height = 64, .width = 64});
  Image<std::uint8_t> picture(64, 64, 4);
  for (int frame = 0; frame < 4; ++frame) {
    const auto level = static_cast<std::uint8_t>(200 * number_of(variant) + 10 * frame);
    std::fill_n(picture.data(), picture.size(), level);
    movie.add(picture.view());
  }
  movie.commit();
}

std::vector<capture::PointPair> pairs_of(Variant variant) {
  const double z = number_of(variant);
  return {{"corner", 10 * z, 20, {1, 2, z}}, {"tip", 30, 40 * z, {z, 5, 6}}};
}

void save_pose(const fs::path& path, Variant variant) {
  capture::PoseStory story;
  story.mesh = path.parent_path() / "mesh.ply";
  story.solved.reprojection_error_px = number_of(variant);
  capture::write_pose(path, story);
}

void save_project(const fs::path& path, Variant variant) {
  Project project;
  ProjectScene scene;
  scene.name = scene.input = variant == Variant::A ? "demo" : "demo:edge";
  project.scenes.push_back(scene);
  project.bad_threshold_px = number_of(variant);
  write_project(path, project);
}

void save_log(const fs::path& path, Variant variant) {
  const io::LogRecord record(20000, static_cast<std::uint8_t>(200 * number_of(variant)));
  const std::vector<io::LogRecord> records(20, record);
  const io::AppendLog log(path, io::LogFraming::Checked, io::LogFlush::AtOnce, records);
}

void add_forms(std::vector<Saver>& savers) {
  for (const io::Writer& writer : io::writers()) {
    const std::string suffix = writer.writes_folder() ? "" : writer.suffixes.front();
    savers.push_back({std::string("form ") + writer.id, "saved" + suffix, writer.writes_folder(),
                      [&writer](const fs::path& path, Variant variant) {
                        writer.write(path, scene_of(variant), Progress());
                      }});
  }
}

void add_results(std::vector<Saver>& savers) {
  savers.push_back({"result", "result.h5", false, [](const fs::path& path, Variant variant) {
                      const Scene& scene = scene_of(variant);
                      io::write_result(path, *shifted_truth(scene, 0.5F), Progress());
                    }});
  savers.push_back({"map", "map.pfm", false, [](const fs::path& path, Variant variant) {
                      const ViewStack<float> views = flat_views(variant);
                      io::write_pfm(path, views.view({1, 1}));
                    }});
  savers.push_back({"cloud", "cloud.ply", false, save_cloud});
  savers.push_back({"movie", "movie.gif", false, save_movie});
  savers.push_back({"frames", "frames", true, save_movie});
}

void add_labels(std::vector<Saver>& savers) {
  savers.push_back({"segmentation", "segments.h5", false, save_segmentation});
  savers.push_back({"strokes", "labels.h5", false, save_scribbles});
  savers.push_back({"edge weights", "edges.h5", false, [](const fs::path& path, Variant variant) {
                      io::write_edge_probabilities(path, flat_views(variant), scene_of(variant),
                                                   Progress());
                    }});
  savers.push_back({"probabilities", "votes.h5", false, [](const fs::path& path, Variant variant) {
                      io::write_label_probabilities(path, kLabels, probabilities_of(variant),
                                                    scene_of(variant), Progress());
                    }});
}

void add_captures(std::vector<Saver>& savers) {
  savers.push_back({"camera", "camera.yml", false, [](const fs::path& path, Variant variant) {
                      capture::LensCamera camera;
                      camera.rms = number_of(variant);
                      capture::write_camera(path, camera);
                    }});
  savers.push_back({"pairs", "pairs.csv", false, [](const fs::path& path, Variant variant) {
                      capture::write_pairs(path, pairs_of(variant));
                    }});
  savers.push_back({"pose", "pose.json", false, save_pose});
}

}  // namespace

std::vector<Saver> savers() {
  std::vector<Saver> savers;
  add_forms(savers);
  add_results(savers);
  add_labels(savers);
  add_captures(savers);
  savers.push_back({"project", "day.episcope", false, save_project});
  savers.push_back({"log", "strokes.log", false, save_log});
  return savers;
}

}  // namespace episcope::test
