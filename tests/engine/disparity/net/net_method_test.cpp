// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/net_method.h"

#include "engine/core/error.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/engine/disparity/net/net_vectors.h"
#include "tests/test_main.h"

#include <QFile>
#include <QTemporaryDir>

#include <algorithm>
#include <cmath>
#include <stop_token>

namespace episcope::in_net_method_test {

using namespace episcope::test;

namespace {

const Scene& scene() {
  static const Scene rendered = render("edge", 48, 56, {5, 5});
  return rendered;
}

Estimate estimated(const NetMethodParameters& parameters,
                   ViewSelection views = ViewSelection::Center,
                   const Progress& progress = Progress()) {
  return estimate_by_net(*scene().light_field, parameters, views, progress);
}

// Share of the pixels 5 px or more from the border that are off by more than 0.07 px.
double share_of_bad(const ImageView<const float>& found, const DisparityView& truth) {
  constexpr int kInset = 5;
  int bad = 0, all = 0;
  for (int y = kInset; y < found.height - kInset; ++y) {
    for (int x = kInset; x < found.width - kInset; ++x) {
      ++all;
      bad += std::abs(found.at(y, x) - truth.disparity.at(y, x)) > 0.07 ? 1 : 0;
    }
  }
  return static_cast<double>(bad) / all;
}

// Whether a pixel within four rows and columns has this disparity.
bool is_near(const ImageView<const float>& truth, int y, int x, float disparity) {
  const int end = std::min(x + 5, truth.width);
  for (int row = std::max(y - 4, 0); row < std::min(y + 5, truth.height); ++row) {
    if (std::any_of(&truth.at(row, std::max(x - 4, 0)), truth.row(row) + end,
                    [&](float each) { return std::abs(each - disparity) < 0.15F; })) {
      return true;
    }
  }
  return false;
}

// The sentence that a run with this file of weights gives; empty if it runs.
std::string failure_with(const QString& file) {
  try {
    (void)estimated({.weights = file.toStdString()});
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

class NetMethodTest : public QObject {
  Q_OBJECT

 private slots:
  void centerView_isThatOfTheNetwork();
  void anyView_isEstimated();
  void silhouettes_areChosen();
  void secondDisparities_areTheOtherSide();
  void givenWeights_areUsedAndNamed();
  void badWeights_areRefusedInASentence();
  void changedWeights_areReadAgain();
  void narrowRange_isWidened();
  void allViews_areClose();
  void finish_givesAllViews_asWithoutCorners();
  void threads_changeNothing();
};

void NetMethodTest::centerView_isThatOfTheNetwork() {
  const LightField& lf = *scene().light_field;

  const Estimate estimate = estimated({.range = Interval{-1, 1.5}});
  const NetMaps maps =
      estimate_net(lf, lf.center(), released_weights(), {.range = {-1, 1.5}}, Progress());

  const ViewIndex view = lf.center();
  QCOMPARE(largest_difference(estimate.field.disparity.view(view), maps.disparity.view()), 0.0);
  QCOMPARE(largest_difference(estimate.confidence.view(view), maps.confidence.view()), 0.0);
  QCOMPARE(estimate.range, (Interval{-1, 1.5}));
}

void NetMethodTest::anyView_isEstimated() {
  const Estimate estimate = estimated({.view = ViewIndex{1, 4}});

  const Errors off =
      errors(estimate.field.disparity.view({1, 4}), scene().truth->field.view(ViewIndex{1, 4}), 5);
  QVERIFY2(off.mse_100 < 0.5, qPrintable(QString::number(off.mse_100)));
}

void NetMethodTest::silhouettes_areChosen() {
  const Estimate mode = estimated({});
  const Estimate mean = estimated({.silhouettes = Silhouettes::Mean});

  QVERIFY(!same_bytes(mode.field.disparity, mean.field.disparity));
  QVERIFY(same_bytes(mode.confidence, mean.confidence));
}

void NetMethodTest::secondDisparities_areTheOtherSide() {
  const Scene bars = render("bars", 64, 64);
  const ViewIndex view = bars.light_field->center();

  const Estimate estimate =
      estimate_by_net(*bars.light_field, {}, ViewSelection::Center, Progress());

  const DisparityView second = estimate.second.view(view), own = estimate.field.view(view);
  int found = 0, true_surfaces = 0;
  for (int y = 0; y < second.disparity.height; ++y) {
    for (int x = 0; x < second.disparity.width; ++x) {
      if (!second.is_valid(y, x)) continue;
      const float other = second.disparity.at(y, x);
      QVERIFY(std::abs(other - own.disparity.at(y, x)) > 0.2);
      ++found;
      true_surfaces += is_near(bars.truth->field.view(view).disparity, y, x, other) ? 1 : 0;
    }
  }
  QVERIFY2(found >= 20 && true_surfaces >= 0.95 * found,
           qPrintable(QString("%1 of %2").arg(true_surfaces).arg(found)));
  QVERIFY(estimated({}, ViewSelection::All).second.empty());
}

void NetMethodTest::givenWeights_areUsedAndNamed() {
  const Estimate own = estimated({});
  const Estimate given = estimated({.weights = released_weights_path()});

  QVERIFY(same_bytes(own.field.disparity, given.field.disparity));
  QVERIFY(own.notes.empty());
  QCOMPARE(given.notes.size(), 1U);
  QVERIFY(QString::fromStdString(given.notes[0]).contains("net.npz, hash "));
}

void NetMethodTest::badWeights_areRefusedInASentence() {
  const QTemporaryDir folder;
  const QString path = folder.filePath("w.npz");
  QVERIFY(failure_with(path).starts_with(path.toStdString()));

  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write("PK is no archive");
  file.close();

  QVERIFY(failure_with(path).starts_with(path.toStdString()));
}

void NetMethodTest::changedWeights_areReadAgain() {
  const QTemporaryDir folder;
  const QString path = folder.filePath("w.npz");
  QVERIFY(QFile::copy(QString::fromStdString(released_weights_path()), path));
  QCOMPARE(failure_with(path), std::string());

  QFile file(path);
  QVERIFY(file.open(QIODevice::ReadWrite) && file.resize(1000));
  file.close();

  QVERIFY(!failure_with(path).empty());
}

void NetMethodTest::narrowRange_isWidened() {
  const Estimate estimate = estimated({.range = Interval{0.5, 0.5}});

  QVERIFY(std::abs(estimate.range.min - 0.4) < 1e-9 && std::abs(estimate.range.max - 0.6) < 1e-9);
  QVERIFY(all_finite(estimate.field.disparity));
}

void NetMethodTest::allViews_areClose() {
  const Estimate all = estimated({}, ViewSelection::All);
  const Estimate center = estimated({});

  const GridShape grid = scene().light_field->grid();
  QVERIFY(all.field.disparity.grid() == grid);
  // A pixel that holds both sides of the edge may be of either.
  constexpr double kMostBad = 0.025;
  double bad = 0;
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    bad += share_of_bad(all.field.disparity.view(view), scene().truth->field.view(view));
  }
  QVERIFY2(bad / grid.count() < kMostBad, qPrintable(QString::number(bad / grid.count())));
  const ViewIndex view = grid.center();
  QCOMPARE(largest_difference(all.field.disparity.view(view), center.field.disparity.view(view)),
           0.0);
}

void NetMethodTest::finish_givesAllViews_asWithoutCorners() {
  std::stop_source finish;
  finish.request_stop();

  const Estimate ended = estimated({}, ViewSelection::All, Progress({}, finish.get_token(), {}));
  const Estimate all = estimated({.has_corners = false}, ViewSelection::All);

  QCOMPARE(all.field.disparity.grid().count(), 25);
  QVERIFY(QString::fromStdString(all.notes.back()).contains("from 1 of them"));
  QVERIFY(same_bytes(all.field.disparity, ended.field.disparity));
}

void NetMethodTest::threads_changeNothing() {
  const Estimate one = estimated({}, ViewSelection::All, Progress(1));
  const Estimate three = estimated({}, ViewSelection::All, Progress(3));

  QVERIFY(same_bytes(one.field.disparity, three.field.disparity));
  QVERIFY(same_bytes(one.confidence, three.confidence));
}

}  // namespace episcope::in_net_method_test

EPISCOPE_TEST(net_method_test, NetMethodTest)
#include "net_method_test.moc"
