// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/message_labeling.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/solvers/message_kernel.h"
#include "engine/solvers/shared_constants.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace episcope {
namespace {

constexpr int kTile = 32;

void check(const MessageProblem& problem) {
  const auto& cost = problem.cost;
  const auto fits = [&](ImageView<const float> w) {
    return w.empty() || (w.height == cost.height && w.width == cost.width && w.channels == 1);
  };
  if (cost.empty() || !fits(problem.across) || !fits(problem.down)) {
    throw InvalidInput("labeling by messages needs costs and weights of one size");
  }
  if (cost.layers < 2 || cost.layers > kMostMessageLabels) {
    throw InvalidInput("labeling by messages needs 2 to 512 labels");
  }
  if (!(problem.slope > 0) || !(problem.most > 0)) {
    throw InvalidInput("labeling by messages needs positive costs of differences");
  }
}

class Passing {
 public:
  explicit Passing(const MessageProblem& problem)
      : problem_(problem),
        height_(problem.cost.height),
        width_(problem.cost.width),
        padded_((problem.cost.layers + kMessageLanes - 1) / kMessageLanes * kMessageLanes),
        across_(height_, width_, padded_),
        down_(height_, width_, padded_),
        labels_(height_, width_) {}

  void clear(const Progress& progress) {
    parallel_for(height_, progress, [&](int y) {
      std::fill_n(across_.view().row(y, 0), static_cast<std::size_t>(width_) * padded_, 0.0F);
      std::fill_n(down_.view().row(y, 0), static_cast<std::size_t>(width_) * padded_, 0.0F);
    });
  }

  // To the lower right.
  void sweep_down(const Progress& progress) {
    for_tiles(progress, false, [&](Tile& tile) {
      for (int y = tile.y; y < tile.end_y; ++y) {
        read_costs(tile, y);
        for (int x = tile.x; x < tile.end_x; ++x) {
          MessagePixel pixel = at(tile, y, x);
          if (x + 1 < width_) pixel.passed[0] = {message(across_, y, x), across(y, x)};
          if (y + 1 < height_) pixel.passed[1] = {message(down_, y, x), down(y, x)};
          kernel_.pass(pixel);
        }
      }
    });
  }

  // Labels, each given those to the left and above.
  void read_off(const Progress& progress) {
    for_tiles(progress, false, [&](Tile& tile) {
      for (int y = tile.y; y < tile.end_y; ++y) {
        read_costs(tile, y);
        for (int x = tile.x; x < tile.end_x; ++x) labels_.at(y, x) = choose(at(tile, y, x), y, x);
      }
    });
  }

  // To the upper left. Returns the bound.
  double sweep_up(const Progress& progress) {
    std::vector<double> gains(static_cast<std::size_t>(tiles_down()) * tiles_across());
    for_tiles(progress, true, [&](Tile& tile) {
      for (int y = tile.end_y - 1; y >= tile.y; --y) {
        read_costs(tile, y);
        for (int x = tile.end_x - 1; x >= tile.x; --x) {
          MessagePixel pixel = at(tile, y, x);
          if (x > 0) pixel.passed[0] = {message(across_, y, x - 1), across(y, x - 1)};
          if (y > 0) pixel.passed[1] = {message(down_, y - 1, x), down(y - 1, x)};
          gains[tile.index] += kernel_.pass(pixel);
        }
      }
    });
    return std::accumulate(gains.begin(), gains.end(), 0.0);
  }

