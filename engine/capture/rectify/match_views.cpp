// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/rectify/match_views.h"

#include "engine/capture/rectify/grey_view.h"
#include "engine/core/error.h"
#include "engine/core/parallel/parallel.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace episcope::capture {
namespace {

constexpr int kMostPoints = 900;
constexpr std::size_t kLeastPoints = 30;
constexpr int kSearchRows = 8;  // by which rows of neighbours may differ

cv::Mat matrix_of(const Image<float>& picture) {
  return {picture.height(), picture.width(), CV_32F, const_cast<float*>(picture.data())};
}

std::vector<PlanePoint> corners_of(const Image<float>& picture) {
  constexpr int margin = Patch::kReach + 2;
  if (picture.height() <= 4 * margin || picture.width() <= 4 * margin) return {};
  const cv::Rect inside(margin, margin, picture.width() - 2 * margin,
                        picture.height() - 2 * margin);
  const double distance = std::sqrt(picture.size() / (2.0 * kMostPoints));
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(matrix_of(picture)(inside), corners, kMostPoints, 0.002, distance,
                          cv::noArray(), 5);
  std::vector<PlanePoint> points;
  points.reserve(corners.size());
  for (const cv::Point2f& p : corners) {
    points.push_back({std::round(p.x) + margin, std::round(p.y) + margin});
  }
  return points;
}

/// A point on its way through the grid: it moves by a·du + a⊥·dv, a found by least squares.
struct Track {
  PlanePoint start;
  PlanePoint sum;     ///< Of what pulls on a,
  double weight = 0;  ///< and its weight.

  [[nodiscard]] PlanePoint predicted(double du, double dv) const {
    const double x = sum.x / weight;
    const double y = sum.y / weight;
    return {start.x + x * du - y * dv, start.y + y * du + x * dv};
  }
  void learn(double du, double dv, const PlanePoint& place) {
    const double dx = place.x - start.x;
    const double dy = place.y - start.y;
    sum.x += du * dx + dv * dy;
    sum.y += du * dy - dv * dx;
    weight += du * du + dv * dv;
  }
};

/// The whole pixel at which a neighbour looks like the surroundings of a point.
std::optional<PlanePoint> search(const Image<float>& from, const Image<float>& to,
                                 const PlanePoint& point, int reach_x, int reach_y) {
  constexpr int side = Patch::kSide;
  const int x = static_cast<int>(point.x) - Patch::kReach;
  const int y = static_cast<int>(point.y) - Patch::kReach;
  const cv::Rect whole(0, 0, to.width(), to.height());
  const cv::Rect area =
      cv::Rect(x - reach_x, y - reach_y, side + 2 * reach_x, side + 2 * reach_y) & whole;
  if (area.width < side || area.height < side) return {};
  cv::Mat score;
  cv::matchTemplate(matrix_of(to)(area), matrix_of(from)(cv::Rect(x, y, side, side)), score,
                    cv::TM_CCOEFF_NORMED);
  double best = 0;
  cv::Point place;
  cv::minMaxLoc(score, nullptr, &best, nullptr, &place);
  if (best < 0.8) return {};
  return PlanePoint{static_cast<double>(area.x + place.x + Patch::kReach),
                    static_cast<double>(area.y + place.y + Patch::kReach)};
}

class Matcher {
 public:
  Matcher(const LightField& field, const Progress& progress)
      : field_(field), progress_(progress), center_(grey_view(field, field.center())) {
    for (const PlanePoint& point : corners_of(center_)) {
      tracks_.push_back({point, {}, 0});
      patches_.emplace_back(center_, static_cast<int>(point.y), static_cast<int>(point.x));
    }
  }

  ViewMatches run() {
    start();
    matches_.grid = field_.grid();
    matches_.found.resize(field_.grid().count());
    for (const Track& track : tracks_) matches_.points.push_back(track.start);
    const std::vector<int> order = views_by_distance();
    for (std::size_t i = 0; i < order.size(); ++i) {
      follow(order[i]);
      progress_.report(0.1 + 0.9 * static_cast<double>(i + 1) / static_cast<double>(order.size()));
    }
    return std::move(matches_);
  }

