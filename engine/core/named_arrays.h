// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace episcope {

/// An array of a file that holds several, by its name; the last axis is contiguous.
struct NamedArray {
  std::string name;
  std::vector<std::size_t> shape;
  std::vector<float> values;
};

/// Weights of a network as a file holds them, and the text (JSON) that describes them.
struct NamedArrays {
  std::vector<NamedArray> arrays;
  std::string record;
};

}  // namespace episcope
