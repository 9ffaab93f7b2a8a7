// SPDX-License-Identifier: BSD-3-Clause
// The way of a user, by mouse and keys: opens a light field, adds labels, paints, undoes across
// views, carries to all views, segments, saves, and finds the same in another window.
#include "app/gui/annotate/annotate_controller.h"
#include "app/gui/annotate/scribble_controller.h"
#include "app/gui/annotate/segment_controller.h"
#include "app/gui/scene/overlay.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/jobs.h"
#include "engine/evaluation/label_quality.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/message_bar.h"
#include "widgets/panels/label_palette.h"

#include <QAction>
#include <QApplication>
#include <QColorDialog>
#include <QDir>
#include <QFile>
#include <QLineEdit>
#include <QTreeWidget>

#include <filesystem>

namespace episcope::in_story_test {

namespace {

constexpr ViewIndex kCenter{4, 4};
const QColor kColor(12, 200, 96);

// A person at the window.
class User : public WindowFixture {
 public:
  void openFolder(const QString& folder) {
    window.bench().opener.open(folder);  // as named in the command line
    QTRY_VERIFY2_WITH_TIMEOUT(window.bench().document.document(),
                              qPrintable(window.findChild<MessageBar*>("messageBar")->text()),
                              kScenePatience);
    QTRY_COMPARE_WITH_TIMEOUT(window.bench().jobs.count(), 0, kScenePatience);
    key(Qt::Key_B);
  }
  int addLabel(const QString& name, const QColor& color) {
    window.activateWindow();
    QTEST_ASSERT(QTest::qWaitForWindowActive(&window));
    click("labels.add");
    auto* tree = window.findChild<LabelPalette*>()->findChild<QTreeWidget*>("labels.tree");
    type(qobject_cast<QLineEdit*>(QApplication::focusWidget()), name);
    // Renaming filled the rows again; the first column is the color.
    const int row = tree->visualItemRect(tree->currentItem()).center().y();
    QTest::mouseClick(tree->viewport(), Qt::LeftButton, {}, {8, row});
    chooseColor(color);
    return document().labels().labels().back().id;
  }
  void segment(Qt::Key how) {
    key(how);
    QTRY_VERIFY_WITH_TIMEOUT(isSegmented(), kScenePatience);
  }
  /// A pixel at these parts of the height and the width.
  PixelIndex pixel(double y, double x) {
    const LightField& light_field = *window.bench().session.light_field();
    return {static_cast<int>(y * light_field.height()), static_cast<int>(x * light_field.width())};
  }
  void paint(double y, double x0, double x1) { drag(pixel(y, x0), pixel(y, x1)); }
  int painted(double y, double x) { return document().scribbles().label_at(view(), pixel(y, x)); }
  ImageView<const std::int32_t> segments() {
    return find<SegmentController>(window).labeler().labeling(view())->labels.view(view());
  }

 private:
  static void type(QLineEdit* editor, const QString& text) {
    QVERIFY(editor);
    editor->selectAll();
    QTest::keyClicks(editor, text);
    QTest::keyClick(editor, Qt::Key_Return);
  }
  void chooseColor(const QColor& color) {
    auto* dialog = window.findChild<QColorDialog*>("label_color");
    QVERIFY(dialog);
    for (QLineEdit* editor : dialog->findChildren<QLineEdit*>()) {
      if (!editor->text().startsWith('#')) continue;
      editor->selectAll();
      QTest::keyClicks(editor, color.name());
    }
    QTest::keyClick(dialog, Qt::Key_Return);
  }
};

// A copy that can be saved beside; the light field itself is large, and stays where it is.
void copy_scene(const QString& from, const QString& to) {
  QVERIFY(QDir().mkpath(to));
  QVERIFY(QFile::link(from + "/lf.h5", to + "/lf.h5"));
  std::filesystem::copy_file((from + "/labels.h5").toStdString(),
                             (to + "/labels.h5").toStdString());
  QVERIFY(QFile(to + "/labels.h5").setPermissions(QFile::ReadOwner | QFile::WriteOwner));
}

}  // namespace

class StoryTest : public QObject {
  Q_OBJECT

