// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/plenoptic/decode.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <utility>

namespace episcope::capture {
namespace {

constexpr float kDarkest = 0.3F;      // of the center of a lens; below, a sample is invalid
constexpr double kLeastShare = 0.02;  // of the light; what is darker is not made brighter
constexpr float kHotMargin = 0.06F;   // of the sensor's range; hot pixels exceed it
constexpr float kOtherLens = 1e-3F;  // weight of pixels below another lens: only if there is no own
constexpr double kMostViews = 15;
constexpr double kWorstOff = 0.06;  // of the pitch, of lenses that are those of the raw picture
constexpr double kBrightLenses = 0.995;  // quantile of lenses that makes 1

using Levels = std::array<double, 3>;

/// Light of a pixel above the dark, in parts of the sensor's range.
class Light {
 public:
  Light(const RawPicture& picture, const std::optional<RawPicture>& dark)
      : picture_(picture),
        dark_(dark ? &dark->samples : nullptr),
        dark_scale_(dark ? picture.white / dark->white : 1),
        range_(1 / (picture.white - picture.black)) {}

  [[nodiscard]] double at(int y, int x) const {
    const double black = dark_ ? dark_->at(y, x) * dark_scale_ : picture_.black;
    return (picture_.samples.at(y, x) - black) * range_;
  }

 private:
  const RawPicture& picture_;
  const Image<std::uint16_t>* dark_;
  double dark_scale_;  ///< Its samples may have other bits.
  double range_;
};

/// One value for all colors: light divided by the mean of its color.
Image<float> evened(const RawPicture& picture, const std::optional<RawPicture>& dark,
                    const Progress& progress) {
  const int height = picture.samples.height(), width = picture.samples.width();
  const Light light(picture, dark);
  std::array<double, 4> sums{};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) sums[(y & 1) * 2 + (x & 1)] += light.at(y, x);
  }
  const double total = (sums[0] + sums[1] + sums[2] + sums[3]) / 4;
  Image<float> even(height, width);
  parallel_for(height, progress, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const double sum = picture.mosaic == Mosaic::Gray ? total : sums[(y & 1) * 2 + (x & 1)];
      even.at(y, x) = static_cast<float>(sum > 0 ? light.at(y, x) * total / sum : 0);
    }
  });
  return even;
}

/// Light of each color in the middle of the brightest lenses.
Levels center_levels(const RawPicture& white, const Light& light, const LensGrid& grid) {
  const int reach = std::max(1, static_cast<int>(grid.pitch_px / 10));
  const int height = white.samples.height(), width = white.samples.width();
  const LensBlock block = lens_block(grid, height, width, reach + 1);
  std::array<std::vector<double>, 3> values;
  for (int j = block.first_row; j < block.first_row + block.rows; ++j) {
    const int first = static_cast<int>(std::ceil(lens_at(grid, block.first_column, j)));
    for (int i = first; i < first + static_cast<int>(block.columns); ++i) {
      const PlanePoint at = grid.center(i, j);
      const int x = static_cast<int>(std::lround(at.x)), y = static_cast<int>(std::lround(at.y));
      Levels sums{}, counts{};
      for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
          const int color = color_at(white.mosaic, y + dy, x + dx);
          sums[color] += light.at(y + dy, x + dx);
          counts[color] += 1;
        }
      }
      for (int c = 0; c < 3; ++c) {
        if (counts[c] > 0) values[c].push_back(sums[c] / counts[c]);
      }
    }
  }
  Levels levels{1, 1, 1};
  for (int c = 0; c < 3; ++c) {
    if (!values[c].empty()) levels[c] = quantile(values[c], kBrightLenses);
    if (levels[c] <= 0) {
      throw InvalidInput("the white picture is black; take one of an evenly lit area");
    }
  }
  return levels;
}

/// What the sensor saw, vignetting removed, and the share of the light that this leaves.
struct Devignetted {
  Image<float> light;      ///< 1 = saturation.
  Image<float> share;      ///< Empty without a white picture.
  Levels levels{1, 1, 1};  ///< Of the white picture's colors.

  [[nodiscard]] float share_at(int y, int x) const { return share.empty() ? 1 : share.at(y, x); }
};

