// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/labels/label_pictures.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/models/labels/color_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr int kRgba = 4;

std::string stem_of(ViewIndex view) {
  return fmt::format("scribbles_{:02}_{:02}", view.v, view.u);
}

template <class T>
void write_ids(const fs::path& path, const Image<std::int32_t>& labels) {
  Image<T> ids(labels.height(), labels.width());
  std::ranges::transform(labels, ids.begin(), [](std::int32_t id) { return static_cast<T>(id); });
  write_png(path, ids.view());
}

Image<std::uint8_t> preview(const Image<std::int32_t>& labels,
                            const std::vector<LabelInfo>& known) {
  Image<std::uint8_t> picture(labels.height(), labels.width(), kRgba);
  std::uint8_t* pixel = picture.data();
  for (const std::int32_t id : labels) {
    if (id > 0) {
      const auto label = std::ranges::find(known, id, &LabelInfo::id);
      const Rgb color = label == known.end() ? label_color(id) : label->color;
      std::ranges::copy(color, pixel);
      pixel[kRgba - 1] = 255;
    }
    pixel += kRgba;
  }
  return picture;
}

}  // namespace

std::vector<fs::path> write_scribble_pictures(const fs::path& folder, const Scribbles& scribbles) {
  std::vector<fs::path> written;
  for (const auto& [view, labels] : scribbles.views) {
    const std::string stem = stem_of(view);
    written.push_back(folder / (stem + ".png"));
    const bool fits_byte = std::ranges::all_of(labels, [](std::int32_t id) { return id <= 255; });
    if (fits_byte) {
      write_ids<std::uint8_t>(written.back(), labels);
    } else {
      write_ids<std::uint16_t>(written.back(), labels);
    }
    written.push_back(folder / (stem + "_preview.png"));
    write_picture(written.back(), preview(labels, scribbles.labels).view());
  }
  return written;
}

std::optional<ViewIndex> view_of_scribble_picture(const std::string& name) {
  static const std::regex pattern("scribbles_([0-9]{2,5})_([0-9]{2,5})\\.png");
  std::smatch found;
  if (!std::regex_match(name, found, pattern)) return std::nullopt;
  return ViewIndex{std::stoi(found[1]), std::stoi(found[2])};
}

bool ViewPicture::is_painted(int y, int x) const {
  constexpr std::uint8_t kOpaque = 128;  // from here on a pixel is painted
  return picture.alpha.empty() || picture.alpha.at(y, x) >= kOpaque;
}

Rgb ViewPicture::color(int y, int x) const {
  const std::uint8_t* pixel = &picture.colors.at(y, x);
  return {pixel[0], pixel[1], pixel[2]};
}

namespace {

/// Calls `visit(y, x)` for each pixel that is painted, or for each that is not.
template <class Visit>
void for_pixels(const ViewPicture& one, bool are_painted, const Visit& visit) {
  for (int y = 0; y < one.picture.height(); ++y) {
    for (int x = 0; x < one.picture.width(); ++x) {
      if (one.is_painted(y, x) == are_painted) visit(y, x);
    }
  }
}

/// How often each color, or each number, is painted.
template <class Key>
struct PixelCensus {
  std::map<Key, std::size_t> counts;
  std::size_t transparent = 0;
  std::size_t ignored = 0;  ///< Pixels that were marked by 0.

