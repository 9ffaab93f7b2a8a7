// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/net_weights.h"

#include "engine/core/error.h"
#include "engine/core/hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

namespace episcope {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = 4 * kMostWeights + (std::uintmax_t{1} << 22);
constexpr std::size_t kMostArrays = 4096;
constexpr std::size_t kMostRecordBytes = std::size_t{1} << 20;
constexpr std::string_view kRecord = "record";
constexpr std::string_view kSuffix = ".npy";

IoError damaged(const fs::path& path) {
  return {path, "the file of weights is truncated or damaged; copy it again"};
}

std::string bytes_of(const fs::path& path) {
  std::error_code failure;
  const std::uintmax_t size = fs::is_regular_file(path, failure) ? fs::file_size(path, failure) : 0;
  std::ifstream in(path, std::ios::binary);
  if (failure || !in || !fs::is_regular_file(path, failure)) {
    throw IoError(path, "no file of weights can be read there; check the name");
  }
  if (size > kMostBytes) {
    throw IoError(path, fmt::format("the file has {} MB, but weights of a network have fewer than "
                                    "{}; choose a file of weights",
                                    size / 1000000, kMostBytes / 1000000));
  }
  std::string bytes(size, '\0');
  if (!in.read(bytes.data(), static_cast<std::streamsize>(size))) throw damaged(path);
  return bytes;
}

// Bytes of a file, or a part of them, that holds little-endian numbers.
class Bytes {
 public:
  Bytes(const fs::path& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  [[nodiscard]] const fs::path& path() const { return path_; }
  [[nodiscard]] std::string_view all() const { return bytes_; }
  [[nodiscard]] std::string_view part(std::size_t at, std::size_t length) const {
    if (at > bytes_.size() || length > bytes_.size() - at) throw damaged(path_);
    return bytes_.substr(at, length);
  }
  template <class T>
  [[nodiscard]] T number(std::size_t at) const {
    std::uint64_t value = 0;
    const std::string_view held = part(at, sizeof(T));
    for (std::size_t i = sizeof(T); i-- > 0;) {
      value = value << 8 | static_cast<unsigned char>(held[i]);
    }
    return static_cast<T>(value);
  }

 private:
  const fs::path& path_;
  std::string_view bytes_;
};

// A file inside the archive.
struct Entry {
  std::string name;
  std::string_view bytes;
  std::uint32_t checksum = 0;
};

std::uint32_t checksum_of(std::string_view bytes) {
  static const auto table = [] {
    std::array<std::uint32_t, 256> made{};
    for (std::uint32_t i = 0; i < made.size(); ++i) {
      made[i] = i;
      for (int bit = 0; bit < 8; ++bit) {
        made[i] = made[i] >> 1 ^ ((made[i] & 1) != 0 ? 0xEDB88320U : 0U);
      }
    }
    return made;
  }();
  std::uint32_t sum = ~0U;
  for (const char byte : bytes)
    sum = table[(sum ^ static_cast<unsigned char>(byte)) & 255] ^ sum >> 8;
  return ~sum;
}

// The entry at `at` of the directory; moves on to the next.
Entry read_entry(const Bytes& file, std::size_t& at) {
  if (file.number<std::uint32_t>(at) != 0x02014B50) throw damaged(file.path());
  const auto method = file.number<std::uint16_t>(at + 10);
  const auto name = file.number<std::uint16_t>(at + 28);
  Entry entry{std::string(file.part(at + 46, name)), {}, file.number<std::uint32_t>(at + 16)};
  if (method != 0) {
    throw IoError(file.path(), "the weights are compressed; save them with numpy.savez");
  }
  const std::size_t local = file.number<std::uint32_t>(at + 42);
  if (file.number<std::uint32_t>(local) != 0x04034B50) throw damaged(file.path());
  const std::size_t begin =
      local + 30 + file.number<std::uint16_t>(local + 26) + file.number<std::uint16_t>(local + 28);
  entry.bytes = file.part(begin, file.number<std::uint32_t>(at + 20));
  at += 46U + name + file.number<std::uint16_t>(at + 30) + file.number<std::uint16_t>(at + 32);
  return entry;
}

std::vector<Entry> entries_of(const Bytes& file) {
  const std::size_t end = file.all().rfind(std::string_view("PK\5\6", 4));
  if (!file.all().starts_with("PK") || end == std::string_view::npos) {
    throw IoError(file.path(),
                  "this is no whole .npz archive; choose a file of weights, or copy it "
                  "again");
  }
  (void)file.part(end, 22U + file.number<std::uint16_t>(end + 20));
  const auto count = file.number<std::uint16_t>(end + 10);
  if (count > kMostArrays) {
    throw IoError(file.path(), fmt::format("the archive holds {} files, but weights of a network "
                                           "have fewer than {}; choose a file of weights",
                                           count, kMostArrays));
  }
  std::vector<Entry> entries;
  std::size_t at = file.number<std::uint32_t>(end + 16);
  for (int i = 0; i < count; ++i) entries.push_back(read_entry(file, at));
  return entries;
}

// An `.npy` file.
struct Array {
  std::string type;  // "<f2"
  std::vector<std::size_t> shape;
  std::string_view samples;

