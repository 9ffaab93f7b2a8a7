// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/plenoptic/raw_picture.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/core/text.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/json.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <boost/uuid/detail/sha1.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <initializer_list>
#include <iterator>

namespace episcope::capture {
namespace {

constexpr std::array<std::uint8_t, 16> kFileSignature{0x89, 'L', 'F', 'P', '\r', '\n', 0x1A, '\n',
                                                      0,    0,   0,   1,   0,    0,    0,    0};
constexpr std::array<std::uint8_t, 12> kTableSignature{0x89, 'L',  'F', 'M', '\r', '\n',
                                                       0x1A, '\n', 0,   0,   0,    0};
constexpr std::array<std::uint8_t, 12> kContentSignature{0x89, 'L',  'F', 'C', '\r', '\n',
                                                         0x1A, '\n', 0,   0,   0,    0};
constexpr std::size_t kLengthEnd = 16;
constexpr std::size_t kReferenceLength = 45;  // "sha1-" and 40 digits
constexpr std::size_t kSectionHeader = 96;    // of a section, with 35 zero bytes at its end
constexpr std::size_t kPadding = 16;
/// Larger than any picture of these cameras with its white picture.
constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 30;

template <std::size_t N>
bool begins_with(ByteView bytes, const std::array<std::uint8_t, N>& signature,
                 std::size_t length = N) {
  return bytes.size() >= length &&
         std::equal(signature.begin(), signature.begin() + length, bytes.begin());
}

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path) {
  io::require_openable_file(path);
  if (std::filesystem::file_size(path) > kLargestFile) {
    throw IoError(path, fmt::format("this file has more than {} MiB, which no picture of a Lytro "
                                    "camera has; choose another",
                                    kLargestFile >> 20));
  }
  const io::FileDescriptor file(path, O_RDONLY);
  std::vector<std::uint8_t> bytes;
  if (!file.ok() || !io::read_all(file.id(), bytes)) {
    throw IoError(path, "it cannot be read; check its permissions and the disk");
  }
  return bytes;
}

std::size_t length_of(ByteView header) {
  std::size_t length = 0;
  for (int i = 12; i < 16; ++i) length = length << 8 | header[i];
  return length;
}

[[noreturn]] void refuse(const std::filesystem::path& path, std::size_t section,
                         const std::string& what) {
  throw IoError(path, fmt::format("section {} of this container {}; copy the file from the camera "
                                  "again",
                                  section + 1, what));
}

/// Reads the section at the beginning of `rest` and cuts it off, with its padding.
LfpSection take_section(const std::filesystem::path& path, std::size_t number, ByteView& rest) {
  if (rest.size() < kSectionHeader) refuse(path, number, "is cut off in its header");
  LfpSection section;
  section.is_table = begins_with(rest, kTableSignature, 4);
  if (!section.is_table && !begins_with(rest, kContentSignature, 4)) {
    refuse(path, number, "does not begin with its signature");
  }
  const std::size_t length = length_of(rest);
  section.reference.assign(rest.begin() + kLengthEnd, rest.begin() + kLengthEnd + kReferenceLength);
  if (length == 0) section.reference.clear();  // an empty section has no hash
  if (length > rest.size() - kSectionHeader) {
    refuse(path, number,
           fmt::format("claims {} bytes, but {} follow: the file is cut off", length,
                       rest.size() - kSectionHeader));
  }
  const ByteView data = rest.subspan(kSectionHeader, length);
  if (length != 0 && lfp_reference(data) != section.reference) {
    refuse(path, number, "does not match its hash: its data were damaged");
  }
  section.data.assign(data.begin(), data.end());
  const std::size_t padded = round_up(kSectionHeader + length, kPadding);
  rest = rest.subspan(std::min(padded, rest.size()));
  return section;
}

void append(std::vector<std::uint8_t>& bytes, ByteView more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

namespace fs = std::filesystem;
using Metadata = nlohmann::json;

constexpr int kLargestSide = 32768;  // px; larger sizes are damaged metadata
constexpr int kSmallestSide = 16;

/// The value at the end of a path of keys and indices; null if it is not there.
const Metadata* at(const Metadata& json, std::initializer_list<const char*> path) {
  const Metadata* here = &json;
  for (const char* key : path) {
    if (here->is_array()) {
      if (here->empty()) return nullptr;
      here = &here->front();  // of a list of frames, the first
    }
    if (!here->is_object()) return nullptr;
    const auto found = here->find(key);
    if (found == here->end()) return nullptr;
    here = &*found;
  }
  return here;
}

std::optional<double> number_at(const Metadata& json, std::initializer_list<const char*> path) {
  const Metadata* value = at(json, path);
  if (!value || !value->is_number()) return {};
  return value->get<double>();
}

std::string text_at(const Metadata& json, std::initializer_list<const char*> path) {
  const Metadata* value = at(json, path);
  return value && value->is_string() ? value->get<std::string>() : std::string();
}

std::optional<double> scaled(std::optional<double> value, double factor) {
  return value ? std::optional(*value * factor) : std::nullopt;
}

RawFacts facts_of(const Metadata& json) {
  RawFacts facts;
  facts.model = text_at(json, {"camera", "model"});
  facts.serial = text_at(json, {"camera", "serialNumber"});
  facts.time = text_at(json, {"devices", "clock", "zuluTime"});
  facts.zoom_step = number_at(json, {"devices", "lens", "zoomStep"});
  facts.focus_step = number_at(json, {"devices", "lens", "focusStep"});
  facts.exposure_s = number_at(json, {"devices", "shutter", "frameExposureDuration"});
  facts.iso = number_at(json, {"devices", "sensor", "iso"});
  facts.f_number = number_at(json, {"devices", "lens", "fNumber"});
  facts.focal_length_mm = scaled(number_at(json, {"devices", "lens", "focalLength"}), 1e3);
  facts.pixel_pitch_um = scaled(number_at(json, {"devices", "sensor", "pixelPitch"}), 1e6);
  facts.lens_pitch_um = scaled(number_at(json, {"devices", "mla", "lensPitch"}), 1e6);
  return facts;
}

/// The part of the JSON that says how samples are stored: of the first generation it lies deeper.
const Metadata& details_of(const Metadata& json) {
  if (const Metadata* details = at(json, {"image", "rawDetails"})) return *details;
  if (const Metadata* image = at(json, {"image"})) return *image;
  throw InvalidInput("the metadata lack 'image', which tells how samples are stored");
}

int side_of(const Metadata& json, const char* key) {
  const auto side = number_at(json, {"image", key});
  const auto whole = side ? whole_int(*side) : std::nullopt;
  if (!whole || *whole < kSmallestSide || *whole > kLargestSide) {
    throw InvalidInput(fmt::format("the metadata have no image {} between {} and {} px", key,
                                   kSmallestSide, kLargestSide));
  }
  return *whole;
}

Packing packing_of(const Metadata& details) {
  const auto bits = number_at(details, {"pixelPacking", "bitsPerPixel"});
  if (bits == 12) return Packing::Bits12;
  if (bits == 10) return Packing::Bits10;
  if (bits == 16) return Packing::Bits16;
  throw InvalidInput(fmt::format("samples of {} bits are not read; 10, 12 and 16 are",
                                 bits ? fmt::format("{}", *bits) : std::string("unknown")));
}

Mosaic mosaic_of(const Metadata& details) {
  const std::string first = text_at(details, {"mosaic", "upperLeftPixel"});
  if (first == "b") return Mosaic::Bggr;
  if (first == "gr") return Mosaic::Grbg;
  if (first == "gb") return Mosaic::Gbrg;
  if (first == "r") return Mosaic::Rggb;
  throw InvalidInput("the metadata do not tell the color of the upper left pixel");
}

double full_scale(Packing packing) {
  return packing == Packing::Bits12 ? 4095 : packing == Packing::Bits10 ? 1023 : 65535;
}

RawColors colors_of(const Metadata& json) {
  RawColors colors;
  const Metadata* gains = at(json, {"image", "color", "whiteBalanceGain"});
  if (!gains) gains = at(json, {"algorithms", "awb", "computed", "gain"});
  colors.is_balanced = gains != nullptr;
  const char* keys[] = {"r", "gr", "b"};
  for (int c = 0; gains && c < 3; ++c) {
    const double gain = number_at(*gains, {keys[c]}).value_or(1);
    if (gain > 1e-3 && gain < 1e3) colors.balance[c] = gain;
  }
  const Metadata* matrix = at(json, {"image", "color", "ccmRgbToSrgbArray"});
  if (!matrix) matrix = at(json, {"image", "color", "ccm"});
  if (matrix && matrix->is_array() && matrix->size() == colors.to_srgb.size() &&
      std::ranges::all_of(*matrix, [](const Metadata& v) { return v.is_number(); })) {
    std::ranges::transform(*matrix, colors.to_srgb.begin(),
                           [](const Metadata& v) { return v.get<double>(); });
  }
  auto gamma = number_at(json, {"image", "color", "gamma"});
  if (!gamma) {
    gamma = number_at(
        json, {"master", "picture", "frameArray", "frame", "metadata", "image", "color", "gamma"});
  }
  if (gamma && *gamma > 0.1 && *gamma <= 1) colors.gamma = *gamma;
  return colors;
}

Metadata parse_metadata(const std::string& text, const char* what) {
  try {
    return io::parse_json<Metadata>(text);
  } catch (const Metadata::exception&) {
    throw InvalidInput(fmt::format("the {} of this picture cannot be read as JSON", what));
  }
}

/// What the camera says of the picture. Calibration data wrap it, with the private metadata.
Metadata frame_of(const std::string& metadata, const std::string& private_metadata) {
  Metadata json = parse_metadata(metadata, "metadata");
  Metadata hidden;
  if (!private_metadata.empty()) hidden = parse_metadata(private_metadata, "private metadata");
  if (const Metadata* frame = at(json, {"master", "picture", "frameArray", "frame"});
      frame && !at(json, {"image"})) {
    if (const Metadata* part = at(*frame, {"privateMetadata"})) hidden = *part;
    if (const Metadata* part = at(*frame, {"metadata"})) json = Metadata(*part);
  }
  const std::string serial = text_at(hidden, {"camera", "serialNumber"});
  if (serial.empty() || !json.is_object()) return json;
  Metadata& camera = json["camera"];
  if (!camera.is_object()) camera = Metadata::object();
  camera["serialNumber"] = serial;
  return json;
}

std::vector<std::uint8_t> bytes_of(const fs::path& path) {
  io::require_openable_file(path);
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The JSON beside a bare .raw.
fs::path metadata_beside(const fs::path& path) {
  for (const char* end : {".txt", ".TXT", ".json", ".JSON", "_metadata.json"}) {
    fs::path beside = path;
    beside.replace_filename(path.stem().string() + end);
    std::error_code error;
    if (fs::is_regular_file(beside, error)) return beside;
  }
  throw IoError(path,
                "a bare .raw needs the JSON of the camera beside it, of the same name with "
                ".txt or .json; copy it there");
}

std::string text_of(const fs::path& path) {
  if (fs::file_size(path) > io::kLargestJson) {
    throw IoError(path, "this is too large for the JSON of a camera; choose another file");
  }
  const std::vector<std::uint8_t> bytes = bytes_of(path);
  return {bytes.begin(), bytes.end()};
}

struct FrameReferences {
  std::string image;
  std::string metadata;
  std::string private_metadata;
  std::string modulation;
};

FrameReferences references_of(const LfpContainer& container) {
  const auto table = std::ranges::find(container.sections, true, &LfpSection::is_table);
  if (table == container.sections.end()) throw InvalidInput("this container has no table");
  const Metadata json = parse_metadata(table->text(), "table");
  const Metadata* frame = at(json, {"frames", "frame"});
  if (!frame) frame = at(json, {"picture", "frameArray", "frame"});
  if (!frame) throw InvalidInput("the table of this container names no frame");
  return {text_at(*frame, {"imageRef"}), text_at(*frame, {"metadataRef"}),
          text_at(*frame, {"privateMetadataRef"}), text_at(*frame, {"modulationDataRef"})};
}

RawFile raw_in(const LfpContainer& container) {
  if (!holds_raw(container)) {
    throw InvalidInput(
        "this container holds a processed picture, without what the sensor saw; "
        "choose the raw one, as the camera wrote it");
  }
  const FrameReferences frame = references_of(container);
  const LfpSection* image = container.find(frame.image);
  const LfpSection* metadata = container.find(frame.metadata);
  const LfpSection* hidden = container.find(frame.private_metadata);
  const std::string private_text = hidden ? hidden->text() : std::string();
  RawFile file{raw_from_json(image->data, metadata->text(), private_text)};
  if (const LfpSection* white = container.find(frame.modulation)) {
    file.white = raw_from_json(white->data, metadata->text(), private_text);
  }
  return file;
}

/// A picture of one channel; of three equal ones, the first is not enough: they may be demosaiced.
RawPicture raw_of(const fs::path& path) {
  RawPicture raw;
  std::visit(
      [&]<class T>(const Image<T>& image) {
        if (image.channels() != 1) {
          throw IoError(path, fmt::format("a raw picture has one channel, but this has {}; use the "
                                          "picture of the sensor before demosaicing",
                                          image.channels()));
        }
        if constexpr (std::is_floating_point_v<T>) {
          throw IoError(path,
                        "a raw picture has whole numbers of 8 to 16 bits, not floats; "
                        "convert it");
        } else {
          raw.samples = Image<std::uint16_t>(image.height(), image.width());
          std::copy(image.begin(), image.end(), raw.samples.begin());
          raw.white = std::numeric_limits<T>::max();
        }
      },
      io::decode_image(path));
  return raw;
}

void pack_pair(const std::uint16_t* s, std::vector<std::uint8_t>& bytes) {
  bytes.push_back(static_cast<std::uint8_t>(s[0] >> 4));
  bytes.push_back(static_cast<std::uint8_t>((s[0] & 15) << 4 | s[1] >> 8));
  bytes.push_back(static_cast<std::uint8_t>(s[1]));
}

void pack_four(const std::uint16_t* s, std::vector<std::uint8_t>& bytes) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(s[i] >> 2));
  bytes.push_back(
      static_cast<std::uint8_t>((s[0] & 3) | (s[1] & 3) << 2 | (s[2] & 3) << 4 | (s[3] & 3) << 6));
}

std::size_t packed_size(Packing packing, std::size_t samples) {
  if (packing == Packing::Bits12) return samples / 2 * 3;
  if (packing == Packing::Bits10) return samples / 4 * 5;
  return samples * 2;
}

Metadata common_metadata(const RawPicture& raw) {
  const RawFacts& facts = raw.facts;
  Metadata json;
  json["camera"] = {{"make", "Episcope"}, {"model", facts.model}, {"serialNumber", facts.serial}};
  json["image"] = {{"width", raw.samples.width()}, {"height", raw.samples.height()}};
  json["devices"]["lens"] = {{"zoomStep", facts.zoom_step.value_or(0)},
                             {"focusStep", facts.focus_step.value_or(0)},
                             {"fNumber", facts.f_number.value_or(2)}};
  json["devices"]["shutter"]["frameExposureDuration"] = facts.exposure_s.value_or(0.01);
  json["devices"]["sensor"] = {{"iso", facts.iso.value_or(100)},
                               {"pixelPitch", facts.pixel_pitch_um.value_or(1.4) * 1e-6}};
  json["devices"]["mla"]["lensPitch"] = facts.lens_pitch_um.value_or(14) * 1e-6;
  return json;
}

Metadata levels(double level) {
  return {{"r", level}, {"gr", level}, {"gb", level}, {"b", level}};
}

Metadata gains(const RawColors& colors) {
  const auto& b = colors.balance;
  return {{"r", b[0]}, {"gr", b[1]}, {"gb", b[1]}, {"b", b[2]}};
}

}  // namespace

