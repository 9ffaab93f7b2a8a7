// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/mosaic/mosaic_layout.h"

#include "engine/core/error.h"
#include "engine/core/text/suffix.h"
#include "engine/io/grid/image_size.h"
#include "engine/io/mosaic/lenslet_period.h"
#include "engine/io/mosaic/mosaic_name.h"
#include "engine/io/mosaic/picture_lines.h"
#include "engine/io/mosaic/tile_count.h"
#include "engine/io/open/grid_option.h"
#include "engine/io/open/undecided.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

/// A picture, what is known of it, and its lines, which show periods.
struct Question {
  const fs::path& path;
  MosaicName name;
  Mosaic kind;                    ///< Given, or told by the name; else Auto.
  std::optional<GridShape> grid;  ///< Given.
  int height;
  int width;
  Image<float> along_x;
  Image<float> along_y;
  std::string subject{};  ///< What messages call it.
};

struct Answer {
  Mosaic kind;
  GridShape grid;
  std::string evidence;
};

int percent(double part) {
  return static_cast<int>(std::lround(100 * part));
}

std::optional<GridShape> stated_grid(const OpenOptions& options) {
  const std::optional<GridShape> grid = given_grid(options);
  if (options.lenslet == 0) return grid;
  const GridShape lenslet{options.lenslet, options.lenslet};
  if (options.mosaic == Mosaic::Views) {
    throw InvalidInput(
        "--lenslet belongs to --mosaic lenslets; for views side by side give --grid");
  }
  if (grid && !(*grid == lenslet)) {
    throw InvalidInput(
        fmt::format("--lenslet {} and --grid {} contradict each other; give one of "
                    "them",
                    options.lenslet, options.grid));
  }
  return lenslet;
}

Mosaic stated_kind(const OpenOptions& options, MosaicName name) {
  if (options.mosaic != Mosaic::Auto) return options.mosaic;
  const bool is_named = name == MosaicName::Eslf || name == MosaicName::Lenslets;
  return options.lenslet > 0 || is_named ? Mosaic::Lenslets : Mosaic::Auto;
}

/// Lytro cameras give 14 px a lenslet, or 15.
std::optional<Answer> eslf_by_size(const Question& question) {
  for (const int side : {14, 15}) {
    if (question.height % side == 0 && question.width % side == 0) {
      return Answer{Mosaic::Lenslets,
                    {side, side},
                    fmt::format("the name says ESLF, and {} divides both sides; the picture itself "
                                "does not tell",
                                side)};
    }
  }
  return std::nullopt;
}

bool is_jpeg_name(const fs::path& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".jpg" || suffix == ".jpeg";
}

bool can_be_lenslets(const Question& question, const LensletPeriod& period) {
  if (question.kind != Mosaic::Lenslets) return period.is_certain();
  return is_jpeg_name(question.path) ? period.is_likely_in_jpeg() : period.is_likely();
}

std::optional<Answer> lenslets_of(const Question& question) {
  const LensletPeriod u = find_lenslet_period(question.along_x);
  const LensletPeriod v = find_lenslet_period(question.along_y);
  if (can_be_lenslets(question, u) && can_be_lenslets(question, v)) {
    return Answer{
        Mosaic::Lenslets,
        {v.period_px, u.period_px},
        fmt::format("{} % and {} % of the changes of brightness along x and y repeat with "
                    "this period",
                    percent(u.explained), percent(v.explained))};
  }
  return question.name == MosaicName::Eslf ? eslf_by_size(question) : std::nullopt;
}

std::optional<Answer> views_of(const Question& question) {
  const TileCount u = find_tile_count(question.along_x);
  if (!u.is_certain()) return std::nullopt;
  const TileCount v = find_tile_count(question.along_y);
  if (!v.is_certain()) return std::nullopt;
  return Answer{Mosaic::Views,
                {v.count, u.count},
                fmt::format("neighbouring views correlate by {:.2f} along x and {:.2f} along y",
                            u.correlation, v.correlation)};
}

