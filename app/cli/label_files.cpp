// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/label_files.h"

#include "engine/core/numbers.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/models/labels/color_table.h"
#include "engine/io/models/labels/label_import.h"

#include <algorithm>
#include <optional>
#include <sstream>

namespace episcope::cli {
namespace {

constexpr const char* kNone = "none";

/// Nothing where the text is empty. Throws UsageError.
std::optional<std::vector<std::int32_t>> ignored_ids(const std::string& text) {
  if (text.empty()) return std::nullopt;
  std::vector<std::int32_t> ids;
  if (text == kNone) return ids;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const auto number = io::parse_number(word);
    const auto id = number ? whole_int(*number) : std::nullopt;
    if (!id) {
      throw UsageError("--ignore is '" + text + "', but must be ids such as 255 or 0,255, or none");
    }
    ids.push_back(*id);
  }
  return ids;
}

std::vector<LabelInfo> color_table(const std::string& name) {
  if (name.empty()) return {};
  const auto& shared = io::shared_colors();
  const auto known = std::ranges::find(shared, name, &io::SharedColors::name);
  return known == shared.end() ? io::read_color_table(name) : known->labels;
}

}  // namespace

void declare_label_options(Arguments& parser, LabelFileOptions& options) {
  parser.option("--colors", options.colors, text_value("TABLE.csv|voc|cityscapes"),
                "What the colors of pictures mean: lines r,g,b,id,name, where id 0 is unlabeled; "
                "labelmap.txt of CVAT; or the table of VOC or Cityscapes. By default the "
                "labelmap.txt beside the pictures");
  parser.option("--ignore", options.ignored, text_value("ID,...|none"),
                "Ids that mean unlabeled, besides 0 and negative ones; by default 255 where all "
                "labels are smaller");
  parser.option("--first-label", options.first_label, integer_value("N", 0, 1),
                "0 = 0 is a label, as in trainIds of Cityscapes: all ids are raised by one");
}

void check_label_options(const Arguments& parser, const LabelFileOptions& options,
                         const std::string& option) {
  parser.check_uses(
      {{{"--colors", "--ignore", "--first-label"}, !options.file.empty(), "without " + option}});
  (void)ignored_ids(options.ignored);
}

Scribbles load_labels(const LabelFileOptions& options, const Scene& scene, Job& job,
                      const Progress& progress) {
  const bool is_own = io::has_own_labels(options.file);
  const bool has_names = is_own || suffix_of(options.file) == ".json";
  const auto refuse = [&](const char* option) {
    throw UsageError(std::string(option) + " has no effect on " + options.file +
                     ", which states what its labels are; leave it out");
  };
  if (!options.colors.empty() && has_names) refuse("--colors");
  if (!options.ignored.empty() && is_own) refuse("--ignore");
  if (options.first_label == 0 && has_names) refuse("--first-label");
  const io::LabelReading reading{.table = color_table(options.colors),
                                 .known = scene.scribbles.labels,
                                 .ignored = ignored_ids(options.ignored),
                                 .zero_is_label = options.first_label == 0,
                                 .prefers_truth = options.prefers_truth};
  io::ImportedLabels labels = io::read_labels({options.file}, scene, reading, progress);
  for (const std::string& note : labels.notes) job.note(note);
  return std::move(labels.scribbles);
}

}  // namespace episcope::cli