const LfpSection* LfpContainer::find(const std::string& reference) const {
  const auto found = std::ranges::find(sections, reference, &LfpSection::reference);
  return found == sections.end() || reference.empty() ? nullptr : &*found;
}

bool is_lfp_container(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;  // opening a pipe would wait
  const io::FileDescriptor file(path, O_RDONLY);
  std::array<std::uint8_t, 8> bytes{};
  return file.ok() && io::read_all_at(file.id(), bytes, 0) &&
         begins_with(ByteView(bytes), kFileSignature, 8);
}

LfpContainer read_lfp(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = read_bytes(path);
  if (!begins_with(ByteView(bytes), kFileSignature, 8)) {
    throw IoError(path, "this is no container of a Lytro camera (.lfp, .lfr); choose another file");
  }
  if (bytes.size() < kFileSignature.size()) refuse(path, 0, "is missing");
  LfpContainer container;
  ByteView rest = ByteView(bytes).subspan(kFileSignature.size());
  while (!rest.empty()) {
    container.sections.push_back(take_section(path, container.sections.size(), rest));
  }
  if (container.sections.empty()) refuse(path, 0, "is missing");
  return container;
}

std::string lfp_reference(ByteView data) {
  boost::uuids::detail::sha1 hash;
  hash.process_bytes(data.data(), data.size());
  boost::uuids::detail::sha1::digest_type digest;
  hash.get_digest(digest);
  std::string text = "sha1-";
  for (const auto word : digest) text += fmt::format("{:08x}", word);
  return text;
}

