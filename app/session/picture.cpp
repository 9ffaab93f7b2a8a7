// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/picture.h"

#include "engine/core/disparity_field.h"
#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/evaluation/metrics.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/formats/movie.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace episcope {

namespace {

constexpr int kAlpha = 3;

void check_line(const char* name, int line, int count) {
  if (line >= 0 && line < count) return;
  throw InvalidInput(std::string("there is no image ") + name + " " + std::to_string(line) +
                     "; they count from 0 to " + std::to_string(count - 1));
}

RgbaImage stretched(const RgbaImage& picture) {
  RgbaImage tall(picture.height() * kEpiRowHeight, picture.width(), picture.channels());
  const std::size_t row_size = static_cast<std::size_t>(picture.width()) * picture.channels();
  for (int y = 0; y < tall.height(); ++y) {
    std::copy_n(picture.row(y / kEpiRowHeight), row_size, tall.row(y));
  }
  return tall;
}

// Calls `change` with every pixel that is not judged; labels are all shown.
template <class Change>
RgbaImage shaded(const QuantityMap& map, const render::Shading& shading, const Change& change) {
  if (!map.labels.empty()) {
    return render::shade_labels(map.labels, map.label_infos, map.label_style);
  }
  RgbaImage picture = render::shade(map.map, map.valid, shading);
  if (map.inside.empty()) return picture;
  for (int y = 0; y < picture.height(); ++y) {
    const std::uint8_t* inside = map.inside.row(y);
    for (int x = 0; x < picture.width(); ++x) {
      if (inside[x] == 0) change(&picture.at(y, x));
    }
  }
  return picture;
}

}  // namespace

RgbaImage overlay_picture(const QuantityMap& map, const render::Shading& shading) {
  RgbaImage picture = shaded(map, shading, [](std::uint8_t* pixel) { pixel[kAlpha] = 0; });
  if (!map.has_bad_alone) return picture;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (map.map.at(y, x) != kBadPixel) picture.at(y, x, kAlpha) = 0;
    }
  }
  return picture;
}

RgbaImage map_picture(const QuantityMap& map, const render::Shading& shading) {
  return shaded(map, shading, [&shading](std::uint8_t* pixel) {
    std::copy(shading.map.invalid.begin(), shading.map.invalid.end(), pixel);
  });
}

namespace {

// The weights of qGray, as the canvas has them.
void make_grey(RgbaImage& picture) {
  for (int y = 0; y < picture.height(); ++y) {
    std::uint8_t* pixel = picture.row(y);
    for (int x = 0; x < picture.width(); ++x, pixel += 4) {
      std::fill_n(pixel, kAlpha,
                  static_cast<std::uint8_t>((11 * pixel[0] + 16 * pixel[1] + 5 * pixel[2]) / 32));
    }
  }
}

}  // namespace

RgbaImage over_view(RgbaImage picture, const QuantityMap& map, const render::Shading& shading,
                    const OverlayLook& look) {
  const bool is_covered =
      map.labels.empty() || map.label_style.drawing != render::LabelDrawing::Contours;
  if (is_covered && !look.is_view_colored) make_grey(picture);
  const RgbaImage over = overlay_picture(map, shading);
  const int weight = static_cast<int>(std::lround(look.opacity * 256));
  for (int y = 0; y < picture.height(); ++y) {
    std::uint8_t* below = picture.row(y);
    const std::uint8_t* above = over.row(y);
    for (int x = 0; x < picture.width(); ++x, below += 4, above += 4) {
      const int part = above[kAlpha] * weight / 255;
      for (int c = 0; c < kAlpha; ++c) {
        below[c] = static_cast<std::uint8_t>(below[c] + (above[c] - below[c]) * part / 256);
      }
    }
  }
  return picture;
}

RgbaImage horizontal_epi_picture(const LightField& light_field, ViewIndex view, int y) {
  check_line("row", y, light_field.height());
  return stretched(render::shade_samples(horizontal_epi(light_field, view, y).view()));
}

RgbaImage vertical_epi_picture(const LightField& light_field, ViewIndex view, int x) {
  check_line("column", x, light_field.width());
  return transposed(stretched(render::shade_samples(vertical_epi(light_field, view, x).view())));
}

