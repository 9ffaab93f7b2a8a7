// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/correct_views.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/labeling/label_review.h"
#include "engine/labeling/regularizer.h"
#include "engine/labeling/solve_views.h"
#include "engine/solvers/simplex_labeling.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <set>
#include <utility>
#include <vector>

namespace episcope {

ProbabilityMap with_layers(VolumeView<const std::uint8_t> map, const std::vector<std::int32_t>& ids,
                           const std::vector<std::int32_t>& more) {
  ProbabilityMap wide(map.height, static_cast<int>(more.size()), map.width);
  for (std::size_t l = 0; l < more.size(); ++l) {
    const auto found = std::ranges::find(ids, more[l]);
    for (int y = 0; y < map.height; ++y) {
      std::uint8_t* const to = wide.view().row(y, static_cast<int>(l));
      if (found == ids.end()) {
        std::fill_n(to, map.width, std::uint8_t{0});
      } else {
        std::copy_n(map.row(y, static_cast<int>(found - ids.begin())), map.width, to);
      }
    }
  }
  return wide;
}

Image<std::int32_t> layers_after(ImageView<const std::int32_t> labels,
                                 const Image<std::uint8_t>& news, const ProbabilityMap& after,
                                 const std::vector<std::int32_t>& ids) {
  Image<std::int32_t> found = most_probable_labels(after.view(), ids);
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      if (news.at(y, x) == 0 && labels.at(y, x) > 0) found.at(y, x) = labels.at(y, x);
    }
  }
  find_layers(found, ids, found.view());
  return found;
}

Image<std::uint8_t> news_of(VolumeView<const std::uint8_t> before,
                            VolumeView<const std::uint8_t> after,
                            ImageView<const std::uint8_t> painted) {
  Image<std::uint8_t> differs(before.height, before.width);
  for (int y = 0; y < before.height; ++y) {
    std::uint8_t* const row = differs.row(y);
    for (int l = 0; l < before.layers; ++l) {
      const std::uint8_t *const a = before.row(y, l), *const b = after.row(y, l);
      for (int x = 0; x < before.width; ++x) row[x] |= std::abs(a[x] - b[x]) >= kNewsOfCode;
    }
  }
  Image<std::uint8_t> news(before.height, before.width);
  for (const Blob& blob : blobs_of(differs, Neighbors::Corners, kFewestNews)) {
    for (int y = blob.bounds.y0; y < blob.bounds.y1; ++y) {
      for (int x = blob.bounds.x0; x < blob.bounds.x1; ++x) {
        if (blob.contains({y, x})) news.at(y, x) = 1;
      }
    }
  }
  if (painted.empty()) return news;
  for (int y = 0; y < news.height(); ++y) {
    for (int x = 0; x < news.width(); ++x) news.at(y, x) |= painted.at(y, x) != 0;
  }
  return news;
}

