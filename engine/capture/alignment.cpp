// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/alignment.h"

#include "engine/capture/symmetric_system.h"
#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace episcope::capture {
namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Vector2 = Eigen::Vector2d;

constexpr int kAlignmentRounds = 6;
constexpr int kSweeps = 12;
constexpr double kPointHuber_px = 0.3;
constexpr double kPointOutlierMedians = 6;
constexpr double kTiltPrior = 0.02;  // radian: rotations out of the plane are hardly seen
constexpr double kNoise = 0.05;      // px, of matches
constexpr double kWorstFit = 3;      // px

struct Observation {
  int view;
  int point;
  Vector2 step;  // (u − uc, v − vc)
  Vector2 ray;
  double weight = 1;
};

Matrix3 rotation_of(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0) return Matrix3::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

Vector2 turned(const Matrix3& rotation, const Vector2& ray) {
  const Eigen::Vector3d r = rotation * Eigen::Vector3d(ray.x(), ray.y(), 1);
  return {r.x() / r.z(), r.y() / r.z()};
}

/// Displacements = −parallax·step + offset of the view: solved for both by turns, for one rotation.
class Model {
 public:
  Model(const ViewMatches& matches, const LensCamera& camera)
      : focal_((camera.focal_x + camera.focal_y) / 2),
        parallax_(matches.points.size(), 0.0),
        offsets_(matches.found.size(), Vector2::Zero()) {
    for (const PlanePoint& point : matches.points) {
      const PlanePoint ray = ray_of_pixel(camera, point);
      centers_.emplace_back(ray.x, ray.y);
    }
    const ViewIndex middle = matches.grid.center();
    for (int view = 0; view < matches.grid.count(); ++view) {
      const ViewIndex index = matches.grid.view_at(view);
      const Vector2 step(index.u - middle.u, index.v - middle.v);
      steps_.push_back(step);
      if (index == middle) continue;
      for (std::size_t i = 0; i < matches.points.size(); ++i) {
        const auto& match = matches.found[view][i];
        if (!match) continue;
        const PlanePoint ray = ray_of_pixel(camera, match->place);
        observations_.push_back({view, static_cast<int>(i), step, {ray.x, ray.y}});
      }
    }
  }

  [[nodiscard]] double focal() const { return focal_; }
  [[nodiscard]] const std::vector<double>& parallax() const { return parallax_; }
  [[nodiscard]] const std::vector<Observation>& observations() const { return observations_; }

  [[nodiscard]] Vector2 displacement(const Observation& o, const Matrix3& rotation) const {
    return focal_ * (turned(rotation, o.ray) - turned(rotation, centers_[o.point]));
  }

