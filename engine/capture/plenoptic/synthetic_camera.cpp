// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/plenoptic/synthetic_camera.h"

#include "engine/core/parallel.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/json.h"

#include <Eigen/LU>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace episcope::capture {
namespace {

constexpr double kLensRadius = 0.485;  // of the pitch
constexpr int kRays = 4;               // of a pixel: quarters of its patch of the main lens
constexpr double kRayOffset = 0.25;    // px

struct BelowLens {
  int i = 0;
  int j = 0;
  PlanePoint offset;  ///< From the center of the lens, px, along the axes of the array.
};

double corner_of(const SyntheticCamera& camera) {
  return std::hypot(camera.width, camera.height) / 2;
}

PlanePoint turned(const PlanePoint& p, double degrees) {
  const double t = degrees * std::numbers::pi / 180;
  return {p.x * std::cos(t) - p.y * std::sin(t), p.x * std::sin(t) + p.y * std::cos(t)};
}

double lean_of(const SyntheticCamera& camera) {
  return camera.lattice == LensLattice::Hexagonal ? 0.5 : 0;
}

BelowLens below_lens(const SyntheticCamera& camera, double x, double y) {
  const PlanePoint from{x - (camera.width - 1) / 2.0 - camera.origin.x,
                        y - (camera.height - 1) / 2.0 - camera.origin.y};
  const double r = std::hypot(from.x, from.y) / corner_of(camera);
  const double straight = 1 / (1 + camera.bend_px / corner_of(camera) * r * r);
  const PlanePoint flat = turned({from.x * straight, from.y * straight}, -camera.rotation_degrees);
  const double row = flat.y / camera.row_distance_px();
  BelowLens best;
  double least = 1e300;
  for (int j = static_cast<int>(std::floor(row)); j <= static_cast<int>(std::floor(row)) + 1; ++j) {
    const int i = static_cast<int>(std::lround(flat.x / camera.pitch_px - lean_of(camera) * j));
    const PlanePoint lens = camera.center(i, j);
    const PlanePoint offset{x - lens.x, y - lens.y};
    const double distance = offset.x * offset.x + offset.y * offset.y;
    if (distance >= least) continue;
    least = distance;
    best = {i, j, turned(offset, -camera.rotation_degrees)};
  }
  return best;
}

/// Share of the light that reaches a place below a lens.
double transmission(const SyntheticCamera& camera, const BelowLens& place, const PlanePoint& at) {
  const double radius = kLensRadius * camera.pitch_px;
  const PlanePoint lens = camera.center(place.i, place.j);
  const PlanePoint field{(lens.x - camera.width / 2.0) / corner_of(camera),
                         (lens.y - camera.height / 2.0) / corner_of(camera)};
  const double r = std::hypot(at.x, at.y) / radius;
  // The barrel of the main lens cuts in from the side of the corner.
  const double barrel = std::hypot(at.x / radius + 0.25 * field.x, at.y / radius + 0.25 * field.y);
  const auto edge = [&](double distance) {
    return std::clamp((1 - distance) * radius / 1.2 + 0.5, 0.03, 1.0);
  };
  const double main_lens = 1 - 0.3 * (field.x * field.x + field.y * field.y);
  return main_lens * (1 - 0.3 * r * r) * edge(r) * edge(barrel / 1.2);
}

double cubic(const std::array<double, 4>& p, double t) {
  return p[1] +
         0.5 * t *
             (p[2] - p[0] +
              t * (2 * p[0] - 5 * p[1] + 4 * p[2] - p[3] + t * (3 * (p[1] - p[2]) + p[3] - p[0])));
}

/// Turns what a screen shows into what the sensor sees of it, as the camera's metadata undo it.
class SensorColors {
 public:
  explicit SensorColors(const SyntheticCamera& camera) {
    for (int i = 0; i < 256; ++i) linear_[i] = std::pow(i / 255.0, 1 / camera.colors.gamma);
    Eigen::Matrix3d to_srgb;
    for (int k = 0; k < 9; ++k) to_srgb(k / 3, k % 3) = camera.colors.to_srgb[k];
    const Eigen::Matrix3d inverse = to_srgb.inverse();
    for (int c = 0; c < 3; ++c) {
      for (int k = 0; k < 3; ++k) rows_[c][k] = inverse(c, k) / camera.colors.balance[c];
    }
  }

  /// Light of one color of the sensor.
  [[nodiscard]] double at(const std::uint8_t* sample, int channels, int color) const {
    if (channels == 1) return linear_[sample[0]];
    const auto& row = rows_[color];
    return row[0] * linear_[sample[0]] + row[1] * linear_[sample[1]] + row[2] * linear_[sample[2]];
  }