namespace {

const Image<std::int32_t>* strokes_on(const Scribbles& scribbles, ViewIndex view) {
  const auto found = std::ranges::find(scribbles.views, view, &ViewScribbles::view);
  return found == scribbles.views.end() ? nullptr : &found->labels;
}

// 1 where strokes differ, of which null has none; empty if they are the same.
Image<std::uint8_t> difference(const Image<std::int32_t>* before,
                               const Image<std::int32_t>* after) {
  const Image<std::int32_t>& either = before ? *before : *after;
  const Image<std::int32_t> none(either.height(), either.width());
  const Image<std::int32_t>&a = before ? *before : none, &b = after ? *after : none;
  Image<std::uint8_t> changed(none.height(), none.width());
  std::transform(a.begin(), a.end(), b.begin(), changed.begin(),
                 [](std::int32_t was, std::int32_t is) { return was != is ? 1 : 0; });
  const bool is_any = std::ranges::any_of(changed, [](std::uint8_t each) { return each != 0; });
  return is_any ? std::move(changed) : Image<std::uint8_t>();
}

void require_fit(const ViewScribbles& painted, const LightField& lf) {
  if (lf.grid().contains(painted.view) && painted.labels.height() == lf.height() &&
      painted.labels.width() == lf.width()) {
    return;
  }
  throw InvalidInput(fmt::format(
      "scribbles of {}×{} px on view {} do not fit the light field {} of {}×{} views of {}×{} px",
      painted.labels.width(), painted.labels.height(), view_text(painted.view), lf.info().name,
      lf.grid().v, lf.grid().u, lf.width(), lf.height()));
}

struct Painted {
  const ViewScribbles* view;
  std::ptrdiff_t pixels = 0;
  std::set<std::int32_t> labels{};
};

Painted painted_in(const ViewScribbles& view) {
  Painted painted{&view};
  std::int32_t last = 0;
  for (const std::int32_t label : view.labels) {
    if (label != last) painted.labels.insert(label);
    last = label;
    painted.pixels += label != 0 ? 1 : 0;
  }
  return painted;
}

// Colors must agree that much for a ray to see the same scene point.
constexpr float kLeastTrust = 0.25F;

void copy_pixel(VolumeView<const std::uint8_t> from, std::int32_t pixel,
                VolumeView<std::uint8_t> to, int y, int x) {
  const int from_y = pixel / from.width, from_x = pixel % from.width;
  for (int l = 0; l < to.layers; ++l) to.row(y, l)[x] = from.row(from_y, l)[from_x];
}

// Rows of one view that see the news of another.
class NewsRow {
 public:
  NewsRow(const ViewNews& news, const DisparityField& disparity, const RayColors& colors)
      : news_(news),
        disparity_(disparity),
        colors_(colors),
        targets_(static_cast<std::size_t>(news.news.width)),
        trusts_(targets_.size()) {}

  void carry(ViewIndex view, int y, VolumeView<std::uint8_t> into, std::uint8_t* changed) {
    find_ray_targets(disparity_.view(view), disparity_.view(news_.view),
                     {news_.view.v - view.v, news_.view.u - view.u}, y, targets_.data());
    const int width = news_.news.width;
    const bool has_news = std::any_of(targets_.begin(), targets_.end(), [&](std::int32_t target) {
      return target >= 0 && news_.news.data[target] != 0;
    });
    if (!has_news) return;
    colors_.trusts(colors_.pair(view, y, news_.view), {0, width}, targets_.data(), trusts_.data());
    for (int x = 0; x < width; ++x) {
      if (targets_[x] < 0 || news_.news.data[targets_[x]] == 0 || trusts_[x] < kLeastTrust)
        continue;
      copy_pixel(news_.probabilities, targets_[x], into, y, x);
      changed[x] = 1;
    }
  }

 private:
  const ViewNews& news_;
  const DisparityField& disparity_;
  const RayColors& colors_;
  std::vector<std::int32_t> targets_;
  std::vector<float> trusts_;
};

void take_news(const ViewNews& news, VolumeView<std::uint8_t> into,
               ImageView<std::uint8_t> changed) {
  for (int y = 0; y < into.height; ++y) {
    for (int x = 0; x < into.width; ++x) {
      if (news.news.at(y, x) == 0) continue;
      copy_pixel(news.probabilities, y * into.width + x, into, y, x);
      changed.at(y, x) = 1;
    }
  }
}

// The marked pixels of a view, and those around them.
Image<std::uint8_t> around(ImageView<const std::uint8_t> marks, int reach_px) {
  const cv::Size window(2 * reach_px + 1, 2 * reach_px + 1);
  // OpenCV has no constant matrices; this one is only read.
  const cv::Mat map(marks.height, marks.width, CV_8U, const_cast<std::uint8_t*>(marks.data));
  Image<std::uint8_t> all(marks.height, marks.width);
  cv::Mat wide(all.height(), all.width(), CV_8U, all.data());
  cv::dilate(map, wide, cv::getStructuringElement(cv::MORPH_RECT, window));
  return all;
}

// The marked pixels of each square of so many px that has some.
constexpr int kTile_px = 32;
std::vector<Blob> tiles_of(const Image<std::uint8_t>& marks) {
  std::vector<Blob> tiles;
  const cv::Mat map(marks.height(), marks.width(), CV_8U, const_cast<std::uint8_t*>(marks.data()));
  for (int y = 0; y < map.rows; y += kTile_px) {
    for (int x = 0; x < map.cols; x += kTile_px) {
      const cv::Rect square = cv::Rect(x, y, kTile_px, kTile_px) & cv::Rect({}, map.size());
      const cv::Rect marked = cv::boundingRect(map(square)) + square.tl();
      if (marked.empty()) continue;
      Blob& tile = tiles.emplace_back();
      tile.bounds = {marked.y, marked.x, marked.br().y, marked.br().x};
      tile.mask = Image<std::uint8_t>(marked.height, marked.width);
      map(marked).copyTo(cv::Mat(marked.size(), CV_8U, tile.mask.data()));
    }
  }
  return tiles;
}

// A part of a view that is solved again, with a border of one pixel that is held.
struct Part {
  const Blob& blob;
  PixelRect rect;
  Image<float> weights;       // Of boundaries in `rect`; empty without edges.
  std::vector<int> layers{};  // The labels that come into question.

