// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/poses.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/json.h"
#include "engine/io/base/npy.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <fstream>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace episcope::io {
namespace {

constexpr std::uintmax_t kLargestColmap = 1'000'000'000;  ///< In bytes: with all points.

/// The pose that COLMAP states as a quaternion (w, x, y, z), which has not to be normalized, and a
/// translation, both from the scene to the camera, whose y is down and z ahead.
CameraPose colmap_pose(const std::array<double, 7>& numbers) {
  const auto [w, x, y, z, tx, ty, tz] = numbers;
  const double n = 2 / (w * w + x * x + y * y + z * z);
  CameraPose pose{.image = {},
                  .right = {1 - n * (y * y + z * z), n * (x * y - z * w), n * (x * z + y * w)},
                  .down = {n * (x * y + z * w), 1 - n * (x * x + z * z), n * (y * z - x * w)},
                  .ahead = {n * (x * z - y * w), n * (y * z + x * w), 1 - n * (x * x + y * y)}};
  for (std::size_t i = 0; i < 3; ++i) {
    pose.center[i] = -(pose.right[i] * tx + pose.down[i] * ty + pose.ahead[i] * tz);
  }
  return pose;
}

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little);

/// Numbers one after the other; after the end of the file they are 0 and `is_whole` is false.
class BinaryInput {
 public:
  explicit BinaryInput(const fs::path& path)
      : in_(path, std::ios::binary), left_(fs::file_size(path)) {}

  template <class T>
  [[nodiscard]] T next() {
    T value{};
    if (take(sizeof(T))) in_.read(reinterpret_cast<char*>(&value), sizeof(T));
    return value;
  }
  /// Up to a zero.
  [[nodiscard]] std::string next_text() {
    std::string text;
    for (char c = next<char>(); c != '\0'; c = next<char>()) text += c;
    return text;
  }
  void skip(std::uint64_t count, std::uint64_t bytes_each) {
    if (count > left_ / bytes_each) {
      is_whole_ = false;
    } else if (take(count * bytes_each)) {
      in_.ignore(static_cast<std::streamsize>(count * bytes_each));
    }
  }
  [[nodiscard]] bool is_whole() const { return is_whole_ && !in_.fail(); }

 private:
  bool take(std::uint64_t bytes) {
    is_whole_ = is_whole_ && bytes <= left_;
    if (is_whole_) left_ -= bytes;
    return is_whole_;
  }

  std::ifstream in_;
  std::uint64_t left_;
  bool is_whole_ = true;
};

/// By the ids of cameras, up to the first of a model that is not known: of every model the first
/// parameter is a focal length.
std::map<std::uint32_t, double> binary_focal_widths(const fs::path& path) {
  constexpr std::array<std::uint64_t, 12> kParameters{3, 4, 4, 5, 8, 8, 12, 5, 4, 5, 12, 16};
  std::map<std::uint32_t, double> focals;
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return focals;
  BinaryInput in(path);
  const auto count = in.next<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto id = in.next<std::uint32_t>();
    const auto model = in.next<std::uint32_t>();
    const auto width = static_cast<double>(in.next<std::uint64_t>());
    in.skip(1, sizeof(std::uint64_t));  // height
    const auto focal = in.next<double>();
    if (model >= kParameters.size()) break;
    in.skip(kParameters[model] - 1, sizeof(double));
    if (!in.is_whole()) break;
    if (width > 0) focals[id] = focal / width;
  }
  return focals;
}

}  // namespace

std::vector<CameraPose> read_binary_colmap_poses(const fs::path& path) {
  constexpr std::uint64_t kPoint = 24;  // x, y and an id, of 8 bytes each
  require_readable_file(path);
  if (fs::file_size(path) > kLargestColmap) throw IoError(path, "this file is larger than 1 GB");
  const std::map<std::uint32_t, double> focals =
      binary_focal_widths(path.parent_path() / "cameras.bin");
  std::vector<CameraPose> poses;
  BinaryInput in(path);
  const auto count = in.next<std::uint64_t>();
  for (std::uint64_t i = 0; i < count && in.is_whole(); ++i) {
    in.skip(1, sizeof(std::uint32_t));  // id of the image
    std::array<double, 7> numbers{};
    for (double& number : numbers) number = in.next<double>();
    CameraPose pose = colmap_pose(numbers);
    const auto focal = focals.find(in.next<std::uint32_t>());
    if (focal != focals.end()) pose.focal_widths = focal->second;
    pose.image = in.next_text();
    in.skip(in.next<std::uint64_t>(), kPoint);
    poses.push_back(std::move(pose));
  }
  if (in.is_whole()) return poses;
  throw IoError(path, fmt::format("it ends within image {} of {}; export it again or remove the "
                                  "file",
                                  poses.size(), count));
}