  [[nodiscard]] std::size_t count() const {
    std::size_t count = 1;
    for (const std::size_t length : shape) {
      if (length > 0 && count > kMostBytes / length) return kMostBytes;
      count *= length;
    }
    return count;
  }
};

// What stands between `begin` and `end` behind a key in the header of an array.
std::string_view value_of(const Bytes& file, std::string_view header, std::string_view key,
                          std::string_view begin, std::string_view end) {
  const std::size_t found = header.find(key);
  if (found == std::string_view::npos) throw damaged(file.path());
  const std::size_t from = header.find(begin, found + key.size());
  if (from == std::string_view::npos) throw damaged(file.path());
  const std::size_t to = header.find(end, from + begin.size());
  if (to == std::string_view::npos) throw damaged(file.path());
  return header.substr(from + begin.size(), to - from - begin.size());
}

std::vector<std::size_t> lengths_in(const Bytes& file, std::string_view text) {
  std::vector<std::size_t> lengths;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    if (*at == ' ' || *at == ',') {
      ++at;
      continue;
    }
    std::size_t length = 0;
    const auto [stop, failure] = std::from_chars(at, end, length);
    if (failure != std::errc()) throw damaged(file.path());
    lengths.push_back(length);
    at = stop;
  }
  return lengths;
}

Array read_array(const fs::path& path, const Entry& entry) {
  const Bytes file(path, entry.bytes);
  if (file.part(0, 6) != std::string_view("\x93NUMPY", 6)) throw damaged(path);
  const bool is_short = file.number<std::uint8_t>(6) == 1;
  const std::size_t begin = is_short ? 10 : 12;
  const std::size_t length =
      is_short ? file.number<std::uint16_t>(8) : file.number<std::uint32_t>(8);
  const std::string_view header = file.part(begin, length);
  Array array{std::string(value_of(file, header, "'descr':", "'", "'")),
              lengths_in(file, value_of(file, header, "'shape':", "(", ")")),
              entry.bytes.substr(begin + length)};
  const bool is_fortran =
      value_of(file, header, "'fortran_order':", " ", ",").find("True") != std::string_view::npos;
  if (is_fortran && array.shape.size() > 1) {
    throw IoError(path, entry.name + " is stored in Fortran order; save the weights in C order");
  }
  return array;
}

// Throws unless the array has as many bytes as its header claims, and these are what was saved.
void require_whole(const fs::path& path, const Entry& entry, const Array& array,
                   std::size_t number_bytes) {
  if (array.samples.size() != array.count() * number_bytes ||
      checksum_of(entry.bytes) != entry.checksum) {
    throw damaged(path);
  }
}

float from_half(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31;
  const auto mantissa = static_cast<float>(bits & 1023);
  float size = std::numeric_limits<float>::infinity();
  if (exponent == 0) size = std::ldexp(mantissa, -24);
  if (exponent > 0 && exponent < 31) size = std::ldexp(mantissa + 1024, exponent - 25);
  return (bits & 0x8000) != 0 ? -size : size;
}

float from_single(std::uint32_t bits) {
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

NamedArray read_weights(const fs::path& path, const Entry& entry, const Array& array,
                        std::string name) {
  const std::size_t bytes = array.type == "|i1"   ? 1
                            : array.type == "<f2" ? 2
                            : array.type == "<f4" ? 4
                                                  : 0;
  if (bytes == 0) {
    throw IoError(path, fmt::format("{} holds numbers of the type {} where weights are int8, "
                                    "float16 or float32; choose a file of weights",
                                    name, array.type));
  }
  require_whole(path, entry, array, bytes);
  const Bytes samples(path, array.samples);
  NamedArray read{std::move(name), array.shape, std::vector<float>(array.count())};
  for (std::size_t i = 0; i < read.values.size(); ++i) {
    read.values[i] = bytes == 1   ? samples.number<std::int8_t>(i)
                     : bytes == 2 ? from_half(samples.number<std::uint16_t>(2 * i))
                                  : from_single(samples.number<std::uint32_t>(4 * i));
  }
  if (!std::ranges::all_of(read.values, [](float value) { return std::isfinite(value); })) {
    throw IoError(path, read.name + " holds numbers that are not finite; copy the file again");
  }
  return read;
}

std::string read_record(const fs::path& path, const Entry& entry, const Array& array) {
  if (array.type != "|u1" || array.samples.size() > kMostRecordBytes ||
      !array.samples.starts_with('{')) {
    throw IoError(path, fmt::format("the record of the weights is expected to be a JSON object of "
                                    "up to {} bytes; choose a file of weights",
                                    kMostRecordBytes));
  }
  require_whole(path, entry, array, 1);
  return std::string(array.samples);
}

// The file that holds this code, mapped by the system; empty if that cannot be told.
fs::path own_file() {
  static const char here = 0;
  const auto address = reinterpret_cast<std::uintptr_t>(&here);
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::uintptr_t begin = 0, end = 0;
    const auto [dash, failure] = std::from_chars(line.data(), line.data() + line.size(), begin, 16);
    if (failure != std::errc() || *dash != '-') continue;
    std::from_chars(dash + 1, line.data() + line.size(), end, 16);
    const std::size_t name = line.find('/');
    if (begin <= address && address < end && name != std::string::npos) return line.substr(name);
  }
  return {};
}

// Dimensions, inputs, outputs, kernel, stride, dilation, bias, leaky: resources/training/README.md.
constexpr NetLayerForm kForms[] = {
    {"volume.image.0", 2, 5, 16, 3, 1, 1, true, true},
    {"volume.image.1", 2, 16, 16, 3, 1, 1, true, true},
    {"volume.e0", 3, 16, 16, 3, 1, 1, true, true},
    {"volume.d1", 3, 16, 32, 3, 2, 1, true, true},
    {"volume.e1", 3, 32, 32, 3, 1, 1, true, true},
    {"volume.d2", 3, 32, 48, 3, 2, 1, true, true},
    {"volume.e2.0", 3, 48, 48, 3, 1, 1, true, true},
    {"volume.e2.1", 3, 48, 48, 3, 1, 1, true, true},
    {"volume.r2.0", 3, 48, 48, 3, 1, 1, true, true},
    {"volume.r2.1", 3, 48, 48, 3, 1, 1, true, false},
    {"volume.d3", 3, 48, 64, 3, 2, 1, true, true},
    {"volume.e3.0", 3, 64, 64, 3, 1, 1, true, true},
    {"volume.e3.1", 3, 64, 64, 3, 1, 1, true, true},
    {"volume.r3.0", 3, 64, 64, 3, 1, 1, true, true},
    {"volume.r3.1", 3, 64, 64, 3, 1, 1, true, false},
    {"volume.u2", 3, 64, 48, 1, 1, 1, true, true},
    {"volume.f2", 3, 48, 48, 3, 1, 1, true, true},
    {"volume.s2.0", 3, 48, 48, 3, 1, 1, true, true},
    {"volume.s2.1", 3, 48, 48, 3, 1, 1, true, false},
    {"volume.u1", 3, 48, 32, 1, 1, 1, true, true},
    {"volume.f1", 3, 32, 32, 3, 1, 1, true, true},
    {"volume.u0", 3, 32, 16, 1, 1, 1, true, true},
    {"volume.f0", 3, 16, 16, 3, 1, 1, true, true},
    {"volume.image.2", 2, 16, 16, 3, 1, 1, true, false},
    {"volume.input", 3, 16, 16, 3, 1, 1, false, false},
    {"volume.head", 3, 16, 1, 3, 1, 1, true, false},
    {"selection.i.0", 2, 85, 64, 3, 1, 1, true, true},
    {"selection.i.1", 2, 64, 64, 3, 1, 1, true, true},
    {"selection.r0.0", 2, 64, 64, 3, 1, 1, true, true},
    {"selection.r0.1", 2, 64, 64, 3, 1, 1, true, false},
    {"selection.d1.0", 2, 64, 96, 3, 2, 1, true, true},
    {"selection.d1.1", 2, 96, 96, 3, 1, 1, true, true},
    {"selection.r1.0", 2, 96, 96, 3, 1, 1, true, true},
    {"selection.r1.1", 2, 96, 96, 3, 1, 1, true, false},
    {"selection.d2.0", 2, 96, 128, 3, 2, 1, true, true},
    {"selection.d2.1", 2, 128, 128, 3, 1, 1, true, true},
    {"selection.d2.2", 2, 128, 128, 3, 1, 2, true, true},
    {"selection.d2.3", 2, 128, 128, 3, 1, 4, true, true},
    {"selection.d3.0", 2, 128, 128, 3, 2, 1, true, true},
    {"selection.d3.1", 2, 128, 128, 3, 1, 1, true, true},
    {"selection.d3.2", 2, 128, 128, 3, 1, 2, true, true},
    {"selection.u2", 2, 128, 128, 1, 1, 1, true, false},
    {"selection.u1", 2, 128, 96, 1, 1, 1, true, true},
    {"selection.f1", 2, 96, 96, 3, 1, 1, true, true},
    {"selection.s1.0", 2, 96, 96, 3, 1, 1, true, true},
    {"selection.s1.1", 2, 96, 96, 3, 1, 1, true, false},
    {"selection.u0", 2, 96, 64, 1, 1, 1, true, true},
    {"selection.f0", 2, 64, 64, 3, 1, 1, true, true},
    {"selection.reduce.a", 2, 16, 16, 1, 1, 1, true, true},
    {"selection.reduce.b", 2, 16, 8, 1, 1, 1, true, true},
    {"selection.head", 2, 64, 8, 3, 1, 1, true, false},
    {"refinement.0.i.0", 2, 49, 48, 3, 1, 1, true, true},
    {"refinement.0.i.1", 2, 48, 48, 3, 1, 1, true, true},
    {"refinement.0.r0.0", 2, 48, 48, 3, 1, 1, true, true},
    {"refinement.0.r0.1", 2, 48, 48, 3, 1, 1, true, false},
    {"refinement.0.d1.0", 2, 48, 56, 3, 2, 1, true, true},
    {"refinement.0.d1.1", 2, 56, 56, 3, 1, 1, true, true},
    {"refinement.0.d1.2", 2, 56, 56, 3, 1, 2, true, true},
    {"refinement.0.d1.3", 2, 56, 56, 3, 1, 4, true, true},
    {"refinement.0.r1.0", 2, 56, 56, 3, 1, 1, true, true},
    {"refinement.0.r1.1", 2, 56, 56, 3, 1, 1, true, false},
    {"refinement.0.u0", 2, 56, 48, 1, 1, 1, true, true},
    {"refinement.0.f0.0", 2, 48, 48, 3, 1, 1, true, true},
    {"refinement.0.f0.1", 2, 48, 48, 3, 1, 1, true, true},
    {"refinement.0.reduce.a", 2, 16, 16, 1, 1, 1, true, true},
    {"refinement.0.reduce.b", 2, 16, 8, 1, 1, 1, true, true},
    {"refinement.0.head", 2, 48, 2, 3, 1, 1, true, false},
    {"refinement.1.i.0", 2, 49, 48, 3, 1, 1, true, true},
    {"refinement.1.i.1", 2, 48, 48, 3, 1, 1, true, true},
    {"refinement.1.r0.0", 2, 48, 48, 3, 1, 1, true, true},
    {"refinement.1.r0.1", 2, 48, 48, 3, 1, 1, true, false},
    {"refinement.1.d1.0", 2, 48, 56, 3, 2, 1, true, true},
    {"refinement.1.d1.1", 2, 56, 56, 3, 1, 1, true, true},
    {"refinement.1.d1.2", 2, 56, 56, 3, 1, 2, true, true},
    {"refinement.1.d1.3", 2, 56, 56, 3, 1, 4, true, true},
    {"refinement.1.r1.0", 2, 56, 56, 3, 1, 1, true, true},
    {"refinement.1.r1.1", 2, 56, 56, 3, 1, 1, true, false},
    {"refinement.1.u0", 2, 56, 48, 1, 1, 1, true, true},
    {"refinement.1.f0.0", 2, 48, 48, 3, 1, 1, true, true},
    {"refinement.1.f0.1", 2, 48, 48, 3, 1, 1, true, true},
    {"refinement.1.reduce.a", 2, 16, 16, 1, 1, 1, true, true},
    {"refinement.1.reduce.b", 2, 16, 8, 1, 1, 1, true, true},
    {"refinement.1.head", 2, 48, 2, 3, 1, 1, true, false},
};

/// Null if there is none.
const NamedArray* find_array(const NamedArrays& arrays, const std::string& name) {
  const auto found = std::ranges::find(arrays.arrays, name, &NamedArray::name);
  return found == arrays.arrays.end() ? nullptr : &*found;
}

const NamedArray& array_of(const NamedArrays& arrays, const std::string& name) {
  if (const NamedArray* found = find_array(arrays, name)) return *found;
  throw InvalidInput("the weights of net lack " + name + "; choose another file of weights");
}

std::string text_of(const std::vector<std::size_t>& shape) {
  return fmt::format("{}", fmt::join(shape, "×"));
}

const std::vector<float>& values_of(const NamedArrays& arrays, const std::string& name,
                                    const std::vector<std::size_t>& shape) {
  const NamedArray& array = array_of(arrays, name);
  std::size_t count = 1;
  for (const std::size_t length : shape) count *= length;
  if (array.shape != shape || array.values.size() != count) {
    throw InvalidInput(
        fmt::format("the weights of net have the shape {} in {}, where {} belongs; "
                    "choose another file of weights",
                    text_of(array.shape), name, text_of(shape)));
  }
  return array.values;
}

// Weights, which the file may hold divided by a scale for each output.
std::vector<float> weights_of(const NamedArrays& arrays, const std::string& name,
                              const std::vector<std::size_t>& shape) {
  std::vector<float> weights = values_of(arrays, name + ".weight", shape);
  if (find_array(arrays, name + ".scale") == nullptr) return weights;
  const std::vector<float>& scales = values_of(arrays, name + ".scale", {shape[0]});
  const std::size_t each = weights.size() / shape[0];
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] *= scales[i / each];
  return weights;
}

