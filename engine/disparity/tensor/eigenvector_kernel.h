// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/tensor/structure_tensor_kernel.h"

namespace episcope {

/// The orientation of a tensor computed in full, where OrientationKernel only compares.
struct EigenvectorKernel {
  /// As OrientationKernel::select, for limits of any size, and without regard to the range: resolve
  /// takes the coherence of what lies beyond. With `replace` the tensor kept is the
  /// one whose least-squares disparity and coherence, as OrientationKernel::resolve reads them, are
  /// those of the eigenvector in the sheared frame: d = −2Jxs/(Jxx − Jss + √((Jxx − Jss)² +
  /// 4Jxs²)), r = √((Jxx − Jss)² + 4Jxs²)/(Jxx + Jss + n²).
  void (*select)(const TensorBlock&, const TensorFilters&, const Shear&, bool replace);
};

EPISCOPE_DECLARE_KERNEL(extern const EigenvectorKernel kEigenvectorKernel);

}  // namespace episcope
