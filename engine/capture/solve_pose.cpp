// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/solve_pose.h"

#include "engine/capture/symmetric_system.h"
#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/core/text.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/base/json.h"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <random>

namespace episcope::capture {
namespace {

/// How points of a mesh lie.
enum class PointLayout { Line, Plane, Space };

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double kFlat = 0.01;
constexpr int kMostSubsets = 60;

Eigen::Vector3d place_of(const PointPair& pair) {
  return {pair.point.x, pair.point.y, pair.point.z};
}

/// The ray (x, y, 1) of a pick.
Eigen::Vector2d ray_of(const PointPair& pair, const Pinhole& pinhole) {
  return {(pair.x_px - pinhole.center_x) / pinhole.focal_px,
          (pair.y_px - pinhole.center_y) / pinhole.focal_px};
}

RigidPose rigid(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
  RigidPose pose;
  Eigen::Map<Matrix3>(pose.rotation.data()) = rotation;
  Eigen::Map<Eigen::Vector3d>(pose.translation.data()) = translation;
  return pose;
}

std::optional<RigidPose> by_opencv(std::span<const PointPair> pairs, const Pinhole& pinhole,
                                   cv::SolvePnPMethod method) {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> rays;
  for (const PointPair& pair : pairs) {
    const Eigen::Vector2d ray = ray_of(pair, pinhole);
    points.emplace_back(pair.point.x, pair.point.y, pair.point.z);
    rays.emplace_back(ray.x(), ray.y());
  }
  cv::Mat axis, shift, rotation;
  try {
    const auto camera = cv::Mat::eye(3, 3, CV_64F);
    if (!cv::solvePnP(points, rays, camera, cv::noArray(), axis, shift, false, method)) return {};
    cv::Rodrigues(axis, rotation);
  } catch (const cv::Exception&) {
    return {};
  }
  return rigid(Eigen::Map<const Matrix3>(rotation.ptr<double>()),
               Eigen::Map<const Eigen::Vector3d>(shift.ptr<double>()));
}

// By the extents along their principal axes: a direction counts from 1 % of the longest.
PointLayout layout_of(std::span<const PointPair> pairs) {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const PointPair& pair : pairs) center += place_of(pair);
  center /= static_cast<double>(pairs.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const PointPair& pair : pairs) {
    const Eigen::Vector3d from = place_of(pair) - center;
    scatter += from * from.transpose();
  }
  cv::Vec3d extents;  // Squared, from the longest on.
  cv::eigen(cv::Mat(3, 3, CV_64F, scatter.data()), extents);
  if (extents[1] < kFlat * kFlat * extents[0]) return PointLayout::Line;
  return extents[2] < kFlat * kFlat * extents[0] ? PointLayout::Plane : PointLayout::Space;
}

// First poses of all pairs, by the homography of points in a plane or the direct linear transform
// of at least 6 in space, and by SQPnP (Terzakis, Lourakis: A consistently fast and globally
// optimal solution to the perspective-n-point problem, ECCV 2020). Also of subsets, so that wrong
// picks do not spoil all: at most 60 sets of 4, drawn by a fixed seed.
std::vector<RigidPose> first_poses(std::span<const PointPair> pairs, const Pinhole& pinhole) {
  std::vector<RigidPose> poses;
  const auto add = [&](std::span<const PointPair> of, cv::SolvePnPMethod method) {
    if (layout_of(of) == PointLayout::Line) return;
    if (const auto pose = by_opencv(of, pinhole, method)) poses.push_back(*pose);
  };
  add(pairs, cv::SOLVEPNP_ITERATIVE);
  add(pairs, cv::SOLVEPNP_SQPNP);
  if (pairs.size() < 5) return poses;
  std::mt19937 random(1);
  std::vector<PointPair> drawn(pairs.begin(), pairs.end());
  for (int i = 0; i < kMostSubsets; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      std::swap(drawn[k], drawn[k + random() % (drawn.size() - k)]);
    }
    add(std::span(drawn).first(4), cv::SOLVEPNP_SQPNP);
  }
  return poses;
}