  void take_ignored(std::size_t pixels) {
    ignored = std::min(counts[Key{}], pixels);
    counts[Key{}] -= ignored;
    if (counts[Key{}] == 0) counts.erase(Key{});
  }
  [[nodiscard]] std::size_t all() const {
    std::size_t sum = transparent + ignored;
    for (const auto& [key, count] : counts) sum += count;
    return sum;
  }
};

std::string share_text(std::size_t count, std::size_t all) {
  return fmt::format("{:.4g} % of the pixels",
                     100.0 * static_cast<double>(count) / static_cast<double>(all));
}

std::string ground_text(const std::string& ground, std::size_t transparent, std::size_t all) {
  const std::string seen_through =
      transparent > 0 ? "transparent pixels (" + share_text(transparent, all) + ")" : "";
  if (ground.empty() && seen_through.empty()) return "every pixel is painted";
  const bool has_both = !ground.empty() && !seen_through.empty();
  return ground + (has_both ? " and " : "") + seen_through +
         (has_both || !seen_through.empty() ? " are" : " is") + " unpainted";
}

/// "1 = #00ff00 (sky)": the name only if it says more.
std::string label_text(const LabelInfo& label) {
  const std::string color = color_text(label.color);
  return fmt::format("{} = {}{}", label.id, color,
                     label.name == color || label.name.empty() ? "" : " (" + label.name + ")");
}

/// The colors of a palette in place of its indices.
void resolve_palette(LabelPicture& picture) {
  picture.colors = Image<std::uint8_t>(picture.height(), picture.width(), 3);
  std::uint8_t* pixel = picture.colors.data();
  for (const std::int32_t index : picture.numbers) {
    const auto place = std::min(static_cast<std::size_t>(index), picture.palette.size() - 1);
    pixel = std::ranges::copy(picture.palette[place], pixel).out;
  }
  picture.numbers = {};
  picture.palette.clear();
}

bool is_gray(const LabelPicture& picture) {
  const Image<std::uint8_t>& colors = picture.colors;
  for (std::size_t i = 0; i < colors.size(); i += 3) {
    const std::uint8_t* pixel = colors.data() + i;
    if (pixel[0] != pixel[1] || pixel[0] != pixel[2]) return false;
  }
  return true;
}

/// Levels in place of colors that are gray.
void take_levels(LabelPicture& picture) {
  if (picture.colors.empty()) return;
  picture.numbers = Image<std::int32_t>(picture.height(), picture.width());
  const std::uint8_t* pixel = picture.colors.data();
  for (std::int32_t& level : picture.numbers) level = std::exchange(pixel, pixel + 3)[0];
  picture.colors = {};
}

/// With a table, colors and palettes are colors; without, pictures that are all gray are numbers.
void settle_kinds(std::vector<ViewPicture>& pictures, bool has_table) {
  for (ViewPicture& one : pictures) {
    if (has_table && !one.picture.palette.empty()) resolve_palette(one.picture);
  }
  const auto are_gray = [](const ViewPicture& one) { return is_gray(one.picture); };
  if (has_table || !std::ranges::all_of(pictures, are_gray)) return;
  for (ViewPicture& one : pictures) take_levels(one.picture);
}

[[noreturn]] void refuse_colors(const fs::path& path, const std::string& count) {
  throw IoError(path, fmt::format("has {} colors, but labels have one each, at most {}; draw "
                                  "strokes with a hard brush on a ground of one color, and save "
                                  "labels as PNG",
                                  count, kMostLabelColors));
}

PixelCensus<Rgb> count_colors(const std::vector<ViewPicture>& pictures, const fs::path& path) {
  constexpr std::size_t kEnough = 4096;  // nobody draws so many by hand
  PixelCensus<Rgb> census;
  for (const ViewPicture& one : pictures) {
    for_pixels(one, true, [&](int y, int x) {
      ++census.counts[one.color(y, x)];
      if (census.counts.size() > kEnough) refuse_colors(path, fmt::format("over {}", kEnough));
    });
    for_pixels(one, false, [&](int, int) { ++census.transparent; });
  }
  const std::size_t count = census.counts.size();
  if (count > kMostLabelColors + 1) refuse_colors(path, std::to_string(count));
  return census;
}

/// Labels of the colors by their ids in `list`, if it has all of them.
std::optional<std::vector<LabelInfo>> all_known(const std::vector<Rgb>& colors,
                                                const std::vector<LabelInfo>& list) {
  std::vector<LabelInfo> found;
  for (const Rgb& color : colors) {
    const auto known = std::ranges::find(list, color, &LabelInfo::color);
    if (known == list.end()) return std::nullopt;
    found.push_back(*known);
  }
  return found;
}

std::vector<LabelInfo> usual_labels() {
  constexpr int kCount = 20;
  std::vector<LabelInfo> labels;
  for (int id = 1; id <= kCount; ++id) {
    labels.push_back(default_label(id));
  }
  return labels;
}

/// Colors that tell more than that somebody took red or blue.
bool are_telling(const SharedColors& table, const std::vector<Rgb>& colors) {
  constexpr std::ptrdiff_t kFewest = 3;
  const auto labels =
      std::ranges::count_if(colors, [](const Rgb& color) { return color != Rgb{}; });
  return table.name == "voc" || labels >= kFewest;
}

/// What colors without a table stand for: labels of the light field, else the usual ones.
struct KnownColors {
  std::vector<LabelInfo> labels;
  std::string title;  ///< Of what others have, too.
};

std::optional<KnownColors> known_labels(const std::vector<Rgb>& colors,
                                        const LabelReading& labels) {
  if (const auto found = all_known(colors, labels.known)) return KnownColors{*found, {}};
  if (const auto found = all_known(colors, usual_labels())) return KnownColors{*found, {}};
  for (const SharedColors& table : shared_colors()) {
    const auto found = all_known(colors, table.labels);
    if (found && are_telling(table, colors)) return KnownColors{*found, table.title};
  }
  return std::nullopt;
}

/// The color that is unpainted; none where pixels are transparent, where the table names it, and
/// where every color is one of a known label.
std::optional<Rgb> find_ground(const PixelCensus<Rgb>& census, const LabelReading& labels) {
  const std::vector<LabelInfo>& table = labels.table;
  const auto has_zero = std::ranges::find(table, 0, &LabelInfo::id) != table.end();
  if (census.transparent > 0 || has_zero || census.counts.empty()) return std::nullopt;
  std::vector<Rgb> colors;
  for (const auto& [color, count] : census.counts) colors.push_back(color);
  if (table.empty() && known_labels(colors, labels)) return std::nullopt;
  const Rgb most = std::ranges::max_element(census.counts, {}, [](const auto& each) {
                     return each.second;
                   })->first;
  const bool is_label = std::ranges::find(table, most, &LabelInfo::color) != table.end();
  return is_label ? std::nullopt : std::optional(most);
}

std::vector<LabelInfo> labels_of(const std::vector<Rgb>& colors, const PixelCensus<Rgb>& census,
                                 const LabelReading& labels, const fs::path& path) {
  if (!labels.table.empty()) {
    if (const auto found = all_known(colors, labels.table)) return *found;
    const auto missing = std::ranges::find_if(colors, [&](const Rgb& color) {
      return std::ranges::find(labels.table, color, &LabelInfo::color) == labels.table.end();
    });
    throw IoError(path, fmt::format("has {} px of the color {} ({},{},{}), which the table of "
                                    "colors lacks; add it, with id 0 if it is unpainted",
                                    census.counts.at(*missing), color_text(*missing), (*missing)[0],
                                    (*missing)[1], (*missing)[2]));
  }
  if (const auto found = known_labels(colors, labels)) return found->labels;
  std::vector<LabelInfo> counted;
  for (const Rgb& color : colors) {
    const int id = static_cast<int>(counted.size()) + 1;
    counted.push_back({id, color_text(color), color});
  }
  return counted;
}

/// Labels by id, each once.
std::vector<LabelInfo> distinct(std::vector<LabelInfo> labels) {
  std::erase_if(labels, [](const LabelInfo& label) { return label.id == 0; });
  std::ranges::stable_sort(labels, {}, &LabelInfo::id);
  const auto is_same = [](const LabelInfo& a, const LabelInfo& b) { return a.id == b.id; };
  labels.erase(std::unique(labels.begin(), labels.end(), is_same), labels.end());
  return labels;
}

/// "#ffffff, #000000 (93 % of the pixels)" of the colors that are no labels.
std::string ground_of(const PixelCensus<Rgb>& census, const std::map<Rgb, int>& ids) {
  std::vector<Rgb> unpainted;
  std::size_t pixels = 0;
  for (const auto& [color, count] : census.counts) {
    if (ids.at(color) != 0) continue;
    unpainted.push_back(color);
    pixels += count;
  }
  if (unpainted.empty()) return {};
  return joined(unpainted, ", ", color_text) + " (" + share_text(pixels, census.all()) + ")";
}

ImportedLabels strokes_of_colors(const std::vector<ViewPicture>& pictures,
                                 const LabelReading& labels, const fs::path& path) {
  const PixelCensus<Rgb> census = count_colors(pictures, path);
  const std::optional<Rgb> ground = find_ground(census, labels);
  std::vector<Rgb> colors;
  for (const auto& [color, count] : census.counts) {
    if (color != ground) colors.push_back(color);
  }
  const std::vector<LabelInfo> found = labels_of(colors, census, labels, path);
  std::map<Rgb, int> ids;
  if (ground) ids[*ground] = 0;
  const std::vector<std::int32_t> ignored = labels.ignored.value_or(std::vector<std::int32_t>{});
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const bool is_ignored = std::ranges::find(ignored, found[i].id) != ignored.end();
    ids[colors[i]] = is_ignored ? 0 : found[i].id;
  }
  ImportedLabels strokes;
  for (const ViewPicture& one : pictures) {
    Image<std::int32_t> painted(one.picture.height(), one.picture.width());
    for_pixels(one, true, [&](int y, int x) { painted.at(y, x) = ids.at(one.color(y, x)); });
    strokes.scribbles.views.push_back({one.view, std::move(painted)});
  }
  strokes.scribbles.labels = distinct(found);
  const std::string name = path.string() + ": ";
  strokes.notes = {
      name + "a label is a color: " + joined(strokes.scribbles.labels, ", ", label_text),
      name + ground_text(ground_of(census, ids), census.transparent, census.all())};
  if (!labels.table.empty()) return strokes;
  const auto usual = known_labels(colors, labels);
  if (!usual) {
    strokes.notes.push_back(name +
                            "the numbers of its labels follow the codes of the colors, which may "
                            "not be those of other labels; a table of colors states them");
  } else if (!usual->title.empty()) {
    strokes.notes.push_back(name + "the labels have the numbers of " + usual->title);
  }
  return strokes;
}

