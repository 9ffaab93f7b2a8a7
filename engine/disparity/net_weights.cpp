// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/net_weights.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace episcope {

namespace {

// Dimensions, inputs, outputs, kernel, stride, dilation, bias, leaky: resources/training/README.md.
constexpr NetLayerForm kForms[] = {
    {"volume.image.0", 2, 5, 16, 3, 1, 1, true, true},
    {"volume.image.1", 2, 16, 16, 3, 1, 1, true, true},
    {"volume.e0", 3, 16, 16, 3, 1, 1, true, true},
    {"volume.d1", 3, 16, 32, 3, 2, 1, true, true},
    {"volume.e1", 3, 32, 32, 3, 1, 1, true, true},
    {"volume.d2", 3, 32, 48, 3, 2, 1, true, true},
    {"volume.e2.0", 3, 48, 48, 3, 1, 1, true, true},
    {"volume.e2.1", 3, 48, 48, 3, 1, 1, true, true},
    {"volume.r2.0", 3, 48, 48, 3, 1, 1, true, true},
    {"volume.r2.1", 3, 48, 48, 3, 1, 1, true, false},
    {"volume.d3", 3, 48, 64, 3, 2, 1, true, true},
    {"volume.e3.0", 3, 64, 64, 3, 1, 1, true, true},
    {"volume.e3.1", 3, 64, 64, 3, 1, 1, true, true},
    {"volume.r3.0", 3, 64, 64, 3, 1, 1, true, true},
    {"volume.r3.1", 3, 64, 64, 3, 1, 1, true, false},
    {"volume.u2", 3, 64, 48, 1, 1, 1, true, true},
    {"volume.f2", 3, 48, 48, 3, 1, 1, true, true},
    {"volume.s2.0", 3, 48, 48, 3, 1, 1, true, true},
    {"volume.s2.1", 3, 48, 48, 3, 1, 1, true, false},
    {"volume.u1", 3, 48, 32, 1, 1, 1, true, true},
    {"volume.f1", 3, 32, 32, 3, 1, 1, true, true},
    {"volume.u0", 3, 32, 16, 1, 1, 1, true, true},
    {"volume.f0", 3, 16, 16, 3, 1, 1, true, true},
    {"volume.image.2", 2, 16, 16, 3, 1, 1, true, false},
    {"volume.input", 3, 16, 16, 3, 1, 1, false, false},
    {"volume.head", 3, 16, 1, 3, 1, 1, true, false},
    {"selection.i.0", 2, 85, 64, 3, 1, 1, true, true},
    {"selection.i.1", 2, 64, 64, 3, 1, 1, true, true},
    {"selection.r0.0", 2, 64, 64, 3, 1, 1, true, true},
    {"selection.r0.1", 2, 64, 64, 3, 1, 1, true, false},
    {"selection.d1.0", 2, 64, 96, 3, 2, 1, true, true},
    {"selection.d1.1", 2, 96, 96, 3, 1, 1, true, true},
    {"selection.r1.0", 2, 96, 96, 3, 1, 1, true, true},
    {"selection.r1.1", 2, 96, 96, 3, 1, 1, true, false},
    {"selection.d2.0", 2, 96, 128, 3, 2, 1, true, true},
    {"selection.d2.1", 2, 128, 128, 3, 1, 1, true, true},
    {"selection.d2.2", 2, 128, 128, 3, 1, 2, true, true},
    {"selection.d2.3", 2, 128, 128, 3, 1, 4, true, true},
    {"selection.d3.0", 2, 128, 128, 3, 2, 1, true, true},
    {"selection.d3.1", 2, 128, 128, 3, 1, 1, true, true},
    {"selection.d3.2", 2, 128, 128, 3, 1, 2, true, true},
    {"selection.u2", 2, 128, 128, 1, 1, 1, true, false},
    {"selection.u1", 2, 128, 96, 1, 1, 1, true, true},
    {"selection.f1", 2, 96, 96, 3, 1, 1, true, true},
    {"selection.s1.0", 2, 96, 96, 3, 1, 1, true, true},
    {"selection.s1.1", 2, 96, 96, 3, 1, 1, true, false},
    {"selection.u0", 2, 96, 64, 1, 1, 1, true, true},
    {"selection.f0", 2, 64, 64, 3, 1, 1, true, true},
    {"selection.reduce.a", 2, 16, 16, 1, 1, 1, true, true},
    {"selection.reduce.b", 2, 16, 8, 1, 1, 1, true, true},
    {"selection.head", 2, 64, 8, 3, 1, 1, true, false},
    {"refinement.0.i.0", 2, 49, 48, 3, 1, 1, true, true},
    {"refinement.0.i.1", 2, 48, 48, 3, 1, 1, true, true},
    {"refinement.0.r0.0", 2, 48, 48, 3, 1, 1, true, true},
    {"refinement.0.r0.1", 2, 48, 48, 3, 1, 1, true, false},
    {"refinement.0.d1.0", 2, 48, 56, 3, 2, 1, true, true},
    {"refinement.0.d1.1", 2, 56, 56, 3, 1, 1, true, true},
    {"refinement.0.d1.2", 2, 56, 56, 3, 1, 2, true, true},
    {"refinement.0.d1.3", 2, 56, 56, 3, 1, 4, true, true},
    {"refinement.0.r1.0", 2, 56, 56, 3, 1, 1, true, true},
    {"refinement.0.r1.1", 2, 56, 56, 3, 1, 1, true, false},
    {"refinement.0.u0", 2, 56, 48, 1, 1, 1, true, true},
    {"refinement.0.f0.0", 2, 48, 48, 3, 1, 1, true, true},
    {"refinement.0.f0.1", 2, 48, 48, 3, 1, 1, true, true},
    {"refinement.0.reduce.a", 2, 16, 16, 1, 1, 1, true, true},
    {"refinement.0.reduce.b", 2, 16, 8, 1, 1, 1, true, true},
    {"refinement.0.head", 2, 48, 2, 3, 1, 1, true, false},
    {"refinement.1.i.0", 2, 49, 48, 3, 1, 1, true, true},
    {"refinement.1.i.1", 2, 48, 48, 3, 1, 1, true, true},
    {"refinement.1.r0.0", 2, 48, 48, 3, 1, 1, true, true},
    {"refinement.1.r0.1", 2, 48, 48, 3, 1, 1, true, false},
    {"refinement.1.d1.0", 2, 48, 56, 3, 2, 1, true, true},
    {"refinement.1.d1.1", 2, 56, 56, 3, 1, 1, true, true},
    {"refinement.1.d1.2", 2, 56, 56, 3, 1, 2, true, true},
    {"refinement.1.d1.3", 2, 56, 56, 3, 1, 4, true, true},
    {"refinement.1.r1.0", 2, 56, 56, 3, 1, 1, true, true},
    {"refinement.1.r1.1", 2, 56, 56, 3, 1, 1, true, false},
    {"refinement.1.u0", 2, 56, 48, 1, 1, 1, true, true},
    {"refinement.1.f0.0", 2, 48, 48, 3, 1, 1, true, true},
    {"refinement.1.f0.1", 2, 48, 48, 3, 1, 1, true, true},
    {"refinement.1.reduce.a", 2, 16, 16, 1, 1, 1, true, true},
    {"refinement.1.reduce.b", 2, 16, 8, 1, 1, 1, true, true},
    {"refinement.1.head", 2, 48, 2, 3, 1, 1, true, false},
};

/// Null if there is none.
const NamedArray* find_array(const NamedArrays& arrays, const std::string& name) {
  const auto found = std::ranges::find(arrays.arrays, name, &NamedArray::name);
  return found == arrays.arrays.end() ? nullptr : &*found;
}

const NamedArray& array_of(const NamedArrays& arrays, const std::string& name) {
  if (const NamedArray* found = find_array(arrays, name)) return *found;
  throw InvalidInput("the weights of net lack " + name + "; choose another file of weights");
}

std::string text_of(const std::vector<std::size_t>& shape) {
  return fmt::format("{}", fmt::join(shape, "×"));
}

const std::vector<float>& values_of(const NamedArrays& arrays, const std::string& name,
                                    const std::vector<std::size_t>& shape) {
  const NamedArray& array = array_of(arrays, name);
  std::size_t count = 1;
  for (const std::size_t length : shape) count *= length;
  if (array.shape != shape || array.values.size() != count) {
    throw InvalidInput(
        fmt::format("the weights of net have the shape {} in {}, where {} belongs; "
                    "choose another file of weights",
                    text_of(array.shape), name, text_of(shape)));
  }
  return array.values;
}

// Weights, which the file may hold divided by a scale for each output.
std::vector<float> weights_of(const NamedArrays& arrays, const std::string& name,
                              const std::vector<std::size_t>& shape) {
  std::vector<float> weights = values_of(arrays, name + ".weight", shape);
  if (find_array(arrays, name + ".scale") == nullptr) return weights;
  const std::vector<float>& scales = values_of(arrays, name + ".scale", {shape[0]});
  const std::size_t each = weights.size() / shape[0];
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] *= scales[i / each];
  return weights;
}