  [[nodiscard]] int height() const { return rect.y1 - rect.y0; }
  [[nodiscard]] int width() const { return rect.x1 - rect.x0; }
};

Image<float> part_of(const Image<float>& weights, const PixelRect& rect) {
  if (weights.empty()) return {};
  Image<float> part(rect.y1 - rect.y0, rect.x1 - rect.x0);
  for (int y = 0; y < part.height(); ++y) {
    std::copy_n(weights.row(y + rect.y0) + rect.x0, part.width(), part.row(y));
  }
  return part;
}

// A view that was solved: its layers before and after.
struct SolvedView {
  ViewIndex view;
  ImageView<const std::int32_t> before, after;
};

// Rays this near to a boundary that was carried along the rays are solved again.
constexpr int kBoundary_px = 3;

class ViewCorrector {
 public:
  ViewCorrector(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                const RayColors& colors)
      : input_(input),
        parameters_(parameters),
        colors_(colors),
        table_(cost_table(parameters.floor)),
        costs_(input.disparity->disparity.height(),
               static_cast<int>(input.probabilities->ids.size()),
               input.disparity->disparity.width()),
        targets_(static_cast<std::size_t>(costs_.width())),
        trusts_(targets_.size()) {}

  // Replaces labels of the view, layers, around its changed pixels.
  SimplexResult correct(ViewIndex view, ImageView<const std::uint8_t> changed,
                        const Progress& progress, ImageView<std::int32_t> layers) {
    const Image<std::uint8_t> open = around(changed, kReach_px);
    const auto options = simplex_options(parameters_, parameters_.gap_all_views);
    return solve(view, open, {blobs_of(open, Neighbors::Corners), 1, options}, progress, layers);
  }

  // Likewise, from what became of the rays in a view that was solved.
  SimplexResult follow(const SolvedView& first, ViewIndex view,
                       ImageView<const std::uint8_t> changed, const Progress& progress,
                       ImageView<std::int32_t> layers) {
    const Image<std::uint8_t> open = take_over(first, view, changed, layers);
    auto options = simplex_options(parameters_, parameters_.gap_all_views);
    // Small problems that begin near their solution need few iterations.
    options.racing_iterations = 0;
    return solve(view, open, {tiles_of(open), 0.3F, options}, progress, layers);
  }

 private:
  // What is solved, and how much more than the cheapest label of a pixel one may cost that comes
  // into question.
  struct Task {
    std::vector<Blob> blobs;
    float little = 0;
    SimplexOptions options;
  };
  SimplexResult solve(ViewIndex view, const Image<std::uint8_t>& open, const Task& task,
                      const Progress& progress, ImageView<std::int32_t> layers);
  SimplexResult solve(Part part, const Task& task, const Progress& progress,
                      ImageView<std::int32_t> layers);
  [[nodiscard]] Image<std::int32_t> find_rays(ViewIndex view, ViewIndex other,
                                              const Image<std::uint8_t>& wanted);
  Image<std::uint8_t> take_over(const SolvedView& first, ViewIndex view,
                                ImageView<const std::uint8_t> changed,
                                ImageView<std::int32_t> layers);
  [[nodiscard]] Volume<float> chosen_costs(float little, Part& part,
                                           ImageView<const std::int32_t> layers) const;

