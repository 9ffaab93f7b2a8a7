// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/left_out.h"

#include "engine/core/error.h"
#include "engine/io/grid/decode_image.h"
#include "engine/io/grid/name_parts.h"
#include "engine/io/grid/name_words.h"

#include <fmt/format.h>

#include <algorithm>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFew = 3;       ///< So many strays are no matter.
constexpr std::size_t kLookedAt = 5;  ///< Evenly spread over all.

bool looks_like_views(const fs::path& path, const LightField::Samples& samples) {
  try {
    const AnyImage image = decode_image(path);
    return std::visit(
        [&]<class T>(const ViewStack<T>& views) {
          const auto* same = std::get_if<Image<T>>(&image);
          return same != nullptr && same->height() == views.height() &&
                 same->width() == views.width() && same->channels() == views.channels();
        },
        samples);
  } catch (const IoError&) {
    return false;
  }
}

}  // namespace

void warn_of_left_out(const std::vector<fs::path>& left_out, const LightField::Samples& samples,
                      ConventionReport& report) {
  std::vector<fs::path> strays = left_out;
  std::erase_if(strays, [](const fs::path& path) {
    return names_companions(path.stem().string()) || names_mosaics(path.stem().string());
  });
  if (strays.size() <= kFew) return;
  std::size_t similar = 0;
  for (std::size_t i = 0; i < kLookedAt; ++i) {
    similar += looks_like_views(strays[i * (strays.size() - 1) / (kLookedAt - 1)], samples) ? 1 : 0;
  }
  if (2 * similar <= kLookedAt) return;
  report.warnings.push_back(
      fmt::format("{} images look like views, but their names have another form, such as {}: they "
                  "are not used. If they belong to the grid, name a pattern that matches all.",
                  strays.size(), strays.front().filename().string()));
}

std::vector<fs::path> without_other_numbers(std::vector<fs::path> left_out, const fs::path& view) {
  const std::string skeleton = split_name(view).skeleton;
  std::erase_if(left_out,
                [&](const fs::path& path) { return split_name(path).skeleton == skeleton; });
  return left_out;
}

}  // namespace episcope::io
