// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/plenoptic/lens_grid.h"

#include "engine/capture/symmetric_system.h"
#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"

#include <fmt/format.h>
#include <Eigen/LU>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <utility>

namespace episcope::capture {
namespace {

using Vector2 = Eigen::Vector2d;
using Matrix2 = Eigen::Matrix2d;

constexpr double kSmallestPitch = 3.5;  // px; below, a lens has no inner pixels
constexpr int kLargestCrop = 1024;      // px, of the spectrum
constexpr int kSmallestCrop = 64;
constexpr int kPeriods = 5;               // the fewest that a crop shows
constexpr std::size_t kMeasured = 60000;  // lenses; more add nothing to a polynomial
constexpr double kOneLens = 0.95;         // radius around a lens, in pitches
constexpr double kManyLenses = 16;
constexpr double kSomeLenses = 8;
constexpr std::size_t kCompared = 100;
constexpr int kSmooth = 11;  // px; edges of larger lenses remain
constexpr std::size_t kMeasuredScene = 600;
constexpr std::size_t kLensesForCubic = 300;
constexpr double kFaintest = 0.002;      // amplitude of the lattice over the mean
constexpr double kWorstResidual = 0.03;  // of the pitch
// Of a scene: photographs have 0.023 and more, but in the square lattices that they show.
constexpr double kWorstOfSquareScene = 0.02, kWorstOfHexagonalScene = 0.07;
constexpr std::size_t kFewestOfScene = 100;  // in fewer, windows overlap so much that all agree
constexpr double kFewestInliers = 0.6;       // of the lenses that the lattice has there

[[noreturn]] void refuse(const std::string& why) {
  throw InvalidInput("no array of microlenses was found in this picture: " + why +
                     "; use a white picture of this camera");
}

// ------------------------------------------------------------- the lattice out of the spectrum

struct Peak {
  Vector2 frequency;  // cycles per px
  double power = 0;
};

/// Power of the middle of the picture, its slow part removed; zero frequency in the middle.
cv::Mat spectrum_of(const Image<float>& picture, int size) {
  const cv::Mat whole(picture.height(), picture.width(), CV_32F,
                      const_cast<float*>(picture.data()));
  const cv::Rect middle((picture.width() - size) / 2, (picture.height() - size) / 2, size, size);
  cv::Mat crop = whole(middle).clone();
  const double mean = cv::mean(crop)[0];
  if (mean > 0) crop /= mean;
  cv::Mat slow;
  cv::blur(crop, slow, {size / 8 | 1, size / 8 | 1}, {-1, -1}, cv::BORDER_REFLECT);
  crop -= slow;
  cv::Mat window;
  cv::createHanningWindow(window, crop.size(), CV_32F);
  crop = crop.mul(window);
  cv::Mat transformed;
  cv::dft(crop, transformed, cv::DFT_COMPLEX_OUTPUT);
  std::vector<cv::Mat> parts;
  cv::split(transformed, parts);
  cv::Mat power = parts[0].mul(parts[0]) + parts[1].mul(parts[1]);
  const int half = size / 2;
  cv::Mat centered(power.size(), CV_32F);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      centered.at<float>((y + half) % size, (x + half) % size) = power.at<float>(y, x);
    }
  }
  return centered;
}

/// Offset of the top of a parabola through the logarithms of three neighbors.
double top_of(double before, double here, double after) {
  const double a = std::log(before + 1e-30), b = std::log(here + 1e-30),
               c = std::log(after + 1e-30);
  const double bend = a - 2 * b + c;
  return bend < 0 ? std::clamp(0.5 * (a - c) / bend, -0.5, 0.5) : 0;
}

/// Peaks of the upper half plane, the strongest first.
std::vector<Peak> peaks_of(const cv::Mat& power) {
  const int size = power.rows, half = size / 2;
  std::vector<Peak> peaks;
  for (int y = 1; y <= half; ++y) {
    for (int x = 1; x < size - 1; ++x) {
      const Vector2 f(static_cast<double>(x - half) / size, static_cast<double>(y - half) / size);
      if (f.norm() * size < kPeriods || f.norm() > 1 / kSmallestPitch) continue;
      if (y == half && x < half) continue;
      const float here = power.at<float>(y, x);
      bool is_top = true;
      for (int k = 0; k < 9 && is_top; ++k) {
        is_top = k == 4 || power.at<float>(y + k / 3 - 1, x + k % 3 - 1) <= here;
      }
      if (!is_top) continue;
      const double dx = top_of(power.at<float>(y, x - 1), here, power.at<float>(y, x + 1));
      const double dy = top_of(power.at<float>(y - 1, x), here, power.at<float>(y + 1, x));
      peaks.push_back({f + Vector2(dx, dy) / size, here});
    }
  }
  std::ranges::sort(peaks, std::greater<>(), &Peak::power);
  return peaks;
}

