// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/net_evidence.h"

#include "engine/core/isa.h"
#include "engine/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

namespace episcope {

namespace {

int sector_of(int dv, int du) {
  constexpr double kEighth = std::numbers::pi / 4;
  const auto turn = static_cast<int>(std::floor((std::atan2(dv, du) + kEighth / 2) / kEighth));
  return (turn + kNetSectors) % kNetSectors;
}

bool has_valid_pixel(const LightField& light_field, ViewIndex view) {
  const ImageView<const std::uint8_t> valid = light_field.valid_of(view);
  return valid.empty() || std::any_of(valid.data, valid.data + valid.size(),
                                      [](std::uint8_t pixel) { return pixel != 0; });
}

// Three samples a pixel, whatever the channels.
void read_colors(const LightField& light_field, ViewIndex view, int y, std::vector<float>& out) {
  const int width = light_field.width();
  light_field.read_row(view, y, 0, width, out.data());
  if (light_field.channels() == 3) return;
  for (int x = width - 1; x >= 0; --x)
    std::fill_n(&out[3 * static_cast<std::size_t>(x)], 3, out[x]);
}

// A row of a view and its grey.
struct ColorRow {
  std::vector<float> colors;
  std::vector<float> grey;

  ColorRow() = default;
  explicit ColorRow(int width)
      : colors(3 * static_cast<std::size_t>(width)), grey(static_cast<std::size_t>(width)) {}
  void read(const LightField& light_field, ViewIndex view, int y) {
    read_colors(light_field, view, y, colors);
    for (std::size_t x = 0; x < grey.size(); ++x) {
      grey[x] = (colors[3 * x] + colors[3 * x + 1] + colors[3 * x + 2]) / 3;
    }
  }
};

// Numbers of the middle one of three rows.
struct PixelWriter {
  const ColorRow (&rows)[3];
  float count;  // What each pixel adds to the number of views.

  void write_pixels(float* out) const {
    for (int x = 0; x < width(); ++x, out += kNetPixel) {
      for (int c = 0; c < 3; ++c) out[c] = rows[1].colors[3 * x + c];
      out[3] = along(x);
      out[4] = rows[2].grey[x] - rows[0].grey[x];
      out[5] = count;
      out[6] = out[7] = 0;
    }
  }
  void write_rows(float* out) const {
    for (int c = 0; c < 3; ++c, out += width()) {
      for (int x = 0; x < width(); ++x) out[x] = rows[1].colors[3 * x + c];
    }
    for (int x = 0; x < width(); ++x) {
      out[x] = along(x);
      out[width() + x] = rows[2].grey[x] - rows[0].grey[x];
    }
  }