namespace {

std::vector<std::string> pose_words(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// What follows so many words of a line; it may hold spaces.
std::string name_behind(const std::string& line, int words) {
  std::istringstream in(line);
  std::string name;
  for (int i = 0; i < words; ++i) in >> name;
  std::getline(in >> std::ws, name);
  return name.substr(0, name.find_last_not_of(" \t\r") + 1);
}

[[noreturn]] void refuse(const fs::path& path, int line) {
  throw IoError(path, fmt::format("line {} is not one of an export of COLMAP as text; export it "
                                  "again or remove the file",
                                  line));
}

double number_in(const fs::path& path, int line, const std::string& word) {
  const auto number = parse_number(word);
  if (!number) refuse(path, line);
  return *number;
}

/// By the ids of cameras: of every model the first parameter is a focal length.
std::map<std::string, double> text_focal_widths(const fs::path& path) {
  std::map<std::string, double> focals;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const std::vector<std::string> words = pose_words(line);
    if (words.size() < 5 || words[0].starts_with('#')) continue;
    const auto width = parse_number(words[2]);
    const auto focal = parse_number(words[4]);
    if (width && focal && *width > 0) focals[words[0]] = *focal / *width;
  }
  return focals;
}

}  // namespace

std::vector<CameraPose> read_colmap_poses(const fs::path& path) {
  require_readable_file(path);
  if (fs::file_size(path) > kLargestColmap) throw IoError(path, "this file is larger than 1 GB");
  const std::map<std::string, double> focals =
      text_focal_widths(path.parent_path() / "cameras.txt");
  std::vector<CameraPose> poses;
  std::ifstream in(path);
  bool is_of_points = false;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.starts_with('#')) continue;
    if (std::exchange(is_of_points, !is_of_points)) continue;
    const std::vector<std::string> words = pose_words(line);
    if (words.size() < 10) refuse(path, number);
    std::array<double, 7> numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      numbers[i] = number_in(path, number, words[i + 1]);
    }
    CameraPose pose = colmap_pose(numbers);
    pose.image = name_behind(line, 9);
    const auto focal = focals.find(words[8]);
    if (focal != focals.end()) pose.focal_widths = focal->second;
    poses.push_back(std::move(pose));
  }
  return poses;
}

