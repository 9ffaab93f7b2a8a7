// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/result_draft.h"
#include "engine/core/error.h"
#include "engine/io/models/result_file.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <cmath>
#include <fstream>
#include <memory>

namespace episcope::in_result_draft_test {

using io::ResultDraft;

namespace {

const MapGeometry kMaps{{2, 3}, {}, 5, 4};

float value_at(ViewIndex view, int y, int x) {
  return static_cast<float>(100 * view.v + 10 * view.u + y) + 0.1F * static_cast<float>(x);
}

// A block of `value_at` plus something; with a mask, the pixels of column 1 are not valid.
BlockMaps block_of(const MapBlock& block, float more = 0, bool has_mask = false) {
  const ViewRectangle& views = block.views;
  BlockMaps maps{{{views.grid, block.rows(), kMaps.width, 1, views.first}, {}},
                 {views.grid, block.rows(), kMaps.width, 1, views.first}};
  if (has_mask) maps.field.valid = {views.grid, block.rows(), kMaps.width, 1, views.first};
  for (int i = 0; i < views.grid.count(); ++i) {
    const ViewIndex view = views.grid.view_at(i, views.first);
    for (int y = 0; y < block.rows(); ++y) {
      for (int x = 0; x < kMaps.width; ++x) {
        const float value = value_at(view, block.first_row + y, x) + more;
        maps.field.disparity.view(view).at(y, x) = value;
        maps.confidence.view(view).at(y, x) = -value;
        if (has_mask) maps.field.valid.view(view).at(y, x) = x == 1 ? 0 : 1;
      }
    }
  }
  return maps;
}

MapBlock rows(int first, int end) {
  return {{{}, kMaps.grid}, first, end};
}

const MapBlock kView{{{1, 2}, {1, 1}}, 0, 5};

}  // namespace

class ResultDraftTest : public QObject {
  Q_OBJECT

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }
  void completedDraft_isTheResultFile();
  void maskedPixels_areNotValid();
  void whatWasWritten_isFoundAgain();
  void secondDisparity_isFoundAgain();
  void draftOfAnotherRun_isReplaced();
  void replacement_endedBeforeItIsNoted_isRepeated();
  void endWhileItIsCompleted_isUndone();
  void draftThatIsBeingWritten_isRefused();
  void missingFolder_isRefusedAndNothingIsLeft();

 private:
  [[nodiscard]] std::filesystem::path path(const char* name = "r.h5") const {
    return std::filesystem::path(folder_->path().toStdString()) / name;
  }
  [[nodiscard]] ResultDraft draft(const std::string& identity = "a run", bool has_valid = false) {
    return {path(), {kMaps, has_valid}, identity};
  }

  std::unique_ptr<QTemporaryDir> folder_;
};

void ResultDraftTest::completedDraft_isTheResultFile() {
  Provenance provenance;
  provenance.method = "epi_l";
  provenance.range = {-1.5, 2};
  provenance.notes = {"one", "two"};
  provenance.camera = {.baseline = 2.5, .focal_length = 4, .shift = 1};
  ResultDraft made = draft();
  made.write(rows(0, 3), block_of(rows(0, 3)), {.done = 3}, false);
  made.write(rows(3, 5), block_of(rows(3, 5)), {.done = 5}, false);

  made.commit(provenance, "lf.h5");

  const Estimate read = io::read_result(path(), kMaps.grid);
  QVERIFY(read.method == "epi_l" && read.source == "lf.h5" && read.notes == provenance.notes);
  QVERIFY(read.range == provenance.range);
  QCOMPARE(read.camera.depth_from_disparity(1), 5.0);
  const io::Hdf5Input file(path());
  QVERIFY(file.has_attribute("estimate/confidence", "DIMENSION_LIST"));
  QCOMPARE(*file.text("estimate/confidence", "units"), std::string("1"));
  QVERIFY(file.text("estimate/disparity", "long_name").has_value());
  QCOMPARE(read.field.disparity.view({1, 2}).at(4, 3), value_at({1, 2}, 4, 3));
  QCOMPARE(read.confidence.view({0, 1}).at(2, 0), -value_at({0, 1}, 2, 0));
  QCOMPARE(std::distance(std::filesystem::directory_iterator(path().parent_path()), {}), 1);
}

void ResultDraftTest::maskedPixels_areNotValid() {
  ResultDraft made = draft("a run", true);
  made.write(rows(0, 5), block_of(rows(0, 5), 0, true), {.done = 5}, false);

  made.commit({}, "lf.h5");

  const Estimate read = io::read_result(path(), kMaps.grid);
  QCOMPARE(read.field.valid.view({0, 0}).at(2, 1), std::uint8_t{0});
  QCOMPARE(read.field.valid.view({0, 0}).at(2, 2), std::uint8_t{1});
}

