// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/linked/linked_start.h"

#include "engine/core/parallel/parallel.h"
#include "engine/solvers/lifted/layered_sweep.h"
#include "engine/solvers/simplex/pair_labels.h"
#include "engine/solvers/simplex/simplex_labeling.h"

#include <algorithm>
#include <vector>

namespace episcope {
namespace {

// Images solved one after the other by one thread.
constexpr int kLongestChain = 9;
// The agreement of images changes more than what more iterations of one would.
constexpr int kMostIterations = 100;
constexpr double kLeastGap = 1e-2;

struct Chain {
  int begin = 0, end = 0;
};

std::vector<Chain> chains_of(const LinkedProblem& problem) {
  std::vector<Chain> chains;
  for (int i = 0; i < static_cast<int>(problem.images.size()); ++i) {
    const bool goes_on = !chains.empty() && problem.images[i - 1].links[0].to == i &&
                         i - chains.back().begin < kLongestChain;
    if (!goes_on) chains.push_back({i, i});
    chains.back().end = i + 1;
  }
  return chains;
}

// One thread's room to solve one image after the other.
class SingleImages {
 public:
  SingleImages(const LinkedProblem& problem, const LinkSources& sources,
               const LinkedOptions& options, LinkedUnknowns& unknowns)
      : problem_(problem),
        sources_(sources),
        options_(options),
        unknowns_(unknowns),
        kernel_(EPISCOPE_CHOOSE_KERNEL(options.isa, kLinkedKernel)),
        solver_(unknowns.height(), unknowns.row().layers, unknowns.row().width, options.isa),
        costs_(unknowns.height(), unknowns.row().layers, unknowns.row().width),
        labels_(unknowns.height(), unknowns.row().width) {}

  void solve(const Chain& chain, const Progress& progress) {
    for (int i = chain.begin; i < chain.end; ++i) {
      for (int y = 0; y < costs_.height(); ++y) {
        look_up_costs(problem_, kernel_, i, y, costs_.view().row(y, 0));
      }
      SimplexOptions options{kMostIterations, std::max(options_.gap, kLeastGap), 5, {}};
      if (i > chain.begin) options.from_last = sources_.pixels(i, 0);
      const SimplexProblem single{costs_.view(), problem_.images[i].g, problem_.smoothness};
      solver_.solve(single, options, progress, labels_.view());
      if (problem_.smoothness > 0) {
        take_unknowns(i);
      } else {
        take_labels(i);
      }
    }
  }

 private:
  void take_unknowns(int image) {
    LayeredSweep& solved = solver_.unknowns();
    const long size = unknowns_.row_size();
    for (int y = 0; y < unknowns_.height(); ++y) {
      kernel_.pack(solved.phi(y), size, LinkedUnknowns::kUnit, unknowns_.u(image, y));
      kernel_.pack(solved.duals(y).pair[0], kPairKinds * size, unknowns_.pair_unit(),
                   unknowns_.pairs(image, y));
    }
  }

  void take_labels(int image) {
    for (int y = 0; y < unknowns_.height(); ++y) {
      for (int x = 0; x < unknowns_.row().width; ++x) {
        unknowns_.u(image, y)[labels_.at(y, x) * unknowns_.row().pitch + x] =
            static_cast<std::int16_t>(1 / LinkedUnknowns::kUnit);
      }
    }
  }

  const LinkedProblem& problem_;
  const LinkSources& sources_;
  const LinkedOptions& options_;
  LinkedUnknowns& unknowns_;
  const LinkedKernel& kernel_;
  SimplexSolver solver_;
  Volume<float> costs_;
  Image<int> labels_;
};

}  // namespace

void look_up_costs(const LinkedProblem& problem, const LinkedKernel& kernel, int image, int y,
                   float* cost) {
  const auto& codes = problem.images[image].codes;
  kernel.look_up(codes.row(y, 0), problem.table.data(),
                 static_cast<long>(codes.layers) * codes.width, cost);
}

void start_from_single_images(const LinkedProblem& problem, const LinkSources& sources,
                              const LinkedOptions& options, const Progress& progress,
                              LinkedUnknowns& unknowns) {
  const std::vector<Chain> chains = chains_of(problem);
  const Progress alone = progress.part(0, 0).on_one_thread();
  parallel_for_workers(static_cast<int>(chains.size()), progress, [&] {
    return [&, images = SingleImages(problem, sources, options, unknowns)](int k) mutable {
      images.solve(chains[k], alone);
    };
  });
}

}  // namespace episcope
