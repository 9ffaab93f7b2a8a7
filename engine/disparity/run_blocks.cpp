// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/run_blocks.h"

#include "engine/core/error.h"
#include "engine/core/progress.h"
#include "engine/disparity/estimator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace episcope {
namespace {

// Bands of fewer rows would mostly compute what they need around them.
constexpr int kFewestRows = 8;

int most_at_once(const BlockPass& pass, const MapGeometry& maps) {
  const int views = pass.only.empty() ? maps.grid.u : 1;
  return pass.unit == BlockUnit::Rows ? maps.height : views;
}

int fewest_at_once(const BlockPass& pass, const MapGeometry& maps) {
  return std::min(pass.unit == BlockUnit::Rows ? kFewestRows : 1, most_at_once(pass, maps));
}

class BlockRunner {
 public:
  BlockRunner(const LightField& light_field, const BlockwiseRun& run, BlockStore& store,
              BlockMemory memory)
      : light_field_(light_field),
        run_(run),
        store_(store),
        wanted_(static_cast<double>(memory.wanted)),
        state_(store.progress()),
        seconds_before_(state_.seconds) {}

  void make(const Progress& progress) {
    const auto passes = static_cast<double>(run_.passes.size());
    while (state_.pass < static_cast<int>(run_.passes.size())) {
      make_pass(progress.part(state_.pass / passes, (state_.pass + 1) / passes));
    }
  }

  [[nodiscard]] Provenance provenance() const {
    Provenance made = run_.provenance;
    made.seconds = state_.seconds;
    std::vector<std::string> notes = state_.notes;
    if (run_.notes) {
      for (std::string& note : run_.notes(state_)) notes.push_back(std::move(note));
    }
    made.notes.insert(made.notes.begin(), notes.begin(), notes.end());
    return made;
  }

 private:
  [[nodiscard]] bool is_last() const {
    return state_.pass + 1 == static_cast<int>(run_.passes.size());
  }
  [[nodiscard]] int count_of(const BlockPass& pass) const {
    if (pass.unit == BlockUnit::Rows) return run_.maps.height;
    return pass.only.empty() ? run_.maps.grid.count() : static_cast<int>(pass.only.size());
  }

  // How many rows or views at once.
  [[nodiscard]] int block_size(const BlockPass& pass) const {
    int few = fewest_at_once(pass, run_.maps);
    int many = most_at_once(pass, run_.maps) + 1;  // few fit, many do not
    while (many - few > 1) {
      const int middle = few + (many - few) / 2;
      (pass.bytes(middle) <= wanted_ ? few : many) = middle;
    }
    return few;
  }

  // The next block: bands of all views, or views of one row of the grid.
  [[nodiscard]] MapBlock next_block(const BlockPass& pass, int size) const {
    const MapGeometry& maps = run_.maps;
    if (pass.unit == BlockUnit::Rows) {
      return {{maps.first, maps.grid}, state_.done, std::min(state_.done + size, maps.height)};
    }
    if (!pass.only.empty()) return {{pass.only[state_.done], {1, 1}}, 0, maps.height};
    const ViewIndex view = maps.grid.view_at(state_.done, maps.first);
    const int left = maps.first.u + maps.grid.u - view.u;
    return {{view, {1, std::min(size, left)}}, 0, maps.height};
  }

  void begin_pass(const BlockPass& pass, const Progress& progress) {
    if (!pass.prepare || state_.is_prepared) return;
    state_.facts = pass.prepare(read_, state_.facts, progress);
    state_.is_prepared = true;
    light_field_.forget_samples();
    state_.seconds = seconds();
    store_.note(state_);
  }

  void make_pass(const Progress& progress) {
    const BlockPass& pass = run_.passes[static_cast<std::size_t>(state_.pass)];
    progress.step(pass.step);
    begin_pass(pass, progress.part(0, 0.02));
    const int size = block_size(pass), count = count_of(pass);
    while (state_.done < count) {
      const MapBlock block = next_block(pass, size);
      const int done =
          state_.done + (pass.unit == BlockUnit::Rows ? block.rows() : block.views.grid.count());
      const auto share = [&](int of) { return 0.02 + 0.98 * of / count; };
      make_block(pass, block, done, progress.part(share(state_.done), share(done)));
    }
    if (is_last()) {
      ++state_.pass;
      return;
    }
    end_pass();
  }

  void end_pass() {
    ++state_.pass;
    state_.done = 0;
    state_.finding = 0;
    state_.is_prepared = false;
    state_.seconds = seconds();
    store_.note(state_);
  }

  void make_block(const BlockPass& pass, const MapBlock& block, int done,
                  const Progress& progress) {
    progress.check();
    FinishedBlock made = pass.compute(block, read_, state_.facts, progress);
    progress.check();
    if (is_last()) mark_invalid(light_field_, block.first_row, made.maps);
    light_field_.forget_samples();
    state_.done = done;
    state_.finding = std::max(state_.finding, made.finding);
    if (!made.facts.empty()) state_.facts = std::move(made.facts);
    state_.notes.insert(state_.notes.end(), made.notes.begin(), made.notes.end());
    state_.seconds = seconds();
    store_.write(block, made.maps, state_, state_.pass > 0);
  }

  [[nodiscard]] double seconds() const { return seconds_before_ + watch_.seconds(); }

  const LightField& light_field_;
  const BlockwiseRun& run_;
  BlockStore& store_;
  double wanted_;
  BlockProgress state_;
  double seconds_before_;
  Stopwatch watch_;
  ReadBlock read_{[this](const MapBlock& block) { return store_.read(block); }};
};

}  // namespace

void require_memory(const BlockwiseRun& run, BlockMemory memory) {
  constexpr double kMegabyte = 1e6;
  const auto most = static_cast<double>(memory.most);
  double least = 0;
  for (const BlockPass& pass : run.passes) {
    least = std::max(least, pass.bytes(fewest_at_once(pass, run.maps)));
  }
  if (least <= most) return;
  throw InvalidInput(
      fmt::format("{} of this light field needs {:.0f} MB of memory at least, but only {:.0f} "
                  "MB may be used; allow more",
                  run.provenance.method, std::ceil(least / kMegabyte), most / kMegabyte));
}

Provenance run_blocks(const LightField& lf, const BlockwiseRun& run, BlockStore& store,
                      BlockMemory memory, const Progress& progress) {
  require_memory(run, memory);
  BlockRunner blocks(lf, run, store, memory);
  blocks.make(progress);
  return blocks.provenance();
}

}  // namespace episcope