NetLayer read_layer(const NamedArrays& arrays, const NetLayerForm& form) {
  std::vector<std::size_t> shape{static_cast<std::size_t>(form.outputs),
                                 static_cast<std::size_t>(form.inputs)};
  shape.insert(shape.end(), form.dimensions, form.kernel);
  const std::string name = form.name;
  const std::vector<float> weights = weights_of(arrays, name, shape);
  if (!form.has_bias) return make_net_layer(form, weights, {});
  return make_net_layer(form, weights, values_of(arrays, name + ".bias", {shape[0]}));
}

void require_known(const NamedArrays& arrays) {
  for (const NamedArray& array : arrays.arrays) {
    const auto is_its_layer = [&](const NetLayerForm& form) {
      const std::string name = form.name;
      return array.name == name + ".weight" || array.name == name + ".scale" ||
             (form.has_bias && array.name == name + ".bias");
    };
    if (std::ranges::none_of(kForms, is_its_layer)) {
      throw InvalidInput("net has no layer for the weights " + array.name +
                         "; choose another file of weights");
    }
  }
}

// Weights of three taps, mixed: their polynomial at the points of kNetMixed, each divided by its
// distances from the others; at infinity its last coefficient.
std::array<double, kNetMixed> mixed_weights(double first, double second, double third) {
  const double even = first + third / 2, odd = second * std::sqrt(0.5);
  const double wide_even = first + third * 2, wide_odd = second * std::sqrt(2.0);
  return {first,
          (even + odd) / -1.5,
          (even - odd) / -1.5,
          (wide_even + wide_odd) / 6,
          (wide_even - wide_odd) / 6,
          third};
}