  const RayLabelingInput& input_;
  const RayLabelingParameters& parameters_;
  const RayColors& colors_;
  CostTable table_;
  Volume<float> costs_;
  std::vector<std::int32_t> targets_;
  std::vector<float> trusts_;
};

// Where the wanted rays of a view arrive in another one, y·width + x; −1 = not known.
Image<std::int32_t> ViewCorrector::find_rays(ViewIndex view, ViewIndex other,
                                             const Image<std::uint8_t>& wanted) {
  Image<std::int32_t> rays(wanted.height(), wanted.width());
  const ViewIndex step{other.v - view.v, other.u - view.u};
  for (int y = 0; y < rays.height(); ++y) {
    std::fill_n(rays.row(y), rays.width(), -1);
    for (const ColumnRange columns : marked_columns(wanted.row(y), rays.width())) {
      find_ray_targets(input_.disparity->view(view), input_.disparity->view(other), step, y,
                       columns, targets_.data());
      colors_.trusts(colors_.pair(view, y, other), columns, targets_.data(), trusts_.data());
      for (int x = columns.begin; x < columns.end; ++x) {
        if (targets_[x] >= 0 && trusts_[x] >= kLeastTrust) rays.at(y, x) = targets_[x];
      }
    }
  }
  return rays;
}

// Pixels near those whose label has changed in the first view take its labels. Marks those of them
// that lie near a boundary then, or whose points it does not see.
Image<std::uint8_t> ViewCorrector::take_over(const SolvedView& first, ViewIndex view,
                                             ImageView<const std::uint8_t> changed,
                                             ImageView<std::int32_t> layers) {
  Image<std::uint8_t> open = around(changed, kReach_px);
  const Image<std::int32_t> rays = find_rays(view, first.view, open);
  Image<std::uint8_t> news(layers.height, layers.width), boundaries(layers.height, layers.width);
  std::transform(rays.begin(), rays.end(), news.begin(), [&](std::int32_t ray) {
    return ray >= 0 && first.after.data[ray] != first.before.data[ray];
  });
  const Image<std::uint8_t> near = around(news, kReach_px);
  for (int y = 0; y < layers.height; ++y) {
    std::int32_t* const row = layers.row(y);
    for (int x = 0; x < layers.width; ++x) {
      const std::int32_t ray = rays.at(y, x);
      open.at(y, x) &= near.at(y, x) | (ray < 0 && changed.at(y, x));
      if (open.at(y, x)) row[x] = ray >= 0 ? first.after.data[ray] : row[std::max(x - 1, 0)];
      boundaries.at(y, x) =
          row[x] != row[std::max(x - 1, 0)] || row[x] != layers.at(std::max(y - 1, 0), x);
    }
  }
  const Image<std::uint8_t> undecided = around(boundaries, kBoundary_px);
  for (std::size_t i = 0; i < open.size(); ++i) {
    open.data()[i] &= undecided.data()[i] | (rays.data()[i] < 0);
  }
  return open;
}

// Of the labels that come into question: that held pixels have, or that cost some pixel little more
// than its best one.
Volume<float> ViewCorrector::chosen_costs(float little, Part& part,
                                          ImageView<const std::int32_t> layers) const {
  const VolumeView<const float> all = costs_.view();
  const int count = all.layers;
  std::vector<bool> counts(static_cast<std::size_t>(count));
  for (int y = 0; y < part.height(); ++y) {
    for (int x = 0; x < part.width(); ++x) {
      const PixelIndex at{y + part.rect.y0, x + part.rect.x0};
      counts[static_cast<std::size_t>(layers.at(at.y, at.x))] = true;
      if (!part.blob.contains(at)) continue;
      float least = all.at(at.y, 0, at.x);
      for (int l = 1; l < count; ++l) least = std::min(least, all.at(at.y, l, at.x));
      for (int l = 0; l < count; ++l) {
        if (all.at(at.y, l, at.x) < least + little) counts[static_cast<std::size_t>(l)] = true;
      }
    }
  }
  for (int l = 0; l < count; ++l) {
    if (counts[static_cast<std::size_t>(l)]) part.layers.push_back(l);
  }
  const float held = price_of_held(parameters_.smoothness);
  Volume<float> chosen(part.height(), static_cast<int>(part.layers.size()), part.width());
  for (int y = 0; y < part.height(); ++y) {
    for (int x = 0; x < part.width(); ++x) {
      const PixelIndex at{y + part.rect.y0, x + part.rect.x0};
      const bool is_free = part.blob.contains(at);
      for (int l = 0; l < chosen.layers(); ++l) {
        const int layer = part.layers[static_cast<std::size_t>(l)];
        chosen.view().at(y, l, x) = is_free                          ? all.at(at.y, layer, at.x)
                                    : layers.at(at.y, at.x) == layer ? 0.0F
                                                                     : held;
      }
    }
  }
  return chosen;
}

SimplexResult ViewCorrector::solve(ViewIndex view, const Image<std::uint8_t>& open,
                                   const Task& task, const Progress& progress,
                                   ImageView<std::int32_t> layers) {
  SimplexResult sum;
  if (task.blobs.empty()) return sum;
  fill_track_costs(
      {*input_.probabilities, *input_.disparity, view, TrackViews::Near, &colors_, open}, table_,
      progress.part(0, 0), costs_.view());
  hold_painted(painted_layers(input_, view), price_of_held(parameters_.smoothness), costs_.view());
  const Image<float> weights = boundary_weights_of(input_, view);
  for (const Blob& blob : task.blobs) {
    const PixelRect& own = blob.bounds;
    const PixelRect rect{std::max(own.y0 - 1, 0), std::max(own.x0 - 1, 0),
                         std::min(own.y1 + 1, layers.height), std::min(own.x1 + 1, layers.width)};
    add_part(solve({blob, rect, part_of(weights, rect)}, task, progress, layers), sum);
  }
  return sum;
}

SimplexResult ViewCorrector::solve(Part part, const Task& task, const Progress& progress,
                                   ImageView<std::int32_t> layers) {
  const Volume<float> costs = chosen_costs(task.little, part, layers);
  SimplexSolver solver(part.height(), costs.layers(), part.width());
  Image<int> solved(part.height(), part.width());
  const SimplexResult result = solver.solve({costs.view(), part.weights, parameters_.smoothness},
                                            task.options, progress, solved.view());
  for (int y = 0; y < part.height(); ++y) {
    for (int x = 0; x < part.width(); ++x) {
      const PixelIndex at{y + part.rect.y0, x + part.rect.x0};
      if (part.blob.contains(at)) {
        layers.at(at.y, at.x) = part.layers[static_cast<std::size_t>(solved.at(y, x))];
      }
    }
  }
  return result;
}

// The first one, then by distance from it.
std::vector<ViewIndex> outwards(const LabelProbabilities& p, ViewIndex first) {
  std::vector<ViewIndex> views;
  for (int i = 0; i < p.grid.count(); ++i) views.push_back(p.view_at(i));
  std::ranges::stable_sort(views, {}, [first](ViewIndex view) {
    const int v = view.v - first.v, u = view.u - first.u;
    return v * v + u * u;
  });
  return views;
}

// The first view does not wait for the pages of all.
ViewStack<std::int32_t> room_for(const ViewStack<std::int32_t>& labels) {
  return {labels.grid(), labels.height(), labels.width(), 1, labels.first(), allocate_large_zeros};
}

}  // namespace

