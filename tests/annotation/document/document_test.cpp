// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/brush.h"
#include "engine/core/error.h"
#include "tests/annotation/random_edits.h"
#include "tests/test_main.h"

#include <algorithm>
#include <memory>
#include <set>
#include <thread>

namespace episcope::in_document_test {

using namespace episcope::test;

namespace {

constexpr GridShape kGrid{3, 4};
constexpr int kHeight = 40;
constexpr int kWidth = 50;
constexpr ViewIndex kView{1, 2};

AnnotationDocument document_with_labels(int count) {
  AnnotationDocument document(kGrid, kHeight, kWidth);
  for (int i = 0; i < count; ++i) document.add_label();
  return document;
}

void paint(AnnotationDocument& document, ViewIndex view, const PaintStyle& style, StrokePoint a,
           StrokePoint b) {
  Stroke stroke(document, view, style);
  stroke.extend(a);
  stroke.extend(b);
  stroke.commit();
}

struct Snapshot {
  LabelSet labels;
  ScribbleLayer scribbles;
  std::uint64_t state = 0;
};

Snapshot snapshot(const AnnotationDocument& document) {
  return {document.labels(), document.scribbles(), document.state()};
}

bool matches(const AnnotationDocument& document, const Snapshot& snapshot) {
  return document.labels() == snapshot.labels && document.scribbles() == snapshot.scribbles &&
         document.state() == snapshot.state;
}

}  // namespace

class DocumentTest : public QObject {
  Q_OBJECT

 private slots:
  void copiedLayer_sharesViewsUntilOneIsPainted() {
    AnnotationDocument document = document_with_labels(1);
    paint(document, kView, {}, {10, 10}, {20, 20});
    paint(document, {0, 0}, {}, {10, 10}, {20, 20});

    const ScribbleLayer before = document.scribbles();
    QCOMPARE(before.view(kView).data, document.scribbles().view(kView).data);
    paint(document, kView, {}, {30, 10}, {30, 20});

    QCOMPARE(before.label_at(kView, {30, 15}), 0);
    QCOMPARE(document.scribbles().label_at(kView, {30, 15}), 1);
    QCOMPARE(before.view({0, 0}).data, document.scribbles().view({0, 0}).data);
    const std::uint8_t* own = document.scribbles().view(kView).data;
    paint(document, kView, {}, {35, 10}, {35, 20});
    QCOMPARE(document.scribbles().view(kView).data, own);  // nobody else has it
  }

  void copiedLayer_isReadWhileTheOtherIsPainted() {
    AnnotationDocument document = document_with_labels(2);
    const auto count_of = [](const ScribbleLayer& layer) {
      const auto image = layer.view(kView);
      return std::count(image.data, image.data + image.size(), 1);
    };
    for (int round = 0; round < 200; ++round) {
      paint(document, kView, {}, {10, 10}, {20, 20});
      const auto expected = count_of(document.scribbles());
      auto copy = std::make_unique<ScribbleLayer>(document.scribbles());
      std::ptrdiff_t found = 0;
      std::jthread reader([&] {
        found = count_of(*copy);
        copy.reset();
      });
      paint(document, kView, {.label = 2}, {10, 10}, {20, 20});
      reader.join();
      QCOMPARE(found, expected);
    }
  }

  void labels_keepTheirIds() {
    LabelSet labels;
    QCOMPARE(labels.add("sky"), 1);
    QCOMPARE(labels.add(), 2);
    QCOMPARE(labels.add("tree"), 3);

    labels.remove(3);
    labels.remove(1);

    QCOMPARE(labels.find(2)->name, std::string("label 2"));
    QVERIFY(!labels.contains(1));
    QCOMPARE(labels.add(), 4);
  }

  void labels_reuseIdsOnlyWhenAllWereGiven() {
    LabelSet labels;
    for (int i = 1; i <= 255; ++i) QCOMPARE(labels.add(), i);
    QVERIFY_THROWS_EXCEPTION(InvalidInput, labels.add());

    labels.remove(77);

    QCOMPARE(labels.add(), 77);
  }

  void labels_getColoursThatDiffer() {
    LabelSet labels;
    labels.insert({9, "nine", label_color(1)});
    for (int i = 0; i < 200; ++i) labels.add();

    std::set<Rgb> colors;
    for (const LabelInfo& label : labels.labels()) colors.insert(label.color);

    QCOMPARE(colors.size(), std::size_t{201});
  }

