// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/light_field.h"

#include "engine/core/error.h"
#include "engine/core/hash.h"
#include "engine/core/memory.h"

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

namespace {

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

}  // namespace

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

namespace {

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

}  // namespace

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

}  // namespace episcope
