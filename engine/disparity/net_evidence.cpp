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

constexpr float kInvalid = std::numeric_limits<float>::quiet_NaN();

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

// A row of a view, its grey and its mask.
struct ColorRow {
  std::vector<float> colors;
  std::vector<float> grey;
  const std::uint8_t* valid = nullptr;  // None: all pixels are.

  ColorRow() = default;
  explicit ColorRow(int width)
      : colors(3 * static_cast<std::size_t>(width)), grey(static_cast<std::size_t>(width)) {}
  void read(const LightField& light_field, ViewIndex view, int y) {
    read_colors(light_field, view, y, colors);
    for (std::size_t x = 0; x < grey.size(); ++x) {
      grey[x] = (colors[3 * x] + colors[3 * x + 1] + colors[3 * x + 2]) / 3;
    }
    const ImageView<const std::uint8_t> mask = light_field.valid_of(view);
    valid = mask.empty() ? nullptr : mask.row(y);
  }
  [[nodiscard]] bool is_valid(int x) const { return valid == nullptr || valid[x] != 0; }
  [[nodiscard]] float grey_or(int x, float other) const { return is_valid(x) ? grey[x] : other; }
};

// Three rows of a view that follow each other, the border repeated. Differences of grey are taken
// across the middle one; the pixel itself stands for a neighbor that is invalid.
class ThreeRows {
 public:
  ThreeRows(const LightField& light_field, ViewIndex view, int y)
      : light_field_(light_field), view_(view), y_(y) {
    for (int i = 0; i < 3; ++i) {
      rows_[i] = ColorRow(light_field.width());
      read(y + i - 1, rows_[i]);
    }
  }

  void go_down() {
    std::swap(rows_[0], rows_[1]);
    std::swap(rows_[1], rows_[2]);
    ++y_;
    read(y_ + 1, rows_[2]);
  }
  [[nodiscard]] int width() const { return light_field_.width(); }
  [[nodiscard]] bool is_valid(int x) const { return rows_[1].is_valid(x); }
  [[nodiscard]] const float* color(int x) const {
    return &rows_[1].colors[3 * static_cast<std::size_t>(x)];
  }
  [[nodiscard]] float along_x(int x) const {
    const ColorRow& row = rows_[1];
    return row.grey_or(std::min(x + 1, width() - 1), row.grey[x]) -
           row.grey_or(std::max(x - 1, 0), row.grey[x]);
  }
  [[nodiscard]] float along_y(int x) const {
    const float own = rows_[1].grey[x];
    return rows_[2].grey_or(x, own) - rows_[0].grey_or(x, own);
  }

 private:
  void read(int y, ColorRow& row) const {
    row.read(light_field_, view_, std::clamp(y, 0, light_field_.height() - 1));
  }

  const LightField& light_field_;
  ViewIndex view_;
  int y_;
  ColorRow rows_[3];
};

// `count` is what each pixel adds to the number of views.
void write_pixels(const ThreeRows& rows, float count, float* out) {
  for (int x = 0; x < rows.width(); ++x, out += kNetPixel) {
    std::copy_n(rows.color(x), 3, out);
    out[3] = rows.along_x(x);
    out[4] = rows.along_y(x);
    out[5] = count;
    out[6] = out[7] = 0;
    if (!rows.is_valid(x)) std::fill_n(out, kNetPixel, kInvalid);
  }
}

// Of an invalid pixel one number tells.
void write_planes(const ThreeRows& rows, float* out) {
  const int width = rows.width();
  for (int x = 0; x < width; ++x) {
    for (int c = 0; c < 3; ++c) out[c * width + x] = rows.color(x)[c];
    out[3 * width + x] = rows.along_x(x);
    out[4 * width + x] = rows.along_y(x);
    if (!rows.is_valid(x)) out[x] = kInvalid;
  }
}

}  // namespace

