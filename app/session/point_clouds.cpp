// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/point_clouds.h"

#include "app/session/picture.h"
#include "engine/core/disparity_field.h"
#include "engine/core/point_cloud.h"
#include "engine/io/base/ply.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

/// A software renderer draws this many points of all sources fluently,
constexpr double kFewPoints = 100'000;
/// and this many of surfaces, whose triangles are twice as many.
constexpr double kFewCorners = 40'000;
/// Between sources side by side, as part of the width of the wider one.
constexpr double kRoomBetween = 0.06;

int step_for(double pixels, double most) {
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / most))));
}

RgbaImage uniform(int height, int width, const Rgb& color) {
  RgbaImage image(height, width, 4, 255);
  for (std::size_t i = 0; i < image.size(); i += 4) {
    std::ranges::copy(color, image.data() + i);
  }
  return image;
}

/// Makes the parts of one request.
class Maker {
 public:
  Maker(const PointCloudRequest& request, const Progress& progress)
      : request_(request), progress_(progress) {}

  PointClouds make() {
    if (request_.coloring == PointCloudColoring::Map) scene_.shading = request_.shading;
    if (request_.coloring == PointCloudColoring::Distance && request_.reference) measure();
    for (std::size_t i = 0; i < request_.sources.size(); ++i) {
      progress_.check();
      scene_.parts.push_back(part(i));
    }
    if (request_.is_beside) moveApart();
    return std::move(scene_);
  }

 private:
  [[nodiscard]] ImageView<const std::uint8_t> shown() const {
    return request_.light_field->valid_of(request_.view);
  }

  void measure() {
    const ShownDisparity estimate(request_.sources.front().field->view(request_.view), shown());
    const ShownDisparity reference(request_.reference->view(request_.view), shown());
    scene_.distance = cloud_distance(estimate.view(), reference.view(),
                                     request_.light_field->info().camera, progress_);
    const double most = scene_.distance->percentile95;
    scene_.shading = render::Shading{render::color_map("viridis"), {0, most > 0 ? most : 1}};
  }

  [[nodiscard]] RgbaImage colors(std::size_t i) const {
    const PointCloudSource& source = request_.sources[i];
    const auto& map = source.field->disparity;
    switch (request_.coloring) {
      case PointCloudColoring::Map:
        if (source.map) return map_picture(*make_map(*source.map), request_.shading);
        break;
      case PointCloudColoring::Distance:
        if (i == 0 && scene_.distance) {
          return render::shade(scene_.distance->distance, {}, *scene_.shading);
        }
        break;
      case PointCloudColoring::Source:
        return uniform(map.height(), map.width(), kSourceColors[i % std::size(kSourceColors)]);
      case PointCloudColoring::View:
        break;
    }
    const auto tone = render::table_of(request_.tone);
    return render::shade_view(*request_.light_field, request_.view, tone.get());
  }

  [[nodiscard]] PointCloud cloud(const DisparityView& map, const RgbaImage& rgba, int step) const {
    PointCloud made =
        make_point_cloud(map, request_.light_field->info().camera, rgba, {.step = step});
    if (request_.jump_px) join_to_surface(made, map, step, *request_.jump_px);
    return made;
  }

  [[nodiscard]] CloudPart part(std::size_t i) const {
    const RgbaImage rgba = colors(i);
    progress_.check();
    const ShownDisparity map(request_.sources[i].field->view(request_.view), shown());
    CloudPart made{cloud(map.view(), rgba, 1), {}};
    progress_.check();
    const double most = request_.jump_px ? kFewCorners : kFewPoints;
    const int step = step_for(static_cast<double>(made.all.positions.size()),
                              most / static_cast<double>(request_.sources.size()));
    if (step > 1) made.few = cloud(map.view(), rgba, step);
    return made;
  }

  void moveApart() {
    double left = 0;
    for (std::size_t i = 0; i < scene_.parts.size(); ++i) {
      const auto box = robust_bounds(scene_.parts[i].all);
      const double width = box[1] - box[0];
      const double shift = i == 0 ? 0 : left - box[0];
      for (PointCloud* moved : {&scene_.parts[i].all, &scene_.parts[i].few}) {
        for (auto& position : moved->positions) position[0] += static_cast<float>(shift);
      }
      left = box[1] + shift + kRoomBetween * width;
    }
  }

  const PointCloudRequest& request_;
  const Progress& progress_;
  PointClouds scene_;
};

}  // namespace

PointClouds make_point_clouds(const PointCloudRequest& request, const Progress& progress) {
  return Maker(request, progress).make();
}

void save_point_clouds(const std::filesystem::path& path, const std::vector<CloudPart>& parts) {
  PointCloud all;
  for (const CloudPart& part : parts) {
    const auto first = static_cast<std::uint32_t>(all.positions.size());
    const PointCloud& cloud = part.all;
    all.positions.insert(all.positions.end(), cloud.positions.begin(), cloud.positions.end());
    all.colors.insert(all.colors.end(), cloud.colors.begin(), cloud.colors.end());
    for (const auto& [a, b, c] : cloud.triangles) {
      all.triangles.push_back({a + first, b + first, c + first});
    }
  }
  io::write_ply(path, all);
}

}  // namespace episcope
