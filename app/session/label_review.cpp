// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/label_review.h"

#include "app/session/scene_summary.h"
#include "engine/core/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace episcope {

LabelingScores judge_labeling(const ViewStack<std::int32_t>& labels, ViewIndex view,
                              const ViewStack<std::int32_t>& truth, const GroundTruth& ground_truth,
                              const DisparityField* disparity, const Progress& progress) {
  LabelingScores scores;
  if (!truth.empty() && truth.contains(view) && labels.contains(view)) {
    scores.view = judge_label_quality(labels.view(view), truth.view(view));
  }
  if (labels.grid().count() == 1) return scores;
  if (truth.grid() == labels.grid()) {
    scores.all_views = judge_label_quality(labels, truth, progress);
  }
  const bool knows_rays =
      ground_truth.has_disparity() && ground_truth.field.disparity.grid() == labels.grid();
  if (const DisparityField* rays = knows_rays ? &ground_truth.field : disparity) {
    scores.consistency = label_consistency(labels, *rays, progress).share();
  }
  return scores;
}

LabelingScores matched(LabelingScores scores, const std::vector<LabelInfo>& given,
                       const std::vector<LabelInfo>& truth) {
  const bool has_all = scores.all_views.all.judged() > 0;
  const LabelMatch match =
      match_labels(has_all ? scores.all_views.all : scores.view.all, given, truth);
  for (LabelQuality* quality : {&scores.view, &scores.all_views}) {
    quality->all = quality->all.matched(match);
    quality->boundaries = quality->boundaries.matched(match);
  }
  scores.is_by_overlap = match.is_by_overlap;
  return scores;
}

std::string other_numbers_text(const LabelingScores& scores) {
  const auto share_of = [](const LabelingScores& of) {
    return of.all_views.all.judged() > 0 ? of.all_views.all.share() : of.view.all.share();
  };
  const std::optional<double> as_numbered = share_of(scores);
  const LabelingScores other = matched(scores, {}, {});
  if (!as_numbered || !other.is_by_overlap) return {};
  const double by_overlap = share_of(other).value_or(0);
  if (1 - by_overlap > 0.5 * (1 - *as_numbered)) return {};
  return fmt::format(
      "{:.2f} % of the pixels have the number of their true label, but {:.2f} % do once labels are "
      "matched by overlap: the strokes number them otherwise than GT_LABELS; give --colors TABLE "
      "or strokes with those numbers",
      100 * *as_numbered, 100 * by_overlap);
}

namespace {

/// Below it, labels are of other pixels or other numbers: people paint inside of objects.
constexpr double kUsuallyRight = 0.9;

/// Share of painted pixels that have their label in `labels_of(view)`; views of none are left out.
template <class LabelsOf>
double agreement(const Scribbles& scribbles, const LabelsOf& labels_of) {
  double painted = 0, right = 0;
  for (const ViewScribbles& one : scribbles.views) {
    const ImageView<const std::int32_t> labels = labels_of(one.view);
    if (labels.height != one.labels.height() || labels.width != one.labels.width()) continue;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (one.labels.data()[i] <= 0) continue;
      ++painted;
      right += labels.data[i] == one.labels.data()[i] ? 1 : 0;
    }
  }
  return painted > 0 ? right / painted : 1;
}

/// "label 3", "labels 3, 5".
std::string labels_text(const std::vector<int>& ids) {
  return (ids.size() == 1 ? "label " : "labels ") +
         joined(ids, ", ", [](int id) { return std::to_string(id); });
}

/// Of `ids`, those that `others` lack.
std::vector<int> missing_ids(std::vector<int> ids, const std::vector<int>& others) {
  std::erase_if(ids, [&others](int id) { return std::ranges::binary_search(others, id); });
  return ids;
}

}  // namespace

std::vector<std::string> stroke_notes(const Scribbles& scribbles,
                                      const ViewStack<std::int32_t>& truth) {
  std::vector<std::string> notes;
  if (truth.empty() || scribbles.empty()) return notes;
  std::vector<int> known, painted;
  collect_ids({truth.data(), truth.size()}, known);
  for (const ViewScribbles& one : scribbles.views) {
    collect_ids({one.labels.data(), one.labels.size()}, painted);
  }
  if (const auto unknown = missing_ids(painted, known); !unknown.empty()) {
    notes.push_back("GT_LABELS do not have " + labels_text(unknown) + ", but " +
                    joined(known, ", ", [](int id) { return std::to_string(id); }) +
                    "; pixels of the former count as wrong");
  }
  if (const auto unpainted = missing_ids(known, painted); !unpainted.empty()) {
    notes.push_back("nobody painted " + labels_text(unpainted) +
                    " of GT_LABELS, whose pixels count as wrong");
  }
  const double share = agreement(scribbles, [&truth](ViewIndex view) {
    return truth.contains(view) ? truth.view(view) : ImageView<const std::int32_t>{};
  });
  if (share < kUsuallyRight) {
    notes.push_back(fmt::format(
        "only {:.2f} % of the painted pixels have that label in GT_LABELS: check the place, "
        "direction and numbers of the strokes",
        100 * share));
  }
  return notes;
}

