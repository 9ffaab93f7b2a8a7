// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/mosaic_layout.h"

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/core/parallel.h"
#include "engine/core/shear.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_header.h"
#include "engine/io/formats/mosaic_periods.h"
#include "engine/io/formats/quilt.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEslf = "eslf";
constexpr std::array<std::string_view, 3> kLensletWords{"macpi", "lenslet", "lenslets"};

/// "eslf" and "flower_eslf", but not "heslf".
bool ends_with_word(const std::string& stem, std::string_view word) {
  if (!stem.ends_with(word)) return false;
  if (stem.size() == word.size()) return true;
  const char before = stem[stem.size() - word.size() - 1];
  return before == '_' || before == '-' || before == '.' || before == ' ';
}

}  // namespace

MosaicName mosaic_name(const std::filesystem::path& path) {
  if (!is_image_name(path)) return MosaicName::Plain;
  const std::string stem = lower_case(path.stem().string());
  if (ends_with_word(stem, kEslf)) return MosaicName::Eslf;
  for (const std::string_view word : kLensletWords) {
    if (ends_with_word(stem, word)) return MosaicName::Lenslets;
  }
  if (quilt_tiles_of_name(path)) return MosaicName::Quilt;
  return stem == "lf" ? MosaicName::Mosaic : MosaicName::Plain;
}

std::string scene_of_mosaic(const std::filesystem::path& path) {
  std::string stem = lower_case(without_quilt_tiles(path.stem().string()));
  for (const std::string_view word :
       {kEslf, kLensletWords[0], kLensletWords[1], kLensletWords[2]}) {
    if (stem.size() <= word.size() + 1 || !ends_with_word(stem, word)) continue;
    stem.resize(stem.size() - word.size() - 1);
    break;
  }
  return stem;
}

