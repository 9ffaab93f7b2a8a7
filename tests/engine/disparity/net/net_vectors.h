// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/disparity/net_weights.h"

#include <string>
#include <vector>

namespace episcope::test {

/// An array of numbers of the training's framework: tests/engine/disparity/net_vectors.npz, written
/// by resources/training/export.py.
struct NetVector {
  std::vector<std::size_t> shape;
  std::vector<float> values;

  [[nodiscard]] int length(std::size_t axis) const { return static_cast<int>(shape.at(axis)); }
};

/// Throws IoError if there is none of this name.
[[nodiscard]] NetVector net_vector(const std::string& name);
/// A map of the vectors.
[[nodiscard]] Image<float> net_vector_map(const std::string& name);

/// resources/weights/net.npz.
[[nodiscard]] const NetWeights& released_weights();
[[nodiscard]] std::string released_weights_path();

/// The light field of the vectors: 5×5 views of 28×32 px in colour and 8 bits; their reference is
/// the center.
[[nodiscard]] LightField vector_light_field();
[[nodiscard]] Interval vector_range();

/// Largest |a − b|; infinity if the sizes differ or one is not a number.
[[nodiscard]] double largest_difference(const std::vector<float>& a, const std::vector<float>& b);
[[nodiscard]] double largest_difference(const Image<float>& a, const std::string& vector);

}  // namespace episcope::test
