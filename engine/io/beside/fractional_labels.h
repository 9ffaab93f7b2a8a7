// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/beside/beside_views.h"
#include "engine/io/beside/find_maps.h"

#include <vector>

namespace episcope::io {

/// Files of `.npy`, `.npz`, `.mat` and HDF5 that are named like labels and hold floats with
/// fractions hold disparity, as EPINET names it: their sets become sets of disparity, or are left
/// out where there is disparity under its own name. One file of each set is looked at.
void settle_fractional_labels(std::vector<MapSet>& sets, const BesideViews& views,
                              const BesideNotes& notes);

}  // namespace episcope::io