Devignetted devignetted(const PlenopticPictures& pictures, const LensGrid& grid,
                        const Progress& progress) {
  const int height = pictures.raw.samples.height(), width = pictures.raw.samples.width();
  Devignetted result{Image<float>(height, width), {}};
  const Light raw(pictures.raw, pictures.dark);
  if (!pictures.white) {
    parallel_for(height, progress, [&](int y) {
      for (int x = 0; x < width; ++x) result.light.at(y, x) = static_cast<float>(raw.at(y, x));
    });
    return result;
  }
  const Light white(*pictures.white, pictures.dark);
  result.levels = center_levels(*pictures.white, white, grid);
  result.share = Image<float>(height, width);
  parallel_for(height, progress, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const double share = white.at(y, x) / result.levels[color_at(pictures.raw.mosaic, y, x)];
      result.share.at(y, x) = static_cast<float>(share);
      result.light.at(y, x) = static_cast<float>(raw.at(y, x) / std::max(share, kLeastShare));
    }
  });
  return result;
}

/// Replaces pixels that are brighter or darker than all neighbors of their color by a third, with
/// the mean of these.
std::size_t replace_hot_pixels(Devignetted& seen, Mosaic mosaic, const Progress& progress) {
  const int reach = mosaic == Mosaic::Gray ? 1 : 2;
  const int height = seen.light.height(), width = seen.light.width();
  std::vector<std::vector<std::pair<int, float>>> replaced(height);
  parallel_for(height - 2 * reach, progress, [&](int item) {
    const int y = item + reach;
    for (int x = reach; x < width - reach; ++x) {
      float low = 1e9F, high = -1e9F, sum = 0;
      for (int k = 0; k < 9; ++k) {
        if (k == 4) continue;
        const float value = seen.light.at(y + (k / 3 - 1) * reach, x + (k % 3 - 1) * reach);
        low = std::min(low, value);
        high = std::max(high, value);
        sum += value;
      }
      const float here = seen.light.at(y, x);
      const float noise = kHotMargin / std::max(seen.share.at(y, x), float(kLeastShare));
      if (here <= 1.35F * high + noise && here >= 0.65F * low - noise) continue;
      replaced[y].emplace_back(x, sum / 8);
    }
  });
  std::size_t count = 0;
  for (int y = 0; y < height; ++y) {
    for (const auto& [x, light] : replaced[y]) seen.light.at(y, x) = light;
    count += replaced[y].size();
  }
  return count;
}

/// Turns linear colors of the camera into samples.
class Developer {
 public:
  Developer(const RawColors& colors, int channels, bool is_linear) : channels_(channels) {
    const bool has_colors = channels == 3;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        matrix_[3 * row + column] =
            static_cast<float>(has_colors ? colors.to_srgb[3 * row + column] : row == column);
      }
      balance_[row] = static_cast<float>(has_colors ? colors.balance[row] : 1);
    }
    curve_.resize(kCurve + 1);
    const double gamma = is_linear ? 1 : colors.gamma;
    for (int i = 0; i <= kCurve; ++i) {
      curve_[i] = to_word_sample(static_cast<float>(std::pow(double(i) / kCurve, gamma)));
    }
  }

  void develop(const float* linear, std::uint16_t* out) const {
    if (channels_ == 1) {
      out[0] = curved(linear[0]);
      return;
    }
    float balanced[3];
    for (int c = 0; c < 3; ++c) balanced[c] = std::min(linear[c] * balance_[c], 1.0F);
    for (int c = 0; c < 3; ++c) {
      const float* m = &matrix_[3 * c];
      out[c] = curved(m[0] * balanced[0] + m[1] * balanced[1] + m[2] * balanced[2]);
    }
  }

 private:
  static constexpr int kCurve = 1 << 16;

  [[nodiscard]] std::uint16_t curved(float value) const {
    return curve_[static_cast<std::size_t>(std::clamp(value, 0.0F, 1.0F) * kCurve + 0.5F)];
  }

  int channels_;
  std::array<float, 9> matrix_{};
  std::array<float, 3> balance_{};
  std::vector<std::uint16_t> curve_;
};

