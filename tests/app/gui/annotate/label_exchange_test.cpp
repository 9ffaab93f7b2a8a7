// SPDX-License-Identifier: BSD-3-Clause
// Labels of other tools come in by one dialog, and go out in their forms.
#include "app/gui/annotate/label_exchange.h"

#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/session/session.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/npy.h"
#include "engine/io/models/labels/label_import.h"
#include "engine/io/models/scribble_file.h"
#include "tests/app/gui/annotating.h"
#include "tests/window_test_main.h"
#include "widgets/controls/message_bar.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDir>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFile>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMimeData>
#include <QPushButton>
#include <QRadioButton>
#include <QUrl>

#include <algorithm>
#include <filesystem>
#include <vector>

namespace episcope::in_label_exchange_test {
namespace {

constexpr int kSide = 96;  ///< Of the views, in px.

class Exchanging : public Annotating {
 public:
  LabelImporter& importer() { return find<LabelImporter>(window); }
  [[nodiscard]] QString told() const { return window.findChild<MessageBar*>("messageBar")->text(); }
  template <class T>
  T* part(const QString& name) {
    return window.findChild<T*>(name);
  }

  /// A picture of rows of label 1 and 2, and of `third` in row 80.
  QString drawn(const QString& name, std::uint8_t third) {
    Image<std::uint8_t> picture(kSide, kSide, 1, 0);
    for (int x = 20; x < 60; ++x) {
      picture.at(40, x) = 1;
      picture.at(60, x) = 2;
      picture.at(80, x) = third;
    }
    io::write_png(path(name).toStdString(), picture.view());
    return path(name);
  }
  /// Labels of all views: 1 left, 2 right.
  QString halves(const QString& name) {
    std::vector<std::int32_t> labels(std::size_t{81} * kSide * kSide);
    for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = i % kSide < kSide / 2 ? 1 : 2;
    io::write_npy<std::int32_t>(path(name).toStdString(), {9, 9, kSide, kSide}, labels);
    return path(name);
  }
  void accept(const QString& use) {
    QTRY_VERIFY(part<QRadioButton>("importLabels." + use));
    part<QRadioButton>("importLabels." + use)->click();
    part<QPushButton>("importLabels.import")->click();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  }
};

}  // namespace

class LabelExchangeTest : public QObject {
  Q_OBJECT

