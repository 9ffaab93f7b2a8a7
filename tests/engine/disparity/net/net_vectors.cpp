// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/disparity/net/net_vectors.h"

#include "engine/core/error.h"
#include "engine/io/base/npy.h"

#include <algorithm>
#include <cmath>
#include <limits>

// EPISCOPE_NET_WEIGHTS, EPISCOPE_NET_VECTORS: paths, by tests/engine/CMakeLists.txt.

namespace episcope::test {

namespace {

const std::vector<io::ZipEntry>& entries() {
  static const std::vector<io::ZipEntry> found = io::list_zip(EPISCOPE_NET_VECTORS);
  return found;
}

template <class T>
std::vector<T> values_of(const std::string& name, std::vector<std::size_t>* shape = nullptr) {
  for (const io::ZipEntry& entry : entries()) {
    if (entry.name != name + ".npy") continue;
    const io::NpyFile file(EPISCOPE_NET_VECTORS, entry.begin, entry.stored);
    std::vector<T> values(io::element_count(file.shape()));
    file.read(io::ArrayShape(file.shape().size(), 0), file.shape(), values.data());
    if (shape) *shape = file.shape();
    return values;
  }
  throw IoError(EPISCOPE_NET_VECTORS, "there is no vector " + name);
}

}  // namespace

NetVector net_vector(const std::string& name) {
  NetVector vector;
  vector.values = values_of<float>(name, &vector.shape);
  return vector;
}

Image<float> net_vector_map(const std::string& name) {
  const NetVector vector = net_vector(name);
  Image<float> map(vector.length(0), vector.length(1));
  std::ranges::copy(vector.values, map.begin());
  return map;
}

std::string released_weights_path() {
  return EPISCOPE_NET_WEIGHTS;
}

const NetWeights& released_weights() {
  static const NetWeights weights(read_named_arrays(EPISCOPE_NET_WEIGHTS));
  return weights;
}

LightField vector_light_field() {
  std::vector<std::size_t> shape;
  const std::vector<std::uint8_t> samples = values_of<std::uint8_t>("views", &shape);
  const std::vector<std::int32_t> offsets = values_of<std::int32_t>("offsets");
  ViewStack<std::uint8_t> views({5, 5}, static_cast<int>(shape[1]), static_cast<int>(shape[2]), 3);
  for (int i = 0; i < 25; ++i) {
    const ViewIndex view{2 + offsets[2 * i], 2 + offsets[2 * i + 1]};
    std::copy_n(samples.begin() + static_cast<long>(i * views.view_size()), views.view_size(),
                views.view(view).data);
  }
  return {std::move(views), {}};
}

Interval vector_range() {
  const std::vector<float> range = values_of<float>("range");
  return {range[0], range[1]};
}

double largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = std::abs(static_cast<double>(a[i]) - b[i]);
    if (!(difference <= largest)) largest = difference;
    if (std::isnan(difference)) return std::numeric_limits<double>::infinity();
  }
  return largest;
}

double largest_difference(const Image<float>& a, const std::string& vector) {
  return largest_difference(std::vector<float>(a.begin(), a.end()), net_vector(vector).values);
}

}  // namespace episcope::test
