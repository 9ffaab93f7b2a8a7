// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/brush.h"
#include "annotation/exchange.h"
#include "engine/core/error.h"
#include "tests/annotation/random_edits.h"
#include "tests/test_main.h"

namespace episcope::in_exchange_test {

class ExchangeTest : public QObject {
  Q_OBJECT

 private slots:
  void documents_comeBack() {
    AnnotationDocument document({3, 2}, 30, 40);
    test::RandomEdits edits(6);
    for (int i = 0; i < 60; ++i) edits.make_one(document);

    const AnnotationDocument copy = document_from(scribbles_of(document), {3, 2}, 30, 40);

    QVERIFY(copy.scribbles() == document.scribbles());
    QVERIFY(copy.labels().labels() == document.labels().labels());
    QVERIFY(!copy.has_unsaved_changes());
    QVERIFY(!copy.history().next_undo());
  }

  void idsWithoutNames_getDefaults() {
    Scribbles scribbles;
    scribbles.views.push_back({{0, 1}, Image<std::int32_t>(4, 5)});
    scribbles.views[0].labels.at(2, 3) = 7;
    scribbles.labels = {{2, "known", {9, 9, 9}}};

    const AnnotationDocument document = document_from(scribbles, {1, 2}, 4, 5);

    QVERIFY(document.labels().labels() ==
            (std::vector<LabelInfo>{{2, "known", {9, 9, 9}}, {7, "label 7", label_color(7)}}));
    QCOMPARE(document.scribbles().label_at({0, 1}, {2, 3}), 7);
  }

  void import_addsWhatIsMissing() {
    AnnotationDocument document({1, 2}, 4, 5);
    document.add_label("mine", Rgb{1, 2, 3});
    Stroke stroke(document, {0, 1}, {PaintTool::Brush, 1, 1, false});
    stroke.extend({0.5, 0.5});
    stroke.commit();
    Scribbles scribbles;
    scribbles.views.push_back({{0, 1}, Image<std::int32_t>(4, 5, 1, 2)});
    scribbles.labels = {{1, "theirs", {9, 9, 9}}, {2, "new", {8, 8, 8}}};
    const std::size_t edits = document.history().count();

    QVERIFY(import_scribbles(document, scribbles));

    QCOMPARE(document.scribbles().label_at({0, 1}, {0, 0}), 1);
    QCOMPARE(document.scribbles().label_at({0, 1}, {3, 4}), 2);
    QVERIFY(document.labels().labels() ==
            (std::vector<LabelInfo>{{1, "mine", {1, 2, 3}}, {2, "new", {8, 8, 8}}}));
    QCOMPARE(document.history().count(), edits + 1);
    QVERIFY(!import_scribbles(document, scribbles));
    document.undo();
    QCOMPARE(document.scribbles().label_at({0, 1}, {3, 4}), 0);
    QVERIFY(!document.labels().contains(2));
  }

  void misfits_areRefused() {
    Scribbles scribbles;
    scribbles.views.push_back({{0, 0}, Image<std::int32_t>(4, 5)});

    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)document_from(scribbles, {1, 1}, 5, 5));
    scribbles.views[0].labels.at(0, 0) = 256;
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)document_from(scribbles, {1, 1}, 4, 5));
    scribbles.views[0].view = {1, 0};
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)document_from(scribbles, {1, 1}, 4, 5));
  }
};

}  // namespace episcope::in_exchange_test

EPISCOPE_TEST(exchange_test, ExchangeTest)
#include "exchange_test.moc"