namespace {

/// Poses of `poses_bounds.npy`, N×17: for each image, in the order of names, a 3×5 matrix whose
/// columns are down, right, backwards, the place of the camera, and height, width and focal length
/// in px; then two bounds of depth, which are not used. Images are not named. Throws IoError.
std::vector<CameraPose> read_llff_poses(const std::filesystem::path& path) {
  constexpr std::size_t kNumbers = 17;
  constexpr std::size_t kMostImages = 100'000;
  const NpyFile file(path);
  const ArrayShape& shape = file.shape();
  const bool is_sound = shape.size() == 2 && shape[1] == kNumbers && shape[0] <= kMostImages &&
                        !file.header().is_fortran;
  if (!is_sound) {
    throw IoError(path, fmt::format("the array has the shape {}, but poses are N×17 in C order; "
                                    "export them again or remove the file",
                                    shape_text(file.header().shape)));
  }
  std::vector<float> all(shape[0] * kNumbers);
  file.read(ArrayShape(2, 0), shape, all.data());
  std::vector<CameraPose> poses;
  for (std::size_t i = 0; i < shape[0]; ++i) {
    const auto column = [&](std::size_t c) {
      const float* matrix = &all[i * kNumbers];
      return Direction{matrix[c], matrix[5 + c], matrix[10 + c]};
    };
    const auto [height, width, focal] = column(4);
    poses.push_back({.image = {},
                     .center = column(3),
                     .right = normalized(column(1)),
                     .down = normalized(column(0)),
                     .ahead = normalized(times(-1, column(2))),
                     .focal_widths = width > 0 ? focal / width : 0});
  }
  return poses;
}

using Json = nlohmann::json;

double focal_widths(const Json& json) {
  if (json.contains("camera_angle_x")) {
    return 0.5 / std::tan(0.5 * json.at("camera_angle_x").get<double>());
  }
  if (!json.contains("fl_x") || !json.contains("w")) return 0;
  return json.at("fl_x").get<double>() / json.at("w").get<double>();
}

CameraPose pose_of(const Json& frame, double focal) {
  const auto rows = frame.at("transform_matrix").get<std::vector<std::vector<double>>>();
  const auto column = [&](std::size_t c) {
    return Direction{rows.at(0).at(c), rows.at(1).at(c), rows.at(2).at(c)};
  };
  const double own = focal_widths(frame);
  return {.image = frame.at("file_path").get<std::string>(),
          .center = column(3),
          .right = normalized(column(0)),
          .down = normalized(times(-1, column(1))),
          .ahead = normalized(times(-1, column(2))),
          .focal_widths = own > 0 ? own : focal};
}

/// Poses of `transforms.json`: `frames` with `file_path` and `transform_matrix`, 4×4, from the
/// camera, whose x is right, y up and z backwards, to the scene. Focal length by `camera_angle_x`,
/// or `fl_x` and `w`. Throws IoError.
std::vector<CameraPose> read_nerf_poses(const std::filesystem::path& path) {
  try {
    const Json json = read_json<Json>(path);
    const double focal = focal_widths(json);
    std::vector<CameraPose> poses;
    for (const Json& frame : json.at("frames")) poses.push_back(pose_of(frame, focal));
    return poses;
  } catch (const Json::exception& error) {
    throw IoError(path, std::string("these are no poses of cameras (") + error.what() +
                            "); export them again or remove the file");
  } catch (const InvalidInput& error) {
    throw IoError(path, std::string("these are no poses of cameras (") + error.what() +
                            "); export them again or remove the file");
  } catch (const std::out_of_range&) {
    throw IoError(path,
                  "a transform_matrix has less than 3 rows of 4 numbers; export it again or "
                  "remove the file");
  }
}

struct PoseForm {
  const char* name;
  std::vector<CameraPose> (*read)(const fs::path&);
  const char* cameras = nullptr;  ///< A file beside it that is read, too.
};

constexpr PoseForm kPoseForms[] = {{"transforms.json", read_nerf_poses},
                                   {"poses_bounds.npy", read_llff_poses},
                                   {"images.txt", read_colmap_poses, "cameras.txt"},
                                   {"images.bin", read_binary_colmap_poses, "cameras.bin"}};

/// Folders beside images that hold poses.
constexpr std::array kPoseFolders{"", "sparse/0", "sparse", "colmap"};

constexpr std::array kParts{"train", "val", "test"};  ///< Of data sets for learning.

constexpr int kDeepestImage = 4;  ///< Folders by which images of one name are told apart.

/// The name, which with and without a suffix is the same image, and up to `folders` folders that it
/// is in.
fs::path place_of(std::string image, int folders, bool keeps_case) {
  std::ranges::replace(image, '\\', '/');
  if (!keeps_case) image = lower_case(image);
  const fs::path path = fs::path(image).lexically_normal();
  fs::path place = path.stem(), folder = path.parent_path();
  for (; folders > 0 && folder.has_filename(); --folders, folder = folder.parent_path()) {
    place = folder.filename() / place;
  }
  return place;
}

/// For each image the only pose of its place, or null.
std::vector<const CameraPose*> poses_at(const std::vector<CameraPose>& all,
                                        const std::vector<fs::path>& images, int folders,
                                        bool keeps_case) {
  std::map<fs::path, const CameraPose*> by_place;
  for (const CameraPose& pose : all) {
    const auto [at, is_new] = by_place.emplace(place_of(pose.image, folders, keeps_case), &pose);
    if (!is_new) at->second = nullptr;
  }
  std::vector<const CameraPose*> poses;
  for (const fs::path& image : images) {
    const auto found = by_place.find(place_of(image.string(), folders, keeps_case));
    poses.push_back(found == by_place.end() ? nullptr : found->second);
  }
  return poses;
}

/// The poses of images by name and as many folders as agree, else regardless of case.
void match_names(const std::vector<CameraPose>& all, const std::vector<fs::path>& images,
                 FoundPoses& found) {
  for (const bool keeps_case : {true, false}) {
    for (int folders = kDeepestImage; folders >= 0; --folders) {
      const std::vector<const CameraPose*> poses = poses_at(all, images, folders, keeps_case);
      for (std::size_t i = 0; i < poses.size(); ++i) {
        if (poses[i] == nullptr) continue;
        found.poses.push_back(*poses[i]);
        found.images.push_back(images[i]);
      }
      if (!found.images.empty()) return;
    }
  }
  found.problem = "it knows none of the images";
}

/// The poses of the images, in their order where there are no names.
void match(std::vector<CameraPose> all, const std::vector<fs::path>& images, FoundPoses& found) {
  const bool has_names = !all.empty() && !all.front().image.empty();
  if (has_names) {
    match_names(all, images, found);
  } else if (all.size() == images.size()) {
    found.poses = std::move(all);
    found.images = images;
  } else {
    found.problem = fmt::format("it has {} poses for {} images", all.size(), images.size());
  }
}

FoundPoses read_form(const fs::path& folder, const PoseForm& form,
                     const std::vector<fs::path>& images) {
  const fs::path file = folder / form.name;
  FoundPoses found{.files = {file}, .poses = {}, .images = {}, .problem = {}};
  if (form.cameras && is_file(folder / form.cameras)) found.files.push_back(folder / form.cameras);
  try {
    match(form.read(file), images, found);
  } catch (const IoError& damaged) {
    const std::string text = damaged.what();
    const std::string path = damaged.path().string() + ": ";
    found.problem = text.starts_with(path) ? text.substr(path.size()) : text;
  }
  return found;
}

std::string part_file(const char* part) {
  return fmt::format("transforms_{}.json", part);
}

/// All parts together, then each; an image of several parts counts once.
std::vector<FoundPoses> read_parts(const fs::path& folder, const std::vector<fs::path>& images) {
  std::vector<FoundPoses> parts;
  FoundPoses all;
  std::set<fs::path> known;
  for (const char* part : kParts) {
    const std::string name = part_file(part);
    if (!is_file(folder / name)) continue;
    FoundPoses found = read_form(folder, {name.c_str(), read_nerf_poses}, images);
    if (found.problem.empty()) {
      all.files.push_back(found.files.front());
      for (std::size_t i = 0; i < found.images.size(); ++i) {
        if (!known.insert(found.images[i]).second) continue;
        all.images.push_back(found.images[i]);
        all.poses.push_back(found.poses[i]);
      }
    }
    parts.push_back(std::move(found));
  }
  std::ranges::stable_sort(parts, {}, [](const FoundPoses& part) { return !part.problem.empty(); });
  if (all.files.size() > 1) parts.insert(parts.begin(), std::move(all));
  return parts;
}

}  // namespace

