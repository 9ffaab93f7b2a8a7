// SPDX-License-Identifier: BSD-3-Clause
// The history, on a document that has nothing to do with labels: pairs of points.
#include "annotation/document.h"
#include "tests/test_main.h"

#include <utility>
#include <vector>

namespace episcope::in_history_test {

namespace {

struct PointPair {
  double here = 0;
  double there = 0;
  friend bool operator==(const PointPair&, const PointPair&) = default;
};

/// One pair that was added or removed.
struct PairEdit {
  PointPair pair;
  bool is_added = true;
  [[nodiscard]] std::size_t byte_size() const { return sizeof(PairEdit); }
};

/// A document as a gantry has one.
class Pairs {
 public:
  explicit Pairs(std::size_t max_bytes) : history_(max_bytes) {}

  void add(PointPair pair) {
    pairs_.push_back(pair);
    history_.push({pair, true});
  }
  void removeLast() {
    history_.push({pairs_.back(), false});
    pairs_.pop_back();
  }
  bool undo() {
    const PairEdit* edit = history_.next_undo();
    if (!edit) return false;
    apply(*edit, !edit->is_added);
    history_.undo();
    return true;
  }
  bool redo() {
    const PairEdit* edit = history_.next_redo();
    if (!edit) return false;
    apply(*edit, edit->is_added);
    history_.redo();
    return true;
  }
  [[nodiscard]] const std::vector<PointPair>& pairs() const { return pairs_; }
  [[nodiscard]] const History<PairEdit>& history() const { return history_; }

 private:
  void apply(const PairEdit& edit, bool adds) {
    if (adds) {
      pairs_.push_back(edit.pair);
    } else {
      pairs_.pop_back();
    }
  }
  std::vector<PointPair> pairs_;
  History<PairEdit> history_;
};

constexpr std::size_t kPlenty = 1000 * sizeof(PairEdit);

}  // namespace

class HistoryTest : public QObject {
  Q_OBJECT

 private slots:
  void undoAndRedo_goToAndFro();
  void state_isTheSameWheneverTheDocumentIs();
  void newEdit_forgetsWhatWasUndone();
  void bound_forgetsTheOldest();
  void editBeyondTheBound_cannotBeUndone();
};

void HistoryTest::undoAndRedo_goToAndFro() {
  Pairs document(kPlenty);
  document.add({1, 2});
  document.add({3, 4});
  document.removeLast();
  const auto after = document.pairs();

  QVERIFY(document.undo());
  QCOMPARE(document.pairs().size(), 2U);
  QVERIFY(document.undo() && document.undo());
  QVERIFY(document.pairs().empty() && !document.undo());
  while (document.redo()) {
  }
  QVERIFY(document.pairs() == after);
}

void HistoryTest::state_isTheSameWheneverTheDocumentIs() {
  Pairs document(kPlenty);
  const auto empty = document.history().state();
  document.add({1, 2});
  const auto one = document.history().state();
  document.add({3, 4});
  QVERIFY(document.history().state() != one && one != empty);

  document.undo();
  QCOMPARE(document.history().state(), one);
  document.add({5, 6});  // not the state that {3, 4} led to
  QVERIFY(document.history().state() != one);
  document.undo();
  document.undo();
  QCOMPARE(document.history().state(), empty);
}

void HistoryTest::newEdit_forgetsWhatWasUndone() {
  Pairs document(kPlenty);
  document.add({1, 2});
  document.undo();
  document.add({3, 4});

  QVERIFY(!document.redo());
  QCOMPARE(document.history().count(), 1U);
}

void HistoryTest::bound_forgetsTheOldest() {
  Pairs document(3 * sizeof(PairEdit));
  for (int i = 0; i < 5; ++i) document.add({i + 0.0, 0});

  QCOMPARE(document.history().count(), 3U);
  QVERIFY(document.history().byte_size() <= document.history().max_bytes());
  while (document.undo()) {
  }
  QCOMPARE(document.pairs().size(), 2U);
}

void HistoryTest::editBeyondTheBound_cannotBeUndone() {
  Pairs document(sizeof(PairEdit) - 1);
  document.add({1, 2});

  QVERIFY(!document.undo());
  QCOMPARE(document.pairs().size(), 1U);
}

}  // namespace episcope::in_history_test

EPISCOPE_TEST(history_test, HistoryTest)
#include "history_test.moc"
