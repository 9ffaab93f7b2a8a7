// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/solvers/tv_l2.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stop_token>

namespace episcope::in_tgv_l2_test {

namespace {

Image<float> affine(int height, int width, float dx, float dy) {
  Image<float> image(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at(y, x) = 0.3F + dx * static_cast<float>(x) + dy * static_cast<float>(y);
    }
  }
  return image;
}

Image<float> noisy(const Image<float>& image, float sigma) {
  Image<float> result = image;
  std::mt19937 random(5);
  std::normal_distribution<float> noise(0.0F, sigma);
  for (float& value : result) value += noise(random);
  return result;
}

double rms(const Image<float>& a, const Image<float>& b, int inset = 0) {
  double sum = 0;
  int count = 0;
  for (int y = inset; y < a.height() - inset; ++y) {
    for (int x = inset; x < a.width() - inset; ++x, ++count) {
      sum += std::pow(a.at(y, x) - b.at(y, x), 2);
    }
  }
  return std::sqrt(sum / count);
}

}  // namespace

class TgvL2Test : public QObject {
  Q_OBJECT

 private slots:
  void affineImage_isReproduced();
  void noiseOnASlope_isRemoved();
  void jumpAtAnEdge_isKept();
  void energy_fallsWithIterations();
  void threads_changeNothing();
  void wrongShapes_areRefused();
  void stopRequest_cancels();
};

void TgvL2Test::affineImage_isReproduced() {
  const Image<float> f = affine(40, 56, 0.02F, -0.01F);
  Image<float> u(40, 56);

  solve_tgv_l2({.f = f, .w = {}, .g = {}, .lambda = 0.5}, 3000, Progress(), u.view());

  // Affine images cost nothing, so they are the minimum; the iteration comes near to it.
  QVERIFY2(rms(u, f) < 1e-3, qPrintable(QString::number(rms(u, f))));
}

void TgvL2Test::noiseOnASlope_isRemoved() {
  const Image<float> truth = affine(64, 64, 0.02F, 0.01F);
  const Image<float> f = noisy(truth, 0.05F);
  Image<float> u(64, 64);

  solve_tgv_l2({.f = f, .w = {}, .g = {}, .lambda = 0.5}, 500, Progress(), u.view());

  QVERIFY2(rms(u, truth, 4) < 0.25 * rms(f, truth, 4),
           qPrintable(QString::number(rms(u, truth, 4))));
}

void TgvL2Test::jumpAtAnEdge_isKept() {
  Image<float> f = affine(32, 48, 0.01F, 0), g(32, 48, 1, 1.0F);
  for (int y = 0; y < 32; ++y) {
    for (int x = 24; x < 48; ++x) f.at(y, x) += 1;
    g.at(y, 23) = 0.01F;
  }
  Image<float> u(32, 48);

  solve_tgv_l2({.f = noisy(f, 0.03F), .w = {}, .g = g, .lambda = 0.3}, 500, Progress(), u.view());

  for (int y = 4; y < 28; ++y) {
    QVERIFY(std::abs(u.at(y, 23) - f.at(y, 23)) < 0.1);
    QVERIFY(std::abs(u.at(y, 24) - f.at(y, 24)) < 0.1);
  }
}

void TgvL2Test::energy_fallsWithIterations() {
  const Image<float> f = noisy(affine(48, 40, 0.01F, 0.02F), 0.05F);
  Image<float> u(48, 40);
  const TgvL2Problem problem{.f = f, .w = {}, .g = {}, .lambda = 0.3};

  const double few = solve_tgv_l2(problem, 50, Progress(), u.view()).energy;
  const double many = solve_tgv_l2(problem, 500, Progress(), u.view()).energy;
  const double most = solve_tgv_l2(problem, 4000, Progress(), u.view()).energy;

  QVERIFY(many < few);
  QVERIFY(most <= many * (1 + 1e-5));
}

void TgvL2Test::threads_changeNothing() {
  const Image<float> f = noisy(affine(50, 40, 0.01F, 0.02F), 0.05F);
  Image<float> one(50, 40), three(50, 40);

  solve_tgv_l2({.f = f, .w = {}, .g = {}}, 50, Progress(1), one.view());
  solve_tgv_l2({.f = f, .w = {}, .g = {}}, 50, Progress(3), three.view());

  QVERIFY(std::equal(one.begin(), one.end(), three.begin()));
}

void TgvL2Test::wrongShapes_areRefused() {
  const Image<float> f(20, 20), other(20, 21);
  Image<float> u(20, 20);

  QVERIFY_THROWS_EXCEPTION(InvalidInput,
                           solve_tgv_l2({.f = f, .w = other, .g = {}}, 5, Progress(), u.view()));
  QVERIFY_THROWS_EXCEPTION(
      InvalidInput, solve_tgv_l2({.f = f, .w = {}, .g = {}, .lambda = 0}, 5, Progress(), u.view()));
}

void TgvL2Test::stopRequest_cancels() {
  std::stop_source stop;
  stop.request_stop();
  const Image<float> f(20, 20);
  Image<float> u(20, 20);

  QVERIFY_THROWS_EXCEPTION(Cancelled, solve_tgv_l2({.f = f, .w = {}, .g = {}}, 5,
                                                   Progress(stop.get_token(), {}), u.view()));
}

}  // namespace episcope::in_tgv_l2_test

EPISCOPE_TEST(tgv_l2_test, TgvL2Test)
#include "tgv_l2_test.moc"