std::vector<FoundPoses> find_poses(const fs::path& folder, const fs::path& scene,
                                   const std::vector<fs::path>& images) {
  std::vector<fs::path> bases{folder, scene};
  for (fs::path inside = folder; inside.has_relative_path(); inside = inside.parent_path()) {
    if (inside.filename() == "images") bases.push_back(inside.parent_path());
  }
  for (const fs::path& base : bases) {
    for (const char* inside : kPoseFolders) {
      for (const PoseForm& form : kPoseForms) {
        if (is_file(base / inside / form.name)) return {read_form(base / inside, form, images)};
      }
    }
    if (auto parts = read_parts(base, images); !parts.empty()) return parts;
  }
  return {};
}

namespace {

bool has_named_poses(const fs::path& folder) {
  return std::ranges::any_of(kPoseFolders, [&](const char* inside) {
    return std::ranges::any_of(kPoseForms, [&](const PoseForm& form) {
      return form.read != read_llff_poses && is_file(folder / inside / form.name);
    });
  });
}

void add_folders_inside(const fs::path& folder, int depth, std::vector<fs::path>& all) {
  for (const fs::path& inside : list_folders(folder)) {
    if (count_images(inside) > 0) all.push_back(inside);
    if (depth > 1) add_folders_inside(inside, depth - 1, all);
  }
}

}  // namespace

