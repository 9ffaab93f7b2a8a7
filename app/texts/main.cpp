// SPDX-License-Identifier: BSD-3-Clause
// episcope_texts SOURCES: prints the texts of the engine that the window shows, for lupdate.
#include "app/texts/sentences.h"
#include "engine/capture/calibrate/pattern.h"
#include "engine/capture/rectify/rectify.h"
#include "engine/core/light_field/scene.h"
#include "engine/disparity/registry.h"
#include "engine/io/open/open_options.h"
#include "engine/io/order/view_order.h"
#include "engine/labeling/labeler_parameters.h"
#include "engine/render/quantity.h"
#include "engine/scenes/builtin.h"
#include "engine/scenes/random/kinds.h"

#include <cstdint>
#include <exception>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

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
    add(texts, estimator.parameters);
  }
  add(texts, labeler_schema().descriptions());
  add(texts, io::open_schema().descriptions());
  add(texts, capture::pattern_schema().descriptions());
  add(texts, capture::rectify_schema().descriptions());
  for (const auto& scene : scenes::builtin_scenes()) add(texts, scene.summary);
  for (const std::string& kind : scenes::random_kind_names()) add(texts, kind);
  add_sample_texts<std::uint8_t, std::uint16_t, float>(texts);
  for (const bool v : {false, true}) {
    for (const bool u : {false, true}) add(texts, io::flip_text({u, v}));
  }
  for (const CompanionKind kind :
       {CompanionKind::EdgeProbabilities, CompanionKind::ImageProbabilities,
        CompanionKind::DepthProbabilities, CompanionKind::TrueDepthProbabilities}) {
    add(texts, companion_name(kind));
  }
  return texts;
}

Texts quantity_texts() {
  Texts texts;
  for (const render::QuantityInfo& each : render::quantities()) {
    for (const char* text : {each.button, each.label, each.tip, each.unit}) add(texts, text);
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
    texts.merge(literal_sentences(std::filesystem::path(argv[1]) / "engine"));
    std::cout << "// SPDX-License-Identifier: BSD-3-Clause\n"
                 "// Texts of the engine, for lupdate. Made by episcope_texts (README.md).\n";
    print("episcope::Schema", texts);
    print("episcope::render", quantity_texts());
    return std::cout.flush() ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "episcope_texts: " << error.what() << '\n';
    return 1;
  }
}
