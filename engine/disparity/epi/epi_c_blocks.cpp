// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi/epi_c_blocks.h"

#include "engine/disparity/epi/line_residual_kernel.h"
#include "engine/disparity/epi/ordering_sweeps.h"
#include "engine/disparity/epi/replace_occluded.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace episcope {
namespace {

// Maps that are kept.
constexpr int kObserved = 0, kDenoised = 1;
// Facts, of which the first two are those of the check of lines.
enum Fact { kGapOfViews = 2, kGapOfSweep, kNoise, kBefore, kAfter, kFacts };
using Facts = std::vector<double>;

// A view more on each side, within the grid.
ViewRectangle around(const ViewRectangle& views, int above, int beside, GridShape grid) {
  const ViewIndex first{std::max(views.first.v - above, 0), std::max(views.first.u - beside, 0)};
  const ViewIndex end{std::min(views.first.v + views.grid.v + above, grid.v),
                      std::min(views.first.u + views.grid.u + beside, grid.u)};
  return {first, {end.v - first.v, end.u - first.u}};
}

void copy_views(const ViewStack<float>& from, const ViewRectangle& views, ViewStack<float>& to) {
  for (int i = 0; i < views.grid.count(); ++i) {
    const ViewIndex view = views.grid.view_at(i, views.first);
    std::copy_n(from.view(view).data, from.view_size(), to.view(view).data);
  }
}

class OrderedBlocks {
 public:
  OrderedBlocks(const LightField& lf, const EpiCParameters& parameters, Interval range, int threads)
      : lf_(lf), parameters_(parameters), range_(range), threads_(threads) {}

  [[nodiscard]] int sweeps() const { return parameters_.sweeps; }
  [[nodiscard]] bool replaces() const { return sweeps() > 0 && parameters_.replace_occluded; }

  [[nodiscard]] Facts find_noise(const ReadBlock& read, const Progress& progress) const {
    Facts facts = line_check_noise(lf_, parameters_.line_check, read(whole(center())), progress);
    facts.resize(kFacts);
    return facts;
  }

  [[nodiscard]] FinishedBlock denoise_views(const MapBlock& block, const ReadBlock& read,
                                            const Facts& facts, const Progress& progress) const {
    FinishedBlock made{read(block)};
    const LineCheck& check = parameters_.line_check;
    if (check.does_anything()) {
      const PackedViews packed = pack_around(lf_, block.views, kMaxArmViews, progress.part(0, 0.1));
      check_lines(packed, check, facts, made.maps, progress.part(0.1, 0.4));
    }
    ViewStack<float>& disparity = made.maps.field.disparity;
    made.maps.kept.push_back(disparity.clone());
    const double gap = denoise(lf_, parameters_.denoising, {kOrderingLeastWeight}, disparity,
                               made.maps.confidence, progress.part(0.4, 1));
    made.maps.kept.push_back(disparity.clone());
    made.facts = facts;
    made.facts[kGapOfViews] = std::max(gap, facts[kGapOfViews]);
    return made;
  }

  [[nodiscard]] Facts find_replacement_noise(const ReadBlock& read, Facts facts,
                                             const Progress& progress) const {
    const PackedViews packed = pack_around(lf_, center(), kMaxArmViews, progress);
    const ViewStack<float> denoised = read.kept(whole(center()), kDenoised);
    facts[kNoise] = replacement_noise(packed, lf_.center(), denoised.view(lf_.center()));
    return facts;
  }

  [[nodiscard]] FinishedBlock replace(const MapBlock& block, const ReadBlock& read,
                                      const Facts& facts, const Progress& progress) const {
    const ViewRectangle reached = around(block.views, kMaxArmViews, kMaxArmViews, lf_.grid());
    ViewStack<float> before = views_of(reached), confidence = views_of(reached);
    for (const ViewRectangle& arms : {around(block.views, 0, kMaxArmViews, lf_.grid()),
                                      around(block.views, kMaxArmViews, 0, lf_.grid())}) {
      copy_views(read.kept(whole(arms), kDenoised), arms, before);
      copy_views(read(whole(arms)).confidence, arms, confidence);
    }
    const PackedViews packed = pack_around(lf_, block.views, kMaxArmViews, progress.part(0, 0.1));
    FinishedBlock made{read(block)};
    replace_occluded(packed, static_cast<float>(facts[kNoise]), before, confidence,
                     made.maps.field.disparity, progress.part(0.1, 1));
    return made;
  }

