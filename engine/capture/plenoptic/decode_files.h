// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/plenoptic/decode.h"
#include "engine/capture/plenoptic/raw_picture.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope::capture {

/// The white picture that fits best, and why it was taken.
struct ChosenWhite {
  RawPicture picture;
  std::string reason;  ///< A sentence with the numbers, for users.
};

/// Reads a white picture from a file (picture, container, bare .raw), or chooses the nearest of the
/// calibration data of a Lytro camera: MOD_nnnn.RAW with their .TXT in a folder, in a tar
/// (caldata-<serial>.tar), or in storage containers (data.C.0 …), alone or in the folder. Throws
/// IoError, InvalidInput.
[[nodiscard]] ChosenWhite read_white(const std::filesystem::path& path, const RawPicture& raw);

/// A file beside a raw picture: NAME_white.* or white.* (`kind` "white"; likewise "dark"), or for
/// white also the calibration data there: caldata-*.tar, data.C.0, MOD_0000.RAW. Empty if there is
/// none.
[[nodiscard]] std::filesystem::path find_beside(const std::filesystem::path& raw,
                                                const std::string& kind);

/// The files of one exposure, as a user names them.
struct PictureFiles {
  std::filesystem::path raw;
  /// A file, folder or tar (read_white); empty = the white picture that the raw file holds or that
  /// lies beside it (find_beside), else none.
  std::filesystem::path white{};
  std::filesystem::path dark{};    ///< Empty = the one beside the raw file, else none.
  std::filesystem::path camera{};  ///< Optics of a laboratory camera (read_optics).
  std::optional<Mosaic> mosaic{};  ///< Of a picture whose file does not tell; else gray.
};

/// Pictures that were read, and sentences for users about which were taken and why.
struct FoundPictures {
  PlenopticPictures pictures;
  std::vector<std::string> notes;
};

/// Throws IoError, InvalidInput if they do not match.
[[nodiscard]] FoundPictures read_pictures(const PictureFiles& files);

/// Facts out of a small text file of lines "key = value" below "[section]", lengths in mm: [sensor]
/// model, pixel_size_x; [micro_lens] physical_size_s; [main_lens] f1. Other keys are ignored.
/// Throws IoError for a file that has none of these.
[[nodiscard]] RawFacts read_optics(const std::filesystem::path& path);

/// What was decoded, as a scene that can be written or shown. Its format tells of raw picture,
/// lenses and facts in one line, which files keep (StatedFacts::origin).
/// Its warnings begin with the notes of `found`.
[[nodiscard]] Scene scene_of(const Decoded& decoded, const FoundPictures& found);

/// Whether a scene is what `decode_files` makes of the container that it was opened from.
[[nodiscard]] bool is_decoded(const Scene& scene, const std::filesystem::path& input);

/// Reads, finds the lenses and decodes: all of it. Throws IoError, InvalidInput, Cancelled.
[[nodiscard]] Scene decode_files(const PictureFiles& files, const DecodeOptions& options,
                                 const Progress& progress);

/// Writes the light field in the form of the archive, with mask and origin. Throws IoError,
/// Cancelled.
void write_decoded(const std::filesystem::path& path, const Decoded& decoded,
                   const FoundPictures& found, const Progress& progress);

}  // namespace episcope::capture