// All taps of an output and an input in the order of a mixed layer, `[mixed z or y][mixed x][y]`.
std::vector<double> mixed_taps(const NetLayerForm& form, const float* taps) {
  const int planes = form.mixed_planes(), rows = form.plain_taps();
  std::vector<double> mixed(static_cast<std::size_t>(planes) * kNetMixed * rows);
  for (int y = 0; y < rows; ++y) {
    std::array<std::array<double, kNetMixed>, 3> columns{};
    for (int z = 0; z < (planes == 1 ? 1 : 3); ++z) {
      const float* const row = taps + (z * rows + y) * 3;
      columns[z] = mixed_weights(row[0], row[1], row[2]);
    }
    for (int x = 0; x < kNetMixed; ++x) {
      std::array<double, kNetMixed> column{columns[0][x]};
      if (planes > 1) column = mixed_weights(columns[0][x], columns[1][x], columns[2][x]);
      for (int z = 0; z < planes; ++z) mixed[(z * kNetMixed + x) * rows + y] = column[z];
    }
  }
  return mixed;
}

}  // namespace

NetLayer make_net_layer(const NetLayerForm& form, const std::vector<float>& weights,
                        const std::vector<float>& bias) {
  NetLayer layer{.form = form, .weights = {}, .bias = {}, .plain_weights = weights};
  const int rows = form.is_narrow() ? form.outputs : whole_groups(form.outputs) / kNetGroup;
  layer.weights.resize(static_cast<std::size_t>(rows * layer.group_stride() / kNetGroup));
  layer.bias.resize(whole_groups(form.outputs) / kNetGroup);
  const auto put = [&](int output, int input, int tap, double value) {
    const long at = form.is_narrow()
                        ? output * layer.group_stride() + tap * layer.tap_stride() + input
                        : output / kNetGroup * layer.group_stride() + tap * layer.tap_stride() +
                              static_cast<long>(input) * kNetGroup + output % kNetGroup;
    layer.weights[at / kNetGroup].values[at % kNetGroup] = static_cast<float>(value);
  };
  const float* next = weights.data();
  for (int output = 0; output < form.outputs; ++output) {
    for (int input = 0; input < form.inputs; ++input, next += form.taps()) {
      const std::vector<double> taps =
          form.is_mixed() ? mixed_taps(form, next) : std::vector<double>(next, next + form.taps());
      for (int tap = 0; tap < static_cast<int>(taps.size()); ++tap) {
        put(output, input, tap, taps[tap]);
      }
    }
  }
  for (std::size_t i = 0; i < bias.size(); ++i) {
    layer.bias[i / kNetGroup].values[i % kNetGroup] = bias[i];
  }
  return layer;
}

NetWeights::NetWeights(const NamedArrays& arrays) : record_(arrays.record) {
  require_known(arrays);
  for (const NetLayerForm& form : kForms) layers_.emplace(form.name, read_layer(arrays, form));
}

}  // namespace episcope