  /// Of every observation, after parallax and offsets are solved for this rotation.
  Eigen::VectorXd residuals(const Matrix3& rotation) {
    std::vector<Vector2> moved;
    moved.reserve(observations_.size());
    for (const Observation& o : observations_) moved.push_back(displacement(o, rotation));
    for (int sweep = 0; sweep < kSweeps; ++sweep) solve_once(moved);
    Eigen::VectorXd residual(2 * static_cast<long>(observations_.size()));
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      const Observation& o = observations_[i];
      residual.segment<2>(2 * static_cast<long>(i)) =
          moved[i] + parallax_[o.point] * o.step - offsets_[o.view];
    }
    return residual;
  }

  /// Huber's weights; what is far off counts nothing.
  void weigh(const Eigen::VectorXd& residual) {
    const std::vector<double> sizes = sizes_of(residual);
    const double limit = std::max(kPointHuber_px, kPointOutlierMedians * median(sizes));
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const double size = sizes[i];
      observations_[i].weight = size > limit ? 0 : std::min(1.0, kPointHuber_px / size);
    }
  }

  [[nodiscard]] Eigen::VectorXd weighted(const Eigen::VectorXd& residual) const {
    Eigen::VectorXd result = residual;
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      result.segment<2>(2 * static_cast<long>(i)) *= std::sqrt(observations_[i].weight);
    }
    return result;
  }

  static std::vector<double> sizes_of(const Eigen::VectorXd& residual) {
    std::vector<double> sizes;
    for (long i = 0; i + 1 < residual.size(); i += 2)
      sizes.push_back(residual.segment<2>(i).norm());
    return sizes;
  }

 private:
  void solve_once(const std::vector<Vector2>& moved) {
    std::vector<double> pull(parallax_.size(), 0.0);
    std::vector<double> weight(parallax_.size(), 1e-9);
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      const Observation& o = observations_[i];
      pull[o.point] -= o.weight * o.step.dot(moved[i] - offsets_[o.view]);
      weight[o.point] += o.weight * o.step.squaredNorm();
    }
    for (std::size_t i = 0; i < parallax_.size(); ++i) parallax_[i] = pull[i] / weight[i];
    std::vector<Vector2> sum(offsets_.size(), Vector2::Zero());
    std::vector<double> count(offsets_.size(), 1e-9);
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      const Observation& o = observations_[i];
      sum[o.view] += o.weight * (moved[i] + parallax_[o.point] * o.step);
      count[o.view] += o.weight;
    }
    for (std::size_t v = 0; v < offsets_.size(); ++v) offsets_[v] = sum[v] / count[v];
    remove_trend();
  }

  /// Offsets that grow with the step of the grid are parallax.
  void remove_trend() {
    double along = 0;
    double squares = 0;
    for (std::size_t v = 0; v < offsets_.size(); ++v) {
      along += offsets_[v].dot(steps_[v]);
      squares += steps_[v].squaredNorm();
    }
    const double trend = along / squares;
    for (std::size_t v = 0; v < offsets_.size(); ++v) offsets_[v] -= trend * steps_[v];
    for (double& parallax : parallax_) parallax -= trend;
  }

  double focal_;
  std::vector<Vector2> centers_;
  std::vector<Vector2> steps_;  // Of every view.
  std::vector<Observation> observations_;
  std::vector<double> parallax_;
  std::vector<Vector2> offsets_;
};

/// One step of Gauss and Newton on the rotation vector, numerically: parallax and offsets follow.
Eigen::Vector3d rotation_step(Model& model, const Eigen::Vector3d& vector) {
  constexpr double delta = 1e-4;
  const Eigen::VectorXd residual = model.weighted(model.residuals(rotation_of(vector)));
  Eigen::MatrixXd jacobian(residual.size() + 2, 3);
  Eigen::VectorXd all(residual.size() + 2);
  all << residual, vector.head<2>() * kNoise / kTiltPrior;
  jacobian.bottomRows(2).setZero();
  jacobian(residual.size(), 0) = kNoise / kTiltPrior;
  jacobian(residual.size() + 1, 1) = kNoise / kTiltPrior;
  for (int k = 0; k < 3; ++k) {
    Eigen::Vector3d other = vector;
    other[k] += delta;
    const Eigen::VectorXd moved = model.weighted(model.residuals(rotation_of(other)));
    jacobian.col(k).head(residual.size()) = (moved - residual) / delta;
  }
  return -solve_symmetric(jacobian.transpose() * jacobian, jacobian.transpose() * all);
}

/// What each view is off, from what parallax does not explain.
std::vector<ViewCorrection> corrections_of(const Model& model, const Matrix3& rotation,
                                           std::size_t views) {
  using Matrix8 = Eigen::Matrix<double, 8, 8>;
  using Vector8 = Eigen::Matrix<double, 8, 1>;
  std::vector<Matrix8> normal(views, Matrix8::Identity() * 1e-6);
  std::vector<Vector8> right(views, Vector8::Zero());
  // Without enough points that spread, a shift is all that can be told.
  for (auto& matrix : normal) matrix.diagonal().tail<7>().array() += 1e-2;
  for (auto& matrix : normal) matrix(3, 3) = 1e-6;
  for (const Observation& o : model.observations()) {
    const Vector2 off = model.displacement(o, rotation) + model.parallax()[o.point] * o.step;
    const Vector2 ray = turned(rotation, o.ray);
    Eigen::Matrix<double, 2, 8> row;
    row << 1, ray.x(), ray.y(), 0, 0, 0, ray.x() * ray.x(), ray.x() * ray.y(), 0, 0, 0, 1, ray.x(),
        ray.y(), ray.x() * ray.y(), ray.y() * ray.y();
    normal[o.view] += o.weight * row.transpose() * row;
    right[o.view] += o.weight * row.transpose() * off;
  }
  std::vector<ViewCorrection> corrections(views);
  for (std::size_t v = 0; v < views; ++v) {
    Eigen::Map<Vector8>(corrections[v].parameters.data()) = solve_symmetric(normal[v], right[v]);
  }
  return corrections;
}

