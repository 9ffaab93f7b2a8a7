// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/judge.h"

#include "app/session/result_files.h"
#include "app/session/result_fit.h"
#include "engine/core/error.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/models/result_file.h"
#include "tests/app/session/tiny_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <cmath>

namespace episcope::in_judge_test {

constexpr int kSide = 64;   // of the tiny scene
constexpr int kBorder = 8;  // of the maps that lack one

/// How a map ends.
enum class Border { Cut, Zero };

class JudgeTest : public QObject {
  Q_OBJECT
 private slots:
  void mapsThatLackABorder_areJudgedOnTheirPart_data() {
    QTest::addColumn<bool>("is_cut");
    QTest::newRow("smaller map") << true;
    QTest::newRow("frame of zeros") << false;
  }
  void mapsThatLackABorder_areJudgedOnTheirPart() {
    QFETCH(bool, is_cut);
    const auto scene = tiny_scene("slant");
    const std::filesystem::path file = write_map(*scene, is_cut ? Border::Cut : Border::Zero);

    const Estimate estimate = read_result_of(*scene->light_field, file);
    const Evaluation all = judge(estimate, *scene, {});
    const Evaluation inner = judge(estimate, *scene, {.protocol = Protocol::Benchmark2016});

    QCOMPARE(estimate.border_px, kBorder);
    QCOMPARE(estimate.notes.size(), std::size_t{1});
    const double side = kSide - 2 * kBorder;
    QVERIFY(std::abs(*find_metric(all.metrics, "mse_100") - 1) < 1e-4);  // 0.1 px, in float
    QCOMPARE(*find_metric(all.metrics, "density"), 100.0);
    QCOMPARE(*find_metric(all.metrics, "shown"), 100 * side * side / (kSide * kSide));
    QVERIFY(std::abs(*find_metric(inner.metrics, "mse_100") - 1) < 1e-4);
    QVERIFY(std::ranges::count(all.judged, 1) == side * side);
  }

  void border_isKeptWithTheResult() {
    const auto scene = tiny_scene("slant");
    const Estimate estimate = read_result_of(*scene->light_field, write_map(*scene, Border::Cut));
    const std::filesystem::path kept = folder_.filePath("kept.h5").toStdString();

    io::write_result(kept, estimate, Progress(1));
    const Estimate read = read_result_of(*scene->light_field, kept);

    QCOMPARE(read.border_px, kBorder);
    QVERIFY(judge(read, *scene, {}).metrics == judge(estimate, *scene, {}).metrics);
  }

  void runtime_isGivenAsItsLogarithm() {
    const auto scene = tiny_scene();
    Estimate estimate;
    estimate.field.disparity = scene->truth->field.disparity.clone();
    QVERIFY(!find_metric(judge(estimate, *scene, by_2016()).metrics, "runtime_log"));
    estimate.seconds = 100;

    QCOMPARE(*find_metric(judge(estimate, *scene, by_2016()).metrics, "runtime_log"), 2.0);
    QVERIFY(!find_metric(judge(estimate, *scene, {}).metrics, "runtime_log"));
  }

  void highResolution_isThatOfTheCenterView() {
    const auto made = tiny_scene();
    Scene scene;
    scene.light_field = made->light_field;
    auto truth = std::make_shared<GroundTruth>();
    truth->field.disparity = made->truth->field.disparity.clone();
    truth->stratified = StratifiedScene::Dots;
    truth->high_res = std::make_shared<const FlatTruth>();
    scene.truth = truth;
    const EstimatePtr estimate = shifted_truth(*made, 0);

    const Evaluation center = judge(*estimate, scene, by_2016());
    const Evaluation corner = judge(*estimate, scene, by_2016(), ViewIndex{0, 0});

    QVERIFY(*find_metric(center.metrics, "mse_100") > 0);
    QCOMPARE(*find_metric(center.metrics, "mse_100_lowres"), 0.0);
    QVERIFY(!find_metric(corner.metrics, "mse_100"));
    QCOMPARE(*find_metric(corner.metrics, "mse_100_lowres"), 0.0);
  }

  void estimateInThePlaceOfTruth_isTold() {
    const auto made = tiny_scene();
    Scene scene;
    scene.light_field = made->light_field;
    auto truth = std::make_shared<GroundTruth>();
    truth->field.disparity = made->truth->field.disparity.clone();
    truth->estimated.emplace().method = "epi_s";
    scene.truth = truth;

    const Evaluation evaluation = judge(*shifted_truth(*made, 0), scene, {});

    QVERIFY(judge(*shifted_truth(*made, 0), *made, {}).notes.empty());
    QVERIFY(QString::fromStdString(evaluation.notes.at(0)).endsWith("estimated by epi_s"));
  }

