// SPDX-License-Identifier: BSD-3-Clause
#include "tests/app/gui/agreement/sample_scene.h"

#include "app/gui/estimate/result_export.h"
#include "app/session/command_line.h"
#include "app/session/scene_summary.h"
#include "engine/io/formats/write_scene.h"

#include <QDir>
#include <QFile>
#include <QTest>

#include <cmath>
#include <limits>
#include <variant>

namespace episcope {
namespace {

using Truth = SampleScene::Truth;

constexpr int kSize = 48;
constexpr int kHoleStep = 11;  // every so many pixels there is none

template <class T>
ViewStack<T> view_of(const ViewStack<T>& stack, ViewIndex view) {
  if (stack.empty()) return {};
  ViewStack<T> one({1, 1}, stack.height(), stack.width(), 1, view);
  std::copy_n(stack.view(view).data, one.size(), one.data());
  return one;
}

DisparityField view_of(const DisparityField& field, ViewIndex view) {
  return {view_of(field.disparity, view), view_of(field.valid, view)};
}

DisparityField with_holes(const DisparityField& field, int first) {
  DisparityField result{field.disparity.clone(), {}};
  if (field.empty()) return result;
  const auto& maps = field.disparity;
  result.valid = ViewStack<std::uint8_t>(maps.grid(), maps.height(), maps.width(), 1, maps.first());
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const bool is_hole = (static_cast<int>(i) + first) % kHoleStep == 0;
    result.valid.data()[i] = is_hole ? 0 : 1;
  }
  return result;
}

GroundTruthPtr truth_of(const SampleScene& sample, const Scene& scene) {
  const GroundTruth& all = *scene.truth;
  auto truth = std::make_shared<GroundTruth>();
  if (sample.truth == Truth::None) return truth;
  const ViewIndex center = scene.light_field->center();
  const auto part = [&](const DisparityField& field) -> DisparityField {
    if (sample.truth == Truth::CenterView) return view_of(field, center);
    if (sample.truth == Truth::WithHoles) return with_holes(field, 0);
    return {field.disparity.clone(), field.valid.clone()};
  };
  truth->field = part(all.field);
  truth->foreground = part(all.foreground);
  truth->background = part(all.background);
  truth->labels =
      sample.truth == Truth::CenterView ? view_of(all.labels, center) : all.labels.clone();
  truth->regions = all.regions;
  return truth;
}

LightFieldPtr without_camera(const LightField& light_field) {
  LightFieldInfo info = light_field.info();
  info.camera = {};
  auto samples = std::visit([](const auto& stack) { return LightField::Samples(stack.clone()); },
                            light_field.samples());
  return std::make_shared<const LightField>(std::move(samples), std::move(info));
}

QString write(const SampleScene& sample, const QString& folder) {
  scenes::RenderOptions options;
  options.grid = sample.grid;
  options.height = options.width = kSize;
  Scene scene = scenes::render_builtin(sample.builtin, options, Progress());
  scene.truth = truth_of(sample, scene);
  if (!sample.has_camera) scene.light_field = without_camera(*scene.light_field);
  if (sample.is_benchmark_form) {
    io::write_benchmark_folder(folder.toStdString(), scene, Progress());
    return folder;
  }
  QDir().mkpath(folder);
  io::write_archive((folder + "/lf.h5").toStdString(), scene, Progress());
  return folder + "/lf.h5";
}

// What there is of the truth, off by a pattern, with holes.
DisparityField near_to(const DisparityField& truth, const LightField& light_field, float offset) {
  DisparityField field;
  field.disparity = ViewStack<float>(light_field.grid(), light_field.height(), light_field.width());
  for (int i = 0; i < light_field.grid().count(); ++i) {
    const ViewIndex view = light_field.grid().view_at(i);
    float* out = field.disparity.view(view).data;
    for (std::size_t k = 0; k < field.disparity.view_size(); ++k) {
      const float base = truth.contains(view) ? truth.disparity.view(view).data[k] : 0;
      out[k] = (std::isfinite(base) ? base : 0) + offset * static_cast<float>(k % 9 + k / 300);
    }
  }
  return with_holes(field, 3);
}

Estimate full_estimate(const Scene& scene) {
  const LightField& light_field = *scene.light_field;
  const GroundTruth& truth = *scene.truth;
  Estimate estimate;
  estimate.method = "epi_two_layer";
  estimate.seconds = 1.25;
  estimate.source_hash = light_field.sample_hash();
  estimate.reading = light_field.info().reading;
  estimate.field =
      near_to(truth.has_disparity() ? truth.field : truth.foreground, light_field, 0.013F);
  estimate.confidence =
      ViewStack<float>(light_field.grid(), light_field.height(), light_field.width());
  for (std::size_t i = 0; i < estimate.confidence.size(); ++i) {
    estimate.confidence.data()[i] = static_cast<float>(i % 101) / 100;
  }
  estimate.layered.foreground = near_to(truth.foreground, light_field, 0.021F);
  estimate.layered.background = near_to(truth.background, light_field, -0.017F);
  estimate.layered.layers =
      ViewStack<std::uint8_t>(light_field.grid(), light_field.height(), light_field.width());
  for (std::size_t i = 0; i < estimate.layered.layers.size(); ++i) {
    estimate.layered.layers.data()[i] = static_cast<std::uint8_t>(1 + i / 7 % 2);
  }
  return estimate;
}

Estimate center_estimate(const Scene& scene) {
  const LightField& light_field = *scene.light_field;
  Estimate estimate;
  estimate.method = "st_av_l";
  estimate.seconds = 0.5;
  estimate.source_hash = light_field.sample_hash();
  estimate.reading = light_field.info().reading;
  estimate.field = view_of(near_to(scene.truth->field, light_field, -0.02F), light_field.center());
  return estimate;
}

}  // namespace

