// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// Where something is computed; Auto takes a GPU where there is one and what is computed can.
enum class Device { Auto, Cpu, Cuda };

}  // namespace episcope