namespace {

/// A picture, what is known of it, and its lines, which show periods.
struct Question {
  const fs::path& path;
  MosaicName name;
  Mosaic kind;                    ///< Given, or told by the name; else Auto.
  std::optional<GridShape> grid;  ///< Given.
  int height;
  int width;
  Image<float> along_x;
  Image<float> along_y;
  std::string evidence_of_options = "as the options say";
  std::string subject{};  ///< What messages call it.
};

struct Answer {
  Mosaic kind;
  GridShape grid;
  std::string evidence;
};

int in_percent(double part) {
  return static_cast<int>(std::lround(100 * part));
}

/// Views along one axis of lenslets that are a pitch apart.
int views_of_pitch(double pitch_px) {
  return std::max(1, static_cast<int>(std::lround(pitch_px)));
}

std::optional<GridShape> stated_grid(const OpenOptions& options) {
  const std::optional<GridShape> grid = given_grid(options);
  if (options.lenslet == 0) return grid;
  const int views = views_of_pitch(options.lenslet);
  const GridShape lenslet{views, views};
  if (options.mosaic != Mosaic::Auto && options.mosaic != Mosaic::Lenslets) {
    throw InvalidInput(
        "--lenslet belongs to --mosaic lenslets; for views side by side give --grid");
  }
  if (grid && !(*grid == lenslet)) {
    throw InvalidInput(
        fmt::format("--lenslet {:g} and --grid {} contradict each other; give one of "
                    "them",
                    options.lenslet, options.grid));
  }
  return lenslet;
}

Mosaic stated_kind(const OpenOptions& options, MosaicName name) {
  if (options.mosaic != Mosaic::Auto) return options.mosaic;
  if (name == MosaicName::Quilt && options.lenslet == 0) return Mosaic::Quilt;
  const bool is_named = name == MosaicName::Eslf || name == MosaicName::Lenslets;
  return options.lenslet > 0 || is_named ? Mosaic::Lenslets : Mosaic::Auto;
}

/// Lytro cameras give 14 px a lenslet, or 15.
std::optional<Answer> eslf_by_size(const Question& question) {
  for (const int side : {14, 15}) {
    if (question.height % side == 0 && question.width % side == 0) {
      return Answer{Mosaic::Lenslets,
                    {side, side},
                    fmt::format("the name says ESLF, and {} divides both sides; the picture itself "
                                "does not tell",
                                side)};
    }
  }
  return std::nullopt;
}

bool is_jpeg_name(const fs::path& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".jpg" || suffix == ".jpeg";
}

bool can_be_lenslets(const Question& question, const LensletPeriod& period) {
  if (question.kind != Mosaic::Lenslets) return period.is_certain();
  return is_jpeg_name(question.path) ? period.is_likely_in_jpeg() : period.is_likely();
}

std::optional<Answer> lenslets_of(const Question& question) {
  const LensletPeriod u = find_lenslet_period(question.along_x);
  const LensletPeriod v = find_lenslet_period(question.along_y);
  if (can_be_lenslets(question, u) && can_be_lenslets(question, v)) {
    return Answer{
        Mosaic::Lenslets,
        {v.period_px, u.period_px},
        fmt::format("{} % and {} % of the changes of brightness along x and y repeat with "
                    "this period",
                    in_percent(u.explained), in_percent(v.explained))};
  }
  return question.name == MosaicName::Eslf ? eslf_by_size(question) : std::nullopt;
}

std::optional<Answer> views_of(const Question& question) {
  const TileCount u = find_tile_count(question.along_x);
  if (!u.is_certain()) return std::nullopt;
  const TileCount v = find_tile_count(question.along_y);
  if (!v.is_certain()) return std::nullopt;
  return Answer{Mosaic::Views,
                {v.count, u.count},
                fmt::format("neighboring views correlate by {:.2f} along x and {:.2f} along y",
                            u.correlation, v.correlation)};
}

/// Whether tiles of `count` would cut through the views that lines show.
bool cuts_views(const Image<float>& lines, int count) {
  const TileCount shown = find_tile_count(lines);
  if (!shown.is_certain() || shown.count == count) return false;
  const TileCount given = tiles_of_count(lines, count);
  return !given.is_certain() || given.correlation < shown.correlation / 2;
}

/// Throws IoError if views side by side evidently have other borders than a given grid.
void require_sensible_cut(const Question& question, GridShape grid) {
  if (!cuts_views(question.along_x, grid.u) && !cuts_views(question.along_y, grid.v)) return;
  const auto shown = views_of(question);
  if (!shown) return;
  throw IoError(
      question.path,
      fmt::format("--grid {}x{} cuts through the views of {}, whose tiles are {}x{} ({}); "
                  "correct or leave out --grid",
                  grid.v, grid.u, question.subject, shown->grid.v, shown->grid.u, shown->evidence));
}

std::optional<Answer> find_answer(const Question& question) {
  if (question.grid && question.kind != Mosaic::Auto) {
    return Answer{question.kind, *question.grid, question.evidence_of_options};
  }
  if (question.kind == Mosaic::Quilt) {
    if (const auto tiles = quilt_tiles_of_name(question.path)) {
      return Answer{Mosaic::Quilt, *tiles, "as its name says"};
    }
  }
  std::optional<Answer> found;
  if (question.kind == Mosaic::Auto || question.kind == Mosaic::Lenslets)
    found = lenslets_of(question);
  if (!found && question.kind != Mosaic::Lenslets) found = views_of(question);
  if (found && question.kind != Mosaic::Auto) found->kind = question.kind;
  const bool contradicts = found && question.grid && !(found->grid == *question.grid);
  if (contradicts && found->kind == Mosaic::Views) require_sensible_cut(question, *question.grid);
  return contradicts ? std::nullopt : found;
}

/// Sides of lenslets of cameras and of common data that divide both sides of the picture.
std::vector<ReadingChoice> possible_lenslets(const Question& question) {
  std::vector<ReadingChoice> choices;
  for (const int side : {14, 15, 9, 8, 7, 5}) {
    if (question.height % side != 0 || question.width % side != 0) continue;
    choices.push_back(
        {std::to_string(side), fmt::format("{0}×{0} views of {1}×{2} px", side,
                                           question.width / side, question.height / side)});
  }
  return choices;
}

/// What cameras record under lenslets has any pitch, and often a rotation.
constexpr const char* kRectify =
    "; if lenslets are no whole number of pixels apart, give their distance, as --lenslet 15.38; "
    "if they are turned or hexagonal, as in raw pictures of cameras, use episcope-cli decode";

[[noreturn]] void refuse(const Question& question) {
  const std::string size = fmt::format("of {}×{} px", question.width, question.height);
  if (question.kind == Mosaic::Lenslets) {
    const std::string reason = "no period of lenslets is found in " + question.subject + " " + size;
    auto choices = possible_lenslets(question);
    if (!choices.empty()) {
      throw Undecided(question.path, reason + kRectify, "lenslet", std::move(choices));
    }
    throw IoError(question.path,
                  reason + "; give the pixels along a side of a lenslet, for example --lenslet 14" +
                      kRectify);
  }
  if (question.kind != Mosaic::Auto) {
    throw IoError(question.path,
                  "the number of views in " + question.subject + " " + size +
                      " is not found; give rows and columns, for example --grid 9x9");
  }
  throw IoError(
      question.path,
      "this is a single picture " + size +
          " and not recognized as a light field; if it holds all views, give --mosaic "
          "lenslets --lenslet N or --mosaic views --grid RxC, else open a folder of views" +
          kRectify);
}

ImageSize size_of(const AnyImage& picture) {
  return std::visit(
      [](const auto& image) {
        return ImageSize{image.height(), image.width()};
      },
      picture);
}

Question question_of(const AnyImage& picture, ImageSize size, const fs::path& path,
                     const OpenOptions& options) {
  const MosaicName name = mosaic_name(path);
  Question question{path,
                    name,
                    stated_kind(options, name),
                    stated_grid(options),
                    size.height,
                    size.width,
                    picture_lines(picture, LineAxis::X),
                    picture_lines(picture, LineAxis::Y)};
  if (has_fraction(options.lenslet)) {
    question.evidence_of_options =
        fmt::format("resampled from {:g} px, as the options say", options.lenslet);
  }
  return question;
}

/// Throws IoError for a quilt whose tiles do not fill the picture: it was cut or scaled.
MosaicLayout layout_of(Answer answer, ImageSize view, ImageSize picture, const fs::path& path) {
  const GridShape tiles = answer.grid;
  MosaicLayout layout{answer.kind, tiles,      tiles,
                      view.height, view.width, std::move(answer.evidence)};
  if (layout.kind != Mosaic::Quilt) return layout;
  layout.grid = {1, tiles.count()};
  if (view.height * tiles.v == picture.height && view.width * tiles.u == picture.width) {
    return layout;
  }
  throw IoError(path, fmt::format("{}×{} tiles of a quilt do not divide a picture of {}×{} px; use "
                                  "the original, or state the tiles by --grid ROWSxCOLUMNS",
                                  tiles.v, tiles.u, picture.width, picture.height));
}

}  // namespace