constexpr double kPairHuber_px = 2;
constexpr double kPairOutlier_px = 3;
constexpr double kPairOutlierMedians = 5;  // A pair beyond both is an outlier.
constexpr double kUsualError = 0.5;        // px, of the paper's scenes
constexpr std::size_t kStarts = 5;         // That are minimized.

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Jacobian = Eigen::Matrix<double, 2, 6>;

constexpr int kMostIterations = 100;
constexpr double kLeastStep = 1e-12;

struct Pose {
  Matrix3 rotation;
  Eigen::Vector3d translation;
};

Pose pose_of(const RigidPose& pose) {
  return {Eigen::Map<const Matrix3>(pose.rotation.data()),
          Eigen::Map<const Eigen::Vector3d>(pose.translation.data())};
}

RigidPose rigid(const Pose& pose) {
  return rigid(pose.rotation, pose.translation);
}

/// exp(ω)·R, t + δ.
Pose moved(const Pose& pose, const Vector6& step) {
  const Eigen::Vector3d axis = step.head<3>();
  const double angle = axis.norm();
  Pose result = pose;
  if (angle > 0) {
    result.rotation = Eigen::AngleAxisd(angle, axis / angle).toRotationMatrix() * pose.rotation;
    result.rotation =
        Eigen::Quaterniond(Eigen::Matrix3d(result.rotation)).normalized().toRotationMatrix();
  }
  result.translation += step.tail<3>();
  return result;
}

/// Of the projection by rotation vector and translation; `turned` is R·X, `seen` R·X + t.
Jacobian jacobian_of(const Eigen::Vector3d& turned, const Eigen::Vector3d& seen, double focal) {
  Eigen::Matrix<double, 2, 3> by_place;
  const double scale = focal / seen.z();
  by_place << scale, 0, -scale * seen.x() / seen.z(), 0, scale, -scale * seen.y() / seen.z();
  Matrix3 cross;
  cross << 0, -turned.z(), turned.y(), turned.z(), 0, -turned.x(), -turned.y(), turned.x(), 0;
  Jacobian jacobian;
  jacobian << -by_place * cross, by_place;
  return jacobian;
}

struct Normal {
  Matrix6 matrix = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
};

Normal normal_equations(std::span<const PointPair> pairs, const Pose& pose,
                        const Pinhole& pinhole) {
  Normal normal;
  const RigidPose current = rigid(pose);
  for (const PointPair& pair : pairs) {
    const Eigen::Vector3d turned =
        pose.rotation * Eigen::Vector3d(pair.point.x, pair.point.y, pair.point.z);
    const auto [rx, ry] = reprojection_residual(pair, current, pinhole);
    const Eigen::Vector2d residual(rx, ry);
    const double size = residual.norm();
    const double weight = pair.is_locked || size <= kPairHuber_px ? 1 : kPairHuber_px / size;
    const Jacobian j = jacobian_of(turned, turned + pose.translation, pinhole.focal_px);
    normal.matrix += weight * j.transpose() * j;
    normal.gradient += weight * j.transpose() * residual;
  }
  return normal;
}

/// The sum of Huber's function of the residuals and of the squares (halved) of locked pairs;
/// infinite if a point lies behind the camera.
double huber_cost(std::span<const PointPair> pairs, const RigidPose& pose, const Pinhole& pinhole) {
  double sum = 0;
  for (const PointPair& pair : pairs) {
    const auto [x, y] = reprojection_residual(pair, pose, pinhole);
    const double size = std::hypot(x, y);
    if (!std::isfinite(size)) return std::numeric_limits<double>::infinity();
    const bool is_square = pair.is_locked || size <= kPairHuber_px;
    sum += is_square ? size * size / 2 : kPairHuber_px * (size - kPairHuber_px / 2);
  }
  return sum;
}

struct MinimizedPose {
  RigidPose pose;
  double cost = 0;
  /// Inverse of the weighted JᵀJ for a standard deviation of 1 px, row by row: rotation vector
  /// (radian, in the frame of the camera), then translation.
  std::array<double, 36> unit_covariance{};
};

