// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/cloud/vtk_version.h"

#include <vtkVersion.h>

namespace episcope {

std::string vtk_version() {
  return vtkVersion::GetVTKVersion();
}

}  // namespace episcope