MosaicLayout find_mosaic_layout(const AnyImage& picture, const fs::path& path,
                                const OpenOptions& options, const std::string& subject) {
  const auto [height, width] = size_of(picture);
  Question question = question_of(picture, {height, width}, path, options);
  question.subject = subject;
  std::optional<Answer> answer = find_answer(question);
  if (!answer) refuse(question);
  const GridShape grid = answer->grid;
  constexpr int kSmallestView = 2;
  if (height / grid.v < kSmallestView || width / grid.u < kSmallestView) {
    throw IoError(path, fmt::format("a picture of {}×{} px is too small for {}×{} views; correct "
                                    "--grid or --lenslet",
                                    width, height, grid.v, grid.u));
  }
  // Without a stated kind, the cut was found before it was compared with the grid.
  const bool is_unseen = question.grid && question.kind != Mosaic::Auto;
  if (is_unseen && answer->kind != Mosaic::Lenslets) require_sensible_cut(question, grid);
  return layout_of(std::move(*answer), {height / grid.v, width / grid.u}, {height, width}, path);
}

namespace {

/// Four samples around a place between samples, and their weights.
struct Taps {
  std::array<int, 4> at;
  std::array<float, 4> weights;
};

/// Of all pixels of lenslets of `views` px, along an axis of `length` px where they are a pitch
/// apart.
std::vector<Taps> taps_along(int length, double pitch_px) {
  const int views = views_of_pitch(pitch_px);
  std::vector<Taps> taps(static_cast<std::size_t>(length / pitch_px) *
                         static_cast<std::size_t>(views));
  for (std::size_t i = 0; i < taps.size(); ++i) {
    const double place = (static_cast<double>(i) + 0.5) * pitch_px / views - 0.5;
    const int first = static_cast<int>(std::floor(place)) - 1;
    const auto t = static_cast<float>(place - std::floor(place));
    for (int k = 0; k < 4; ++k) taps[i].at[k] = std::clamp(first + k, 0, length - 1);
    taps[i].weights = cubic_weights(t);
  }
  return taps;
}

template <class T>
Image<T> resampled(const Image<T>& from, const std::vector<Taps>& along_y,
                   const std::vector<Taps>& along_x) {
  const int channels = from.channels();
  Image<T> to(static_cast<int>(along_y.size()), static_cast<int>(along_x.size()), channels);
  parallel_for(to.height(), Progress(), [&](int y) {
    const Taps& rows = along_y[static_cast<std::size_t>(y)];
    std::vector<float> line(static_cast<std::size_t>(from.width()) * channels, 0.F);
    for (int k = 0; k < 4; ++k) {
      const T* row = from.row(rows.at[k]);
      for (std::size_t i = 0; i < line.size(); ++i) {
        line[i] += rows.weights[k] * static_cast<float>(row[i]);
      }
    }
    T* out = to.row(y);
    for (const Taps& columns : along_x) {
      for (int c = 0; c < channels; ++c) {
        float sum = 0;
        for (int k = 0; k < 4; ++k) sum += columns.weights[k] * line[columns.at[k] * channels + c];
        *out++ = interpolated_sample<T>(sum);
      }
    }
  });
  return to;
}

/// Whether a pixel that something was seen in stands for all that a resampled one is made of.
Image<std::uint8_t> resampled_mask(Image<std::uint8_t> seen, std::vector<Taps> along_y,
                                   std::vector<Taps> along_x) {
  for (std::vector<Taps>* taps : {&along_y, &along_x}) {
    for (Taps& each : *taps) {
      float sum = 0;
      for (const float weight : each.weights) sum += std::abs(weight);
      for (float& weight : each.weights) weight = std::abs(weight) / sum;
    }
  }
  for (std::uint8_t& each : seen) each = each != 0 ? 255 : 0;
  seen = resampled(seen, along_y, along_x);
  for (std::uint8_t& each : seen) each = each == 255 ? 1 : 0;
  return seen;
}

}  // namespace

