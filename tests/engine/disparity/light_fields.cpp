// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/disparity/light_fields.h"

#include "engine/scenes/builtin.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>

namespace episcope::test {
namespace {

template <class Body>
void each_view(GridShape grid, const Body& body) {
  for (int v = 0; v < grid.v; ++v) {
    for (int u = 0; u < grid.u; ++u) body(ViewIndex{v, u});
  }
}

template <class Body>
void each_pixel(int height, int width, int inset, const Body& body) {
  for (int y = inset; y < height - inset; ++y) {
    for (int x = inset; x < width - inset; ++x) body(y, x);
  }
}

}  // namespace

Scene render(const std::string& id, int height, int width, GridShape grid, double disparity_scale,
             double noise_sigma) {
  scenes::RenderOptions options;
  options.grid = grid;
  options.height = height;
  options.width = width;
  options.disparity_scale = disparity_scale;
  options.noise_sigma = noise_sigma;
  return scenes::render_builtin(id, options, Progress());
}

LightField make_light_field(GridShape grid, int height, int width, int channels,
                            const SampleFunction& sample) {
  ViewStack<float> samples(grid, height, width, channels);
  each_view(grid, [&](ViewIndex view) {
    const ImageView<float> image = samples.view(view);
    each_pixel(height, width, 0, [&](int y, int x) {
      for (int c = 0; c < channels; ++c) image.at(y, x, c) = sample(view, y, x, c);
    });
  });
  return {std::move(samples), {}};
}

LightField like(const LightField& shape, const SampleFunction& sample) {
  return make_light_field(shape.grid(), shape.height(), shape.width(), shape.channels(), sample);
}

ViewStack<float> float_samples(const LightField& lf) {
  ViewStack<float> samples(lf.grid(), lf.height(), lf.width(), lf.channels());
  each_view(lf.grid(), [&](ViewIndex view) {
    for (int y = 0; y < lf.height(); ++y) {
      lf.read_row(view, y, 0, lf.width(), samples.view(view).row(y));
    }
  });
  return samples;
}

LightField transposed(const LightField& lf) {
  const ViewStack<float> samples = float_samples(lf);
  return make_light_field({lf.grid().u, lf.grid().v}, lf.width(), lf.height(), lf.channels(),
                          [&](ViewIndex view, int y, int x, int c) {
                            return samples.view({view.u, view.v}).at(x, y, c);
                          });
}

LightField sheared(const LightField& lf, int k) {
  const ViewStack<float> samples = float_samples(lf);
  const ViewIndex center = lf.center();
  return like(lf, [&](ViewIndex view, int y, int x, int c) {
    const int from_y = std::clamp(y + k * (view.v - center.v), 0, lf.height() - 1);
    const int from_x = std::clamp(x + k * (view.u - center.u), 0, lf.width() - 1);
    return samples.view(view).at(from_y, from_x, c);
  });
}

LightField as_uint16(const LightField& lf) {
  const ViewStack<float> samples = float_samples(lf);
  ViewStack<std::uint16_t> stored(lf.grid(), lf.height(), lf.width(), lf.channels());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    stored.data()[i] = static_cast<std::uint16_t>(std::lround(65535 * samples.data()[i]));
  }
  return {std::move(stored), {}};
}

LightField grey(const LightField& lf) {
  const ViewStack<float> samples = float_samples(lf);
  return make_light_field(lf.grid(), lf.height(), lf.width(), 1,
                          [&](ViewIndex view, int y, int x, int) {
                            float sum = 0;
                            for (int c = 0; c < lf.channels(); ++c) {
                              sum += samples.view(view).at(y, x, c);
                            }
                            return sum / static_cast<float>(lf.channels());
                          });
}

Errors errors(const ImageView<const float>& estimate, const DisparityView& truth, int inset) {
  Errors sum;
  double count = 0;
  each_pixel(estimate.height, estimate.width, inset, [&](int y, int x) {
    if (!truth.is_valid(y, x)) return;
    const double off = static_cast<double>(estimate.at(y, x)) - truth.disparity.at(y, x);
    sum.bias += off;
    sum.mse_100 += 100 * off * off;
    sum.worst = std::max(sum.worst, std::fabs(off));
    count += 1;
  });
  return {sum.bias / count, sum.mse_100 / count, sum.worst};
}

double largest_difference(const ImageView<const float>& a, const ImageView<const float>& b,
                          int inset) {
  double largest = 0;
  each_pixel(a.height, a.width, inset, [&](int y, int x) {
    largest = std::max(largest, std::fabs(static_cast<double>(a.at(y, x)) - b.at(y, x)));
  });
  return largest;
}

double mean(const ImageView<const float>& image, int inset) {
  double sum = 0;
  double count = 0;
  each_pixel(image.height, image.width, inset, [&](int y, int x) {
    sum += image.at(y, x);
    count += 1;
  });
  return sum / count;
}

bool all_finite(const ViewStack<float>& stack) {
  return std::all_of(stack.data(), stack.data() + stack.size(),
                     [](float value) { return std::isfinite(value); });
}

bool same_bytes(const ViewStack<float>& a, const ViewStack<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

}  // namespace episcope::test