NetLayer read_layer(const NamedArrays& arrays, const NetLayerForm& form) {
  std::vector<std::size_t> shape{static_cast<std::size_t>(form.outputs),
                                 static_cast<std::size_t>(form.inputs)};
  shape.insert(shape.end(), form.dimensions, form.kernel);
  const std::string name = form.name;
  const std::vector<float> weights = weights_of(arrays, name, shape);
  if (!form.has_bias) return make_net_layer(form, weights, {});
  return make_net_layer(form, weights, values_of(arrays, name + ".bias", {shape[0]}));
}

void require_known(const NamedArrays& arrays) {
  for (const NamedArray& array : arrays.arrays) {
    const auto is_its_layer = [&](const NetLayerForm& form) {
      const std::string name = form.name;
      return array.name == name + ".weight" || array.name == name + ".scale" ||
             (form.has_bias && array.name == name + ".bias");
    };
    if (std::ranges::none_of(kForms, is_its_layer)) {
      throw InvalidInput("net has no layer for the weights " + array.name +
                         "; choose another file of weights");
    }
  }
}

// Weights of three taps, mixed: their polynomial at the points of kNetMixed, each divided by its
// distances from the others; at infinity its last coefficient.
std::array<double, kNetMixed> mixed_weights(double first, double second, double third) {
  const double even = first + third / 2, odd = second * std::sqrt(0.5);
  const double wide_even = first + third * 2, wide_odd = second * std::sqrt(2.0);
  return {first,
          (even + odd) / -1.5,
          (even - odd) / -1.5,
          (wide_even + wide_odd) / 6,
          (wide_even - wide_odd) / 6,
          third};
}