void write_lfp(const std::filesystem::path& path, const LfpContainer& container) {
  std::vector<std::uint8_t> bytes(kFileSignature.begin(), kFileSignature.end());
  for (const LfpSection& section : container.sections) {
    append(bytes, section.is_table ? ByteView(kTableSignature) : ByteView(kContentSignature));
    const std::size_t length = section.data.size();
    for (int shift = 24; shift >= 0; shift -= 8) {
      bytes.push_back(static_cast<std::uint8_t>(length >> shift));
    }
    const std::string reference = lfp_reference(section.data);
    bytes.insert(bytes.end(), reference.begin(), reference.end());
    bytes.resize(bytes.size() + kSectionHeader - kLengthEnd - kReferenceLength);
    append(bytes, section.data);
    bytes.resize(round_up(bytes.size(), kPadding));
  }
  io::write_atomically(path, bytes);
}

Names<Mosaic> names_of(Mosaic) {
  return {{Mosaic::Gray, "gray"},
          {Mosaic::Rggb, "rggb"},
          {Mosaic::Grbg, "grbg"},
          {Mosaic::Gbrg, "gbrg"},
          {Mosaic::Bggr, "bggr"}};
}

int color_at(Mosaic mosaic, int y, int x) {
  static constexpr int kColors[][4] = {
      {0, 0, 0, 0}, {0, 1, 1, 2}, {1, 0, 2, 1}, {1, 2, 0, 1}, {2, 1, 1, 0}};
  return kColors[static_cast<int>(mosaic)][(y & 1) * 2 + (x & 1)];
}

