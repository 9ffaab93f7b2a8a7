// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/view_group.h"

#include "engine/core/error.h"
#include "engine/core/text/suffix.h"
#include "engine/io/grid/decode_image.h"
#include "engine/io/grid/index_fields.h"
#include "engine/io/grid/joined_digits.h"
#include "engine/io/grid/lettered_rows.h"
#include "engine/io/grid/name_pattern.h"
#include "engine/io/grid/name_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <tuple>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;
using Form = IndexFields::Form;

/// A full grid is taken rather than a list of up to so many times its views.
constexpr std::size_t kGridsWorth = 4;

struct Candidate {
  const NameGroup* group = nullptr;
  IndexFields fields;
  std::tuple<bool, std::size_t> rank{};  ///< What speaks for it, the most important first.
};

std::vector<Candidate> candidates_of(const std::vector<NameGroup>& groups) {
  std::vector<Candidate> candidates;
  for (const NameGroup& group : groups) {
    if (group.images.size() < 2 || names_mosaics(group.skeleton)) continue;
    Candidate candidate{&group, find_index_fields(group)};
    if (candidate.fields.form == Form::None) continue;
    const std::size_t worth = candidate.fields.form == Form::Grid ? kGridsWorth : 1;
    candidate.rank = {!names_companions(group.skeleton), worth * group.images.size()};
    candidates.push_back(std::move(candidate));
  }
  std::ranges::stable_sort(candidates, std::ranges::greater{}, &Candidate::rank);
  return candidates;
}

struct Look {
  long long area = 0;
  bool is_colour = false;
};

/// Of the first image of a group; nothing for one that cannot be decoded.
Look look_of(const NameGroup& group) {
  try {
    return std::visit(
        [](const auto& image) {
          return Look{static_cast<long long>(image.height()) * image.width(),
                      image.channels() == 3};
        },
        decode_image(group.images.front().path));
  } catch (const IoError&) {
    return {};
  }
}

bool has_words(const NameGroup& group) {
  const fs::path stem = fs::path(group.images.front().path).stem();
  return std::ranges::any_of(stem.string(), [](unsigned char c) { return std::isalpha(c) != 0; });
}

bool has_loss(const NameGroup& group) {
  constexpr std::array kSuffixes{".jpg", ".jpeg", ".webp"};
  const std::string suffix = suffix_of(group.images.front().path);
  return std::ranges::find(kSuffixes, suffix) != kSuffixes.end();
}

/// The one to prefer of candidates of the same rank; throws IoError if there is none.
const Candidate& best_of(const fs::path& folder, const std::vector<Candidate>& candidates) {
  using Merit = std::tuple<long long, bool, bool, bool>;
  std::vector<std::pair<Merit, const Candidate*>> equal;
  for (const Candidate& each : candidates) {
    if (each.rank == candidates.front().rank) equal.push_back({{}, &each});
  }
  if (equal.size() == 1) return candidates.front();
  for (auto& [merit, each] : equal) {
    const Look look = look_of(*each->group);
    merit = {look.area, look.is_colour, !has_words(*each->group), !has_loss(*each->group)};
  }
  std::ranges::stable_sort(equal, std::ranges::greater{},
                           &std::pair<Merit, const Candidate*>::first);
  if (equal[0].first > equal[1].first) return *equal[0].second;
  throw IoError(folder,
                fmt::format("two sets of {} images could be the views, {} and {}; say which by "
                            "--pattern",
                            equal[0].second->group->images.size(),
                            pattern_text(*equal[0].second->group, equal[0].second->fields),
                            pattern_text(*equal[1].second->group, equal[1].second->fields)));
}

[[noreturn]] void refuse(const fs::path& folder, const std::vector<NameGroup>& groups,
                         std::size_t images) {
  const auto mosaics = std::ranges::find_if(
      groups, [](const NameGroup& group) { return names_mosaics(group.skeleton); });
  if (mosaics != groups.end()) {
    throw IoError(folder, "each of these images is a light field of its own, such as " +
                              mosaics->images.front().path.filename().string() +
                              "; open one of them");
  }
  throw IoError(folder, fmt::format("the images do not form a grid of views: {} image{} found, and "
                                    "no number in the names tells row and column; {}",
                                    images, images == 1 ? " was" : "s were", kPatternAdvice));
}

ViewNames names_of(const Candidate& candidate) {
  const IndexFields& fields = candidate.fields;
  ViewNames names{.pattern = pattern_text(*candidate.group, fields)};
  for (const NumberedImage& image : candidate.group->images) {
    NamedView view{.path = image.path};
    const auto number = [&](std::size_t place) {
      const NameNumber& each = image.numbers[place];
      return fields.are_signed ? *each.signed_count() : *each.count();
    };
    if (fields.row) view.row = number(*fields.row);
    if (fields.column) view.column = number(*fields.column);
    if (fields.index) view.index = number(*fields.index);
    if (fields.y) view.y = image.numbers[*fields.y].position();
    if (fields.x) view.x = image.numbers[*fields.x].position();
    names.views.push_back(std::move(view));
  }
  return names;
}

}  // namespace

ViewNames find_view_names(const fs::path& folder, const std::vector<fs::path>& images) {
  std::vector<NameGroup> groups = group_by_name(images);
  join_lettered_rows(groups);
  std::ranges::for_each(groups, separate_joined_digits);
  const std::vector<Candidate> candidates = candidates_of(groups);
  if (candidates.empty()) refuse(folder, groups, images.size());
  const Candidate& best = best_of(folder, candidates);
  if (best.fields.form == Form::Unclear) {
    throw IoError(folder,
                  fmt::format("several numbers vary in the names of {} images, such as {}, "
                              "and it is not clear which are row and column; {}",
                              best.group->images.size(),
                              best.group->images.front().path.filename().string(), kPatternAdvice));
  }
  ViewNames names = names_of(best);
  names.images = static_cast<int>(images.size());
  return names;
}

ViewNames match_view_names(const std::vector<fs::path>& images, const std::string& pattern) {
  const NamePattern compiled(pattern);
  ViewNames names{.pattern = pattern, .is_chosen = true, .images = static_cast<int>(images.size())};
  for (const fs::path& path : images) {
    if (auto view = compiled.match(path)) names.views.push_back(std::move(*view));
  }
  return names;
}

}  // namespace episcope::io