 private slots:
  void drawing_isImportedByItsColors();
  void oneOfThreeUses_isAskedFor();
  void labelsOfAllViews_becomeTheSegmentation();
  void importedLabels_areNotReplacedUnsaid();
  void import_isAStepOfTheHistory();
  void importedLabels_stayWhenTheDisparityComes();
  void trueLabels_areCompared();
  void anotherId_isUnlabeledAtOnce();
  void anotherId_isUnlabeledBeforeTheImport_data();
  void anotherId_isUnlabeledBeforeTheImport();
  void namesThatAreNew_getFreeIds();
  void tableOfColors_isChosen();
  void folder_isChosen();
  void folderDropped_asks();
  void largeIds_areRenumbered();
  void foreignFiles_areRefusedInWords();
  void dropOnAnnotate_asks();
  void lightFieldOnAnnotate_isOpened();
  void zero_isALabelAtWish();
  void everyForm_isExported_data();
  void everyForm_isExported();
  void outOfDateLabels_areTold();
};

void LabelExchangeTest::drawing_isImportedByItsColors() {
  Exchanging f;
  Image<std::uint8_t> drawing(kSide, kSide, 3, 255);
  for (int x = 20; x < 60; ++x) {
    drawing.at(40, x, 0) = drawing.at(40, x, 2) = 0;  // green
    drawing.at(60, x, 1) = drawing.at(60, x, 2) = 0;  // red
  }
  io::write_png(f.path("drawing.png").toStdString(), drawing.view());

  f.importer().open({f.path("drawing.png")});
  f.accept("strokes");

  QTRY_COMPARE(f.labelAt({40, 40}), 1);
  QCOMPARE(f.labelAt({60, 40}), 2);
  QCOMPARE(f.labelAt({50, 40}), 0);
  QVERIFY2(f.told().contains("#ffffff"), qPrintable(f.told()));
}

void LabelExchangeTest::oneOfThreeUses_isAskedFor() {
  Exchanging f;

  f.importer().open({f.drawn("ids.png", 255)});

  QTRY_VERIFY(f.part<QDialog>("importLabels"));
  QVERIFY(!f.part<QLabel>("importLabels.preview")->pixmap().isNull());
  const QString content = f.part<QLabel>("importLabels.content")->text();
  QVERIFY2(content.contains("4,4") && content.contains("1") && content.contains("2"),
           qPrintable(content));
  QVERIFY(f.part<QLabel>("importLabels.notes")->text().contains("255"));
  QVERIFY(f.part<QRadioButton>("importLabels.strokes")->isChecked());
  QCOMPARE(f.labelAt({40, 40}), 0);
  f.accept("strokes");
  QTRY_COMPARE(f.labelAt({40, 40}), 1);
  QCOMPARE(f.labelAt({80, 40}), 0);
}

void LabelExchangeTest::labelsOfAllViews_becomeTheSegmentation() {
  Exchanging f;

  f.importer().open({f.halves("all.npy")});
  f.accept("segmentation");

  QTRY_VERIFY(f.segment().segmentation());
  const LabelingPtr labeling = f.segment().segmentation()->labeling;
  QCOMPARE(labeling->labels.grid().count(), 81);
  QCOMPARE(labeling->labels.view({0, 8}).at(5, 60), 2);
  QCOMPARE(f.labelAt({40, 40}), 0);  // nothing is painted
  QVERIFY(f.document().labels().contains(2));
}

void LabelExchangeTest::importedLabels_areNotReplacedUnsaid() {
  Exchanging f;
  f.importer().open({f.drawn("ids.png", 3)});
  QTRY_VERIFY(f.part<QRadioButton>("importLabels.segmentation"));
  f.part<QRadioButton>("importLabels.segmentation")->click();
  QVERIFY(!f.part<QLabel>("importLabels.replaced")->isVisible());
  f.accept("segmentation");
  QTRY_VERIFY(f.segment().segmentation());
  QVERIFY(f.window.bench().session.labels().is_worth_keeping());  // of one view, but nothing else
                                                                  // gives them

  f.importer().open({f.halves("all.npy")});

  QTRY_VERIFY(f.part<QRadioButton>("importLabels.segmentation"));
  QVERIFY(!f.part<QLabel>("importLabels.replaced")->isVisible());
  f.part<QRadioButton>("importLabels.segmentation")->click();
  QVERIFY(f.part<QLabel>("importLabels.replaced")->isVisible());
  const LabelingPtr former = f.window.bench().session.labels().labeling;
  f.accept("segmentation");
  QVERIFY(f.segment().hasAllViews());
  f.trigger("annotate.undo");
  QCOMPARE(f.window.bench().session.labels().labeling, former);
  QVERIFY(f.segment().hasSegmentation());
  QVERIFY(!f.segment().hasAllViews());
}

// A stroke and an import were once undone in two places, in any order.
void LabelExchangeTest::import_isAStepOfTheHistory() {
  Exchanging f;
  f.drag({20, 20}, {20, 40});
  const auto labels = [&f] { return f.window.bench().session.labels().labeling; };
  f.importer().open({f.halves("all.npy")});
  f.accept("segmentation");
  QTRY_VERIFY(f.segment().hasAllViews());
  const LabelingPtr imported = labels();
  f.drag({70, 20}, {70, 40});
  QVERIFY(f.labelAt({70, 30}) != 0);

  f.trigger("annotate.undo");
  QCOMPARE(f.labelAt({70, 30}), 0);
  QCOMPARE(labels(), imported);
  QVERIFY(f.segment().isSegmentationUpToDate());
  f.trigger("annotate.undo");
  QVERIFY(!labels());
  QVERIFY(!f.segment().hasSegmentation());
  QVERIFY(f.labelAt({20, 30}) != 0);
  f.trigger("annotate.redo");
  QCOMPARE(labels(), imported);
  QVERIFY(f.segment().hasAllViews());
}

void LabelExchangeTest::importedLabels_stayWhenTheDisparityComes() {
  Exchanging f;
  f.importer().open({f.halves("all.npy")});
  f.accept("segmentation");
  QTRY_VERIFY(f.segment().hasAllViews());
  const LabelingPtr imported = f.window.bench().session.labels().labeling;

  f.segment().provideDisparity();

  QTRY_VERIFY_WITH_TIMEOUT(f.segment().labeler().input()->disparity, kScenePatience);
  QVERIFY(f.segment().isSegmentationUpToDate());
  QCOMPARE(f.window.bench().session.labels().labeling, imported);
}

void LabelExchangeTest::trueLabels_areCompared() {
  Exchanging f;

  f.importer().open({f.halves("all.npy")});
  f.accept("truth");

  QTRY_VERIFY(f.told().contains("all.npy"));
  const TrueLabelsPtr truth = f.window.bench().session.true_labels();
  QVERIFY(truth && truth->view({3, 3}).at(10, 10) == 1);
}

void LabelExchangeTest::anotherId_isUnlabeledAtOnce() {
  Exchanging f;
  f.importer().open({f.drawn("ids.png", 7)});
  QTRY_VERIFY(f.part<QDialog>("importLabels"));
  const auto content = [&f] { return f.part<QLabel>("importLabels.content")->text(); };
  QVERIFY(content().contains("7"));

  auto* field = f.part<QLineEdit>("importLabels.ignored");
  field->setFocus();
  QTest::keyClicks(field, "7");
  QTest::keyClick(field, Qt::Key_Tab);

  QTRY_VERIFY(!content().contains("7"));
  f.accept("strokes");
  QTRY_COMPARE(f.labelAt({40, 40}), 1);
  QCOMPARE(f.labelAt({80, 40}), 0);
}

// What was typed last was once not yet read when the labels were taken.
void LabelExchangeTest::anotherId_isUnlabeledBeforeTheImport_data() {
  QTest::addColumn<bool>("by_return");
  QTest::newRow("button") << false;
  QTest::newRow("Return") << true;
}

void LabelExchangeTest::anotherId_isUnlabeledBeforeTheImport() {
  QFETCH(bool, by_return);
  Exchanging f;
  f.importer().open({f.drawn("ids.png", 7)});
  QTRY_VERIFY(f.part<QDialog>("importLabels"));
  auto* field = f.part<QLineEdit>("importLabels.ignored");
  field->setFocus();
  QTest::keyClicks(field, "x");
  f.part<QPushButton>("importLabels.import")->click();
  QVERIFY(f.part<QDialog>("importLabels")->isVisible());  // that is no id
  field->clear();
  QTest::keyClicks(field, "7");

  if (by_return) {
    QTest::keyClick(field, Qt::Key_Return);
  } else {
    f.part<QPushButton>("importLabels.import")->click();
  }

  QTRY_COMPARE(f.labelAt({40, 40}), 1);
  QCOMPARE(f.labelAt({80, 40}), 0);
}

void LabelExchangeTest::namesThatAreNew_getFreeIds() {
  Exchanging f;
  const auto write = [&f](const QString& name, const QByteArray& category) {
    QFile file(f.path(name));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(R"({"images": [{"id": 1, "file_name": "04_04.png", "height": 96, "width": 96}],
      "categories": [{"id": 10, "name": ")" +
               category + R"("}], "annotations": [
        {"image_id": 1, "category_id": 10, "segmentation": [[10, 10, 20, 10, 20, 20, 10, 20]]}]})");
  };
  write("apples.json", "apple");
  write("people.json", "person");
  f.importer().open({f.path("apples.json")});
  f.accept("strokes");
  QTRY_COMPARE(f.labelAt({15, 15}), 10);