/// Levenberg and Marquardt on the reprojection error with Huber's weights and the analytic
/// Jacobian, from `start`; ends when a step is below 1e-12 of the pose, after 100 iterations at
/// most. λ begins at 1e-3 and changes by factors of 10.
MinimizedPose minimize_reprojection(std::span<const PointPair> pairs, const RigidPose& start,
                                    const Pinhole& pinhole) {
  MinimizedPose result{start, huber_cost(pairs, start, pinhole), {}};
  if (!std::isfinite(result.cost)) return result;
  Pose pose = pose_of(start);
  double damping = 1e-3;
  Normal normal = normal_equations(pairs, pose, pinhole);
  for (int i = 0; i < kMostIterations && damping < 1e12; ++i) {
    Matrix6 damped = normal.matrix;
    damped.diagonal() *= 1 + damping;
    const Vector6 step = -solve_symmetric(damped, normal.gradient);
    if (!step.allFinite()) break;
    const Pose next = moved(pose, step);
    const double cost = huber_cost(pairs, rigid(next), pinhole);
    const bool is_tiny = step.head<3>().norm() < kLeastStep &&
                         step.tail<3>().norm() < kLeastStep * pose.translation.norm();
    if (cost <= result.cost) {
      pose = next;
      result.cost = cost;
      damping /= 10;
      normal = normal_equations(pairs, pose, pinhole);
    } else {
      damping *= 10;
    }
    if (is_tiny) break;
  }
  result.pose = rigid(pose);
  cv::Mat inverse(6, 6, CV_64F, result.unit_covariance.data());
  cv::invert(cv::Mat(6, 6, CV_64F, normal.matrix.data()), inverse, cv::DECOMP_SVD);
  return result;
}

MinimizedPose best_pose(std::span<const PointPair> pairs, const Pinhole& pinhole) {
  struct Start {
    double cost;
    RigidPose pose;
  };
  std::vector<Start> starts;
  for (const RigidPose& pose : first_poses(pairs, pinhole)) {
    starts.push_back({huber_cost(pairs, pose, pinhole), pose});
  }
  std::ranges::stable_sort(starts, {}, &Start::cost);
  MinimizedPose best;
  best.cost = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < std::min(kStarts, starts.size()); ++i) {
    const MinimizedPose pose = minimize_reprojection(pairs, starts[i].pose, pinhole);
    if (pose.cost < best.cost) best = pose;
  }
  return best;
}

std::vector<double> residuals_of(std::span<const PointPair> pairs, const RigidPose& pose,
                                 const Pinhole& pinhole) {
  std::vector<double> sizes;
  for (const PointPair& pair : pairs) {
    const auto [x, y] = reprojection_residual(pair, pose, pinhole);
    sizes.push_back(std::hypot(x, y));
  }
  return sizes;
}

std::vector<PairResidual> judged(std::span<const PointPair> pairs, const RigidPose& pose,
                                 const Pinhole& pinhole) {
  const std::vector<double> sizes = residuals_of(pairs, pose, pinhole);
  const double limit = std::max(kPairOutlier_px, kPairOutlierMedians * median(sizes));
  std::vector<PairResidual> judgements;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    judgements.push_back({sizes[i], !pairs[i].is_locked && sizes[i] > limit});
  }
  const auto right = std::ranges::count(judgements, false, &PairResidual::is_outlier);
  if (right < 4) {
    for (PairResidual& each : judgements) each.is_outlier = false;
  }
  return judgements;
}

std::vector<PointPair> kept(std::span<const PointPair> pairs,
                            std::span<const PairResidual> judgements) {
  std::vector<PointPair> rest;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!judgements[i].is_outlier) rest.push_back(pairs[i]);
  }
  return rest;
}

