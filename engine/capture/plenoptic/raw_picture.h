// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/schema.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace episcope::capture {

using ByteView = std::span<const std::uint8_t>;

/// One part of a container.
struct LfpSection {
  bool is_table = false;  ///< JSON that names the other sections, not data.
  std::string reference;  ///< "sha1-" and 40 digits: the hash of the data, and its name.
  std::vector<std::uint8_t> data;

  [[nodiscard]] std::string text() const { return {data.begin(), data.end()}; }
};

/// The container of Lytro cameras (.lfp, .lfr): a signature of 16 bytes, then sections of a header
/// (signature, length as big endian u32, hash as text, 35 zero bytes) and data padded to 16 bytes.
struct LfpContainer {
  std::vector<LfpSection> sections;

  /// The section of this reference; null if there is none.
  [[nodiscard]] const LfpSection* find(const std::string& reference) const;
};

/// Whether the file begins as such a container.
[[nodiscard]] bool is_lfp_container(const std::filesystem::path& path);

/// Reads a whole container. Throws IoError with one sentence for a truncated file, a length beyond
/// its end, data that do not match their hash, and for no such container.
[[nodiscard]] LfpContainer read_lfp(const std::filesystem::path& path);

/// Name of data in a container: "sha1-" and the hash.
[[nodiscard]] std::string lfp_reference(ByteView data);

/// Writes a container of these sections, whose references are computed. Atomic. Throws IoError.
void write_lfp(const std::filesystem::path& path, const LfpContainer& container);

/// Colors of the first two pixels of the first row of a sensor.
enum class Mosaic { Gray, Rggb, Grbg, Gbrg, Bggr };
[[nodiscard]] Names<Mosaic> names_of(Mosaic);

/// Color of a pixel: 0 red, 1 green, 2 blue; 0 on a gray sensor.
[[nodiscard]] int color_at(Mosaic mosaic, int y, int x);

/// How samples of a Lytro camera are packed.
enum class Packing {
  Bits12,  ///< Two samples in 3 bytes, big endian (F01).
  Bits10,  ///< Four samples in 5 bytes: high bits of each, then low bits of all (Illum).
  Bits16   ///< Little endian.
};

/// What the camera says of a picture; what it does not say is empty.
struct RawFacts {
  std::string model;
  std::string serial;
  std::string time;
  std::optional<double> zoom_step;
  std::optional<double> focus_step;
  std::optional<double> exposure_s;
  std::optional<double> iso;
  std::optional<double> f_number;
  std::optional<double> focal_length_mm;
  std::optional<double> pixel_pitch_um;
  std::optional<double> lens_pitch_um;

  /// What is known, as pairs of a key and a text with its unit.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> table() const;
};

/// How linear colors of the sensor become those of a screen.
struct RawColors {
  std::array<double, 3> balance{1, 1, 1};  ///< Gains of red, green, blue.
  /// Camera to linear sRGB, row by row; out = M·in.
  std::array<double, 9> to_srgb{1, 0, 0, 0, 1, 0, 0, 0, 1};
  double gamma = 1;          ///< Exponent: shown = linear^gamma.
  bool is_balanced = false;  ///< The camera told the gains.
};

/// A picture as the sensor saw it.
struct RawPicture {
  Image<std::uint16_t> samples;  ///< One channel.
  double black = 0;              ///< Sample without light,
  double white = 65535;          ///< and where the sensor saturates.
  Mosaic mosaic = Mosaic::Gray;
  RawFacts facts{};
  RawColors colors{};
  std::string name{};    ///< Of its file.
  std::string source{};  ///< What opens it again; empty = nothing does.
};

/// Largest share of saturated samples, and least level, of a white picture that is exposed well.
inline constexpr double kMostSaturated = 0.01;
inline constexpr double kDarkWhite = 0.1;

/// Level that a tenth of the samples exceeds, from black (0) to white (1).
[[nodiscard]] double light_level(const RawPicture& picture);
/// Share of the samples that are saturated.
[[nodiscard]] double saturated_share(const RawPicture& picture);

struct RawFile {
  RawPicture raw;
  std::optional<RawPicture> white{};  ///< The white picture that the container brings along.
};

/// Reads a container (.lfp, .lfr), a bare .raw of a Lytro camera with its JSON (.txt, .json) beside
/// it, or a picture of one channel (PNG, TIFF, …; 8 to 16 bit). Levels of a picture are 0 and the
/// full scale of its type. Throws IoError: also for a container without a raw picture, for sizes
/// that do not fit the data, for a picture of several channels.
[[nodiscard]] RawFile read_raw(const std::filesystem::path& path);

/// Whether a container holds what the sensor saw. Throws InvalidInput if its table names no frame.
[[nodiscard]] bool holds_raw(const LfpContainer& container);

/// What the JSON of a camera says of a picture. Throws InvalidInput for what is no JSON.
[[nodiscard]] RawFacts facts_from_json(const std::string& metadata);

/// Samples of `height`×`width` px. Throws InvalidInput if there are not exactly as many bytes as
/// they take.
[[nodiscard]] Image<std::uint16_t> unpack(ByteView bytes, Packing packing, int height, int width);
[[nodiscard]] std::vector<std::uint8_t> pack(const Image<std::uint16_t>& samples, Packing packing);

/// A raw picture out of the bytes of its samples and the JSON of the camera, of either generation
/// or of calibration data, which wrap it (master.picture.frameArray[0].frame).
/// Throws InvalidInput for JSON that lacks what is needed or says what cannot be, or other bytes.
[[nodiscard]] RawPicture raw_from_json(ByteView samples, const std::string& metadata,
                                       const std::string& private_metadata);

/// JSON of the first generation (F01) or the second (Illum) that `raw_from_json` reads, for `raw`.
[[nodiscard]] std::string f01_metadata(const RawPicture& raw);
[[nodiscard]] std::string illum_metadata(const RawPicture& raw);
/// JSON beside a white picture of an F01's calibration data.
[[nodiscard]] std::string calibration_metadata(const RawPicture& raw);

}  // namespace episcope::capture