void ResultDraftTest::whatWasWritten_isFoundAgain() {
  const BlockProgress after{
      .pass = 1, .done = 3, .facts = {0.1, 1e-17}, .finding = 1.0 / 3, .seconds = 2.5};
  {
    ResultDraft left = draft();
    QVERIFY(left.found() == ResultDraft::Found::Nothing);
    left.write(rows(0, 3), block_of(rows(0, 3)), after, false);
  }

  const ResultDraft found = draft();

  QVERIFY(found.found() == ResultDraft::Found::Same);
  QVERIFY(found.progress() == after);
  const BlockMaps maps = found.read({{{1, 0}, {1, 2}}, 1, 3});
  QCOMPARE(maps.field.disparity.view({1, 1}).at(0, 3), value_at({1, 1}, 1, 3));
  QCOMPARE(maps.confidence.view({1, 0}).at(1, 0), -value_at({1, 0}, 2, 0));
}

void ResultDraftTest::secondDisparity_isFoundAgain() {
  const io::DraftShape shape{.maps = kMaps, .has_valid = true, .has_second = true};
  BlockMaps maps = block_of(rows(0, 5), 0, true);
  maps.second = block_of(rows(0, 5), 5000, true).field;
  { ResultDraft(path(), shape, "a run").write(rows(0, 5), maps, {.done = 5}, false); }

  ResultDraft found(path(), shape, "a run");

  QCOMPARE(found.read({{{1, 1}, {1, 2}}, 2, 4}).second.disparity.view({1, 2}).at(1, 0),
           value_at({1, 2}, 3, 0) + 5000);
  found.commit({}, "lf.h5");
  const Estimate read = io::read_result(path(), kMaps.grid);
  QCOMPARE(read.second.disparity.view({1, 2}).at(4, 3), value_at({1, 2}, 4, 3) + 5000);
  QCOMPARE(read.second.valid.view({1, 2}).at(4, 1), std::uint8_t{0});
}

void ResultDraftTest::draftOfAnotherRun_isReplaced() {
  { draft("a run").note({.done = 3}); }

  const ResultDraft other = draft("another run");

  QVERIFY(other.found() == ResultDraft::Found::Other);
  QVERIFY(other.progress() == BlockProgress{});
}

void ResultDraftTest::replacement_endedBeforeItIsNoted_isRepeated() {
  {
    ResultDraft left = draft();
    left.write(rows(0, 5), block_of(rows(0, 5)), {.pass = 0, .done = 5}, false);
    left.write(kView, block_of(kView, 1000), {.pass = 1, .done = 6}, true);
  }
  // As if the program had ended when half of the view was in its place: the last record is missing,
  // and what it would have vouched for is damaged.
  const std::filesystem::path log = path("r.h5.partial.log");
  std::string text;
  for (std::ifstream file(log); file.peek() != EOF;) text += static_cast<char>(file.get());
  text.resize(text.rfind('\n', text.size() - 2) + 1);
  std::ofstream(log, std::ios::trunc) << text;
  io::DraftFile(path("r.h5.partial"), {kMaps, false}, path()).write(kView, block_of(kView, -7));

  const ResultDraft found = draft();

  QVERIFY(found.progress() == (BlockProgress{.pass = 1, .done = 6}));
  QCOMPARE(found.read(kView).field.disparity.view({1, 2}).at(4, 1), value_at({1, 2}, 4, 1) + 1000);
}

void ResultDraftTest::endWhileItIsCompleted_isUndone() {
  {
    ResultDraft left = draft();
    left.write(rows(0, 5), block_of(rows(0, 5)), {.done = 5}, false);
  }
  {
    // The structure of the file is half rewritten, and it has grown.
    std::fstream file(path("r.h5.partial"), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(8) << std::string(80, 'x');
    file.seekp(0, std::ios::end) << std::string(1000, 'y');
  }

  draft().commit({}, "lf.h5");

  QCOMPARE(io::read_result(path(), kMaps.grid).field.disparity.view({1, 2}).at(4, 3),
           value_at({1, 2}, 4, 3));
}

void ResultDraftTest::draftThatIsBeingWritten_isRefused() {
  const ResultDraft first = draft();

  QVERIFY_THROWS_EXCEPTION(IoError, static_cast<void>(draft()));
}

void ResultDraftTest::missingFolder_isRefusedAndNothingIsLeft() {
  QVERIFY_THROWS_EXCEPTION(IoError, ResultDraft(path("none") / "r.h5", {kMaps, false}, "a run"));
  QVERIFY(std::filesystem::is_empty(path().parent_path()));
}

}  // namespace episcope::in_result_draft_test

EPISCOPE_TEST(result_draft_test, ResultDraftTest)
#include "result_draft_test.moc"
