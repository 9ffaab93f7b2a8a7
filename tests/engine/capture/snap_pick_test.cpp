// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/pixel_surface.h"

#include "tests/test_main.h"

#include <cmath>
#include <functional>
#include <random>

namespace episcope::in_snap_pick_test {

using namespace capture;

namespace {

constexpr double kX = 31.37;
constexpr double kY = 27.81;

/// `brightness` of a place, averaged over each pixel, with noise of 2/255.
Image<float> picture(const std::function<double(double, double)>& brightness) {
  constexpr int size = 64;
  constexpr int parts = 8;
  Image<float> grey(size, size);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 2);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      double sum = 0;
      for (int j = 0; j < parts; ++j) {
        for (int i = 0; i < parts; ++i) {
          sum += brightness(x + (i + 0.5) / parts - 0.5, y + (j + 0.5) / parts - 0.5);
        }
      }
      grey.at(y, x) = static_cast<float>(sum / (parts * parts) + noise(random));
    }
  }
  return grey;
}

/// Of a checkered corner that is turned by 0.3.
double corner(double x, double y) {
  const double u = std::cos(0.3) * (x - kX) + std::sin(0.3) * (y - kY);
  const double v = std::cos(0.3) * (y - kY) - std::sin(0.3) * (x - kX);
  return u * v > 0 ? 200 : 60;
}

double disc(double x, double y) {
  return std::hypot(x - kX, y - kY) < 4.3 ? 180 : 70;
}

double edge(double x, double y) {
  return x + 0.4 * y > kX + 0.4 * kY ? 180 : 70;
}

}  // namespace

class SnapPickTest : public QObject {
  Q_OBJECT

 private slots:
  void corner_isFoundToATenthOfAPixel() {
    const Image<float> grey = picture(corner);
    for (const double off : {-3.0, 0.0, 2.5}) {
      const auto found = snap_pick(grey.view(), {kX + off, kY - off / 2}, 5);
      QVERIFY(found);
      QCOMPARE(found->kind, MarkKind::Corner);
      QVERIFY2(std::hypot(found->place.x - kX, found->place.y - kY) < 0.1,
               qPrintable(QString("%1 %2").arg(found->place.x).arg(found->place.y)));
    }
  }

  void disc_isFoundByItsCentre() {
    const Image<float> grey = picture(disc);
    for (const double off : {-2.0, 0.0, 2.0}) {
      const auto found = snap_pick(grey.view(), {kX + off, kY + off / 2}, 5);
      QVERIFY(found);
      QCOMPARE(found->kind, MarkKind::Blob);
      QVERIFY2(std::hypot(found->place.x - kX, found->place.y - kY) < 0.1,
               qPrintable(QString("%1 %2").arg(found->place.x).arg(found->place.y)));
    }
  }

  void edgesAndNoise_areNoMarks() {
    QVERIFY(!snap_pick(picture(edge).view(), {kX, kY}, 5));
    QVERIFY(!snap_pick(picture([](double, double) { return 100.0; }).view(), {kX, kY}, 5));
  }

  void marksOutOfReach_areLeftAlone() {
    QVERIFY(!snap_pick(picture(corner).view(), {kX + 14, kY + 13}, 5));
  }

  void border_isNoObstacle() {
    const Image<float> grey = picture(corner);
    for (const double at : {0.0, 63.0}) {
      const auto found = snap_pick(grey.view(), {at, at}, 5);
      if (found) QVERIFY(std::hypot(found->place.x - at, found->place.y - at) <= 5);
    }
  }
};

}  // namespace episcope::in_snap_pick_test

EPISCOPE_TEST(snap_pick_test, SnapPickTest)
#include "snap_pick_test.moc"