  void renumberedLabel_isSoInAllViews_andUndone() {
    AnnotationDocument document = document_with_labels(2);
    paint(document, kView, {}, {5, 5}, {9, 9});
    paint(document, {0, 0}, {}, {5, 5}, {9, 9});
    const Snapshot before = snapshot(document);

    document.renumber_label(1, 7);

    QCOMPARE(document.labels().labels()[0].id, 7);  // in its place
    QCOMPARE(document.scribbles().label_at(kView, {5, 5}), 7);
    QCOMPARE(document.scribbles().label_at({0, 0}, {5, 5}), 7);
    document.undo();
    QVERIFY(matches(document, before));
  }

  void movedLabel_isInItsPlace() {
    LabelSet labels;
    for (int i = 0; i < 4; ++i) labels.add();
    const auto ids = [&labels] {
      std::vector<int> all;
      for (const LabelInfo& label : labels.labels()) all.push_back(label.id);
      return all;
    };

    labels.move(4, 1);
    QCOMPARE(ids(), (std::vector{1, 4, 2, 3}));
    labels.move(1, 2);
    QCOMPARE(ids(), (std::vector{4, 2, 1, 3}));
    labels.move(2, 9);
    QCOMPARE(ids(), (std::vector{4, 1, 3, 2}));
    labels.move(3, -1);
    QCOMPARE(ids(), (std::vector{3, 4, 1, 2}));
  }

