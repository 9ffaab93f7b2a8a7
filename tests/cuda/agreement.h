// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"
#include "tests/cuda/cases.h"

#include <string>

namespace episcope::cuda_tests {

/// How a run on the device compares with the CPU's, and with itself.
struct Agreement {
  double within =
      0;  ///< Share of the pixels of all views whose disparity is within its kind's limit.
  double largest = 0;     ///< Largest difference of disparity, px.
  double confidence = 0;  ///< Share whose confidence is within 1e-3.
  double cpu_mse = 0;     ///< ×100, center view.
  double device_mse = 0;
  bool is_repeatable = false;  ///< Two runs on the device gave the same bits.
  bool passes = false;         ///< By the limits of its kind.
};

/// Runs a case three times, on the CPU once. Throws as Estimator::run, with Device::Cuda.
[[nodiscard]] Agreement compare(const Case& each, const Scene& scene);

}  // namespace episcope::cuda_tests