  f.importer().open({f.path("people.json")});
  QTRY_VERIFY(f.part<QLabel>("importLabels.content"));
  QVERIFY(f.part<QLabel>("importLabels.content")->text().contains("1 person"));
  f.accept("segmentation");

  QTRY_VERIFY(f.segment().segmentation());
  QCOMPARE(f.segment().segmentation()->labeling->labels.view({4, 4}).at(15, 15), 1);
  QCOMPARE(f.document().labels().find(1)->name, std::string("person"));
  QCOMPARE(f.document().labels().find(10)->name, std::string("apple"));
  QVERIFY2(f.told().contains("10 (person) is 1"), qPrintable(f.told()));
}

void LabelExchangeTest::tableOfColors_isChosen() {
  Exchanging f;
  QFile table(f.path("colors.csv"));
  QVERIFY(table.open(QIODevice::WriteOnly));
  table.write("0,80,0,1,tree\n0,0,200,2,sky\n");
  table.close();
  f.importer().open({f.drawn("ids.png", 3)});
  QTRY_VERIFY(f.part<QDialog>("importLabels"));

  f.part<QPushButton>("importLabels.table")->click();
  auto* files = f.part<QFileDialog>("import_color_table");
  QVERIFY(files);
  emit files->fileSelected(f.path("colors.csv"));
  files->reject();

  QTRY_VERIFY(f.part<QLabel>("importLabels.content")->text().contains("1 tree"));
  f.accept("strokes");
  QTRY_COMPARE(f.labelAt({40, 40}), 1);
  QCOMPARE(f.document().labels().find(1)->name, std::string("tree"));
}

