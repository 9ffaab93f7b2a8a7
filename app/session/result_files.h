// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/io/models/map_reading.h"
#include "engine/io/models/open_options.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope {

/// Whether a path names a result: a result file; another HDF5 file, an `.npz` or a MATLAB file with
/// maps and no light field; a PFM, a `.csv`, an `.npy` of one map or named like disparity, a float
/// TIFF. False for built-in scenes and for what does not exist. Throws IoError if it is a damaged
/// HDF5 file.
[[nodiscard]] bool names_result(const std::string& path);

/// Whether a path can name a light field only: a built-in scene, a folder, an HDF5 file with
/// samples or true depth that is no result file. Throws IoError if that is damaged.
[[nodiscard]] bool names_light_field_only(const std::string& path);

/// Whether maps have as many rows as the views have columns, and the other way round.
[[nodiscard]] bool are_on_their_side(const ViewStack<float>& maps, const LightField& light_field);

/// Reads a result of this light field, as a user says (`reading`) beyond what its file states.
/// Throws IoError, also for a file that holds a light field or depth, which would else be judged as
/// disparity, and for maps whose rows and columns are exchanged for those of the views;
/// InvalidInput as `io::apply_reading`, and if it does not fit (check_fits).
[[nodiscard]] Estimate read_result_of(const LightField& light_field,
                                      const std::filesystem::path& path,
                                      const io::MapReading& reading = {});

/// Maps of another program as a result of this light field, as if they were read from a file:
/// values that are not finite become invalid, padding is cut off, and a bare border is not judged.
/// Throws InvalidInput as `io::apply_reading`, and if they do not fit (check_fits).
[[nodiscard]] Estimate result_from_maps(const LightField& light_field, DisparityField maps,
                                        const std::string& method,
                                        const io::MapReading& reading = {});

/// Reads a result without its light field: a result file knows the places of its views; a map from
/// elsewhere becomes view 0,0. Throws IoError, InvalidInput.
[[nodiscard]] Estimate read_result_alone(const std::filesystem::path& path,
                                         const io::MapReading& reading = {});

/// How to read `input`, so that it has the views that a result or labels were made from: what
/// `given` says and, where that is silent, what their file says of its own light field. The focus
/// plane holds for every form, the other options for the form that they were given for. `result`
/// names the file in sentences. Throws IoError, saying what to change, if `given` contradicts the
/// result; InvalidInput for a bad option.
[[nodiscard]] io::OpenOptions options_for_result(const std::string& result,
                                                 const Reading& of_result, const std::string& input,
                                                 const ParameterSet& given);

/// Brings a result to the focus plane of the light field, if its file says that it was estimated at
/// another. Throws Cancelled.
void bring_to_focus(Estimate& estimate, const LightField& light_field, const Progress& progress);

/// What a result file says of its light field: a built-in scene as it is typed, else a path
/// relative to the folder of the result, so that both can move together; absolute only where they
/// share no folder but the root. Its last part is the name; the hash of the samples is beside it.
/// Nothing if `input` is empty: the light field comes from no file.
[[nodiscard]] std::string source_text(const std::string& input,
                                      const std::filesystem::path& result);

/// The path that `source_text` wrote, in `result`.
[[nodiscard]] std::string absolute_path(const std::string& text,
                                        const std::filesystem::path& result);

/// Whether an input can be opened still: a folder only with a light field in it,
/// which may be damaged.
[[nodiscard]] bool is_there(const std::string& input, const ParameterSet& reading);

/// The INPUT behind a `source` that was read from the file `result`; empty if there is none or it
/// is not where it was.
[[nodiscard]] std::string existing_source(const std::string& source,
                                          const std::filesystem::path& result);

/// The `source` that a result file states; empty for other files. Throws IoError if it is an HDF5
/// file and damaged.
[[nodiscard]] std::string stated_source(const std::filesystem::path& result);

/// Whether two inputs are one light field; its folder stands for an lf.h5.
[[nodiscard]] bool is_same_input(const std::string& a, const std::string& b);

/// Light field that a result belongs to.
struct ResultOwner {
  std::string input{};     ///< What opens it; empty = unknown.
  bool is_stated = false;  ///< By the file; else it lies in the folder of the light field.
};

/// Finds the light field of a result or map. None is named where it is `front` (may be null), which
/// `front_input` opened: by the samples that the file states, or because it lies in the folder of
/// the map, too. Throws IoError for a damaged file.
[[nodiscard]] ResultOwner owner_of_result(const std::filesystem::path& result,
                                          const LightField* front, const std::string& front_input);

/// Forms of a disparity map, told by the suffix of its file.
enum class MapForm {
  Result,     ///< .h5, .hdf5: all views, confidence, provenance.
  Pfm,        ///< .pfm: one view.
  Tiff,       ///< .tif, .tiff: one view.
  Csv,        ///< .csv: one view.
  Npy,        ///< .npy: one view or all.
  Npz,        ///< .npz: one view or all; `disparity`, `confidence`, `valid`, `disparity_second`.
  Mat,        ///< .mat: the same; version 7.3.
  PointCloud  ///< .ply: one view, colored.
};
/// Empty for another suffix.
[[nodiscard]] std::optional<MapForm> map_form_of(const std::filesystem::path& path);
[[nodiscard]] bool holds_all_views(MapForm form);

/// Writes a result file; `input` is what opens the light field. Atomic. Throws IoError, Cancelled.
void save_result(const std::filesystem::path& path, const Estimate& estimate,
                 const std::string& input, const Progress& progress);

/// A result with all that it has of one view, and nothing of others.
[[nodiscard]] Estimate one_view(const Estimate& estimate, ViewIndex view);

/// Writes the maps of one view as the suffix says, else as TIFF: disparity, NaN where it is
/// invalid, and in forms of several arrays what the result has beside it. Atomic. Throws IoError.
/// Precondition: the result has that view.
void save_map(const std::filesystem::path& path, const Estimate& estimate, ViewIndex view);
/// Writes those of all views there are. Precondition: the form of `path` holds all views, or there
/// is one.
void save_maps(const std::filesystem::path& path, const Estimate& estimate);

/// Writes the valid pixels of a view that the light field shows as a colored point cloud. Atomic.
/// Throws IoError, InvalidInput if no pixel is valid.
void save_point_cloud(const std::filesystem::path& path, const LightField& light_field,
                      ViewIndex view, const DisparityView& map);

}  // namespace episcope