// All taps of an output and an input in the order of a mixed layer, `[mixed z or y][mixed x][y]`.
std::vector<double> mixed_taps(const NetLayerForm& form, const float* taps) {
  const int planes = form.mixed_planes(), rows = form.plain_taps();
  std::vector<double> mixed(static_cast<std::size_t>(planes) * kNetMixed * rows);
  for (int y = 0; y < rows; ++y) {
    std::array<std::array<double, kNetMixed>, 3> columns{};
    for (int z = 0; z < (planes == 1 ? 1 : 3); ++z) {
      const float* const row = taps + (z * rows + y) * 3;
      columns[z] = mixed_weights(row[0], row[1], row[2]);
    }
    for (int x = 0; x < kNetMixed; ++x) {
      std::array<double, kNetMixed> column{columns[0][x]};
      if (planes > 1) column = mixed_weights(columns[0][x], columns[1][x], columns[2][x]);
      for (int z = 0; z < planes; ++z) mixed[(z * kNetMixed + x) * rows + y] = column[z];
    }
  }
  return mixed;
}

}  // namespace

NamedArrays read_named_arrays(const fs::path& path) {
  const std::string bytes = bytes_of(path);
  NamedArrays read;
  std::size_t left = kMostWeights;
  for (const Entry& entry : entries_of(Bytes(path, bytes))) {
    if (!entry.name.ends_with(kSuffix)) continue;
    std::string name = entry.name.substr(0, entry.name.size() - kSuffix.size());
    const Array array = read_array(path, entry);
    if (name == kRecord) {
      read.record = read_record(path, entry, array);
      continue;
    }
    if (array.count() > left) {
      throw IoError(path, fmt::format("the archive holds more than {} numbers, too many for "
                                      "weights of a network; choose another file",
                                      kMostWeights));
    }
    left -= array.count();
    if (std::ranges::find(read.arrays, name, &NamedArray::name) != read.arrays.end()) {
      throw IoError(path, "the archive holds two arrays " + name + "; copy the file again");
    }
    read.arrays.push_back(read_weights(path, entry, array, std::move(name)));
  }
  if (read.record.empty()) {
    throw IoError(path, "the archive has no record of its weights; choose a file of weights");
  }
  Fnv1a hash;
  hash.add(bytes);
  read.hash = hash.value();
  return read;
}