  [[nodiscard]] double energy() const {
    double sum = 0;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const int label = labels_.at(y, x);
        sum += problem_.cost.at(y, label, x);
        if (x + 1 < width_) sum += across(y, x) * jump(label - labels_.at(y, x + 1));
        if (y + 1 < height_) sum += down(y, x) * jump(label - labels_.at(y + 1, x));
      }
    }
    return sum;
  }

  [[nodiscard]] Image<int> take_labels() { return std::move(labels_); }

 private:
  struct Tile {
    int y = 0, x = 0, end_y = 0, end_x = 0;
    int index = 0;
    std::vector<float> costs;  // Of one row, `[x][label]`.
  };

  [[nodiscard]] int tiles_down() const { return (height_ + kTile - 1) / kTile; }
  [[nodiscard]] int tiles_across() const { return (width_ + kTile - 1) / kTile; }

  // Tiles of one diagonal at a time: each needs what its neighbors of the diagonal before passed.
  template <class Work>
  void for_tiles(const Progress& progress, bool backward, const Work& work) {
    const int rows = tiles_down(), columns = tiles_across(), diagonals = rows + columns - 1;
    for (int i = 0; i < diagonals; ++i) {
      const int diagonal = backward ? diagonals - 1 - i : i;
      const int first = std::max(0, diagonal - columns + 1), last = std::min(diagonal, rows - 1);
      parallel_for(last - first + 1, progress, [&](int k) {
        const FlushDenormals flush;
        const int row = first + k, column = diagonal - row;
        Tile tile{row * kTile,
                  column * kTile,
                  std::min(height_, (row + 1) * kTile),
                  std::min(width_, (column + 1) * kTile),
                  row * columns + column,
                  {}};
        tile.costs.assign(static_cast<std::size_t>(kTile) * padded_, kMessageFiller);
        work(tile);
      });
    }
  }

  void read_costs(Tile& tile, int y) const {
    for (int label = 0; label < problem_.cost.layers; ++label) {
      const float* const row = problem_.cost.row(y, label);
      float* out = tile.costs.data() + label;
      for (int x = tile.x; x < tile.end_x; ++x, out += padded_) *out = row[x];
    }
  }

  [[nodiscard]] float* message(Volume<float>& edges, int y, int x) const {
    return edges.view().row(y, x);
  }
  [[nodiscard]] float across(int y, int x) const {
    return problem_.across.empty() ? 1.0F : problem_.across.at(y, x);
  }
  [[nodiscard]] float down(int y, int x) const {
    return problem_.down.empty() ? 1.0F : problem_.down.at(y, x);
  }
  [[nodiscard]] float jump(int labels) const {
    return std::min(problem_.slope * static_cast<float>(std::abs(labels)), problem_.most);
  }

  MessagePixel at(const Tile& tile, int y, int x) {
    MessagePixel pixel;
    pixel.costs = tile.costs.data() + static_cast<std::size_t>(x - tile.x) * padded_;
    pixel.received[0] = x > 0 ? message(across_, y, x - 1) : nullptr;
    pixel.received[1] = y > 0 ? message(down_, y - 1, x) : nullptr;
    pixel.received[2] = x + 1 < width_ ? message(across_, y, x) : nullptr;
    pixel.received[3] = y + 1 < height_ ? message(down_, y, x) : nullptr;
    pixel.labels = padded_;
    pixel.slope = problem_.slope;
    pixel.most = problem_.most;
    const int before = (x > 0) + (y > 0), after = (x + 1 < width_) + (y + 1 < height_);
    pixel.share = 1.0F / static_cast<float>(std::max({before, after, 1}));
    return pixel;
  }

  [[nodiscard]] int choose(MessagePixel pixel, int y, int x) const {
    pixel.received[0] = pixel.received[1] = nullptr;
    const int before[2] = {x > 0 ? labels_.at(y, x - 1) : -1, y > 0 ? labels_.at(y - 1, x) : -1};
    const float weights[2] = {x > 0 ? across(y, x - 1) : 0, y > 0 ? down(y - 1, x) : 0};
    return kernel_.choose(pixel, before, weights);
  }

  const MessageProblem& problem_;
  const MessageKernel& kernel_ = EPISCOPE_CHOOSE_KERNEL(best_isa(), kMessageKernel);
  int height_, width_, padded_;
  Volume<float> across_, down_;  // `[y][x][label]`, of the edges to the right and below.
  Image<int> labels_;
};

}  // namespace

MessageResult solve_by_messages(const MessageProblem& problem, int iterations,
                                const Progress& progress) {
  check(problem);
  Passing passing(problem);
  const Progress silent = progress.part(0, 0);
  passing.clear(silent);
  MessageResult result;
  while (result.iterations < iterations && !progress.finish_requested()) {
    passing.sweep_down(silent);
    result.bound = passing.sweep_up(silent);
    ++result.iterations;
    progress.report(static_cast<double>(result.iterations) / (iterations + 1));
  }
  passing.read_off(silent);
  result.energy = passing.energy();
  result.labels = passing.take_labels();
  progress.report(1);
  return result;
}

}  // namespace episcope