  void badLabels_areRefused() {
    LabelSet labels;
    labels.insert({5, "five", {}});

    QVERIFY_THROWS_EXCEPTION(InvalidInput, labels.insert({5, "again", {}}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, labels.insert({0, "none", {}}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, labels.insert({256, "high", {}}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, labels.rename(5, ""));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, labels.rename(5, "two\nlines"));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, labels.rename(5, std::string(201, 'x')));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, labels.remove(6));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, labels.renumber(6, 7));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, labels.renumber(5, 5));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, labels.renumber(5, 256));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, labels.move(6, 0));
    QCOMPARE(labels.labels().size(), std::size_t{1});
  }

  void layer_takesMemoryForPaintedViewsOnly() {
    AnnotationDocument document = document_with_labels(1);
    QCOMPARE(document.scribbles().byte_size(), std::size_t{0});

    paint(document, kView, {}, {5, 5}, {9, 9});

    QCOMPARE(document.scribbles().byte_size(), std::size_t{kHeight * kWidth});
    QCOMPARE(document.scribbles().painted_views(), std::vector{kView});
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)document.scribbles().view({3, 0}));
    QCOMPARE(document.scribbles().label_at(kView, {5, 5}), 1);
    QCOMPARE(document.scribbles().label_at(kView, {-1, 5}), 0);
  }

  void stroke_returnsWhatMustBeRedrawn() {
    AnnotationDocument document = document_with_labels(1);
    Stroke stroke(document, kView, {PaintTool::Brush, 1, 4, false});

    QCOMPARE(stroke.extend({10, 10}), (PixelRect{8, 8, 12, 12}));
    QCOMPARE(stroke.extend({10, 14}), (PixelRect{8, 8, 12, 16}));
    QVERIFY(stroke.extend({-200, 14}).y0 == 0);
    QVERIFY(stroke.extend({-200, 30}).empty());
  }

  void stroke_isOneEdit() {
    AnnotationDocument document = document_with_labels(1);
    const Snapshot before = snapshot(document);
    {
      Stroke stroke(document, kView, {});
      for (int i = 0; i < 20; ++i) stroke.extend({10.0 + i, 5.0 + 2 * i});
      QVERIFY(stroke.commit());
    }

    const DocumentChange change = document.undo();

    QVERIFY(matches(document, before));
    QCOMPARE(change.views.size(), std::size_t{1});
    QCOMPARE(change.views[0].view, kView);
  }

  void uncommittedStroke_revertsItself() {
    AnnotationDocument document = document_with_labels(2);
    paint(document, kView, {}, {5, 5}, {30, 30});
    const Snapshot before = snapshot(document);
    {
      Stroke stroke(document, kView, {PaintTool::Brush, 2, 20, false});
      stroke.extend({5, 30});
      stroke.extend({30, 5});
      QVERIFY(!(document.scribbles() == before.scribbles));
    }

    QVERIFY(matches(document, before));
  }

  void editThatChangesNothing_vanishes() {
    AnnotationDocument document = document_with_labels(1);
    paint(document, kView, {}, {5, 5}, {30, 30});
    const Snapshot before = snapshot(document);

    paint(document, kView, {}, {5, 5}, {30, 30});
    paint(document, kView, {PaintTool::Eraser, 1, 3, false}, {38, 3}, {38, 9});
    document.rename_label(1, "label 1");
    document.recolor_label(1, label_color(1));

    QVERIFY(matches(document, before));
    QCOMPARE(document.history().count(), std::size_t{2});
  }

  void protectedLabels_areNotPaintedOver_data() {
    QTest::addColumn<bool>("is_eraser");
    QTest::addColumn<bool>("protects");
    QTest::addColumn<int>("bare");
    QTest::addColumn<int>("own");
    QTest::addColumn<int>("other");
    QTest::newRow("brush") << false << false << 1 << 1 << 1;
    QTest::newRow("brush, protecting") << false << true << 1 << 1 << 2;
    QTest::newRow("eraser") << true << false << 0 << 0 << 0;
    QTest::newRow("eraser, protecting") << true << true << 0 << 0 << 2;
  }
  void protectedLabels_areNotPaintedOver() {
    QFETCH(bool, is_eraser);
    QFETCH(bool, protects);
    AnnotationDocument document = document_with_labels(2);
    fill_region(document, kView, {{3, 10, 20}}, {PaintTool::Brush, 1, 1, false});
    fill_region(document, kView, {{3, 20, 30}}, {PaintTool::Brush, 2, 1, false});

    paint(document, kView, {is_eraser ? PaintTool::Eraser : PaintTool::Brush, 1, 3, protects},
          {3.5, 5}, {3.5, 28});

    QTEST(document.scribbles().label_at(kView, {3, 7}), "bare");
    QTEST(document.scribbles().label_at(kView, {3, 15}), "own");
    QTEST(document.scribbles().label_at(kView, {3, 25}), "other");
  }

  void lockedLabels_areNeitherPaintedNorPaintedOver() {
    AnnotationDocument document = document_with_labels(3);
    fill_region(document, kView, {{3, 10, 20}}, {PaintTool::Brush, 1});
    fill_region(document, kView, {{3, 20, 30}}, {PaintTool::Brush, 2});
    LabelIds locked;
    locked.set(2);
    const auto label_at = [&](int x) { return document.scribbles().label_at(kView, {3, x}); };
    const PixelRegion row{{3, 5, 35}};

    QVERIFY(!fill_region(document, kView, row, {PaintTool::Brush, 2, 1, false, locked}));
    QVERIFY(fill_region(document, kView, row, {PaintTool::Brush, 3, 1, false, locked},
                        EditKind::Polygon));
    QCOMPARE(document.history().next_undo()->kind, EditKind::Polygon);
    QCOMPARE(label_at(7), 3);
    QCOMPARE(label_at(15), 3);
    QCOMPARE(label_at(25), 2);
    QVERIFY(fill_region(document, kView, row, {PaintTool::Eraser, 3, 1, false, locked}));
    QCOMPARE(label_at(15), 0);
    QCOMPARE(label_at(25), 2);
    QVERIFY(!fill_region(document, kView, row, {PaintTool::Eraser, 2, 1, true, locked}));
  }

  void removedLabel_comesBackWithItsPixels() {
    AnnotationDocument document = document_with_labels(3);
    paint(document, kView, {PaintTool::Brush, 2, 5, false}, {5, 5}, {20, 20});
    paint(document, {0, 0}, {PaintTool::Brush, 2, 5, false}, {5, 5}, {20, 20});
    paint(document, {0, 0}, {PaintTool::Brush, 3, 5, false}, {30, 5}, {30, 20});
    const Snapshot before = snapshot(document);

    document.remove_label(2);

    QCOMPARE(document.scribbles().painted_views(), std::vector{(ViewIndex{0, 0})});
    QCOMPARE(document.labels().labels().size(), std::size_t{2});

    const DocumentChange change = document.undo();

    QVERIFY(matches(document, before));
    QVERIFY(change.has_new_labels);
    QCOMPARE(change.views.size(), std::size_t{2});
  }

  void mergedLabel_isTakenOverOnAllViews() {
    AnnotationDocument document = document_with_labels(3);
    paint(document, kView, {PaintTool::Brush, 2, 5, false}, {5, 5}, {20, 20});
    paint(document, {0, 0}, {PaintTool::Brush, 2, 5, false}, {5, 5}, {20, 20});
    const Snapshot before = snapshot(document);

    document.merge_label(2, 3);

    QCOMPARE(document.scribbles().label_at(kView, {10, 10}), 3);
    QCOMPARE(document.scribbles().label_at({0, 0}, {10, 10}), 3);
    QVERIFY(!document.labels().contains(2));
    document.undo();
    QVERIFY(matches(document, before));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, document.merge_label(2, 9));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, document.merge_label(2, 2));
  }

  void randomEdits_undoAndRedoToTheSameStates() {
    AnnotationDocument document(kGrid, kHeight, kWidth);
    RandomEdits edits(11);
    std::vector<Snapshot> states{snapshot(document)};
    while (states.size() < 150) {
      edits.make_one(document);
      if (document.history().count() == states.size()) states.push_back(snapshot(document));
    }

    for (std::size_t i = states.size(); i-- > 1;) {
      QVERIFY(matches(document, states[i]));
      document.undo();
    }
    QVERIFY(matches(document, states[0]));
    QVERIFY(document.undo().empty());
    for (const Snapshot& state : states) {
      QVERIFY(matches(document, state));
      document.redo();
    }
    QVERIFY(document.redo().empty());
  }

  void recordedEdits_makeTheSameDocument() {
    AnnotationDocument document(kGrid, kHeight, kWidth);
    AnnotationDocument copy(kGrid, kHeight, kWidth);
    document.set_observer([&](const DocumentEvent& event) {
      if (event.step == DocumentStep::Edited) copy.apply(*event.edit);
      if (event.step == DocumentStep::Undone) copy.undo();
      if (event.step == DocumentStep::Redone) copy.redo();
      if (event.step == DocumentStep::Saved) copy.mark_saved();
    });
    RandomEdits edits(5);

    for (int i = 0; i < 300; ++i) edits.step(document);

    QVERIFY(matches(copy, snapshot(document)));
    QCOMPARE(copy.has_unsaved_changes(), document.has_unsaved_changes());
    QCOMPARE(copy.history().count(), document.history().count());
  }

  void history_staysWithinItsBound() {
    constexpr std::size_t bound = 20000;
    AnnotationDocument document(kGrid, kHeight, kWidth, bound);
    RandomEdits edits(3);
    for (int i = 0; i < 400; ++i) {
      edits.make_one(document);
      QVERIFY(document.history().byte_size() <= bound);
    }
    const Snapshot last = snapshot(document);

    QVERIFY(document.history().count() > 5);
    while (document.history().next_undo()) document.undo();
    QVERIFY(document.state() != 0);  // what was forgotten is not the state of the beginning
    while (document.history().next_redo()) document.redo();
    QVERIFY(matches(document, last));
  }

  void longDiagonalStroke_takesLittleMemory() {
    AnnotationDocument document({1, 1}, 2048, 2048);
    document.add_label();
    paint(document, {0, 0}, {PaintTool::Brush, 1, 20, false}, {5, 5}, {2040, 2040});

    // A rectangle with mask, old and new labels would take 8.5 MB.
    QVERIFY(document.history().byte_size() < 40000);
  }

  void unsavedChanges_followUndoAndRedo() {
    AnnotationDocument document = document_with_labels(1);
    QVERIFY(document.has_unsaved_changes());
    document.mark_saved();
    QVERIFY(!document.has_unsaved_changes());

    paint(document, kView, {}, {5, 5}, {9, 9});
    QVERIFY(document.has_unsaved_changes());
    document.undo();
    QVERIFY(!document.has_unsaved_changes());
    document.redo();
    QVERIFY(document.has_unsaved_changes());
    document.undo();
    paint(document, kView, {}, {5, 5}, {9, 9});
    QVERIFY(document.has_unsaved_changes());
  }

  void erasedStroke_isNoChange() {
    AnnotationDocument document = document_with_labels(1);
    document.mark_saved();

    paint(document, kView, {}, {5, 5}, {9, 9});
    paint(document, kView, {PaintTool::Eraser}, {5, 5}, {9, 9});

    QVERIFY(!document.has_unsaved_changes());
  }

  void otherSteps_areRefusedDuringAStroke() {
    AnnotationDocument document = document_with_labels(1);
    Stroke stroke(document, kView, {});
    stroke.extend({3, 3});

    QVERIFY_THROWS_EXCEPTION(InvalidInput, document.undo());
    QVERIFY_THROWS_EXCEPTION(InvalidInput, document.add_label());
    QVERIFY_THROWS_EXCEPTION(InvalidInput, Stroke(document, kView, {}));
    QVERIFY(stroke.commit());
    QVERIFY(!document.undo().empty());
  }

  void badStrokes_areRefused() {
    AnnotationDocument document = document_with_labels(1);

    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             Stroke(document, kView, {PaintTool::Brush, 2, 5, false}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             Stroke(document, kView, {PaintTool::Brush, 0, 5, false}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             Stroke(document, kView, {PaintTool::Brush, 1, 500, false}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, Stroke(document, {3, 0}, {}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, AnnotationDocument({0, 3}, 5, 5));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, AnnotationDocument({1, 1}, 5, 70000));
    Edit outside{EditKind::Paint, {{kView, {0, 0, 1, 90}, {{0, 0, 90, 0, 1}}}}, {}};
    QVERIFY_THROWS_EXCEPTION(InvalidInput, document.apply(outside));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, document.remove_label(9));
    QVERIFY(!document.undo().empty());  // nothing is left half open
  }
};

}  // namespace episcope::in_document_test

EPISCOPE_TEST(document_test, DocumentTest)
#include "document_test.moc"
