// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/input.h"
#include "app/cli/labeling_pictures.h"
#include "app/cli/output.h"
#include "app/cli/pictures.h"
#include "app/cli/result_input.h"
#include "app/cli/usage_error.h"
#include "app/cli/verbs.h"
#include "app/session/judgement.h"
#include "app/session/read_result.h"
#include "engine/io/grid/image_file.h"
#include "engine/io/labels/labeling_file.h"
#include "engine/render/color_map.h"

#include <algorithm>
#include <iostream>
#include <limits>

namespace episcope::cli {
namespace {

struct Request {
  std::string subject;
  std::string output;
  std::string what;
  std::string truth;
  PictureOptions picture;
  JobOptions job;
  ReadOptions read;

  /// Whether the subject is a result and not a light field.
  [[nodiscard]] bool is_result() const { return !truth.empty() || names_result(subject); }
  /// Whether it is a file of labels.
  [[nodiscard]] bool is_labeling() const { return io::is_labeling_file(subject); }
};

/// Options as typed.
struct Texts {
  std::string view;
  std::string row;
  std::string column;
  std::string range;
  std::string label = "1";
  std::string layer;
};

PictureOptions picture_options(const Texts& texts, const std::string& color_map) {
  constexpr int most = std::numeric_limits<int>::max();
  PictureOptions options;
  if (!texts.view.empty()) options.view = parse_view("--view", texts.view);
  if (!texts.row.empty()) options.row = parse_integer("--row", texts.row, 0, most);
  if (!texts.column.empty()) options.column = parse_integer("--column", texts.column, 0, most);
  if (!texts.range.empty()) options.range = parse_interval("--range", texts.range);
  options.label = parse_integer("--label", texts.label, 1, most);
  options.layer = texts.layer;
  options.color_map = color_map;
  if (options.row && options.column) {
    throw UsageError("show: --row and --column exclude each other");
  }
  return options;
}

bool parse(const VerbArguments& arguments, Request& request) {
  Texts texts;
  std::string color_map;
  Arguments parser("show", {"Writes a picture of a light field or of a result, as the window shows "
                            "it.",
                            "episcope-cli show demo.h5 -o error.png --what error"});
  parser.positional("INPUT|RESULT", request.subject, "A light field or a result");
  parser.required_option("-o,--output", request.output, "OUT.png", "Picture to write");
  parser.choice("--what", request.what,
                {"view", "epi", "disparity", "error", "confidence", "labels", "probability",
                 "uncertainty", "edges"},
                "By default the view of an INPUT, the disparity of a RESULT, the labels of a file "
                "of labels");
  parser.option("--view", texts.view, "V,U", "Camera row and column; by default the centre");
  parser.option("--row", texts.row, "Y", "Image row of a horizontal EPI");
  parser.option("--column", texts.column, "X", "Image column of a vertical EPI");
  parser.option("--range", texts.range, "A,B", "Values at the ends of the colour map");
  parser.choice("--colormap", color_map, render::color_map_names(), "Colour map");
  parser.option("--truth", request.truth, "INPUT",
                "Light field of a RESULT; by default the one that its file names");
  parser.choice("--layer", texts.layer, {"foreground", "background"},
                "Which disparity of a light field or result in two layers");
  parser.option("--label", texts.label, "N", "Label whose probability is shown (default 1)");
  if (!parse_reading(parser, arguments, request.job, request.read)) return false;
  request.picture = picture_options(texts, color_map);
  if (suffix_of(request.output) != ".png") {
    throw UsageError("show writes PNG, but the output is " + request.output + "; name it OUT.png");
  }
  if (!request.what.empty()) return true;
  if (request.is_labeling()) {
    request.what = "labels";
  } else {
    request.what = request.is_result() ? "disparity" : "view";
  }
  return true;
}

Picture scene_picture(const Request& request, const Scene& scene, const Progress& progress) {
  if (request.what == "view") return view_picture(scene, request.picture);
  if (request.what == "epi") return epi_picture(scene, request.picture);
  if (request.what == "disparity") return truth_picture(scene, request.picture);
  if (request.what == "labels") return labels_picture(scene, request.picture);
  if (request.what == "probability") return probability_picture(scene, request.picture);
  if (request.what == "edges") return edges_picture(scene, {}, request.picture, progress);
  throw UsageError("--what " + request.what + " needs a RESULT, but " + request.subject +
                   " is a light field");
}

/// The light field that belongs to the result: the one named, else the one its file names; empty if
/// there is none and the picture does without.
std::optional<Scene> scene_of(const Request& request, const Estimate& estimate,
                              const Progress& progress) {
  const std::string input =
      request.truth.empty() ? source_of(estimate, request.subject) : request.truth;
  if (!input.empty()) return load_input(input, request.read, progress);
  if (request.what == "disparity" || request.what == "confidence") return std::nullopt;
  throw IoError(request.subject,
                "the light field it was estimated from" +
                    (estimate.source.empty() ? " is not named in it"
                                             : ", " + estimate.source + ", is not there") +
                    "; name it with --truth INPUT");
}

Picture result_picture(const Request& request, Job& job) {
  std::optional<Scene> scene;
  if (!request.truth.empty()) {
    scene = load_input(request.truth, request.read, job.progress().part(0, 0.9));
  }
  const Estimate estimate = scene ? read_result_of(*scene->light_field, request.subject)
                                  : read_result_alone(request.subject);
  if (request.what == "confidence") return confidence_picture(estimate, request.picture);
  const bool has_own_range = request.what == "disparity" && request.picture.range;
  if (!scene && !has_own_range) scene = scene_of(request, estimate, job.progress().part(0, 0.9));
  if (request.what == "disparity") {
    return disparity_picture(estimate, scene ? &*scene : nullptr, request.picture);
  }
  if (request.what == "edges") {
    return edges_picture(*scene, estimate.field, request.picture, job.progress().part(0.9, 1));
  }
  if (request.what != "error") return scene_picture(request, *scene, job.progress().part(0.9, 1));
  const Judgement judgement = judge(estimate, *scene, {}, request.picture.view);
  note_other_source(estimate, *scene->light_field, job);
  return error_picture(judgement.evaluation, request.picture);
}

bool shows_labels(const std::string& what) {
  return what == "labels" || what == "probability" || what == "uncertainty";
}

Picture make_picture(const Request& request, Job& job) {
  if (request.is_labeling()) {
    if (!shows_labels(request.what)) {
      throw UsageError("--what " + request.what + " needs a light field or a RESULT, but " +
                       request.subject + " is a file of labels");
    }
    return labeling_picture(request.subject, request.what, request.picture);
  }
  if (request.what == "uncertainty") {
    throw UsageError("--what uncertainty needs a file of labels that 'label' wrote, but " +
                     request.subject + " is none");
  }
  if (request.is_result()) return result_picture(request, job);
  return scene_picture(request,
                       load_input(request.subject, request.read, job.progress().part(0, 0.9)),
                       job.progress().part(0.9, 1));
}

}  // namespace

void run_show(const VerbArguments& arguments, std::stop_token stop) {
  Request request;
  if (!parse(arguments, request)) return;
  check_output_file(request.output);
  protect_input(request.output, request.subject);
  if (!request.truth.empty()) protect_input(request.output, request.truth);
  if (!request.is_result() && (request.what == "error" || request.what == "confidence")) {
    throw UsageError("--what " + request.what + " needs a RESULT, but " + request.subject +
                     " is none");
  }

  Job job(std::move(stop), request.job);
  const Picture picture = make_picture(request, job);
  job.progress().check();
  io::write_png(request.output, picture.view());
  job.finish();
  std::cout << request.output << ": " << request.what << ", " << picture.width() << "×"
            << picture.height() << " px\n";
}

}  // namespace episcope::cli
