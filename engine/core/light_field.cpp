// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/light_field.h"

#include "engine/core/error.h"
#include "engine/core/hash.h"
#include "engine/core/memory.h"
#include "engine/core/numbers.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <string_view>

namespace episcope {
namespace {

template <class T>
void convert(const T* in, std::size_t count, float* out) {
  constexpr float scale = kSampleStep<T>;
  for (std::size_t i = 0; i < count; ++i) out[i] = scale * static_cast<float>(in[i]);
}

std::uint64_t next_identity() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

// Hashes bytes by words, whatever pieces they come in: a byte at a time would take a second for a
// common light field.
class WordHash {
 public:
  explicit WordHash(Fnv1a& hash) : hash_(hash) {}

  void add(std::string_view bytes) {
    while (!bytes.empty() && (count_ > 0 || bytes.size() < sizeof rest_)) {
      rest_[count_++] = bytes.front();
      bytes.remove_prefix(1);
      if (count_ < sizeof rest_) continue;
      add_word(rest_);
      count_ = 0;
    }
    for (; bytes.size() >= sizeof rest_; bytes.remove_prefix(sizeof rest_)) add_word(bytes.data());
    if (!bytes.empty()) add(bytes);
  }
  // The last bytes, if they are no whole word.
  void finish() { hash_.add({rest_, count_}); }

 private:
  void add_word(const char* bytes) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes, sizeof word);
    hash_.add_word(word);
  }

  Fnv1a& hash_;
  char rest_[sizeof(std::uint64_t)];
  std::size_t count_ = 0;
};

void gradient_norms(const float* here, const float* below, int width, int channels, float* out) {
  for (int x = 0; x < width; ++x) {
    const int right = x + 1 < width ? channels : 0;
    float energy = 0;
    for (int c = 0; c < channels; ++c) {
      const int i = x * channels + c;
      const float dx = here[i + right] - here[i];
      const float dy = below[i] - here[i];
      energy += dx * dx + dy * dy;
    }
    out[x] = std::sqrt(energy);
  }
}

void require_inside(const LightField& light_field, ViewIndex view, int line, int count,
                    const char* axis) {
  if (!light_field.grid().contains(view) || line < 0 || line >= count) {
    throw InvalidInput(
        fmt::format("there is no EPI through view ({}, {}) at {} {}: the light field has {}×{} "
                    "views of {}×{} pixels",
                    view.v, view.u, axis, line, light_field.grid().v, light_field.grid().u,
                    light_field.width(), light_field.height()));
  }
}

// out(i) = in(i + offset), linear, clamped.
void shift_row(const float* in, int width, int channels, double offset, float* out) {
  const double whole = std::floor(offset);
  const auto fraction = static_cast<float>(offset - whole);
  const int step = static_cast<int>(whole);
  for (int x = 0; x < width; ++x) {
    const int left = std::clamp(x + step, 0, width - 1) * channels;
    const int right = std::clamp(x + step + 1, 0, width - 1) * channels;
    for (int c = 0; c < channels; ++c) {
      out[x * channels + c] = (1 - fraction) * in[left + c] + fraction * in[right + c];
    }
  }
}

template <class ReadLine>
Image<float> gather(int rows, int width, int channels, int fixed_row, double focus_px,
                    const ReadLine& read_line) {
  Image<float> epi(rows, width, channels);
  std::vector<float> line(static_cast<std::size_t>(width) * channels);
  for (int s = 0; s < rows; ++s) {
    if (focus_px == 0 || s == fixed_row) {
      read_line(s, epi.row(s));
      continue;
    }
    read_line(s, line.data());
    // A point of disparity d appears at x − d·(u − u_c): fetching there puts it upright.
    shift_row(line.data(), width, channels, -focus_px * (s - fixed_row), epi.row(s));
  }
  return epi;
}

constexpr double kRegular = 0.02;  // steps
constexpr double kOutlier = 0.5;   // steps
constexpr double kMostOutliers = 0.1;
constexpr double kMostSkew = 1.0 / 3;
constexpr double kMostRatio = 2;
constexpr int kPlaneSweeps = 50;

