// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/plenoptic/decode_files.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/numbers.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/json.h"
#include "engine/io/base/sample_range.h"
#include "engine/io/formats/write_scene.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace episcope::capture {
namespace {

namespace fs = std::filesystem;
using FileBytes = std::vector<std::uint8_t>;

/// Files of calibration data by name in upper case, read when they are needed.
using CalibrationFiles = std::map<std::string, std::function<FileBytes()>>;

/// "MOD_0007.RAW" of "C:\CALIB\mod_0007.raw", "unit/MOD_0007.RAW" or
/// "data.C.0__C__CALIB__MOD_0007.RAW", as other programs extract it.
std::string base_name(const std::string& path) {
  std::string name = path.substr(path.find_last_of("/\\") + 1);
  if (const auto joint = name.rfind("__"); joint != name.npos) name.erase(0, joint + 2);
  std::ranges::transform(name, name.begin(), [](char c) {
    return static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  });
  return name;
}

FileBytes part_of(const fs::path& path, std::uintmax_t offset, std::uintmax_t bytes) {
  std::ifstream file(path, std::ios::binary);
  FileBytes data(bytes);
  file.seekg(static_cast<std::streamoff>(offset));
  if (!file.read(reinterpret_cast<char*>(data.data()), static_cast<std::streamsize>(bytes))) {
    throw IoError(path, "it ends before its last file; copy it again");
  }
  return data;
}

/// Adds the files of a storage container (data.C.0 …), which its table names.
void add_stored(const fs::path& path, CalibrationFiles& files) {
  const auto container = std::make_shared<const LfpContainer>(read_lfp(path));
  const auto table = std::ranges::find(container->sections, true, &LfpSection::is_table);
  if (table == container->sections.end()) return;
  try {
    const auto json = io::parse_json<nlohmann::json>(table->text());
    for (const auto& file : json.value("files", nlohmann::json::array())) {
      const std::string reference = file.value("dataRef", std::string());
      if (const LfpSection* section = container->find(reference)) {
        files[base_name(file.value("name", std::string()))] = [container, section] {
          return section->data;
        };
      }
    }
  } catch (const nlohmann::json::exception&) {
    throw IoError(path, "the table of this container is no JSON of calibration data");
  } catch (const InvalidInput& error) {
    throw IoError(path, error.what());
  }
}

constexpr std::size_t kTarBlock = 512;

/// The files of a tar (POSIX ustar), by the headers before them.
CalibrationFiles tar_files(const fs::path& path) {
  CalibrationFiles files;
  const std::uintmax_t end = fs::file_size(path);
  std::ifstream file(path, std::ios::binary);
  std::uintmax_t offset = 0;
  while (offset + kTarBlock <= end) {
    char header[kTarBlock];
    file.seekg(static_cast<std::streamoff>(offset));
    if (!file.read(header, kTarBlock) || header[0] == '\0') break;
    if (std::memcmp(header + 257, "ustar", 5) != 0) throw IoError(path, "this is no tar archive");
    std::uintmax_t bytes = 0;
    const char* digits = header + 124;
    while (*digits == ' ' || *digits == '0') ++digits;
    const auto [stop, error] = std::from_chars(digits, header + 136, bytes, 8);
    if ((error != std::errc() && stop != digits) || bytes > end - offset - kTarBlock) {
      throw IoError(path, "this tar archive is cut off or damaged; copy it again");
    }
    const std::string name(header, strnlen(header, 100));
    if (header[156] == '0' || header[156] == '\0') {
      files[base_name(name)] = [path, begin = offset + kTarBlock, bytes] {
        return part_of(path, begin, bytes);
      };
    }
    offset += kTarBlock + round_up(bytes, kTarBlock);
  }
  return files;
}

bool is_storage_name(const fs::path& path) {
  const std::string name = lower_case(path.filename().string());
  return name.starts_with("data.c.") && name.find_first_not_of("0123456789", 7) == name.npos;
}

CalibrationFiles calibration_files(const fs::path& path) {
  CalibrationFiles plain, stored;
  if (!fs::is_directory(path)) {
    if (suffix_of(path) == ".tar") return tar_files(path);
    add_stored(path, stored);
    return stored;
  }
  constexpr int kDeepestFolder = 3;  // folders; extracted data lie in unit/T1CALIB
  for (auto each =
           fs::recursive_directory_iterator(path, fs::directory_options::skip_permission_denied);
       each != fs::recursive_directory_iterator(); ++each) {
    const fs::directory_entry& entry = *each;
    if (each.depth() >= kDeepestFolder) each.disable_recursion_pending();
    if (!entry.is_regular_file()) continue;
    if (is_storage_name(entry.path())) {
      add_stored(entry.path(), stored);
    } else {
      plain[base_name(entry.path().filename().string())] =
          [file = entry.path(), bytes = entry.file_size()] { return part_of(file, 0, bytes); };
    }
  }
  return stored.empty() ? plain : stored;
}

std::string metadata_name(const std::string& raw) {
  return raw.substr(0, raw.size() - 4) + ".TXT";
}

std::string number_text(const std::optional<double>& number) {
  return number ? fmt::format("{:g}", *number) : "unknown";
}

std::string steps_text(const RawFacts& facts) {
  return fmt::format("zoom {}, focus {}", number_text(facts.zoom_step),
                     number_text(facts.focus_step));
}

/// A white picture of a camera's calibration data, before its samples are read.
struct WhiteCandidate {
  std::string name;  ///< Of its file, within the folder or archive.
  RawFacts facts;
  std::pair<double, double> rank{};  ///< Differences of zoom and focus.
};

bool is_other_camera(const RawFacts& a, const RawFacts& b) {
  return !a.serial.empty() && !b.serial.empty() && a.serial != b.serial;
}

/// Puts candidates first whose zoom is nearest to that of the raw picture, and among these whose
/// focus is. Leaves out candidates of another serial number. Throws InvalidInput, which names the
/// serial numbers, if none is left.
void order_whites(const RawFacts& raw, std::vector<WhiteCandidate>& candidates) {
  const auto distance = [](const std::optional<double>& a, const std::optional<double>& b) {
    return a && b ? std::abs(*a - *b) : std::numeric_limits<double>::max();
  };
  std::string others;
  std::erase_if(candidates, [&](WhiteCandidate& each) {
    const RawFacts& facts = each.facts;
    each.rank = {distance(raw.zoom_step, facts.zoom_step),
                 distance(raw.focus_step, facts.focus_step)};
    if (!is_other_camera(raw, facts)) return false;
    if (others.find(facts.serial) == others.npos) {
      others += (others.empty() ? "" : ", ") + facts.serial;
    }
    return true;
  });
  if (candidates.empty()) {
    throw InvalidInput(fmt::format(
        "no white picture is of this camera: the raw picture is of {}, they are of {}; use the "
        "calibration data of this camera",
        raw.serial, others));
  }
  std::ranges::stable_sort(candidates, {}, &WhiteCandidate::rank);
}

/// The best exposed of the nearest white pictures that are not dark: cameras take two of each zoom
/// and focus. `worse`: names of those that were left out for it.
RawPicture best_exposed(const CalibrationFiles& files, const std::vector<WhiteCandidate>& nearest,
                        WhiteCandidate& best, std::vector<std::string>& worse) {
  RawPicture chosen;
  double most = 0;
  for (const WhiteCandidate& each : nearest) {
    if (most > 0 && each.rank != best.rank) break;
    const FileBytes text = files.at(metadata_name(each.name))();
    RawPicture picture = raw_from_json(files.at(each.name)(), {text.begin(), text.end()}, {});
    const double level = light_level(picture), saturated = saturated_share(picture);
    const double quality = level < kDarkWhite ? 0 : saturated > kMostSaturated ? kDarkWhite : level;
    if (quality <= most) {
      worse.push_back(each.name);
      continue;
    }
    if (most > 0) worse.push_back(best.name);
    best = each;
    most = quality;
    chosen = std::move(picture);
  }
  if (most > 0) return chosen;
  throw InvalidInput(
      fmt::format("there is no light in the white pictures ({}); use other calibration data",
                  joined(worse, ", ")));
}

ChosenWhite choose(const fs::path& path, const RawPicture& raw) {
  const CalibrationFiles files = calibration_files(path);
  std::vector<WhiteCandidate> candidates;
  for (const auto& [name, read] : files) {
    if (!name.starts_with("MOD_") || !name.ends_with(".RAW")) continue;
    const auto metadata = files.find(metadata_name(name));
    if (metadata == files.end()) continue;
    const FileBytes text = metadata->second();
    candidates.push_back({name, facts_from_json({text.begin(), text.end()}), {}});
  }
  if (candidates.empty()) {
    throw IoError(path, "there is no white picture here: MOD_nnnn.RAW with its .TXT is expected");
  }
  const std::size_t count = candidates.size();
  order_whites(raw.facts, candidates);
  WhiteCandidate best;
  std::vector<std::string> worse;
  ChosenWhite chosen{best_exposed(files, candidates, best, worse), {}};
  chosen.picture.name = best.name;
  const std::string steps = steps_text(best.facts), wanted = steps_text(raw.facts);
  chosen.reason = worse.empty() ? fmt::format(finding_text("plenoptic.white_nearest"), best.name,
                                              steps, count, wanted)
                                : fmt::format(finding_text("plenoptic.white_exposed"), best.name,
                                              steps, count, wanted, joined(worse, ", "));
  return chosen;
}

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

ChosenWhite read_white(const fs::path& path, const RawPicture& raw) {
  try {
    if (fs::is_directory(path) || suffix_of(path) == ".tar" || is_storage_name(path)) {
      return choose(path, raw);
    }
    ChosenWhite chosen{read_raw(path).raw, {}};
    if (is_other_camera(raw.facts, chosen.picture.facts)) {
      throw InvalidInput(fmt::format(
          "this white picture is of another camera: it is of {}, the raw picture of {}; use one of "
          "this camera",
          chosen.picture.facts.serial, raw.facts.serial));
    }
    const RawFacts& facts = chosen.picture.facts;
    chosen.reason = facts.zoom_step
                        ? fmt::format(finding_text("plenoptic.white_steps"), chosen.picture.name,
                                      steps_text(facts), steps_text(raw.facts))
                        : fmt::format(finding_text("plenoptic.white"), chosen.picture.name);
    return chosen;
  } catch (const InvalidInput& error) {
    throw IoError(path, error.what());
  }
}

fs::path find_beside(const fs::path& raw, const std::string& kind) {
  const fs::path folder = raw.has_parent_path() ? raw.parent_path() : fs::path(".");
  const std::string own = lower_case(raw.stem().string()) + "_" + kind;
  std::vector<fs::path> named, plain, calibration;
  bool has_pictures = false;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (!entry.is_regular_file(error) || entry.path().filename() == raw.filename()) continue;
    const std::string name = lower_case(entry.path().filename().string());
    const std::string stem = lower_case(entry.path().stem().string());
    const std::string suffix = suffix_of(entry.path());
    const bool is_picture =
        io::is_image_name(entry.path()) || suffix == ".raw" || suffix == ".lfp" || suffix == ".lfr";
    if (is_picture && stem == own) named.push_back(entry.path());
    if (is_picture && stem == kind) plain.push_back(entry.path());
    if (kind != "white") continue;
    if (name.starts_with("caldata-") && suffix == ".tar") calibration.push_back(entry.path());
    has_pictures = has_pictures || is_storage_name(entry.path()) ||
                   (base_name(name).starts_with("MOD_") && suffix == ".raw");
  }
  for (auto* found : {&named, &plain, &calibration}) {
    if (!found->empty()) return *std::ranges::min_element(*found);
  }
  return has_pictures ? folder : fs::path();
}

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
