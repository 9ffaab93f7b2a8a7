// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/run_estimator.h"

#include "app/session/result_files.h"
#include "app/session/scene_summary.h"
#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/hash.h"
#include "engine/core/memory.h"
#include "engine/core/version.h"
#include "engine/io/base/json.h"
#include "engine/io/models/result_draft.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <ctime>
#include <string_view>
#include <utility>

namespace episcope {
namespace {

// Codes of notes that doubt the range.
constexpr std::array<std::string_view, 3> kRangeDoubts{"range.limited", "range.elsewhere",
                                                       "range.nothing"};

std::string range_warning(const Estimate& estimate) {
  const auto doubted = std::ranges::find_if(estimate.notes, [](const std::string& note) {
    const auto finding = finding_of(note);
    return finding && std::ranges::count(kRangeDoubts, finding->code) > 0;
  });
  return doubted == estimate.notes.end() ? std::string() : *doubted;
}

void add_date(Provenance& estimate) {
  estimate.date = fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr)));
}

}  // namespace

bool was_taken_early(const Estimate& estimate) {
  return std::ranges::find(estimate.notes, kTakenEarly) != estimate.notes.end();
}

FinishedEstimate run_estimator(const Scene& scene, const Estimator& estimator,
                               const ParameterSet& parameters, const RunOptions& options,
                               const Progress& progress) {
  const LightField& light_field = *scene.light_field;
  auto estimate = std::make_shared<Estimate>(
      estimator.run(light_field, *scene.even, parameters, options, progress.part(0, 0.95)));
  estimate->source_hash = light_field.sample_hash();
  add_date(*estimate);
  if (progress.finish_requested() && estimator.info.iterative) {
    estimate->notes.push_back(kTakenEarly);
  }
  progress.check();
  const Interval range = display_range(*estimate);
  std::string warning = range_warning(*estimate);
  progress.report(1);
  return {std::move(estimate), range, std::move(warning)};
}

ViewSelection views_to_estimate(const Estimator& estimator, std::optional<ViewSelection> wanted) {
  const bool can_all = estimator.info.all_views;
  if (!wanted) return can_all ? ViewSelection::All : ViewSelection::Center;
  if (can_all || *wanted == ViewSelection::Center) return *wanted;
  const bool chooses =
      std::ranges::count(estimator.parameters, std::string("view"), &ParameterDescription::key) > 0;
  throw InvalidInput(estimator.info.id + " estimates one view at a time; use --views center" +
                     (chooses ? ", or --view V,U for another" : ""));
}

namespace {

// What must be the same for a file to be continued, in one line.
std::string identity_of(const Estimator& estimator, const BlockwiseRun& run,
                        std::uint64_t source_hash) {
  const MapGeometry& maps = run.maps;
  const nlohmann::json identity{
      {"draft", 4},
      {"version", kVersion},
      {"method", estimator.info.id},
      {"revision", estimator.info.revision},
      {"parameters", io::parameters_to_json(run.provenance.parameters)},
      {"range", {run.provenance.range.min, run.provenance.range.max}},
      {"samples", hash_digits(source_hash)},
      {"maps", {maps.first.v, maps.first.u, maps.grid.v, maps.grid.u, maps.height, maps.width}}};
  return io::json_text(identity);
}

class DraftStore : public BlockStore {
 public:
  DraftStore(io::ResultDraft& draft, std::string source)
      : draft_(draft), source_(std::move(source)) {}
  [[nodiscard]] BlockProgress progress() const override { return draft_.progress(); }
  [[nodiscard]] BlockMaps read(const MapBlock& block) const override { return draft_.read(block); }
  void note(const BlockProgress& after) override { draft_.note(after); }
  void write(const MapBlock& block, const BlockMaps& maps, const BlockProgress& after,
             bool replaces) override {
    require_samples();
    draft_.write(block, maps, after, replaces);
  }

 private:
  // What was computed from pages that are gone must not be kept.
  void require_samples() const {
    if (!has_lost_pages()) return;
    throw IoError(source_, "the file was truncated, or could not be read, while it was open");
  }

  io::ResultDraft& draft_;
  std::string source_;
};

std::string remark_on(const io::ResultDraft& draft, const std::filesystem::path& output) {
  const std::string name = output.string() + ".partial";
  switch (draft.found()) {
    case io::ResultDraft::Found::Nothing:
      return {};
    case io::ResultDraft::Found::Other:
      return name + ", which another run had left unfinished, was replaced";
    case io::ResultDraft::Found::Same:
      return fmt::format("{} was continued, on which {:.0f} s had been spent", name,
                         draft.progress().seconds);
  }
  return {};
}

// What is left beside so many bytes.
BlockMemory without(BlockMemory memory, std::size_t bytes) {
  return {memory.wanted - std::min(bytes, memory.wanted),
          memory.most - std::min(bytes, memory.most)};
}

}  // namespace

bool should_run_in_blocks(const LightField& lf, const Estimator& estimator,
                          const RunOptions& options) {
  if (!estimator.can_run_in_blocks() || options.device == Device::Cuda) return false;
  if (is_memory_budget_set()) return true;
  constexpr double kOfMaps = 9, kBesideThem = 4;  // bytes of a ray
  const bool all = estimator.info.all_views && options.views == ViewSelection::All;
  const double pixels = static_cast<double>(lf.height()) * lf.width();
  const double rays = pixels * (all ? lf.grid().count() : 1);
  return rays * (kOfMaps + kBesideThem) > static_cast<double>(memory_budget());
}

FinishedBlocks run_in_blocks(const LightField& lf, const Estimator& estimator,
                             const BlockRequest& request, const Progress& progress) {
  return_freed_memory();
  progress.step("identifying the samples");
  const std::uint64_t hash = lf.sample_hash();
  const Progress limited = progress.limited_to(request.run.options.threads);
  EvenViews even;
  BlockwiseRun run = estimator.in_blocks(lf, even, request.run.parameters, request.run.options,
                                         limited.part(0.02, 0.06));
  lf.forget_samples();
  const BlockMemory memory = without(request.memory, even.bytes());
  require_memory(run, memory);  // before what another run left is replaced
  run.provenance.source_hash = hash;
  const io::DraftShape shape{
      .maps = run.maps, .has_valid = !lf.valid().empty(), .has_second = run.has_second};
  io::ResultDraft draft(request.output, shape, identity_of(estimator, run, hash));
  DraftStore store(draft, lf.info().source);
  FinishedBlocks finished{{}, run.maps, remark_on(draft, request.output)};
  finished.provenance = run_blocks(lf, run, store, memory, limited.part(0.06, 1));
  add_date(finished.provenance);
  draft.commit(finished.provenance, source_text(request.input, request.output));
  return finished;
}

}  // namespace episcope
