// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/scribble_picture.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr int kRgba = 4;

std::string stem_of(ViewIndex view) {
  return fmt::format("scribbles_{:02}_{:02}", view.v, view.u);
}

std::optional<ViewIndex> view_of(const std::string& name) {
  static const std::regex pattern("scribbles_([0-9]{2,5})_([0-9]{2,5})\\.png");
  std::smatch found;
  if (!std::regex_match(name, found, pattern)) return std::nullopt;
  return ViewIndex{std::stoi(found[1]), std::stoi(found[2])};
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

bool holds_scribble_pictures(const fs::path& path) {
  // JPEG to say why it is refused.
  constexpr std::array kSuffixes{".png", ".bmp", ".tif", ".tiff", ".pgm", ".jpg", ".jpeg"};
  std::error_code ignored;
  return fs::is_directory(path, ignored) ||
         std::ranges::find(kSuffixes, suffix_of(path)) != kSuffixes.end();
}

namespace {

/// Begins of a line that are separated as a table is; the last holds the rest.
std::vector<std::string> cells_of(const std::string& line, std::size_t most) {
  const std::string marks = line.find(',') != std::string::npos   ? ","
                            : line.find(';') != std::string::npos ? ";"
                                                                  : " \t";
  const auto trimmed = [](std::string text) {
    constexpr const char* blank = " \t\r\"";
    const std::size_t begin = text.find_first_not_of(blank);
    if (begin == std::string::npos) return std::string();
    return text.substr(begin, text.find_last_not_of(blank) - begin + 1);
  };
  std::vector<std::string> cells;
  std::string rest = trimmed(line);
  while (!rest.empty() && cells.size() + 1 < most) {
    const std::size_t end = rest.find_first_of(marks);
    cells.push_back(trimmed(rest.substr(0, end)));
    rest = end == std::string::npos ? "" : trimmed(rest.substr(end + 1));
  }
  if (!rest.empty()) cells.push_back(rest);
  return cells;
}

std::optional<int> whole_number(const std::string& text, int most) {
  const auto number = parse_number(text);
  const auto whole = number ? whole_int(*number) : std::nullopt;
  return whole && *whole >= 0 && *whole <= most ? whole : std::nullopt;
}

std::string color_text(const Rgb& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

constexpr int kMostId = 65535;

/// Empty if the line is no row of a table.
std::optional<LabelInfo> row_of(const std::string& line) {
  constexpr std::size_t kCells = 5;
  const std::vector<std::string> cells = cells_of(line, kCells);
  if (cells.size() + 1 < kCells) return std::nullopt;
  LabelInfo row;
  for (std::size_t c = 0; c < row.color.size(); ++c) {
    const auto level = whole_number(cells[c], 255);
    if (!level) return std::nullopt;
    row.color[c] = static_cast<std::uint8_t>(*level);
  }
  const auto id = whole_number(cells[3], kMostId);
  if (!id) return std::nullopt;
  row.id = *id;
  row.name = cells.size() == kCells ? cells.back() : color_text(row.color);
  return row;
}

}  // namespace

std::vector<LabelInfo> read_color_table(const fs::path& path) {
  require_readable_file(path);
  std::ifstream in(path);
  std::vector<LabelInfo> table;
  int number = 0;
  bool may_be_heading = true;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos || line.starts_with('#')) continue;
    const auto row = row_of(line);
    if (!row && !std::exchange(may_be_heading, false)) {
      throw IoError(path, fmt::format("line {} is '{}', but must be r,g,b,id,name with levels from "
                                      "0 to 255 and an id from 0 to {}",
                                      number, line, kMostId));
    }
    may_be_heading = false;
    if (!row) continue;
    if (std::ranges::find(table, row->color, &LabelInfo::color) != table.end()) {
      throw IoError(path, fmt::format("line {} repeats the color {}; give each color one label",
                                      number, color_text(row->color)));
    }
    table.push_back(*row);
  }
  if (table.empty()) throw IoError(path, "has no line r,g,b,id,name; write one for each color");
  return table;
}

namespace {

constexpr std::uint8_t kOpaque = 128;  ///< From here on a pixel is painted.

struct ReadPicture {
  fs::path path;
  ViewIndex view;
  LabelPicture picture;

