// SPDX-License-Identifier: BSD-3-Clause
// Whether colors can be told apart by those who lack a kind of cones: simulation of Machado,
// Oliveira, Fernandes 2009 (severity 1) on linear RGB, distances ΔE*ab of CIE 1976. A distance of
// about 2.3 is just noticeable side by side; areas that lie apart need several times that.
#include "engine/core/scene.h"
#include "engine/render/shade.h"
#include "tests/test_main.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace episcope::in_color_vision_test {

using namespace episcope::render;

namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

constexpr Matrix kNormal{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr Matrix kProtan{{{0.152286, 1.052583, -0.204868},
                          {0.114503, 0.786281, 0.099216},
                          {-0.003882, -0.048116, 1.051998}}};
constexpr Matrix kDeutan{{{0.367322, 0.860646, -0.227968},
                          {0.280085, 0.672501, 0.047413},
                          {-0.011820, 0.042940, 0.968881}}};
constexpr Matrix kTritan{{{1.255528, -0.076749, -0.178779},
                          {-0.078411, 0.930809, 0.147602},
                          {0.004733, 0.691367, 0.303900}}};
constexpr Matrix kXyzFromRgb{{{0.4124564, 0.3575761, 0.1804375},
                              {0.2126729, 0.7151522, 0.0721750},
                              {0.0193339, 0.1191920, 0.9503041}}};
constexpr Vector kWhite{0.95047, 1, 1.08883};

Vector product(const Matrix& matrix, const Vector& vector) {
  Vector result{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) result[i] += matrix[i][k] * vector[k];
  }
  return result;
}

// L*, a*, b* of an sRGB color as it is seen.
Vector seen(const Rgb& color, const Matrix& vision) {
  Vector linear{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double level = color[c] / 255.0;
    linear[c] = level <= 0.04045 ? level / 12.92 : std::pow((level + 0.055) / 1.055, 2.4);
  }
  Vector shown = product(vision, linear);
  for (double& each : shown) each = std::clamp(each, 0.0, 1.0);
  Vector f = product(kXyzFromRgb, shown);
  for (std::size_t i = 0; i < 3; ++i) {
    const double share = f[i] / kWhite[i];
    f[i] = share > 216.0 / 24389 ? std::cbrt(share) : (24389.0 / 27 * share + 16) / 116;
  }
  return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

// The least distance of two colors over all kinds of vision.
double distance(const Rgb& a, const Rgb& b) {
  double least = 1e9;
  for (const Matrix* vision : {&kNormal, &kProtan, &kDeutan, &kTritan}) {
    const Vector x = seen(a, *vision);
    const Vector y = seen(b, *vision);
    least = std::min(least, std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]));
  }
  return least;
}

}  // namespace

class ColorVisionTest : public QObject {
  Q_OBJECT

 private slots:
  void simulation_isThatOfThePaper() {
    // White stays white, and for the deutan red and green lie closer than they do for others.
    QVERIFY(std::abs(seen({255, 255, 255}, kDeutan)[0] - 100) < 0.1);
    const Vector red = seen({200, 60, 60}, kDeutan);
    const Vector green = seen({90, 120, 40}, kDeutan);
    QVERIFY(std::abs(red[1] - green[1]) < 10);
    QVERIFY(std::abs(seen({200, 60, 60}, kNormal)[1] - seen({90, 120, 40}, kNormal)[1]) > 60);
  }

  void labels_areToldApart() {
    for (int a = 1; a <= 20; ++a) {
      for (int b = a + 1; b <= 20; ++b) {
        const bool is_close = b == a + 1 || b <= 8;
        const double limit = is_close ? 20 : b <= 12 ? 15 : 12;
        const double apart = distance(label_color(a), label_color(b));
        QVERIFY2(apart >= limit, qPrintable(QString("labels %1 and %2: %3 < %4")
                                                .arg(a)
                                                .arg(b)
                                                .arg(apart, 0, 'f', 1)
                                                .arg(limit)));
      }
    }
  }

  void endsOfTheDefaultMaps_areToldApart_data() {
    QTest::addColumn<QString>("map");
    QTest::addColumn<double>("low");
    QTest::addColumn<double>("high");
    QTest::newRow("signed error") << "seismic" << 0.0 << 1.0;
    QTest::newRow("signed error, halfway") << "seismic" << 0.25 << 0.75;
    QTest::newRow("signed error, near") << "seismic" << 0.25 << 0.5;
    QTest::newRow("signed error, far") << "seismic" << 0.5 << 0.75;
    QTest::newRow("absolute error") << "ylorrd" << 0.0 << 1.0;
    QTest::newRow("bad pixels") << "rdylgn_r" << 0.2 << 1.0;
    QTest::newRow("disparity") << "viridis" << 0.0 << 1.0;
    QTest::newRow("disparity, halfway") << "viridis" << 0.25 << 0.75;
    QTest::newRow("confidence") << "magma" << 0.0 << 1.0;
  }
  void endsOfTheDefaultMaps_areToldApart() {
    QFETCH(QString, map);
    QFETCH(double, low);
    QFETCH(double, high);
    const ColorMap colors = color_map(map.toStdString());

    const double apart = distance(colors.color(static_cast<float>(low), 0, 1),
                                  colors.color(static_cast<float>(high), 0, 1));

    QVERIFY2(apart >= 25, qPrintable(QString::number(apart)));
  }
};

}  // namespace episcope::in_color_vision_test

EPISCOPE_TEST(color_vision_test, ColorVisionTest)
#include "color_vision_test.moc"