std::vector<fs::path> folders_of_parts(const fs::path& folder) {
  std::vector<fs::path> folders;
  for (const char* part : kParts) {
    std::error_code error;
    if (is_file(folder / part_file(part)) && fs::is_directory(folder / part, error)) {
      folders.push_back(folder / part);
    }
  }
  std::error_code error;
  const fs::path images = folder / "images";
  if (folders.empty() && fs::is_directory(images, error) && has_named_poses(folder)) {
    add_folders_inside(images, kDeepestImage, folders);
  }
  return folders;
}

namespace {

constexpr double kMostOff_steps = 0.1;

/// How cameras of a light field may differ from a plane grid that is exact: orientations by half a
/// degree, places by a tenth of a step, on the plane and off it.
constexpr double kMostTurn_deg = 0.5;

constexpr std::size_t kFewestCameras = 3;
constexpr double kMostPosePlaces = 10;  ///< Of a grid with gaps, for each camera.
constexpr double kMostSteps = 1e4;
constexpr double kOneLine_spans = 0.02;  ///< Of the larger extent: then it is a single row.

/// A camera seen by the first one: to the right, below, ahead of it.
struct PlanePlace {
  double x = 0;
  double y = 0;
  double z = 0;
};

std::vector<PlanePlace> places_of(const std::vector<CameraPose>& poses) {
  const CameraPose& first = poses.front();
  std::vector<PlanePlace> places;
  for (const CameraPose& pose : poses) {
    const Direction from_first{pose.center[0] - first.center[0], pose.center[1] - first.center[1],
                               pose.center[2] - first.center[2]};
    places.push_back(
        {dot(from_first, first.right), dot(from_first, first.down), dot(from_first, first.ahead)});
  }
  return places;
}

double largest_turn_deg(const std::vector<CameraPose>& poses) {
  double smallest = 1;
  const CameraPose& first = poses.front();
  for (const CameraPose& pose : poses) {
    smallest = std::min({smallest, dot(pose.right, first.right), dot(pose.down, first.down),
                         dot(pose.ahead, first.ahead)});
  }
  return std::acos(std::clamp(smallest, -1.0, 1.0)) * 180 / std::numbers::pi;
}

/// Equal steps along one axis, and in which of them each camera is.
struct Steps {
  double first = 0;
  double step = 0;  ///< 0 for a single one.
  int count = 1;
  std::vector<int> numbers;
  double off = 0;  ///< The largest deviation.
};

Steps steps_along(const std::vector<PlanePlace>& places, double PlanePlace::*axis, double gap) {
  std::vector<double> sorted;
  for (const PlanePlace& place : places) sorted.push_back(place.*axis);
  std::ranges::sort(sorted);
  Steps steps;
  steps.first = sorted.front();
  std::vector<double> distances;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i] - sorted[i - 1] > gap) distances.push_back(sorted[i] - sorted[i - 1]);
  }
  if (!distances.empty()) {
    // Where cameras are missing some distances are larger.
    const double middle = quantile(distances, 0.5);
    const double extent = sorted.back() - sorted.front();
    steps.count = 1 + static_cast<int>(std::lround(std::min(extent / middle, kMostSteps)));
    steps.step = extent / (steps.count - 1);
  }
  for (const PlanePlace& place : places) {
    const double from_first = place.*axis - steps.first;
    const int number = steps.step > 0 ? static_cast<int>(std::lround(from_first / steps.step)) : 0;
    steps.numbers.push_back(number);
    steps.off = std::max(steps.off, std::abs(from_first - number * steps.step));
  }
  return steps;
}

double extent(const std::vector<PlanePlace>& places, double PlanePlace::*axis) {
  const auto [least, most] = std::ranges::minmax_element(places, {}, axis);
  return (*most).*axis - (*least).*axis;
}

