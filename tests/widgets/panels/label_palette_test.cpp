// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/label_palette.h"
#include "tests/window_test_main.h"

#include <QDropEvent>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMimeData>
#include <QSignalSpy>
#include <QToolButton>
#include <QTreeWidget>

#include <memory>

namespace episcope::in_label_palette_test {

namespace {

std::vector<LabelInfo> labels(int count) {
  std::vector<LabelInfo> made;
  for (int id = 1; id <= count; ++id) {
    made.push_back({2 * id, "label " + std::to_string(2 * id), label_color(id)});
  }
  return made;
}

}  // namespace

class LabelPaletteTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    palette_ = std::make_unique<LabelPalette>();
    palette_->resize(340, 300);
    tree_ = palette_->findChild<QTreeWidget*>("labels.tree");
    palette_->show();
    QVERIFY(QTest::qWaitForWindowActive(palette_.get()));
  }
  void cleanup() { palette_.reset(); }

  void rows_showIdsNamesAndTheCurrentOne() {
    QSignalSpy chosen(palette_.get(), &LabelPalette::currentChosen);
    palette_->setLabels(labels(3));
    palette_->setCurrent(4);

    QCOMPARE(tree_->topLevelItemCount(), 3);
    QCOMPARE(tree_->topLevelItem(2)->text(1), QString("6"));
    QCOMPARE(tree_->topLevelItem(2)->text(2), QString("label 6"));
    QVERIFY(tree_->topLevelItem(1)->isSelected());
    QVERIFY(tree_->topLevelItem(1)->font(2).bold());
    QVERIFY(!tree_->topLevelItem(0)->font(2).bold());
    QCOMPARE(chosen.size(), 0);  // setters never emit
  }

  void clickAndArrow_chooseALabel() {
    palette_->setLabels(labels(3));
    palette_->setCurrent(2);
    QSignalSpy chosen(palette_.get(), &LabelPalette::currentChosen);

    click(1, 2);
    QCOMPARE(chosen.takeFirst()[0].toInt(), 4);
    QTest::keyClick(tree_, Qt::Key_Down);
    QCOMPARE(chosen.takeFirst()[0].toInt(), 6);
    QCOMPARE(palette_->current(), 6);
  }

  void drag_movesTheLabel_toTheNearestBorderOfRows() {
    palette_->setLabels(labels(4));
    QSignalSpy moves(palette_.get(), &LabelPalette::moveRequested);
    const auto by = [&](int from, int onto, bool is_lower_half) {
      click(from, 2);
      const QRect row = tree_->visualItemRect(tree_->topLevelItem(onto));
      drop({row.center().x(), is_lower_half ? row.bottom() - 2 : row.top() + 2});
      return moves.isEmpty() ? 0 : moves.takeFirst()[1].toInt();
    };
    QCOMPARE(by(0, 2, true), 2);
    QCOMPARE(by(0, 2, false), 1);
    QCOMPARE(by(3, 0, false), -3);
    QCOMPARE(by(3, 0, true), -2);
    QCOMPARE(by(1, 1, true), 0);
    QCOMPARE(by(1, 0, true), 0);
    click(0, 2);
    drop({40, tree_->viewport()->height() - 2});  // below all
    QCOMPARE(moves.takeFirst(), (QVariantList{2, 3}));
    QCOMPARE(tree_->topLevelItem(0)->text(1), QString("2"));  // the owner moves it
  }

  void clickOnTheColour_asksForAnother() {
    palette_->setLabels(labels(3));
    QSignalSpy colors(palette_.get(), &LabelPalette::colorRequested);

    click(2, 0);

    QCOMPARE(colors.size(), 1);
    QCOMPARE(colors[0][0].toInt(), 6);
  }

  void typedName_isAnIntent() {
    palette_->setLabels(labels(3));
    palette_->setCurrent(4);
    QSignalSpy renamed(palette_.get(), &LabelPalette::renameRequested);

    palette_->findChild<QToolButton*>("labels.rename")->click();
    auto* editor = tree_->findChild<QLineEdit*>();
    QVERIFY(editor);
    editor->setText("vase");
    QTest::keyClick(editor, Qt::Key_Return);

    QTRY_COMPARE(renamed.size(), 1);
    QCOMPARE(renamed[0][0].toInt(), 4);
    QCOMPARE(renamed[0][1].toString(), QString("vase"));
  }

  void clicksOnEyeAndLock_areIntents_andChooseNothing() {
    palette_->setLabels(labels(3));
    palette_->setCurrent(2);
    palette_->setLocked({4});
    QSignalSpy chosen(palette_.get(), &LabelPalette::currentChosen);
    QSignalSpy hidden(palette_.get(), &LabelPalette::hiddenRequested);
    QSignalSpy locked(palette_.get(), &LabelPalette::lockedRequested);

    click(1, 4);
    click(1, 5);
    click(2, 5);

    QCOMPARE(hidden.size(), 1);
    QCOMPARE(hidden[0][0].toInt(), 4);
    QVERIFY(hidden[0][1].toBool());
    QCOMPARE(locked.size(), 2);
    QVERIFY(!locked[0][1].toBool());  // it was locked
    QCOMPARE(locked[1][0].toInt(), 6);
    QVERIFY(locked[1][1].toBool());
    QCOMPARE(chosen.size(), 0);
    QCOMPARE(palette_->current(), 2);
  }

  void amounts_standInTheirRows() {
    palette_->setLabels(labels(2));

    palette_->setAmounts({{4, {"1,234", "1,234 px painted"}}});

    QCOMPARE(tree_->topLevelItem(0)->text(3), QString());
    QCOMPARE(tree_->topLevelItem(1)->text(3), QString("1,234"));
    QCOMPARE(tree_->topLevelItem(1)->toolTip(3), QString("1,234 px painted"));
  }

  void deleteKey_removesTheCurrentLabel() {
    palette_->setLabels(labels(3));
    palette_->setCurrent(6);
    QSignalSpy removed(palette_.get(), &LabelPalette::removeRequested);

    tree_->setFocus();
    QTest::keyClick(tree_, Qt::Key_Delete);

    QCOMPARE(removed.size(), 1);
    QCOMPARE(removed[0][0].toInt(), 6);
  }

  void withoutLabels_aHintStandsThere() {
    palette_->setHint("begin here");
    palette_->setLabels({});

    QVERIFY(!tree_->isVisible());
    QVERIFY(palette_->findChild<QLabel*>("labels.hint")->isVisible());
    QVERIFY(!palette_->findChild<QToolButton*>("labels.remove")->isEnabled());
    QVERIFY(palette_->findChild<QToolButton*>("labels.add")->isEnabled());
  }

  void longNames_neitherWidenNorHideAnything() {
    std::vector<LabelInfo> many = labels(40);
    many[0].name = std::string(200, 'W');
    const int width = palette_->minimumSizeHint().width();

    palette_->setLabels(many);
    palette_->setCurrent(80);

    QVERIFY(palette_->minimumSizeHint().width() <= width);
    QCOMPARE(tree_->topLevelItem(0)->toolTip(2).size(), qsizetype{200});
    // The current one is scrolled into sight.
    QVERIFY(tree_->viewport()->rect().contains(
        tree_->visualItemRect(tree_->topLevelItem(39)).center()));
  }

 private:
  void drop(QPoint at) {
    const QMimeData none;
    QDropEvent event(at, Qt::MoveAction, &none, Qt::LeftButton, Qt::NoModifier);
    // QApplication delivers no drop without a drag that the system began.
    static_cast<QObject*>(palette_.get())->eventFilter(tree_->viewport(), &event);
    QVERIFY(event.isAccepted());
    QCOMPARE(event.dropAction(), Qt::IgnoreAction);
  }
  void click(int row, int column) {
    const QRect rect = tree_->visualItemRect(tree_->topLevelItem(row));
    const int x = tree_->header()->sectionViewportPosition(column) + 8;
    QTest::mouseClick(tree_->viewport(), Qt::LeftButton, {}, {x, rect.center().y()});
  }

  std::unique_ptr<LabelPalette> palette_;
  QTreeWidget* tree_ = nullptr;
};

}  // namespace episcope::in_label_palette_test

EPISCOPE_WINDOW_TEST(label_palette_test, LabelPaletteTest)
#include "label_palette_test.moc"
