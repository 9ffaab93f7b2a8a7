// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/kept_solver.h"

#include "engine/core/hash/fnv1a.h"

#include <algorithm>
#include <cstring>

namespace episcope {
namespace {

// As far as one undoes without a thought.
constexpr std::size_t kMostSolved = 16;

void add(const float* values, std::size_t count, Fnv1a& hash) {
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t word = 0;
    std::memcpy(&word, values + i, sizeof word);
    hash.add_word(word);
  }
}

std::uint64_t hash_of(const SimplexProblem& problem) {
  Fnv1a hash;
  const VolumeView<const float>& cost = problem.cost;
  add(cost.data, static_cast<std::size_t>(cost.height) * cost.layers * cost.width, hash);
  add(problem.g.data, problem.g.size(), hash);
  const auto smoothness = static_cast<float>(problem.smoothness);
  add(&smoothness, 1, hash);
  return hash.value();
}

}  // namespace

double KeptSolver::bytes(double pixels, int labels) {
  return (8 * 4.0 / 3 + 1.0 / 3) * sizeof(float) * pixels * labels;
}

bool KeptSolver::prepare(const LabelProbabilities& probabilities, ViewIndex view) {
  const ProbabilityMap& map = probabilities.view(view);
  if (solver_ && view == view_ && map.height() == height_ && map.width() == width_ &&
      probabilities.ids == ids_) {
    return true;
  }
  drop();
  solver_.emplace(map.height(), map.layers(), map.width());
  view_ = view;
  height_ = map.height();
  width_ = map.width();
  ids_ = probabilities.ids;
  return false;
}

SimplexResult KeptSolver::solve(const SimplexProblem& problem, const SimplexOptions& options,
                                const Progress& progress, ImageView<int> labels) {
  const std::uint64_t hash = hash_of(problem);
  const auto known = std::ranges::find_if(solved_, [&](const Solved& each) {
    return each.problem == hash && each.result.converged && each.gap <= options.gap;
  });
  if (known != solved_.end()) {
    std::ranges::copy(known->labels, labels.data);
    return known->result;
  }
  const SimplexResult result = solver_->solve(problem, options, progress, labels);
  if (solved_.size() == kMostSolved) solved_.pop_front();
  solved_.push_back({hash, options.gap, result, {labels.data, labels.data + labels.size()}});
  return result;
}

void KeptSolver::drop() {
  solver_.reset();
  solved_.clear();
}

}  // namespace episcope