std::vector<std::pair<std::string, std::string>> RawFacts::table() const {
  std::vector<std::pair<std::string, std::string>> rows;
  const auto add_text = [&](const char* key, const std::string& text) {
    if (!text.empty()) rows.emplace_back(key, text);
  };
  const auto add = [&](const char* key, const std::optional<double>& value, const char* unit) {
    if (value) rows.emplace_back(key, fmt::format("{:.6g}{}", *value, unit));
  };
  add_text("model", model);
  add_text("serial", serial);
  add_text("time", time);
  add("zoom step", zoom_step, "");
  add("focus step", focus_step, "");
  add("exposure", exposure_s, " s");
  add("ISO", iso, "");
  add("f-number", f_number, "");
  add("focal length", focal_length_mm, " mm");
  add("pixel pitch", pixel_pitch_um, " µm");
  add("lens pitch", lens_pitch_um, " µm");
  return rows;
}

double light_level(const RawPicture& picture) {
  std::vector<std::uint16_t> samples(picture.samples.begin(), picture.samples.end());
  const auto level = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() * 9 / 10);
  std::ranges::nth_element(samples, level);
  return (*level - picture.black) / (picture.white - picture.black);
}

double saturated_share(const RawPicture& picture) {
  const auto saturated = std::ranges::count_if(
      picture.samples, [&](std::uint16_t sample) { return sample >= picture.white; });
  return static_cast<double>(saturated) / static_cast<double>(picture.samples.size());
}

