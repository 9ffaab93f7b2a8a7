// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/metrics/bumpiness.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

int reflected(int i, int size) {
  if (i < 0) return std::min(-i - 1, size - 1);
  return i < size ? i : std::max(2 * size - 1 - i, 0);
}

/// Difference along one axis, [3, 10, 3]/16 across it.
template <bool along_x>
Image<double> scharr(const Image<double>& map) {
  Image<double> result(map.height(), map.width());
  for (int y = 0; y < map.height(); ++y) {
    const double* rows[3] = {map.row(reflected(y - 1, map.height())), map.row(y),
                             map.row(reflected(y + 1, map.height()))};
    for (int x = 0; x < map.width(); ++x) {
      const int left = reflected(x - 1, map.width());
      const int right = reflected(x + 1, map.width());
      const double sum =
          along_x ? 3 * (rows[0][right] - rows[0][left]) + 10 * (rows[1][right] - rows[1][left]) +
                        3 * (rows[2][right] - rows[2][left])
                  : 3 * (rows[2][left] - rows[0][left]) + 10 * (rows[2][x] - rows[0][x]) +
                        3 * (rows[2][right] - rows[0][right]);
      result.at(y, x) = sum / 16;
    }
  }
  return result;
}

}  // namespace

Image<float> hessian_norm(const Image<double>& map) {
  const Image<double> dx = scharr<true>(map);
  const Image<double> dy = scharr<false>(map);
  const Image<double> terms[] = {scharr<true>(dx), scharr<false>(dx), scharr<true>(dy),
                                 scharr<false>(dy)};
  Image<float> norm(map.height(), map.width());
  for (std::size_t i = 0; i < norm.size(); ++i) {
    double sum = 0;
    for (const auto& term : terms) sum += term.data()[i] * term.data()[i];
    norm.data()[i] = static_cast<float>(std::sqrt(sum));
  }
  return norm;
}

}  // namespace episcope
