// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/plenoptic/white_pictures.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/numbers.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
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
#include <tuple>

namespace episcope::capture {
namespace {

namespace fs = std::filesystem;
using FileBytes = std::vector<std::uint8_t>;

/// Files of calibration data by name in upper case, read when they are needed.
using CalibrationFiles = std::map<std::string, std::function<FileBytes()>>;

/// "MOD_0007.RAW" of "C:\CALIB\mod_0007.raw" or "unit/MOD_0007.RAW".
std::string base_name(const std::string& path) {
  std::string name = path.substr(path.find_last_of("/\\") + 1);
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
  return lower_case(path.filename().string()).starts_with("data.c.");
}

CalibrationFiles calibration_files(const fs::path& path) {
  CalibrationFiles plain, stored;
  if (!fs::is_directory(path)) {
    if (suffix_of(path) == ".tar") return tar_files(path);
    add_stored(path, stored);
    return stored;
  }
  for (const auto& entry : fs::directory_iterator(path)) {
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
};

bool is_other_camera(const RawFacts& a, const RawFacts& b) {
  return !a.serial.empty() && !b.serial.empty() && a.serial != b.serial;
}

/// Index of the candidate with the nearest zoom and among these the nearest focus, as the raw
/// picture has them. Leaves out candidates of another serial number. Throws InvalidInput, which
/// names the serial numbers, if none is left.
std::size_t nearest_white(const RawFacts& raw, const std::vector<WhiteCandidate>& candidates) {
  using Rank = std::tuple<double, double>;
  const auto distance = [](const std::optional<double>& a, const std::optional<double>& b) {
    return a && b ? std::abs(*a - *b) : std::numeric_limits<double>::max();
  };
  std::optional<std::size_t> best;
  Rank least;
  std::string others;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const RawFacts& facts = candidates[k].facts;
    if (is_other_camera(raw, facts)) {
      if (others.find(facts.serial) == others.npos) {
        others += (others.empty() ? "" : ", ") + facts.serial;
      }
      continue;
    }
    const Rank rank(distance(raw.zoom_step, facts.zoom_step),
                    distance(raw.focus_step, facts.focus_step));
    if (!best || rank < least) {
      best = k;
      least = rank;
    }
  }
  if (best) return *best;
  throw InvalidInput(fmt::format(
      "all {} white pictures are of another camera: the raw picture is of {}, they are of {}; "
      "use the calibration data of this camera",
      candidates.size(), raw.serial, others));
}

ChosenWhite choose(const fs::path& path, const RawPicture& raw) {
  const CalibrationFiles files = calibration_files(path);
  std::vector<WhiteCandidate> candidates;
  for (const auto& [name, read] : files) {
    if (!name.starts_with("MOD_") || !name.ends_with(".RAW")) continue;
    const auto metadata = files.find(metadata_name(name));
    if (metadata == files.end()) continue;
    const FileBytes text = metadata->second();
    candidates.push_back({name, facts_from_json({text.begin(), text.end()})});
  }
  if (candidates.empty()) {
    throw IoError(path, "there is no white picture here: MOD_nnnn.RAW with its .TXT is expected");
  }
  const WhiteCandidate& best = candidates[nearest_white(raw.facts, candidates)];
  const FileBytes text = files.at(metadata_name(best.name))();
  ChosenWhite chosen;
  chosen.picture = raw_from_json(files.at(best.name)(), {text.begin(), text.end()}, {});
  chosen.picture.name = best.name;
  chosen.reason = fmt::format(finding_text("plenoptic.white_nearest"), best.name,
                              steps_text(best.facts), candidates.size(), steps_text(raw.facts));
  return chosen;
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
                   (name.starts_with("mod_") && suffix == ".raw");
  }
  for (auto* found : {&named, &plain, &calibration}) {
    if (!found->empty()) return *std::ranges::min_element(*found);
  }
  return has_pictures ? folder : fs::path();
}

}  // namespace episcope::capture
