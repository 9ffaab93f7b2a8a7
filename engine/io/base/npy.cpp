// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/npy.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/io/base/atomic_file.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <bit>
#include <charconv>
#include <optional>
#include <vector>

namespace episcope::io {
namespace {

static_assert(std::endian::native == std::endian::little);

/// No header of an array of numbers is longer.
constexpr std::size_t kLongestNpyHeader = 65536;
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

/// Parses the header at the front of a file, which `begin` holds. Nothing in it is evaluated:
/// objects, records and text are refused. Throws IoError that names `path`.
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

}  // namespace

bool has_npy_magic(std::string_view begin) {
  return begin.substr(0, kMagic.size()) == kMagic;
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

namespace {

/// Height and width: the lengths other than 1, or the last two.
ArrayShape map_size(const ArrayInput& array) {
  ArrayShape size;
  for (const std::size_t length : array.shape()) {
    if (length != 1) size.push_back(length);
  }
  while (size.size() < 2 && array.shape().size() >= 2) size.insert(size.begin(), 1);
  const bool is_map =
      size.size() == 2 && size[0] > 0 && size[1] > 0 && size[0] <= 1 << 20 && size[1] <= 1 << 20;
  if (is_map) return size;
  throw IoError(array.path(), fmt::format("the array has the shape {}, but a map has height × "
                                          "width; save one map alone",
                                          shape_text(array.shape())));
}

template <class T>
Image<T> read_image(const ArrayInput& array, bool is_transposed) {
  const ArrayShape size = map_size(array);
  Image<T> image(static_cast<int>(size[0]), static_cast<int>(size[1]));
  array.read(ArrayShape(array.shape().size(), 0), array.shape(), image.data());
  return is_transposed ? transposed(image) : image;
}

}  // namespace

ArrayShape stored_shape(const NpyHeader& header) {
  ArrayShape shape = header.shape;
  if (header.is_fortran) std::ranges::reverse(shape);
  return shape;
}

NpyFile::Place NpyFile::find(const std::filesystem::path& path, std::uint64_t offset,
                             std::uint64_t bytes) {
  require_readable_file(path);
  Place place{FileDescriptor(path, O_RDONLY), 0, {}};
  if (!place.file.ok()) throw IoError(path, "the file cannot be opened; check its permissions");
  const std::uint64_t size = std::filesystem::file_size(path);
  const std::uint64_t held = std::min(bytes, size - std::min(offset, size));
  std::vector<std::uint8_t> begin(std::min<std::size_t>(held, kLongestNpyHeader + kNpyPrefix));
  if (!read_all_at(place.file.id(), begin, offset)) begin.clear();
  place.header =
      parse_npy_header(path, {reinterpret_cast<const char*>(begin.data()), begin.size()});
  const std::size_t elements = element_count(place.header.shape);
  const std::size_t width = byte_size(place.header.type);
  if (elements > (held - place.header.bytes) / width) {
    throw IoError(path, fmt::format("the .npy header states {} {} samples, but the file ends after "
                                    "{} of them; copy or save it again",
                                    shape_text(place.header.shape), number_name(place.header.type),
                                    (held - place.header.bytes) / width));
  }
  place.offset = offset + place.header.bytes;
  return place;
}

NpyFile::NpyFile(const std::filesystem::path& path, std::uint64_t offset, std::uint64_t bytes)
    : NpyFile(path, find(path, offset, bytes)) {}

NpyFile::NpyFile(const std::filesystem::path& path, Place place)
    : LinearArray(path, stored_shape(place.header), place.header.type),
      file_(std::move(place.file)),
      samples_begin_(place.offset),
      header_(std::move(place.header)) {}

void NpyFile::read_elements(std::size_t first, std::size_t count, std::uint8_t* out) const {
  const std::size_t width = byte_size(type());
  if (!read_all_at(file_.id(), {out, count * width}, samples_begin_ + first * width)) {
    throw IoError(path(), "the file cannot be read to its end; copy it again or check the disk");
  }
  if (header_.is_big_endian) swap_bytes(type(), count, out);
}

Image<float> read_map(const ArrayInput& array, bool is_transposed) {
  return read_image<float>(array, is_transposed);
}

Image<std::int32_t> read_label_map(const ArrayInput& array, bool is_transposed) {
  if (!is_float(array.type())) return read_image<std::int32_t>(array, is_transposed);
  const Image<float> numbers = read_image<float>(array, is_transposed);
  if (!std::all_of(numbers.begin(), numbers.end(),
                   [](float number) { return whole_int(number).has_value(); })) {
    throw IoError(array.path(),
                  "labels are expected to be whole numbers, but the array holds fractions; save "
                  "labels as integers");
  }
  Image<std::int32_t> labels(numbers.height(), numbers.width());
  std::transform(numbers.begin(), numbers.end(), labels.begin(),
                 [](float number) { return static_cast<std::int32_t>(number); });
  return labels;
}

Image<float> read_npy_map(const std::filesystem::path& path) {
  const NpyFile file(path);
  return read_map(file, file.header().is_fortran);
}

Image<std::int32_t> read_npy_labels(const std::filesystem::path& path) {
  const NpyFile file(path);
  return read_label_map(file, file.header().is_fortran);
}

template <class T>
void write_npy(const std::filesystem::path& path, const ArrayShape& shape,
               std::span<const T> samples) {
  if (element_count(shape) != samples.size()) {
    throw InvalidInput(fmt::format("an array of the shape {} cannot hold {} samples",
                                   shape_text(shape), samples.size()));
  }
  const std::string header = npy_header(shape, number_type_of<T>());
  AtomicFile file(path, header.size() + samples.size_bytes());
  {
    const FileDescriptor out(file.temporary(), O_WRONLY | O_TRUNC);
    const bool is_written =
        out.ok() &&
        write_all(out.id(),
                  {reinterpret_cast<const std::uint8_t*>(header.data()), header.size()}) &&
        write_all(out.id(),
                  {reinterpret_cast<const std::uint8_t*>(samples.data()), samples.size_bytes()});
    if (!is_written) throw write_error(path);
  }
  file.commit();
}

template void write_npy(const std::filesystem::path&, const ArrayShape&,
                        std::span<const std::uint8_t>);
template void write_npy(const std::filesystem::path&, const ArrayShape&,
                        std::span<const std::uint16_t>);
template void write_npy(const std::filesystem::path&, const ArrayShape&,
                        std::span<const std::int32_t>);
template void write_npy(const std::filesystem::path&, const ArrayShape&, std::span<const float>);

namespace {

class DeflatedNpy : public LinearArray {
 public:
  DeflatedNpy(const std::filesystem::path& path, const ZipEntry& entry, NpyHeader header)
      : LinearArray(path, stored_shape(header), header.type),
        entry_(entry),
        header_(std::move(header)),
        stream_(std::make_unique<InflateStream>(path, entry)) {}

  [[nodiscard]] bool is_sequential() const override { return true; }

 private:
  void read_elements(std::size_t first, std::size_t count, std::uint8_t* out) const override {
    const std::size_t bytes = count * byte_size(type());
    const std::uint64_t begin = header_.bytes + first * byte_size(type());
    if (begin < stream_->position()) stream_ = std::make_unique<InflateStream>(path(), entry_);
    if (!stream_->skip_to(begin) || stream_->read(bytes, out) != bytes) {
      throw IoError(path(), entry_.name +
                                " in the zip archive is truncated or damaged; copy or save "
                                "it again");
    }
    if (header_.is_big_endian) swap_bytes(type(), count, out);
  }

  ZipEntry entry_;
  NpyHeader header_;
  mutable std::unique_ptr<InflateStream> stream_;
};

}  // namespace

NpyHeader read_zipped_header(const std::filesystem::path& path, const ZipEntry& entry) {
  if (!entry.is_deflated) return NpyFile(path, entry.begin, entry.stored).header();
  std::vector<std::uint8_t> begin(
      std::min<std::uint64_t>(entry.size, kLongestNpyHeader + kNpyPrefix));
  begin.resize(InflateStream(path, entry).read(begin.size(), begin.data()));
  return parse_npy_header(path, {reinterpret_cast<const char*>(begin.data()), begin.size()});
}

std::unique_ptr<ArrayInput> open_zipped_npy(const std::filesystem::path& path,
                                            const ZipEntry& entry) {
  if (!entry.is_deflated) return std::make_unique<NpyFile>(path, entry.begin, entry.stored);
  return std::make_unique<DeflatedNpy>(path, entry, read_zipped_header(path, entry));
}

}  // namespace episcope::io
