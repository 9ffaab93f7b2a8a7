// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/open_options.h"

namespace episcope::io {
namespace {

constexpr double kMaxFocus_px = 1000;

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
          {Mosaic::Views, "views", "views side by side"}};
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
             "File names of an image grid with {row} and {col}, or {index}; * matches anything: "
             "view_{row}_{col}.png"})
      .toggle("snake", &O::snake,
              {"Snake", "Every other row of an image grid runs from right to left"})
      .real(
          Reading::kFocus, &O::focus_px,
          {"Focus plane", "Focus plane to bake in: points of this disparity get disparity 0", "px"},
          {-kMaxFocus_px, kMaxFocus_px})
      .toggle("equalise", &O::equalise,
              {"Equalise", "Bring all views to the brightness of the centre view"});
  return schema;
}

ParameterSet given_options(const OpenOptions& options) {
  const Schema<OpenOptions> schema = open_schema();
  ParameterSet given;
  for (auto& [key, value] : schema.values(options)) {
    const auto& description = schema.description(key);
    if (!(value == description.default_value)) given.emplace_back(key, std::move(value));
  }
  return given;
}

}  // namespace episcope::io
