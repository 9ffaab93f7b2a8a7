// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/segment_controller.h"
#include "app/gui/scene/overlay.h"
#include "app/gui/shell/commands.h"
#include "engine/io/formats/archive_companions.h"
#include "engine/io/open.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/controls/message_bar.h"
#include "widgets/panels/segment_panel.h"

#include <QAction>
#include <QFileInfo>
#include <QSignalSpy>
#include <QToolTip>

#include <algorithm>
#include <filesystem>

// The edge weights that lie beside a light field, in the window that ships.

namespace episcope::in_edge_weights_test {

namespace {

using render::Quantity;

class Weighted : public WindowFixture {
 public:
  /// Edges everywhere in the left half of each view, and nowhere else.
  void openWithWeights() {
    const std::filesystem::path file = writeScene("objects", smallOptions()).toStdString();
    const Scene scene = io::open_scene(file, {}, Progress());
    const LightField& lf = *scene.light_field;
    ViewStack<float> weights(lf.grid(), lf.height(), lf.width());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      weights.data()[i] = isLeft(static_cast<int>(i) % lf.width(), lf.width()) ? 1.0F : 0.0F;
    }
    io::write_edge_probabilities(file.parent_path() / "edge_weights.h5", weights, scene,
                                 Progress());
    open(file);
  }
  static bool isLeft(int x, int width) { return x < width / 2; }

  [[nodiscard]] const LiveLabeler& labeler() { return find<SegmentController>(window).labeler(); }
  [[nodiscard]] QString chipTip() const {
    return window.findChild<SegmentPanel*>()->findChild<QWidget*>("segment.state")->toolTip();
  }
  void trigger(const char* id) { window.bench().commands.find(id)->trigger(); }

 private:
  void open(const std::filesystem::path& file) {
    window.bench().opener.open(QString::fromStdString(file.string()));
    QTRY_VERIFY_WITH_TIMEOUT(labeler().has_input(), kPatience);
  }
};

}  // namespace

class EdgeWeightsTest : public QObject {
  Q_OBJECT

 private slots:
  void weightsOfTheFile_areShownAndGoneBy();
  void withoutAFile_edgesAreComputed();
  void damagedFile_isToldAndComputedInstead();
};

void EdgeWeightsTest::weightsOfTheFile_areShownAndGoneBy() {
  Weighted f;
  f.openWithWeights();
  QTRY_VERIFY_WITH_TIMEOUT(f.labeler().input()->edges, kPatience);
  QVERIFY2(f.chipTip().contains("file"), qPrintable(f.chipTip()));

  f.trigger("segment.edges");
  QTRY_VERIFY(f.window.bench().overlay.isUpToDate() &&
              !f.window.bench().overlay.picture().isNull());
  const QImage picture = f.window.bench().overlay.picture();
  QVERIFY(picture.pixelColor(10, 40) == picture.pixelColor(40, 70));
  QVERIFY(picture.pixelColor(60, 40) == picture.pixelColor(90, 70));
  QVERIFY(picture.pixelColor(10, 40) != picture.pixelColor(60, 40));

  f.trigger("segment.all");
  QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().jobs.count() == 0 && f.labeler().labeling({0, 0}),
                           kScenePatience);
  QVERIFY(find<SegmentController>(f.window).map_source(render::Quantity::Edges, {0, 0})->edges);
}

void EdgeWeightsTest::withoutAFile_edgesAreComputed() {
  Weighted f;
  f.openWithWeights();
  QTRY_VERIFY_WITH_TIMEOUT(f.labeler().input()->edges, kPatience);
  std::filesystem::remove(std::filesystem::path(f.path("objects/edge_weights.h5").toStdString()));

  f.trigger("file.read_again");
  QTRY_VERIFY_WITH_TIMEOUT(!f.labeler().input()->edges, kPatience);

  QVERIFY2(f.chipTip().contains("computed"), qPrintable(f.chipTip()));
}

void EdgeWeightsTest::damagedFile_isToldAndComputedInstead() {
  Weighted f;
  f.openWithWeights();
  QTRY_VERIFY_WITH_TIMEOUT(f.labeler().input()->edges, kPatience);
  const auto scene = f.window.bench().session.scene();
  const auto file = std::filesystem::path(f.path("objects/edge_weights.h5").toStdString());
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);

  f.window.bench().session.open(scene, f.path("objects").toStdString());
  const auto* messages = f.window.findChild<MessageBar*>("messageBar");
  QTRY_VERIFY_WITH_TIMEOUT(messages->text().contains("edge_weights.h5"), kPatience);

  QVERIFY(!f.labeler().input()->edges);
}

}  // namespace episcope::in_edge_weights_test

EPISCOPE_WINDOW_TEST(edge_weights_test, EdgeWeightsTest)
#include "edge_weights_test.moc"
