// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/labeling_source.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"

namespace episcope::in_labeling_source_test {

namespace {

/// A source beside that of the window, on two light fields of which the first is shown.
class Sourcing : public WindowFixture {
 public:
  Sourcing() {
    openSmall("edge");
    edge = session().generation();
    openSmall("slant");
    slant = session().generation();
    show(edge);
  }
  [[nodiscard]] Session& session() { return window.bench().session; }
  void show(std::uint64_t scene) {
    session().choose(scene);
    QCoreApplication::processEvents();  // the session tells of it one turn later
  }
  void awaitJobs() { QTRY_COMPARE_WITH_TIMEOUT(window.bench().jobs.count(), 0, kScenePatience); }

  std::uint64_t edge = 0;
  std::uint64_t slant = 0;
  QObject owner;
  LabelingSource source{window.bench().session, window.bench().jobs, &owner};
};

}  // namespace

class LabelingSourceTest : public QObject {
  Q_OBJECT

 private slots:
  void ownDisparity_isThereAgainWithItsScene() {
    Sourcing f;
    f.source.provide();
    f.awaitJobs();
    const auto own = f.source.find(FeatureSet::ImageEstimate).field;
    QVERIFY(own);

    f.show(f.slant);
    QVERIFY(!f.source.find(FeatureSet::ImageEstimate).field);
    f.show(f.edge);

    QCOMPARE(f.source.find(FeatureSet::ImageEstimate).field, own);
  }

  void ownDisparity_isOfItsSceneThoughAnotherIsShown() {
    Sourcing f;
    f.source.provide();
    f.show(f.slant);
    f.awaitJobs();
    QVERIFY(!f.source.find(FeatureSet::ImageEstimate).field);

    f.show(f.edge);

    QVERIFY(f.source.find(FeatureSet::ImageEstimate).field);
  }

  // Its memory goes with that of the scene.
  void ownDisparity_isEstimatedAgainAfterAScenesReturn() {
    Sourcing f;
    f.source.provide();
    f.awaitJobs();
    const auto scene = f.session().scene();
    f.show(f.slant);
    f.session().unload(f.edge);
    QCoreApplication::processEvents();
    f.session().load(f.edge, scene, {});
    f.show(f.edge);
    QVERIFY(!f.source.find(FeatureSet::ImageEstimate).field);

    f.source.provide();
    f.awaitJobs();

    QVERIFY(f.source.find(FeatureSet::ImageEstimate).field);
  }
};

}  // namespace episcope::in_labeling_source_test

EPISCOPE_WINDOW_TEST(labeling_source_test, LabelingSourceTest)
#include "labeling_source_test.moc"
