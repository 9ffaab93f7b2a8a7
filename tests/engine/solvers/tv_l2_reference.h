// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/solvers/tv_l2.h"

#include <cmath>
#include <vector>

namespace episcope {

/// The simplest solver of TvL2Problem: Chambolle and Pock's first algorithm in double, run for many
/// iterations.
class TvL2Reference {
 public:
  explicit TvL2Reference(const TvL2Problem& problem)
      : height_(problem.f.height), width_(problem.f.width), lambda_(problem.lambda) {
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        f_.push_back(problem.f.at(y, x));
        c_.push_back((problem.w.empty() ? 1.0 : problem.w.at(y, x)) / lambda_);
        g_.push_back(problem.g.empty() ? 1.0 : problem.g.at(y, x));
      }
    }
    u_ = f_;
    px_.assign(f_.size(), 0.0);
    py_ = px_;
  }

  void run(int iterations) {
    const double step = 1 / std::sqrt(8.0);
    std::vector<double> ahead = u_;
    for (int k = 0; k < iterations; ++k) {
      for (int i = 0; i < count(); ++i) {
        const double a = px_[i] + step * right(ahead, i), b = py_[i] + step * down(ahead, i);
        const double scale = std::fmin(1.0, g_[i] / std::fmax(1e-300, std::hypot(a, b)));
        px_[i] = a * scale;
        py_[i] = b * scale;
      }
      for (int i = 0; i < count(); ++i) {
        const double next = (u_[i] + step * (divergence(i) + c_[i] * f_[i])) / (1 + step * c_[i]);
        ahead[i] = 2 * next - u_[i];
        u_[i] = next;
      }
    }
  }

  [[nodiscard]] double energy(ImageView<const float> u) const {
    std::vector<double> values;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) values.push_back(u.at(y, x));
    }
    double sum = 0;
    for (int i = 0; i < count(); ++i) {
      const double off = values[i] - f_[i];
      sum += g_[i] * std::hypot(right(values, i), down(values, i)) + 0.5 * c_[i] * off * off;
    }
    return sum;
  }
  [[nodiscard]] double largest_difference(ImageView<const float> u) const {
    double largest = 0;
    for (int i = 0; i < count(); ++i) {
      largest = std::fmax(largest, std::fabs(u.at(i / width_, i % width_) - u_[i]));
    }
    return largest;
  }

 private:
  [[nodiscard]] int count() const { return height_ * width_; }
  [[nodiscard]] double right(const std::vector<double>& u, int i) const {
    return i % width_ + 1 < width_ ? u[i + 1] - u[i] : 0;
  }
  [[nodiscard]] double down(const std::vector<double>& u, int i) const {
    return i / width_ + 1 < height_ ? u[i + width_] - u[i] : 0;
  }
  [[nodiscard]] double divergence(int i) const {
    return px_[i] - (i % width_ > 0 ? px_[i - 1] : 0) + py_[i] -
           (i >= width_ ? py_[i - width_] : 0);
  }

  int height_, width_;
  double lambda_;
  std::vector<double> f_, c_, g_, u_, px_, py_;
};

}  // namespace episcope