/// Weights of Lanczos' windowed sinc of 3 lobes for a fraction in [0, 1).
std::array<float, 6> lanczos_weights(double fraction) {
  std::array<double, 6> weights{};
  double sum = 0;
  for (int k = 0; k < 6; ++k) {
    const double x = std::numbers::pi * (k - 2 - fraction);
    weights[k] = std::abs(x) < 1e-9 ? 1 : 3 * std::sin(x) * std::sin(x / 3) / (x * x);
    sum += weights[k];
  }
  std::array<float, 6> unit{};
  for (int k = 0; k < 6; ++k) unit[k] = static_cast<float>(weights[k] / sum);
  return unit;
}

/// Geometry of the views: which lenses are their pixels.
struct ViewGeometry {
  LensBlock block;
  int views = 1;
  double step_px = 1;
  int width = 0;
  double column_step = 1;  ///< In pitches.
  PlanePoint u;            ///< On the sensor, from one view to the next.
  PlanePoint v;
  /// To neighboring lenses, divided by the squared distance; the third is 0 on a square lattice.
  std::array<std::array<float, 2>, 3> neighbors{};

  /// Whether a place, from the center of a lens, is nearest to this lens.
  [[nodiscard]] bool is_below_lens(float x, float y) const {
    return std::ranges::all_of(
        neighbors, [&](const auto& n) { return std::abs(x * n[0] + y * n[1]) <= 0.5F; });
  }
};

void set_neighbors(const LensGrid& grid, double turn, ViewGeometry& g) {
  const double lean = grid.lattice == LensLattice::Hexagonal ? grid.pitch_px / 2 : 0;
  const PlanePoint flat[] = {
      {grid.pitch_px, 0}, {lean, grid.row_distance_px}, {-lean, grid.row_distance_px}};
  for (int k = 0; k < (lean > 0 ? 3 : 2); ++k) {
    const auto [x, y] = flat[k];
    const double square = x * x + y * y;
    g.neighbors[k] = {static_cast<float>((x * std::cos(turn) - y * std::sin(turn)) / square),
                      static_cast<float>((x * std::sin(turn) + y * std::cos(turn)) / square)};
  }
}

ViewGeometry geometry_of(const LensGrid& grid, const DecodeOptions& options, int height,
                         int width) {
  ViewGeometry g;
  if (!(options.step_px >= 0)) throw InvalidInput("the step between views is no length in px");
  g.step_px = options.step_px > 0 ? options.step_px : std::max(1.0, grid.pitch_px / kMostViews);
  const int room = static_cast<int>(grid.pitch_px / g.step_px + 1e-6);
  g.views = options.views > 0 ? options.views : std::max(1, room % 2 == 1 ? room : room - 1);
  if (g.views % 2 == 0) {
    throw InvalidInput(fmt::format("{} views have no center view; ask for an odd number", g.views));
  }
  const bool is_single = g.views == 1 && options.views == 0;
  if (is_single || std::max(1, g.views - 1) * g.step_px > grid.pitch_px) {
    throw InvalidInput(
        fmt::format("{} views at a step of {:.3g} px do not fit below lenses of "
                    "{:.2f} px; ask for fewer views or a smaller step",
                    is_single ? 3 : g.views, g.step_px, grid.pitch_px));
  }
  const double border = g.views / 2 * g.step_px + 1;
  g.block = lens_block(grid, height, width, border);
  g.column_step = grid.lattice == LensLattice::Hexagonal ? grid.row_distance_px / grid.pitch_px : 1;
  // A pixel of the views lies on lens (0, 0).
  const double end = g.block.first_column + g.block.columns;
  g.block.first_column = std::ceil(g.block.first_column / g.column_step) * g.column_step;
  g.width = static_cast<int>((end - g.block.first_column) / g.column_step) + 1;
  const double turn = grid.rotation_degrees * std::numbers::pi / 180;
  g.u = {g.step_px * std::cos(turn), g.step_px * std::sin(turn)};
  g.v = {-g.u.y, g.u.x};
  set_neighbors(grid, grid.has_columns ? turn + std::numbers::pi / 2 : turn, g);
  return g;
}