Image<std::uint16_t> unpack(ByteView bytes, Packing packing, int height, int width) {
  const std::size_t count = static_cast<std::size_t>(height) * width;
  const std::size_t needed = packed_size(packing, count);
  if (bytes.size() != needed || count % 4 != 0) {
    throw InvalidInput(fmt::format("{}×{} px take {} bytes, but there are {}", width, height,
                                   needed, bytes.size()));
  }
  Image<std::uint16_t> image(height, width);
  std::uint16_t* out = image.data();
  const std::uint8_t* in = bytes.data();
  if (packing == Packing::Bits12) {
    for (std::size_t i = 0; i < count; i += 2, in += 3) {
      out[i] = static_cast<std::uint16_t>(in[0] << 4 | in[1] >> 4);
      out[i + 1] = static_cast<std::uint16_t>((in[1] & 15) << 8 | in[2]);
    }
  } else if (packing == Packing::Bits10) {
    for (std::size_t i = 0; i < count; i += 4, in += 5) {
      for (int k = 0; k < 4; ++k) {
        out[i + k] = static_cast<std::uint16_t>(in[k] << 2 | (in[4] >> 2 * k & 3));
      }
    }
  } else {
    for (std::size_t i = 0; i < count; ++i, in += 2) {
      out[i] = static_cast<std::uint16_t>(in[0] | in[1] << 8);
    }
  }
  return image;
}

