// SPDX-License-Identifier: BSD-3-Clause
#include "tests/app/soak/chores.h"

#include "app/session/judge.h"
#include "app/session/load_scene.h"
#include "app/session/project_file.h"
#include "app/session/result_files.h"
#include "app/session/run_estimator.h"
#include "engine/core/error.h"
#include "engine/core/memory.h"
#include "engine/disparity/registry.h"
#include "engine/io/models/scribble_file.h"
#include "engine/io/open.h"
#include "engine/io/write.h"
#include "engine/labeling/labeler.h"
#include "tests/app/session/tiny_scene.h"

#include <stdexcept>
#include <stop_token>
#include <string>

namespace episcope::test {
namespace {

namespace fs = std::filesystem;

void require(bool is_so, const std::string& what) {
  if (!is_so) throw std::runtime_error("soak: " + what);
}

Scribbles two_strokes(const LightField& lf) {
  Image<std::int32_t> painted(lf.height(), lf.width(), 1, 0);
  for (int x = 8; x < 56; ++x) {
    painted.at(10, x) = 1;
    painted.at(50, x) = 2;
  }
  Scribbles scribbles;
  scribbles.views.push_back({lf.center(), std::move(painted)});
  return scribbles;
}

}  // namespace

Chores::Chores(const fs::path& folder) : folder_(folder), scene_(tiny_scene("edge", {3, 3})) {
  fs::create_directories(folder_);
}

void Chores::do_all(int round) const {
  exchange_forms();
  estimate(round);
  estimate_in_blocks();
  cancel_a_run();
  label();
  keep_a_project(round);
  refuse_damaged_files();
  for (const auto& entry : fs::directory_iterator(folder_)) fs::remove_all(entry);
}

void Chores::exchange_forms() const {
  for (const io::Writer& writer : io::writers()) {
    const std::string suffix = writer.writes_folder() ? "" : writer.suffixes.front();
    const fs::path path = folder_ / (std::string("form_") + writer.id + suffix);
    writer.write(path, *scene_, Progress());
    io::OpenOptions options;
    options.grid = "3x3";
    if (!writer.holds.has_rows) {
      options.mosaic = io::Mosaic::Quilt;
      options.grid = "1x3";
    }
    const Scene opened = io::open_scene(path, options, Progress());
    const GridShape grid = scene_->light_field->grid();
    require(opened.light_field->grid() == (writer.holds.has_rows ? grid : GridShape{1, grid.u}),
            path.string());
  }
}

void Chores::estimate(int round) const {
  const LightField& lf = *scene_->light_field;
  for (const Estimator& method : registered_estimators()) {
    const RunOptions options{.threads = 1 + round % 2};
    const FinishedEstimate made = run_estimator(*scene_, method, {}, options, Progress());
    const fs::path path = folder_ / (method.info.id + ".h5");
    save_result(path, *made.estimate, "demo:edge", Progress());
    const Estimate read = read_result_of(lf, path);
    const Evaluation evaluation = judge(read, *scene_, {});
    require(!evaluation.metrics.empty(), method.info.id + " was not judged");
  }
}

void Chores::estimate_in_blocks() const {
  BlockRequest request;
  request.run.method = "epi_s";
  request.output = folder_ / "blocks.h5";
  request.input = "demo:edge";
  request.memory = {40 << 20, 40 << 20};
  const FinishedBlocks made =
      run_in_blocks(*scene_->light_field, find_estimator("epi_s"), request, Progress());
  require(made.provenance.method == "epi_s" && fs::exists(request.output), "no result of blocks");
}

void Chores::cancel_a_run() const {
  std::stop_source stop;
  stop.request_stop();
  try {
    const Progress stopped(stop.get_token(), {});
    static_cast<void>(run_estimator(*scene_, find_estimator("epi_c"), {}, {}, stopped));
    require(false, "a run was not cancelled");
  } catch (const Cancelled&) {
  }
}

void Chores::label() const {
  const Scribbles scribbles = two_strokes(*scene_->light_field);
  const auto truth = std::shared_ptr<const DisparityField>(scene_->truth, &scene_->truth->field);
  Labeler labeler(scene_->light_field, truth);
  const ViewRectangle all{{}, scene_->light_field->grid()};
  const Labeling labeling = labeler.label(scribbles, {}, all, Progress());
  require(labeling.labels.grid() == all.grid, "not all views were labeled");
  io::write_scribbles(folder_ / "labels.h5", scribbles, *scene_, Progress());
  require(!io::read_scribbles(folder_ / "labels.h5", *scene_, Progress()).views.empty(),
          "no strokes were read");
}

void Chores::keep_a_project(int round) const {
  Project project;
  ProjectScene scene;
  scene.name = scene.input = "demo:edge";
  project.scenes.push_back(scene);
  project.bad_threshold_px = 0.01 * (1 + round % 9);
  const fs::path path = folder_ / "day.episcope";
  write_project(path, project);
  require(read_project(path).scenes.size() == 1, "a project lost its scene");
}

void Chores::refuse_damaged_files() const {
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (!entry.is_regular_file()) continue;
    fs::resize_file(entry.path(), fs::file_size(entry.path()) / 2);
    try {
      static_cast<void>(load_scene(entry.path().string(), {}, Progress()));
    } catch (const Error&) {
    }
  }
}

}  // namespace episcope::test
