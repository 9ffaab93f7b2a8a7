// SPDX-License-Identifier: BSD-3-Clause
#include "tests/cuda/label_runs.h"

namespace episcope::cuda_tests {

LabelRun whole_labeler(const Scene&) {
  return {};
}

}  // namespace episcope::cuda_tests