 private:
  std::array<double, 256> linear_{};
  std::array<std::array<double, 3>, 3> rows_{};
};

/// Looks up rays in the views of a pupil row.
class RayLookup {
 public:
  RayLookup(const SyntheticCamera& camera, const Scene& row, int first_u, double v)
      : colors_(camera), row_(row), first_u_(first_u), v_(v) {}

  /// `x`, `y`: pixel of the view from pupil position (u, v).
  [[nodiscard]] double light(double x, double y, double u, double v, int color) const {
    const int nearest = static_cast<int>(std::lround(u));
    const ViewIndex view{0, std::clamp(nearest - first_u_, 0, row_.light_field->grid().u - 1)};
    const double du = u - nearest, dv = v - v_;
    const auto disparity = row_.truth->field.disparity.view(view);
    double d = 0;
    for (int round = 0; round < 3; ++round) {
      const int px = std::clamp(static_cast<int>(std::lround(x + d * du)), 0, disparity.width - 1);
      const int py = std::clamp(static_cast<int>(std::lround(y + d * dv)), 0, disparity.height - 1);
      d = disparity.at(py, px);
    }
    return interpolated(row_.light_field->view<std::uint8_t>(view), x + d * du, y + d * dv, color);
  }

 private:
  [[nodiscard]] double interpolated(ImageView<const std::uint8_t> view, double x, double y,
                                    int color) const {
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    std::array<double, 4> column{};
    for (int k = 0; k < 4; ++k) {
      const std::uint8_t* row = view.row(std::clamp(y0 + k - 1, 0, view.height - 1));
      std::array<double, 4> along{};
      for (int i = 0; i < 4; ++i) {
        const int at = std::clamp(x0 + i - 1, 0, view.width - 1);
        along[i] =
            colors_.at(row + static_cast<std::ptrdiff_t>(at) * view.channels, view.channels, color);
      }
      column[k] = cubic(along, x - x0);
    }
    return std::max(0.0, cubic(column, y - y0));
  }

  SensorColors colors_;
  const Scene& row_;
  int first_u_;
  double v_;
};

/// Farthest pupil position that a pixel sees, in whole view steps.
int pupil_reach(const SyntheticCamera& camera) {
  return static_cast<int>(std::ceil(0.6 * camera.pitch_px + 0.5));
}

PlanePoint ray_at(const BelowLens& place, int ray) {
  return {place.offset.x + (ray % 2 == 0 ? kRayOffset : -kRayOffset),
          place.offset.y + (ray / 2 == 0 ? kRayOffset : -kRayOffset)};
}

/// The row of the pupil that each pixel looks from.
Image<float> pupil_rows(const SyntheticCamera& camera, const Progress& progress) {
  Image<float> rows(camera.height, camera.width);
  parallel_for(camera.height, progress, [&](int y) {
    for (int x = 0; x < camera.width; ++x) {
      rows.at(y, x) = static_cast<float>(below_lens(camera, x, y).offset.y);
    }
  });
  return rows;
}

/// Adds the rays that look from the pupil row `v` to the light of all pixels. `rows`: pupil_rows.
void add_rays(const SyntheticCamera& camera, const RayLookup& lookup, const Image<float>& rows,
              int v, Image<float>& light, const Progress& progress) {
  const double to_views = 1 / camera.row_distance_px();
  const double middle_x = camera.view_width() / 2, middle_y = camera.view_height() / 2;
  parallel_for(camera.height, progress, [&](int y) {
    for (int x = 0; x < camera.width; ++x) {
      if (std::abs(rows.at(y, x) - v) > 0.5 + 2 * kRayOffset) continue;
      const BelowLens place = below_lens(camera, x, y);
      const double view_x =
          middle_x + (place.i + lean_of(camera) * place.j) * camera.pitch_px * to_views;
      const double view_y = middle_y + place.j;
      for (int ray = 0; ray < kRays; ++ray) {
        const PlanePoint at = ray_at(place, ray);
        if (std::lround(at.y) != v) continue;
        light.at(y, x) += static_cast<float>(
            transmission(camera, place, at) / kRays *
            lookup.light(view_x, view_y, at.x, at.y, color_at(camera.mosaic, y, x)));
      }
    }
  });
}

Image<float> white_light(const SyntheticCamera& camera, const Progress& progress) {
  Image<float> light(camera.height, camera.width);
  parallel_for(camera.height, progress, [&](int y) {
    for (int x = 0; x < camera.width; ++x) {
      const BelowLens place = below_lens(camera, x, y);
      const int color = color_at(camera.mosaic, y, x);
      double sum = 0;
      for (int ray = 0; ray < kRays; ++ray) {
        sum += transmission(camera, place, ray_at(place, ray));
      }
      light.at(y, x) = static_cast<float>(0.9 * sum / kRays / camera.colors.balance[color]);
    }
  });
  return light;
}

bool is_hot(const SyntheticCamera& camera, std::uint64_t pixel) {
  std::uint64_t hash = (pixel + camera.seed * 0x9E3779B97F4A7C15ULL) * 0xBF58476D1CE4E5B9ULL;
  hash = (hash ^ (hash >> 31)) * 0x94D049BB133111EBULL;
  return static_cast<double>((hash ^ (hash >> 29)) >> 11) * 0x1p-53 < camera.hot_share;
}

RawPicture developed(const SyntheticCamera& camera, const Image<float>& light, double noise,
                     unsigned seed) {
  RawPicture raw;
  raw.samples = Image<std::uint16_t>(camera.height, camera.width);
  raw.black = camera.black;
  raw.white = camera.white;
  raw.mosaic = camera.mosaic;
  raw.colors = camera.colors;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, noise);
  const double range = camera.white - camera.black;
  for (std::size_t k = 0; k < raw.samples.size(); ++k) {
    const double value =
        camera.black + range * (light.data()[k] + (noise > 0 ? normal(random) : 0));
    raw.samples.data()[k] = static_cast<std::uint16_t>(
        is_hot(camera, k) ? camera.white : std::clamp(value + 0.5, 0.0, camera.white));
  }
  return raw;
}