 private:
  /// Parallax to the neighbours of the centre; keeps the points that have one.
  void start() {
    const GridShape grid = field_.grid();
    const ViewIndex middle = field_.center();
    const bool has_columns = grid.u > 1;
    const ViewIndex next = has_columns ? ViewIndex{middle.v, middle.u > 0 ? middle.u - 1 : 1}
                                       : ViewIndex{middle.v > 0 ? middle.v - 1 : 1, middle.u};
    if (!grid.contains(next)) throw InvalidInput("there is only one photograph; a grid is needed");
    const Image<float> picture = grey_view(field_, next);
    const int reach = field_.width() / 8;
    parallel_for(static_cast<int>(tracks_.size()), progress_.part(0, 0.1), [&](int i) {
      Track& track = tracks_[i];
      const auto place = search(center_, picture, track.start, has_columns ? reach : kSearchRows,
                                has_columns ? kSearchRows : reach);
      if (place) track.learn(next.u - middle.u, next.v - middle.v, *place);
    });
    keep_started();
  }

  void keep_started() {
    std::vector<Track> tracks;
    std::vector<Patch> patches;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      if (tracks_[i].weight == 0) continue;
      tracks.push_back(tracks_[i]);
      patches.push_back(patches_[i]);
    }
    tracks_ = std::move(tracks);
    patches_ = std::move(patches);
    if (tracks_.size() >= kLeastPoints) return;
    throw InvalidInput(
        "only " + std::to_string(tracks_.size()) +
        " points of the centre photograph were found in its neighbour; the photographs lack "
        "texture, overlap too little, or are not in the order of the grid");
  }

  [[nodiscard]] std::vector<int> views_by_distance() const {
    const ViewIndex middle = field_.center();
    std::vector<int> order(field_.grid().count());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
    std::ranges::stable_sort(order, {}, [&](int index) {
      const ViewIndex view = field_.grid().view_at(index);
      const int du = view.u - middle.u;
      const int dv = view.v - middle.v;
      return du * du + dv * dv;
    });
    return order;
  }

  void follow(int index) {
    const ViewIndex view = field_.grid().view_at(index);
    const double du = view.u - field_.center().u;
    const double dv = view.v - field_.center().v;
    progress_.step("matching view " + view_text(view));
    auto& found = matches_.found[index];
    found.resize(tracks_.size());
    if (view == field_.center()) {
      for (std::size_t i = 0; i < tracks_.size(); ++i) found[i] = PatchMatch{tracks_[i].start, 1};
      return;
    }
    const Image<float> picture = grey_view(field_, view);
    parallel_for(static_cast<int>(tracks_.size()), progress_.part(0, 0), [&](int i) {
      Track& track = tracks_[i];
      found[i] = patches_[i].find(picture, track.predicted(du, dv));
      if (found[i]) track.learn(du, dv, found[i]->place);
    });
  }

  const LightField& field_;
  Progress progress_;
  Image<float> center_;
  std::vector<Track> tracks_;
  std::vector<Patch> patches_;
  ViewMatches matches_;
};

}  // namespace

ViewMatches match_views(const LightField& field, const Progress& progress) {
  return Matcher(field, progress).run();
}

std::vector<double> vertical_disparities(const ViewMatches& matches) {
  std::vector<double> differences;
  for (int v = 0; v < matches.grid.v; ++v) {
    for (int u = 0; u + 1 < matches.grid.u; ++u) {
      const auto& left = matches.of({v, u});
      const auto& right = matches.of({v, u + 1});
      for (std::size_t i = 0; i < left.size(); ++i) {
        if (!left[i] || !right[i]) continue;
        differences.push_back(std::abs(left[i]->place.y - right[i]->place.y));
      }
    }
  }
  std::ranges::sort(differences);
  return differences;
}

std::vector<double> view_gains(const ViewMatches& matches) {
  std::vector<double> gains;
  for (const auto& view : matches.found) {
    std::vector<double> of_view;
    for (const auto& match : view) {
      if (match) of_view.push_back(match->gain);
    }
    std::ranges::sort(of_view);
    gains.push_back(of_view.empty() ? 1 : of_view[of_view.size() / 2]);
  }
  return gains;
}

}  // namespace episcope::capture