bool has_fraction(double pitch_px) {
  return pitch_px != std::floor(pitch_px);
}

SeenImage with_whole_lenslets(const SeenImage& picture, double pitch_px) {
  const auto [height, width] = size_of(picture.image);
  const auto along_y = taps_along(height, pitch_px), along_x = taps_along(width, pitch_px);
  SeenImage whole{
      std::visit([&](const auto& image) -> AnyImage { return resampled(image, along_y, along_x); },
                 picture.image)};
  if (!picture.seen.empty()) whole.seen = resampled_mask(picture.seen, along_y, along_x);
  return whole;
}

std::optional<MosaicLayout> evident_mosaic(const fs::path& path) {
  try {
    MosaicLayout layout = find_mosaic_layout(decode_image(path), path, OpenOptions());
    const bool is_one = layout.kind == Mosaic::Views && layout.grid.v > 1 && layout.grid.u > 1;
    return is_one ? std::optional(std::move(layout)) : std::nullopt;
  } catch (const IoError&) {
    return std::nullopt;
  }
}

std::optional<GridShape> find_lenslets(const AnyImage& top, int height, const fs::path& path,
                                       const OpenOptions& options) {
  const Question question = question_of(top, {height, size_of(top).width}, path, options);
  if (question.kind != Mosaic::Lenslets) return std::nullopt;
  const std::optional<Answer> answer = find_answer(question);
  return answer ? std::optional(answer->grid) : std::nullopt;
}