/// Names of the numbers that are painted: of the table, else of the light field; colors are those
/// of the palette. Empty where none of these says anything.
std::vector<LabelInfo> labels_of(const PixelCensus<std::int32_t>& census,
                                 const LabelPicture& picture, const LabelReading& labels) {
  std::vector<LabelInfo> found;
  if (picture.palette.empty() && labels.table.empty() && labels.stated.empty()) return found;
  for (const auto& [id, count] : census.counts) {
    if (id == 0) continue;
    LabelInfo label = default_label(id);
    const std::int32_t stored = id - (labels.zero_is_label ? 1 : 0);
    const auto place = static_cast<std::size_t>(stored);
    if (place < picture.palette.size()) {
      label.color = picture.palette[place];
      label.name = color_text(label.color);
    }
    for (const auto& [list, its_id] : {std::pair(&labels.known, id), {&labels.table, stored}}) {
      const auto known = std::ranges::find(*list, its_id, &LabelInfo::id);
      if (known != list->end()) label.name = known->name;
    }
    const auto stated = std::ranges::find(labels.stated, id, &LabelInfo::id);
    if (stated != labels.stated.end()) label = *stated;
    const auto named = std::ranges::find(labels.palette_names, label.color, &LabelInfo::color);
    if (named != labels.palette_names.end()) label.name = named->name;
    found.push_back(std::move(label));
  }
  return found;
}

