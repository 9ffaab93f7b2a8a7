// SPDX-License-Identifier: BSD-3-Clause
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/labels.h"
#include "widgets/panels/scene_panel.h"

#include <QComboBox>
#include <QDir>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QMimeData>
#include <QSlider>
#include <QUrl>

namespace episcope::in_collection_window_test {

class CollectionWindowTest : public QObject {
  Q_OBJECT

 private slots:
  void collection_isListedWithThumbnails();
  void droppedFolder_isListed();
  void doubleClick_andReturn_open();
  void pageKeys_goFromSceneToScene();
  void steppingThrough_keepsOpenWhatWasWorkedOn();
  void filterAndOrder_chooseRows();
  void problem_isToldWhole();
  void emptyFolder_saysSo();
  void slider_opensFrames_andKeepsTheView();
  void otherScenes_haveNoSlider();
};

// Scenes of different sizes in a folder.
QString make_collection(const WindowFixture& f, const QStringList& names) {
  const QString lf = f.writeScene("edge", WindowFixture::smallOptions());
  const QString root = f.path("collection");
  for (const QString& name : names) {
    QDir().mkpath(root + '/' + name);
    QFile::copy(lf, root + '/' + name + "/lf.h5");
  }
  return root;
}

QListView* list_of(const WindowFixture& f) {
  return f.window.findChild<QListView*>("scenes.list");
}

void open_collection(WindowFixture& f, const QString& folder, int count) {
  f.window.bench().opener.open(folder);
  QTRY_COMPARE_WITH_TIMEOUT(list_of(f)->model()->rowCount(), count, kScenePatience);
  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().jobs.count(), 0, kScenePatience);
}

QString open_input(const WindowFixture& f) {
  return QString::fromStdString(f.window.bench().session.input());
}

QStringList names_of(const WindowFixture& f) {
  QStringList names;
  const QAbstractItemModel* model = list_of(f)->model();
  for (int row = 0; row < model->rowCount(); ++row) {
    names += model->index(row, 0).data().toString();
  }
  return names;
}

void CollectionWindowTest::collection_isListedWithThumbnails() {
  WindowFixture f;

  open_collection(f, make_collection(f, {"one", "two", "deep/three"}), 3);

  QCOMPARE(f.window.bench().frame.shownTab(), QString("collection"));
  QCOMPARE(f.canvas()->accessibleDescription(), QString("Choose a scene in the list."));
  QCOMPARE(names_of(f), QStringList({"one", "three", "two"}));
  const QModelIndex first = list_of(f)->model()->index(0, 0);
  QCOMPARE(first.data(SceneList::kForm).toString(), QString("2013 archive"));
  QTRY_VERIFY_WITH_TIMEOUT(!first.data(Qt::DecorationRole).value<QImage>().isNull(),
                           kScenePatience);
  QVERIFY(!f.window.bench().session.scene());
}