void LabelExchangeTest::folder_isChosen() {
  Exchanging f;
  QVERIFY(QDir(f.path("")).mkdir("masks"));
  f.drawn("masks/04_04.png", 3);

  f.importer().ask();
  auto* dialog = f.part<QFileDialog>("import_labels");
  QVERIFY(dialog);
  dialog->setDirectory(f.path("masks"));
  f.part<QPushButton>("import_labels.folder")->click();

  f.accept("strokes");
  QTRY_COMPARE(f.labelAt({80, 40}), 3);
}

void LabelExchangeTest::folderDropped_asks() {
  Exchanging f;
  f.window.bench().frame.showTab("annotate");
  QVERIFY(QDir(f.path("")).mkpath("voc/SegmentationClass"));
  f.drawn("voc/SegmentationClass/04_04.png", 3);
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(f.path("voc"))});
  QDragEnterEvent enter({50, 50}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QDropEvent drop(QPointF(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);

  QCoreApplication::sendEvent(&f.window, &enter);
  QCoreApplication::sendEvent(&f.window, &drop);

  QTRY_VERIFY(f.part<QDialog>("importLabels"));
  f.part<QDialog>("importLabels")->close();
}

void LabelExchangeTest::largeIds_areRenumbered() {
  Exchanging f;
  Image<std::uint16_t> picture(kSide, kSide, 1, 0);
  for (int x = 20; x < 60; ++x) picture.at(40, x) = 40000;
  io::write_png(f.path("large.png").toStdString(), picture.view());

  f.importer().open({f.path("large.png")});
  f.accept("strokes");

  QTRY_COMPARE(f.labelAt({40, 40}), 1);
  QVERIFY2(f.told().contains("40000 is 1"), qPrintable(f.told()));
}

void LabelExchangeTest::foreignFiles_areRefusedInWords() {
  Exchanging f;
  QFile file(f.path("notes.json"));
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write("[1, 2]");
  file.close();

  f.importer().open({f.path("notes.json")});

  QTRY_VERIFY(f.told().contains("labelme"));
  QVERIFY(!f.part<QDialog>("importLabels"));
}

void LabelExchangeTest::dropOnAnnotate_asks() {
  Exchanging f;
  f.window.bench().frame.showTab("annotate");
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(f.drawn("ids.png", 3))});
  QDragEnterEvent enter({50, 50}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QDropEvent drop(QPointF(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);

  QCoreApplication::sendEvent(&f.window, &enter);
  QCoreApplication::sendEvent(&f.window, &drop);

  QTRY_VERIFY(f.part<QDialog>("importLabels"));
  f.part<QDialog>("importLabels")->close();
}

void LabelExchangeTest::lightFieldOnAnnotate_isOpened() {
  Exchanging f;
  f.window.bench().frame.showTab("annotate");
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(f.writeScene("objects", WindowFixture::smallOptions()))});
  QDragEnterEvent enter({50, 50}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QDropEvent drop(QPointF(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);

  QCoreApplication::sendEvent(&f.window, &enter);
  QCoreApplication::sendEvent(&f.window, &drop);

  QTRY_COMPARE_WITH_TIMEOUT(f.window.bench().session.scenes().size(), std::size_t{2}, kPatience);
  QVERIFY(!f.part<QDialog>("importLabels"));
}

void LabelExchangeTest::zero_isALabelAtWish() {
  Exchanging f;
  f.importer().open({f.drawn("ids.png", 255)});
  QTRY_VERIFY(f.part<QLineEdit>("importLabels.ignored"));
  auto* ignored = f.part<QLineEdit>("importLabels.ignored");
  QTest::keyClicks(ignored, "255");
  QTest::keyClick(ignored, Qt::Key_Tab);
  const auto* notes = f.part<QLabel>("importLabels.notes");
  QTRY_VERIFY2(notes->text().contains("“0 is a label” makes it a label"),
               qPrintable(notes->text()));

  f.part<QCheckBox>("importLabels.zero")->click();

  QTRY_VERIFY2(!notes->text().contains("makes it a label"), qPrintable(notes->text()));
  f.accept("strokes");
  QTRY_COMPARE(f.labelAt({40, 40}), 2);
  QCOMPARE(f.labelAt({10, 10}), 1);
}

void LabelExchangeTest::everyForm_isExported_data() {
  QTest::addColumn<int>("row");
  QTest::addColumn<QString>("place");
  QTest::addColumn<QString>("file");
  QTest::newRow("PNG") << 2 << "png"
                       << "png/00_08.png";
  QTest::newRow("VOC") << 3 << "voc"
                       << "voc/JPEGImages/08_08.png";
  QTest::newRow("COCO") << 4 << "coco"
                        << "coco/annotations/instances_default.json";
  QTest::newRow("labelme") << 5 << "labelme"
                           << "labelme/04_04.json";
}

void LabelExchangeTest::everyForm_isExported() {
  QFETCH(int, row);
  QFETCH(QString, place);
  QFETCH(QString, file);
  Exchanging f;
  f.importer().open({f.halves("all.npy")});
  f.accept("segmentation");
  QTRY_VERIFY(f.segment().segmentation());
  const io::LabelForm form = io::names_of(io::LabelForm{})[static_cast<std::size_t>(row - 2)].value;

  ask_to_export_labels(f.window.bench(), f.segment());
  QVERIFY(f.part<QDialog>("exportLabels"));
  QVERIFY(f.part<QLabel>("exportLabels.warning")->isHidden());
  QCOMPARE(f.part<QComboBox>("exportLabels.form")->count(), 7);
  f.part<QDialog>("exportLabels")->close();
  export_labels(f.window.bench(), f.segment(), f.path(place),
                {LabelTarget::Kind::Folder, form, true});
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(f.path(file)), kPatience);

  const io::ImportedLabels read =
      io::read_label_files({f.path(place).toStdString()}, {{{9, 9}, kSide, kSide}});
  QCOMPARE(read.scribbles.views.size(), std::size_t{81});
  QCOMPARE(read.scribbles.views[80].labels.at(5, 60), 2);
}

void LabelExchangeTest::outOfDateLabels_areTold() {
  Exchanging f;
  f.importer().open({f.halves("all.npy")});
  f.accept("segmentation");
  QTRY_VERIFY(f.segment().segmentation());
  f.drag({40, 20}, {40, 60});
  QTRY_VERIFY(!f.segment().labeler().is_up_to_date(f.window.bench().session.view()));

  ask_to_export_labels(f.window.bench(), f.segment());
  QVERIFY(!f.part<QLabel>("exportLabels.warning")->isHidden());
  f.part<QDialog>("exportLabels")->close();
  export_labels(f.window.bench(), f.segment(), f.path("out.h5"), {LabelTarget::Kind::Hdf5});

  QTRY_VERIFY_WITH_TIMEOUT(f.told().contains("out of date"), kPatience);
  const io::SegmentationFile file(f.path("out.h5").toStdString());
  QVERIFY(!file.has_probabilities());
  QVERIFY(std::filesystem::file_size(f.path("out.h5").toStdString()) < 200000);
}

}  // namespace episcope::in_label_exchange_test

EPISCOPE_WINDOW_TEST(label_exchange_test, LabelExchangeTest)

#include "label_exchange_test.moc"
