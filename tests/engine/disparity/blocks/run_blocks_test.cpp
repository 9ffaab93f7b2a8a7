// SPDX-License-Identifier: BSD-3-Clause
// An estimate that is made in blocks equals the one that is made at once bit by bit, however it is
// cut and wherever it was interrupted: data-driven over the methods that can.
#include "engine/disparity/estimator.h"

#include "engine/core/error.h"
#include "engine/disparity/registry.h"
#include "engine/scenes/builtin.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace episcope::in_run_blocks_test {

using namespace episcope::test;

namespace {

struct Ended {};

template <class T>
ViewStack<T> stack_of(const MapGeometry& maps, T value) {
  ViewStack<T> stack(maps.grid, maps.height, maps.width, 1, maps.first);
  std::fill_n(stack.data(), stack.size(), value);
  return stack;
}

// From rows of a stack on to those of another, as many as the block has.
template <class T>
void copy(const ViewStack<T>& from, const MapBlock& block, int from_row, ViewStack<T>& to,
          int to_row) {
  for (int i = 0; i < block.views.grid.count(); ++i) {
    const ViewIndex view = block.views.grid.view_at(i, block.views.first);
    for (int y = 0; y < block.rows(); ++y) {
      std::copy_n(from.view(view).row(from_row + y), from.width(), to.view(view).row(to_row + y));
    }
  }
}

// A disparity with its mask, as files have it: what a former pass marked as not valid is lost.
class StoredField {
 public:
  explicit StoredField(const MapGeometry& maps)
      : disparity_(stack_of(maps, 0.0F)), valid_(stack_of(maps, std::uint8_t{1})) {}

  void write(const MapBlock& block, const DisparityField& field) {
    copy(field.disparity, block, 0, disparity_, block.first_row);
    if (!field.valid.empty()) copy(field.valid, block, 0, valid_, block.first_row);
  }
  [[nodiscard]] DisparityField read(const MapBlock& block) const {
    const MapGeometry of_block{block.views.grid, block.views.first, block.rows(),
                               disparity_.width()};
    ViewStack<float> disparity = stack_of(of_block, 0.0F);
    ViewStack<std::uint8_t> valid = stack_of(of_block, std::uint8_t{0});
    copy(disparity_, block, block.first_row, disparity, 0);
    copy(valid_, block, block.first_row, valid, 0);
    for (std::size_t i = 0; i < valid.size(); ++i) {
      if (valid.data()[i] == 0) disparity.data()[i] = std::numeric_limits<float>::quiet_NaN();
    }
    return {std::move(disparity), {}};
  }
  [[nodiscard]] bool equals(const DisparityField& field) const {
    const std::uint8_t* const valid = valid_.data();
    const bool same_mask = field.valid.empty()
                               ? std::count(valid, valid + valid_.size(), 0) == 0
                               : std::memcmp(valid, field.valid.data(), valid_.size()) == 0;
    return same_mask && same_bytes(disparity_, field.disparity);
  }

 private:
  ViewStack<float> disparity_;
  ViewStack<std::uint8_t> valid_;
};

// Keeps maps in memory; ends the program, as it were, before the write that exceeds `writes`.
class MemoryStore : public BlockStore {
 public:
  explicit MemoryStore(const BlockwiseRun& run)
      : has_second_(run.has_second),
        field_(run.maps),
        second_(run.maps),
        confidence_(stack_of(run.maps, 0.0F)) {}

  int writes = 1 << 20;
  int blocks = 0;

  [[nodiscard]] BlockProgress progress() const override { return progress_; }
  [[nodiscard]] BlockMaps read(const MapBlock& block) const override {
    return {field_.read(block), of_block(confidence_, block)};
  }
  void note(const BlockProgress& after) override { progress_ = after; }
  void write(const MapBlock& block, const BlockMaps& maps, const BlockProgress& after,
             bool) override {
    if (writes-- == 0) throw Ended();
    ++blocks;
    field_.write(block, maps.field);
    copy(maps.confidence, block, 0, confidence_, block.first_row);
    if (has_second_) second_.write(block, maps.second);
    note(after);
  }

  [[nodiscard]] bool equals(const Estimate& estimate) const {
    if (has_second_ != !estimate.second.empty()) return false;
    return estimate.layered.layers.empty() && (!has_second_ || second_.equals(estimate.second)) &&
           field_.equals(estimate.field) && same_bytes(confidence_, estimate.confidence);
  }

 private:
  template <class T>
  static ViewStack<T> of_block(const ViewStack<T>& stack, const MapBlock& block) {
    ViewStack<T> part =
        stack_of({block.views.grid, block.views.first, block.rows(), stack.width()}, T{});
    copy(stack, block, block.first_row, part, 0);
    return part;
  }

