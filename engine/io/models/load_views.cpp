// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/load_views.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/memory.h"
#include "engine/core/parallel.h"
#include "engine/core/text.h"
#include "engine/io/base/image_header.h"
#include "engine/io/base/sample_range.h"

#include <fmt/format.h>
#include <unistd.h>

#include <compare>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <numeric>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

/// What all views have in common. Any of them may be grey: programs that save pictures as small as
/// they can store those without color so.
struct ViewForm {
  int height = 0;
  int width = 0;
  std::size_t type = 0;

  friend auto operator<=>(const ViewForm&, const ViewForm&) = default;
};

struct Outcome {
  std::optional<ViewForm> form{};  ///< Nothing if the view could not be decoded.
  bool is_grey = false;
  std::string text{};  ///< What it is, or why it could not be decoded.
};

Outcome outcome_of(const AnyImage& image) {
  return std::visit(
      [&](const auto& one) {
        return Outcome{ViewForm{one.height(), one.width(), image.index()}, one.channels() == 1,
                       describe_image(image)};
      },
      image);
}

template <class T>
void copy_grey(const Image<T>& image, ImageView<T> view) {
  for (std::size_t i = 0; i < image.size(); ++i) {
    std::fill_n(view.data + i * static_cast<std::size_t>(view.channels), view.channels,
                image.data()[i]);
  }
}

/// Nothing if the image does not fit.
template <class T>
void store(const AnyImage& decoded, ImageView<T> view) {
  const auto* image = std::get_if<Image<T>>(&decoded);
  if (!image || image->height() != view.height || image->width() != view.width) return;
  if (image->channels() > view.channels) return;
  if (image->channels() < view.channels) return copy_grey(*image, view);
  std::copy_n(image->data(), image->size(), view.data);
}

/// Views that fit one of them, and the outcome of each view, by place.
struct Loaded {
  LoadedViews pixels;
  std::vector<Outcome> outcomes;

  /// Whether all are of one form, and none has color that the one with the others lacks.
  [[nodiscard]] bool is_whole() const {
    const bool is_grey =
        std::visit([](const auto& all) { return all.channels() == 1; }, pixels.samples);
    return std::ranges::all_of(outcomes, [&](const Outcome& each) {
      return each.form && each.form == outcomes.front().form && (each.is_grey || !is_grey);
    });
  }
};

/// Decodes views, and notes what becomes of each.
class ViewDecoder {
 public:
  explicit ViewDecoder(const ViewFiles& views)
      : views_(views), outcomes_(views.files.size()), seen_(views.files.size()) {}

  /// An empty image if it cannot be decoded.
  AnyImage decode(int place) {
    const auto at = static_cast<std::size_t>(place);
    try {
      SeenImage decoded = decode_seen(views_.files[at]);
      AnyImage image = upright(std::move(decoded.image), views_.orientation);
      outcomes_[at] = outcome_of(image);
      seen_[at] =
          std::get<Image<std::uint8_t>>(upright(std::move(decoded.seen), views_.orientation));
      return image;
    } catch (const IoError& error) {
      outcomes_[at] = {.text = error.sentence()};
      return {};
    }
  }
  /// The first of these views that can be decoded. Throws IoError about the first if there is none.
  std::pair<int, AnyImage> first_of(const std::vector<int>& places) {
    for (const int place : places) {
      AnyImage image = decode(place);
      if (outcomes_[static_cast<std::size_t>(place)].form) return {place, std::move(image)};
    }
    const auto at = static_cast<std::size_t>(places.front());
    throw IoError(views_.files[at], outcomes_[at].text);
  }
  [[nodiscard]] std::vector<Outcome>& outcomes() { return outcomes_; }
  [[nodiscard]] const std::vector<Image<std::uint8_t>>& seen() const { return seen_; }

 private:
  const ViewFiles& views_;
  std::vector<Outcome> outcomes_;
  std::vector<Image<std::uint8_t>> seen_;  ///< Empty = the whole view.
};

/// Throws IoError if files state that their views were cut out at different places: no parallax
/// tells these from a shift of the cameras.
void require_one_place(const std::vector<fs::path>& files) {
  const PagePlace first = stated_place(files.front());
  for (const fs::path& file : files) {
    const PagePlace place = stated_place(file);
    if (place == first) continue;
    throw IoError(
        file, fmt::format("this view states that it lies at ({}, {}) px of a page, but {} "
                          "at ({}, {}); cut all views at one place, or remove what the "
                          "files state",
                          place.x, place.y, files.front().filename().string(), first.x, first.y));
  }
}

