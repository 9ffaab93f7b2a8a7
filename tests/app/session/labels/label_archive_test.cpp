// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/labeling_inputs.h"

#include "engine/core/error.h"
#include "engine/io/formats/archive_companions.h"
#include "engine/io/models/scribble_file.h"
#include "engine/labeling/labeler.h"
#include "engine/scenes/builtin.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <vector>

namespace episcope::in_label_archive_test {

namespace {

Scene objects() {
  scenes::RenderOptions options;
  options.grid = {3, 3};
  options.height = options.width = 48;
  return scenes::render_builtin("objects", options, Progress());
}

LabelerParameters parameters_with(FeatureSet features) {
  LabelerParameters parameters;
  parameters.features = features;
  parameters.trees = 8;
  return parameters;
}

bool are_same(const ProbabilityMap& a, const ProbabilityMap& b) {
  return a.view().size() == b.view().size() &&
         std::equal(a.view().data, a.view().data + a.view().size(), b.view().data);
}

}  // namespace

class LabelArchiveTest : public QObject {
  Q_OBJECT

 private slots:
  void probabilities_comeBackBitByBit_andGiveTheSameLabels() {
    const Scene scene = objects();
    const Scribbles& painted = scene.scribbles;
    const QTemporaryDir folder;
    const std::filesystem::path path = folder.path().toStdString();
    const LabelerParameters parameters = parameters_with(FeatureSet::ImageTruth);
    const LabelingDisparity truth = find_labeling_disparity(scene, parameters, {}, Progress());
    Labeler labeler(scene.light_field, truth.field);
    const Labeling learned =
        labeler.label(painted, parameters, {{0, 0}, scene.light_field->grid()}, Progress());

    const auto written = write_label_archive(path, scene, painted, parameters, truth, Progress());
    LabelProbabilities read = read_all_probabilities(path / "feature_gt_depth_probabilities.h5",
                                                     scene, painted, Progress());

    QCOMPARE(written.size(), std::size_t{4});
    for (const std::string& file : written) QVERIFY(std::filesystem::exists(path / file));
    QVERIFY(read.ids == learned.probabilities.ids);
    for (std::size_t i = 0; i < read.views.size(); ++i) {
      QVERIFY(are_same(read.views[i], learned.probabilities.views[i]));
    }
    const Labeling again = labeler.smooth(std::move(read), painted, parameters, Progress());
    QVERIFY(std::equal(again.labels.data(), again.labels.data() + again.labels.size(),
                       learned.labels.data()));
  }

  void layersAreCounted_whereStrokesDoNotTell() {
    const Scene scene = objects();
    const QTemporaryDir folder;
    const std::filesystem::path file = std::filesystem::path(folder.path().toStdString()) / "p.h5";
    const ProbabilityMap even(48, 7, 48);
    io::write_label_probabilities(
        file, 7, [&](ViewIndex) { return even.view(); }, scene, Progress());

    const LabelProbabilities read = read_all_probabilities(file, scene, {}, Progress());

    QVERIFY((read.ids == std::vector<std::int32_t>{1, 2, 3, 4, 5, 6, 7}));
  }

  void probabilitiesOfSomeViews_areRefused() {
    const Scene scene = objects();
    LabelProbabilities one;
    one.ids = {1, 2};
    one.grid = {1, 1};
    one.views.emplace_back(48, 2, 48);
    LabelerParameters parameters = parameters_with(FeatureSet::Image);
    parameters.regularizer = Regularizer::View;

    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)Labeler(scene.light_field, nullptr)
                                               .smooth(std::move(one), {}, parameters, Progress()));
  }

  void strangeSamples_areBounded() {
    Image<float> samples(1, 1, 4);
    samples.at(0, 0, 0) = -1;
    samples.at(0, 0, 1) = 2;
    samples.at(0, 0, 2) = std::numeric_limits<float>::quiet_NaN();
    samples.at(0, 0, 3) = 0.5F;

    const Volume<std::uint8_t> bytes = io::bytes_of(samples);

    QCOMPARE(bytes.view().at(0, 0, 0), std::uint8_t{0});
    QCOMPARE(bytes.view().at(0, 1, 0), std::uint8_t{255});
    QCOMPARE(bytes.view().at(0, 2, 0), std::uint8_t{0});
    QCOMPARE(bytes.view().at(0, 3, 0), std::uint8_t{128});
  }
};

}  // namespace episcope::in_label_archive_test

EPISCOPE_TEST(label_archive_test, LabelArchiveTest)
#include "label_archive_test.moc"
