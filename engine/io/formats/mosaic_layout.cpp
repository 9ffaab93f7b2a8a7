// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/mosaic_layout.h"

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/core/parallel.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace episcope::io {
namespace {

enum class LineAxis { X, Y };

constexpr int kMostLines = 400;

/// Not a multiple of the distance of two lines, or all of them would show the same part of
/// lenslets.
int spread(int line, int lines, int length) {
  return static_cast<int>((line + 0.5) * length / lines);
}

template <class T>
float brightness(const T* pixel, int channels) {
  float sum = 0;
  for (int c = 0; c < channels; ++c) sum += static_cast<float>(pixel[c]);
  return sum / static_cast<float>(channels);
}

/// Brightness along up to 400 rows (LineAxis::X) or columns (LineAxis::Y) spread over a picture: a
/// line a row, in units of the samples, the mean of the channels.
Image<float> picture_lines(const AnyImage& picture, LineAxis axis) {
  return std::visit(
      [axis](const auto& image) {
        const int across = axis == LineAxis::X ? image.height() : image.width();
        const int along = axis == LineAxis::X ? image.width() : image.height();
        Image<float> lines(std::min(across, kMostLines), along);
        // Row by row of the picture in both cases, as it lies in memory.
        for (int i = 0; i < (axis == LineAxis::X ? lines.height() : along); ++i) {
          const auto* row = image.row(axis == LineAxis::X ? spread(i, lines.height(), across) : i);
          for (int k = 0; k < (axis == LineAxis::X ? along : lines.height()); ++k) {
            const int x = axis == LineAxis::X ? k : spread(k, lines.height(), across);
            const float value = brightness(row + x * image.channels(), image.channels());
            (axis == LineAxis::X ? lines.at(i, k) : lines.at(k, i)) = value;
          }
        }
        return lines;
      },
      picture);
}

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
  return stem == "lf" ? MosaicName::Mosaic : MosaicName::Plain;
}

std::string scene_of_mosaic(const std::filesystem::path& path) {
  std::string stem = lower_case(path.stem().string());
  for (const std::string_view word :
       {kEslf, kLensletWords[0], kLensletWords[1], kLensletWords[2]}) {
    if (stem.size() <= word.size() + 1 || !ends_with_word(stem, word)) continue;
    stem.resize(stem.size() - word.size() - 1);
    break;
  }
  return stem;
}

namespace {

/// The period with which the brightness of a picture changes along its lines. From one lenslet to
/// the next, the view jumps from the last to the first, and so does the brightness; lenslets with
/// dark borders show their period in the brightness itself.
struct LensletPeriod {
  int period_px = 0;     ///< 0 = none was found.
  double explained = 0;  ///< Part of the variance of differences of neighbors that repeats,
  double jump = 0;       ///< their largest over their median within a period,
  double shading = 0;    ///< and part of the variance of the brightness itself that repeats.

  /// Whether the lines are those of lenslets: half of the variance repeats, with a jump of 1.5. Of
  /// multiples of 4 the brightness must repeat as well, because pictures that were compressed as
  /// JPEG have jumps every 8 or 16 px.
  [[nodiscard]] bool is_certain() const;
  /// The same without regard to compression: for a picture of which one knows otherwise that it
  /// consists of lenslets.
  [[nodiscard]] bool is_likely() const;
  /// For such a picture that is a JPEG: of multiples of 8 the brightness must repeat.
  [[nodiscard]] bool is_likely_in_jpeg() const;
};

constexpr int kSmallestPeriod = 3;
constexpr int kLargestPeriod = 32;
/// Fewer repetitions of a period prove nothing.
constexpr int kFewestRepetitions = 8;
constexpr double kExplained = 0.5;
constexpr double kJump = 1.5;
/// A period is taken before its multiples, which explain as much.
constexpr double kAlmost = 0.9;
/// Of JPEG, in px; with colors of half the size, they are twice as large.
constexpr int kJpegBlock = 8;

struct Folded {
  double explained = 0;
  double jump = 0;
};

/// Each period divided by its mean, so that only what is within periods counts.
Folded fold(const std::vector<double>& signal, int period) {
  const std::size_t repetitions = signal.size() / static_cast<std::size_t>(period);
  if (repetitions < kFewestRepetitions) return {};
  std::vector<double> mean(static_cast<std::size_t>(period));
  double total = 0;
  for (std::size_t r = 0; r < repetitions; ++r) {
    const auto begin = signal.begin() + static_cast<std::ptrdiff_t>(r) * period;
    const double level = std::accumulate(begin, begin + period, 0.0) / period;
    if (level <= 0) continue;
    for (int i = 0; i < period; ++i) {
      const double relative = begin[i] / level - 1;
      total += relative * relative;
      mean[static_cast<std::size_t>(i)] += relative / static_cast<double>(repetitions);
    }
  }
  double repeated = 0;
  for (const double value : mean) repeated += static_cast<double>(repetitions) * value * value;
  std::vector<double> sorted = mean;
  std::ranges::sort(sorted);
  const double median = 1 + sorted[sorted.size() / 2];
  return {total > 0 ? repeated / total : 0, median > 0 ? (1 + sorted.back()) / median : 0};
}

bool LensletPeriod::is_likely() const {
  return period_px > 0 && explained >= kExplained && jump >= kJump;
}

bool LensletPeriod::is_likely_in_jpeg() const {
  return is_likely() && (period_px % kJpegBlock != 0 || shading >= kExplained);
}

bool LensletPeriod::is_certain() const {
  return is_likely() && (period_px % 4 != 0 || shading >= kExplained);
}

/// `lines`: brightness, a line a row. Periods of 3 to 32 px are tried.
LensletPeriod find_lenslet_period(const Image<float>& lines) {
  std::vector<double> brightness(static_cast<std::size_t>(lines.width()));
  std::vector<double> difference(static_cast<std::size_t>(std::max(lines.width() - 1, 0)));
  for (int y = 0; y < lines.height(); ++y) {
    const float* line = lines.row(y);
    for (std::size_t x = 0; x < brightness.size(); ++x) brightness[x] += line[x];
    for (std::size_t x = 0; x < difference.size(); ++x) {
      difference[x] += std::abs(line[x + 1] - line[x]);
    }
  }
  std::vector<Folded> folded;
  for (int period = kSmallestPeriod; period <= kLargestPeriod; ++period) {
    folded.push_back(fold(difference, period));
  }
  const double best = std::ranges::max(folded, {}, &Folded::explained).explained;
  const auto found = std::ranges::find_if(
      folded, [best](const Folded& one) { return one.explained >= kAlmost * best; });
  if (best <= 0) return {};
  const int period = kSmallestPeriod + static_cast<int>(found - folded.begin());
  return {period, found->explained, found->jump, fold(brightness, period).explained};
}

/// How often a picture repeats along its lines: views side by side resemble each other.
struct TileCount {
  int count = 0;           ///< 0 = nothing was found.
  double correlation = 0;  ///< Of the brightness changes of neighboring tiles, at the best of
                           ///< shifts by up to 8 px.
  double edge = 0;         ///< Differences across borders of tiles over those everywhere.

  /// Whether tiles are views of one scene: correlation 0.3 (unrelated pictures: below 0.15), and
  /// borders that are seen, 1.5.
  [[nodiscard]] bool is_certain() const;
};

constexpr int kMostTiles = 32;
constexpr int kSmallestTile = 32;
constexpr int kLargestTileShift = 8;
constexpr int kStepWindow = 4;
constexpr int kLineStep = 2;
constexpr double kCorrelation = 0.3;
constexpr double kEdge = 1.5;

/// Differences of the means of neighboring windows of 4 px: what disparity moves by a pixel or two
/// still correlates.
Image<float> smooth_changes(const Image<float>& lines) {
  const int width = std::max(lines.width() - 2 * kStepWindow + 1, 1);
  Image<float> changes((lines.height() + kLineStep - 1) / kLineStep, width);
  if (lines.width() < 2 * kStepWindow) return changes;
  for (int y = 0; y < changes.height(); ++y) {
    const float* line = lines.row(y * kLineStep);
    for (int x = 0; x < width; ++x) {
      float change = 0;
      for (int i = 0; i < kStepWindow; ++i) change += line[x + kStepWindow + i] - line[x + i];
      changes.at(y, x) = change;
    }
  }
  return changes;
}

double correlation_at(const Image<float>& changes, int lag) {
  double ab = 0;
  double aa = 0;
  double bb = 0;
  for (int y = 0; y < changes.height(); ++y) {
    const float* a = changes.row(y);
    const float* b = a + lag;
    float row_ab = 0;
    float row_aa = 0;
    float row_bb = 0;
    for (int x = 0; x < changes.width() - lag; ++x) {
      row_ab += a[x] * b[x];
      row_aa += a[x] * a[x];
      row_bb += b[x] * b[x];
    }
    ab += row_ab;
    aa += row_aa;
    bb += row_bb;
  }
  const double norm = std::sqrt(aa * bb);
  return norm > 0 ? ab / norm : 0;
}

double edge_ratio(const Image<float>& lines, int tiles) {
  const int width = lines.width() / tiles;
  double all = 0;
  double edges = 0;
  for (int y = 0; y < lines.height(); ++y) {
    const float* line = lines.row(y);
    for (int x = 1; x < lines.width(); ++x) {
      const double difference = std::abs(line[x] - line[x - 1]);
      all += difference;
      if (x % width == 0) edges += difference;
    }
  }
  if (all <= 0) return 0;
  return edges / (tiles - 1) / (all / (lines.width() - 1));
}

bool TileCount::is_certain() const {
  return count > 1 && correlation >= kCorrelation && edge >= kEdge;
}

/// `lines`: brightness, a line a row. Tries 2 to 32 tiles of at least 32 px, of whole pixels.
TileCount find_tile_count(const Image<float>& lines) {
  const Image<float> changes = smooth_changes(lines);
  TileCount best;
  for (int tiles = 2; tiles <= kMostTiles; ++tiles) {
    const int width = lines.width() / tiles;
    if (lines.width() % tiles != 0 || width < kSmallestTile) continue;
    for (int shift = -kLargestTileShift; shift <= kLargestTileShift; ++shift) {
      const double correlation = correlation_at(changes, width + shift);
      if (correlation > best.correlation) best = {tiles, correlation, 0};
    }
  }
  if (best.count > 0) best.edge = edge_ratio(lines, best.count);
  return best;
}

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

std::optional<GridShape> stated_grid(const OpenOptions& options) {
  const std::optional<GridShape> grid = given_grid(options);
  if (options.lenslet == 0) return grid;
  const GridShape lenslet{options.lenslet, options.lenslet};
  if (options.mosaic == Mosaic::Views) {
    throw InvalidInput(
        "--lenslet belongs to --mosaic lenslets; for views side by side give --grid");
  }
  if (grid && !(*grid == lenslet)) {
    throw InvalidInput(
        fmt::format("--lenslet {} and --grid {} contradict each other; give one of "
                    "them",
                    options.lenslet, options.grid));
  }
  return lenslet;
}

Mosaic stated_kind(const OpenOptions& options, MosaicName name) {
  if (options.mosaic != Mosaic::Auto) return options.mosaic;
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

std::optional<Answer> find_answer(const Question& question) {
  if (question.grid && question.kind != Mosaic::Auto) {
    return Answer{question.kind, *question.grid, "as the options say"};
  }
  std::optional<Answer> found;
  if (question.kind != Mosaic::Views) found = lenslets_of(question);
  if (!found && question.kind != Mosaic::Lenslets) found = views_of(question);
  const bool contradicts = found && question.grid && !(found->grid == *question.grid);
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

[[noreturn]] void refuse(const Question& question) {
  const std::string size = fmt::format("of {}×{} px", question.width, question.height);
  if (question.kind == Mosaic::Lenslets) {
    const std::string reason = "no period of lenslets is found in " + question.subject + " " + size;
    auto choices = possible_lenslets(question);
    if (!choices.empty()) throw Undecided(question.path, reason, "lenslet", std::move(choices));
    throw IoError(question.path,
                  reason + "; give the pixels along a side of a lenslet, for example --lenslet 14");
  }
  if (question.kind == Mosaic::Views) {
    throw IoError(question.path,
                  "the number of views in " + question.subject + " " + size +
                      " is not found; give rows and columns, for example --grid 9x9");
  }
  throw IoError(
      question.path,
      "this is a single picture " + size +
          " and not recognized as a light field; if it holds all views, give --mosaic "
          "lenslets --lenslet N or --mosaic views --grid RxC, else open a folder of views");
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
  return {path,
          name,
          stated_kind(options, name),
          stated_grid(options),
          size.height,
          size.width,
          picture_lines(picture, LineAxis::X),
          picture_lines(picture, LineAxis::Y)};
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
  return {answer->kind, grid, height / grid.v, width / grid.u, std::move(answer->evidence)};
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

/// Row `y` of view `view`.
template <class T>
void copy_row(const Image<T>& picture, const MosaicLayout& layout, ViewIndex view, int y, T* to) {
  const int channels = picture.channels();
  if (layout.kind == Mosaic::Lenslets) {
    const T* row = picture.row(y * layout.grid.v + view.v);
    gather(row + view.u * channels, channels, layout.grid.u, layout.width, to);
  } else {
    const T* row = picture.row(view.v * layout.height + y);
    std::copy_n(row + static_cast<std::ptrdiff_t>(view.u) * layout.width * channels,
                layout.width * channels, to);
  }
}

}  // namespace

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
