// SPDX-License-Identifier: BSD-3-Clause
// The kernels of every instruction set give the same maps. A process uses one set for all its life,
// so this program runs itself with another and compares.
#include "engine/core/isa.h"
#include "engine/disparity/epi_c.h"
#include "engine/disparity/epi_l.h"
#include "engine/disparity/epi_s.h"
#include "engine/disparity/epi_two_layer.h"
#include "engine/disparity/stereo.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <QCoreApplication>
#include <QProcess>

#include <cmath>
#include <cstring>

namespace episcope::in_isa_test {

using namespace episcope::test;

namespace {

constexpr int kHeight = 61;
constexpr int kWidth = 75;

// Maps of EPI_L, their confidence, the maps of EPI_S, EPI_C and those of both layers, one behind
// the other; then those of ST_AV_S and ST_CH_G.
QByteArray computed_maps() {
  const Scene scene = render("objects", kHeight, kWidth, {5, 7});
  const EpiLParameters tensor{.range = Interval{-2, 2}};
  const Estimate local = estimate_epi_l(*scene.light_field, tensor, ViewSelection::All, Progress());
  const Estimate smooth =
      estimate_epi_s(*scene.light_field, {.tensor = tensor}, ViewSelection::All, Progress());
  const Estimate ordered =
      estimate_epi_c(*scene.light_field, {.tensor = tensor}, ViewSelection::All, Progress());
  StereoSmoothParameters stereo;
  stereo.local.matching.range = tensor.range;
  const Estimate matched =
      estimate_stereo_smooth(*scene.light_field, MatchedViews::All, stereo, Progress());
  StereoGlobalParameters global;
  global.matching.range = tensor.range;
  const Estimate labeled =
      estimate_stereo_global(*scene.light_field, MatchedViews::CrossHair, global, Progress());
  const Scene pane = render("transparent", kHeight, kWidth, {5, 7});
  const Estimate layers =
      estimate_epi_two_layer(*pane.light_field, {}, ViewSelection::All, Progress());
  QByteArray bytes;
  for (const ViewStack<float>* stack :
       {&local.field.disparity, &local.confidence, &smooth.field.disparity,
        &ordered.field.disparity, &layers.layered.foreground.disparity,
        &layers.layered.background.disparity, &matched.field.disparity, &labeled.field.disparity}) {
    bytes.append(reinterpret_cast<const char*>(stack->data()),
                 static_cast<qsizetype>(stack->size() * sizeof(float)));
  }
  return bytes;
}

std::vector<float> as_floats(const QByteArray& bytes) {
  std::vector<float> floats(static_cast<std::size_t>(bytes.size()) / sizeof(float));
  std::memcpy(floats.data(), bytes.constData(), floats.size() * sizeof(float));
  return floats;
}

QByteArray maps_under(const char* isa) {
  QTemporaryDir folder;
  const QString path = folder.filePath("maps");
  QProcess process;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert("EPISCOPE_ISA", isa);
  process.setProcessEnvironment(environment);
  process.start(QCoreApplication::applicationFilePath(), {"isa_test", "--write", path});
  if (!process.waitForFinished() || process.exitCode() != 0) return {};
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

int write_maps(const QString& path) {
  QFile file(path);
  const QByteArray bytes = computed_maps();
  return file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size() ? 0 : 1;
}

}  // namespace

class IsaTest : public QObject {
  Q_OBJECT

 private slots:
  void everyInstructionSet_givesTheSameMaps_data();
  void everyInstructionSet_givesTheSameMaps();
};

void IsaTest::everyInstructionSet_givesTheSameMaps_data() {
  QTest::addColumn<QString>("isa");
  QTest::newRow("baseline") << "baseline";
  QTest::newRow("avx2") << "avx2";
}

void IsaTest::everyInstructionSet_givesTheSameMaps() {
  QFETCH(QString, isa);
  static const std::vector<float> best = as_floats(computed_maps());
  const std::vector<float> other = as_floats(maps_under(isa.toLatin1().constData()));
  QCOMPARE(other.size(), best.size());
  constexpr std::size_t maps = 6;  // of all views
  const std::size_t pixels = std::size_t{kHeight} * kWidth;
  const std::size_t end = best.size() - 2 * pixels;
  const std::size_t part = end / maps;
  std::size_t differ = 0;
  for (std::size_t i = 0; i < 2 * part; ++i) {
    QVERIFY(std::isfinite(other[i]));
    // Sums are rounded in different orders: of two shears that are nearly as coherent either may
    // win, and their answers differ by the bias of a slope.
    const bool confident = best[part + i % part] > 0.9F;
    if (confident && std::fabs(best[i] - other[i]) > 2e-3F) ++differ;
  }
  QVERIFY2(differ < part / 1000, qPrintable(QString("EPI_L: %1 of %2").arg(differ).arg(part)));
  const auto mean_difference = [&](std::size_t first, std::size_t count) {
    double sum = 0;
    for (std::size_t i = first; i < first + count; ++i) sum += std::fabs(best[i] - other[i]);
    return sum / static_cast<double>(count);
  };
  for (std::size_t map = 2; map < maps; ++map) {
    const double mean = mean_difference(map * part, part);
    QVERIFY2(mean < 1e-3, qPrintable(QString("smoothed map %1: %2").arg(map).arg(mean)));
  }
  for (const std::size_t first : {end, end + pixels}) {
    const double mean = mean_difference(first, pixels);
    QVERIFY2(mean < 1e-3, qPrintable(QString("stereo: %1").arg(mean)));
  }
}

}  // namespace episcope::in_isa_test

int isa_test(int argc, char** argv) {
  const QCoreApplication application(argc, argv);
  if (argc == 3 && std::strcmp(argv[1], "--write") == 0)
    return episcope::in_isa_test::write_maps(argv[2]);
  episcope::in_isa_test::IsaTest test;
  return QTest::qExec(&test, argc, argv);
}

#include "isa_test.moc"