double median_of_finite(std::vector<float> values) {
  std::erase_if(values, [](float value) { return !std::isfinite(value); });
  return values.empty() ? 0 : quantile(values, 0.5);
}

// One coordinate of all positions, and the plane through it: base + along_u·u + along_v·v.
class Coordinate {
 public:
  Coordinate(GridShape grid, std::vector<double> values) : grid_(grid), values_(std::move(values)) {
    along_u = median_of_finite(differences({0, 1}));
    along_v = median_of_finite(differences({1, 0}));
    std::vector<float> bases;
    bases.reserve(grid_.count());
    for (int i = 0; i < grid_.count(); ++i) {
      bases.push_back(static_cast<float>(values_[i] - slope(grid_.view_at(i))));
    }
    base_ = median_of_finite(bases);
  }

  // Least squares over the views that are believed, by Gauss and Seidel.
  void refine(const std::vector<bool>& is_believed) {
    for (int sweep = 0; sweep < kPlaneSweeps; ++sweep) {
      base_ += mean_residual(is_believed, [](ViewIndex) { return 1; });
      along_u += mean_residual(is_believed, [this](ViewIndex v) { return v.u - grid_.center().u; });
      along_v += mean_residual(is_believed, [this](ViewIndex v) { return v.v - grid_.center().v; });
    }
  }

  [[nodiscard]] double fitted(int i) const { return base_ + slope(grid_.view_at(i)); }
  // As stated, or where the grid has it.
  [[nodiscard]] double value(int i, bool is_stated) const {
    return is_stated ? values_[i] : fitted(i);
  }
  [[nodiscard]] bool is_near(int i, double distance) const {
    return std::abs(values_[i] - fitted(i)) <= distance;
  }

  double along_u = 0, along_v = 0;

 private:
  // About the center.
  [[nodiscard]] double slope(ViewIndex view) const {
    return along_u * (view.u - grid_.center().u) + along_v * (view.v - grid_.center().v);
  }
  // The change of a coefficient that fits the residuals best.
  template <class Factor>
  [[nodiscard]] double mean_residual(const std::vector<bool>& is_believed,
                                     const Factor& factor) const {
    double sum = 0, weight = 0;
    for (int i = 0; i < grid_.count(); ++i) {
      if (!is_believed[i]) continue;
      const double f = factor(grid_.view_at(i));
      sum += f * (values_[i] - fitted(i));
      weight += f * f;
    }
    return weight > 0 ? sum / weight : 0;
  }
  [[nodiscard]] std::vector<float> differences(ViewIndex way) const {
    std::vector<float> all;
    for (int i = 0; i < grid_.count(); ++i) {
      const ViewIndex view = grid_.view_at(i), next{view.v + way.v, view.u + way.u};
      if (!grid_.contains(next)) continue;
      all.push_back(static_cast<float>(values_[next.v * grid_.u + next.u] - values_[i]));
    }
    return all;
  }

  GridShape grid_;
  std::vector<double> values_;
  double base_ = 0;
};

// Whether positions grow with columns along x and with rows along y.
bool is_upright(const Coordinate& x, const Coordinate& y, GridShape grid) {
  const double step_u = std::abs(x.along_u), step_v = std::abs(y.along_v);
  if (grid.u > 1 && !(step_u > 0 && std::abs(y.along_u) <= kMostSkew * step_u)) return false;
  if (grid.v > 1 && !(step_v > 0 && std::abs(x.along_v) <= kMostSkew * step_v)) return false;
  return true;
}

double deviation_from_grid(const std::vector<ViewPlace>& places, GridShape grid) {
  const ViewIndex center = grid.center();
  const ViewPlace origin = places[static_cast<std::size_t>(center.v) * grid.u + center.u];
  double largest = 0;
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    largest = std::max({largest, std::abs(places[i].v - origin.v - (view.v - center.v)),
                        std::abs(places[i].u - origin.u - (view.u - center.u))});
  }
  return largest;
}

}  // namespace