/// Loads the views that fit the first of `references` that can be decoded.
Loaded load_around(const ViewFiles& views, const std::vector<int>& references,
                   const OnCenterView& on_center, const Progress& progress) {
  progress.check();
  require_one_place(views.files);
  ViewDecoder decoder(views);
  const auto first = decoder.first_of(references);
  return std::visit(
      [&]<class T>(const Image<T>& image) -> Loaded {
        require_view_memory(views.files.front().parent_path(),
                            static_cast<double>(image.size() * sizeof(T)) * views.grid.count());
        if (on_center) on_center(preview_rgb(image.view()));
        ViewStack<T> stack(views.grid, image.height(), image.width(), image.channels());
        parallel_for(views.grid.count(), progress, [&](int i) {
          store(i == first.first ? first.second : decoder.decode(i),
                stack.view(views.grid.view_at(i)));
        });
        return {{std::move(stack),
                 joined_seen(decoder.seen(), views.grid, {image.height(), image.width()})},
                std::move(decoder.outcomes())};
      },
      first.second);
}

/// Places of views, those next to the center first.
std::vector<int> from_center(GridShape grid) {
  std::vector<int> places(static_cast<std::size_t>(grid.count()));
  std::iota(places.begin(), places.end(), 0);
  const ViewIndex center = grid.center();
  std::ranges::stable_sort(places, {}, [&](int place) {
    const ViewIndex view = grid.view_at(place);
    return std::abs(view.v - center.v) + std::abs(view.u - center.u);
  });
  return places;
}

/// The form of most views that could be decoded.
std::optional<ViewForm> usual_form(const std::vector<Outcome>& outcomes) {
  std::vector<std::optional<ViewForm>> forms;
  for (const Outcome& each : outcomes) forms.push_back(each.form);
  return majority(forms);
}

/// Views that are not like most, or else not like the first that could be decoded.
std::vector<UnusableView> unusable_views(const ViewFiles& views,
                                         const std::vector<Outcome>& outcomes) {
  const auto form = usual_form(outcomes);
  const auto one = std::ranges::find_if(
      outcomes, [&](const Outcome& each) { return each.form && (!form || each.form == form); });
  const fs::path& usual = views.files[static_cast<std::size_t>(one - outcomes.begin())];
  std::vector<UnusableView> unusable;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& each = outcomes[i];
    if (each.form == one->form) continue;
    const std::string why =
        fmt::format(finding_text("views.unlike"), each.text, usual.filename().string(), one->text);
    unusable.push_back({static_cast<int>(i), each.form ? why : each.text, !each.form});
  }
  return unusable;
}

[[noreturn]] void refuse(const ViewFiles& views, const std::vector<UnusableView>& unusable) {
  if (unusable.empty()) {
    throw IoError(views.files.front().parent_path(),
                  "some views are grey and others have color; all views must match");
  }
  const UnusableView& first = unusable.front();
  throw IoError(views.files[static_cast<std::size_t>(first.place)],
                first.is_damaged ? first.why : first.why + "; all views must match");
}

/// Places of a part of the decoded views, from its center on, color views first.
std::vector<int> references_in(const UsableViews& usable, GridShape all,
                               const std::vector<Outcome>& outcomes) {
  std::vector<int> places = from_center(usable.views.grid);
  std::stable_partition(places.begin(), places.end(), [&](int place) {
    ViewIndex view = usable.views.grid.view_at(place);
    if (usable.kept) view = usable.kept->in_whole(view);
    return !outcomes[static_cast<std::size_t>(view.v * all.u + view.u)].is_grey;
  });
  return places;
}

}  // namespace

ViewStack<std::uint8_t> joined_seen(const std::vector<Image<std::uint8_t>>& seen, GridShape grid,
                                    ImageSize size) {
  if (std::ranges::all_of(seen, [](const auto& one) { return one.empty(); })) return {};
  ViewStack<std::uint8_t> valid = all_valid(grid, size.height, size.width);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (ImageSize{seen[i].height(), seen[i].width()} != size) continue;
    std::ranges::copy(seen[i], valid.view(grid.view_at(static_cast<int>(i))).data);
  }
  const bool is_any = std::any_of(valid.data(), valid.data() + valid.size(),
                                  [](std::uint8_t pixel) { return pixel != 0; });
  return is_any ? std::move(valid) : ViewStack<std::uint8_t>();
}

