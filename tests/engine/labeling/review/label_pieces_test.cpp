// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/label_review.h"

#include "tests/engine/labeling/review/drawn_labels.h"
#include "tests/test_main.h"

namespace episcope::in_label_pieces_test {

class LabelPiecesTest : public QObject {
  Q_OBJECT

 private slots:
  void partsAndHoles_areFound_theLargestFirst();
  void pixelsThatTouchAtACorner_areTwoIslands_butOneHole();
  void whatReachesTheBorder_isNoHole();
  void aLabelThatNobodyHas_hasNoPieces();
  void inside_liesDeepest_evenInARing();
};

void LabelPiecesTest::partsAndHoles_areFound_theLargestFirst() {
  const auto labels = test::labels_from({"1111112222",  //
                                         "1131112222",  //
                                         "1111112212",  //
                                         "1144112222",  //
                                         "1143111112",  //
                                         "1111112222"});

  const auto pieces = pieces_of(labels, 1);

  QCOMPARE(pieces.size(), std::size_t{4});
  QCOMPARE(pieces[0].kind, PieceKind::Main);
  QCOMPARE(pieces[0].blob.pixels, 34);
  QCOMPARE(pieces[1].kind, PieceKind::Hole);
  QCOMPARE(pieces[1].label, 4);  // of three of its four pixels
  QCOMPARE(pieces[1].blob.pixels, 4);
  QVERIFY((pieces[1].blob.bounds == PixelRect{3, 2, 5, 4}));
  QCOMPARE(pieces[2].kind, PieceKind::Island);
  QCOMPARE(pieces[2].label, 1);
  QVERIFY((pieces[2].blob.inside == PixelIndex{2, 8}));
  QVERIFY((pieces[3].blob.inside == PixelIndex{1, 2}));
  QVERIFY(pieces[1].blob.contains({4, 3}));
  QVERIFY(!pieces[1].blob.contains({5, 3}));
}

void LabelPiecesTest::pixelsThatTouchAtACorner_areTwoIslands_butOneHole() {
  const auto labels = test::labels_from({"11111",  //
                                         "12111",  //
                                         "11211",  //
                                         "11111"});

  QCOMPARE(pieces_of(labels, 1).size(), std::size_t{2});
  QCOMPARE(pieces_of(labels, 1)[1].blob.pixels, 2);
  const auto of_two = pieces_of(labels, 2);
  QCOMPARE(of_two.size(), std::size_t{2});
  QCOMPARE(of_two[0].kind, PieceKind::Main);
  QCOMPARE(of_two[1].kind, PieceKind::Island);
}

void LabelPiecesTest::whatReachesTheBorder_isNoHole() {
  const auto labels = test::labels_from({"1121",  //
                                         "1121",  //
                                         "1111"});

  QCOMPARE(pieces_of(labels, 1).size(), std::size_t{1});
}

void LabelPiecesTest::aLabelThatNobodyHas_hasNoPieces() {
  QVERIFY(pieces_of(test::labels_from({"11", "12"}), 7).empty());
}

void LabelPiecesTest::inside_liesDeepest_evenInARing() {
  Image<std::int32_t> labels(40, 40, 1, 2);
  for (int y = 5; y < 35; ++y) {
    for (int x = 5; x < 35; ++x) labels.at(y, x) = (y >= 10 && y < 20 && x >= 10 && x < 30) ? 2 : 1;
  }

  const auto pieces = pieces_of(labels, 1);

  const PixelIndex inside = pieces[0].blob.inside;
  QCOMPARE(labels.at(inside.y, inside.x), 1);
  QVERIFY(inside.y >= 25 && inside.y < 30);  // in the middle of the thickest side
  QCOMPARE(pieces[1].kind, PieceKind::Hole);
  QCOMPARE(pieces[1].blob.pixels, 200);
}

}  // namespace episcope::in_label_pieces_test

EPISCOPE_TEST(label_pieces_test, LabelPiecesTest)
#include "label_pieces_test.moc"
