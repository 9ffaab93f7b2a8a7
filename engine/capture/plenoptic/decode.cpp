// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/plenoptic/decode.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numbers>

namespace episcope::capture {
namespace {

constexpr float kDarkest = 0.3F;  // of the center of a lens; below, a sample is invalid
constexpr double kUnit = 32768;   // of devignetted samples: what 1 is stored as
constexpr double kMostViews = 15;
constexpr double kBrightLenses = 0.995;  // quantile of lenses that makes 1

using Levels = std::array<double, 3>;

/// Light of a pixel above the dark, in parts of the sensor's range.
class Light {
 public:
  Light(const RawPicture& picture, const std::optional<RawPicture>& dark)
      : picture_(picture),
        dark_(dark ? &dark->samples : nullptr),
        range_(1 / (picture.white - picture.black)) {}

  [[nodiscard]] double at(int y, int x) const {
    const double black = dark_ ? dark_->at(y, x) : picture_.black;
    return (picture_.samples.at(y, x) - black) * range_;
  }

 private:
  const RawPicture& picture_;
  const Image<std::uint16_t>* dark_;
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

/// What the sensor saw, without vignetting, and where anything was seen.
struct Devignetted {
  Image<std::uint16_t> light;   ///< kUnit = saturation.
  Image<std::uint8_t> is_seen;  ///< Empty without a white picture.
};

std::uint16_t stored(double value) {
  return static_cast<std::uint16_t>(std::clamp(value * kUnit + 0.5, 0.0, 65535.0));
}

/// Means over squares of `size` px; lenses with many pixels have more than views.
cv::Mat smoothed(const Image<float>& picture, int size) {
  cv::Mat result;
  cv::blur(cv::Mat(picture.height(), picture.width(), CV_32F, const_cast<float*>(picture.data())),
           result, {size, size}, {-1, -1}, cv::BORDER_REPLICATE);
  return result;
}

/// Light divided by the share of it that vignetting leaves, of the pixel (y, x) each.
template <class LightAt, class ShareAt>
Devignetted divided(const PlenopticPictures& pictures, const LightAt& light_at,
                    const ShareAt& share_at, const Progress& progress) {
  const int height = pictures.raw.samples.height(), width = pictures.raw.samples.width();
  Devignetted result{Image<std::uint16_t>(height, width), {}};
  if (pictures.white) result.is_seen = Image<std::uint8_t>(height, width);
  parallel_for(height, progress, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const double share = pictures.white ? share_at(y, x) : 1;
      result.light.at(y, x) = stored(light_at(y, x) / std::max(share, 0.02));
      if (pictures.white) result.is_seen.at(y, x) = share >= kDarkest;
    }
  });
  return result;
}

/// A gray picture of large lenses: light and white are averaged over the step of the views first.
Devignetted devignetted_means(const PlenopticPictures& pictures, const LensGrid& grid, int size,
                              const Progress& progress) {
  const auto means = [&](const Light& light, const Progress& part) {
    Image<float> values(pictures.raw.samples.height(), pictures.raw.samples.width());
    parallel_for(values.height(), part, [&](int y) {
      for (int x = 0; x < values.width(); ++x) values.at(y, x) = static_cast<float>(light.at(y, x));
    });
    return smoothed(values, size);
  };
  const cv::Mat light = means(Light(pictures.raw, pictures.dark), progress.part(0, 0.4));
  cv::Mat shade;
  double level = 1;
  if (pictures.white) {
    const Light white(*pictures.white, pictures.dark);
    shade = means(white, progress.part(0.4, 0.8));
    level = center_levels(*pictures.white, white, grid)[0];
  }
  return divided(
      pictures, [&](int y, int x) { return double{light.at<float>(y, x)}; },
      [&](int y, int x) { return shade.at<float>(y, x) / level; }, progress.part(0.8, 1));
}

Devignetted devignetted(const PlenopticPictures& pictures, const LensGrid& grid,
                        const Progress& progress) {
  const Light raw(pictures.raw, pictures.dark);
  const auto light = [&](int y, int x) { return raw.at(y, x); };
  if (!pictures.white) return divided(pictures, light, light, progress);
  const Light white(*pictures.white, pictures.dark);
  const Levels levels = center_levels(*pictures.white, white, grid);
  return divided(
      pictures, light,
      [&](int y, int x) { return white.at(y, x) / levels[color_at(pictures.raw.mosaic, y, x)]; },
      progress);
}

/// Replaces pixels that are brighter or darker than all neighbors of their color by a third, with
/// the mean of these.
std::size_t replace_hot_pixels(Image<std::uint16_t>& light, const Image<std::uint8_t>& is_seen,
                               Mosaic mosaic, const Progress& progress) {
  const int reach = mosaic == Mosaic::Gray ? 1 : 2;
  const Image<std::uint16_t> before = light;
  std::vector<std::size_t> counts(light.height());
  parallel_for(light.height() - 2 * reach, progress, [&](int item) {
    const int y = item + reach;
    for (int x = reach; x < light.width() - reach; ++x) {
      if (!is_seen.empty() && is_seen.at(y, x) == 0) continue;
      double low = 65535, high = 0, sum = 0;
      for (int k = 0; k < 9; ++k) {
        if (k == 4) continue;
        const double value = before.at(y + (k / 3 - 1) * reach, x + (k % 3 - 1) * reach);
        low = std::min(low, value);
        high = std::max(high, value);
        sum += value;
      }
      const double here = before.at(y, x);
      if (here <= 1.35 * high + 0.03 * kUnit && here >= 0.65 * low - 0.03 * kUnit) continue;
      light.at(y, x) = static_cast<std::uint16_t>(sum / 8);
      ++counts[y];
    }
  });
  std::size_t count = 0;
  for (const std::size_t each : counts) count += each;
  return count;
}

int bayer_code(Mosaic mosaic) {
  // OpenCV names the second and third pixel of the second row.
  switch (mosaic) {
    case Mosaic::Rggb:
      return cv::COLOR_BayerBG2RGB;
    case Mosaic::Grbg:
      return cv::COLOR_BayerGB2RGB;
    case Mosaic::Gbrg:
      return cv::COLOR_BayerGR2RGB;
    default:
      return cv::COLOR_BayerRG2RGB;
  }
}

Image<std::uint16_t> demosaiced(Image<std::uint16_t> light, Mosaic mosaic) {
  if (mosaic == Mosaic::Gray) return light;
  Image<std::uint16_t> colors(light.height(), light.width(), 3);
  const cv::Mat from(light.height(), light.width(), CV_16U, light.data());
  cv::Mat to(light.height(), light.width(), CV_16UC3, colors.data());
  cv::cvtColor(from, to, bayer_code(mosaic));
  return colors;
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
    for (int c = 0; c < 3; ++c) balanced[c] = std::clamp(linear[c] * balance_[c], 0.0F, 1.0F);
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
};

ViewGeometry geometry_of(const LensGrid& grid, const DecodeOptions& options, int height,
                         int width) {
  ViewGeometry g;
  g.step_px = options.step_px > 0 ? options.step_px : std::max(1.0, grid.pitch_px / kMostViews);
  const int room = static_cast<int>(grid.pitch_px / g.step_px + 1e-6);
  g.views = options.views > 0 ? options.views : std::max(1, room % 2 == 1 ? room : room - 1);
  if (g.views % 2 == 0) {
    throw InvalidInput(fmt::format("{} views have no center view; ask for an odd number", g.views));
  }
  if ((g.views - 1) * g.step_px > grid.pitch_px) {
    throw InvalidInput(
        fmt::format("{} views at a step of {:.3g} px do not fit below lenses of "
                    "{:.2f} px; ask for fewer views or a smaller step",
                    g.views, g.step_px, grid.pitch_px));
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
  return g;
}

/// Samples the views out of the light below the lenses.
class Sampler {
 public:
  Sampler(const Image<std::uint16_t>& light, const Devignetted& seen, const LensGrid& grid,
          const ViewGeometry& geometry, const Developer& developer)
      : light_(light),
        is_seen_(seen.is_seen),
        grid_(grid),
        geometry_(geometry),
        developer_(developer),
        samples_({geometry.views, geometry.views}, geometry.block.rows, geometry.width,
                 light.channels()),
        valid_(samples_.grid(), geometry.block.rows, geometry.width) {}

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
    line.light.resize(line.centers.size() * light_.channels());
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

  /// Bilinear samples at the same place below each lens of a row.
  void sample_lenses(const PlanePoint& offset, Line& line) const {
    const int channels = light_.channels();
    for (std::size_t i = 0; i < line.centers.size(); ++i) {
      const double px = std::clamp(line.centers[i].x + offset.x, 0.0, light_.width() - 1.001);
      const double py = std::clamp(line.centers[i].y + offset.y, 0.0, light_.height() - 1.001);
      const int x = static_cast<int>(px), y = static_cast<int>(py);
      const auto fx = static_cast<float>(px - x), fy = static_cast<float>(py - y);
      const std::uint16_t* top = light_.row(y) + x * channels;
      const std::uint16_t* bottom = light_.row(y + 1) + x * channels;
      for (int c = 0; c < channels; ++c) {
        const float upper = top[c] + fx * (float(top[c + channels]) - float(top[c]));
        const float lower = bottom[c] + fx * (float(bottom[c + channels]) - float(bottom[c]));
        line.light[i * channels + c] = (upper + fy * (lower - upper)) * float(1 / kUnit);
      }
      line.valid[i] =
          is_inside(line.centers[i], offset) &&
          (is_seen_.empty() || is_seen_.at(fy < 0.5F ? y : y + 1, fx < 0.5F ? x : x + 1));
    }
  }

  [[nodiscard]] bool is_inside(const PlanePoint& center, const PlanePoint& offset) const {
    const double x = center.x + offset.x, y = center.y + offset.y;
    return x >= 0 && y >= 0 && x <= light_.width() - 1 && y <= light_.height() - 1;
  }

  void write_row(ViewIndex view, int row, const Line& line) {
    const int channels = light_.channels();
    const int lenses = static_cast<int>(line.centers.size());
    std::uint16_t* out = samples_.view(view).row(row);
    std::uint8_t* valid = valid_.view(view).row(row);
    for (int x = 0; x < geometry_.width; ++x) {
      const auto& [lens, is_on_lens, weights] = line.places[x];
      float light[3] = {};
      if (is_on_lens) {
        std::copy_n(&line.light[static_cast<std::size_t>(lens) * channels], channels, light);
        valid[x] = line.valid[lens];
      } else {
        for (int k = 0; k < 6; ++k) {
          const std::size_t at = std::clamp(lens + k - 2, 0, lenses - 1);
          for (int c = 0; c < channels; ++c) light[c] += weights[k] * line.light[at * channels + c];
        }
        valid[x] = line.valid[lens] && line.valid[std::min(lens + 1, lenses - 1)];
      }
      developer_.develop(light, out + static_cast<std::ptrdiff_t>(x) * channels);
    }
  }

  const Image<std::uint16_t>& light_;
  const Image<std::uint8_t>& is_seen_;
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

/// Says so if the lenses stand otherwise than the optics tell. The main lens spreads them a little.
void check_pitch(const RawFacts& facts, Decoded& decoded) {
  constexpr double kSpread = 0.1;
  if (!facts.lens_pitch_um || !facts.pixel_pitch_um) return;
  const double expected = *facts.lens_pitch_um / *facts.pixel_pitch_um;
  if (std::abs(decoded.grid.pitch_px / expected - 1) < kSpread) return;
  decoded.warnings.push_back(
      fmt::format(finding_text("plenoptic.pitch"), decoded.grid.pitch_px, expected));
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
  return fit_lens_grid(evened(shown, pictures.dark, progress.part(0, 0.2)), progress.part(0.2, 1),
                       pictures.white ? LensLight::Even : LensLight::Scene);
}

Decoded decode(const PlenopticPictures& pictures, const LensGrid& grid,
               const DecodeOptions& options, const Progress& progress) {
  require_matching(pictures);
  const RawPicture& raw = pictures.raw;
  Decoded decoded;
  decoded.grid = grid;
  if (!pictures.white) decoded.warnings.emplace_back(finding_text("plenoptic.no_white"));
  check_pitch(raw.facts, decoded);
  const ViewGeometry geometry =
      geometry_of(grid, options, raw.samples.height(), raw.samples.width());
  decoded.step_px = geometry.step_px;
  decoded.first_x =
      static_cast<int>(std::lround(geometry.block.first_column / geometry.column_step));
  decoded.first_y = geometry.block.first_row;
  progress.step("removing vignetting");
  const int mean = static_cast<int>(geometry.step_px + 0.5);
  Devignetted seen = raw.mosaic == Mosaic::Gray && mean > 1
                         ? devignetted_means(pictures, grid, mean | 1, progress.part(0, 0.2))
                         : devignetted(pictures, grid, progress.part(0, 0.2));
  decoded.hot_pixels =
      replace_hot_pixels(seen.light, seen.is_seen, raw.mosaic, progress.part(0.2, 0.35));
  progress.check();
  progress.step("demosaicing");
  const Image<std::uint16_t> light = demosaiced(std::move(seen.light), raw.mosaic);
  progress.report(0.5);
  progress.step("sampling views");
  const Developer developer(raw.colors, light.channels(), options.is_linear);
  Sampler sampler(light, seen, grid, geometry, developer);
  sampler.run(progress.part(0.5, 1));
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
