// SPDX-License-Identifier: BSD-3-Clause
// episcope_texts SOURCES: prints the English texts that the engine holds and the window shows, in a
// form that Qt's lupdate reads. They come from tables and schemas, and from literal sentences in
// SOURCES/engine and SOURCES/app/session.
#include "app/session/scene_summary.h"
#include "engine/capture/calibrate.h"
#include "engine/capture/rectify.h"
#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/scene.h"
#include "engine/disparity/registry.h"
#include "engine/io/models/open_options.h"
#include "engine/io/models/order/view_axes.h"
#include "engine/labeling/labeler.h"
#include "engine/render/quantity.h"
#include "engine/scenes/builtin.h"
#include "engine/scenes/plan.h"

#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace episcope {
namespace {

bool is_source(const std::filesystem::path& path) {
  return path.extension() == ".cpp" || path.extension() == ".cu";
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw IoError(path, "cannot be read");
  return text;
}

// What sources below `folder` say literally of the step of a job (`progress.step("denoising")`)
// and of why there is no GPU (`device.why_not = "…"`); sentences composed of data are left out. As
// in the source: escapes stay as they are. Throws IoError if a source cannot be read.
std::set<std::string> literal_sentences(const std::filesystem::path& folder) {
  static const std::regex sentence(
      R"re((?:[.]step\(|[.](?:step|why_not|format|order|order_check|sign_check|units|units_check|gain) = ))re"
      R"re("((?:[^"\\]|\\.)*)"[;)])re");
  std::set<std::string> sentences;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!is_source(entry.path())) continue;
    const std::string text = text_of(entry.path());
    for (std::sregex_iterator match(text.begin(), text.end(), sentence), end; match != end;
         ++match) {
      sentences.insert((*match)[1]);
    }
  }
  return sentences;
}

}  // namespace
}  // namespace episcope

namespace {

using namespace episcope;

// As in C++ sources, between quotes.
using Texts = std::set<std::string>;

std::string escaped(const std::string& text) {
  std::string literal;
  for (const char each : text) {
    if (each == '"' || each == '\\') literal += '\\';
    literal += each == '\n' ? std::string("\\n") : std::string(1, each);
  }
  return literal;
}

void add(Texts& texts, const std::string& text) {
  if (!text.empty()) texts.insert(escaped(text));
}

void add(Texts& texts, const std::vector<ParameterDescription>& parameters) {
  for (const ParameterDescription& each : parameters) {
    add(texts, each.label);
    add(texts, each.help);
    add(texts, each.unit);
    for (const auto& label : each.choice_labels.empty() ? each.choices : each.choice_labels) {
      add(texts, label);
    }
  }
}

// How samples of these types are taken.
template <class... T>
void add_sample_texts(Texts& texts) {
  (add(texts, stored_samples_text(ViewStack<T>({1, 1}, 1, 1))), ...);
}

Texts schema_texts() {
  Texts texts;
  for (const Estimator& estimator : registered_estimators()) {
    add(texts, estimator.info.summary);
    if (estimator.info.reference.starts_with("Own")) add(texts, estimator.info.reference);
    add(texts, estimator.parameters);
  }
  add(texts, labeler_schema().descriptions());
  add(texts, io::open_schema().descriptions());
  add(texts, capture::pattern_schema().descriptions());
  add(texts, capture::rectify_schema().descriptions());
  for (const auto& scene : scenes::builtin_scenes()) add(texts, scene.summary);
  for (const std::string& kind : all_names<scenes::RandomKind>()) add(texts, kind);
  add_sample_texts<std::uint8_t, std::uint16_t, float>(texts);
  for (const bool v : {false, true}) {
    for (const bool u : {false, true}) add(texts, io::flip_text({u, v}));
  }
  for (const CompanionKind kind :
       {CompanionKind::EdgeProbabilities, CompanionKind::ImageProbabilities,
        CompanionKind::DepthProbabilities, CompanionKind::TrueDepthProbabilities}) {
    add(texts, companion_name(kind));
  }
  // What readers count (FileUse).
  for (const char* each : {"depth maps",
                           "depth maps of the center view",
                           "disparity maps",
                           "disparity maps of the center view",
                           "label files",
                           "label maps",
                           "label maps of the center view",
                           "label pictures",
                           "light field",
                           "manifest",
                           "masks of invalid pixels",
                           "masks of valid pixels",
                           "mosaics",
                           "parameter files",
                           "pose files",
                           "region masks",
                           "results",
                           "scribble files",
                           "segmentations",
                           "views"}) {
    add(texts, each);
    add(texts, singular_kind(each));
  }
  add(texts, kNotEnoughMemory);
  add(texts, kUnknownFailure);
  return texts;
}

Texts quantity_texts() {
  Texts texts;
  for (const render::QuantityInfo& each : render::quantities()) {
    for (const char* text : {each.button, each.label, each.tip, each.unit}) add(texts, text);
  }
  return texts;
}

Texts finding_texts() {
  Texts texts;
  for (const FindingText& each : kFindingTexts) {
    add(texts, numbered(each.english));
    add(texts, std::string(each.brief));
  }
  return texts;
}

void print(const char* context, const Texts& texts) {
  for (const std::string& text : texts) {
    std::cout << "QT_TRANSLATE_NOOP(\"" << context << "\", \"" << text << "\")\n";
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 2) throw std::runtime_error("usage: episcope_texts SOURCES");
    Texts texts = schema_texts();
    for (const char* folder : {"engine", "app/session"}) {
      texts.merge(literal_sentences(std::filesystem::path(argv[1]) / folder));
    }
    print("episcope::Schema", texts);
    print("episcope::render", quantity_texts());
    print("episcope::Finding", finding_texts());
    return std::cout.flush() ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "episcope_texts: " << error.what() << '\n';
    return 1;
  }
}