 private slots:
  void whatIsPaintedAndSaved_isFoundAgain_data();
  void whatIsPaintedAndSaved_isFoundAgain();
};

void StoryTest::whatIsPaintedAndSaved_isFoundAgain_data() {
  QTest::addColumn<QString>("source");
  QTest::newRow("built-in scene") << QString();
  const QString shared = qEnvironmentVariable("EPISCOPE_SHARED_DATA");
  if (!shared.isEmpty()) QTest::newRow("still_life") << shared + "/still_life";
}

void StoryTest::whatIsPaintedAndSaved_isFoundAgain() {
  QFETCH(QString, source);
  User user;
  const QString folder = user.path("objects");
  if (source.isEmpty()) {
    (void)user.writeScene("objects", WindowFixture::smallOptions());
  } else {
    copy_scene(source, folder);
  }
  user.openFolder(folder);
  const std::size_t given = user.document().labels().labels().size();
  const std::size_t given_views = user.document().scribbles().painted_views().size();

  // Labels, a stroke here and two on another view.
  const int wall = user.addLabel("wall, behind", kColor);
  user.paint(0.06, 0.1, 0.5);
  const int corner = user.addLabel("corner", Qt::magenta);
  QCOMPARE(user.document().labels().labels().size(), given + 2);
  user.key(Qt::Key_Left);
  user.key(Qt::Key_Up);
  QVERIFY((user.view() == ViewIndex{3, 3}));
  user.paint(0.95, 0.6, 0.9);
  user.paint(0.8, 0.6, 0.9);
  QCOMPARE(user.painted(0.95, 0.7), corner);

  // Undo goes to where it changes something, and back.
  user.key(Qt::Key_Home);
  QVERIFY(user.view() == kCenter);
  user.key(Qt::Key_Z, Qt::ControlModifier);
  QVERIFY((user.view() == ViewIndex{3, 3}));
  QCOMPARE(user.painted(0.8, 0.7), 0);
  QCOMPARE(user.painted(0.95, 0.7), corner);
  user.key(Qt::Key_Z, Qt::ControlModifier);                              // the other stroke there
  for (int i = 0; i < 3; ++i) user.key(Qt::Key_Z, Qt::ControlModifier);  // label, name, color
  user.key(Qt::Key_Z, Qt::ControlModifier);  // the stroke on the center view
  QVERIFY(user.view() == kCenter);
  QCOMPARE(user.painted(0.06, 0.3), 0);
  for (int i = 0; i < 5; ++i) user.key(Qt::Key_Y, Qt::ControlModifier);
  QVERIFY((user.view() == ViewIndex{3, 3}));
  QCOMPARE(user.document().labels().labels().size(), given + 2);

  // Carried to all views by the truth: there is no estimate.
  user.key(Qt::Key_C);
  QTRY_VERIFY_WITH_TIMEOUT(find<ScribbleController>(user.window).carried() &&
                               !find<ScribbleController>(user.window).isCarrying(),
                           kScenePatience);
  QVERIFY(find<ScribbleController>(user.window).carried()->painted_views().size() > 70);

  // Segmented live, again after a stroke, and once more by hand.
  user.key(Qt::Key_Home);
  user.segment(Qt::Key_L);
  QCOMPARE(user.window.bench().overlay.quantity(), render::Quantity::Segmentation);
  user.key(Qt::Key_X);
  user.paint(0.2, 0.1, 0.3);
  QCOMPARE(user.painted(0.2, 0.2), wall);
  QTRY_VERIFY_WITH_TIMEOUT(user.isSegmented(), kScenePatience);
  user.key(Qt::Key_L);
  user.segment(Qt::Key_U);
  const PixelIndex on_stroke = user.pixel(0.06, 0.3);
  QCOMPARE(user.segments().at(on_stroke.y, on_stroke.x), wall);

  QVERIFY(user.window.isWindowModified());
  user.key(Qt::Key_S, Qt::ControlModifier);
  QTRY_VERIFY_WITH_TIMEOUT(!user.window.isWindowModified(), kScenePatience);

  User other;
  other.openFolder(folder);
  QVERIFY(other.document().labels() == user.document().labels());
  QCOMPARE(other.document().labels().find(wall)->name, std::string("wall, behind"));
  QVERIFY((other.document().labels().find(wall)->color == Rgb{12, 200, 96}));
  QVERIFY(other.document().scribbles() == user.document().scribbles());
  QVERIFY(other.document().scribbles().painted_views().size() > given_views);
  user.key(Qt::Key_C);  // what is carried is no part of the file
  QCOMPARE(other.canvas()->scribbles(), user.canvas()->scribbles());
  QVERIFY(!other.window.isWindowModified());
  other.segment(Qt::Key_U);
  // Live labels start from those before each stroke and stop within half a percent of the optimum.
  QVERIFY(judge_labels(other.segments(), user.segments()).share().value_or(0) > 0.98);
  QVERIFY(!other.window.isWindowModified());
  user.window.close();
  QVERIFY(!user.window.isVisible());  // without a question
}

}  // namespace episcope::in_story_test

EPISCOPE_WINDOW_TEST(story_test, StoryTest)
#include "story_test.moc"