/// Samples the views out of the light below the lenses.
class Sampler {
 public:
  Sampler(const Devignetted& seen, Mosaic mosaic, const LensGrid& grid,
          const ViewGeometry& geometry, const Developer& developer)
      : seen_(seen),
        channels_(mosaic == Mosaic::Gray ? 1 : 3),
        reach_(static_cast<float>(
            std::max(channels_ == 1 ? 1.0 : 2.0, std::min(geometry.step_px, grid.pitch_px / 2)))),
        grid_(grid),
        geometry_(geometry),
        developer_(developer),
        samples_({geometry.views, geometry.views},
                 grid.has_columns ? geometry.width : geometry.block.rows,
                 grid.has_columns ? geometry.block.rows : geometry.width, channels_),
        valid_(samples_.grid(), samples_.height(), samples_.width()) {
    for (int k = 0; k < 4; ++k) colors_[k] = color_at(mosaic, k / 2, k % 2);
  }

  void run(const Progress& progress) {
    parallel_for(geometry_.block.rows, progress, [this](int row) { sample_row(row); });
  }

  ViewStack<std::uint16_t> samples() { return std::move(samples_); }
  ViewStack<std::uint8_t> valid() { return std::move(valid_); }

 private:
  /// Where a pixel of the views lies: on a lens of the line, or between it and the next.
  struct Place {
    int lens = 0;
    bool is_on_lens = false;
    std::array<float, 6> weights{};  ///< Of the lenses from two before on.
  };
  struct Line {
    int first = 0;  ///< Lens.
    std::vector<PlanePoint> centers;
    std::vector<Place> places;  ///< Of the pixels; the same in all views.
    std::vector<float> light;   ///< [lens][channel]
    std::vector<std::uint8_t> valid;
  };

  void sample_row(int row) {
    const int j = geometry_.block.first_row + row;
    const double begin = lens_at(grid_, geometry_.block.first_column, j);
    const double end = begin + (geometry_.width - 1) * geometry_.column_step;
    Line line;
    line.first = static_cast<int>(std::floor(begin + 1e-9));
    for (int i = line.first; i <= static_cast<int>(std::ceil(end - 1e-9)); ++i) {
      line.centers.push_back(grid_.center(i, j));
    }
    place_pixels(begin - line.first, line);
    line.light.resize(line.centers.size() * channels_);
    line.valid.resize(line.centers.size());
    const int middle = geometry_.views / 2;
    for (int v = 0; v < geometry_.views; ++v) {
      for (int u = 0; u < geometry_.views; ++u) {
        const PlanePoint offset{(u - middle) * geometry_.u.x + (v - middle) * geometry_.v.x,
                                (u - middle) * geometry_.u.y + (v - middle) * geometry_.v.y};
        sample_lenses(offset, line);
        write_row({v, u}, row, line);
      }
    }
  }

  /// The first pixel is `begin` lenses right of the first of the line.
  void place_pixels(double begin, Line& line) const {
    const int lenses = static_cast<int>(line.centers.size());
    for (int x = 0; x < geometry_.width; ++x) {
      const double at = begin + x * geometry_.column_step;
      Place place;
      place.lens = std::clamp(static_cast<int>(std::floor(at + 1e-6)), 0, lenses - 1);
      const double fraction = at - place.lens;
      place.is_on_lens = std::abs(fraction) < 1e-5;
      if (!place.is_on_lens) place.weights = lanczos_weights(fraction);
      line.places.push_back(place);
    }
  }

  /// The same place below each lens of a row.
  void sample_lenses(const PlanePoint& offset, Line& line) const {
    const bool is_below_lens = geometry_.is_below_lens(float(offset.x), float(offset.y));
    const bool is_near_others = std::hypot(offset.x, offset.y) + reach_ * std::numbers::sqrt2 >
                                std::min(grid_.pitch_px, grid_.row_distance_px) / 2;
    for (std::size_t i = 0; i < line.centers.size(); ++i) {
      const float share =
          sample(line.centers[i], offset, is_near_others, &line.light[i * channels_]);
      line.valid[i] = is_below_lens && share >= kDarkest && is_inside(line.centers[i], offset);
    }
  }

