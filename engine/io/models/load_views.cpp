// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/load_views.h"

#include "engine/core/error.h"
#include "engine/core/memory.h"
#include "engine/core/parallel.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/image_orientation.h"
#include "engine/io/models/names/view_files.h"

#include <fmt/format.h>

#include <unistd.h>
#include <algorithm>
#include <compare>
#include <cstdlib>
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
  LightField::Samples samples;
  std::vector<Outcome> outcomes;

  /// Whether all are of one form, and none has color that the one with the others lacks.
  [[nodiscard]] bool is_whole() const {
    const bool is_grey = std::visit([](const auto& all) { return all.channels() == 1; }, samples);
    return std::ranges::all_of(outcomes, [&](const Outcome& each) {
      return each.form && each.form == outcomes.front().form && (each.is_grey || !is_grey);
    });
  }
};

/// Decodes views, and notes what becomes of each.
class ViewDecoder {
 public:
  explicit ViewDecoder(const ViewFiles& views) : views_(views), outcomes_(views.files.size()) {}

  /// An empty image if it cannot be decoded.
  AnyImage decode(int place) {
    const auto at = static_cast<std::size_t>(place);
    try {
      AnyImage image = upright(decode_image(views_.files[at]), views_.orientation);
      outcomes_[at] = outcome_of(image);
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

 private:
  const ViewFiles& views_;
  std::vector<Outcome> outcomes_;
};

/// Loads the views that fit the first of `references` that can be decoded.
Loaded load_around(const ViewFiles& views, const std::vector<int>& references,
                   const OnCenterView& on_center, const Progress& progress) {
  progress.check();
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
        return {std::move(stack), std::move(decoder.outcomes())};
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
    const std::string why = fmt::format("this view has {}, but {} has {}", each.text,
                                        usual.filename().string(), one->text);
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

UsableViews load_usable_views(const ViewFiles& views, const OnCenterView& on_center,
                              const Progress& progress) {
  Loaded loaded = load_around(views, from_center(views.grid), on_center, progress);
  if (loaded.is_whole()) return {std::move(loaded.samples), views};
  const std::vector<UnusableView> unusable = unusable_views(views, loaded.outcomes);
  UsableViews usable{{}, views};
  if (!unusable.empty()) {
    auto left = usual_form(loaded.outcomes) ? without_views(views, unusable) : std::nullopt;
    if (!left) refuse(views, unusable);
    usable.views = std::move(left->views);
    usable.kept = left->kept;
    usable.warning = std::move(left->warning);
  }
  loaded.samples = {};
  loaded = load_around(usable.views, references_in(usable, views.grid, loaded.outcomes), on_center,
                       progress);
  if (!loaded.is_whole()) refuse(usable.views, unusable_views(usable.views, loaded.outcomes));
  usable.samples = std::move(loaded.samples);
  return usable;
}

LightField::Samples load_views(const ViewFiles& views, const OnCenterView& on_center,
                               const Progress& progress) {
  Loaded loaded = load_around(views, from_center(views.grid), on_center, progress);
  if (!loaded.is_whole()) refuse(views, unusable_views(views, loaded.outcomes));
  return std::move(loaded.samples);
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

}  // namespace episcope::io