 private:
  [[nodiscard]] int width() const { return static_cast<int>(rows[1].grey.size()); }
  [[nodiscard]] float along(int x) const {
    return rows[1].grey[std::min(x + 1, width() - 1)] - rows[1].grey[std::max(x - 1, 0)];
  }
};

}  // namespace

std::array<std::vector<ViewIndex>, kNetSectors> net_sectors(const LightField& light_field,
                                                            ViewIndex reference, int most) {
  std::array<std::vector<ViewIndex>, kNetSectors> sectors;
  for (int i = 0; i < light_field.grid().count(); ++i) {
    const ViewIndex view = light_field.grid().view_at(i);
    if (view == reference || !has_valid_pixel(light_field, view)) continue;
    sectors[sector_of(view.v - reference.v, view.u - reference.u)].push_back(view);
  }
  const auto rank = [&](ViewIndex view) {
    const int dv = view.v - reference.v, du = view.u - reference.u;
    return std::tuple(dv * dv + du * du, dv, du);
  };
  for (std::vector<ViewIndex>& views : sectors) {
    std::ranges::sort(views, {}, rank);
    const auto count = static_cast<int>(views.size());
    if (count <= most) continue;
    for (int i = 0; i < most; ++i) {
      views[i] = views[static_cast<std::size_t>((2L * i + 1) * count / (2L * most))];
    }
    views.resize(most);
  }
  return sectors;
}

Image<float> net_guide(const LightField& light_field, ViewIndex reference) {
  const int height = light_field.height(), width = light_field.width();
  Image<float> guide(height, width, kNetGuide);
  Image<float> grey(height, width);
  std::vector<float> colors(3 * static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    read_colors(light_field, reference, y, colors);
    for (int x = 0; x < width; ++x) {
      const float* const color = &colors[3 * static_cast<std::size_t>(x)];
      for (int c = 0; c < 3; ++c) guide.at(y, x, c) = color[c] - kNetGrey;
      grey.at(y, x) = (color[0] + color[1] + color[2]) / 3;
    }
  }
  for (int y = 0; y < height; ++y) {
    const float* const above = grey.row(std::max(y - 1, 0));
    const float* const below = grey.row(std::min(y + 1, height - 1));
    for (int x = 0; x < width; ++x) {
      const float along = grey.at(y, std::min(x + 1, width - 1)) - grey.at(y, std::max(x - 1, 0));
      guide.at(y, x, 3) = kNetContrast * along;
      guide.at(y, x, 4) = kNetContrast * (below[x] - above[x]);
    }
  }
  return guide;
}

NetEvidence::NetEvidence(const LightField& light_field, ViewIndex reference, Interval disparities,
                         NetEvidenceOf kind, int sector_views)
    : light_field_(light_field), reference_(reference), disparities_(disparities), kind_(kind) {
  windows_.push_back({.view = reference, .pixels = {}});
  const auto sectors = net_sectors(light_field, reference, sector_views);
  for (int k = 0; k < kNetSectors; ++k) {
    sector_begin_[k] = static_cast<int>(windows_.size()) - 1;
    for (const ViewIndex view : sectors[k]) {
      windows_.push_back({.view = view, .dv = view.v - reference.v, .pixels = {}});
    }
  }
  sector_begin_[kNetSectors] = static_cast<int>(windows_.size()) - 1;
  views_.resize(windows_.size());
}

void NetEvidence::hold(int first, int end, const Progress& progress) {
  parallel_for(static_cast<int>(windows_.size()), progress, [&](int i) {
    Window& window = windows_[i];
    const auto [least, most] =
        std::minmax({-disparities_.min * window.dv, -disparities_.max * window.dv});
    // Coordinates are rounded: one row more on either side.
    const double lowest = std::clamp(std::floor(first + least) - 1, 0.0, height() - 1.0);
    const double highest = std::clamp(std::floor(end - 1 + most) + 2, 0.0, height() - 1.0);
    move_window(window, static_cast<int>(lowest), static_cast<int>(highest) + 1);
    views_[i] = {window.data(), window.first, row_pixels() * kNetPixel,
                 static_cast<float>(window.view.u - reference_.u), static_cast<float>(window.dv)};
  });
}

void NetEvidence::move_window(Window& window, int first, int end) const {
  const long row = row_pixels();
  const int kept_from = std::clamp(first, window.first, window.end);
  std::vector<Pixel>& pixels = window.pixels;
  const int dropped = kept_from - window.first, kept = window.end - kept_from;
  if (dropped >= kept) {  // Else it is not worth moving the others.
    pixels.erase(pixels.begin(), pixels.begin() + dropped * row);
    window.first = kept == 0 ? first : kept_from;
  }
  const int from = kept == 0 ? first : window.end;
  window.end = std::max(from, end);
  pixels.resize((window.end - window.first) * row + kNetReadBehind / kNetPixel);
  if (from < window.end) read_rows(window, from);
}

void NetEvidence::read_rows(Window& window, int first) const {
  ColorRow rows[3];
  for (ColorRow& row : rows) row = ColorRow(width());
  const auto read = [&](int y, ColorRow& row) {
    row.read(light_field_, window.view, std::clamp(y, 0, height() - 1));
  };
  read(first - 1, rows[0]);
  read(first, rows[1]);
  for (int y = first; y < window.end; ++y) {
    read(y + 1, rows[2]);
    float* const out = window.data() + (y - window.first) * row_pixels() * kNetPixel;
    const PixelWriter writer{rows, window.view == reference_ ? 0.0F : 1.0F};
    kind_ == NetEvidenceOf::Planes ? writer.write_rows(out) : writer.write_pixels(out);
    if (!light_field_.valid().empty()) mark_invalid_pixels(window.view, y, out);
    std::swap(rows[0], rows[1]);
    std::swap(rows[1], rows[2]);
  }
}

// Differences are taken across a pixel: one beside an invalid pixel has none.
void NetEvidence::mark_invalid_pixels(ViewIndex view, int y, float* out) const {
  constexpr float kInvalid = std::numeric_limits<float>::quiet_NaN();
  const int above = std::max(y - 1, 0), below = std::min(y + 1, height() - 1);
  for (int x = 0; x < width(); ++x) {
    const int left = std::max(x - 1, 0), right = std::min(x + 1, width() - 1);
    if (light_field_.is_valid(view, y, x) && light_field_.is_valid(view, y, left) &&
        light_field_.is_valid(view, y, right) && light_field_.is_valid(view, above, x) &&
        light_field_.is_valid(view, below, x)) {
      continue;
    }
    if (kind_ == NetEvidenceOf::Maps) {
      std::fill_n(out + static_cast<long>(x) * kNetPixel, kNetPixel, kInvalid);
    } else {
      out[x] = kInvalid;
    }
  }
}

// Of memory that a row takes.
long NetEvidence::row_pixels() const {
  if (kind_ == NetEvidenceOf::Maps) return width();
  return (static_cast<long>(width()) * kNetPixelRows + kNetPixel - 1) / kNetPixel;
}

void NetEvidence::compute(int y, std::span<const NetDisparity> disparities) const {
  const NetView& reference = views_.front();
  NetEvidenceRow row{.y = y, .width = width(), .height = height(), .views = views_.data() + 1};
  std::ranges::copy(sector_begin_, row.sector_begin);
  row.reference = reference.pixels + (y - reference.first_row) * reference.row_stride;
  row.has_invalid = !light_field_.valid().empty();
  row.disparities = disparities.data();
  row.count = static_cast<int>(disparities.size());
  const NetEvidenceKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kNetEvidenceKernel);
  kind_ == NetEvidenceOf::Planes ? kernel.planes(row) : kernel.maps(row);
}

}  // namespace episcope