/// Takes from the parameters what grows along rows or columns; of the shift the parallax has it.
void remove_trends(std::vector<ViewCorrection>& corrections, GridShape grid) {
  const ViewIndex middle = grid.center();
  for (const int k : {1, 2, 4, 5, 6, 7}) {
    Eigen::Matrix2d squares = Eigen::Matrix2d::Identity() * 1e-12;
    Vector2 along = Vector2::Zero();
    const auto step_of = [&](int v) {
      const ViewIndex view = grid.view_at(v);
      return Vector2(view.u - middle.u, view.v - middle.v);
    };
    for (int v = 0; v < grid.count(); ++v) {
      squares += step_of(v) * step_of(v).transpose();
      along += corrections[v].parameters[k] * step_of(v);
    }
    const Vector2 trend = solve_symmetric(squares, along);
    for (int v = 0; v < grid.count(); ++v) {
      corrections[v].parameters[k] -= trend.dot(step_of(v));
    }
  }
}

constexpr int kMostPoints = 900;
constexpr std::size_t kLeastPoints = 30;
constexpr int kSearchRows = 8;  // by which rows of neighbors may differ

cv::Mat matrix_of(const Image<float>& picture) {
  return {picture.height(), picture.width(), CV_32F, const_cast<float*>(picture.data())};
}

std::vector<PlanePoint> corners_of(const Image<float>& picture) {
  constexpr int margin = Patch::kReach + 2;
  if (picture.height() <= 4 * margin || picture.width() <= 4 * margin) return {};
  const cv::Rect inside(margin, margin, picture.width() - 2 * margin,
                        picture.height() - 2 * margin);
  const double distance = std::sqrt(picture.size() / (2.0 * kMostPoints));
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(matrix_of(picture)(inside), corners, kMostPoints, 0.002, distance,
                          cv::noArray(), 5);
  std::vector<PlanePoint> points;
  points.reserve(corners.size());
  for (const cv::Point2f& p : corners) {
    points.push_back({std::round(p.x) + margin, std::round(p.y) + margin});
  }
  return points;
}

/// A point on its way through the grid: it moves by a·du + a⊥·dv, a found by least squares.
struct Track {
  PlanePoint start;
  PlanePoint sum;     ///< Of what pulls on a,
  double weight = 0;  ///< and its weight.

  [[nodiscard]] PlanePoint predicted(double du, double dv) const {
    const double x = sum.x / weight;
    const double y = sum.y / weight;
    return {start.x + x * du - y * dv, start.y + y * du + x * dv};
  }
  void learn(double du, double dv, const PlanePoint& place) {
    const double dx = place.x - start.x;
    const double dy = place.y - start.y;
    sum.x += du * dx + dv * dy;
    sum.y += du * dy - dv * dx;
    weight += du * du + dv * dv;
  }
};