std::vector<std::int32_t> painted_labels(const Scribbles& scribbles, const LightField& lf) {
  std::set<std::int32_t> found;
  for (const ViewScribbles& painted : scribbles.views) {
    require_fit(painted, lf);
    std::int32_t last = 0;
    for (const std::int32_t label : painted.labels) {
      if (label != last && label > 0) found.insert(label);
      last = label;
    }
  }
  if (found.empty()) {
    throw InvalidInput("nothing is painted yet; paint strokes of at least two labels");
  }
  if (found.size() == 1) {
    throw InvalidInput(
        fmt::format("only label {} is painted; paint a second one as well", *found.begin()));
  }
  return {found.begin(), found.end()};
}

bool have_same_strokes(const std::vector<ViewScribbles>& a, const std::vector<ViewScribbles>& b) {
  return std::ranges::equal(a, b, [](const ViewScribbles& left, const ViewScribbles& right) {
    return left.view == right.view && std::ranges::equal(left.labels, right.labels);
  });
}

std::vector<const ViewScribbles*> teaching_views(const std::vector<ViewScribbles>& views) {
  std::vector<Painted> all;
  for (const ViewScribbles& view : views) all.push_back(painted_in(view));
  if (all.size() > kTeachingViews) {
    std::ranges::stable_sort(all, std::greater<>(), &Painted::pixels);
  }
  std::set<std::int32_t> taught{0};
  std::vector<const ViewScribbles*> chosen;
  for (const Painted& each : all) {
    if (chosen.size() >= kTeachingViews && std::ranges::includes(taught, each.labels)) continue;
    taught.insert(each.labels.begin(), each.labels.end());
    chosen.push_back(each.view);
  }
  return chosen;
}