void CollectionWindowTest::droppedFolder_isListed() {
  WindowFixture f;
  const QString folder = make_collection(f, {"one", "two"});
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(folder)});

  QDragEnterEvent enter({300, 300}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QDropEvent drop(QPointF(300, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(&f.window, &enter);
  QCoreApplication::sendEvent(&f.window, &drop);

  QTRY_COMPARE_WITH_TIMEOUT(names_of(f), QStringList({"one", "two"}), kScenePatience);
}

void CollectionWindowTest::doubleClick_andReturn_open() {
  WindowFixture f;
  const QString folder = make_collection(f, {"one", "two"});
  open_collection(f, folder, 2);
  QListView* list = list_of(f);
  const auto middle = [&](int row) {
    return list->visualRect(list->model()->index(row, 0)).center();
  };

  QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, middle(1));
  QTest::mouseDClick(list->viewport(), Qt::LeftButton, {}, middle(1));
  QTRY_COMPARE_WITH_TIMEOUT(open_input(f), folder + "/two", kScenePatience);
  QTRY_VERIFY(list->model()->index(1, 0).data(SceneList::kIsOpen).toBool());

  list->setFocus();
  QTest::keyClick(list, Qt::Key_Up);
  QTest::keyClick(list, Qt::Key_Return);
  QTRY_COMPARE_WITH_TIMEOUT(open_input(f), folder + "/one", kScenePatience);
}

void CollectionWindowTest::pageKeys_goFromSceneToScene() {
  WindowFixture f;
  const QString folder = make_collection(f, {"1", "cotton", "dino"});
  QFile broken(folder + "/bad.h5");
  QVERIFY(broken.open(QIODevice::WriteOnly));
  broken.write("this is no HDF5 file");
  broken.close();
  open_collection(f, folder, 4);

  f.key(Qt::Key_PageDown);
  QTRY_COMPARE_WITH_TIMEOUT(open_input(f), folder + "/1", kScenePatience);
  f.key(Qt::Key_PageDown);
  QTRY_COMPARE_WITH_TIMEOUT(open_input(f), folder + "/cotton", kScenePatience);
  list_of(f)->setFocus();
  QTest::keyClick(list_of(f), Qt::Key_PageDown);
  QTRY_COMPARE_WITH_TIMEOUT(open_input(f), folder + "/dino", kScenePatience);
  f.key(Qt::Key_PageDown);
  f.key(Qt::Key_PageUp);
  QTRY_COMPARE_WITH_TIMEOUT(open_input(f), folder + "/cotton", kScenePatience);
}

void CollectionWindowTest::steppingThrough_keepsOpenWhatWasWorkedOn() {
  WindowFixture f;
  const QString root = make_collection(f, {"a", "b", "c"});
  open_collection(f, root, 3);
  const auto go_to = [&](const QString& name) {
    emit find<ScenePanel>(f.window).openRequested(root + '/' + name);
    QTRY_VERIFY_WITH_TIMEOUT(open_input(f).startsWith(root + '/' + name), kScenePatience);
    QTRY_VERIFY_WITH_TIMEOUT(f.window.bench().document.document(), kPatience);
    QCoreApplication::processEvents();
  };
  const auto open_count = [&f] { return f.window.bench().session.scenes().size(); };

  go_to("a");
  go_to("b");
  QCOMPARE(open_count(), 1U);
  f.runAndWait();
  go_to("c");
  QCOMPARE(open_count(), 2U);
  go_to("a");

  QCOMPARE(open_count(), 2U);
  QCOMPARE(f.window.bench().session.scenes()[0]->estimates.size(), 1U);

  f.window.bench().session.set_measurements({.list = {{.name = "line 1"}}});
  go_to("c");
  QCOMPARE(open_count(), 3U);
}

void CollectionWindowTest::filterAndOrder_chooseRows() {
  WindowFixture f;
  const QString folder = make_collection(f, {"scene 10", "scene 9", "cotton"});
  QFile broken(folder + "/bad.h5");
  QVERIFY(broken.open(QIODevice::WriteOnly));
  broken.write("this is no HDF5 file");
  broken.close();
  open_collection(f, folder, 4);
  QCOMPARE(names_of(f), QStringList({"bad", "cotton", "scene 9", "scene 10"}));

  QTest::keyClicks(f.window.findChild<QLineEdit*>("scenes.filter"), "SCENE");
  QCOMPARE(names_of(f), QStringList({"scene 9", "scene 10"}));
  f.window.findChild<QLineEdit*>("scenes.filter")->clear();
  QComboBox* order = f.window.findChild<QComboBox*>("scenes.order");
  order->setCurrentIndex(order->findText("Ground truth"));

  QCOMPARE(names_of(f).last(), QString("bad"));

  QTest::keyClicks(f.window.findChild<QLineEdit*>("scenes.filter"), "ground truth");
  QCOMPARE(names_of(f).size(), 3);
}

void CollectionWindowTest::problem_isToldWhole() {
  WindowFixture f;
  const QString folder = make_collection(f, {"cotton"});
  QFile broken(folder + "/bad.h5");
  QVERIFY(broken.open(QIODevice::WriteOnly));
  broken.write("this is no HDF5 file");
  broken.close();
  open_collection(f, folder, 2);
  QListView* list = list_of(f);
  const auto* problem = f.window.findChild<FoldedLabel*>("scenes.problem");
  QVERIFY(!problem->isVisible());

  const QModelIndex bad = list->model()->index(0, 0);
  list->setCurrentIndex(bad);

  QVERIFY(problem->isVisible());
  QCOMPARE(problem->fullText(), bad.data(SceneList::kProblem).toString());
  QVERIFY(!problem->text().endsWith(QChar(0x2026)));
  list->setCurrentIndex(list->model()->index(1, 0));
  QVERIFY(!problem->isVisible());
}

void CollectionWindowTest::emptyFolder_saysSo() {
  WindowFixture f;
  f.window.bench().frame.showTab("collection");
  const QLabel* hint = f.window.findChild<QLabel*>("scenes.hint");
  QVERIFY(hint->isVisible());
  QVERIFY2(hint->text().contains("drop"), qPrintable(hint->text()));

  open_collection(f, make_collection(f, {"one", "two"}), 2);

  QVERIFY(!hint->isVisible());
}

QString make_sequence(const WindowFixture& f) {
  return make_collection(f, {"frame_0", "frame_1", "frame_2"});
}

void CollectionWindowTest::slider_opensFrames_andKeepsTheView() {
  WindowFixture f;
  f.window.bench().opener.open(make_sequence(f));
  const auto frame = [&] {
    const auto& scene = f.window.bench().session.scene();
    return scene ? scene->sequence.frame : -1;
  };
  QTRY_COMPARE_WITH_TIMEOUT(frame(), 0, kScenePatience);
  TimeBar& bar = find<TimeBar>(f.window);
  QTRY_VERIFY(bar.isVisible());
  f.window.bench().session.set_view({2, 3});
  f.canvas()->zoomIn();
  const QPoint corner = f.at({0, 0});

  f.key(Qt::Key_Right, Qt::AltModifier);

  QTRY_COMPARE_WITH_TIMEOUT(frame(), 1, kScenePatience);
  QTRY_COMPARE(f.view(), (ViewIndex{2, 3}));
  QCOMPARE(f.at({0, 0}), corner);
  QSlider* slider = bar.findChild<QSlider*>();
  QTRY_COMPARE(slider->value(), 1);
  slider->setFocus();
  QTest::keyClick(slider, Qt::Key_End);
  QTRY_COMPARE_WITH_TIMEOUT(frame(), 2, kScenePatience);
  QTRY_COMPARE(f.view(), (ViewIndex{2, 3}));
  f.trigger("sequence.play");
  QTRY_COMPARE_WITH_TIMEOUT(frame(), 0, kScenePatience);
  QTRY_COMPARE_WITH_TIMEOUT(frame(), 1, kScenePatience);
  f.trigger("sequence.play");
}

void CollectionWindowTest::otherScenes_haveNoSlider() {
  WindowFixture f;

  f.openSmall();

  QVERIFY(!find<TimeBar>(f.window).isVisible());
}

}  // namespace episcope::in_collection_window_test

EPISCOPE_WINDOW_TEST(collection_window_test, CollectionWindowTest)
#include "collection_window_test.moc"
