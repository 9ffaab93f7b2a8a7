// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/labeling/ray_labeling.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace episcope {

/// Ids that are painted on any view, ascending. Throws InvalidInput if nothing or only one label is
/// painted, or if scribbles do not fit the light field.
[[nodiscard]] std::vector<std::int32_t> painted_labels(const Scribbles& scribbles,
                                                       const LightField& light_field);

/// Which painted views a labeler reads. A fill of all views says the same in each of them, so that
/// a few suffice; rays carry to the others what these say.

[[nodiscard]] bool have_same_strokes(const std::vector<ViewScribbles>& a,
                                     const std::vector<ViewScribbles>& b);

/// Most views whose strokes teach, unless more are needed to have every label.
inline constexpr std::size_t kTeachingViews = 8;
/// The views from which a forest learns: all, or of more than kTeachingViews those with most
/// painted pixels, the most first, and any that alone has a label.
[[nodiscard]] std::vector<const ViewScribbles*> teaching_views(
    const std::vector<ViewScribbles>& views);

/// Pixels of a view that have other strokes than before, `[y][x]`, 1 = changed.
struct NewStrokes {
  ViewIndex view;
  Image<std::uint8_t> pixels;
};
/// Most views whose new strokes are read.
inline constexpr std::size_t kNewViews = 4;
/// New strokes of each view that has some. Of more than kNewViews views one remains: `first` if it
/// has new strokes, else the one that has most.
[[nodiscard]] std::vector<NewStrokes> new_strokes(const Scribbles& former, const Scribbles& now,
                                                  ViewIndex first);

/// The same probabilities with a layer for each label of `more`, which includes `ids`; what has
/// none gets 0.
[[nodiscard]] ProbabilityMap with_layers(VolumeView<const std::uint8_t> map,
                                         const std::vector<std::int32_t>& ids,
                                         const std::vector<std::int32_t>& more);

/// How much a probability must change, of 255, to count as news. A forest that is trained again
/// changes all of them a little.
inline constexpr int kNewsOfCode = 51;
/// News of fewer connected pixels do not count, unless they are painted.
inline constexpr int kFewestNews = 12;

/// The pixels of a view of which strokes said something new, `[y][x]`, 1 = news: where a
/// probability differs by kNewsOfCode or more, in connected sets of kFewestNews pixels, and where
/// `painted` (0 = no) says so. `before` and `after` `[y][label][x]` have one shape.
[[nodiscard]] Image<std::uint8_t> news_of(VolumeView<const std::uint8_t> before,
                                          VolumeView<const std::uint8_t> after,
                                          ImageView<const std::uint8_t> painted);

/// Layers of the labels of a view, with the most probable ones where there are news.
[[nodiscard]] Image<std::int32_t> layers_after(ImageView<const std::int32_t> labels,
                                               const Image<std::uint8_t>& news,
                                               const ProbabilityMap& after,
                                               const std::vector<std::int32_t>& ids);

/// Which rays have new probabilities, `[v][u][y][x]`, 1 = new.
using ChangedRays = ViewStack<std::uint8_t>;

/// What strokes said about one view; borrowed.
struct ViewNews {
  ViewIndex view;
  ImageView<const std::uint8_t> news;              ///< As `news_of`.
  VolumeView<const std::uint8_t> probabilities{};  ///< Of the view, after the strokes.
};

/// Carries the news of one view along the rays to `view`: each ray that sees a scene point with
/// news takes its new probabilities, where the colors of both rays agree. Marks those rays in
/// `changed`. Other rays keep what they have.
void carry_news(const ViewNews& news, const DisparityField& disparity, const RayColors& colors,
                ViewIndex view, LabelProbabilities& into, ChangedRays& changed);

/// Rays within so many px of a changed one are solved again.
inline constexpr int kReach_px = 12;

/// What `correct_rays` begins with; borrowed.
struct RayCorrection {
  const ViewStack<std::int32_t>& labels;  ///< Of all views, ids or 0, before the change.
  const ChangedRays& changed;
  ViewIndex first;          ///< The view that is solved first; the others follow by their distance.
  const RayColors& colors;  ///< Of all views.
  /// Called for each view that is solved, from any thread, the first one before all others.
  std::function<void(ViewIndex, ImageView<const std::int32_t> layers)> on_view{};
  /// Called after the first view. Until then, probabilities and `changed` need to be there for the
  /// views near it only (near_views). Empty = all are there.
  std::function<void(const Progress&)> complete{};
};

/// Labels of all views, ids, after the probabilities of some rays have changed, as
/// Regularizer::Rayspace would give them: in the first view, rays within kReach_px of a changed one
/// are solved again. In each other view, rays that near take the new labels of the first view where
/// those have changed nearby, and are solved again beside boundaries and where the first view does
/// not see their points. All others keep their labels. Then rays vote again whose evidence has
/// changed; costs, gap and votes are the same. Energy and bound are of the parts that were solved,
/// with what borders them held. Precondition: `input` has disparities and probabilities of all
/// views. Throws Cancelled.
[[nodiscard]] RayLabeling correct_rays(const RayLabelingInput& input,
                                       const RayLabelingParameters& parameters,
                                       const RayCorrection& correction, const Progress& progress);

}  // namespace episcope
