// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/frames_reader.h"
#include "engine/io/formats/movie.h"
#include "tests/engine/io/formats/described_tiff.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/seed_scene.h"

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include <vector>

namespace episcope::fuzz {
namespace {

constexpr int kPictures = 9, kHeight = 16, kWidth = 24;

cv::Mat picture(int number, int type) {
  cv::Mat made(kHeight, kWidth, type, cv::Scalar::all(40));
  made.col(4 + number).setTo(cv::Scalar::all(200));
  return made;
}

void write_pages(const std::filesystem::path& path, int type) {
  std::vector<cv::Mat> pages;
  for (int i = 0; i < kPictures; ++i) pages.push_back(picture(i, type));
  cv::imwrite(path.string(), pages);
}

void write_film(const std::filesystem::path& path) {
  io::MovieFile film(path, {.height = kHeight, .width = kWidth});
  for (int i = 0; i < kPictures; ++i) {
    const cv::Mat pixels = picture(i, CV_8UC4);
    film.add({pixels.data, kHeight, kWidth, 4, kWidth * 4});
  }
  film.commit();
}

void write_seeds(const std::filesystem::path& folder) {
  write_pages(folder / "pages.tif", CV_8UC3);
  write_pages(folder / "deep.tif", CV_16UC1);
  int number = 0;
  for (const char* text :
       {"ImageJ=1.53t\nimages=9\nchannels=3\nslices=3\n", R"({"shape": [3, 3, 16, 24]})",
        "<OME><Pixels DimensionOrder=\"XYCZT\" SizeC=\"3\" SizeZ=\"3\"/></OME>"}) {
    const std::filesystem::path file = folder / fmt::format("stated{}.tif", number++);
    write_pages(file, CV_8UC1);
    test::describe_tiff(file, text);
  }
  for (const char* name : {"film.mp4", "film.webm", "film.gif"}) write_film(folder / name);
}

std::string name_of(std::string_view bytes) {
  if (bytes.starts_with("II") || bytes.starts_with("MM")) return "lf.tif";
  if (bytes.starts_with("GIF")) return "lf.gif";
  if (bytes.starts_with("RIFF")) return "lf.avi";
  return bytes.starts_with("\x1a\x45") ? "lf.webm" : "lf.mp4";
}

/// Pages of a TIFF file, or a film.
void read(const std::filesystem::path& file) {
  tolerate([&] {
    (void)io::stated_pages(io::tiff_description(file), io::count_tiff_pages(file, 1000));
  });
  open_light_field(file);
}

}  // namespace

const Harness kHarness{name_of, read, write_seeds};

}  // namespace episcope::fuzz