std::vector<std::uint8_t> pack(const Image<std::uint16_t>& samples, Packing packing) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(packed_size(packing, samples.size()));
  const std::uint16_t* s = samples.data();
  const std::uint16_t* end = s + samples.size();
  if (packing == Packing::Bits12) {
    for (; s + 1 < end; s += 2) pack_pair(s, bytes);
  } else if (packing == Packing::Bits10) {
    for (; s + 3 < end; s += 4) pack_four(s, bytes);
  } else {
    for (; s < end; ++s) {
      bytes.push_back(static_cast<std::uint8_t>(*s));
      bytes.push_back(static_cast<std::uint8_t>(*s >> 8));
    }
  }
  return bytes;
}

RawPicture raw_from_json(ByteView samples, const std::string& metadata,
                         const std::string& private_metadata) {
  const Metadata json = frame_of(metadata, private_metadata);
  const Metadata& details = details_of(json);
  const Packing packing = packing_of(details);
  RawPicture raw;
  raw.facts = facts_of(json);
  raw.mosaic = mosaic_of(details);
  raw.colors = colors_of(json);
  raw.black = number_at(details, {"pixelFormat", "black", "gr"}).value_or(0);
  raw.white = number_at(details, {"pixelFormat", "white", "gr"}).value_or(full_scale(packing));
  if (raw.black < 0 || raw.white <= raw.black || raw.white > 65535) {
    throw InvalidInput(
        fmt::format("levels of black, {}, and white, {}, make no picture", raw.black, raw.white));
  }
  raw.samples = unpack(samples, packing, side_of(json, "height"), side_of(json, "width"));
  return raw;
}

bool holds_raw(const LfpContainer& container) {
  const FrameReferences frame = references_of(container);
  return container.find(frame.image) && container.find(frame.metadata);
}

RawFacts facts_from_json(const std::string& metadata) {
  return facts_of(frame_of(metadata, {}));
}

RawFile read_raw(const fs::path& path) {
  io::require_openable_file(path);
  RawFile file;
  try {
    const std::string suffix = suffix_of(path);
    if (is_lfp_container(path) || suffix == ".lfp" || suffix == ".lfr") {
      file = raw_in(read_lfp(path));  // which says what is wrong with another file
    } else if (suffix == ".raw") {
      const std::string metadata = text_of(metadata_beside(path));
      file.raw = raw_from_json(bytes_of(path), metadata, {});
    } else {
      file.raw = raw_of(path);
    }
  } catch (const InvalidInput& error) {
    throw IoError(path, error.what());
  }
  file.raw.name = path.filename().string();
  file.raw.source = path.string();
  if (file.white) file.white->name = file.raw.name + " (its own white picture)";
  return file;
}

std::string f01_metadata(const RawPicture& raw) {
  Metadata json = common_metadata(raw);
  Metadata& details = json["image"]["rawDetails"];
  details["pixelFormat"] = {
      {"rightShift", 0}, {"black", levels(raw.black)}, {"white", levels(raw.white)}};
  details["pixelPacking"] = {{"endianness", "big"}, {"bitsPerPixel", 12}};
  details["mosaic"] = {{"tile", "r,gr:gb,b"}, {"upperLeftPixel", "b"}};
  json["image"]["color"] = {{"ccmRgbToSrgbArray", raw.colors.to_srgb},
                            {"gamma", raw.colors.gamma},
                            {"whiteBalanceGain", gains(raw.colors)}};
  return io::json_text(json, 2);
}

std::string calibration_metadata(const RawPicture& raw) {
  Metadata frame;
  frame["metadata"] = io::parse_json<Metadata>(f01_metadata(raw));
  frame["privateMetadata"]["camera"]["serialNumber"] = raw.facts.serial;
  frame["metadata"]["camera"].erase("serialNumber");
  Metadata json;
  json["master"]["picture"]["frameArray"] = {{{"frame", std::move(frame)}}};
  return io::json_text(json, 2);
}

std::string illum_metadata(const RawPicture& raw) {
  Metadata json = common_metadata(raw);
  Metadata& image = json["image"];
  image["pixelFormat"] = {
      {"rightShift", 0}, {"black", levels(raw.black)}, {"white", levels(raw.white)}};
  image["pixelPacking"] = {{"endianness", "little"}, {"bitsPerPixel", 10}};
  image["mosaic"] = {{"tile", "r,gr:gb,b"}, {"upperLeftPixel", "gr"}};
  image["color"] = {{"ccm", raw.colors.to_srgb}, {"gamma", raw.colors.gamma}};
  json["algorithms"]["awb"]["computed"]["gain"] = gains(raw.colors);
  return io::json_text(json, 2);
}

}  // namespace episcope::capture