/// The step of a full grid of so many cameras follows from its extents: rows and columns with
/// about equal steps. Of a grid with gaps the step is smaller.
double likely_step(const std::vector<PlanePlace>& places) {
  const double width = extent(places, &PlanePlace::x);
  const double height = extent(places, &PlanePlace::y);
  const double longer = std::max(width, height);
  const double shorter = std::min(width, height);
  const auto count = static_cast<double>(places.size());
  if (shorter <= kOneLine_spans * longer) return longer / (count - 1);
  // (width / s + 1) · (height / s + 1) = count
  const double a = count - 1;
  const double b = width + height;
  return (b + std::sqrt(b * b + 4 * a * width * height)) / (2 * a);
}

std::string problem_of(const PoseGrid& grid, const Steps& columns, const Steps& rows, double depth,
                       std::size_t count) {
  const auto off_along = [&](const Steps& steps) {
    return steps.off / (steps.step > 0 ? steps.step : grid.step);
  };
  const double off = std::max(off_along(columns), off_along(rows));
  if (depth / grid.step > kMostOff_steps) {
    return fmt::format(
        "the cameras do not stand on a plane that they face: they differ by {:.2g} "
        "of their step along the line of sight",
        depth / grid.step);
  }
  const double places = static_cast<double>(rows.count) * columns.count;
  if (places > kMostPosePlaces * static_cast<double>(count)) {
    return fmt::format("{} cameras do not fill a grid of equal steps, which would have {}×{}",
                       count, grid.grid.v, grid.grid.u);
  }
  if (off > kMostOff_steps) {
    return fmt::format("the cameras are off a grid of equal steps by up to {:.2g} of a step", off);
  }
  return {};
}

/// The cameras in their places; says so if two stand in one.
std::string fill(PoseGrid& grid, const Steps& columns, const Steps& rows,
                 const std::vector<PlanePlace>& places) {
  grid.order.assign(static_cast<std::size_t>(grid.grid.count()), kNoCamera);
  grid.positions.resize(grid.order.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto at = static_cast<std::size_t>(rows.numbers[i] * grid.grid.u + columns.numbers[i]);
    if (grid.order[at] != kNoCamera) return "two cameras stand in the same place";
    grid.order[at] = i;
    const auto rounded = [&](double length) {
      return std::round(length / grid.step * 1e6) / 1e6 * grid.step;
    };
    grid.positions[at] = {rounded(places[i].x - columns.first), rounded(places[i].y - rows.first)};
  }
  return {};
}

}  // namespace

PoseGrid find_pose_grid(const std::vector<CameraPose>& poses) {
  PoseGrid grid;
  if (poses.size() < kFewestCameras) return {.problem = "there are less than three cameras"};
  if (!std::ranges::all_of(poses, &CameraPose::is_finite)) {
    return {.problem = "some numbers are not finite"};
  }
  const double turn_deg = largest_turn_deg(poses);
  if (turn_deg > kMostTurn_deg) {
    return {.problem = fmt::format("the cameras are turned against each other by up to {:.3g}°",
                                   turn_deg)};
  }
  const std::vector<PlanePlace> places = places_of(poses);
  const double gap = likely_step(places) / 4;
  if (!(gap > 0)) return {.problem = "all cameras stand in one place"};
  const Steps columns = steps_along(places, &PlanePlace::x, gap);
  const Steps rows = steps_along(places, &PlanePlace::y, gap);
  grid.grid = {rows.count, columns.count};
  grid.step = columns.step > 0 ? columns.step : rows.step;
  if (!(grid.step > 0))
    return {.problem = "the cameras do not stand in rows and columns of equal steps"};
  const double depth = extent(places, &PlanePlace::z);
  grid.problem = problem_of(grid, columns, rows, depth, poses.size());
  if (grid.problem.empty()) grid.problem = fill(grid, columns, rows, places);
  grid.focal_widths = poses.front().focal_widths;
  grid.evidence = fmt::format(
      "cameras in steps of {:.4g}, off the grid by up to {:.2g} of a step, turned against each "
      "other by up to {:.2g}°",
      grid.step, std::max({columns.off, rows.off, depth}) / grid.step, turn_deg);
  return grid;
}

}  // namespace episcope::io
