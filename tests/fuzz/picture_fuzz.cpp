// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/image_file.h"
#include "engine/io/base/image_header.h"
#include "engine/io/open.h"
#include "tests/engine/io/base/exr_file.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/seed_scene.h"

#include <opencv2/imgcodecs.hpp>

#include <cstdint>

namespace episcope::fuzz {
namespace {

/// As renderers name them; of colors, and of depth.
void write_layers(const std::filesystem::path& path) {
  const Image<float> values(4, 5);
  const std::string layer = "View Layer.Combined.";
  test::write_exr(path, {{layer + "R", values.view()},
                         {layer + "G", values.view()},
                         {layer + "B", values.view()},
                         {"View Layer.Depth.Z", values.view()}});
}

void write_seeds(const std::filesystem::path& folder) {
  write_seed("eslf", folder / "lf_eslf.png");
  write_layers(folder / "layers.exr");
  const cv::Mat picture(32, 40, CV_8UC3, cv::Scalar(10, 100, 200));
  for (const char* suffix : {".bmp", ".ppm", ".tif", ".jpg", ".png", ".jp2", ".webp", ".hdr"}) {
    cv::imwrite((folder / ("picture" + std::string(suffix))).string(), picture);
  }
}

/// A picture of any form; one that is read whole also as a mosaic of lenslets. Of those that claim
/// to be large, whose decoding is all filling, only those that are read whole.
void read(const std::filesystem::path& file) {
  constexpr std::uint64_t kLarge = 200'000;
  tolerate([&] { (void)io::read_image_header(file); });
  if (!is_read_whole() && io::declared_pixels(file).value_or(0) > kLarge) return;
  tolerate([&] { (void)io::decode_image(file); });
  tolerate([&] { (void)io::decode_image(file, io::PicturePart::Depth); });
  if (!is_read_whole()) return;
  io::OpenOptions options;
  options.mosaic = io::Mosaic::Lenslets;
  options.grid = "3x3";
  (void)io::open_scene(file, options, progress_of_reading());
}

}  // namespace

const Harness kHarness{[](std::string_view) { return std::string("lf_eslf.png"); }, read,
                       write_seeds};

}  // namespace episcope::fuzz