/// The whole pixel at which a neighbor looks like the surroundings of a point.
std::optional<PlanePoint> search(const Image<float>& from, const Image<float>& to,
                                 const PlanePoint& point, int reach_x, int reach_y) {
  constexpr int side = Patch::kSide;
  const int x = static_cast<int>(point.x) - Patch::kReach;
  const int y = static_cast<int>(point.y) - Patch::kReach;
  const cv::Rect whole(0, 0, to.width(), to.height());
  const cv::Rect area =
      cv::Rect(x - reach_x, y - reach_y, side + 2 * reach_x, side + 2 * reach_y) & whole;
  if (area.width < side || area.height < side) return {};
  cv::Mat score;
  cv::matchTemplate(matrix_of(to)(area), matrix_of(from)(cv::Rect(x, y, side, side)), score,
                    cv::TM_CCOEFF_NORMED);
  double best = 0;
  cv::Point place;
  cv::minMaxLoc(score, nullptr, &best, nullptr, &place);
  if (best < 0.8) return {};
  return PlanePoint{static_cast<double>(area.x + place.x + Patch::kReach),
                    static_cast<double>(area.y + place.y + Patch::kReach)};
}

class Matcher {
 public:
  Matcher(const LightField& field, const Progress& progress)
      : field_(field), progress_(progress), center_(gray_view(field, field.center())) {
    for (const PlanePoint& point : corners_of(center_)) {
      tracks_.push_back({point, {}, 0});
      patches_.emplace_back(center_, static_cast<int>(point.y), static_cast<int>(point.x));
    }
  }

  ViewMatches run() {
    start();
    matches_.grid = field_.grid();
    matches_.found.resize(field_.grid().count());
    for (const Track& track : tracks_) matches_.points.push_back(track.start);
    const std::vector<int> order = views_by_distance();
    for (std::size_t i = 0; i < order.size(); ++i) {
      follow(order[i]);
      progress_.report(0.1 + 0.9 * static_cast<double>(i + 1) / static_cast<double>(order.size()));
    }
    return std::move(matches_);
  }

 private:
  /// Parallax to the neighbors of the center; keeps the points that have one.
  void start() {
    const GridShape grid = field_.grid();
    const ViewIndex middle = field_.center();
    const bool has_columns = grid.u > 1;
    const ViewIndex next = has_columns ? ViewIndex{middle.v, middle.u > 0 ? middle.u - 1 : 1}
                                       : ViewIndex{middle.v > 0 ? middle.v - 1 : 1, middle.u};
    if (!grid.contains(next)) throw InvalidInput("there is only one photograph; a grid is needed");
    const Image<float> picture = gray_view(field_, next);
    const int reach = field_.width() / 8;
    parallel_for(static_cast<int>(tracks_.size()), progress_.part(0, 0.1), [&](int i) {
      Track& track = tracks_[i];
      const auto place = search(center_, picture, track.start, has_columns ? reach : kSearchRows,
                                has_columns ? kSearchRows : reach);
      if (place) track.learn(next.u - middle.u, next.v - middle.v, *place);
    });
    keep_started();
  }

  void keep_started() {
    std::vector<Track> tracks;
    std::vector<Patch> patches;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      if (tracks_[i].weight == 0) continue;
      tracks.push_back(tracks_[i]);
      patches.push_back(patches_[i]);
    }
    tracks_ = std::move(tracks);
    patches_ = std::move(patches);
    if (tracks_.size() >= kLeastPoints) return;
    throw InvalidInput(
        "only " + std::to_string(tracks_.size()) +
        " points of the center photograph were found in its neighbor; the photographs lack "
        "texture, overlap too little, or are not in the order of the grid");
  }

  [[nodiscard]] std::vector<int> views_by_distance() const {
    const ViewIndex middle = field_.center();
    std::vector<int> order(field_.grid().count());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
    std::ranges::stable_sort(order, {}, [&](int index) {
      const ViewIndex view = field_.grid().view_at(index);
      const int du = view.u - middle.u;
      const int dv = view.v - middle.v;
      return du * du + dv * dv;
    });
    return order;
  }

  void follow(int index) {
    const ViewIndex view = field_.grid().view_at(index);
    const double du = view.u - field_.center().u;
    const double dv = view.v - field_.center().v;
    progress_.step("matching view " + view_text(view));
    auto& found = matches_.found[index];
    found.resize(tracks_.size());
    if (view == field_.center()) {
      for (std::size_t i = 0; i < tracks_.size(); ++i) found[i] = PatchMatch{tracks_[i].start, 1};
      return;
    }
    const Image<float> picture = gray_view(field_, view);
    parallel_for(static_cast<int>(tracks_.size()), progress_.part(0, 0), [&](int i) {
      Track& track = tracks_[i];
      found[i] = patches_[i].find(picture, track.predicted(du, dv));
      if (found[i]) track.learn(du, dv, found[i]->place);
    });
  }

  const LightField& field_;
  Progress progress_;
  Image<float> center_;
  std::vector<Track> tracks_;
  std::vector<Patch> patches_;
  ViewMatches matches_;
};

