// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/io/formats/described_tiff.h"

#include <cstddef>
#include <fstream>
#include <iterator>

namespace episcope::test {
namespace {

std::size_t little(const std::string& bytes, std::size_t at, std::size_t count) {
  std::size_t number = 0;
  for (std::size_t i = count; i-- > 0;) {
    number = number << 8 | static_cast<unsigned char>(bytes.at(at + i));
  }
  return number;
}

std::string little(std::size_t number, std::size_t count) {
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i) bytes += static_cast<char>(number >> (8 * i));
  return bytes;
}

}  // namespace

void describe_tiff(const std::filesystem::path& path, const std::string& text) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  constexpr std::size_t kDescription = 270;
  const std::size_t directory = little(bytes, 4, 4);
  const std::size_t entries = little(bytes, directory, 2);
  const std::string of_text =
      little(kDescription, 2) + little(2, 2) + little(text.size() + 1, 4) + little(bytes.size(), 4);
  std::string written = little(entries + 1, 2);
  bool is_placed = false;
  for (std::size_t i = 0; i < entries; ++i) {
    const std::string entry = bytes.substr(directory + 2 + 12 * i, 12);
    if (!is_placed && little(entry, 0, 2) > kDescription) {
      written += of_text;
      is_placed = true;
    }
    written += entry;
  }
  written += bytes.substr(directory + 2 + 12 * entries, 4);
  bytes += text + std::string(1 + text.size() % 2, '\0');
  bytes.replace(4, 4, little(bytes.size() + bytes.size() % 2, 4));
  bytes.resize(bytes.size() + bytes.size() % 2);
  std::ofstream(path, std::ios::binary) << bytes + written;
}

}  // namespace episcope::test