LightField::LightField(LightField&& other, LightFieldInfo info)
    : samples_(std::move(other.samples_)),
      valid_(std::move(other.valid_)),
      info_(std::move(info)),
      grid_(other.grid_),
      height_(other.height_),
      width_(other.width_),
      channels_(other.channels_),
      identity_(other.identity_) {}

LightField::LightField(Samples samples, LightFieldInfo info, ViewStack<std::uint8_t> valid)
    : samples_(std::move(samples)),
      valid_(std::move(valid)),
      info_(std::move(info)),
      identity_(next_identity()) {
  std::visit(
      [this](const auto& stack) {
        grid_ = stack.grid();
        height_ = stack.height();
        width_ = stack.width();
        channels_ = stack.channels();
        if (stack.empty() || stack.size() == 0)
          throw InvalidInput("the light field has no samples");
        if (!(stack.first() == ViewIndex{})) {
          throw InvalidInput("the views of a light field must begin at view (0, 0)");
        }
      },
      samples_);
  if (channels_ != 1 && channels_ != 3) {
    throw InvalidInput(fmt::format(
        "the light field has {} channels, but 1 (grey) or 3 (RGB) are expected", channels_));
  }
  const bool fits = valid_.grid() == grid_ && valid_.first() == ViewIndex{} &&
                    valid_.height() == height_ && valid_.width() == width_ &&
                    valid_.channels() == 1;
  if (!valid_.empty() && !fits) throw InvalidInput("the mask of valid pixels does not fit");
}

SampleType LightField::sample_type() const {
  constexpr SampleType types[] = {SampleType::UInt8, SampleType::UInt16, SampleType::Float32};
  return types[samples_.index()];
}

std::size_t LightField::byte_size() const {
  return std::visit([](const auto& stack) { return stack.size() * sizeof(*stack.data()); },
                    samples_);
}

void LightField::read_row(ViewIndex index, int y, int x0, int x1, float* out) const {
  std::visit(
      [&](const auto& stack) {
        const auto view = stack.view(index);
        convert(view.row(y) + static_cast<std::size_t>(x0) * channels_,
                static_cast<std::size_t>(x1 - x0) * channels_, out);
      },
      samples_);
}

void LightField::read_column(ViewIndex index, int x, int y0, int y1, float* out) const {
  std::visit(
      [&](const auto& stack) {
        const auto view = stack.view(index);
        for (int y = y0; y < y1; ++y, out += channels_) {
          convert(view.row(y) + static_cast<std::size_t>(x) * channels_, channels_, out);
        }
      },
      samples_);
}

Image<float> LightField::view_as_float(ViewIndex index) const {
  Image<float> image(height_, width_, channels_);
  for (int y = 0; y < height_; ++y) read_row(index, y, 0, width_, image.row(y));
  return image;
}

bool LightField::is_on_disk() const {
  return std::visit([](const auto& stack) { return stack.is_on_disk(); }, samples_);
}

void LightField::fetch_samples(ViewIndex index, int first_row, int end_row) const {
  std::visit(
      [&]<class T>(const ViewStack<T>& stack) {
        if (!stack.is_on_disk()) return;
        const ImageView<const T> view = stack.view(index);
        const auto rows = static_cast<std::size_t>(end_row - first_row);
        fetch_pages(view.row(first_row), sizeof(T) * rows * view.row_stride);
      },
      samples_);
}

void LightField::forget_samples() const {
  const auto forget = [](const auto& stack) {
    for (int i = 0; i < stack.grid().count(); ++i) forget_view(stack, stack.view_at(i));
  };
  std::visit(forget, samples_);
  if (!valid_.empty()) forget(valid_);
}

