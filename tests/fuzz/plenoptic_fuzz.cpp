// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/plenoptic/decode_files.h"
#include "engine/capture/plenoptic/processed_container.h"
#include "engine/capture/plenoptic/raw_picture.h"
#include "tests/fuzz/harness.h"

#include <fstream>
#include <iterator>

namespace episcope::fuzz {
namespace {

std::vector<std::uint8_t> bytes_of(const std::string& text) {
  return {text.begin(), text.end()};
}

capture::RawPicture small_raw() {
  capture::RawPicture raw;
  raw.samples = Image<std::uint16_t>(16, 16, 1, 500);
  raw.white = 1023;
  raw.mosaic = capture::Mosaic::Grbg;
  return raw;
}

/// A picture with its white picture, a storage container of one white picture, and a depth map.
void write_seeds(const std::filesystem::path& folder) {
  const capture::RawPicture raw = small_raw();
  const auto samples = pack(raw.samples, capture::Packing::Bits10);
  const auto metadata = bytes_of(illum_metadata(raw));
  const std::string image = capture::lfp_reference(samples);
  const std::string facts = capture::lfp_reference(metadata);
  const auto table =
      bytes_of(R"({"frames":[{"frame":{"imageRef":")" + image + R"(","metadataRef":")" + facts +
               R"(","modulationDataRef":")" + image + R"("}}]})");
  const auto files = bytes_of(R"({"files":[{"name":"MOD_0000.RAW","dataRef":")" + image +
                              R"("},{"name":"MOD_0000.TXT","dataRef":")" + facts + R"("}]})");
  capture::write_lfp(folder / "picture",
                     {{{true, {}, table}, {false, {}, samples}, {false, {}, metadata}}});
  capture::write_lfp(folder / "storage",
                     {{{true, {}, files}, {false, {}, samples}, {false, {}, metadata}}});
  const auto depth = bytes_of("AAAABBBBCCCCDDDD");
  const auto processed = bytes_of(
      R"({"picture":{"frameArray":[{"frame":{}}],"width":2,"height":2,"depthMap":{"imageRef":")" +
      capture::lfp_reference(depth) + R"("}}})");
  capture::write_lfp(folder / "processed", {{{true, {}, processed}, {false, {}, depth}}});
  write_bytes(folder / "metadata", illum_metadata(raw));
}

/// A container, calibration data of a camera, or the JSON of a camera.
void read(const std::filesystem::path& file) {
  tolerate([&] { (void)capture::read_raw(file); });
  tolerate([&] { (void)capture::read_white(file, small_raw()); });
  tolerate([&] {
    if (const auto processed = capture::read_processed(file)) (void)scene_of(*processed);
  });
  std::ifstream text(file, std::ios::binary);
  const auto samples = pack(small_raw().samples, capture::Packing::Bits10);
  tolerate([&] {
    (void)capture::raw_from_json(samples, {std::istreambuf_iterator<char>(text), {}}, {});
  });
}

}  // namespace

/// Calibration data are known by this name.
const Harness kHarness{[](std::string_view) { return std::string("data.C.0"); }, read, write_seeds};

}  // namespace episcope::fuzz
