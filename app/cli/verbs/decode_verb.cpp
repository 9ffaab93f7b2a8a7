// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments.h"
#include "app/cli/job.h"
#include "app/cli/output.h"
#include "app/cli/verbs/verbs.h"
#include "engine/capture/plenoptic/decode_files.h"
#include "engine/capture/plenoptic/processed_container.h"
#include "engine/capture/plenoptic/raw_picture.h"
#include "engine/core/finding.h"
#include "engine/core/text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <iostream>
#include <utility>
#include <vector>

namespace episcope::cli {
namespace {

constexpr int kMostViews = 63;

struct DecodeRequest {
  std::string raw;
  std::string white;
  std::string dark;
  std::string camera;
  std::string output;
  std::optional<capture::Mosaic> mosaic;
  capture::DecodeOptions options;
  bool is_json = false;
  Overwrite overwrite = Overwrite::No;
  JobOptions job;
};

/// A mosaic in capital or small letters.
OptionValue<capture::Mosaic> mosaic_value() {
  OptionValue<capture::Mosaic> mosaic = choice_of<capture::Mosaic>();
  mosaic.read = [read = mosaic.read](const std::string& option, const std::string& text) {
    return read(option, lower_case(text));
  };
  return mosaic;
}

bool parse(const VerbArguments& arguments, DecodeRequest& request) {
  Arguments parser(
      "decode",
      {"Makes a light field of a raw picture of a plenoptic camera: a container of a Lytro camera\n"
       "(.lfp, .lfr), its bare .raw with the JSON beside it, or any picture of a sensor behind an\n"
       "array of microlenses, square or hexagonal. The white picture is taken from the container\n"
       "or from beside it (NAME_white.png, white.png, caldata-*.tar, MOD_0000.RAW, data.C.0).\n"
       "Of a processed container (-stk.lfp, -dm.lfp), pictures and depth map are written into a\n"
       "new folder.",
       "episcope-cli decode IMG_0001.lfr --white caldata-A303134643.tar -o lf.h5\n"
       "  episcope-cli decode raw.png --white white.png --dark dark.png -o lf.h5"});
  parser.positional("RAW", request.raw, "The raw picture");
  parser.required_option("-o,--output", request.output, text_value("OUT.h5"),
                         "Light field to write; of a processed container, a new folder");
  parser.option("--white", request.white, text_value("FILE|FOLDER|TAR"),
                "White picture, or calibration data of the camera, of which the nearest is taken");
  parser.option("--dark", request.dark, text_value("FILE"), "Picture without light, subtracted");
  parser.option("--camera", request.camera, text_value("FILE"),
                "Optics of a laboratory camera: [sensor] pixel_size_x, [micro_lens] "
                "physical_size_s, [main_lens] f1, in mm");
  parser.option("--mosaic", request.mosaic, mosaic_value(),
                "Colors of the first pixels of a picture whose file does not tell (default gray)");
  parser.option("--views", request.options.views, integer_value("N", 1, kMostViews),
                "Views along each axis, odd (default: as many as a lens has room for)");
  parser.option("--step", request.options.step_px, real_value("PX", 0.25, 1e3),
                "Pixels between views below a lens (default 1, or a 15th of the lens's pitch)");
  parser.flag("--linear", request.options.is_linear, true, "Leave out the gamma of the camera");
  parser.flag("--json", request.is_json, "Print one JSON object instead of text");
  parser.flag("--overwrite", request.overwrite, Overwrite::Yes, "Replace an existing light field");
  declare_job_options(parser, request.job);
  if (!parser.parse(arguments)) return false;
  if (request.options.views % 2 == 0 && request.options.views > 0) {
    throw UsageError(fmt::format("--views is {}, but the center view needs an odd number",
                                 request.options.views));
  }
  return true;
}

Json answer(const capture::Decoded& decoded, const capture::RawPicture& raw,
            const std::string& output) {
  const LightField& field = *decoded.light_field;
  const capture::LensGrid& grid = decoded.grid;
  Json json;
  json["views"] = Json::object({{"v", field.grid().v}, {"u", field.grid().u}});
  json["width"] = field.width();
  json["height"] = field.height();
  json["lattice"] = capture::lattice_name(grid.lattice);
  json["pitch_px"] = grid.pitch_px;
  json["rotation_degrees"] = grid.rotation_degrees;
  json["residual_px"] = grid.residual_px;
  json["lenses"] = grid.lenses;
  json["lenses_left_out"] = grid.measured - grid.lenses;
  json["step_px"] = decoded.step_px;
  json["valid_percent"] = decoded.valid_percent;
  json["hot_pixels"] = decoded.hot_pixels;
  json["sharpness"] = decoded.sharpness;
  json["samples"] = decoded.is_gamma_encoded ? "gamma-encoded" : "linear";
  Json facts = Json::object();
  for (const auto& [key, value] : raw.facts.table()) facts[key] = value;
  json["camera"] = std::move(facts);
  json["output"] = output;
  return json;
}

void print(const capture::Decoded& decoded, const capture::RawPicture& raw,
           const std::string& output) {
  const LightField& field = *decoded.light_field;
  const capture::LensGrid& grid = decoded.grid;
  std::cout << fmt::format(
      "{}: {}×{} views of {}×{} px, {} samples\n"
      "{} lenses: pitch {:.3f} px, turned by {:.3f}°; {} lenses fit the grid to {:.3f} px rms, {} "
      "do not\n"
      "views {:.3g} px apart, {:.1f} % of their samples valid, {} hot pixels replaced, sharpness "
      "{:.3f}\n",
      output, field.grid().v, field.grid().u, field.width(), field.height(),
      decoded.is_gamma_encoded ? "gamma-encoded" : "linear", capture::lattice_name(grid.lattice),
      grid.pitch_px, grid.rotation_degrees, grid.lenses, grid.residual_px,
      grid.measured - grid.lenses, decoded.step_px, decoded.valid_percent, decoded.hot_pixels,
      decoded.sharpness);
  for (const auto& [key, value] : raw.facts.table()) std::cout << key << ": " << value << '\n';
}

void check_outputs(const DecodeRequest& request) {
  check_hdf5_output("decode", request.output);
  check_light_field_output(request.output, request.overwrite);
}

/// Tells which options do nothing for processed pictures.
void note_ignored(const DecodeRequest& request, Job& job) {
  const std::pair<const char*, bool> given[] = {
      {"white", !request.white.empty()},    {"dark", !request.dark.empty()},
      {"camera", !request.camera.empty()},  {"mosaic", request.mosaic.has_value()},
      {"views", request.options.views > 0}, {"step", request.options.step_px > 0},
      {"linear", request.options.is_linear}};
  for (const auto& [option, is_given] : given) {
    if (!is_given) continue;
    job.note(fmt::format(finding_text("option.ignored"), option, "a processed picture"));
  }
}

/// Of a container without a raw picture; false for any other file.
bool write_processed(const DecodeRequest& request, Job& job) {
  if (!capture::is_lfp_container(request.raw)) return false;
  const auto container = capture::read_processed(request.raw);
  if (!container) return false;
  if (std::filesystem::path(request.output).has_extension()) {
    throw UsageError(
        fmt::format("{} holds {}, which are written into a new folder; name one with -o",
                    request.raw, container->text()));
  }
  note_ignored(request, job);
  const std::vector<std::string> written =
      capture::write_processed(request.output, *container, job.progress());
  job.finish();
  if (!request.is_json) {
    std::cout << request.output << ": " << container->text() << '\n';
    for (const std::string& file : written) std::cout << file << '\n';
    return true;
  }
  Json json;
  json["pictures"] = container->pictures.size();
  json["maps"] = Json::array();
  for (const capture::ProcessedMap& map : container->maps) json["maps"].push_back(map.name);
  json["output"] = request.output;
  print_answer(std::move(json), job.notes(), written);
  return true;
}

}  // namespace

void run_decode(const VerbArguments& arguments, std::stop_token stop) {
  DecodeRequest request;
  if (!parse(arguments, request)) return;
  Job job(std::move(stop), request.job);
  job.progress().step("reading " + request.raw);
  if (write_processed(request, job)) return;
  check_outputs(request);
  const capture::FoundPictures found = capture::read_pictures(
      {request.raw, request.white, request.dark, request.camera, request.mosaic});
  for (const std::string& note : found.notes) job.note(note);
  const capture::LensGrid grid =
      capture::find_lenses(found.pictures, job.progress().part(0.1, 0.4));
  const capture::Decoded decoded =
      capture::decode(found.pictures, grid, request.options, job.progress().part(0.4, 0.85));
  for (const std::string& warning : decoded.warnings) job.note(warning);
  capture::write_decoded(request.output, decoded, found, job.progress().part(0.85, 1));
  job.finish();
  const capture::RawPicture& raw = found.pictures.raw;
  if (request.is_json) {
    return print_answer(answer(decoded, raw, request.output), job.notes(), {request.output});
  }
  print(decoded, raw, request.output);
}

}  // namespace episcope::cli