std::string probabilities_note(const LabelProbabilities& probabilities,
                               const Scribbles& scribbles) {
  Image<std::int32_t> best;
  const double share = agreement(scribbles, [&](ViewIndex view) {
    if (!probabilities.contains(view)) return ImageView<const std::int32_t>{};
    best = most_probable_labels(probabilities.view(view).view(), probabilities.ids);
    return std::as_const(best).view();
  });
  if (share >= kUsuallyRight) return {};
  return fmt::format(
      "only {:.2f} % of the painted pixels have their label as the most probable one: check views, "
      "direction, sign and labels of the probabilities",
      100 * share);
}

Metrics labeling_metrics(const LabelingScores& scores) {
  Metrics metrics;
  const auto add = [&metrics](const char* key, const std::optional<double>& share) {
    if (share) metrics.emplace_back(key, *share);
  };
  add("accuracy_all_views", scores.all_views.all.share());
  add("accuracy_center", scores.view.all.share());
  add("miou", scores.all_views.all.mean_overlap());
  add("macc", scores.all_views.all.mean_share());
  add("boundary_accuracy", scores.all_views.boundaries.share());
  add("thin_iou", scores.all_views.thin_overlap());
  add("consistency", scores.consistency);
  return metrics;
}

namespace {

struct Sums {
  std::int64_t pixels = 0;
  std::int64_t measured = 0;
  double sum = 0;
  double squares = 0;
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  void add(const DisparityView& disparity, int y, int x0, int x1) {
    pixels += x1 - x0;
    if (disparity.disparity.empty()) return;
    for (int x = x0; x < x1; ++x) {
      if (!disparity.is_valid(y, x)) continue;
      const double value = disparity.disparity.at(y, x);
      ++measured;
      sum += value;
      squares += value * value;
      min = std::min(min, value);
      max = std::max(max, value);
    }
  }

  [[nodiscard]] std::optional<LabelDisparity> disparity() const {
    if (measured == 0) return std::nullopt;
    const auto count = static_cast<double>(measured);
    const double mean = sum / count;
    return LabelDisparity{mean, std::sqrt(std::max(0.0, squares / count - mean * mean)), min, max};
  }
};

template <class Label>
std::vector<LabelAmount> amounts_of(ImageView<const Label> labels, const DisparityView& disparity) {
  std::map<std::int32_t, Sums> sums;
  for (int y = 0; y < labels.height; ++y) {
    const Label* row = labels.row(y);
    for (int x = 0; x < labels.width;) {
      const int begin = x;
      while (x < labels.width && row[x] == row[begin]) ++x;
      if (row[begin] > 0) sums[row[begin]].add(disparity, y, begin, x);
    }
  }
  std::vector<LabelAmount> amounts;
  for (const auto& [id, each] : sums) amounts.push_back({id, each.pixels, each.disparity()});
  return amounts;
}

}  // namespace

std::vector<LabelAmount> label_amounts(ImageView<const std::int32_t> labels,
                                       const DisparityView& disparity) {
  return amounts_of(labels, disparity);
}

std::vector<LabelAmount> label_amounts(ImageView<const std::uint8_t> labels,
                                       const DisparityView& disparity) {
  return amounts_of(labels, disparity);
}

int LabelSummary::count(PieceKind kind) const {
  return static_cast<int>(std::ranges::count(pieces, kind, &LabelPiece::kind));
}

ViewReview review_view(const Labeling& labeling, const LabelFinish& finish, ViewIndex view,
                       const ScribbleLayer& painted, const DisparityField* disparity,
                       const Progress& progress) {
  const Image<std::int32_t> labels = finished_labels(labeling, finish, view);
  const bool has_disparity = disparity && disparity->contains(view);
  const std::vector<LabelAmount> amounts =
      label_amounts(labels, has_disparity ? disparity->view(view) : DisparityView{});
  ViewReview review;
  for (const std::int32_t id : labeling.probabilities.ids) {
    progress.check();
    const auto amount = std::ranges::find(amounts, id, &LabelAmount::id);
    review.labels.push_back(
        {amount == amounts.end() ? LabelAmount{id} : *amount, pieces_of(labels, id)});
  }
  if (!labeling.probabilities.contains(view)) return review;
  progress.check();
  review.doubts = label_doubts(labeling.probabilities.view(view).view(), labeling.probabilities.ids,
                               labels, painted.view(view));
  return review;
}

namespace {

// Images of labels by place along a line: rows of horizontal EPIs, columns of vertical ones.
class Lines {
 public:
  explicit Lines(EpiDirection direction) : is_horizontal_(direction == EpiDirection::Horizontal) {}

