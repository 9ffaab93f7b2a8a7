// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace episcope::io {

/// Bytes of a file; what lies behind its end reads as 0 and is remembered.
class FileBytes {
 public:
  explicit FileBytes(const std::filesystem::path& path) : in_(path, std::ios::binary) {}

  [[nodiscard]] std::uint32_t number(std::streamoff at, int count, bool is_little_endian) {
    std::array<unsigned char, 4> bytes{};
    in_.clear();
    in_.seekg(at);
    in_.read(reinterpret_cast<char*>(bytes.data()), count);
    if (!in_) is_short_ = true;
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i) {
      const int place = is_little_endian ? count - 1 - i : i;
      value = value << 8 | bytes[static_cast<std::size_t>(place)];
    }
    return value;
  }
  [[nodiscard]] bool begins_with(std::string_view signature) {
    for (std::size_t i = 0; i < signature.size(); ++i) {
      const auto expected = static_cast<unsigned char>(signature[i]);
      if (number(static_cast<std::streamoff>(i), 1, true) != expected) return false;
    }
    return true;
  }
  [[nodiscard]] std::istream& at(std::streamoff place) {
    in_.clear();
    in_.seekg(place);
    return in_;
  }
  [[nodiscard]] bool is_short() const { return is_short_; }

 private:
  std::ifstream in_;
  bool is_short_ = false;
};

}  // namespace episcope::io