  // Half a sweep; the second half counts the gap of both.
  [[nodiscard]] FinishedBlock sweep(int half, const MapBlock& block, const ReadBlock& read,
                                    const Facts& facts, const Progress& progress) const {
    const ViewRectangle reached = around(block.views, 1, 1, lf_.grid());
    ViewStack<float> u = read(whole(reached)).field.disparity;
    FinishedBlock made{read(block)};
    const ViewStack<float> observed = read.kept(block, kObserved);
    const double gap = improve({lf_, parameters_, observed, made.maps.confidence, u},
                               views_of_colour(block.views, half % 2), progress);
    copy_views(u, block.views, made.maps.field.disparity);
    made.facts = facts;
    made.facts[kGapOfSweep] = std::max(gap, facts[kGapOfSweep]);
    return made;
  }

  [[nodiscard]] Facts count_violations(const ReadBlock& read, Facts facts,
                                       const Progress& progress) const {
    LineCount before, after;
    Image<float> scratch(lf_.height(), lf_.width());
    for (int i = 0; i < lf_.grid().count(); ++i) {
      progress.check();
      const ViewIndex view = lf_.grid().view_at(i);
      const MapBlock block = whole(around({view, {1, 1}}, 1, 1, lf_.grid()));
      before += count_lines(read.kept(block, kDenoised), view, scratch);
      after += count_lines(read(block).field.disparity, view, scratch);
    }
    facts[kBefore] = before.share();
    facts[kAfter] = after.share();
    return facts;
  }

  [[nodiscard]] FinishedBlock finish(const MapBlock& block, const ReadBlock& read,
                                     const Progress& progress) const {
    FinishedBlock made{read(block)};
    clamp_to_range(made.maps.field.disparity, range_, progress);
    return made;
  }

  // What a view takes that is denoised, with what is looked at around it.
  [[nodiscard]] double bytes_of_denoised(int count) const {
    constexpr double kMaps = 17, kSmoothed = 96, kChecked = 24;
    return around_bytes(count, 4) +
           pixels() * (kMaps * count + kChecked + kSmoothed * std::min(count, threads_));
  }
  [[nodiscard]] double bytes_of_replaced(int count) const {
    constexpr double kMaps = 9, kReplaced = 24;
    return around_bytes(count, 20) + pixels() * (kMaps * count + kReplaced);
  }
  [[nodiscard]] double bytes_of_swept(int count) const {
    constexpr double kAround = 8, kMaps = 13, kSwept = 124;
    const double looked_at = lf_.is_on_disk() ? sample_bytes() * std::min(count, threads_) : 0;
    return pixels() *
               (kAround * 3 * (count + 2) + kMaps * count + kSwept * std::min(count, threads_)) +
           looked_at;
  }
  [[nodiscard]] double bytes_of_finished(int count) const {
    constexpr double kMaps = 9, kCounted = 9 * 12 + 4;
    return pixels() * std::max(kMaps * count, kCounted);
  }

 private:
  [[nodiscard]] ViewRectangle center() const { return {lf_.center(), {1, 1}}; }
  [[nodiscard]] MapBlock whole(const ViewRectangle& views) const {
    return {views, 0, lf_.height()};
  }
  [[nodiscard]] ViewStack<float> views_of(const ViewRectangle& views) const {
    return {views.grid, lf_.height(), lf_.width(), 1, views.first};
  }
  [[nodiscard]] double pixels() const { return static_cast<double>(lf_.height()) * lf_.width(); }
  // Of a view.
  [[nodiscard]] double sample_bytes() const {
    return static_cast<double>(lf_.byte_size()) / lf_.grid().count();
  }
  [[nodiscard]] double around_bytes(int count, double of_pixel) const {
    return packed_around(count, kMaxArmViews) *
           (of_pixel * pixels() + (lf_.is_on_disk() ? sample_bytes() : 0));
  }

