// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/plenoptic/decode_files.h"

#include "engine/capture/plenoptic/white_pictures.h"
#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/sample_range.h"
#include "engine/io/formats/write_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <utility>

namespace episcope::capture {
namespace {

namespace fs = std::filesystem;

/// Values by "section.key".
std::map<std::string, std::string> read_sections(const fs::path& path) {
  io::require_openable_file(path);
  constexpr std::uintmax_t kLargestText = 1 << 20;
  if (fs::file_size(path) > kLargestText) {
    throw IoError(path, "this is too large for a description of a camera; choose another file");
  }
  std::ifstream file(path);
  std::map<std::string, std::string> values;
  std::string section;
  for (std::string text; std::getline(file, text);) {
    const std::string_view line = trimmed(text, kQuotesAndBlanks);
    if (line.starts_with('[')) {
      section = line.substr(1, line.find(']') - 1);
      continue;
    }
    const auto equals = line.find('=');
    if (equals == line.npos) continue;
    const auto key = std::string(trimmed(line.substr(0, equals), kQuotesAndBlanks));
    values[section + "." + key] = trimmed(line.substr(equals + 1), kQuotesAndBlanks);
  }
  return values;
}

void take_mosaic(RawPicture& picture, const std::optional<Mosaic>& mosaic) {
  if (mosaic && picture.mosaic == Mosaic::Gray) picture.mosaic = *mosaic;
}

/// Files of 16 bits may hold samples of 8 to 14: the largest of all pictures tells.
void settle_bits(FoundPictures& found) {
  constexpr int k16Bits = 65535, k14Bits = 16383, kMostOf13Bits = 9000;
  auto& [raw, white, dark] = found.pictures;
  int largest = 1;
  std::vector<RawPicture*> words;
  for (RawPicture* picture : {&raw, white ? &*white : nullptr, dark ? &*dark : nullptr}) {
    if (!picture || picture->black != 0 || picture->white != k16Bits) continue;
    words.push_back(picture);
    largest = std::max<int>(largest, *std::ranges::max_element(picture->samples));
  }
  const bool is_of_14_bits = largest > kMostOf13Bits && largest <= k14Bits;
  const int full = is_of_14_bits ? k14Bits : io::full_scale(largest);
  if (words.empty() || full == k16Bits) return;
  for (RawPicture* picture : words) picture->white = full;
  found.notes.push_back(
      fmt::format(finding_text("plenoptic.bits"), std::bit_width(static_cast<unsigned>(full))));
}

/// Facts of the optics where the camera itself says nothing.
void add_facts(RawFacts& facts, const RawFacts& optics) {
  if (facts.model.empty()) facts.model = optics.model;
  if (!facts.pixel_pitch_um) facts.pixel_pitch_um = optics.pixel_pitch_um;
  if (!facts.lens_pitch_um) facts.lens_pitch_um = optics.lens_pitch_um;
  if (!facts.focal_length_mm) facts.focal_length_mm = optics.focal_length_mm;
}

void find_white(const PictureFiles& files, std::optional<RawPicture> own, FoundPictures& found) {
  RawPicture& raw = found.pictures.raw;
  if (files.white.empty() && own) {
    found.pictures.white = std::move(own);
    found.notes.emplace_back(finding_text("plenoptic.white_inside"));
    return;
  }
  const fs::path path = files.white.empty() ? find_beside(files.raw, "white") : files.white;
  if (path.empty()) return;
  ChosenWhite chosen = read_white(path, raw);
  take_mosaic(chosen.picture, files.mosaic);
  found.pictures.white = std::move(chosen.picture);
  found.notes.push_back(std::move(chosen.reason));
}

void find_dark(const PictureFiles& files, FoundPictures& found) {
  const fs::path path = files.dark.empty() ? find_beside(files.raw, "dark") : files.dark;
  if (path.empty()) return;
  found.pictures.dark = read_raw(path).raw;
  take_mosaic(*found.pictures.dark, files.mosaic);
  found.notes.push_back(fmt::format(finding_text("plenoptic.dark"), found.pictures.dark->name));
}

/// Throws if a picture is given twice.
void require_different(const PlenopticPictures& pictures) {
  const auto check = [](const RawPicture& other, const char* what, const RawPicture& picture) {
    if (std::ranges::equal(other.samples, picture.samples)) {
      throw InvalidInput(fmt::format("the {} picture {} is the same picture as {}", what,
                                     other.name, picture.name));
    }
  };
  const auto& [raw, white, dark] = pictures;
  if (white) check(*white, "white", raw);
  if (dark) check(*dark, "dark", raw);
  if (white && dark) check(*dark, "dark", *white);
}

constexpr const char* kDecodedFrom = "decoded from ";

/// Raw picture, lenses and facts in one line.
std::string origin_text(const Decoded& decoded, const RawPicture& raw) {
  const LensGrid& grid = decoded.grid;
  std::string text =
      fmt::format(finding_text("plenoptic.decoded"), raw.name, lattice_name(grid.lattice),
                  grid.pitch_px, grid.rotation_degrees, decoded.step_px);
  const auto facts = raw.facts.table();
  if (facts.empty()) return text;
  return text + "; " +
         joined(facts, ", ", [](const auto& fact) { return fact.first + " " + fact.second; });
}

}  // namespace

FoundPictures read_pictures(const PictureFiles& files) {
  FoundPictures found;
  RawFile file = read_raw(files.raw);
  found.pictures.raw = std::move(file.raw);
  if (files.mosaic.value_or(Mosaic::Gray) != Mosaic::Gray &&
      found.pictures.raw.mosaic != Mosaic::Gray) {
    found.notes.push_back(fmt::format(finding_text("option.ignored"), "mosaic",
                                      "a picture whose camera tells its colors"));
  }
  take_mosaic(found.pictures.raw, files.mosaic);
  if (!files.camera.empty()) add_facts(found.pictures.raw.facts, read_optics(files.camera));
  find_white(files, std::move(file.white), found);
  find_dark(files, found);
  require_matching(found.pictures);
  require_different(found.pictures);
  settle_bits(found);
  return found;
}

RawFacts read_optics(const fs::path& path) {
  const std::map<std::string, std::string> values = read_sections(path);
  const auto number = [&](const char* key, double factor) -> std::optional<double> {
    const auto value = values.find(key);
    if (value == values.end()) return {};
    const auto read = io::parse_number(value->second);
    return read && *read > 0 ? std::optional(*read * factor) : std::nullopt;
  };
  RawFacts facts;
  if (const auto model = values.find("sensor.model"); model != values.end()) {
    facts.model = model->second;
  }
  facts.pixel_pitch_um = number("sensor.pixel_size_x", 1e3);
  facts.lens_pitch_um = number("micro_lens.physical_size_s", 1e3);
  facts.focal_length_mm = number("main_lens.f1", 1);
  if (facts.table().empty()) {
    throw IoError(path,
                  "this describes no camera: [sensor] pixel_size_x, [micro_lens] "
                  "physical_size_s or [main_lens] f1 is expected, in mm");
  }
  return facts;
}

Scene scene_of(const Decoded& decoded, const FoundPictures& found) {
  Scene scene;
  scene.light_field = decoded.light_field;
  scene.truth = std::make_shared<const GroundTruth>();
  scene.convention.format = origin_text(decoded, found.pictures.raw);
  scene.convention.order = "canonical order";
  scene.convention.order_check = "a pixel right of a lens's center sees from the right";
  scene.convention.sign = "checked";
  scene.convention.sign_check = "exact by construction";
  scene.convention.samples = decoded.is_gamma_encoded ? "uint16, gamma-encoded" : "uint16, linear";
  scene.convention.stated = {scene.convention.format, scene.convention.samples,
                             scene.convention.sign_check};
  scene.convention.warnings = found.notes;
  std::ranges::copy(decoded.warnings, std::back_inserter(scene.convention.warnings));
  return scene;
}

bool is_decoded(const Scene& scene, const fs::path& input) {
  const std::string suffix = suffix_of(input);
  return (suffix == ".lfp" || suffix == ".lfr") &&
         scene.convention.format.starts_with(kDecodedFrom);
}

Scene decode_files(const PictureFiles& files, const DecodeOptions& options,
                   const Progress& progress) {
  progress.step("reading " + files.raw.filename().string());
  const FoundPictures found = read_pictures(files);
  progress.check();
  const LensGrid grid = find_lenses(found.pictures, progress.part(0.1, 0.4));
  return scene_of(decode(found.pictures, grid, options, progress.part(0.4, 1)), found);
}

void write_decoded(const fs::path& path, const Decoded& decoded, const FoundPictures& found,
                   const Progress& progress) {
  io::write_archive(path, scene_of(decoded, found), progress);
}

}  // namespace episcope::capture
