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

/// View axes to reverse against the stored order.
enum class Flip { Auto, None, U, V, Both };
[[nodiscard]] Names<Flip> names_of(Flip);

/// Whether dH of an archive file holds the factor xRes (eq. 2) or lacks it.
enum class Units { Auto, WithWidth, WithoutWidth };
[[nodiscard]] Names<Units> names_of(Units);

/// How one image holds all views.
enum class Mosaic { Auto, Lenslets, Views, ViewsUp, Quilt };
[[nodiscard]] Names<Mosaic> names_of(Mosaic);

/// Views whose disparity and depth are read.
enum class MapViews { All, Center };

/// The EPIs through the middle of the center view, `[u][x]` and `[v][y]` in RGB.
struct CenterEpis {
  Image<std::uint8_t> horizontal;
  Image<std::uint8_t> vertical;
};

/// Options of opening: what a user may state instead of letting the reader detect it
/// (`open_schema`), and what the caller wants.
struct OpenOptions {
  Flip flip = Flip::Auto;
  Units units = Units::Auto;
  std::string
      pattern{};  ///< Image grids: file name with {row} and {col} or {index}; empty = detect.
  std::string
      grid{};  ///< Rows and columns of views, "9x9", where files do not tell; empty = found.
  std::string crop{};  ///< Views to keep around the center, "9x9", or "all"; empty = all that are
                       ///< filled.
  Mosaic mosaic = Mosaic::Auto;
  double lenslet = 0;     ///< Mosaics of lenslets: pixels from one to the next; 0 = found.
  std::string dataset{};  ///< Files of several arrays: which holds the light field; empty = found.
  std::string axes{};     ///< Arrays: their axes in C order, as "vuyxc"; empty = found.
  int frame = 0;          ///< Sequences of light fields: which one, from 0.
  std::string levels{};   ///< Samples that are black and white, as stored: "0,1023"; empty = found.
  bool equalize = false;  ///< Bring all views to the brightness of the center view.
  /// Have methods use the brightness of the views as it is (EvenViews).
  bool keep_brightness = false;
  bool snake = false;   ///< Image grids: every second row was captured right to left.
  double focus_px = 0;  ///< Focus plane to bake in after reading (shear.h), px per view step.

  /// If false, truth and labels are not returned. Only the map of the center view is read, to
  /// determine units and the order of views.
  bool needs_truth = true;
  /// Called on the reading thread as soon as the center view is decoded.
  std::function<void(const Image<std::uint8_t>& center_rgb, const LightFieldInfo&, GridShape)>
      on_center_view{};
  /// Called on the reading thread once all views are there, and again once their order is known.
  std::function<void(CenterEpis)> on_center_epis{};

  [[nodiscard]] MapViews map_views() const {
    return needs_truth ? MapViews::All : MapViews::Center;
  }
};

/// Schema of the reading options, one row each. Command lines, dialogs, settings and result files
/// use it.
[[nodiscard]] Schema<OpenOptions> open_schema();

/// Reading options that differ from automatic, by key.
[[nodiscard]] ParameterSet given_options(const OpenOptions& options);

/// Options as a file stores them, those of earlier versions too: whole numbers of an option that
/// takes fractions become such.
[[nodiscard]] ParameterSet stored_options(ParameterSet options);

/// "7×7", for sentences.
[[nodiscard]] std::string grid_text(GridShape grid);

/// Parses rows and columns: "7x7", "1x49". Throws InvalidInput for anything else and for more than
/// 1,000,000 views.
[[nodiscard]] GridShape parse_grid(const std::string& text);

/// Value of the option `grid`; nothing if it was not given. Throws InvalidInput.
[[nodiscard]] std::optional<GridShape> given_grid(const OpenOptions& options);

/// One of several ways to read a light field.
struct ReadingChoice {
  std::string value;  ///< Of the option, as on a command line: "1x49".
  std::string label;  ///< In words: "49 views in a row".
};

/// Thrown for a light field that can be read in several ways, none of them certain: readers never
/// guess. The message names the option (`open_schema`) that decides; a window asks.
class Undecided : public IoError {
 public:
  /// `reason`: what is uncertain, and why. The message adds the option and its values.
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