namespace {

constexpr float kOneColour = 0.004F;  ///< A step of 8 bits, of the brightest sample.

struct Run {
  int begin = 0;
  int end = 0;
  [[nodiscard]] int length() const { return end - begin; }
};

/// Where all lines have one and the same brightness.
std::vector<Run> runs_of_one_color(const Image<float>& lines) {
  const int width = lines.width();
  std::vector<float> least(lines.row(0), lines.row(0) + width);
  std::vector<float> most = least;
  for (int i = 1; i < lines.height(); ++i) {
    for (int x = 0; x < width; ++x) {
      least[static_cast<std::size_t>(x)] =
          std::min(least[static_cast<std::size_t>(x)], lines.at(i, x));
      most[static_cast<std::size_t>(x)] =
          std::max(most[static_cast<std::size_t>(x)], lines.at(i, x));
    }
  }
  const float step = kOneColour * *std::ranges::max_element(most);
  std::vector<Run> runs;
  for (int x = 0; x < width; ++x) {
    const auto at = static_cast<std::size_t>(x);
    if (most[at] - least[at] > step) continue;
    const bool goes_on =
        !runs.empty() && runs.back().end == x && std::abs(most[at] - most[at - 1]) <= step;
    if (!goes_on) runs.push_back({x, x});
    runs.back().end = x + 1;
  }
  return runs;
}

/// Nothing if the runs are not at equal distances.
std::optional<TileGaps> gaps_along(const AnyImage& picture, LineAxis axis) {
  const Image<float> lines = picture_lines(picture, axis);
  if (lines.empty()) return std::nullopt;
  std::vector<Run> runs = runs_of_one_color(lines);
  TileGaps found;
  int end = lines.width();
  if (!runs.empty() && runs.back().end == end) {
    end = runs.back().begin;
    runs.pop_back();
  }
  if (!runs.empty() && runs.front().begin == 0) {
    found.first = runs.front().end;
    runs.erase(runs.begin());
  }
  found.count = static_cast<int>(runs.size()) + 1;
  found.length = (runs.empty() ? end : runs.front().begin) - found.first;
  found.gap = runs.empty() ? 0 : runs.front().length();
  if (found.length < kSmallestTile) return std::nullopt;
  int begin = found.first;
  for (const Run& run : runs) {
    if (run.begin - begin != found.length || run.length() != found.gap) return std::nullopt;
    begin = run.end;
  }
  return end - begin == found.length ? std::optional(found) : std::nullopt;
}

bool is_border_of_each(const TileGaps& tiles, int length) {
  const int last = tiles.first + tiles.count * tiles.length + (tiles.count - 1) * tiles.gap;
  return tiles.first + length - last == tiles.gap;
}

}  // namespace

std::string ContactSheet::text() const {
  return fmt::format("gaps of {}×{} px left out", x.gap, y.gap);
}

std::optional<ContactSheet> find_contact_sheet(const AnyImage& picture) {
  const auto x = gaps_along(picture, LineAxis::X);
  if (!x) return std::nullopt;
  const auto y = gaps_along(picture, LineAxis::Y);
  if (!y || x->count * y->count == 1) return std::nullopt;
  const auto [height, width] = std::visit(
      [](const auto& image) { return std::pair(image.height(), image.width()); }, picture);
  if (is_border_of_each(*x, width) && is_border_of_each(*y, height)) return std::nullopt;
  return ContactSheet{*x, *y};
}

