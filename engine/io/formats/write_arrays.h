// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/estimate.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/core/view_stack.h"

#include <filesystem>

namespace episcope::io {

/// Writes the views as one array `[v][u][y][x][c]` in their sample type, without maps. Atomic.
/// Throws IoError, Cancelled.
void write_npy(const std::filesystem::path& path, const Scene& scene, const Progress& progress);

/// Writes an uncompressed archive of `lf` as above and, where the scene has them, `disparity`
/// (float, NaN = invalid), `labels` (int32) and `valid` (uint8, 0 = invalid): `[y][x]` of the
/// center view alone, else `[v][u][y][x]`. Throws IoError, Cancelled.
void write_npz(const std::filesystem::path& path, const Scene& scene, const Progress& progress);

/// Writes a MATLAB file of version 7.3 as LFToolbox does: LF(t, s, v, u, c), t and s for rows and
/// columns of views, v and u for those of pixels; a fourth channel is the weight, 0 = invalid, if
/// the scene has invalid pixels. `disparity`, `labels` and, for grey views, `valid` as above, in
/// MATLAB's order: (v, u) or (t, s, v, u). Throws IoError, Cancelled.
void write_mat(const std::filesystem::path& path, const Scene& scene, const Progress& progress);

/// Disparity as files hold it: NaN where it is invalid; empty if there is none.
[[nodiscard]] ViewStack<float> disparity_with_nan(const DisparityField& field);

/// Writes maps alone as one array, `[y][x]` of a single view, else `[v][u][y][x]`, NaN = invalid.
/// Atomic. Throws IoError.
void write_npy_maps(const std::filesystem::path& path, const ViewStack<float>& maps);

/// Write the maps of a result as arrays of the same shape: `disparity`, NaN where it is invalid,
/// and, where the result has them, `confidence`, `valid` (uint8, 0 = invalid) and
/// `disparity_second`, NaN where there is none. `.npz` archive; MATLAB file of version 7.3, in its
/// order, (y, x) or (v, u, y, x). Atomic. Throw IoError.
void write_npz_maps(const std::filesystem::path& path, const Estimate& estimate);
void write_mat_maps(const std::filesystem::path& path, const Estimate& estimate);

}  // namespace episcope::io