  const LightField& lf_;
  EpiCParameters parameters_;
  Interval range_;
  int threads_;
};

using Blocks = std::shared_ptr<const OrderedBlocks>;

BlockPass views_pass(std::string step) {
  BlockPass pass;
  pass.step = std::move(step);
  pass.unit = BlockUnit::Views;
  return pass;
}

BlockPass denoising(const Blocks& blocks) {
  BlockPass pass = views_pass("checking lines and denoising");
  pass.bytes = [blocks](int count) { return blocks->bytes_of_denoised(count); };
  pass.prepare = [blocks](const ReadBlock& read, const Facts&, const Progress& progress) {
    return blocks->find_noise(read, progress);
  };
  pass.compute = [blocks](const MapBlock& block, const ReadBlock& read, const Facts& facts,
                          const Progress& progress) {
    return blocks->denoise_views(block, read, facts, progress);
  };
  return pass;
}

BlockPass replacing(const Blocks& blocks) {
  BlockPass pass = views_pass("replacing rays that other views see through");
  pass.bytes = [blocks](int count) { return blocks->bytes_of_replaced(count); };
  pass.prepare = [blocks](const ReadBlock& read, const Facts& facts, const Progress& progress) {
    return blocks->find_replacement_noise(read, facts, progress);
  };
  pass.compute = [blocks](const MapBlock& block, const ReadBlock& read, const Facts& facts,
                          const Progress& progress) {
    return blocks->replace(block, read, facts, progress);
  };
  return pass;
}

BlockPass sweeping(const Blocks& blocks, int half) {
  BlockPass pass =
      views_pass(fmt::format("ordering, sweep {} of {}", half / 2 + 1, blocks->sweeps()));
  pass.bytes = [blocks](int count) { return blocks->bytes_of_swept(count); };
  if (half % 2 == 0) {
    pass.prepare = [](const ReadBlock&, Facts facts, const Progress&) {
      facts[kGapOfSweep] = 0;
      return facts;
    };
  }
  pass.compute = [blocks, half](const MapBlock& block, const ReadBlock& read, const Facts& facts,
                                const Progress& progress) {
    return blocks->sweep(half, block, read, facts, progress);
  };
  return pass;
}

BlockPass finishing(const Blocks& blocks) {
  BlockPass pass = views_pass("counting violations of the ordering");
  pass.bytes = [blocks](int count) { return blocks->bytes_of_finished(count); };
  pass.prepare = [blocks](const ReadBlock& read, const Facts& facts, const Progress& progress) {
    return blocks->count_violations(read, facts, progress);
  };
  pass.compute = [blocks](const MapBlock& block, const ReadBlock& read, const Facts&,
                          const Progress& progress) {
    return blocks->finish(block, read, progress);
  };
  return pass;
}

// One block that needs the maps of all views.
BlockwiseRun center_in_one(const LightField& lf, const EpiCParameters& parameters, BlockwiseRun run,
                           int threads) {
  run.maps = {{1, 1}, lf.center(), lf.height(), lf.width()};
  BlockPass pass = views_pass("estimating all views for the one in the middle");
  pass.only = {lf.center()};
  pass.bytes = [&lf, threads](int) {
    constexpr double kOfRay = 20, kOfView = 124;
    const double rays = static_cast<double>(lf.height()) * lf.width() * lf.grid().count();
    return kOfRay * rays + kOfView * threads * lf.height() * lf.width() +
           (lf.is_on_disk() ? static_cast<double>(lf.byte_size()) : 0);
  };
  pass.compute = [&lf, parameters](const MapBlock&, const ReadBlock&, const Facts&,
                                   const Progress& progress) {
    Estimate estimate = estimate_epi_c(lf, parameters, ViewSelection::Center, progress);
    FinishedBlock made{{std::move(estimate.field), std::move(estimate.confidence)}};
    made.notes = std::move(estimate.notes);
    return made;
  };
  run.passes = {std::move(pass)};
  return run;
}

}  // namespace

BlockwiseRun epi_c_in_blocks(const LightField& lf, const EpiCParameters& parameters,
                             ViewSelection views, const Progress& progress) {
  BlockwiseRun run = orientations_in_blocks(lf, parameters.tensor, ViewSelection::All, progress);
  if (views == ViewSelection::Center) {
    return center_in_one(lf, parameters, std::move(run), progress.threads());
  }
  const auto blocks = std::make_shared<const OrderedBlocks>(lf, parameters, run.provenance.range,
                                                            progress.threads());
  run.kept = 2;
  run.passes.push_back(denoising(blocks));
  if (blocks->replaces()) run.passes.push_back(replacing(blocks));
  for (int half = 0; half < 2 * blocks->sweeps(); ++half) {
    run.passes.push_back(sweeping(blocks, half));
  }
  run.passes.push_back(finishing(blocks));
  run.notes = [](const BlockProgress& end) {
    const Facts& facts = end.facts;
    const double gap = facts[kGapOfSweep] > 0 ? facts[kGapOfSweep] : facts[kGapOfViews];
    return std::vector<std::string>{gap_note(gap), ordering_note(facts[kBefore], facts[kAfter])};
  };
  return run;
}

}  // namespace episcope