fs::path installed_weights(std::string_view name) {
  std::vector<fs::path> data_folders;
  for (fs::path folder = own_file().parent_path(); folder.has_relative_path();
       folder = folder.parent_path()) {
    data_folders.push_back(folder / "share");
  }
  const char* const given = std::getenv("XDG_DATA_DIRS");
  std::istringstream of_system(given && *given ? given : "/usr/local/share:/usr/share");
  for (std::string folder; std::getline(of_system, folder, ':');) data_folders.push_back(folder);
  const fs::path place = fs::path("episcope/weights") / name;
  for (const fs::path& folder : data_folders) {
    std::error_code ignored;
    if (fs::is_regular_file(folder / place, ignored)) return folder / place;
  }
  throw Unavailable(fmt::format(
      "the weights {} are not installed with the program, in share/{}; install it anew, "
      "or name a file of weights",
      name, place.string()));
}

NetLayer make_net_layer(const NetLayerForm& form, const std::vector<float>& weights,
                        const std::vector<float>& bias) {
  NetLayer layer{.form = form, .weights = {}, .bias = {}, .plain_weights = weights};
  const int rows = form.is_narrow() ? form.outputs : whole_groups(form.outputs) / kNetGroup;
  layer.weights.resize(static_cast<std::size_t>(rows * layer.group_stride() / kNetGroup));
  layer.bias.resize(whole_groups(form.outputs) / kNetGroup);
  const auto put = [&](int output, int input, int tap, double value) {
    const long at = form.is_narrow()
                        ? output * layer.group_stride() + tap * layer.tap_stride() + input
                        : output / kNetGroup * layer.group_stride() + tap * layer.tap_stride() +
                              static_cast<long>(input) * kNetGroup + output % kNetGroup;
    layer.weights[at / kNetGroup].values[at % kNetGroup] = static_cast<float>(value);
  };
  const float* next = weights.data();
  for (int output = 0; output < form.outputs; ++output) {
    for (int input = 0; input < form.inputs; ++input, next += form.taps()) {
      const std::vector<double> taps =
          form.is_mixed() ? mixed_taps(form, next) : std::vector<double>(next, next + form.taps());
      for (int tap = 0; tap < static_cast<int>(taps.size()); ++tap) {
        put(output, input, tap, taps[tap]);
      }
    }
  }
  for (std::size_t i = 0; i < bias.size(); ++i) {
    layer.bias[i / kNetGroup].values[i % kNetGroup] = bias[i];
  }
  return layer;
}

NetWeights::NetWeights(const NamedArrays& arrays) : record_(arrays.record) {
  require_known(arrays);
  for (const NetLayerForm& form : kForms) layers_.emplace(form.name, read_layer(arrays, form));
}

}  // namespace episcope