constexpr int kMostSteps = 15;
constexpr double kConverged = 2e-3;   // px
constexpr double kFarthest = 2;       // px from the guess
constexpr double kLeastContrast = 2;  // gray levels
constexpr double kAlike = 0.35;       // difference by contrast

/// Weights of Catmull and Rom's cubic.
std::array<float, 4> cubic(double t) {
  const double tt = t * t;
  const double ttt = tt * t;
  return {static_cast<float>((-ttt + 2 * tt - t) / 2),
          static_cast<float>((3 * ttt - 5 * tt + 2) / 2),
          static_cast<float>((-3 * ttt + 4 * tt + t) / 2), static_cast<float>((ttt - tt) / 2)};
}

/// The square of a picture around a place; false if it is not inside.
bool sample(ImageView<const float> picture, const PlanePoint& at,
            std::array<float, Patch::kSide * Patch::kSide>& out) {
  constexpr int side = Patch::kSide;
  const int x0 = static_cast<int>(std::floor(at.x)) - Patch::kReach - 1;
  const int y0 = static_cast<int>(std::floor(at.y)) - Patch::kReach - 1;
  if (x0 < 0 || y0 < 0 || x0 + side + 3 > picture.width || y0 + side + 3 > picture.height) {
    return false;
  }
  const auto wx = cubic(at.x - std::floor(at.x));
  const auto wy = cubic(at.y - std::floor(at.y));
  float rows[side + 3][side];
  for (int y = 0; y < side + 3; ++y) {
    const float* row = picture.row(y0 + y) + x0;
    for (int x = 0; x < side; ++x) {
      rows[y][x] = wx[0] * row[x] + wx[1] * row[x + 1] + wx[2] * row[x + 2] + wx[3] * row[x + 3];
    }
  }
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      out[y * side + x] = wy[0] * rows[y][x] + wy[1] * rows[y + 1][x] + wy[2] * rows[y + 2][x] +
                          wy[3] * rows[y + 3][x];
    }
  }
  return true;
}

}  // namespace

double Alignment::roll_degrees() const {
  return std::atan2(rotation[3], rotation[0]) * 180 / std::numbers::pi;
}

Alignment align(const ViewMatches& matches, const LensCamera& camera) {
  Model model(matches, camera);
  const ViewIndex middle = matches.grid.center();
  const auto center = static_cast<std::size_t>(middle.v) * matches.grid.u + middle.u;
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  for (int round = 0; round < kAlignmentRounds; ++round) {
    vector += rotation_step(model, vector);
    model.weigh(model.residuals(rotation_of(vector)));
  }
  const Matrix3 rotation = rotation_of(vector);
  std::vector<double> sizes = Model::sizes_of(model.residuals(rotation));
  Alignment alignment;
  alignment.residual_px = median(sizes);
  if (!(alignment.residual_px < kWorstFit)) {
    throw InvalidInput("the photographs do not lie on a grid: points are " +
                       std::to_string(alignment.residual_px) +
                       " px off; check the order of the files, and that the camera fits them");
  }
  Eigen::Map<Matrix3>(alignment.rotation.data()) = rotation;
  alignment.focal_px = model.focal();
  alignment.parallax = model.parallax();
  alignment.corrections = corrections_of(model, rotation, matches.found.size());
  alignment.corrections[center] = {};
  remove_trends(alignment.corrections, matches.grid);
  return alignment;
}

ViewMatches match_views(const LightField& field, const Progress& progress) {
  return Matcher(field, progress).run();
}