  void otherReading_isToldWithNumbersAndOptions() {
    const auto scene = tiny_scene("objects");
    const std::filesystem::path file = folder_.filePath("negated.pfm").toStdString();
    const DisparityView truth = scene->truth->field.view(scene->light_field->center());
    Image<float> map(kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) map.at(y, x) = -truth.disparity.at(y, x);
    }
    io::write_pfm(file, map.view());

    const auto found = find_better_reading(read_result_of(*scene->light_field, file), *scene);
    const Estimate right = read_result_of(*scene->light_field, file, {.scale = -1});

    QVERIFY(found.has_value());
    const QString text = QString::fromStdString(better_reading_text(*found));
    for (const char* words : {"fits the ground truth far better with values negated",
                              "MSE×100 0 instead", "; if it is stored so, add --map-scale=-1"}) {
      QVERIFY2(text.contains(words), qPrintable(text));
    }
    QCOMPARE(*find_metric(judge(right, *scene, {}).metrics, "mse_100"), 0.0);
    QVERIFY(!find_better_reading(right, *scene));
  }

  void otherOrderOfAllMaps_isTold_data() {
    QTest::addColumn<bool>("is_transposed");
    QTest::addColumn<QString>("words");
    QTest::newRow("exchanged")
        << true << "another order, rows and columns of views exchanged: against the ground truth";
    QTest::newRow("u reversed")
        << false << "another order, u reversed: against the ground truth, MSE×100 is 0.01 so";
  }
  void otherOrderOfAllMaps_isTold() {
    QFETCH(bool, is_transposed);
    QFETCH(QString, words);
    const auto scene = tiny_scene("objects");
    const EstimatePtr right = shifted_truth(*scene, 0.01F);
    Estimate stored;
    stored.field.disparity = right->field.disparity.clone();
    for (int i = 0; i < 9; ++i) {
      const ViewIndex view = stored.field.disparity.view_at(i);
      const auto from = right->field.disparity.view(is_transposed ? ViewIndex{view.u, view.v}
                                                                  : ViewIndex{view.v, 2 - view.u});
      std::copy_n(from.data, from.size(), stored.field.disparity.view(view).data);
    }

    const QString text = QString::fromStdString(doubt_text(stored, *scene, false));
    QVERIFY2(text.contains(words), qPrintable(text));
    QCOMPARE(doubt_text(*right, *scene, false), std::string());
    stored.version = "1";  // ours are in order
    QVERIFY(!QString::fromStdString(doubt_text(stored, *scene, false)).contains("another order"));
  }

  // Views without values are no evidence of an order, a map without any is no ground truth.
  void viewsWithoutValues_areNoEvidence() {
    const auto scene = tiny_scene("objects");
    const EstimatePtr noisy = shifted_truth(*scene, 0.02F);
    Estimate partly;
    partly.field.disparity = noisy->field.disparity.clone();
    partly.field.valid = ViewStack<std::uint8_t>({3, 3}, 64, 64);
    for (const ViewIndex view : {ViewIndex{0, 2}, {1, 1}, {2, 0}}) {
      const auto valid = partly.field.valid.view(view);
      std::fill_n(valid.data, valid.size(), std::uint8_t{1});
    }
    QCOMPARE(doubt_text(partly, *scene, false), std::string());
    std::fill_n(partly.field.valid.data(), partly.field.valid.size(), std::uint8_t{0});
    QVERIFY(!is_ground_truth(partly, *scene));
  }

  void constantMap_explainsLittle() {
    const auto scene = tiny_scene("objects");
    Estimate flat = center_map(scene->truth->field.view({1, 1}), 0);
    std::fill_n(flat.field.disparity.data(), flat.field.disparity.size(), 9.0F);
    const QString text = QString::fromStdString(doubt_text(flat, *scene, false));
    QVERIFY2(text.startsWith("the map explains little of the ground truth"), qPrintable(text));
  }