const std::vector<SampleScene>& sample_scenes() {
  static const std::vector<SampleScene> samples{
      {.name = "labels", .builtin = "objects"},
      {.name = "masks and a camera", .builtin = "objects", .is_benchmark_form = true},
      {.name = "masks without a camera",
       .builtin = "objects",
       .is_benchmark_form = true,
       .has_camera = false,
       .is_drawn = false},
      {.name = "two layers", .builtin = "transparent", .is_drawn = false},
      {.name = "two layers of 3x3 views", .builtin = "transparent", .grid = {3, 3}},
      {.name = "one view", .builtin = "objects", .grid = {1, 1}},
      {.name = "truth of the center", .builtin = "objects", .truth = Truth::CenterView},
      {.name = "truth with holes", .builtin = "slant", .truth = Truth::WithHoles},
      {.name = "no truth", .builtin = "edge", .truth = Truth::None},
      {.name = "another focus plane", .builtin = "objects", .focus_px = 0.5}};
  return samples;
}

AgreementFixture::AgreementFixture(const SampleScene& sample) {
  // The shell has to quote such a path.
  const QString file = write(sample, path(QString("it's %1").arg(sample.name)));
  const auto wait_for_other_than = [this](const std::shared_ptr<const Scene>& before) {
    QVERIFY(QTest::qWaitFor(
        [&] { return session().scene() != before && window.bench().jobs.count() == 0; },
        kScenePatience));
  };
  window.bench().opener.open(file);
  wait_for_other_than(nullptr);
  if (sample.focus_px != 0) {
    const auto before = session().scene();
    window.bench().opener.reopenAt(sample.focus_px, [] {});
    wait_for_other_than(before);
  }
  addResults();
}

void AgreementFixture::addResults() {
  const auto add = [this](Estimate estimate) {
    const auto held = std::make_shared<const Estimate>(std::move(estimate));
    session().add_estimate(held, display_range(*held), session().generation());
  };
  add(full_estimate(*session().scene()));
  add(center_estimate(*session().scene()));
  session().show_estimate(first().id);
  QCoreApplication::processEvents();  // the session tells the window of them one turn later
}

QStringList AgreementFixture::input() {
  const std::string options = reading_options_text(session().reading_options());
  return QStringList{QString::fromStdString(session().input())} +
         QString::fromStdString(options).split(' ', Qt::SkipEmptyParts);
}

QString AgreementFixture::exported(const EstimateEntry& entry) {
  const QString file = path(QString("result_%1.h5").arg(entry.id));
  if (QFile::exists(file)) return file;
  export_result(window.bench(), entry, file);
  return waitForFile(file) ? file : QString();
}

bool AgreementFixture::waitForFile(const QString& file) {
  return QTest::qWaitFor([&] { return QFile::exists(file) && window.bench().jobs.count() == 0; },
                         kPatience);
}

}  // namespace episcope