/// Angle between two directions without sign, in degrees up to 90.
double angle_between(const Vector2& a, const Vector2& b) {
  const double cosine = std::abs(a.dot(b)) / (a.norm() * b.norm());
  return std::acos(std::min(cosine, 1.0)) * 180 / std::numbers::pi;
}

struct Lattice {
  LensLattice kind = LensLattice::Square;
  Vector2 a;  // to the right (down, along columns)
  Vector2 b;  // to the next row, below (to the right)
  bool has_columns = false;
  /// Base frequencies, and for a hexagonal lattice the third one.
  [[nodiscard]] std::vector<Vector2> frequencies() const {
    Matrix2 steps;
    steps << a, b;
    const Matrix2 dual = steps.inverse();
    std::vector<Vector2> all{dual.row(0).transpose(), dual.row(1).transpose()};
    if (kind == LensLattice::Hexagonal) all.emplace_back(all[0] + all[1]);
    return all;
  }
};

/// The two shortest independent vectors of the lattice with these base vectors, the first one near
/// the x axis, or of a hexagonal lattice near the y axis.
Lattice oriented(LensLattice kind, const Matrix2& steps) {
  std::vector<Vector2> vectors;
  for (int i = -2; i <= 2; ++i) {
    for (int j = -2; j <= 2; ++j) {
      if (i != 0 || j != 0) vectors.emplace_back(steps * Vector2(i, j));
    }
  }
  std::ranges::sort(vectors, {}, [](const Vector2& v) { return v.norm(); });
  vectors.resize(kind == LensLattice::Hexagonal ? 6 : 4);
  const Vector2 right =
      *std::ranges::max_element(vectors, {}, [](const Vector2& v) { return v.x(); });
  const Vector2 down =
      *std::ranges::max_element(vectors, {}, [](const Vector2& v) { return v.y(); });
  const bool has_columns = kind == LensLattice::Hexagonal && down.y() > right.x();
  const Vector2 a = has_columns ? down : right;
  // Of the vectors below (right), the one that leans by half a pitch along a, or not at all.
  const double lean = kind == LensLattice::Hexagonal ? 0.5 : 0;
  const Vector2 normal = Vector2(-a.y(), a.x()) / (has_columns ? -a.norm() : a.norm());
  const Vector2 wanted = lean * a + normal * a.norm() * std::sqrt(1 - lean * lean);
  const Vector2 b =
      *std::ranges::min_element(vectors, {}, [&](const Vector2& v) { return (v - wanted).norm(); });
  return {kind, a, b, has_columns};
}

/// Whether two frequencies can span a lattice of lenses.
bool can_span(const Vector2& a, const Vector2& b) {
  const double ratio = a.norm() / b.norm();
  const double angle = angle_between(a, b);
  return ratio > 0.9 && ratio < 1.12 && (std::abs(angle - 60) < 8 || angle > 80);
}

/// Whether the third base frequency of a hexagonal lattice is there, too: sum or difference of two.
bool has_third(const std::vector<Vector2>& frequencies, const Vector2& a, const Vector2& b) {
  const Vector2 third = a.dot(b) < 0 ? Vector2(a + b) : Vector2(a - b);
  return std::ranges::any_of(frequencies, [&](const Vector2& f) {
    return std::min((f - third).norm(), (f + third).norm()) < 0.04 * a.norm();
  });
}