  void mapOfAnotherView_isTold() {
    const auto scene = tiny_scene("objects");
    const Estimate estimate = center_map(scene->truth->field.view({0, 0}), 0);

    const QString text = QString::fromStdString(doubt_text(estimate, *scene, false));

    QVERIFY2(text.startsWith(
                 "the map fits the ground truth of view 0,0 far better than that of view 1,1: "
                 "MSE×100 0 instead of "),
             qPrintable(text));
    QCOMPARE(doubt_text(center_map(scene->truth->field.view({1, 1}), 0), *scene, false),
             std::string());
  }

  void constantOffset_isTold() {
    const auto scene = tiny_scene("objects");

    const QString text = QString::fromStdString(
        doubt_text(center_map(scene->truth->field.view({1, 1}), 0.5F), *scene, false));

    QVERIFY2(
        text.startsWith("the map is off by +0.5 px everywhere: without that, MSE×100 would be"),
        qPrintable(text));
  }

  void resultOfAnotherSizeOrGrid_isRefused_data() {
    QTest::addColumn<int>("views");
    QTest::addColumn<int>("side");
    QTest::addColumn<QString>("words");
    QTest::newRow("size") << 3 << 32 << "the map has 32×32 px, but";
    QTest::newRow("grid") << 5 << 64 << "the map has 5×5 views, but";
  }
  void resultOfAnotherSizeOrGrid_isRefused() {
    QFETCH(int, views);
    QFETCH(int, side);
    QFETCH(QString, words);
    const auto scene = tiny_scene("objects");
    DisparityField maps = DisparityField::unknown({views, views}, side, side, {});
    std::fill_n(maps.valid.data(), maps.valid.size(), std::uint8_t{1});

    try {
      (void)result_from_maps(*scene->light_field, std::move(maps), "mine");
      QFAIL("it was taken");
    } catch (const InvalidInput& error) {
      QVERIFY2(QString(error.what()).startsWith("mine: " + words), error.what());
    }
  }

  void resultOfOtherSamples_isToldInWhateverPlace() {
    const auto scene = tiny_scene("objects");
    Estimate estimate = center_map(scene->truth->field.view({1, 1}), 0);
    estimate.version = "1";
    estimate.source_hash = scene->light_field->sample_hash();
    QVERIFY(fit_of(estimate, *scene).sentences().empty());
    estimate.source_hash += 1;

    const std::vector<std::string> sentences = fit_of(estimate, *scene).sentences();

    QCOMPARE(sentences.size(), std::size_t{1});
    QVERIFY(QString::fromStdString(sentences[0]).contains("estimated from other samples than"));
  }

 private:
  /// A map of the center view of 3×3, `offset` px above `map`.
  static Estimate center_map(const DisparityView& map, float offset) {
    Estimate estimate;
    estimate.field.disparity = ViewStack<float>({1, 1}, kSide, kSide, 1, {1, 1});
    float* values = estimate.field.disparity.data();
    for (std::size_t i = 0; i < map.disparity.size(); ++i)
      values[i] = map.disparity.data[i] + offset;
    return estimate;
  }

  /// Disparity 9 everywhere.
  class FlatTruth : public HighResTruth {
   public:
    [[nodiscard]] Image<float> read_disparity() const override {
      return Image<float>(10 * kSide, 10 * kSide, 1, 9);
    }
    [[nodiscard]] std::vector<std::string> regions() const override { return {}; }
    [[nodiscard]] Image<std::uint8_t> read_region(const std::string& name) const override {
      throw IoError(name, "is not there");
    }
    [[nodiscard]] std::string identity() const override { return "flat"; }
  };

  [[nodiscard]] static EvaluationOptions by_2016() { return {.protocol = Protocol::Benchmark2016}; }

  /// The true center view, 0.1 px off, without its border.
  [[nodiscard]] std::filesystem::path write_map(const Scene& scene, Border border) const {
    const DisparityView truth = scene.truth->field.view(scene.light_field->center());
    const int cut = border == Border::Cut ? kBorder : 0;
    Image<float> map(kSide - 2 * cut, kSide - 2 * cut);
    for (int y = kBorder; y < kSide - kBorder; ++y) {
      for (int x = kBorder; x < kSide - kBorder; ++x) {
        map.at(y - cut, x - cut) = truth.disparity.at(y, x) + 0.1F;
      }
    }
    const std::filesystem::path file = folder_.filePath("map.pfm").toStdString();
    io::write_pfm(file, map.view());
    return file;
  }

  QTemporaryDir folder_;
};

}  // namespace episcope::in_judge_test

EPISCOPE_TEST(judge_test, JudgeTest)
#include "judge_test.moc"