  /// Light below a lens, interpolated between pixels of each color; dark pixels count less.
  /// Returns the share of the light that vignetting leaves there.
  float sample(const PlanePoint& center, const PlanePoint& offset, bool is_near_others,
               float* out) const {
    const auto px = static_cast<float>(std::clamp(center.x + offset.x, 0.0, width() - 1.0));
    const auto py = static_cast<float>(std::clamp(center.y + offset.y, 0.0, height() - 1.0));
    const auto first = [&](float at) { return std::max(0, static_cast<int>(at - reach_ + 1)); };
    const int last_x = std::min(width() - 1, static_cast<int>(px + reach_));
    const int last_y = std::min(height() - 1, static_cast<int>(py + reach_));
    std::array<float, 3> light{}, weight{};
    float share = 0, all = 1e-9F;
    for (int y = first(py); y <= last_y; ++y) {
      const float dy = (static_cast<float>(y) - py) / reach_;
      for (int x = first(px); x <= last_x; ++x) {
        const float dx = (static_cast<float>(x) - px) / reach_;
        const int c = colors_[(y & 1) * 2 + (x & 1)];
        // Green pixels are a lattice turned by 45°.
        float w = c == 1 ? tent(dx + dy) * tent(dx - dy) : tent(dx) * tent(dy);
        if (is_near_others && !geometry_.is_below_lens(float(x - center.x), float(y - center.y)))
          w *= kOtherLens;
        const float here = seen_.share_at(y, x);
        share += w * here;
        all += w;
        w *= std::clamp(here / kDarkest, 0.0F, 1.0F);
        light[c] += w * seen_.light.at(y, x);
        weight[c] += w;
      }
    }
    for (int c = 0; c < channels_; ++c) out[c] = light[c] / std::max(weight[c], 1e-9F);
    return share / all;
  }

  static float tent(float distance) { return std::max(0.0F, 1 - std::abs(distance)); }
  [[nodiscard]] int width() const { return seen_.light.width(); }
  [[nodiscard]] int height() const { return seen_.light.height(); }

  [[nodiscard]] bool is_inside(const PlanePoint& center, const PlanePoint& offset) const {
    const double x = center.x + offset.x, y = center.y + offset.y;
    return x >= 0 && y >= 0 && x <= width() - 1 && y <= height() - 1;
  }

  void write_row(ViewIndex view, int row, const Line& line) {
    const int channels = channels_;
    const int lenses = static_cast<int>(line.centers.size());
    const auto samples = samples_.view(view);
    const auto is_valid = valid_.view(view);
    for (int x = 0; x < geometry_.width; ++x) {
      const int at_y = grid_.has_columns ? x : row, at_x = grid_.has_columns ? row : x;
      std::uint8_t& valid = is_valid.at(at_y, at_x);
      const auto& [lens, is_on_lens, weights] = line.places[x];
      float light[3] = {};
      if (is_on_lens) {
        std::copy_n(&line.light[static_cast<std::size_t>(lens) * channels], channels, light);
        valid = line.valid[lens];
      } else {
        for (int k = 0; k < 6; ++k) {
          const std::size_t at = std::clamp(lens + k - 2, 0, lenses - 1);
          for (int c = 0; c < channels; ++c) light[c] += weights[k] * line.light[at * channels + c];
        }
        valid = line.valid[lens] && line.valid[std::min(lens + 1, lenses - 1)];
      }
      developer_.develop(light, &samples.at(at_y, at_x));
    }
  }

  const Devignetted& seen_;
  int channels_;
  float reach_;  ///< px from a place, of the pixels that are interpolated there.
  std::array<int, 4> colors_{};
  const LensGrid& grid_;
  const ViewGeometry& geometry_;
  const Developer& developer_;
  ViewStack<std::uint16_t> samples_;
  ViewStack<std::uint8_t> valid_;
};

double sharpness_of(const LightField& field) {
  const Image<float> view = field.view_as_float(field.center());
  double difference = 0, sum = 0, squares = 0;
  const int channels = view.channels();
  const int row = view.width() * channels;
  for (int y = 0; y < view.height(); ++y) {
    const float* samples = view.row(y);
    for (int x = 0; x < row; ++x) {
      sum += samples[x];
      squares += samples[x] * samples[x];
      if (x >= channels) difference += std::pow(samples[x] - samples[x - channels], 2);
    }
  }
  const double n = static_cast<double>(view.size());
  const double variance = squares / n - sum * sum / (n * n);
  return variance > 0 ? std::sqrt(difference / n / variance) : 0;
}