/// The coarsest lattice whose base frequencies are peaks and of which the strongest peak is a
/// harmonic: lenses that touch each other have stronger harmonics than base frequencies.
Lattice lattice_of(const std::vector<Peak>& peaks) {
  constexpr double kShare = 0.05;  // of the power of the strongest
  constexpr double kWhole = 0.06;  // of a base frequency
  const Vector2 strongest = peaks.front().frequency;
  std::vector<Vector2> some;
  for (const Peak& peak : peaks) {
    const bool is_base = peak.power > kShare * peaks.front().power &&
                         peak.frequency.norm() > 0.45 * strongest.norm() &&
                         peak.frequency.norm() < 1.1 * strongest.norm();
    if (is_base && some.size() < 40) some.push_back(peak.frequency);
  }
  std::ranges::sort(some, {}, [](const Vector2& f) { return f.norm(); });
  for (std::size_t j = 1; j < some.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      if (!can_span(some[i], some[j])) continue;
      Matrix2 base;
      base << some[i].transpose(), some[j].transpose();
      const Vector2 order = base.transpose().inverse() * strongest;
      if ((order - order.array().round().matrix()).cwiseAbs().maxCoeff() > kWhole) continue;
      const bool is_hexagonal = angle_between(some[i], some[j]) < 75;
      if (is_hexagonal && !has_third(some, some[i], some[j])) continue;
      return oriented(is_hexagonal ? LensLattice::Hexagonal : LensLattice::Square, base.inverse());
    }
  }
  refuse("its strongest pattern repeats in one direction alone");
}

Lattice find_lattice(const Image<float>& picture) {
  int size = kSmallestCrop;
  const int side = std::min(picture.width(), picture.height());
  if (side < size) refuse(fmt::format("it has only {}×{} px", picture.width(), picture.height()));
  while (2 * size <= std::min(side, kLargestCrop)) size *= 2;
  const std::vector<Peak> peaks = peaks_of(spectrum_of(picture, size));
  // A wave of relative amplitude m has a peak of (m·size²/8)² behind a Hann window.
  const double least = std::pow(kFaintest * size * size / 8, 2);
  if (peaks.empty() || peaks.front().power < least) refuse("it is even");
  return lattice_of(peaks);
}

// ---------------------------------------------------------------- the place of a single lens

/// A picture over its means in squares of `size` px around each pixel: of a scene, mainly the
/// lenses are left.
Image<float> leveled(const Image<float>& picture, int size) {
  const cv::Mat whole(picture.height(), picture.width(), CV_32F,
                      const_cast<float*>(picture.data()));
  cv::Mat means;
  cv::blur(whole, means, {size, size}, {-1, -1}, cv::BORDER_REFLECT);
  const double least = 0.05 * cv::mean(whole)[0] + 1e-9;
  Image<float> result(picture.height(), picture.width());
  cv::divide(whole, cv::max(means, least),
             cv::Mat(picture.height(), picture.width(), CV_32F, result.data()));
  return result;
}

/// Measures where the lens near a place stands: the phases of the base frequencies in a window
/// around it. What is even within a pitch has no effect.
class LensMeter {
 public:
  /// `reach`: radius of the window, in pitches.
  LensMeter(const Image<float>& picture, const Lattice& lattice, double reach)
      : picture_(picture), frequencies_(lattice.frequencies()), radius_(reach * lattice.a.norm()) {
    Eigen::MatrixX2d rows(frequencies_.size(), 2);
    for (std::size_t k = 0; k < frequencies_.size(); ++k) {
      rows.row(static_cast<Eigen::Index>(k)) = frequencies_[k].transpose();
    }
    solve_ = (rows.transpose() * rows).inverse() * rows.transpose();
  }

  [[nodiscard]] bool has_room(const Vector2& at) const {
    return at.x() >= radius_ && at.y() >= radius_ && at.x() <= picture_.width() - 1 - radius_ &&
           at.y() <= picture_.height() - 1 - radius_;
  }

  /// Nothing where the picture shows no lens. Precondition: has_room(start).
  [[nodiscard]] std::optional<Vector2> measure(const Vector2& start) const {
    Vector2 at = start;
    for (int round = 0; round < 3; ++round) {
      if (!has_room(at)) return {};
      const std::optional<Vector2> step = step_from(at);
      if (!step) return {};
      at += *step;
      if (step->norm() < 1e-3) break;
    }
    return at;
  }