std::vector<NewStrokes> new_strokes(const Scribbles& former, const Scribbles& now,
                                    ViewIndex first) {
  std::set<std::pair<int, int>> painted;
  for (const Scribbles* each : {&former, &now}) {
    for (const ViewScribbles& view : each->views) painted.insert({view.view.v, view.view.u});
  }
  std::vector<NewStrokes> all;
  for (const auto& [v, u] : painted) {
    Image<std::uint8_t> strokes = difference(strokes_on(former, {v, u}), strokes_on(now, {v, u}));
    if (!strokes.empty()) all.push_back({{v, u}, std::move(strokes)});
  }
  if (all.size() <= kNewViews) return all;
  auto kept = std::ranges::find(all, first, &NewStrokes::view);
  if (kept == all.end()) {
    kept = std::ranges::max_element(
        all, {}, [](const NewStrokes& each) { return std::ranges::count(each.pixels, 1); });
  }
  std::iter_swap(all.begin(), kept);
  all.resize(1);
  return all;
}

void carry_news(const ViewNews& news, const DisparityField& disparity, const RayColors& colors,
                ViewIndex view, LabelProbabilities& into, ChangedRays& changed) {
  const VolumeView<std::uint8_t> of_view = into.view(view).view();
  const ImageView<std::uint8_t> marks = changed.view(view);
  if (view == news.view) return take_news(news, of_view, marks);
  if (!disparity.contains(view)) return;
  NewsRow row(news, disparity, colors);
  for (int y = 0; y < of_view.height; ++y) row.carry(view, y, of_view, marks.row(y));
}

RayLabeling correct_rays(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                         const RayCorrection& correction, const Progress& progress) {
  const LabelProbabilities& p = *input.probabilities;
  const ViewStack<std::int32_t>& labels = correction.labels;
  RayLabeling result;
  result.labels = room_for(labels);
  ViewStack<std::int32_t> before = room_for(labels);
  const std::vector<ViewIndex> views = outwards(p, correction.first);
  std::vector<SimplexResult> parts(views.size());
  progress.step("views");
  const SolvedView solved{views[0], before.view(views[0]), result.labels.view(views[0])};
  const auto correct = [&](ViewCorrector& corrector, std::size_t i, const Progress& part) {
    const ImageView<std::int32_t> layers = result.labels.view(views[i]);
    find_layers(labels.view(views[i]), p.ids, before.view(views[i]));
    std::copy_n(before.view(views[i]).data, layers.size(), layers.data);
    const ImageView<const std::uint8_t> changed = correction.changed.view(views[i]);
    parts[i] = i == 0 ? corrector.correct(views[i], changed, part, layers)
                      : corrector.follow(solved, views[i], changed, part, layers);
    keep_painted(painted_layers(input, views[i]), layers);
    if (correction.on_view) correction.on_view(views[i], layers);
  };
  ViewCorrector first(input, parameters, correction.colors);
  correct(first, 0, progress.part(0, 0.05));
  if (correction.complete) correction.complete(progress.part(0.05, 0.1));
  const Progress alone = progress.part(0, 0).on_one_thread();
  parallel_for_workers(static_cast<int>(views.size()) - 1, progress.part(0.1, 0.9), [&] {
    return [&, corrector = ViewCorrector(input, parameters, correction.colors)](int i) mutable {
      correct(corrector, static_cast<std::size_t>(i) + 1, alone);
    };
  });
  for (const SimplexResult& part : parts) add_part(part, result);
  vote_in_rounds({static_cast<int>(p.ids.size()), *input.disparity, correction.colors, &input},
                 &before, progress.part(0.9, 1), result.labels);
  replace_layers_by_ids(p.ids, result);
  return result;
}

}  // namespace episcope
