// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/npy_header.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <charconv>
#include <optional>

namespace episcope::io {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kAlignment = 64;
constexpr std::size_t kMostAxes = 32;

struct TypeCode {
  const char* code;
  NumberType type;
};
constexpr TypeCode kCodes[] = {
    {"b1", NumberType::Bool},    {"i1", NumberType::Int8},    {"u1", NumberType::UInt8},
    {"i2", NumberType::Int16},   {"u2", NumberType::UInt16},  {"i4", NumberType::Int32},
    {"u4", NumberType::UInt32},  {"i8", NumberType::Int64},   {"u8", NumberType::UInt64},
    {"f2", NumberType::Float16}, {"f4", NumberType::Float32}, {"f8", NumberType::Float64}};

/// What follows `'key':` in the dictionary; empty if there is no such key.
std::string_view value_of(std::string_view text, std::string_view key) {
  for (const char quote : {'\'', '"'}) {
    const std::string quoted = fmt::format("{0}{1}{0}", quote, key);
    const std::size_t at = text.find(quoted);
    if (at == std::string_view::npos) continue;
    std::string_view rest = text.substr(at + quoted.size());
    const std::size_t value = rest.find_first_not_of(" :");
    return value == std::string_view::npos ? std::string_view() : rest.substr(value);
  }
  return {};
}

/// "(9, 9, 512, 512, 3)", "(5,)", "()"; also with the L of Python 2.
std::optional<ArrayShape> parse_shape(std::string_view text) {
  if (text.empty() || text.front() != '(') return std::nullopt;
  text.remove_prefix(1);
  ArrayShape shape;
  for (;;) {
    text.remove_prefix(std::min(text.size(), text.find_first_not_of(" ,L")));
    if (text.empty()) return std::nullopt;
    if (text.front() == ')') return shape;
    std::size_t length = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), length);
    if (error != std::errc() || shape.size() == kMostAxes) return std::nullopt;
    shape.push_back(length);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
}

void parse_type(const std::filesystem::path& path, std::string_view text, NpyHeader& header) {
  const auto refused = [&](const std::string& kind) {
    return IoError(path, "the array holds " + kind +
                             ", but numbers are expected; save it as an array of numbers");
  };
  if (text.empty()) throw IoError(path, "the .npy header lacks the key descr; save it again");
  if (text.front() == '[') throw refused("records (a structured type)");
  if (text.front() != '\'' && text.front() != '"') throw refused("an unknown type");
  const std::size_t end = text.find(text.front(), 1);
  if (end == std::string_view::npos || end < 2) throw refused("an unknown type");
  std::string code(text.substr(1, end - 1));
  if (std::string_view("<>|=").find(code.front()) != std::string_view::npos) {
    header.is_big_endian = code.front() == '>';
    code.erase(0, 1);
  }
  if (!code.empty() && code.front() == 'O') throw refused("pickled Python objects");
  for (const TypeCode& known : kCodes) {
    if (code != known.code) continue;
    header.type = known.type;
    return;
  }
  if (!code.empty() && code.front() == 'c') throw refused("complex numbers (" + code + ")");
  throw refused("elements of the type " + code.substr(0, 20));
}

}  // namespace

bool has_npy_magic(std::string_view begin) {
  return begin.substr(0, kMagic.size()) == kMagic;
}

NpyHeader parse_npy_header(const std::filesystem::path& path, std::string_view begin) {
  if (!has_npy_magic(begin)) {
    throw IoError(path, "this is not an .npy file, despite its name; choose another file");
  }
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(begin[at]); };
  if (begin.size() < kNpyPrefix) {
    throw IoError(path, fmt::format("the .npy file is truncated: {} bytes are present; copy it "
                                    "again",
                                    begin.size()));
  }
  const int version = byte(6);
  if (version < 1 || version > 3) {
    throw IoError(path, fmt::format("the .npy file has version {}, but 1, 2 or 3 is expected; save "
                                    "it again with numpy.save",
                                    version));
  }
  const std::size_t lead = version == 1 ? 10 : 12;
  std::size_t length = byte(8) | std::size_t{byte(9)} << 8;
  if (version > 1) length |= std::size_t{byte(10)} << 16 | std::size_t{byte(11)} << 24;
  if (length > kLongestNpyHeader || lead + length > begin.size()) {
    throw IoError(path, fmt::format("the .npy header should be {} bytes long, which the file does "
                                    "not hold; it is truncated or damaged: copy it again",
                                    length));
  }
  const std::string_view text = begin.substr(lead, length);
  NpyHeader header;
  header.bytes = lead + length;
  parse_type(path, value_of(text, "descr"), header);
  header.is_fortran = value_of(text, "fortran_order").starts_with("True");
  const std::optional<ArrayShape> shape = parse_shape(value_of(text, "shape"));
  if (!shape) {
    throw IoError(path, "the .npy header states no valid shape; save the array again");
  }
  header.shape = *shape;
  return header;
}

std::string npy_header(const ArrayShape& shape, NumberType type) {
  std::string code;
  for (const TypeCode& known : kCodes) {
    if (known.type != type) continue;
    code = fmt::format("{}{}", byte_size(type) == 1 ? "|" : "<", known.code);
  }
  std::string lengths;
  for (const std::size_t length : shape) lengths += std::to_string(length) + ", ";
  if (shape.size() > 1) lengths.resize(lengths.size() - 2);
  std::string text =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", code, lengths);
  const std::size_t lead = 10;
  text.resize((lead + text.size() + kAlignment) / kAlignment * kAlignment - lead, ' ');
  text.back() = '\n';
  std::string header(kMagic);
  for (const std::size_t part :
       {std::size_t{1}, std::size_t{0}, text.size() & 255, text.size() >> 8}) {
    header += static_cast<char>(part);
  }
  return header + text;
}

}  // namespace episcope::io
