// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/net_weights.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/npy.h"
#include "engine/io/base/zip.h"
#include "tests/fuzz/harness.h"

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace episcope::fuzz {
namespace {

/// Zeros of any type, behind the header of an array.
std::string array_of(const io::ArrayShape& shape, io::NumberType type) {
  return io::npy_header(shape, type) +
         std::string(io::element_count(shape) * io::byte_size(type), '\0');
}

void write_seeds(const std::filesystem::path& folder) {
  const std::string record = "{\"name\": \"net\", \"version\": 1}";
  const std::vector<std::pair<std::string, std::string>> files = {
      {"volume.image.0.bias.npy", array_of({16}, io::NumberType::Float16)},
      {"volume.image.0.weight.npy", array_of({16, 5, 3, 3}, io::NumberType::Float32)},
      {"record.npy", io::npy_header({record.size()}, io::NumberType::UInt8) + record}};
  io::AtomicFile file(folder / "weights.npz");
  io::ZipWriter zip(file);
  for (const auto& [name, bytes] : files) {
    zip.add(name, {{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}});
  }
  zip.close();
  file.commit();
}

void read(const std::filesystem::path& file) {
  (void)NetWeights(read_named_arrays(file));
}

}  // namespace

const Harness kHarness{[](std::string_view) { return std::string("weights.npz"); }, read,
                       write_seeds};

}  // namespace episcope::fuzz