  bool has_second_;
  StoredField field_, second_;
  ViewStack<float> confidence_;
  BlockProgress progress_;
};

// Awkward sizes: no multiple of a vector, of a band or of a block.
Scene scene_of(GridShape grid) {
  return render("edge", 83, 71, grid);
}

LightField with_holes(const LightField& lf) {
  ViewStack<std::uint8_t> valid(lf.grid(), lf.height(), lf.width());
  for (int i = 0; i < lf.grid().count(); ++i) {
    const auto view = valid.view(lf.grid().view_at(i));
    for (std::size_t n = 0; n < view.size(); ++n) view.data[n] = (n + i) % 97 == 0 ? 0 : 1;
  }
  return {std::get<ViewStack<std::uint8_t>>(lf.samples()).clone(), lf.info(), std::move(valid)};
}

BlockMemory exactly(std::size_t bytes) {
  return {bytes, bytes};
}

// So much that bands have few rows.
std::size_t scarce(const BlockwiseRun& run, int rows) {
  double bytes = 0;
  for (const BlockPass& pass : run.passes) {
    bytes = std::max(bytes, pass.bytes(pass.unit == BlockUnit::Rows ? rows : 1));
  }
  return static_cast<std::size_t>(bytes) + 1;
}

// Those that have a parameter, if one is named.
void add_methods(const std::string& parameter = "") {
  QTest::addColumn<QString>("id");
  for (const Estimator& estimator : registered_estimators()) {
    const bool has_it = parameter.empty() ||
                        std::ranges::any_of(estimator.parameters, [&](const auto& description) {
                          return description.key == parameter;
                        });
    if (!estimator.can_run_in_blocks() || !has_it) continue;
    QTest::newRow(estimator.info.id.c_str()) << estimator.info.id.c_str();
  }
}

Estimator fetched() {
  QFETCH(QString, id);
  return find_estimator(id.toStdString());
}

// Whether the method gives the same in blocks as at once.
bool agrees(const LightField& lf, const Estimator& method, const ParameterSet& values,
            ViewSelection views, int rows) {
  const RunOptions options{.views = views, .threads = 2};
  const Estimate at_once = method.run(lf, values, options, Progress(2));
  const BlockwiseRun run = method.in_blocks(lf, values, options, Progress(2));
  MemoryStore store(run);
  const Provenance made = run_blocks(lf, run, store, exactly(scarce(run, rows)), Progress(2));
  return store.equals(at_once) && made.notes == at_once.notes && made.range == at_once.range &&
         made.parameters == at_once.parameters && made.method == at_once.method;
}

}  // namespace

class RunBlocksTest : public QObject {
  Q_OBJECT

 private slots:
  void localMethodsAndMethodsByViews_runInBlocks();
  void blocks_equalTheRunAtOnce_data() { add_methods(); }
  void blocks_equalTheRunAtOnce();
  void centerOnly_equalsTheRunAtOnce_data() { add_methods(); }
  void centerOnly_equalsTheRunAtOnce();
  void profileOfThePaper_equalsTheRunAtOnce_data() { add_methods("profile"); }
  void profileOfThePaper_equalsTheRunAtOnce();
  void viewsCarriedFromOne_equalTheRunAtOnce();
  void invalidPixels_areMarkedAlike_data() { add_methods(); }
  void invalidPixels_areMarkedAlike();
  void singleRowOrColumnOfViews_equalsTheRunAtOnce_data() { add_methods(); }
  void singleRowOrColumnOfViews_equalsTheRunAtOnce();
  void interruption_losesNothing_data() { add_methods(); }
  void interruption_losesNothing();
  void unevenViews_equalTheRunAtOnce_data() { add_methods(); }
  void unevenViews_equalTheRunAtOnce();
  void lessThanTheSmallestBlock_isRefused_data() { add_methods(); }
  void lessThanTheSmallestBlock_isRefused();
  void lessThanALaterPassNeeds_isRefusedAtOnce();
  void smallestBlocks_mayTakeMoreThanIsWanted();
};

void RunBlocksTest::localMethodsAndMethodsByViews_runInBlocks() {
  for (const char* id : {"epi_l", "epi_s", "plane_pm", "net"}) {
    QVERIFY2(find_estimator(id).can_run_in_blocks(), id);
  }
}

void RunBlocksTest::blocks_equalTheRunAtOnce() {
  const Scene scene = scene_of({6, 7});

  for (const int rows : {8, 9, 23, 82, 83}) {
    QVERIFY2(agrees(*scene.light_field, fetched(), {}, ViewSelection::All, rows),
             std::to_string(rows).c_str());
  }
}

void RunBlocksTest::centerOnly_equalsTheRunAtOnce() {
  const Scene scene = scene_of({5, 5});

  QVERIFY(agrees(*scene.light_field, fetched(), {}, ViewSelection::Center, 11));
}