RawFacts facts_of(const SyntheticCamera& camera) {
  RawFacts facts;
  facts.model = camera.model == CameraModel::F01 ? "F01" : "ILLUM";
  facts.serial = camera.model == CameraModel::F01 ? "A000000001" : "B5000000001";
  facts.zoom_step = 600;
  facts.focus_step = 800;
  facts.exposure_s = 0.01;
  facts.iso = 100;
  facts.f_number = 2;
  facts.pixel_pitch_um = 1.4;
  facts.lens_pitch_um = 1.4 * camera.pitch_px;
  return facts;
}

std::vector<std::uint8_t> text_bytes(const std::string& text) {
  return {text.begin(), text.end()};
}

/// A container of a picture, with its white picture if there is one.
LfpContainer container_of(const std::vector<std::uint8_t>& samples, const std::string& metadata,
                          const std::string& serial, const std::vector<std::uint8_t>& white) {
  LfpContainer container;
  nlohmann::ordered_json frame;
  const auto add = [&](const char* key, std::vector<std::uint8_t> data) {
    frame[key] = lfp_reference(data);
    container.sections.push_back({false, {}, std::move(data)});
  };
  container.sections.push_back({true, {}, {}});
  add("metadataRef", text_bytes(metadata));
  const nlohmann::ordered_json hidden{{"camera", {{"serialNumber", serial}}}};
  add("privateMetadataRef", text_bytes(io::json_text(hidden, 2)));
  add("imageRef", samples);
  if (!white.empty()) add("modulationDataRef", white);
  nlohmann::ordered_json table;
  table["frames"] = {{{"frame", frame}}};
  container.sections.front().data = text_bytes(io::json_text(table, 2));
  return container;
}

void write_f01(const std::filesystem::path& folder, const SyntheticCamera& camera,
               const SyntheticPictures& pictures) {
  RawPicture raw = pictures.raw, white = pictures.white;
  raw.facts = white.facts = facts_of(camera);
  io::write_atomically(folder / "calibration/MOD_0001.RAW", pack(white.samples, camera.packing));
  io::write_atomically(folder / "calibration/MOD_0001.TXT", calibration_metadata(white));
  // Of another zoom, dark: a choice of it would show.
  white.facts.zoom_step = 300;
  std::ranges::fill(white.samples, static_cast<std::uint16_t>(camera.black));
  io::write_atomically(folder / "calibration/MOD_0000.RAW", pack(white.samples, camera.packing));
  io::write_atomically(folder / "calibration/MOD_0000.TXT", calibration_metadata(white));
  write_lfp(folder / "raw.lfp", container_of(pack(raw.samples, camera.packing), f01_metadata(raw),
                                             raw.facts.serial, {}));
}

void write_illum(const std::filesystem::path& folder, const SyntheticCamera& camera,
                 const SyntheticPictures& pictures) {
  RawPicture raw = pictures.raw;
  raw.facts = facts_of(camera);
  write_lfp(folder / "raw.lfr",
            container_of(pack(raw.samples, camera.packing), illum_metadata(raw), raw.facts.serial,
                         pack(pictures.white.samples, camera.packing)));
}

}  // namespace