render::Shading shading_of(render::Quantity quantity, Interval disparity_range,
                           const ShadingChoice& choice) {
  render::Shading shading = render::default_shading(quantity, disparity_range);
  if (!choice.color_map.empty()) shading.map = render::color_map(choice.color_map);
  if (choice.range) shading.range = *choice.range;
  return shading;
}

namespace {

using render::MovieChoice;
using render::MovieKind;
using render::Quantity;

constexpr double kRefocusRate = 12;  // Pictures per second.

GridShape grid_of(const MapSource& source) {
  if (source.light_field) return source.light_field->grid();
  const ViewStack<float>& maps = source.estimate->field.disparity;
  return {maps.first().v + maps.grid().v, maps.first().u + maps.grid().u};
}

bool has_map(const MovieSubject& subject, ViewIndex view) {
  MapSource source = subject.source;
  source.view = view;
  if (source.quantity == Quantity::View) return true;
  if (!reason_against(source).empty()) return false;
  if (!source.evaluation || view == subject.source.view) return true;
  return subject.scene && can_judge(*source.estimate, *subject.scene, view);
}

MapSource in_view(const MovieSubject& subject, ViewIndex view) {
  MapSource source = subject.source;
  if (source.evaluation && !(source.view == view)) {
    source.evaluation =
        std::make_shared<const Evaluation>(judge(*source.estimate, *subject.scene, {}, view));
  }
  source.view = view;
  return source;
}

Movie parallax(const MovieChoice& choice, const MovieSubject& subject) {
  std::vector<ViewIndex> views = render::camera_path(grid_of(subject.source), choice.path);
  std::erase_if(views, [&](ViewIndex view) { return !has_map(subject, view); });
  if (views.empty()) {
    throw InvalidInput(
        "none of the views along the path has such a picture; a movie needs a result of all views");
  }
  const auto count = static_cast<int>(views.size());
  return {count, count / choice.seconds, [views = std::move(views), subject](int i) {
            return subject.draw(in_view(subject, views[i]));
          }};
}

Movie refocused(const MovieChoice& choice, const MovieSubject& subject) {
  if (!subject.source.light_field || subject.source.quantity != Quantity::View) {
    throw InvalidInput("only the view of a light field can be refocused, not a map");
  }
  const int count = std::max(2, static_cast<int>(std::lround(choice.seconds * kRefocusRate)));
  std::vector<double> focus =
      render::there_and_back(choice.focus_px.min, choice.focus_px.max, count);
  return {count, count / choice.seconds, [focus = std::move(focus), subject](int i) {
            const MapSource& source = subject.source;
            const Image<float> samples =
                render::refocus(*source.light_field, source.view, focus[i]);
            return render::shade_samples(samples.view(), subject.tone);
          }};
}

Movie flipped(const MovieChoice& choice, const MovieSubject& subject) {
  if (!subject.other) throw InvalidInput("a flip needs two results; choose a second one");
  return {2, 2 / choice.seconds,
          [subject](int i) { return subject.draw(i == 0 ? subject.source : *subject.other); }};
}

}  // namespace

Movie make_movie(const MovieChoice& choice, const MovieSubject& subject) {
  switch (choice.kind) {
    case MovieKind::Parallax:
      return parallax(choice, subject);
    case MovieKind::Refocus:
      return refocused(choice, subject);
    case MovieKind::Flip:
      break;
  }
  return flipped(choice, subject);
}

void write_movie(const std::filesystem::path& path, const Movie& movie, int width_px,
                 const Progress& progress) {
  std::unique_ptr<io::MovieFile> file;
  for (int i = 0; i < movie.count; ++i) {
    progress.check();
    const RgbaImage picture = movie.picture(i);
    if (!file) {
      file = std::make_unique<io::MovieFile>(
          path, io::MovieShape{picture.height(), picture.width(), movie.rate, width_px});
    }
    file->add(picture.view());
    progress.report(static_cast<double>(i + 1) / movie.count);
  }
  if (file) file->commit();
}

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