void require_same(const RawPicture& raw, const RawPicture& other, const char* what) {
  if (raw.samples.height() != other.samples.height() ||
      raw.samples.width() != other.samples.width()) {
    throw InvalidInput(fmt::format(
        "the {} picture {} has {}×{} px, but the raw picture {} has {}×{}; use one of this camera",
        what, other.name, other.samples.width(), other.samples.height(), raw.name,
        raw.samples.width(), raw.samples.height()));
  }
  if (raw.mosaic != other.mosaic) {
    throw InvalidInput(
        fmt::format("the {} picture {} has the mosaic {}, but the raw picture {} has {}; use one "
                    "of this camera",
                    what, other.name, name_of(other.mosaic), raw.name, name_of(raw.mosaic)));
  }
}

/// Compares the lenses of the white picture with those that the raw picture itself shows. Throws
/// InvalidInput if these are another lattice.
void check_white(const PlenopticPictures& pictures, LensGrid& grid, const Progress& progress) {
  const Image<float> raw = evened(pictures.raw, pictures.dark, progress.part(0, 0.1));
  grid.raw_off_px = distance_from_lenses(raw, grid, progress.part(0.1, 1));
  if (grid.raw_off_px < kWorstOff * grid.pitch_px) return;
  LensGrid own;
  try {
    own = fit_lens_grid(raw, progress.part(1, 1), LensLight::Scene);
  } catch (const InvalidInput&) {
    return;  // It shows none.
  }
  if (own.lattice == grid.lattice && std::abs(own.pitch_px / grid.pitch_px - 1) < 0.005 &&
      std::abs(own.rotation_degrees - grid.rotation_degrees) < 0.25) {
    return;
  }
  throw InvalidInput(fmt::format(
      "the white picture {} is of another camera or zoom: its lenses are {} and {:.2f} px apart, "
      "turned by {:.2f}°, those of the raw picture {} are {} and {:.2f} px apart, turned by "
      "{:.2f}°; use one of this camera",
      pictures.white->name, lattice_name(grid.lattice), grid.pitch_px, grid.rotation_degrees,
      pictures.raw.name, lattice_name(own.lattice), own.pitch_px, own.rotation_degrees));
}

/// Says so if the lenses stand otherwise than the optics tell. The main lens spreads them a little.
void check_pitch(const RawFacts& facts, Decoded& decoded) {
  constexpr double kSpread = 0.1;
  if (!facts.lens_pitch_um || !facts.pixel_pitch_um) return;
  const double expected = *facts.lens_pitch_um / *facts.pixel_pitch_um;
  if (std::abs(decoded.grid.pitch_px / expected - 1) < kSpread) return;
  decoded.warnings.push_back(
      fmt::format(finding_text("plenoptic.pitch"), decoded.grid.pitch_px, expected));
}

/// What is to be said before decoding. `decoded` has its grid.
void warn(const PlenopticPictures& pictures, const DecodeOptions& options, Decoded& decoded) {
  if (!pictures.white) decoded.warnings.emplace_back(finding_text("plenoptic.no_white"));
  if (options.is_linear && pictures.raw.colors.gamma == 1) {
    decoded.warnings.push_back(fmt::format(finding_text("option.ignored"), "linear",
                                           "a picture that is not gamma-encoded"));
  }
  const LensGrid& grid = decoded.grid;
  if (grid.raw_off_px > kWorstOff * grid.pitch_px) {
    decoded.warnings.push_back(fmt::format(finding_text("plenoptic.white_off"), grid.raw_off_px));
  }
  check_pitch(pictures.raw.facts, decoded);
}

/// Tells what is wrong with the white picture's exposure.
void check_exposure(const RawPicture& white, const Levels& levels, Decoded& decoded) {
  const double saturated = saturated_share(white);
  if (saturated > kMostSaturated) {
    decoded.warnings.push_back(
        fmt::format(finding_text("plenoptic.white_saturated"), 100 * saturated));
  }
  const double level = levels[white.mosaic == Mosaic::Gray ? 0 : 1];
  if (level < kDarkWhite) {
    decoded.warnings.push_back(fmt::format(finding_text("plenoptic.white_dark"), 100 * level));
  }
}