/// Refuses pairs that fit the mirror image of the mesh far better.
void refuse_mirrored(std::span<const PointPair> pairs, const Pinhole& pinhole, double cost) {
  const double tolerance = kUsualError * kUsualError * static_cast<double>(pairs.size());
  if (pairs.size() < 6 || cost <= tolerance || layout_of(pairs) != PointLayout::Space) return;
  std::vector<PointPair> mirrored(pairs.begin(), pairs.end());
  for (PointPair& pair : mirrored) pair.point.z = -pair.point.z;
  const double other = best_pose(mirrored, pinhole).cost;
  if (!(other < cost / 10)) return;
  throw InvalidInput(
      fmt::format("the mesh is a mirror image of what the camera sees (its axes are left-handed): "
                  "mirrored, the pairs fit {:.0f} times better; negate its Z and pick again",
                  std::sqrt(cost / std::max(other, 1e-12))));
}

/// Least depth error along the optical axis (paper, section 3.2.1).
double delta_tz(std::span<const PointPair> pairs, const RigidPose& pose, const Pinhole& pinhole,
                double error_px, double& depth) {
  double least = std::numeric_limits<double>::infinity();
  for (const PointPair& pair : pairs) {
    const double z = pose.apply(pair.point).z;
    const double off =
        std::max(std::abs(pair.x_px - pinhole.center_x), std::abs(pair.y_px - pinhole.center_y));
    const double delta = z * error_px / off;
    if (delta < least) depth = z;
    least = std::min(least, delta);
  }
  return least;
}

void set_errors(std::span<const PointPair> pairs, const MinimizedPose& pose,
                const CameraGrid& camera, SolvedPose& solved) {
  const std::vector<double> sizes = residuals_of(pairs, pose.pose, *camera.pinhole);
  double sum = 0;
  double squares = 0;
  for (const double size : sizes) {
    sum += size;
    squares += size * size;
  }
  solved.reprojection_error_px = sum / static_cast<double>(sizes.size());
  const double freedom = 2 * static_cast<double>(sizes.size()) - 6;
  const double variance = sizes.size() > 4 ? squares / freedom : kUsualError * kUsualError;
  std::ranges::transform(pose.unit_covariance, solved.covariance.begin(),
                         [variance](double value) { return variance * value; });
  double depth = 0;
  solved.delta_tz =
      delta_tz(pairs, pose.pose, *camera.pinhole, solved.reprojection_error_px, depth);
  solved.delta_tz_px =
      camera.is_known() ? camera.baseline * camera.focal_length * solved.delta_tz / (depth * depth)
                        : std::numeric_limits<double>::quiet_NaN();
}

using Json = nlohmann::ordered_json;

Json pairs_json(const PoseStory& story) {
  Json pairs = Json::array();
  for (std::size_t i = 0; i < story.pairs.size(); ++i) {
    const PointPair& pair = story.pairs[i];
    const PairResidual& judged = story.solved.pairs[i];
    pairs.push_back({{"name", pair.name},
                     {"x_px", pair.x_px},
                     {"y_px", pair.y_px},
                     {"X", pair.point.x},
                     {"Y", pair.point.y},
                     {"Z", pair.point.z},
                     {"residual_px", judged.residual_px},
                     {"outlier", judged.is_outlier}});
    if (pair.is_locked) pairs.back()["locked"] = true;
  }
  return pairs;
}

/// The path of the mesh as it is found from the folder of the file.
std::string stored_mesh(const std::filesystem::path& mesh, const std::filesystem::path& path) {
  std::error_code error;
  const auto relative =
      std::filesystem::relative(mesh, std::filesystem::absolute(path, error).parent_path(), error);
  return error || relative.empty() ? std::filesystem::absolute(mesh).string() : relative.string();
}

bool is_rotation(const std::array<double, 9>& r) {
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      double product = 0;
      for (int c = 0; c < 3; ++c) product += r[3 * i + c] * r[3 * k + c];
      if (!(std::abs(product - (i == k ? 1 : 0)) < 1e-6)) return false;
    }
  }
  const double turn = r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) +
                      r[2] * (r[3] * r[7] - r[4] * r[6]);
  return turn > 0;
}

