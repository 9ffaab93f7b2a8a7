// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// What the device can do at most, measured: what kernels are held against.
struct DeviceBounds {
  double bytes = 0;       ///< Copied within its memory a second, read and written.
  double operations = 0;  ///< FP32 a second; a multiply-add counts as two.
};

/// Measures them, in a tenth of a second. Throws DeviceFailure.
[[nodiscard]] DeviceBounds measure_device_bounds();

}  // namespace episcope
