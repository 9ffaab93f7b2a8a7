// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/kernels/net_kernel.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
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
  std::uint64_t hash = 0;  ///< Fnv1a of the bytes of the file.
};

/// Most numbers that are read, all arrays together.
inline constexpr std::size_t kMostWeights = std::size_t{1} << 25;

/// Reads weights of a network as `numpy.savez` writes them: an `.npz` archive of arrays of bytes
/// with a sign, half or single floats in C order, not compressed, and one, `record`, of the bytes
/// of a JSON object. That form needs no library, so that a build of the estimators alone reads it;
/// io reads all others. Sources: PKWARE APPNOTE 6.3.10, numpy.lib.format. Throws IoError if there
/// is no such file; if it is damaged, truncated or compressed; if it holds arrays of other numbers,
/// two of one name, numbers that are not finite, or more of them than `kMostWeights`; and without a
/// record.
[[nodiscard]] NamedArrays read_named_arrays(const std::filesystem::path& path);

/// The file of this name in share/episcope/weights of the nearest folder above the program or
/// library that this code is part of, else in episcope/weights of the system's folders of data
/// (XDG_DATA_DIRS). Throws Unavailable if none has it.
[[nodiscard]] std::filesystem::path installed_weights(std::string_view name);

/// Channels are stored in groups of so many, and weights are put in order for as many outputs.
inline constexpr int kNetGroup = 16;

/// Channels with those that fill the last group, which are 0.
[[nodiscard]] constexpr int whole_groups(int channels) {
  return (channels + kNetGroup - 1) / kNetGroup * kNetGroup;
}

/// The form of a convolution of `net`.
struct NetLayerForm {
  const char* name = "";
  int dimensions = 2;  ///< 2: rows and columns; 3: labels, rows and columns.
  int inputs = 1;
  int outputs = 1;
  int kernel = 3;  ///< Taps along each axis, 1 or 3; what is outside is 0.
  int stride = 1;
  int dilation = 1;
  bool has_bias = true;
  bool is_leaky = true;  ///< Followed by a leaky ReLU.

  [[nodiscard]] int depth_taps() const { return dimensions == 3 ? kernel : 1; }
  [[nodiscard]] int taps() const { return depth_taps() * kernel * kernel; }
  /// Whether outputs are so few that inputs are what kernels work on side by side.
  [[nodiscard]] bool is_narrow() const { return outputs <= 2; }
  /// Whether it is computed by mixed columns (kNetMixed) and by mixed labels or rows, which rows
  /// that are far apart are not.
  [[nodiscard]] bool is_mixed() const { return kernel == 3 && stride == 1 && !is_narrow(); }
  [[nodiscard]] bool mixes_labels() const { return is_mixed() && dimensions == 3; }
  [[nodiscard]] bool mixes_rows() const { return is_mixed() && dimensions == 2 && dilation == 1; }
  [[nodiscard]] int mixed_planes() const { return mixes_labels() || mixes_rows() ? kNetMixed : 1; }
  /// Taps that are left of a mixed layer: rows.
  [[nodiscard]] int plain_taps() const { return mixes_rows() ? 1 : kernel; }
};

/// Numbers of one group, on a boundary that loads do not cross.
struct alignas(64) NetGroup {
  std::array<float, kNetGroup> values{};
};

/// A convolution as its kernels want it.
struct NetLayer {
  NetLayerForm form;
  /// `[group of outputs][z][y][x][input][output of the group]`; of mixed layers
  /// `[group][mixed z or y][mixed x][y][input][output]`; of narrow layers
  /// `[output][z][y][x][input]`, inputs in whole groups. Zeros fill up.
  std::vector<NetGroup> weights;
  std::vector<NetGroup> bias;        ///< Zeros if it has none.
  std::vector<float> plain_weights;  ///< `[output][input](z)[y][x]`, as the device takes them.

  [[nodiscard]] const float* weights_data() const { return weights.front().values.data(); }
  [[nodiscard]] const float* bias_data() const { return bias.front().values.data(); }
  /// Numbers from one tap to the next, and from one group (output, of narrow layers) to the next.
  [[nodiscard]] long tap_stride() const {
    return form.is_narrow() ? whole_groups(form.inputs)
                            : static_cast<long>(form.inputs) * kNetGroup;
  }
  [[nodiscard]] long group_stride() const {
    return tap_stride() *
           (form.is_mixed() ? form.mixed_planes() * kNetMixed * form.plain_taps() : form.taps());
  }
};

/// The weights of `net`, checked, in the order of its kernels.
class NetWeights {
 public:
  /// Weights as `resources/weights/net.npz` holds them: `NAME.weight` `[output][input](z)[y][x]`,
  /// to be multiplied by `NAME.scale` `[output]` if there is one, and `NAME.bias`. Throws
  /// InvalidInput where an array is missing, unknown, or of another shape.
  explicit NetWeights(const NamedArrays& arrays);

  /// Precondition: the network has a layer of this name.
  [[nodiscard]] const NetLayer& layer(const std::string& name) const { return layers_.at(name); }
  /// What the file says of them (JSON).
  [[nodiscard]] const std::string& record() const { return record_; }

 private:
  std::map<std::string, NetLayer> layers_;
  std::string record_;
};

/// Puts weights `[output][input](z)[y][x]` and biases, empty if there are none, in order.
[[nodiscard]] NetLayer make_net_layer(const NetLayerForm& form, const std::vector<float>& weights,
                                      const std::vector<float>& bias);

}  // namespace episcope