 private:
  [[nodiscard]] std::optional<Vector2> step_from(const Vector2& at) const {
    std::array<std::complex<double>, 3> sums{}, weights{};
    double light = 0, all = 0;
    const int y0 = static_cast<int>(std::ceil(at.y() - radius_));
    const int y1 = static_cast<int>(std::floor(at.y() + radius_));
    for (int y = y0; y <= y1; ++y) {
      const double dy = y - at.y();
      const double reach = std::sqrt(std::max(0.0, radius_ * radius_ - dy * dy));
      const int x0 = static_cast<int>(std::ceil(at.x() - reach));
      const int x1 = static_cast<int>(std::floor(at.x() + reach));
      std::array<std::complex<double>, 3> wave, turn;
      for (std::size_t k = 0; k < frequencies_.size(); ++k) {
        const Vector2& f = frequencies_[k];
        wave[k] = std::polar(1.0, 2 * std::numbers::pi * (f.x() * (x0 - at.x()) + f.y() * dy));
        turn[k] = std::polar(1.0, 2 * std::numbers::pi * f.x());
      }
      const float* row = picture_.row(y);
      for (int x = x0; x <= x1; ++x) {
        const double dx = x - at.x();
        const double fall = 1 - (dx * dx + dy * dy) / (radius_ * radius_);
        const double weight = fall * fall;
        const double value = weight * row[x];
        light += value;
        all += weight;
        for (std::size_t k = 0; k < frequencies_.size(); ++k) {
          sums[k] += value * wave[k];
          weights[k] += weight * wave[k];
          wave[k] *= turn[k];
        }
      }
    }
    const double mean = light / all;
    Eigen::VectorXd phases(frequencies_.size());
    for (std::size_t k = 0; k < frequencies_.size(); ++k) {
      const std::complex<double> sum = sums[k] - mean * weights[k];
      if (!(std::abs(sum) > 1e-3 * light)) return {};
      phases(static_cast<Eigen::Index>(k)) = std::arg(sum) / (2 * std::numbers::pi);
    }
    // The third phase is the sum of the others, but for whole turns.
    if (phases.size() == 3) phases(2) += std::round(phases(0) + phases(1) - phases(2));
    return Vector2(solve_ * phases);
  }

  const Image<float>& picture_;
  std::vector<Vector2> frequencies_;
  double radius_;
  Eigen::Matrix2Xd solve_;
};

// -------------------------------------------------------------------------------- the fit

struct Measured {
  double i = 0;
  double j = 0;
  Vector2 at;
  bool is_used = true;
};

int term_count(int degree) {
  return (degree + 1) * (degree + 2) / 2;
}

/// The terms i^p·j^q in the order of LensGrid::terms.
void fill_terms(int degree, double i, double j, double* out) {
  for (int sum = 0; sum <= degree; ++sum) {
    for (int q = 0; q <= sum; ++q) *out++ = std::pow(i, sum - q) * std::pow(j, q);
  }
}

void fit_terms(LensGrid& grid, const std::vector<Measured>& lenses) {
  const int terms = term_count(grid.degree);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(terms, terms);
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(terms, 2);
  Eigen::VectorXd row(terms);
  for (const Measured& lens : lenses) {
    if (!lens.is_used) continue;
    fill_terms(grid.degree, lens.i / grid.scale, lens.j / grid.scale, row.data());
    normal += row * row.transpose();
    right += row * lens.at.transpose();
  }
  const Eigen::MatrixX2d solved = solve_symmetric(normal, right);
  grid.terms.resize(terms);
  for (int k = 0; k < terms; ++k) grid.terms[k] = {solved(k, 0), solved(k, 1)};
}

/// Fits, leaves out lenses that lie beyond 4 times the median distance, and fits again.
void fit_robustly(LensGrid& grid, std::vector<Measured>& lenses) {
  for (int round = 0; round < 4; ++round) {
    fit_terms(grid, lenses);
    std::vector<double> distances;
    for (const Measured& lens : lenses) {
      const PlanePoint fitted = grid.center(lens.i, lens.j);
      distances.push_back((lens.at - Vector2(fitted.x, fitted.y)).norm());
    }
    const double limit = 4 * median(distances) + 1e-3;
    double sum = 0;
    grid.lenses = 0;
    for (std::size_t k = 0; k < lenses.size(); ++k) {
      lenses[k].is_used = distances[k] <= limit;
      if (!lenses[k].is_used) continue;
      sum += distances[k] * distances[k];
      ++grid.lenses;
    }
    grid.residual_px = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(grid.lenses, 1)));
  }
  grid.measured = lenses.size();
}