void RunBlocksTest::profileOfThePaper_equalsTheRunAtOnce() {
  const Scene scene = scene_of({5, 5});

  QVERIFY(agrees(*scene.light_field, fetched(), {{"profile", std::string("paper")}},
                 ViewSelection::All, 10));
}

void RunBlocksTest::viewsCarriedFromOne_equalTheRunAtOnce() {
  const Scene scene = scene_of({5, 5});

  QVERIFY(agrees(*scene.light_field, find_estimator("net"), {{"corners", false}},
                 ViewSelection::All, 23));
}

void RunBlocksTest::invalidPixels_areMarkedAlike() {
  const Scene scene = scene_of({5, 5});
  const LightField lf = with_holes(*scene.light_field);

  QVERIFY(agrees(lf, fetched(), {}, ViewSelection::All, 13));
}

void RunBlocksTest::singleRowOrColumnOfViews_equalsTheRunAtOnce() {
  for (const GridShape grid : {GridShape{1, 7}, GridShape{7, 1}}) {
    const Scene scene = scene_of(grid);

    QVERIFY(agrees(*scene.light_field, fetched(), {}, ViewSelection::All, 9));
  }
}

void RunBlocksTest::interruption_losesNothing() {
  const Scene scene = scene_of({5, 6});
  const LightField lf = with_holes(*scene.light_field);
  const Estimator method = fetched();
  const Estimate at_once = method.run(lf, {}, {}, Progress(2));
  const BlockwiseRun first = method.in_blocks(lf, {}, {}, Progress(2));
  const std::size_t memory = scarce(first, 20);
  MemoryStore store(first);

  int ends = 0;
  Provenance made;
  for (bool is_done = false; !is_done; ++ends) {
    store.writes = 1;
    // As another program, which knows nothing of this one.
    const BlockwiseRun run = method.in_blocks(lf, {}, {}, Progress(2));
    try {
      made = run_blocks(lf, run, store, exactly(memory), Progress(2));
      is_done = true;
    } catch (const Ended&) {
    }
  }

  QVERIFY(ends > 3);
  QVERIFY(store.equals(at_once));
  QVERIFY(made.notes == at_once.notes);
  QVERIFY(store.blocks <= ends);  // nothing was made twice
}

void RunBlocksTest::unevenViews_equalTheRunAtOnce() {
  const Scene scene = scenes::render_builtin(
      scenes::kRandomScene,
      {.grid = {5, 5}, .height = 60, .width = 66, .seed = 9, .kind = scenes::RandomKind::Uneven},
      Progress());

  QVERIFY(agrees(*scene.light_field, fetched(), {}, ViewSelection::All, 12));
}

void RunBlocksTest::lessThanTheSmallestBlock_isRefused() {
  const Scene scene = scene_of({3, 3});
  const BlockwiseRun run = fetched().in_blocks(*scene.light_field, {}, {}, Progress(2));
  MemoryStore store(run);

  QVERIFY_THROWS_EXCEPTION(
      InvalidInput,
      static_cast<void>(run_blocks(*scene.light_field, run, store, exactly(1000), Progress(2))));
}

void RunBlocksTest::lessThanALaterPassNeeds_isRefusedAtOnce() {
  const Scene scene = scene_of({3, 3});
  BlockwiseRun run = find_estimator("epi_s").in_blocks(*scene.light_field, {}, {}, Progress(2));
  const std::size_t enough = scarce(run, 83);
  run.passes.back().bytes = [enough](int) { return 2.0 * static_cast<double>(enough); };
  MemoryStore store(run);

  std::string sentence;
  try {
    static_cast<void>(run_blocks(*scene.light_field, run, store, exactly(enough), Progress(2)));
  } catch (const InvalidInput& error) {
    sentence = error.what();
  }

  QVERIFY2(sentence.starts_with("epi_s of this light field needs"), sentence.c_str());
  QCOMPARE(store.blocks, 0);
}

void RunBlocksTest::smallestBlocks_mayTakeMoreThanIsWanted() {
  const Scene scene = scene_of({3, 3});
  const Estimator method = find_estimator("epi_l");
  const Estimate at_once = method.run(*scene.light_field, {}, {}, Progress(2));
  const BlockwiseRun run = method.in_blocks(*scene.light_field, {}, {}, Progress(2));
  MemoryStore store(run);

  static_cast<void>(
      run_blocks(*scene.light_field, run, store, {1000, scarce(run, 83)}, Progress(2)));

  QCOMPARE(store.blocks, (83 + 7) / 8);  // of eight rows each
  QVERIFY(store.equals(at_once));
}

}  // namespace episcope::in_run_blocks_test

EPISCOPE_TEST(run_blocks_test, RunBlocksTest)
#include "run_blocks_test.moc"
