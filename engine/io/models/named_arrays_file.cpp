// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/named_arrays_file.h"

#include "engine/core/error.h"
#include "engine/io/base/json.h"
#include "engine/io/base/npy.h"
#include "engine/io/base/zip.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

namespace episcope::io {

namespace {

constexpr std::size_t kMostRecordBytes = std::size_t{1} << 20;
constexpr std::size_t kMostArrays = 4096;
constexpr const char* kRecord = "record";
constexpr const char* kSuffix = ".npy";

std::unique_ptr<ArrayInput> open_entry(const std::filesystem::path& path, const ZipEntry& entry) {
  const NpyHeader header = read_zipped_header(path, entry);
  if (header.is_fortran && header.shape.size() > 1) {
    throw IoError(path, entry.name + " is stored in Fortran order; save the weights in C order");
  }
  return open_zipped_npy(path, entry);
}

template <class T>
std::vector<T> values_of(const ArrayInput& array) {
  std::vector<T> values(element_count(array.shape()));
  array.read(ArrayShape(array.shape().size(), 0), array.shape(), values.data());
  return values;
}

std::string read_record(const ArrayInput& array) {
  if (array.type() != NumberType::UInt8 || element_count(array.shape()) > kMostRecordBytes) {
    throw IoError(array.path(), fmt::format("the record is expected to be up to {} bytes of text, "
                                            "but is {} of {}; choose a file of weights",
                                            kMostRecordBytes, shape_text(array.shape()),
                                            number_name(array.type())));
  }
  const std::vector<std::uint8_t> bytes = values_of<std::uint8_t>(array);
  std::string text(bytes.begin(), bytes.end());
  try {
    if (!parse_json<nlohmann::json>(text).is_object()) throw InvalidInput("no JSON object");
  } catch (const nlohmann::json::exception&) {
    throw IoError(array.path(), "the record of the weights is no JSON; copy the file again");
  } catch (const InvalidInput&) {
    throw IoError(array.path(), "the record of the weights is no JSON object; copy the file again");
  }
  return text;
}

NamedArray read_weights(const ArrayInput& array, const std::string& name) {
  if (array.type() != NumberType::Float16 && array.type() != NumberType::Float32) {
    throw IoError(array.path(),
                  fmt::format("{} holds {} where weights are float16 or float32; choose a file of "
                              "weights",
                              name, number_name(array.type())));
  }
  NamedArray read{name, array.shape(), values_of<float>(array)};
  if (!std::ranges::all_of(read.values, [](float value) { return std::isfinite(value); })) {
    throw IoError(array.path(), name + " holds numbers that are not finite; copy the file again");
  }
  return read;
}

void require_new_name(const std::filesystem::path& path, const NamedArrays& read,
                      const std::string& name) {
  const auto has_name = [&](const NamedArray& array) { return array.name == name; };
  if (std::ranges::any_of(read.arrays, has_name)) {
    throw IoError(path, "the archive holds two arrays " + name + "; copy the file again");
  }
}

}  // namespace

NamedArrays read_named_arrays(const std::filesystem::path& path) {
  const std::vector<ZipEntry> entries = list_zip(path);
  if (entries.size() > kMostArrays) {
    throw IoError(path, fmt::format("the archive holds {} files, but weights of a network have "
                                    "fewer than {}; choose a file of weights",
                                    entries.size(), kMostArrays));
  }
  NamedArrays read;
  std::size_t left = kMostWeights;
  for (const ZipEntry& entry : entries) {
    if (!entry.name.ends_with(kSuffix)) continue;
    const std::string name = entry.name.substr(0, entry.name.size() - 4);
    const std::unique_ptr<ArrayInput> array = open_entry(path, entry);
    if (name == kRecord) {
      read.record = read_record(*array);
      continue;
    }
    const std::size_t count = element_count(array->shape());
    if (count > left) {
      throw IoError(path, fmt::format("the archive holds more than {} numbers, too many for "
                                      "weights of a network; choose another file",
                                      kMostWeights));
    }
    left -= count;
    require_new_name(path, read, name);
    read.arrays.push_back(read_weights(*array, name));
  }
  if (read.record.empty()) {
    throw IoError(path, "the archive has no record of its weights; choose a file of weights");
  }
  return read;
}

}  // namespace episcope::io