/// Grid positions within `reach` of the middle whose lens the picture can show, thinned out evenly.
std::vector<Measured> places(const LensGrid& grid, const LensMeter& meter, const Vector2& middle,
                             double reach, std::size_t most_measured) {
  const int most = static_cast<int>(reach / std::min(grid.row_distance_px, grid.pitch_px)) + 2;
  std::vector<Measured> all;
  for (int j = -most; j <= most; ++j) {
    const double lean = grid.lattice == LensLattice::Hexagonal ? j / 2.0 : 0;
    for (int c = -most; c <= most; ++c) {
      const double i = c - std::floor(lean);
      const PlanePoint at = grid.center(i, j);
      const Vector2 place(at.x, at.y);
      if ((place - middle).norm() <= reach && meter.has_room(place))
        all.push_back({i, double(j), place});
    }
  }
  if (all.size() <= most_measured) return all;
  std::vector<Measured> some;
  const double step = static_cast<double>(all.size()) / static_cast<double>(most_measured);
  for (double k = 0; k < static_cast<double>(all.size()); k += step) {
    some.push_back(all[static_cast<std::size_t>(k)]);
  }
  return some;
}

std::vector<Measured> measured(std::vector<Measured> lenses, const LensMeter& meter,
                               const Progress& progress) {
  constexpr int kBlock = 64;
  const int blocks = static_cast<int>((lenses.size() + kBlock - 1) / kBlock);
  parallel_for(blocks, progress, [&](int block) {
    const std::size_t end = std::min(lenses.size(), (block + std::size_t{1}) * kBlock);
    for (std::size_t k = static_cast<std::size_t>(block) * kBlock; k < end; ++k) {
      const std::optional<Vector2> at = meter.measure(lenses[k].at);
      lenses[k].is_used = at.has_value();
      if (at) lenses[k].at = *at;
    }
  });
  std::erase_if(lenses, [](const Measured& lens) { return !lens.is_used; });
  return lenses;
}

/// To the next lens of the row and to the next row, from the first lens.
std::pair<Vector2, Vector2> steps_of(const LensGrid& grid) {
  const PlanePoint here = grid.center(0, 0), right = grid.center(1, 0), below = grid.center(0, 1);
  return {{right.x - here.x, right.y - here.y}, {below.x - here.x, below.y - here.y}};
}

void describe(LensGrid& grid) {
  const auto [a, b] = steps_of(grid);
  grid.pitch_px = a.norm();
  grid.row_distance_px = std::abs(a.x() * b.y() - a.y() * b.x()) / a.norm();
  const double angle = grid.has_columns ? std::atan2(-a.x(), a.y()) : std::atan2(a.y(), a.x());
  grid.rotation_degrees = angle * 180 / std::numbers::pi;
}

LensGrid first_guess(const Lattice& lattice, const LensMeter& meter, const Vector2& middle) {
  LensGrid grid;
  grid.lattice = lattice.kind;
  grid.has_columns = lattice.has_columns;
  const Vector2 start = meter.measure(middle).value_or(middle);
  grid.terms = {
      {start.x(), start.y()}, {lattice.a.x(), lattice.a.y()}, {lattice.b.x(), lattice.b.y()}};
  describe(grid);
  return grid;
}

}  // namespace

PlanePoint LensGrid::center(double i, double j) const {
  const double x = i / scale, y = j / scale;
  PlanePoint at{0, 0};
  std::size_t term = 0;
  for (int sum = 0; sum <= degree; ++sum) {
    for (int q = 0; q <= sum; ++q) {
      double power = 1;
      for (int k = 0; k < sum - q; ++k) power *= x;
      for (int k = 0; k < q; ++k) power *= y;
      at.x += terms[term].x * power;
      at.y += terms[term].y * power;
      ++term;
    }
  }
  return at;
}