UsableViews load_usable_views(const ViewFiles& views, const OnCenterView& on_center,
                              const Progress& progress) {
  Loaded loaded = load_around(views, from_center(views.grid), on_center, progress);
  if (loaded.is_whole()) return {std::move(loaded.pixels), views};
  const std::vector<UnusableView> unusable = unusable_views(views, loaded.outcomes);
  UsableViews usable{{}, views};
  if (!unusable.empty()) {
    auto left = usual_form(loaded.outcomes) ? without_views(views, unusable) : std::nullopt;
    if (!left) refuse(views, unusable);
    usable.views = std::move(left->views);
    usable.kept = left->kept;
    usable.warning = std::move(left->warning);
  }
  loaded.pixels = {};
  loaded = load_around(usable.views, references_in(usable, views.grid, loaded.outcomes), on_center,
                       progress);
  if (!loaded.is_whole()) refuse(usable.views, unusable_views(usable.views, loaded.outcomes));
  usable.pixels = std::move(loaded.pixels);
  return usable;
}

LoadedViews load_views(const ViewFiles& views, const OnCenterView& on_center,
                       const Progress& progress) {
  Loaded loaded = load_around(views, from_center(views.grid), on_center, progress);
  if (!loaded.is_whole()) refuse(views, unusable_views(views, loaded.outcomes));
  return std::move(loaded.pixels);
}

namespace {

/// Of the nearest folder that is there.
double room_in(std::filesystem::path folder) {
  std::error_code error;
  while (!std::filesystem::exists(folder, error) && folder.has_relative_path()) {
    folder = folder.parent_path();
  }
  const auto space = std::filesystem::space(folder, error);
  return error ? 0 : static_cast<double>(space.available);
}

}  // namespace

void require_view_memory(const std::filesystem::path& path, double bytes) {
  const double memory =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (bytes < memory) return;
  const double room = room_in(scratch_folder());
  if (bytes < room) return;
  constexpr double gigabyte = 1e9;
  throw IoError(
      path,
      fmt::format("the views need {:.1f} GB, but this machine has {:.1f} GB of memory and "
                  "{:.1f} GB of room in {}; make room there, or store fewer views or "
                  "smaller ones",
                  bytes / gigabyte, memory / gigabyte, room / gigabyte, scratch_folder().string()));
}