/// Colors of the camera; if it says nothing of its white balance, that of the white picture.
RawColors balanced(const RawPicture& raw, const Levels& levels, Decoded& decoded) {
  RawColors colors = raw.colors;
  if (colors.is_balanced || raw.mosaic == Mosaic::Gray) return colors;
  for (int c = 0; c < 3; ++c) colors.balance[c] = levels[1] / levels[c];
  decoded.warnings.push_back(
      fmt::format(finding_text("plenoptic.neutral"), colors.balance[0], colors.balance[2]));
  return colors;
}

void drop_unneeded_mask(ViewStack<std::uint8_t>& valid, Decoded& decoded) {
  const std::size_t seen = static_cast<std::size_t>(
      std::count(valid.data(), valid.data() + valid.size(), std::uint8_t{1}));
  decoded.valid_percent = 100.0 * static_cast<double>(seen) / static_cast<double>(valid.size());
  if (seen == valid.size()) valid = {};
}

}  // namespace

Schema<DecodeOptions> decode_schema() {
  return Schema<DecodeOptions>()
      .integer("views", &DecodeOptions::views,
               {"Views along each axis", "Odd; 0 = as many as a lens has room for"}, {0, 63})
      .real("step", &DecodeOptions::step_px,
            {"Step", "Between neighboring views below a lens; 0 = found", "px"}, {0, 1000})
      .flag("linear", &DecodeOptions::is_linear, {"Linear", "Leave out the gamma of the camera"});
}

void require_matching(const PlenopticPictures& pictures) {
  if (pictures.white) require_same(pictures.raw, *pictures.white, "white");
  if (pictures.dark) require_same(pictures.raw, *pictures.dark, "dark");
}

LensGrid find_lenses(const PlenopticPictures& pictures, const Progress& progress) {
  require_matching(pictures);
  const RawPicture& shown = pictures.white ? *pictures.white : pictures.raw;
  LensGrid grid;
  try {
    grid =
        fit_lens_grid(evened(shown, pictures.dark, progress.part(0, 0.2)), progress.part(0.2, 0.8),
                      pictures.white ? LensLight::Even : LensLight::Scene);
  } catch (const InvalidInput& error) {
    throw InvalidInput(shown.name + ": " + error.what());
  }
  if (pictures.white) check_white(pictures, grid, progress.part(0.8, 1));
  return grid;
}

Decoded decode(const PlenopticPictures& pictures, const LensGrid& grid,
               const DecodeOptions& options, const Progress& progress) {
  require_matching(pictures);
  const RawPicture& raw = pictures.raw;
  Decoded decoded;
  decoded.grid = grid;
  warn(pictures, options, decoded);
  const ViewGeometry geometry =
      geometry_of(grid, options, raw.samples.height(), raw.samples.width());
  decoded.step_px = geometry.step_px;
  decoded.first_x =
      static_cast<int>(std::lround(geometry.block.first_column / geometry.column_step));
  decoded.first_y = geometry.block.first_row;
  if (grid.has_columns) std::swap(decoded.first_x, decoded.first_y);
  progress.step("removing vignetting");
  Devignetted seen = devignetted(pictures, grid, progress.part(0, 0.2));
  RawColors colors = raw.colors;
  if (pictures.white) {
    check_exposure(*pictures.white, seen.levels, decoded);
    colors = balanced(raw, seen.levels, decoded);
    // Without it, texture within the edges of lenses looks the same.
    decoded.hot_pixels = replace_hot_pixels(seen, raw.mosaic, progress.part(0.2, 0.4));
  }
  progress.check();
  progress.step("sampling views");
  const Developer developer(colors, raw.mosaic == Mosaic::Gray ? 1 : 3, options.is_linear);
  Sampler sampler(seen, raw.mosaic, grid, geometry, developer);
  sampler.run(progress.part(0.4, 1));
  ViewStack<std::uint8_t> valid = sampler.valid();
  drop_unneeded_mask(valid, decoded);
  LightFieldInfo info;
  info.name = std::filesystem::path(raw.name).stem().string();
  info.source = raw.source;
  decoded.light_field =
      std::make_shared<const LightField>(sampler.samples(), std::move(info), std::move(valid));
  decoded.sharpness = sharpness_of(*decoded.light_field);
  decoded.is_gamma_encoded = !options.is_linear && raw.colors.gamma != 1;
  return decoded;
}

}  // namespace episcope::capture