LensGrid fit_lens_grid(const Image<float>& picture, const Progress& progress, LensLight light) {
  progress.step("finding the lenses");
  const bool is_scene = light == LensLight::Scene;
  const Lattice lattice = find_lattice(is_scene ? leveled(picture, kSmooth) : picture);
  const Image<float> lenses =
      is_scene ? leveled(picture, static_cast<int>(lattice.a.norm() / 2) | 1) : Image<float>();
  const Vector2 middle((picture.width() - 1) / 2.0, (picture.height() - 1) / 2.0);
  const double room = 0.6 * std::min(middle.x(), middle.y()) / lattice.a.norm();
  const LensMeter meter(is_scene ? lenses : picture, lattice,
                        is_scene ? std::min(kManyLenses, room) : kOneLens);
  if (!meter.has_room(middle)) refuse("its strongest pattern is too coarse");
  LensGrid grid = first_guess(lattice, meter, middle);
  // A fit of a part predicts the next larger part to a fraction of the pitch.
  const double corner = middle.norm();
  double expected = 0;
  for (double reach = 8 * grid.pitch_px;; reach *= 2) {
    const bool is_all = reach >= corner;
    const std::size_t most = is_scene ? kMeasuredScene : kMeasured;
    std::vector<Measured> centers = places(grid, meter, middle, reach, most);
    expected = static_cast<double>(centers.size());
    centers = measured(std::move(centers), meter, is_all ? progress : progress.part(0, 0));
    if (centers.size() < 6) refuse("too few lenses show");
    // Of a scene, what is bent cannot be told from what texture disturbs.
    if (is_all && !is_scene && centers.size() >= kLensesForCubic) grid.degree = 3;
    grid.scale = std::max(1.0, reach / grid.pitch_px);
    fit_robustly(grid, centers);
    describe(grid);
    if (is_all) break;
  }
  if (is_scene && grid.measured < kFewestOfScene) {
    refuse(fmt::format("its strongest pattern, of {:.2f} px, is too coarse to be told from texture",
                       grid.pitch_px));
  }
  const double worst = !is_scene                             ? kWorstResidual
                       : grid.lattice == LensLattice::Square ? kWorstOfSquareScene
                                                             : kWorstOfHexagonalScene;
  if (grid.residual_px > worst * grid.pitch_px ||
      static_cast<double>(grid.lenses) < kFewestInliers * expected) {
    refuse(fmt::format("the strongest pattern, of {:.2f} px, fits at {} of {} places, to {:.2f} px",
                       grid.pitch_px, grid.lenses, expected, grid.residual_px));
  }
  return grid;
}

double distance_from_lenses(const Image<float>& picture, const LensGrid& grid,
                            const Progress& progress) {
  const auto [a, b] = steps_of(grid);
  const Lattice lattice{grid.lattice, a, b, grid.has_columns};
  const Image<float> lenses = leveled(picture, static_cast<int>(grid.pitch_px / 2) | 1);
  const Vector2 middle((picture.width() - 1) / 2.0, (picture.height() - 1) / 2.0);
  const double room = 0.6 * std::min(middle.x(), middle.y()) / grid.pitch_px;
  const LensMeter meter(lenses, lattice, std::min(kSomeLenses, room));
  const std::vector<Measured> all = places(grid, meter, middle, middle.norm(), kCompared);
  std::vector<double> distances(all.size(), grid.pitch_px / 2);
  parallel_for(static_cast<int>(all.size()), progress, [&](int k) {
    if (const auto at = meter.measure(all[k].at)) distances[k] = (*at - all[k].at).norm();
  });
  return all.empty() ? 0 : quantile(distances, 0.25);
}

LensBlock lens_block(const LensGrid& grid, int height, int width, double border) {
  const auto is_inside = [&](double column, int row) {
    const PlanePoint at = grid.center(lens_at(grid, column, row), row);
    return at.x >= border && at.y >= border && at.x <= width - 1 - border &&
           at.y <= height - 1 - border;
  };
  // Columns inside the picture, of rows up or down from the middle.
  using Reach = std::pair<int, int>;
  const auto reaches = [&](int row, int step) {
    std::vector<Reach> all;
    for (; is_inside(0, row); row += step) {
      Reach reach{0, 0};
      while (is_inside(reach.first - 1, row)) --reach.first;
      while (is_inside(reach.second + 1, row)) ++reach.second;
      all.push_back(reach);
    }
    return all;
  };
  const auto both = [](const Reach& a, const Reach& b) {
    return Reach(std::max(a.first, b.first), std::min(a.second, b.second));
  };
  const std::vector<Reach> above = reaches(0, -1), below = reaches(0, 1);
  LensBlock best{0, 1, 0, 0};
  Reach upper{-(1 << 20), 1 << 20};
  for (int up = 0; up < static_cast<int>(above.size()); ++up) {
    upper = both(upper, above[up]);
    Reach all = upper;
    for (int down = 0; down < static_cast<int>(below.size()); ++down) {
      all = both(all, below[down]);
      const int rows = up + down + 1;
      const double columns = all.second - all.first;
      if (rows * (columns + 1) <= best.rows * (best.columns + 1)) continue;
      best = {-up, rows, static_cast<double>(all.first), columns};
    }
  }
  return best;
}

}  // namespace episcope::capture
