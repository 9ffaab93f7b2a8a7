// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/linked_labeling.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/solvers/linked_unknowns.h"
#include "engine/solvers/pair_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace episcope {
namespace {

// The share of the work that solving the images alone takes.
constexpr double kStartShare = 0.3;

void check_problem(const LinkedProblem& problem) {
  if (problem.images.empty() || problem.images[0].codes.empty()) {
    throw InvalidInput("a labeling of several images needs costs of at least one");
  }
  const auto& first = problem.images[0].codes;
  for (const LinkedImage& image : problem.images) {
    const auto& codes = image.codes;
    if (codes.height != first.height || codes.width != first.width ||
        codes.layers != first.layers) {
      throw InvalidInput("images that are labeled together must have the same size and labels");
    }
    check_boundaries(image.g, problem.smoothness, codes.height, codes.width);
  }
  if (!(problem.coherence >= 0)) {
    throw InvalidInput("the coherence of a labeling must not be negative");
  }
}

template <class Labels>
void check_labels(const LinkedProblem& problem, const Labels& labels) {
  const auto& codes = problem.images[0].codes;
  const bool fit =
      labels.size() == problem.images.size() && std::ranges::all_of(labels, [&](const auto& each) {
        return each.height == codes.height && each.width == codes.width;
      });
  if (!fit)
    throw InvalidInput("there must be a label image of the size of the costs for each image");
}

std::vector<PairLimits> limits_of(const LinkedProblem& problem, const Progress& progress) {
  std::vector<PairLimits> limits;
  for (const LinkedImage& image : problem.images) {
    progress.check();
    limits.emplace_back(image.codes.height, image.codes.width, problem.smoothness / 2, image.g);
  }
  return limits;
}

// Of the costs and boundaries of one image and the links that leave it.
double image_energy(const LinkedProblem& problem, const PairLimits& limits,
                    const std::vector<ImageView<const int>>& labels, int i) {
  const LinkedImage& image = problem.images[i];
  const ImageView<const int> here = labels[i];
  double sum = 0;
  for (int y = 0; y < here.height; ++y) {
    sum += boundary_row_energy(limits, here, y, potts_jump);
    for (int x = 0; x < here.width; ++x) {
      sum += static_cast<double>(problem.table[image.codes.at(y, here.at(y, x), x)]);
    }
    for (const ImageLinks& links : image.links) {
      if (links.to < 0) continue;
      const ImageView<const int> there = labels[links.to];
      for (int x = 0; x < here.width; ++x) {
        const std::int32_t at = links.target.at(y, x);
        if (at < 0 || there.at(at / here.width, at % here.width) == here.at(y, x)) continue;
        sum += problem.coherence * link_weight(links, y, x);
      }
    }
  }
  return sum;
}

std::vector<ImageView<const int>> views_of(const std::vector<Image<int>>& images) {
  return {images.begin(), images.end()};
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// All images together.
class LinkedSolver {
 public:
  LinkedSolver(const LinkedProblem& problem, const LinkedOptions& options, const Progress& progress)
      : problem_(problem),
        options_(options),
        sources_(problem, progress.part(0, 0)),
        limits_(limits_of(problem, progress)),
        unknowns_(problem, progress.part(0, 0)),
        bounds_(problem.images.size()),
        energies_(problem.images.size()) {
    for (std::size_t i = 0; i < problem.images.size(); ++i) {
      rounded_.emplace_back(unknowns_.height(), unknowns_.row().width);
    }
  }

  void start(const Progress& progress) {
    start_from_single_images(problem_, sources_, options_, progress, unknowns_);
  }

  void iterate(const Progress& progress) {
    for_images(progress, [](LinkedRows& rows, int i) { rows.sweep(i); });
    for_images(progress, [](LinkedRows& rows, int i) { rows.move_links(i); });
  }

  // The labels of a look are kept if they are the best so far.
  void measure(const Progress& progress, LinkedResult& result,
               const std::vector<ImageView<int>>& labels) {
    for_images(progress, [this](LinkedRows& rows, int i) {
      bounds_[i] = rows.bound(i);
      rows.round(i, rounded_[i].view());
    });
    const auto rounded = views_of(rounded_);
    parallel_for(images(), progress,
                 [&](int i) { energies_[i] = image_energy(problem_, limits_[i], rounded, i); });
    result.bound = std::max(result.bound, sum_of(bounds_));
    const double energy = sum_of(energies_);
    if (energy >= result.energy) return;
    result.energy = energy;
    for (int i = 0; i < images(); ++i) {
      for (int y = 0; y < unknowns_.height(); ++y) {
        std::copy_n(rounded_[i].row(y), unknowns_.row().width, labels[i].row(y));
      }
    }
  }

 private:
  [[nodiscard]] int images() const { return static_cast<int>(problem_.images.size()); }

  template <class Work>
  void for_images(const Progress& progress, const Work& work) {
    parallel_for_workers(images(), progress, [&] {
      return [&, rows = LinkedRows({problem_, sources_, limits_, options_.isa, progress},
                                   unknowns_)](int i) mutable {
        const FlushDenormals flush;
        work(rows, i);
      };
    });
  }

  const LinkedProblem& problem_;
  const LinkedOptions& options_;
  LinkSources sources_;
  std::vector<PairLimits> limits_;
  LinkedUnknowns unknowns_;
  std::vector<Image<int>> rounded_;
  std::vector<double> bounds_, energies_;  // of each image
};

}  // namespace

double LinkedResult::relative_gap() const {
  return labeling_gap(energy, bound);
}

LinkedResult solve_linked_labeling(const LinkedProblem& problem, const LinkedOptions& options,
                                   const Progress& progress,
                                   const std::vector<ImageView<int>>& labels) {
  check_problem(problem);
  check_labels(problem, labels);
  LinkedSolver solver(problem, options, progress);
  solver.start(progress.part(0, kStartShare));
  LinkedResult result;
  result.energy = std::numeric_limits<double>::infinity();
  result.bound = -result.energy;
  const int check_every = std::max(1, options.check_every);
  double done = kStartShare;
  for (bool last = false; !last;) {
    const Progress quiet = progress.part(done, done);
    solver.iterate(quiet);
    ++result.iterations;
    done = std::max(done, 1 - (1 - kStartShare) * std::exp2(-result.iterations / 40.0));
    progress.report(done);
    last = result.iterations >= options.max_iterations || progress.finish_requested();
    if (!last && result.iterations % check_every != 0) continue;
    solver.measure(quiet, result, labels);
    result.converged = result.relative_gap() <= options.gap;
    last = last || result.converged;
    progress.step(labeling_gap_text(result.relative_gap()));
  }
  progress.report(1);
  return result;
}

double linked_energy(const LinkedProblem& problem,
                     const std::vector<ImageView<const int>>& labels) {
  check_problem(problem);
  check_labels(problem, labels);
  const std::vector<PairLimits> limits = limits_of(problem, Progress());
  double sum = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    sum += image_energy(problem, limits[i], labels, static_cast<int>(i));
  }
  return sum;
}

}  // namespace episcope