IoError no_pose(const std::filesystem::path& path) {
  return {path,
          "this is no pose: mesh, rotation (9 numbers) and translation (3) are expected; "
          "make one with episcope-cli pose"};
}

double number_or_zero(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : 0;
}

/// The pairs and how well they fit, as far as the file has them.
void read_evidence(const Json& json, PoseStory& story) {
  story.solved.reprojection_error_px = number_or_zero(json, "reprojection_error_px");
  story.solved.delta_tz = number_or_zero(json, "delta_tz");
  const auto pairs = json.find("pairs");
  if (pairs == json.end() || !pairs->is_array()) return;
  for (const Json& each : *pairs) {
    const Point3 point{number_or_zero(each, "X"), number_or_zero(each, "Y"),
                       number_or_zero(each, "Z")};
    story.pairs.push_back({each.value("name", ""), number_or_zero(each, "x_px"),
                           number_or_zero(each, "y_px"), point, each.value("locked", false)});
    story.solved.pairs.push_back(
        {number_or_zero(each, "residual_px"), each.value("outlier", false)});
  }
}

constexpr const char* kHeader = "name,x_px,y_px,X,Y,Z";
constexpr const char* kLocked = ",locked";

std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = line.find(',', begin);
    fields.emplace_back(trimmed(line.substr(begin, end - begin), kQuotesAndBlanks));
    if (end == line.npos) return fields;
    begin = end + 1;
  }
}

PointPair pair_of(const std::filesystem::path& path, int line,
                  const std::vector<std::string>& fields) {
  const auto fail = [&](const std::string& what) -> IoError {
    return {path, fmt::format("line {} {}; a line is {}", line, what, kHeader)};
  };
  if (fields.size() != 6 && fields.size() != 7) {
    throw fail(fmt::format("has {} fields instead of 6", fields.size()));
  }
  double numbers[5];
  for (int i = 0; i < 5; ++i) {
    const auto number = io::parse_number(fields[i + 1]);
    if (!number) throw fail("has '" + fields[i + 1] + "' where a number belongs");
    numbers[i] = *number;
  }
  const std::string lock = fields.size() == 7 ? fields[6] : "0";
  if (lock != "0" && lock != "1") throw fail("has '" + lock + "' where 1 (locked) or 0 belongs");
  return {fields[0], numbers[0], numbers[1], {numbers[2], numbers[3], numbers[4]}, lock == "1"};
}

}  // namespace

SolvedPose solve_pose(std::span<const PointPair> pairs, const CameraGrid& camera) {
  if (!camera.pinhole) throw InvalidInput("the pinhole of the camera is not known");
  if (pairs.size() < 4) {
    throw InvalidInput(
        fmt::format("a pose needs 4 pairs, and there are {}; pick more, best 10", pairs.size()));
  }
  if (layout_of(pairs) == PointLayout::Line) {
    throw InvalidInput(
        "the points of the pairs lie on one line, which leaves the pose open; pick "
        "points beside it");
  }
  const Pinhole& pinhole = *camera.pinhole;
  MinimizedPose pose = best_pose(pairs, pinhole);
  if (!std::isfinite(pose.cost)) {
    throw InvalidInput(
        "no pose in front of the camera fits these pairs; check that each names the "
        "same point in the view and on the mesh");
  }
  SolvedPose solved;
  solved.pairs = judged(pairs, pose.pose, pinhole);
  const std::vector<PointPair> rest = kept(pairs, solved.pairs);
  refuse_mirrored(pairs, pinhole, pose.cost);
  if (rest.size() < pairs.size()) {
    pose = minimize_reprojection(rest, pose.pose, pinhole);
    const std::vector<double> sizes = residuals_of(pairs, pose.pose, pinhole);
    for (std::size_t i = 0; i < sizes.size(); ++i) solved.pairs[i].residual_px = sizes[i];
  }
  solved.pose = pose.pose;
  set_errors(rest, pose, camera, solved);
  return solved;
}