std::vector<double> vertical_disparities(const ViewMatches& matches) {
  std::vector<double> differences;
  for (int v = 0; v < matches.grid.v; ++v) {
    for (int u = 0; u + 1 < matches.grid.u; ++u) {
      const auto& left = matches.of({v, u});
      const auto& right = matches.of({v, u + 1});
      for (std::size_t i = 0; i < left.size(); ++i) {
        if (!left[i] || !right[i]) continue;
        differences.push_back(std::abs(left[i]->place.y - right[i]->place.y));
      }
    }
  }
  std::ranges::sort(differences);
  return differences;
}

std::vector<double> view_gains(const ViewMatches& matches) {
  std::vector<double> gains;
  for (const auto& view : matches.found) {
    std::vector<double> of_view;
    for (const auto& match : view) {
      if (match) of_view.push_back(match->gain);
    }
    std::ranges::sort(of_view);
    gains.push_back(of_view.empty() ? 1 : of_view[of_view.size() / 2]);
  }
  return gains;
}

Patch::Patch(ImageView<const float> picture, int y, int x) {
  Eigen::Matrix<double, kCount, 4> jacobian;
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < kCount; ++i) {
    const int py = y + i / kSide - kReach;
    const int px = x + i % kSide - kReach;
    const double value = picture.at(py, px);
    template_[i] = static_cast<float>(value);
    jacobian.row(i) << (picture.at(py, px + 1) - picture.at(py, px - 1)) / 2,
        (picture.at(py + 1, px) - picture.at(py - 1, px)) / 2, value, 1;
    sum += value;
    squares += value * value;
  }
  contrast_ = std::sqrt(std::max(0.0, squares / kCount - (sum / kCount) * (sum / kCount)));
  const Eigen::MatrixXd update =
      solve_symmetric(jacobian.transpose() * jacobian, jacobian.transpose(), 1e-14);
  if (contrast_ < kLeastContrast || update.size() == 0) {
    contrast_ = 0;
    return;
  }
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < kCount; ++i) update_[k][i] = static_cast<float>(update(k, i));
  }
}

std::optional<PatchMatch> Patch::find(ImageView<const float> picture,
                                      const PlanePoint& guess) const {
  if (contrast_ == 0) return {};
  std::array<float, kCount> seen;
  PlanePoint at = guess;
  double gain = 1;
  double offset = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    if (!sample(picture, at, seen)) return {};
    double by[4] = {};
    double squares = 0;
    for (int i = 0; i < kCount; ++i) {
      const float error =
          seen[i] - static_cast<float>(gain) * template_[i] - static_cast<float>(offset);
      squares += static_cast<double>(error) * error;
      for (int k = 0; k < 4; ++k) by[k] += update_[k][i] * error;
    }
    at.x -= by[0];
    at.y -= by[1];
    gain += by[2];
    offset += by[3];
    const double off = std::hypot(at.x - guess.x, at.y - guess.y);
    if (!(off <= kFarthest) || gain < 0.3 || gain > 3) return {};
    if (std::hypot(by[0], by[1]) > kConverged) continue;
    const bool is_alike = std::sqrt(squares / kCount) < kAlike * contrast_ * gain;
    return is_alike ? std::optional(PatchMatch{at, gain}) : std::nullopt;
  }
  return {};
}

Image<float> gray_view(const LightField& field, ViewIndex view) {
  constexpr double sigma = 0.8;
  const Image<float> samples = field.view_as_float(view);
  Image<float> gray(samples.height(), samples.width());
  for (int y = 0; y < gray.height(); ++y) {
    for (int x = 0; x < gray.width(); ++x) {
      float sum = 0;
      for (int c = 0; c < samples.channels(); ++c) sum += samples.at(y, x, c);
      gray.at(y, x) = sum * 255 / static_cast<float>(samples.channels());
    }
  }
  cv::Mat picture(gray.height(), gray.width(), CV_32F, gray.data());
  cv::GaussianBlur(picture, picture, {5, 5}, sigma);
  return gray;
}

}  // namespace episcope::capture