Names<CameraModel> names_of(CameraModel) {
  return {
      {CameraModel::F01, "f01"}, {CameraModel::Illum, "illum"}, {CameraModel::Square, "square"}};
}

double SyntheticCamera::row_distance_px() const {
  return lattice == LensLattice::Hexagonal ? pitch_px * std::sqrt(0.75) : pitch_px;
}

PlanePoint SyntheticCamera::center(int i, int j) const {
  const PlanePoint flat =
      turned({(i + lean_of(*this) * j) * pitch_px, j * row_distance_px()}, rotation_degrees);
  const double r = std::hypot(flat.x, flat.y) / corner_of(*this);
  const double bent = 1 + bend_px / corner_of(*this) * r * r;
  return {(width - 1) / 2.0 + origin.x + flat.x * bent,
          (height - 1) / 2.0 + origin.y + flat.y * bent};
}

int SyntheticCamera::view_width() const {
  return static_cast<int>(width / row_distance_px()) / 2 * 2 + 5;
}

int SyntheticCamera::view_height() const {
  return static_cast<int>(height / row_distance_px()) / 2 * 2 + 5;
}

SyntheticCamera synthetic_camera(CameraModel model) {
  SyntheticCamera camera;
  camera.model = model;
  camera.origin = {0.37, -0.21};
  if (model == CameraModel::Square) {
    camera.width = 1600;
    camera.height = 1200;
    camera.lattice = LensLattice::Square;
    camera.pitch_px = 12.6;
    camera.black = 800;
    return camera;
  }
  const bool is_f01 = model == CameraModel::F01;
  camera.width = is_f01 ? 3280 : 7728;
  camera.height = is_f01 ? 3280 : 5368;
  camera.pitch_px = is_f01 ? 10.02 : 14.31;
  camera.mosaic = is_f01 ? Mosaic::Bggr : Mosaic::Grbg;
  camera.packing = is_f01 ? Packing::Bits12 : Packing::Bits10;
  camera.black = is_f01 ? 168 : 64;
  camera.white = is_f01 ? 4095 : 1023;
  camera.colors.balance = {1.3, 1, 1.26};
  camera.colors.is_balanced = true;
  camera.colors.to_srgb = {1.6, -0.5, -0.1, -0.2, 1.5, -0.3, 0.05, -0.45, 1.4};
  camera.colors.gamma = 0.41666;
  return camera;
}

SyntheticPictures expose(const SyntheticCamera& camera, const PupilLight& light,
                         const Progress& progress) {
  Image<float> sum(camera.height, camera.width);
  const Image<float> rows = pupil_rows(camera, progress.part(0, 0));
  const int reach = pupil_reach(camera);
  std::vector<CameraPosition> positions(2 * static_cast<std::size_t>(reach) + 1);
  for (int v = -reach; v <= reach; ++v) {
    for (int u = -reach; u <= reach; ++u) {
      positions[u + reach] = {static_cast<double>(u), static_cast<double>(v)};
    }
    const double begin = 0.9 * (v + reach) / (2 * reach + 1), part = 0.9 / (2 * reach + 1);
    const Scene row = light(positions, progress.part(begin, begin + 0.6 * part));
    add_rays(camera, {camera, row, -reach, static_cast<double>(v)}, rows, v, sum,
             progress.part(begin + 0.6 * part, begin + part));
  }
  SyntheticPictures pictures;
  pictures.raw = developed(camera, sum, camera.noise, camera.seed);
  // White and dark pictures are means of 16 exposures.
  pictures.white = developed(camera, white_light(camera, progress.part(0.9, 0.97)),
                             camera.noise / 4, camera.seed + 1);
  if (camera.model == CameraModel::Square) {
    pictures.dark = developed(camera, Image<float>(camera.height, camera.width), camera.noise / 4,
                              camera.seed + 2);
  }
  progress.report(1);
  return pictures;
}

std::filesystem::path write_pictures(const std::filesystem::path& folder,
                                     const SyntheticCamera& camera,
                                     const SyntheticPictures& pictures) {
  io::make_folder(folder);
  if (camera.model == CameraModel::F01) {
    io::make_folder(folder / "calibration");
    write_f01(folder, camera, pictures);
    return folder / "raw.lfp";
  }
  if (camera.model == CameraModel::Illum) {
    write_illum(folder, camera, pictures);
    return folder / "raw.lfr";
  }
  io::write_png(folder / "raw_white.png", pictures.white.samples.view());
  if (pictures.dark) io::write_png(folder / "raw_dark.png", pictures.dark->samples.view());
  io::write_png(folder / "raw.png", pictures.raw.samples.view());
  return folder / "raw.png";
}

}  // namespace episcope::capture