namespace {

constexpr std::uint32_t kOrientationTag = 0x0112;
constexpr int kMostEntries = 1000;  ///< Of segments, and of tags.

/// Of the TIFF structure in an Exif segment; 0 if it states none.
int orientation_in(FileBytes& file, std::streamoff tiff) {
  const bool is_little = file.number(tiff, 2, true) == 0x4949;  // "II"
  const auto number = [&](std::streamoff at, int count) {
    return static_cast<int>(file.number(at, count, is_little));
  };
  const std::streamoff directory = tiff + file.number(tiff + 4, 4, is_little);
  const int entries = std::min(number(directory, 2), kMostEntries);
  for (int i = 0; i < entries && !file.is_short(); ++i) {
    const std::streamoff entry = directory + 2 + 12 * i;
    if (number(entry, 2) == kOrientationTag) return number(entry + 8, 2);
  }
  return 0;
}

/// Of the first Exif segment of a JPEG file; 0 if there is none.
int orientation_in_jpeg(FileBytes& file) {
  constexpr std::uint32_t kExif = 0x45786966;
  std::streamoff at = 2;
  for (int i = 0; i < kMostEntries && !file.is_short(); ++i) {
    const std::uint32_t marker = file.number(at, 2, false), length = file.number(at + 2, 2, false);
    if (marker < 0xFF00 || marker == 0xFFDA || length < 2) return 0;  // samples begin
    const bool is_exif =
        file.number(at + 4, 4, false) == kExif && file.number(at + 8, 2, false) == 0;
    if (marker == 0xFFE1 && is_exif) return orientation_in(file, at + 10);
    at += 2 + static_cast<std::streamoff>(length);
  }
  return 0;
}

/// Of the eXIf chunk of a PNG file, before its samples; 0 if there is none.
int orientation_in_png(FileBytes& file) {
  constexpr std::uint32_t kExif = 0x65584966, kSamples = 0x49444154;
  std::streamoff at = 8;
  for (int i = 0; i < kMostEntries && !file.is_short(); ++i) {
    const std::uint32_t length = file.number(at, 4, false), type = file.number(at + 4, 4, false);
    if (type == kExif) return orientation_in(file, at + 8);
    if (type == kSamples) return 0;
    at += 12 + static_cast<std::streamoff>(length);
  }
  return 0;
}

/// Of the EXIF chunk of a WebP file, which may begin as the segment of a JPEG file does; 0 if there
/// is none.
int orientation_in_webp(FileBytes& file) {
  constexpr std::uint32_t kExif = 0x45584946, kSegment = 0x45786966;
  if (file.number(8, 4, false) != 0x57454250) return 0;  // "WEBP"
  std::streamoff at = 12;
  for (int i = 0; i < kMostEntries && !file.is_short(); ++i) {
    const std::uint32_t type = file.number(at, 4, false), length = file.number(at + 4, 4, true);
    const bool is_segment = type == kExif && file.number(at + 8, 4, false) == kSegment;
    if (type == kExif) return orientation_in(file, at + 8 + (is_segment ? 6 : 0));
    at += 8 + static_cast<std::streamoff>(length) + length % 2;
  }
  return 0;
}

template <class T>
Image<T> upright_image(const Image<T>& stored, int orientation) {
  const bool is_turned = is_quarter_turn(orientation);
  const int height = is_turned ? stored.width() : stored.height();
  const int width = is_turned ? stored.height() : stored.width();
  // Where the first row, and the first column, of what was stored lie in the picture.
  const bool is_right_to_left =
      orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
  const bool is_upwards =
      orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
  Image<T> image(height, width, stored.channels());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int from_left = is_right_to_left ? width - 1 - x : x;
      const int from_top = is_upwards ? height - 1 - y : y;
      const T* in = is_turned ? &stored.at(from_left, from_top) : &stored.at(from_top, from_left);
      std::copy_n(in, stored.channels(), &image.at(y, x));
    }
  }
  return image;
}

}  // namespace

int exif_orientation(const fs::path& path) {
  const std::string suffix = suffix_of(path);
  const bool can_state =
      suffix == ".jpg" || suffix == ".jpeg" || suffix == ".png" || suffix == ".webp";
  if (!can_state) return 1;
  FileBytes file(path);
  const int orientation = file.begins_with("\xff\xd8")            ? orientation_in_jpeg(file)
                          : file.begins_with("\x89PNG\r\n\x1a\n") ? orientation_in_png(file)
                          : file.begins_with("RIFF")              ? orientation_in_webp(file)
                                                                  : 0;
  return orientation >= 1 && orientation <= 8 ? orientation : 1;
}

AnyImage upright(AnyImage stored, int orientation) {
  if (orientation == 1) return stored;
  return std::visit(
      [&](const auto& image) -> AnyImage { return upright_image(image, orientation); }, stored);
}

std::string_view orientation_text(int orientation) {
  constexpr std::string_view kMeanings[] = {"upright",
                                            finding_text("exif.mirrored"),
                                            finding_text("exif.half_turn"),
                                            finding_text("exif.upside_down"),
                                            finding_text("exif.turned_mirrored"),
                                            finding_text("exif.left"),
                                            finding_text("exif.turned_mirrored"),
                                            finding_text("exif.right")};
  return kMeanings[orientation - 1];
}

CommonOrientation common_orientation(const std::vector<fs::path>& files) {
  std::map<int, int> counts;
  for (const fs::path& file : files) ++counts[exif_orientation(file)];
  const auto most = std::ranges::max_element(counts, {}, &std::pair<const int, int>::second);
  if (counts.size() == 1) {
    const int value = most->first;
    if (value == 1) return {};
    return {value, fmt::format(finding_text("exif.all"), orientation_text(value), value)};
  }
  if (counts.empty()) return {};
  return {1, fmt::format(finding_text("exif.different"), counts.size(), most->second, files.size(),
                         most->first)};
}

}  // namespace episcope::io