  [[nodiscard]] bool is_painted(int y, int x) const {
    return picture.alpha.empty() || picture.alpha.at(y, x) >= kOpaque;
  }
  [[nodiscard]] Rgb color(int y, int x) const {
    const std::uint8_t* pixel = &picture.colors.at(y, x);
    return {pixel[0], pixel[1], pixel[2]};
  }
};

ViewIndex require_view(const fs::path& path, ViewIndex view, GridShape grid) {
  if (grid.contains(view)) return view;
  throw IoError(path, "the light field has no view (" + view_text(view) +
                          "); choose pictures of this light field");
}

/// JPEG mixes the colors of strokes with those beside them.
void require_exact_colors(const fs::path& path) {
  constexpr std::array<char, 3> kJpeg{'\xFF', '\xD8', '\xFF'};
  std::array<char, 3> begin{};
  std::ifstream(path, std::ios::binary).read(begin.data(), begin.size());
  if (begin != kJpeg) return;
  throw IoError(path,
                "is a JPEG picture, which changes the colors of strokes; save the drawing as PNG");
}

ReadPicture read_picture(const fs::path& path, ViewIndex view, const FieldShape& shape) {
  require_exact_colors(path);
  ReadPicture read{path, require_view(path, view, shape.grid), decode_label_picture(path)};
  const LabelPicture& picture = read.picture;
  if (picture.height() == shape.height && picture.width() == shape.width) return read;
  throw IoError(
      path,
      fmt::format(
          "the picture has {}×{} px, but views have {}×{} px; choose pictures of this light field",
          picture.height(), picture.width(), shape.height, shape.width));
}

std::vector<ReadPicture> read_pictures(const fs::path& path, const FieldShape& shape) {
  std::error_code error;
  std::vector<ReadPicture> pictures;
  if (!fs::is_directory(path, error)) {
    const ViewIndex view = view_of(path.filename().string()).value_or(shape.grid.center());
    pictures.push_back(read_picture(path, view, shape));
    return pictures;
  }
  for (const auto& entry : fs::directory_iterator(path, error)) {
    const auto view = view_of(entry.path().filename().string());
    if (view) pictures.push_back(read_picture(entry.path(), *view, shape));
  }
  if (error) throw IoError(path, "the folder cannot be read; check its permissions");
  if (pictures.empty()) {
    throw IoError(path, "there is no picture scribbles_<v>_<u>.png here; choose another folder");
  }
  std::ranges::sort(pictures, {},
                    [](const ReadPicture& one) { return std::pair(one.view.v, one.view.u); });
  return pictures;
}

/// Calls `visit(y, x)` for each pixel that is painted, or for each that is not.
template <class Visit>
void for_pixels(const ReadPicture& one, bool are_painted, const Visit& visit) {
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

  [[nodiscard]] std::size_t all() const {
    std::size_t sum = transparent;
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
void settle_kinds(std::vector<ReadPicture>& pictures, bool has_table) {
  for (ReadPicture& one : pictures) {
    if (has_table && !one.picture.palette.empty()) resolve_palette(one.picture);
  }
  const auto are_gray = [](const ReadPicture& one) { return is_gray(one.picture); };
  if (has_table || !std::ranges::all_of(pictures, are_gray)) return;
  for (ReadPicture& one : pictures) take_levels(one.picture);
}

[[noreturn]] void refuse_colors(const fs::path& path, const std::string& count) {
  throw IoError(path, fmt::format("has {} colors, but strokes have one a label, at most {}; draw "
                                  "them with a hard brush on a ground of one color, and save them "
                                  "as PNG",
                                  count, kMostStrokeColors));
}

PixelCensus<Rgb> count_colors(const std::vector<ReadPicture>& pictures, const fs::path& path) {
  constexpr std::size_t kEnough = 4096;  // nobody draws so many by hand
  PixelCensus<Rgb> census;
  for (const ReadPicture& one : pictures) {
    for_pixels(one, true, [&](int y, int x) {
      ++census.counts[one.color(y, x)];
      if (census.counts.size() > kEnough) refuse_colors(path, fmt::format("over {}", kEnough));
    });
    for_pixels(one, false, [&](int, int) { ++census.transparent; });
  }
  const std::size_t count = census.counts.size();
  if (count > kMostStrokeColors + 1) refuse_colors(path, std::to_string(count));
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
    labels.push_back({id, "label " + std::to_string(id), label_color(id)});
  }
  return labels;
}

/// What colors without a table stand for: labels of the light field, else the usual ones.
std::optional<std::vector<LabelInfo>> known_labels(const std::vector<Rgb>& colors,
                                                   const PictureLabels& labels) {
  const auto found = all_known(colors, labels.known);
  return found ? found : all_known(colors, usual_labels());
}

/// The color that is unpainted; none where pixels are transparent, where the table names it, and
/// where every color is one of a known label.
std::optional<Rgb> find_ground(const PixelCensus<Rgb>& census, const PictureLabels& labels) {
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
                                 const PictureLabels& labels, const fs::path& path) {
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
  if (const auto found = known_labels(colors, labels)) return *found;
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

PictureStrokes strokes_of_colors(const std::vector<ReadPicture>& pictures,
                                 const PictureLabels& labels, const fs::path& path) {
  const PixelCensus<Rgb> census = count_colors(pictures, path);
  const std::optional<Rgb> ground = find_ground(census, labels);
  std::vector<Rgb> colors;
  for (const auto& [color, count] : census.counts) {
    if (color != ground) colors.push_back(color);
  }
  const std::vector<LabelInfo> found = labels_of(colors, census, labels, path);
  std::map<Rgb, int> ids;
  if (ground) ids[*ground] = 0;
  for (std::size_t i = 0; i < colors.size(); ++i) ids[colors[i]] = found[i].id;
  PictureStrokes strokes;
  for (const ReadPicture& one : pictures) {
    Image<std::int32_t> painted(one.picture.height(), one.picture.width());
    for_pixels(one, true, [&](int y, int x) { painted.at(y, x) = ids.at(one.color(y, x)); });
    strokes.scribbles.views.push_back({one.view, std::move(painted)});
  }
  strokes.scribbles.labels = distinct(found);
  const std::string name = path.string() + ": ";
  strokes.notes = {
      name + "a label is a color: " + joined(strokes.scribbles.labels, ", ", label_text),
      name + ground_text(ground_of(census, ids), census.transparent, census.all())};
  if (labels.table.empty() && !known_labels(colors, labels)) {
    strokes.notes.push_back(name +
                            "the numbers of its labels follow the codes of the colors, which may "
                            "not be those of other labels; a table of colors states them");
  }
  return strokes;
}

/// Names of the numbers that are painted: of the table, else of the light field; colors are those
/// of the palette. Empty where none of these says anything.
std::vector<LabelInfo> labels_of(const PixelCensus<std::int32_t>& census,
                                 const LabelPicture& picture, const PictureLabels& labels) {
  std::vector<LabelInfo> found;
  if (picture.palette.empty() && labels.table.empty()) return found;
  for (const auto& [id, count] : census.counts) {
    if (id == 0) continue;
    LabelInfo label{id, "label " + std::to_string(id), label_color(id)};
    const auto place = static_cast<std::size_t>(id);
    if (place < picture.palette.size()) {
      label.color = picture.palette[place];
      label.name = color_text(label.color);
    }
    for (const auto* list : {&labels.known, &labels.table}) {
      const auto known = std::ranges::find(*list, id, &LabelInfo::id);
      if (known != list->end()) label.name = known->name;
    }
    found.push_back(std::move(label));
  }
  return found;
}

PictureStrokes strokes_of_numbers(const std::vector<ReadPicture>& pictures,
                                  const PictureLabels& labels, const fs::path& path) {
  PictureStrokes strokes;
  PixelCensus<std::int32_t> census;
  for (const ReadPicture& one : pictures) {
    Image<std::int32_t> painted(one.picture.height(), one.picture.width());
    for_pixels(one, true, [&](int y, int x) {
      painted.at(y, x) = one.picture.numbers.at(y, x);
      ++census.counts[painted.at(y, x)];
    });
    for_pixels(one, false, [&](int, int) { ++census.transparent; });
    strokes.scribbles.views.push_back({one.view, std::move(painted)});
  }
  const LabelPicture& first = pictures.front().picture;
  strokes.scribbles.labels = labels_of(census, first, labels);
  const bool has_palette = !first.palette.empty();
  if (!has_palette && census.transparent == 0) return strokes;
  const auto zeros = census.counts.find(0);
  const std::string ground = zeros == census.counts.end()
                                 ? ""
                                 : fmt::format("{} 0 ({})", has_palette ? "index" : "level",
                                               share_text(zeros->second, census.all()));
  if (has_palette) {
    strokes.notes.push_back(path.string() + ": a label is an index of the palette: " +
                            joined(strokes.scribbles.labels, ", ", label_text));
  }
  strokes.notes.push_back(path.string() + ": " +
                          ground_text(ground, census.transparent, census.all()));
  return strokes;
}

bool is_anything_painted(const Scribbles& scribbles) {
  return std::ranges::any_of(scribbles.views, [](const ViewScribbles& one) {
    return std::ranges::any_of(one.labels, [](std::int32_t id) { return id != 0; });
  });
}

}  // namespace

PictureStrokes read_scribble_pictures(const fs::path& path, const FieldShape& shape,
                                      const PictureLabels& labels) {
  std::vector<ReadPicture> pictures = read_pictures(path, shape);
  settle_kinds(pictures, !labels.table.empty());
  const auto has_colors = [](const ReadPicture& one) { return !one.picture.colors.empty(); };
  const auto colored = std::ranges::count_if(pictures, has_colors);
  if (colored > 0 && static_cast<std::size_t>(colored) < pictures.size()) {
    throw IoError(path, "holds pictures of colors beside pictures of numbers; save all alike");
  }
  PictureStrokes strokes = colored > 0 ? strokes_of_colors(pictures, labels, path)
                                       : strokes_of_numbers(pictures, labels, path);
  if (is_anything_painted(strokes.scribbles)) return strokes;
  throw IoError(path, "nothing is painted: every pixel is unpainted or transparent; draw strokes");
}

}  // namespace episcope::io
