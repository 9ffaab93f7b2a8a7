// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/picture.h"
#include "engine/capture/mesh_file.h"
#include "engine/core/error.h"
#include "tests/app/session/tiny_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <cmath>

namespace episcope::in_space_scene_test {

namespace {

std::shared_ptr<const DisparityField> field_of(const EstimatePtr& estimate) {
  return {estimate, &estimate->field};
}

PointCloudRequest request_of(const Scene& scene, float offset) {
  PointCloudRequest request;
  request.light_field = scene.light_field;
  request.view = scene.light_field->center();
  request.sources.push_back({field_of(shifted_truth(scene, offset))});
  return request;
}

std::shared_ptr<const DisparityField> truth_of(const Scene& scene) {
  return {scene.truth, &scene.truth->field};
}

}  // namespace

class SpaceSceneTest : public QObject {
  Q_OBJECT

 private slots:
  void points_areAllOfTheView_inItsColours() {
    const auto scene = tiny_scene();
    const PointCloudRequest request = request_of(*scene, 0);

    const PointClouds made = make_point_clouds(request, Progress());

    QCOMPARE(made.parts.size(), std::size_t(1));
    QCOMPARE(made.parts[0].all.positions.size(), std::size_t(64 * 64));
    QVERIFY(made.parts[0].few.positions.empty());  // so few need no reduction
    QVERIFY(!made.distance && !made.shading);
    const auto rgba = render::shade_view(*scene->light_field, request.view);
    QCOMPARE(made.parts[0].all.colors[65][1], rgba.at(1, 1, 1));
  }

  void manyPoints_areFewWhileTheyMove() {
    scenes::RenderOptions options;
    options.grid = {1, 1};
    options.height = options.width = 640;
    const Scene scene = scenes::render_builtin("edge", options, Progress());
    PointCloudRequest request = request_of(scene, 0);

    const PointClouds points = make_point_clouds(request, Progress());
    request.jump_px = 0.1;
    const PointClouds surface = make_point_clouds(request, Progress());

    QCOMPARE(points.parts[0].all.positions.size(), std::size_t(640 * 640));
    QCOMPARE(points.parts[0].few.positions.size(), std::size_t(214 * 214));
    QVERIFY(surface.parts[0].all.triangles.size() > 700'000);
    QVERIFY(surface.parts[0].few.triangles.size() < 80'000);
    QVERIFY(surface.parts[0].few.triangles.size() > 30'000);
  }

  void sources_standBesideEachOther() {
    const auto scene = tiny_scene();
    PointCloudRequest request = request_of(*scene, 0);
    request.sources.push_back({truth_of(*scene)});

    const PointClouds over = make_point_clouds(request, Progress());
    request.is_beside = true;
    const PointClouds beside = make_point_clouds(request, Progress());

    QVERIFY(over.parts[0].all.positions == over.parts[1].all.positions);
    const auto left = robust_bounds(beside.parts[0].all);
    const auto right = robust_bounds(beside.parts[1].all);
    QVERIFY(right[0] > left[1]);
    QVERIFY(beside.parts[0].all.positions == over.parts[0].all.positions);
  }

  void colours_areOneEachOrThoseOfAMap() {
    const auto scene = tiny_scene();
    PointCloudRequest request = request_of(*scene, 0);
    request.sources.push_back({truth_of(*scene)});
    request.coloring = PointCloudColoring::Source;

    const PointClouds each = make_point_clouds(request, Progress());
    request.coloring = PointCloudColoring::Map;
    request.shading = {render::color_map("grey"), {-1, 1}};
    MapSource map;
    map.quantity = render::Quantity::Truth;
    map.view = request.view;
    map.light_field = scene->light_field;
    map.truth = scene->truth;
    request.sources[0].map = map;
    const PointClouds mapped = make_point_clouds(request, Progress());

    QCOMPARE(each.parts[0].all.colors[5][0], kSourceColors[0][0]);
    QCOMPARE(each.parts[1].all.colors[5][2], kSourceColors[1][2]);
    const auto view = render::shade_view(*scene->light_field, request.view);
    const double d = scene->truth->field.view(request.view).disparity.at(0, 5);
    QCOMPARE(int(mapped.parts[0].all.colors[5][0]), int(request.shading.map.color(d, -1, 1)[0]));
    QCOMPARE(mapped.parts[1].all.colors[5][0], view.at(0, 5, 0));  // there is no map of it
    QVERIFY(mapped.shading && render::is_same(*mapped.shading, request.shading));
  }

  void distances_areToTheReference() {
    const auto scene = tiny_scene();
    PointCloudRequest request = request_of(*scene, 0.05F);
    request.coloring = PointCloudColoring::Distance;
    request.reference = truth_of(*scene);

    const PointClouds made = make_point_clouds(request, Progress());

    QVERIFY(made.distance.has_value());
    QVERIFY(made.distance->median > 0);
    QCOMPARE(made.shading->range.max, made.distance->percentile95);
    QCOMPARE(made.distance->points, made.parts[0].all.positions.size());
  }

  void savedScene_isReadAsAMesh() {
    const auto scene = tiny_scene();
    PointCloudRequest request = request_of(*scene, 0);
    request.sources.push_back({truth_of(*scene)});
    request.is_beside = true;
    request.jump_px = 0.1;
    const PointClouds made = make_point_clouds(request, Progress());
    const QTemporaryDir folder;
    const std::filesystem::path file = folder.filePath("scene.ply").toStdString();

    save_point_clouds(file, made.parts);
    const auto mesh = capture::read_mesh(file, Progress());

    QCOMPARE(mesh.faces.size(),
             made.parts[0].all.triangles.size() + made.parts[1].all.triangles.size());
    QVERIFY_THROWS_EXCEPTION(InvalidInput, save_point_clouds(file, {}));
  }

  void stopRequest_isHeard() {
    const auto scene = tiny_scene();
    std::stop_source stop;
    stop.request_stop();

    QVERIFY_THROWS_EXCEPTION(
        Cancelled, (void)make_point_clouds(request_of(*scene, 0), Progress(stop.get_token(), {})));
  }
};

}  // namespace episcope::in_space_scene_test

EPISCOPE_TEST(space_scene_test, SpaceSceneTest)
#include "space_scene_test.moc"