  [[nodiscard]] int count(const Image<std::int32_t>& labels) const {
    return is_horizontal_ ? labels.height() : labels.width();
  }
  [[nodiscard]] int length(const Image<std::int32_t>& labels) const {
    return is_horizontal_ ? labels.width() : labels.height();
  }
  [[nodiscard]] std::int32_t at(const Image<std::int32_t>& labels, int line, int place) const {
    return is_horizontal_ ? labels.at(line, place) : labels.at(place, line);
  }
  [[nodiscard]] bool has(const Image<std::int32_t>& labels, int line, std::int32_t label) const {
    for (int place = 0; place < length(labels); ++place) {
      if (at(labels, line, place) == label) return true;
    }
    return false;
  }

 private:
  bool is_horizontal_;
};

// Labels of the views along the direction.
std::vector<Image<std::int32_t>> labels_along(const Labeling& labeling, const LabelFinish& finish,
                                              const LabelStripChoice& choice,
                                              const Progress& progress) {
  const bool is_horizontal = choice.direction == EpiDirection::Horizontal;
  const GridShape grid = labeling.labels.grid();
  const int count = is_horizontal ? grid.u : grid.v;
  std::vector<Image<std::int32_t>> views;
  for (int i = 0; i < count; ++i) {
    progress.report(static_cast<double>(i) / count);
    const ViewIndex view =
        is_horizontal ? ViewIndex{choice.view.v, i} : ViewIndex{i, choice.view.u};
    views.push_back(finished_labels(labeling, finish, view));
  }
  return views;
}

std::vector<int> chosen_lines(const Image<std::int32_t>& labels, const Lines& lines,
                              const LabelStripChoice& choice) {
  std::vector<int> found;
  for (int line = 0; line < lines.count(labels); ++line) {
    if (lines.has(labels, line, choice.label)) found.push_back(line);
  }
  const int count = std::min(choice.count, static_cast<int>(found.size()));
  std::vector<int> chosen;
  for (int i = 0; i < count; ++i) {
    chosen.push_back(found[found.size() * (2 * i + 1) / (2 * static_cast<std::size_t>(count))]);
  }
  return chosen;
}

struct Reach {
  int begin = 0;
  int end = 0;
};

// Where the label is seen on the lines, in any of the views.
Reach reach_of(const std::vector<Image<std::int32_t>>& views, const Lines& lines,
               const std::vector<int>& chosen, const LabelStripChoice& choice) {
  const int length = lines.length(views.front());
  Reach reach{length, 0};
  for (const auto& labels : views) {
    for (const int line : chosen) {
      for (int place = 0; place < length; ++place) {
        if (lines.at(labels, line, place) != choice.label) continue;
        reach.begin = std::min(reach.begin, place);
        reach.end = std::max(reach.end, place + 1);
      }
    }
  }
  return {std::max(0, reach.begin - choice.margin_px),
          std::min(length, reach.end + choice.margin_px)};
}

RgbaImage cut(const RgbaImage& picture, const Reach& reach) {
  RgbaImage part(picture.height(), reach.end - reach.begin, picture.channels());
  const int channels = picture.channels();
  for (int y = 0; y < part.height(); ++y) {
    const std::uint8_t* from = picture.row(y) + static_cast<std::ptrdiff_t>(reach.begin) * channels;
    std::copy_n(from, static_cast<std::ptrdiff_t>(part.width()) * channels, part.row(y));
  }
  return part;
}

}  // namespace

LabelStrip label_strip(const LightField& light_field, const Labeling& labeling,
                       const LabelFinish& finish, const LabelStripChoice& choice,
                       const Progress& progress) {
  const Lines lines(choice.direction);
  const bool is_horizontal = choice.direction == EpiDirection::Horizontal;
  const auto views = labels_along(labeling, finish, choice, progress.part(0, 0.9));
  const auto here = static_cast<std::size_t>(is_horizontal ? choice.view.u : choice.view.v);
  const std::vector<int> chosen = chosen_lines(views[here], lines, choice);
  const Reach reach = reach_of(views, lines, chosen, choice);
  LabelStrip strip{choice.direction, reach.begin, {}};
  for (const int line : chosen) {
    progress.check();
    const Image<float> samples = is_horizontal ? horizontal_epi(light_field, choice.view, line)
                                               : vertical_epi(light_field, choice.view, line);
    LabelEpi epi{line, cut(render::shade_samples(samples.view()), reach), {}};
    epi.labels = Image<std::int32_t>(epi.picture.height(), epi.picture.width());
    for (int view = 0; view < epi.labels.height(); ++view) {
      const auto& labels = views[static_cast<std::size_t>(view)];
      for (int place = 0; place < epi.labels.width(); ++place) {
        epi.labels.at(view, place) = lines.at(labels, line, reach.begin + place);
      }
    }
    strip.epis.push_back(std::move(epi));
  }
  return strip;
}

}  // namespace episcope