AnyImage without_gaps(const AnyImage& picture, const ContactSheet& sheet) {
  return std::visit(
      [&]<class T>(const Image<T>& image) -> AnyImage {
        const auto [x, y] = std::pair(sheet.x, sheet.y);
        const int channels = image.channels();
        Image<T> out(y.count * y.length, x.count * x.length, channels);
        for (int row = 0; row < out.height(); ++row) {
          const T* from = image.row(y.first + row / y.length * (y.length + y.gap) + row % y.length);
          for (int u = 0; u < x.count; ++u) {
            std::copy_n(from + (x.first + u * (x.length + x.gap)) * channels, x.length * channels,
                        out.row(row) + u * x.length * channels);
          }
        }
        return out;
      },
      picture);
}

namespace {

/// Every `step`-th pixel of a row.
template <class T>
void gather(const T* from, int channels, int step, int count, T* to) {
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(step) * channels;
  for (int x = 0; x < count; ++x, from += stride, to += channels) {
    for (int c = 0; c < channels; ++c) to[c] = from[c];
  }
}

template <class T>
void scatter(const T* from, int channels, int step, int count, T* to) {
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(step) * channels;
  for (int x = 0; x < count; ++x, from += channels, to += stride) {
    for (int c = 0; c < channels; ++c) to[c] = from[c];
  }
}

template <class T>
void copy_row(const Image<T>& picture, const MosaicLayout& layout, ViewIndex view, int y, T* to) {
  const int channels = picture.channels();
  if (layout.kind == Mosaic::Lenslets) {
    const T* row = picture.row(y * layout.grid.v + view.v);
    gather(row + view.u * channels, channels, layout.grid.u, layout.width, to);
  } else {
    const ViewIndex tile = layout.tile_of(view);
    const T* row = picture.row(tile.v * layout.height + y);
    std::copy_n(row + static_cast<std::ptrdiff_t>(tile.u) * layout.width * channels,
                layout.width * channels, to);
  }
}

}  // namespace

ViewIndex MosaicLayout::tile_of(ViewIndex view) const {
  if (kind == Mosaic::Quilt) return quilt_tile(tiles, view.u);
  return kind == Mosaic::ViewsUp ? ViewIndex{tiles.v - 1 - view.v, view.u} : view;
}

AnyImage mosaic_view(const AnyImage& picture, const MosaicLayout& layout, ViewIndex view) {
  return std::visit(
      [&]<class T>(const Image<T>& image) -> AnyImage {
        Image<T> one(layout.height, layout.width, image.channels());
        for (int y = 0; y < layout.height; ++y) copy_row(image, layout, view, y, one.row(y));
        return one;
      },
      picture);
}

LightField::Samples split_mosaic(const AnyImage& picture, const MosaicLayout& layout,
                                 const Progress& progress) {
  return std::visit(
      [&]<class T>(const Image<T>& image) -> LightField::Samples {
        ViewStack<T> views(layout.grid, layout.height, layout.width, image.channels());
        // A row of all views at a time: of lenslets, these rows lie side by side in the picture.
        parallel_for(layout.height, progress, [&](int y) {
          for (int i = 0; i < layout.grid.count(); ++i) {
            const ViewIndex view = layout.grid.view_at(i);
            copy_row(image, layout, view, y, views.view(view).row(y));
          }
        });
        return views;
      },
      picture);
}

template <class T>
Image<T> join_lenslets(const ViewStack<T>& views, const Progress& progress) {
  const GridShape grid = views.grid();
  const int channels = views.channels();
  Image<T> picture(views.height() * grid.v, views.width() * grid.u, channels);
  parallel_for(views.height(), progress, [&](int y) {
    for (int i = 0; i < grid.count(); ++i) {
      const ViewIndex view = grid.view_at(i);
      scatter(views.view(view).row(y), channels, grid.u, views.width(),
              picture.row(y * grid.v + view.v) + view.u * channels);
    }
  });
  return picture;
}

template Image<std::uint8_t> join_lenslets(const ViewStack<std::uint8_t>&, const Progress&);
template Image<std::uint16_t> join_lenslets(const ViewStack<std::uint16_t>&, const Progress&);

}  // namespace episcope::io