std::uint64_t LightField::sample_hash() const {
  Fnv1a hash;
  for (const int extent : {grid_.v, grid_.u, height_, width_, channels_}) hash.add_word(extent);
  std::visit(
      [&](const auto& stack) {
        WordHash words(hash);
        for (int i = 0; i < grid_.count(); ++i) {
          // The disk reads while the last view is being hashed.
          if (i + 1 < grid_.count()) fetch_samples(stack.view_at(i + 1), 0, height_);
          const auto* const first = stack.view(stack.view_at(i)).data;
          words.add({reinterpret_cast<const char*>(first), stack.view_size() * sizeof *first});
          forget_view(stack, stack.view_at(i));
        }
        words.finish();
      },
      samples_);
  return hash.value();
}

void gradient_magnitude(const LightField& light_field, ViewIndex view, ImageView<float> out) {
  const LightField& lf = light_field;
  std::vector<float> here(static_cast<std::size_t>(lf.width()) * lf.channels());
  std::vector<float> below(here.size());
  lf.read_row(view, 0, 0, lf.width(), here.data());
  for (int y = 0; y < lf.height(); ++y) {
    lf.read_row(view, std::min(y + 1, lf.height() - 1), 0, lf.width(), below.data());
    gradient_norms(here.data(), below.data(), lf.width(), lf.channels(), out.row(y));
    here.swap(below);
  }
}

Image<float> horizontal_epi(const LightField& lf, ViewIndex view, int y, double focus_px) {
  require_inside(lf, view, y, lf.height(), "row");
  for (int u = 0; u < lf.grid().u; ++u) lf.fetch_samples({view.v, u}, y, y + 1);
  return gather(lf.grid().u, lf.width(), lf.channels(), view.u, focus_px, [&](int u, float* out) {
    lf.read_row({view.v, u}, y, 0, lf.width(), out);
  });
}

Image<float> vertical_epi(const LightField& lf, ViewIndex view, int x, double focus_px) {
  require_inside(lf, view, x, lf.width(), "column");
  // Whole views: reading a little of each row would take the disk as long.
  for (int v = 0; v < lf.grid().v; ++v) lf.fetch_samples({v, view.u}, 0, lf.height());
  return gather(lf.grid().v, lf.height(), lf.channels(), view.v, focus_px, [&](int v, float* out) {
    lf.read_column({v, view.u}, x, 0, lf.height(), out);
  });
}

ViewPlaces view_places(const LightFieldInfo& info, GridShape grid) {
  ViewPlaces result;
  if (info.positions.size() != static_cast<std::size_t>(grid.count()) || grid.count() < 2) {
    return result;
  }
  std::vector<double> xs, ys;
  for (const CameraPosition& position : info.positions) {
    xs.push_back(position.x);
    ys.push_back(position.y);
  }
  Coordinate x(grid, std::move(xs)), y(grid, std::move(ys));
  result.kind = PlacesKind::Implausible;
  if (!is_upright(x, y, grid)) return result;
  if (grid.v > 1 && grid.u > 1) result.row_step = std::abs(y.along_v / x.along_u);
  if (std::max(result.row_step, 1 / result.row_step) > kMostRatio) return result;
  const auto unit = [&](double along) {
    return std::copysign(grid.u > 1 ? x.along_u : y.along_v, along);
  };
  std::vector<bool> is_believed;
  is_believed.reserve(grid.count());
  for (int i = 0; i < grid.count(); ++i) {
    is_believed.push_back(x.is_near(i, kOutlier * unit(1)) && y.is_near(i, kOutlier * unit(1)));
  }
  result.outliers = static_cast<int>(std::ranges::count(is_believed, false));
  if (result.outliers > kMostOutliers * grid.count()) return result;
  x.refine(is_believed);
  y.refine(is_believed);
  const double u = unit(x.along_u), v = unit(y.along_v);
  for (int i = 0; i < grid.count(); ++i) {
    const bool stands = is_believed[i];
    result.places.push_back({y.value(i, stands) / v, x.value(i, stands) / u});
  }
  result.largest_deviation = deviation_from_grid(result.places, grid);
  result.kind = result.largest_deviation < kRegular ? PlacesKind::Regular : PlacesKind::Irregular;
  if (result.kind == PlacesKind::Regular) result.places.clear();
  return result;
}

}  // namespace episcope
