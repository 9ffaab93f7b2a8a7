// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/light_field/light_field.h"

#include "engine/core/error.h"
#include "engine/core/hash/fnv1a.h"

#include <fmt/format.h>

#include <atomic>
#include <cstring>
#include <limits>

namespace episcope {
namespace {

template <class T>
constexpr float unit_scale() {
  if constexpr (std::is_integral_v<T>) return 1.0F / std::numeric_limits<T>::max();
  return 1.0F;
}

template <class T>
void convert(const T* in, std::size_t count, float* out) {
  constexpr float scale = unit_scale<T>();
  for (std::size_t i = 0; i < count; ++i) out[i] = scale * static_cast<float>(in[i]);
}

std::uint64_t next_identity() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
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

std::uint64_t LightField::sample_hash() const {
  Fnv1a hash;
  for (const int extent : {grid_.v, grid_.u, height_, width_, channels_}) hash.add_word(extent);
  std::visit(
      [&](const auto& stack) {
        // By words: a byte at a time would take a second for a common light field.
        const auto* bytes = reinterpret_cast<const char*>(stack.data());
        const std::size_t size = byte_size();
        std::size_t i = 0;
        for (std::uint64_t word = 0; i + sizeof word <= size; i += sizeof word) {
          std::memcpy(&word, bytes + i, sizeof word);
          hash.add_word(word);
        }
        hash.add({bytes + i, size - i});
      },
      samples_);
  return hash.value();
}

}  // namespace episcope