/// Pixels that are unlabeled for another number than 0, and a sentence about those that are not
/// negative.
struct Unlabeled {
  std::size_t pixels = 0;
  std::string sentence{};
};

/// Marks unlabeled numbers by 0, and raises the others if 0 is a label.
Unlabeled mark_unlabeled(std::vector<ViewPicture>& pictures, const LabelReading& labels) {
  constexpr std::int32_t kVoid = 255;
  std::map<std::int32_t, std::size_t> counts;
  std::size_t all = 0;
  for (const ViewPicture& one : pictures) {
    std::int32_t last = 0;
    std::size_t* count = &counts[last];
    for (const std::int32_t id : one.picture.numbers) {
      if (id != last) count = &counts[last = id];
      ++*count;
    }
    all += one.picture.numbers.size();
  }
  const bool is_void = counts.rbegin()->first == kVoid && counts.upper_bound(0)->first < kVoid &&
                       !pictures.front().is_own;
  std::vector<std::int32_t> ignored = labels.ignored.value_or(std::vector<std::int32_t>{});
  if (!labels.ignored && is_void) ignored.push_back(kVoid);
  std::erase_if(ignored, [&](std::int32_t id) { return id <= 0 || !counts.contains(id); });
  if (ignored.empty() && counts.begin()->first >= 0 && !labels.zero_is_label) return {};
  const std::set<std::int32_t> none(ignored.begin(), ignored.end());
  Unlabeled unlabeled;
  for (const std::int32_t id : none) unlabeled.pixels += counts.at(id);
  for (ViewPicture& one : pictures) {
    for (std::int32_t& id : one.picture.numbers) {
      id = id < 0 || none.contains(id) ? 0 : id + (labels.zero_is_label ? 1 : 0);
    }
  }
  if (none.empty()) return unlabeled;
  unlabeled.sentence = fmt::format(
      "{} ({}) {} unlabeled", joined(none, ", ", [](int id) { return std::to_string(id); }),
      share_text(unlabeled.pixels, all), none.size() == 1 ? "is taken for" : "are taken for");
  return unlabeled;
}

