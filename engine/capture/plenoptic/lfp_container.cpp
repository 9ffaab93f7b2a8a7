// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/plenoptic/lfp_container.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"

#include <fmt/format.h>
#include <boost/uuid/detail/sha1.hpp>

#include <fcntl.h>
#include <algorithm>
#include <array>
#include <cstddef>

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

}  // namespace episcope::capture