std::array<std::vector<cuda::NetNeighbor>, kNetSectors> net_sectors(const LightField& light_field,
                                                                    ViewIndex reference,
                                                                    const NetPlaces& places) {
  const GridShape grid = light_field.grid();
  const auto place_of = [&](ViewIndex view) {
    return places ? (*places)[view.v * grid.u + view.u] : ViewPlace{1.0 * view.v, 1.0 * view.u};
  };
  const ViewPlace here = place_of(reference);
  std::array<std::vector<cuda::NetNeighbor>, kNetSectors> sectors;
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    if (view == reference || !has_valid_pixel(light_field, view)) continue;
    const ViewPlace there = place_of(view);
    sectors[sector_of(view.v - reference.v, view.u - reference.u)].push_back(
        {view, {there.v - here.v, there.u - here.u}});
  }
  const auto rank = [&](const cuda::NetNeighbor& neighbor) {
    const int dv = neighbor.view.v - reference.v, du = neighbor.view.u - reference.u;
    return std::tuple(dv * dv + du * du, dv, du);
  };
  for (std::vector<cuda::NetNeighbor>& views : sectors) {
    std::ranges::sort(views, {}, rank);
    const auto count = static_cast<int>(views.size());
    if (count <= kNetSectorViews) continue;
    for (int i = 0; i < kNetSectorViews; ++i) {
      views[i] = views[static_cast<std::size_t>((2L * i + 1) * count / (2L * kNetSectorViews))];
    }
    views.resize(kNetSectorViews);
  }
  return sectors;
}

Image<float> net_guide(const LightField& light_field, ViewIndex reference) {
  Image<float> guide(light_field.height(), light_field.width(), kNetGuide);
  ThreeRows rows(light_field, reference, 0);
  for (int y = 0; y < guide.height(); ++y) {
    if (y > 0) rows.go_down();
    for (int x = 0; x < guide.width(); ++x) {
      float* const out = &guide.at(y, x);
      for (int c = 0; c < 3; ++c) out[c] = rows.color(x)[c] - kNetGrey;
      out[3] = kNetContrast * rows.along_x(x);
      out[4] = kNetContrast * rows.along_y(x);
    }
  }
  return guide;
}

NetEvidence::NetEvidence(const LightField& light_field, ViewIndex reference, Interval disparities,
                         NetEvidenceOf kind, const NetPlaces& places)
    : light_field_(light_field), reference_(reference), disparities_(disparities), kind_(kind) {
  windows_.push_back({.neighbor = {reference, {}}, .pixels = {}});
  const auto sectors = net_sectors(light_field, reference, places);
  for (int k = 0; k < kNetSectors; ++k) {
    sector_begin_[k] = static_cast<int>(windows_.size()) - 1;
    for (const cuda::NetNeighbor& neighbor : sectors[k]) {
      windows_.push_back({.neighbor = neighbor, .pixels = {}});
    }
  }
  sector_begin_[kNetSectors] = static_cast<int>(windows_.size()) - 1;
  views_.resize(windows_.size());
}

void NetEvidence::hold(int first, int end, const Progress& progress) {
  parallel_for(static_cast<int>(windows_.size()), progress, [&](int i) {
    Window& window = windows_[i];
    const ViewPlace way = window.neighbor.way;
    const auto [least, most] = std::minmax({-disparities_.min * way.v, -disparities_.max * way.v});
    // Coordinates are rounded: one row more on either side.
    const double lowest = std::clamp(std::floor(first + least) - 1, 0.0, height() - 1.0);
    const double highest = std::clamp(std::floor(end - 1 + most) + 2, 0.0, height() - 1.0);
    move_window(window, static_cast<int>(lowest), static_cast<int>(highest) + 1);
    views_[i] = {window.data(), window.first, row_pixels() * kNetPixel, static_cast<float>(way.u),
                 static_cast<float>(way.v)};
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
  const float count = window.neighbor.view == reference_ ? 0.0F : 1.0F;
  ThreeRows rows(light_field_, window.neighbor.view, first);
  for (int y = first; y < window.end; ++y) {
    if (y > first) rows.go_down();
    float* const out = window.data() + (y - window.first) * row_pixels() * kNetPixel;
    kind_ == NetEvidenceOf::Planes ? write_planes(rows, out) : write_pixels(rows, count, out);
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