/// On pixels that are unpainted without being ignored, or on all being painted.
std::vector<std::string> ground_notes(const PixelCensus<std::int32_t>& census,
                                      const LabelReading& labels, const fs::path& path,
                                      const std::string& zero) {
  const std::size_t all = census.all();
  const auto zeros = census.counts.find(0);
  if (zeros != census.counts.end()) {
    std::vector<std::string> notes;
    const bool is_asked =
        labels.ignored && (labels.ignored->empty() || std::ranges::count(*labels.ignored, 255) > 0);
    if (is_asked && !labels.zero_is_label) {
      notes.push_back(
          fmt::format(finding_text("labels.zero"), path.filename().string(),
                      100.0 * static_cast<double>(zeros->second) / static_cast<double>(all)));
    }
    notes.push_back(path.string() + ": " +
                    ground_text(fmt::format("{} ({})", zero, share_text(zeros->second, all)),
                                census.transparent, all));
    return notes;
  }
  if (census.ignored > 0 && census.transparent == 0) return {};
  std::string unpainted = ground_text({}, census.transparent, all);
  if (census.transparent == 0) {
    const auto& [id, count] =
        *std::ranges::max_element(census.counts, {}, [](const auto& one) { return one.second; });
    unpainted += fmt::format("; ignore {} ({}) if it stands for none", id, share_text(count, all));
  }
  return {path.string() + ": " + unpainted};
}