std::array<double, 2> reprojection_residual(const PointPair& pair, const RigidPose& pose,
                                            const Pinhole& pinhole) {
  const Point3 seen = pose.apply(pair.point);
  if (!(seen.z > 0)) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan};
  }
  return {pinhole.focal_px * seen.x / seen.z + pinhole.center_x - pair.x_px,
          pinhole.focal_px * seen.y / seen.z + pinhole.center_y - pair.y_px};
}

std::string pose_json(const PoseStory& story, const std::filesystem::path& path) {
  const SolvedPose& solved = story.solved;
  Json json;
  json["mesh"] = stored_mesh(story.mesh, path);
  json["light_field"] = story.light_field;
  json["rotation"] = solved.pose.rotation;
  json["translation"] = solved.pose.translation;
  json["reprojection_error_px"] = solved.reprojection_error_px;
  json["delta_tz"] = solved.delta_tz;
  if (std::isfinite(solved.delta_tz_px)) json["delta_tz_px"] = solved.delta_tz_px;
  json["covariance"] = solved.covariance;
  if (story.camera.pinhole) {
    const Pinhole& pinhole = *story.camera.pinhole;
    json["pinhole"] = {pinhole.focal_px, pinhole.center_x, pinhole.center_y};
  }
  json["pairs"] = pairs_json(story);
  return io::json_text(json, 2) + "\n";
}

void write_pose(const std::filesystem::path& path, const PoseStory& story,
                const std::filesystem::path& place) {
  const std::string text = pose_json(story, place.empty() ? path : place);
  io::write_atomically(path, text);
}

PoseStory read_pose(const std::filesystem::path& path) {
  if (!std::ifstream(path)) {
    throw IoError(path, "this file cannot be read; make one with episcope-cli pose");
  }
  PoseStory story;
  try {
    const auto json = io::read_json<Json>(path);
    story.mesh = json.at("mesh").get<std::string>();
    json.at("rotation").get_to(story.solved.pose.rotation);
    json.at("translation").get_to(story.solved.pose.translation);
    story.light_field = json.value("light_field", "");
    read_evidence(json, story);
  } catch (const Json::exception&) {
    throw no_pose(path);
  } catch (const InvalidInput&) {
    throw no_pose(path);
  }
  if (!is_rotation(story.solved.pose.rotation)) {
    throw IoError(path,
                  "rotation is no rotation matrix; make the pose again with episcope-cli pose");
  }
  if (story.mesh.is_relative()) {
    story.mesh = std::filesystem::absolute(path).parent_path() / story.mesh;
  }
  return story;
}

std::vector<PointPair> read_pairs(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw IoError(path, "this file cannot be read; name the pairs, as CSV");
  std::vector<PointPair> pairs;
  std::string text;
  for (int line = 1; std::getline(file, text); ++line) {
    if (line == 1 && text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
    const std::string_view content = trimmed(text, kQuotesAndBlanks);
    if (content.empty() || content.starts_with('#')) continue;
    const std::vector<std::string> fields = fields_of(content);
    if (pairs.empty() && fields.size() > 1 && fields[1] == "x_px") continue;
    pairs.push_back(pair_of(path, line, fields));
  }
  if (pairs.empty()) {
    throw IoError(path, std::string("there are no pairs in this file; a line is ") + kHeader);
  }
  return pairs;
}

void write_pairs(const std::filesystem::path& path, std::span<const PointPair> pairs) {
  const bool has_locks = std::ranges::any_of(pairs, &PointPair::is_locked);
  std::string text = std::string(kHeader) + (has_locks ? kLocked : "") + "\n";
  for (const PointPair& pair : pairs) {
    if (pair.name.find_first_of(",\n\r") != std::string::npos) {
      throw IoError(path,
                    "the name '" + pair.name + "' has a comma or a line end; rename the pair");
    }
    text += fmt::format("{},{},{},{},{},{}", pair.name, pair.x_px, pair.y_px, pair.point.x,
                        pair.point.y, pair.point.z);
    if (has_locks) text += pair.is_locked ? ",1" : ",0";
    text += '\n';
  }
  io::write_atomically(path, text);
}

}  // namespace episcope::capture