std::optional<Answer> find_answer(const Question& question) {
  if (question.grid && question.kind != Mosaic::Auto) {
    return Answer{question.kind, *question.grid, "as the options say"};
  }
  std::optional<Answer> found;
  if (question.kind != Mosaic::Views) found = lenslets_of(question);
  if (!found && question.kind != Mosaic::Lenslets) found = views_of(question);
  const bool contradicts = found && question.grid && !(found->grid == *question.grid);
  return contradicts ? std::nullopt : found;
}

/// Sides of lenslets of cameras and of common data that divide both sides of the picture.
std::vector<ReadingChoice> possible_lenslets(const Question& question) {
  std::vector<ReadingChoice> choices;
  for (const int side : {14, 15, 9, 8, 7, 5}) {
    if (question.height % side != 0 || question.width % side != 0) continue;
    choices.push_back(
        {std::to_string(side), fmt::format("{0}×{0} views of {1}×{2} px", side,
                                           question.width / side, question.height / side)});
  }
  return choices;
}

[[noreturn]] void refuse(const Question& question) {
  const std::string size = fmt::format("of {}×{} px", question.width, question.height);
  if (question.kind == Mosaic::Lenslets) {
    const std::string reason = "no period of lenslets is found in " + question.subject + " " + size;
    auto choices = possible_lenslets(question);
    if (!choices.empty()) throw Undecided(question.path, reason, "lenslet", std::move(choices));
    throw IoError(question.path,
                  reason + "; give the pixels along a side of a lenslet, for example --lenslet 14");
  }
  if (question.kind == Mosaic::Views) {
    throw IoError(question.path,
                  "the number of views in " + question.subject + " " + size +
                      " is not found; give rows and columns, for example --grid 9x9");
  }
  throw IoError(
      question.path,
      "this is a single picture " + size +
          " and not recognised as a light field; if it holds all views, give --mosaic "
          "lenslets --lenslet N or --mosaic views --grid RxC, else open a folder of views");
}

ImageSize size_of(const AnyImage& picture) {
  return std::visit(
      [](const auto& image) {
        return ImageSize{image.height(), image.width()};
      },
      picture);
}

Question question_of(const AnyImage& picture, ImageSize size, const fs::path& path,
                     const OpenOptions& options) {
  const MosaicName name = mosaic_name(path);
  return {
      path,        name,       stated_kind(options, name),      stated_grid(options),
      size.height, size.width, picture_lines(picture, Axis::X), picture_lines(picture, Axis::Y)};
}

}  // namespace

MosaicLayout find_mosaic_layout(const AnyImage& picture, const fs::path& path,
                                const OpenOptions& options, const std::string& subject) {
  const auto [height, width] = size_of(picture);
  Question question = question_of(picture, {height, width}, path, options);
  question.subject = subject;
  std::optional<Answer> answer = find_answer(question);
  if (!answer) refuse(question);
  const GridShape grid = answer->grid;
  constexpr int kSmallestView = 2;
  if (height / grid.v < kSmallestView || width / grid.u < kSmallestView) {
    throw IoError(path, fmt::format("a picture of {}×{} px is too small for {}×{} views; correct "
                                    "--grid or --lenslet",
                                    width, height, grid.v, grid.u));
  }
  return {answer->kind, grid, height / grid.v, width / grid.u, std::move(answer->evidence)};
}

std::optional<GridShape> find_lenslets(const AnyImage& top, int height, const fs::path& path,
                                       const OpenOptions& options) {
  const Question question = question_of(top, {height, size_of(top).width}, path, options);
  if (question.kind != Mosaic::Lenslets) return std::nullopt;
  const std::optional<Answer> answer = find_answer(question);
  return answer ? std::optional(answer->grid) : std::nullopt;
}

}  // namespace episcope::io