ImportedLabels strokes_of_numbers(std::vector<ViewPicture>& pictures, const LabelReading& labels,
                                  const fs::path& path) {
  ImportedLabels strokes;
  const Unlabeled unlabeled = mark_unlabeled(pictures, labels);
  if (!unlabeled.sentence.empty()) {
    strokes.notes.push_back(path.string() + ": " + unlabeled.sentence);
  }
  if (labels.zero_is_label) strokes.notes.emplace_back(finding_text("labels.raised_files"));
  PixelCensus<std::int32_t> census;
  for (const ViewPicture& one : pictures) {
    Image<std::int32_t> painted(one.picture.height(), one.picture.width());
    for_pixels(one, true, [&](int y, int x) {
      painted.at(y, x) = one.picture.numbers.at(y, x);
      ++census.counts[painted.at(y, x)];
    });
    for_pixels(one, false, [&](int, int) { ++census.transparent; });
    strokes.scribbles.views.push_back({one.view, std::move(painted)});
  }
  census.take_ignored(unlabeled.pixels);
  const LabelPicture& first = pictures.front().picture;
  strokes.scribbles.labels = labels_of(census, first, labels);
  const bool has_palette = !first.palette.empty();
  if (pictures.front().is_own) return strokes;
  if (has_palette) {
    strokes.notes.push_back(path.string() + ": a label is an index of the palette: " +
                            joined(strokes.scribbles.labels, ", ", label_text));
  }
  std::ranges::move(ground_notes(census, labels, path, has_palette ? "index 0" : "0"),
                    std::back_inserter(strokes.notes));
  return strokes;
}

/// A sentence about labels that hardly any pixel has but between two others; else nothing.
std::string doubt_of_edges(const Image<std::int32_t>& labels) {
  constexpr std::ptrdiff_t kFewestEdges = 3;
  constexpr double kMostOnEdges = 0.8;
  std::map<std::int32_t, std::pair<int, int>> counts;  // pixels, and those between two others
  for (int y = 1; y + 1 < labels.height(); ++y) {
    for (int x = 1; x + 1 < labels.width(); ++x) {
      const std::int32_t id = labels.at(y, x);
      const auto is_between = [id](int a, int b) { return a != b && a != id && b != id; };
      if (id == 0) continue;
      auto& [pixels, edges] = counts[id];
      ++pixels;
      if (is_between(labels.at(y, x - 1), labels.at(y, x + 1)) ||
          is_between(labels.at(y - 1, x), labels.at(y + 1, x))) {
        ++edges;
      }
    }
  }
  const auto edges = std::ranges::count_if(
      counts, [](const auto& one) { return one.second.second > kMostOnEdges * one.second.first; });
  if (edges < kFewestEdges) return {};
  return fmt::format(finding_text("labels.smoothed"), edges, counts.size());
}

}  // namespace

ImportedLabels labels_of_pictures(std::vector<ViewPicture> pictures, const LabelReading& reading,
                                  const fs::path& path) {
  settle_kinds(pictures, !reading.table.empty());
  const auto has_colors = [](const ViewPicture& one) { return !one.picture.colors.empty(); };
  const auto colored = std::ranges::count_if(pictures, has_colors);
  if (colored > 0 && static_cast<std::size_t>(colored) < pictures.size()) {
    throw IoError(path, "holds pictures of colors beside pictures of numbers; save all alike");
  }
  ImportedLabels labels = colored > 0 ? strokes_of_colors(pictures, reading, path)
                                      : strokes_of_numbers(pictures, reading, path);
  if (colored > 0 && reading.zero_is_label) {
    labels.notes.emplace_back(finding_text("labels.colors_first"));
  }
  std::erase_if(labels.scribbles.views, [](const ViewScribbles& one) {
    return std::ranges::all_of(one.labels, [](std::int32_t id) { return id == 0; });
  });
  if (!labels.scribbles.views.empty()) {
    const std::string doubt = doubt_of_edges(labels.scribbles.views.front().labels);
    if (!doubt.empty() && reading.table.empty()) labels.notes.push_back(doubt);
    return labels;
  }
  throw IoError(path, "nothing is painted: every pixel is unpainted or transparent; draw strokes");
}

}  // namespace episcope::io
