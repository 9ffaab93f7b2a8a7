// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/schema.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Which view axes to reverse against the order stored.
enum class Flip { Auto, None, U, V, Both };
[[nodiscard]] Names<Flip> names_of(Flip);

/// Whether dH of an archive file holds the factor xRes (eq. 2) or lacks it.
enum class Units { Auto, WithWidth, WithoutWidth };
[[nodiscard]] Names<Units> names_of(Units);

/// How one image holds all views.
enum class Mosaic { Auto, Lenslets, Views };
[[nodiscard]] Names<Mosaic> names_of(Mosaic);

/// Of which views maps of disparity and depth are read, where there are any of all.
enum class MapViews { All, Center };

/// How to open a light field: what a user may override instead of letting the reader detect it
/// (`open_schema`), and what the caller wants.
struct OpenOptions {
  Flip flip = Flip::Auto;
  Units units = Units::Auto;
  std::string
      pattern{};  ///< Image grids: file name with {row} and {col} or {index}; empty = detect.
  std::string
      grid{};  ///< Rows and columns of views, "9x9", where files do not tell; empty = found.
  std::string crop{};  ///< Views to keep around the centre, "9x9", or "all"; empty = all that are
                       ///< filled.
  Mosaic mosaic = Mosaic::Auto;
  int lenslet = 0;        ///< Mosaics of lenslets: pixels a side of a lenslet; 0 = found.
  std::string dataset{};  ///< Files of several arrays: which holds the light field; empty = found.
  std::string axes{};     ///< Arrays: their axes in C order, as "vuyxc"; empty = found.
  int frame = 0;          ///< Sequences of light fields: which one, from 0.
  std::string levels{};   ///< Samples that are black and white, as stored: "0,1023"; empty = found.
  bool equalise = false;  ///< Bring all views to the brightness of the centre view.
  /// Have methods take differences of brightness between views as they are (even_brightness.h).
  bool keep_brightness = false;
  bool snake = false;   ///< Image grids: every second row was captured right to left.
  double focus_px = 0;  ///< Focus plane to bake in after reading (shear.h), px per view step.

  /// Without, no truth nor labels are given: only the map of the centre view is then read, by which
  /// units and the order of views are settled.
  bool needs_truth = true;
  /// Called on the reading thread as soon as the centre view is there, before the rest is read.
  std::function<void(const Image<std::uint8_t>& center_rgb, const LightFieldInfo&, GridShape)>
      on_center_view{};

  [[nodiscard]] MapViews map_views() const {
    return needs_truth ? MapViews::All : MapViews::Center;
  }
};

/// The reading options: one row each, from which command lines, the dialog of conventions, settings
/// and result files take them.
[[nodiscard]] Schema<OpenOptions> open_schema();

/// The reading options that are not automatic, by key.
[[nodiscard]] ParameterSet given_options(const OpenOptions& options);

/// "7×7", for sentences.
[[nodiscard]] std::string grid_text(GridShape grid);

/// Rows and columns as a user writes them: "7x7", "1x49". Throws InvalidInput for anything else,
/// and for more than 1,000,000 views.
[[nodiscard]] GridShape parse_grid(const std::string& text);

/// The option `grid`; nothing if it was not given. Throws InvalidInput.
[[nodiscard]] std::optional<GridShape> given_grid(const OpenOptions& options);

/// One of several ways in which a light field can be read.
struct ReadingChoice {
  std::string value;  ///< Of the option, as on a command line: "1x49".
  std::string label;  ///< In words: "49 views in a row".
};

/// A light field that can be read in several ways, none of which is certain: a reader never
/// guesses. The message names the option (`open_schema`) that decides; a window asks.
class Undecided : public IoError {
 public:
  /// `reason`: what is not certain, and why. The option and its values are added to it.
  Undecided(const std::filesystem::path& path, const std::string& reason, std::string option,
            std::vector<ReadingChoice> choices);

  [[nodiscard]] const std::string& reason() const { return reason_; }
  [[nodiscard]] const std::string& option() const { return option_; }
  [[nodiscard]] const std::vector<ReadingChoice>& choices() const { return choices_; }

 private:
  std::string reason_;
  std::string option_;
  std::vector<ReadingChoice> choices_;
};

}  // namespace episcope::io
