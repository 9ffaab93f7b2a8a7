// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments/arguments.h"
#include "app/cli/arguments/usage_error.h"
#include "app/cli/input/shown_map.h"
#include "app/cli/output/output_file.h"
#include "app/cli/verbs/verbs.h"
#include "app/session/picture/picture.h"
#include "app/session/run/read_result.h"
#include "engine/core/text/suffix.h"
#include "engine/io/grid/image_file.h"
#include "engine/io/labels/labeling_file.h"

#include <iostream>
#include <limits>

namespace episcope::cli {
namespace {

using render::Quantity;

constexpr const char* kEpi = "epi";

struct Request {
  std::string output;
  std::string what;
  ShownMap map;
  std::optional<int> row;
  std::optional<int> column;
  ShadingChoice shading;
  std::optional<double> opacity;  ///< Over the view; empty = the map by itself.
  JobOptions job;
  ReadOptions read;
};

/// Options as typed.
struct Texts {
  std::string view;
  std::string row;
  std::string column;
  std::string range;
  std::string label = "1";
  std::string layer;
  std::string opacity;
};

void parse_texts(const Texts& texts, Request& request) {
  constexpr int most = std::numeric_limits<int>::max();
  if (!texts.view.empty()) request.map.view = parse_view("--view", texts.view);
  if (!texts.row.empty()) request.row = parse_integer("--row", texts.row, 0, most);
  if (!texts.column.empty()) request.column = parse_integer("--column", texts.column, 0, most);
  if (!texts.range.empty()) request.shading.range = parse_interval("--range", texts.range);
  if (!texts.opacity.empty()) request.opacity = parse_real("--over-view", texts.opacity, 0, 1);
  request.map.needs_light_field = request.opacity.has_value();
  request.map.label = parse_integer("--label", texts.label, 1, most);
  if (request.row && request.column) {
    throw UsageError("show: --row and --column exclude each other");
  }
  if (suffix_of(request.output) != ".png") {
    throw UsageError("show writes PNG, but the output is " + request.output + "; name it OUT.png");
  }
}

ShownKind kind_of(const Request& request) {
  if (io::is_labeling_file(request.map.subject)) return ShownKind::Labels;
  const bool is_result = !request.map.truth.empty() || names_result(request.map.subject);
  return is_result ? ShownKind::Result : ShownKind::LightField;
}

/// "disparity" and "labels" are those of what is shown: true ones of a light field.
Quantity quantity_of(const std::string& what, ShownKind kind, bool is_behind) {
  if (what.empty()) {
    if (kind == ShownKind::Labels) return Quantity::Segmentation;
    return kind == ShownKind::Result ? Quantity::Disparity : Quantity::View;
  }
  const Quantity named = render::find_quantity(what)->quantity;
  if (named == Quantity::Labels && kind == ShownKind::Labels) return Quantity::Segmentation;
  const bool is_true =
      named == Quantity::Truth || (named == Quantity::Disparity && kind == ShownKind::LightField);
  if (is_true) return is_behind ? Quantity::TruthBackground : Quantity::Truth;
  return named == Quantity::Disparity && is_behind ? Quantity::Background : named;
}

std::vector<std::string> choices() {
  std::vector<std::string> ids{kEpi};
  for (const auto& info : render::quantities()) ids.emplace_back(info.id);
  return ids;
}

bool parse(const VerbArguments& arguments, Request& request) {
  Texts texts;
  Arguments parser("show",
                   {"Writes a picture of a light field, of a result or of labels, as the window "
                    "shows it.",
                    "episcope-cli show demo.h5 -o error.png --what error"});
  parser.positional("INPUT|RESULT", request.map.subject, "A light field, a result, or labels");
  parser.required_option("-o,--output", request.output, "OUT.png", "Picture to write");
  parser.choice("--what", request.what, choices(),
                "By default the view of an INPUT, the disparity of a RESULT, the labels of a file "
                "of labels");
  parser.option("--view", texts.view, "V,U", "Camera row and column; by default the centre");
  parser.option("--row", texts.row, "Y", "Image row of a horizontal EPI");
  parser.option("--column", texts.column, "X", "Image column of a vertical EPI");
  parser.option("--range", texts.range, "A,B", "Values at the ends of the colour map");
  parser.choice("--colormap", request.shading.color_map, render::color_map_names(), "Colour map");
  parser.option("--truth", request.map.truth, "INPUT",
                "Light field of a RESULT; by default the one that its file names");
  parser.choice("--layer", texts.layer, {"foreground", "background"},
                "Which disparity of a light field or result in two layers");
  parser.option("--label", texts.label, "N", "Label whose probability is shown (default 1)");
  parser.option("--minus", request.map.minus, "RESULT", "For a difference: what is subtracted");
  parser.option("--over-view", texts.opacity, "OPACITY",
                "Lay the map over the view, with an opacity from 0 to 1");
  if (!parse_reading(parser, arguments, request.job, request.read)) return false;
  parse_texts(texts, request);
  request.map.kind = kind_of(request);
  const bool is_epi = request.what == kEpi;
  request.map.quantity =
      quantity_of(is_epi ? "view" : request.what, request.map.kind, texts.layer == "background");
  if (request.what.empty()) {
    const bool is_of_labels = request.map.kind == ShownKind::Labels;
    request.what = render::info_of(is_of_labels ? Quantity::Labels : request.map.quantity).id;
  }
  return true;
}

RgbaImage epi_picture(const Request& request, const LightField& light_field, ViewIndex view) {
  if (request.column) return vertical_epi_picture(light_field, view, *request.column);
  return horizontal_epi_picture(light_field, view, request.row.value_or(light_field.height() / 2));
}

RgbaImage make_picture(const Request& request, Job& job) {
  const LoadedMap loaded = load_map(request.map, request.read, job);
  const MapSource& source = loaded.source;
  job.progress().check();
  if (request.what == kEpi) return epi_picture(request, *source.light_field, source.view);
  if (source.quantity == Quantity::View) {
    return render::shade_view(*source.light_field, source.view);
  }
  const auto shading = shading_of(source.quantity, loaded.disparity_range, request.shading);
  const QuantityMapPtr map = make_map(source);
  if (!request.opacity) return map_picture(*map, shading);
  return blended(render::shade_view(*source.light_field, source.view),
                 overlay_picture(*map, shading), *request.opacity);
}

}  // namespace

void run_show(const VerbArguments& arguments, std::stop_token stop) {
  Request request;
  if (!parse(arguments, request)) return;
  check_output_file(request.output);
  for (const std::string& input : {request.map.subject, request.map.truth, request.map.minus}) {
    if (!input.empty()) protect_input(request.output, input);
  }

  Job job(std::move(stop), request.job);
  const RgbaImage picture = make_picture(request, job);
  job.progress().check();
  io::write_png(request.output, picture.view());
  job.finish();
  std::cout << request.output << ": " << request.what << ", " << picture.width() << "×"
            << picture.height() << " px\n";
}

}  // namespace episcope::cli
