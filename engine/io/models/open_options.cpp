// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/open_options.h"

#include <fmt/format.h>

#include <charconv>
#include <utility>
#include <variant>

namespace episcope::io {
namespace {

constexpr double kMaxFocus_px = 1000;
constexpr double kLargestLenslet = 100;
constexpr int kLastFrame = 999999;

}  // namespace

Names<Flip> names_of(Flip) {
  return {{Flip::Auto, "auto", "automatic: detected and checked"},
          {Flip::None, "none", "as stored"},
          {Flip::U, "u", "columns (u) reversed"},
          {Flip::V, "v", "rows (v) reversed"},
          {Flip::Both, "both", "both reversed"}};
}

Names<Units> names_of(Units) {
  return {{Units::Auto, "auto", "automatic: whichever is plausible"},
          {Units::WithWidth, "with-width", "dH includes the image width"},
          {Units::WithoutWidth, "without-width", "dH does not include the image width"}};
}

Names<Mosaic> names_of(Mosaic) {
  return {{Mosaic::Auto, "auto", "automatic: detected and checked"},
          {Mosaic::Lenslets, "lenslets", "lenslets side by side (ESLF)"},
          {Mosaic::Views, "views", "views side by side"},
          {Mosaic::ViewsUp, "views-up", "views side by side, rows from the bottom"},
          {Mosaic::Quilt, "quilt", "one line of views, rows from the bottom (quilt)"}};
}

Schema<OpenOptions> open_schema() {
  using O = OpenOptions;
  Schema<O> schema;
  schema
      .choice("flip", &O::flip,
              {"Order of views",
               "View axes to reverse relative to the file; auto = detected and checked"})
      .choice("units", &O::units,
              {"Depth units",
               "Whether dH of an archive file includes the factor xRes, which determines how depth "
               "is converted to disparity"})
      .text("pattern", &O::pattern,
            {"Image names",
             "Whole file names of the views, with {row} and {col} or {index} for the numbers, {y} "
             "and {x} for positions, * for anything and ? for one character: "
             "view_{row}_{col}.png; or re: and a regular expression with groups of these names: "
             "re:(?<row>[0-9]+)of(?<col>[0-9]+).*"})
      .toggle("snake", &O::snake,
              {"Snake", "Every other row of an image grid runs from right to left"})
      .text(
          "grid", &O::grid,
          {"Grid of views",
           "Rows and columns of views, where the files do not tell: 9x9, or 1x49 for a scan along "
           "a line"})
      .text(
          "crop", &O::crop,
          {"Views to keep",
           "Rows and columns of views to keep around the center: 9x9, or all; empty = the largest "
           "grid whose views are filled"})
      .choice("mosaic", &O::mosaic, {"Mosaic", "How one image holds all views"})
      .real(
          "lenslet", &O::lenslet,
          {"Lenslet",
           "Pixels from one lenslet of a mosaic to the next; of a fraction, as 15.38, the picture "
           "is resampled to lenslets of whole pixels; 0 = detected",
           "px"},
          {0, kLargestLenslet})
      .text("dataset", &O::dataset,
            {"Dataset",
             "Name of the array that holds the light field, in a file with several of them"})
      .text("axes", &O::axes,
            {"Axes",
             "Axes of an array in the order of its indices: v and u for rows and columns of views, "
             "y, "
             "x, c for channels, as in vuyxc; empty = detected"})
      .integer("frame", &O::frame, {"Frame", "Which light field of a sequence to open, from 0"},
               {0, kLastFrame})
      .real(
          Reading::kFocus, &O::focus_px,
          {"Focus plane", "Focus plane to bake in: points of this disparity get disparity 0", "px"},
          {-kMaxFocus_px, kMaxFocus_px})
      .text("levels", &O::levels,
            {"Levels",
             "Values of black and white samples as stored: 0,1023 for 10 bits in 16, -1,1 for "
             "normalized floats; empty = detected"})
      .toggle("equalize", &O::equalize,
              {"Equalize", "Bring all views to the brightness of the center view"})
      .toggle("no-equalize", &O::keep_brightness,
              {"Keep differences of brightness",
               "Have methods take differences of brightness between views as they are, which they "
               "otherwise even out where these are measured"});
  return schema;
}

ParameterSet given_options(const OpenOptions& options) {
  return open_schema().changed_values(options);
}

ParameterSet stored_options(ParameterSet options) {
  for (const ParameterDescription& description : open_schema().descriptions()) {
    if (!std::holds_alternative<double>(description.default_value)) continue;
    for (auto& [key, value] : options) {
      const int* const whole = key == description.key ? std::get_if<int>(&value) : nullptr;
      if (whole) value = static_cast<double>(*whole);
    }
  }
  return options;
}

namespace {

constexpr int kMostGivenViews = 1000000;

/// A whole number from 1 on that begins at `at`, which moves behind it; 0 if there is none.
int take_count(const std::string& text, std::size_t& at) {
  int value = 0;
  const char* begin = text.data() + at;
  const auto [stop, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error != std::errc() || value < 1 || value > kMostGivenViews) return 0;
  at += static_cast<std::size_t>(stop - begin);
  return value;
}

}  // namespace

std::string grid_text(GridShape grid) {
  return fmt::format("{}×{}", grid.v, grid.u);
}

GridShape parse_grid(const std::string& text) {
  std::size_t at = 0;
  GridShape grid;
  grid.v = take_count(text, at);
  for (const std::string_view times : {"x", "X", "×"}) {
    if (!std::string_view(text).substr(at).starts_with(times)) continue;
    at += times.size();
    grid.u = take_count(text, at);
    break;
  }
  if (grid.v < 1 || grid.u < 1 || at != text.size() || grid.v > kMostGivenViews / grid.u) {
    throw InvalidInput("'" + text +
                       "' is no grid of views; give rows x columns, as in 9x9, or 1x49 for a scan "
                       "along a line");
  }
  return grid;
}

std::optional<GridShape> given_grid(const OpenOptions& options) {
  if (options.grid.empty()) return std::nullopt;
  return parse_grid(options.grid);
}

namespace {

std::string alternatives(const std::string& option, const std::vector<ReadingChoice>& choices) {
  std::string text;
  for (const ReadingChoice& choice : choices) {
    text += fmt::format("{}--{} {} ({})", text.empty() ? "" : ", or ", option, choice.value,
                        choice.label);
  }
  return text;
}

}  // namespace

Undecided::Undecided(const std::filesystem::path& path, const std::string& reason,
                     std::string option, std::vector<ReadingChoice> choices)
    : IoError(path, reason + "; give " + alternatives(option, choices)),
      reason_(reason),
      option_(std::move(option)),
      choices_(std::move(choices)) {}

}  // namespace episcope::io
