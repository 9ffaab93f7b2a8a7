// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/npy.h"
#include "engine/io/models/poses.h"
#include "engine/io/open.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>

namespace episcope::in_posed_views_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// Views whose names say nothing, with files of poses beside them: a square before a wall in 3×5
/// views, numbered in an order that is none of a grid, of cameras that are turned in the scene.
class PosedViewsTest : public QObject {
  Q_OBJECT

 private:
  static constexpr GridShape kGrid{3, 5};
  static constexpr double kStep = 0.25;
  static constexpr double kFocal_widths = 1.25;
  // What all cameras see as right, down and ahead, not along the axes of the scene.
  static constexpr io::Direction kRight{0.36, 0.48, -0.8};
  static constexpr io::Direction kDown{-0.8, 0.6, 0};
  static constexpr io::Direction kAhead{0.48, 0.64, 0.6};

  std::unique_ptr<LayeredFolder> folder_;

  static ViewIndex view_of(int number) { return kGrid.view_at(7 * number % kGrid.count()); }
  /// `off` along the line of sight, in the last view.
  static io::Direction center_of(int number, double off = 0) {
    const ViewIndex view = view_of(number);
    io::Direction center{3, -2, 1};
    for (std::size_t i = 0; i < 3; ++i) {
      center[i] += kStep * (view.u * kRight[i] + view.v * kDown[i]);
      if (number == kGrid.count() - 1) center[i] += off * kStep * kAhead[i];
    }
    return center;
  }
  void write_views(const std::string& inside) const {
    fs::create_directories(folder_->path(inside));
    for (int i = 0; i < kGrid.count(); ++i) {
      io::write_png(folder_->path(inside + fmt::format("img{:02}.png", i)),
                    folder_->scene.views.view(view_of(i)));
    }
  }
  /// The poses of every `step`-th image from `first` on, whose paths `path_of` gives.
  template <class PathOf>
  void write_nerf(const std::string& name, int first, int step, const PathOf& path_of,
                  double off = 0) const {
    std::ofstream out(folder_->path(name));
    out << fmt::format("{{\"camera_angle_x\": {}, \"frames\": [",
                       2 * std::atan(0.5 / kFocal_widths));
    for (int i = first; i < kGrid.count(); i += step) {
      const io::Direction center = center_of(i, off);
      out << (i > first ? "," : "")
          << fmt::format("{{\"file_path\": \"{}\", \"transform_matrix\": [", path_of(i));
      for (std::size_t row = 0; row < 3; ++row) {
        out << fmt::format("[{}, {}, {}, {}],", kRight[row], -kDown[row], -kAhead[row],
                           center[row]);
      }
      out << "[0, 0, 0, 1]]}";
    }
    out << "]}";
  }
  void write_nerf(double off = 0) const {
    write_nerf(
        "transforms.json", 0, 1, [](int i) { return fmt::format("./images/img{:02}", i); }, off);
  }
  /// Every third view is in the same part, where it has a number of its own.
  void write_parts() const {
    const char* parts[] = {"train", "val", "test"};
    const auto path_of = [&](int i) { return fmt::format("{}/r_{}", parts[i % 3], i / 3); };
    for (int part = 0; part < 3; ++part) {
      write_nerf(fmt::format("transforms_{}.json", parts[part]), part, 3,
                 [&](int i) { return "./" + path_of(i); });
    }
    for (int i = 0; i < kGrid.count(); ++i) {
      io::write_png(folder_->place(path_of(i) + ".png"), folder_->scene.views.view(view_of(i)));
    }
  }
  void write_llff() const {
    std::vector<float> all;
    for (int i = 0; i < kGrid.count(); ++i) {
      const io::Direction center = center_of(i);
      const double size[] = {60, 72, kFocal_widths * 72};
      for (std::size_t row = 0; row < 3; ++row) {
        for (const double value : {kDown[row], kRight[row], -kAhead[row], center[row], size[row]}) {
          all.push_back(static_cast<float>(value));
        }
      }
      all.insert(all.end(), {1.0F, 9.0F});
    }
    io::write_npy<float>(folder_->path("poses_bounds.npy"), {15, 17}, all);
  }
  /// The quaternion of the matrix with the rows right, down and ahead, and the translation.
  static std::array<double, 7> colmap_numbers(int number) {
    const double w = 0.5 * std::sqrt(1 + kRight[0] + kDown[1] + kAhead[2]);
    const io::Direction center = center_of(number);
    return {w,
            (kAhead[1] - kDown[2]) / (4 * w),
            (kRight[2] - kAhead[0]) / (4 * w),
            (kDown[0] - kRight[1]) / (4 * w),
            -io::dot(kRight, center),
            -io::dot(kDown, center),
            -io::dot(kAhead, center)};
  }
  template <class... Numbers>
  static void put(std::ofstream& out, Numbers... numbers) {
    (out.write(reinterpret_cast<const char*>(&numbers), sizeof(numbers)), ...);
  }
  void write_colmap() const {
    write_colmap([](int i) { return fmt::format("img{:02}.png", i); });
  }
  template <class NameOf>
  void write_colmap(const NameOf& name_of) const {
    fs::create_directories(folder_->path("sparse/0"));
    std::ofstream(folder_->path("sparse/0/cameras.txt"))
        << fmt::format("# cameras\n1 SIMPLE_PINHOLE 72 60 {} 36 30\n", kFocal_widths * 72);
    std::ofstream out(folder_->path("sparse/0/images.txt"));
    out << "# images\n";
    for (int i = 0; i < kGrid.count(); ++i) {
      out << i + 1;
      for (const double number : colmap_numbers(i)) out << ' ' << fmt::format("{}", number);
      out << fmt::format(" 1 {}\n", name_of(i)) << (i % 2 == 0 ? "\n" : "10.5 20.5 -1\n");
    }
  }
  void write_binary_colmap() const {
    fs::create_directories(folder_->path("sparse/0"));
    std::ofstream cameras(folder_->path("sparse/0/cameras.bin"), std::ios::binary);
    put(cameras, std::uint64_t{2});
    for (const std::uint32_t id : {7U, 1U}) {  // SIMPLE_RADIAL and PINHOLE
      put(cameras, id, id == 1 ? 1U : 2U, std::uint64_t{72}, std::uint64_t{60});
      put(cameras, id == 1 ? kFocal_widths * 72 : 1.0, 90.0, 36.0, 30.0);
    }
    std::ofstream out(folder_->path("sparse/0/images.bin"), std::ios::binary);
    put(out, static_cast<std::uint64_t>(kGrid.count()));
    for (int i = 0; i < kGrid.count(); ++i) {
      put(out, static_cast<std::uint32_t>(i + 1));
      for (const double number : colmap_numbers(i)) put(out, number);
      put(out, 1U);
      out << fmt::format("img{:02}.png", i) << '\0';
      put(out, static_cast<std::uint64_t>(i % 3));
      for (int point = 0; point < i % 3; ++point) put(out, 10.5, 20.5, std::uint64_t{4});
    }
  }
  bool has_views_in_order(const Scene& scene) const {
    const auto& views = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples());
    return views.size() == folder_->scene.views.size() &&
           std::memcmp(views.data(), folder_->scene.views.data(), views.size()) == 0;
  }

 private slots:
  void init() { folder_ = std::make_unique<LayeredFolder>(kGrid); }

  void posesOfAGrid_placeTheViews_data() {
    QTest::addColumn<QString>("form");
    QTest::newRow("NeRF") << "transforms.json";
    QTest::newRow("LLFF") << "poses_bounds.npy";
    QTest::newRow("COLMAP") << "images.txt";
    QTest::newRow("COLMAP, binary") << "images.bin";
    QTest::newRow("NeRF in parts") << "transforms_train.json, transforms_val.json, transforms_test";
  }
  void posesOfAGrid_placeTheViews() {
    QFETCH(QString, form);
    const bool is_in_parts = form.startsWith("transforms_");
    if (is_in_parts) write_parts();
    if (!is_in_parts) write_views("images/");
    if (form == "transforms.json") write_nerf();
    if (form == "poses_bounds.npy") write_llff();
    if (form == "images.txt") write_colmap();
    if (form == "images.bin") write_binary_colmap();

    const Scene scene = folder_->open();

    QCOMPARE(scene.light_field->grid(), kGrid);
    QVERIFY2(has_views_in_order(scene), describe(scene.convention).c_str());
    const std::string check = scene.convention.order_check;
    QVERIFY2(check.starts_with("3×5 by " + form.toStdString()), check.c_str());
    const CameraGrid& camera = scene.light_field->info().camera;
    QVERIFY(std::abs(camera.baseline - kStep) < 1e-5);
    QVERIFY(std::abs(camera.focal_length - 72 * kFocal_widths) < 1e-3);
    QCOMPARE(scene.light_field->info().positions.size(), std::size_t{15});
    QVERIFY(std::abs(scene.light_field->info().positions.back().x - 4 * kStep) < 1e-5);
    QCOMPARE(scene.convention.sign, std::string("checked"));
  }

  void namesOfColmap_areFoundAsTheyAre_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<QString>("stated");
    QTest::newRow("spaces") << "images/img {}.png"
                            << "img {}.png";
    QTest::newRow("a folder with spaces") << "images/left row/img ({}).png"
                                          << "left row/img ({}).png";
    QTest::newRow("other case") << "images/img{}.png"
                                << "IMG{}.PNG";
    QTest::newRow("two folders") << "images/day 1/cam/img{}.png"
                                 << "day 1/cam/img{}.png";
  }
  void namesOfColmap_areFoundAsTheyAre() {
    QFETCH(QString, file);
    QFETCH(QString, stated);
    const auto named = [](const QString& form) {
      return [form](int i) { return fmt::format(fmt::runtime(form.toStdString()), i); };
    };
    for (int i = 0; i < kGrid.count(); ++i) {
      io::write_png(folder_->place(named(file)(i)), folder_->scene.views.view(view_of(i)));
    }
    write_colmap(named(stated));
    const fs::path views = folder_->path(named(file)(0)).parent_path();

    const Scene scene = io::open_scene(views, {}, Progress(1));

    QVERIFY2(has_views_in_order(scene), describe(scene.convention).c_str());
    const std::string check = scene.convention.order_check;
    QVERIFY2(check.starts_with("3×5 by images.txt"), check.c_str());
  }

  void imagesInSeveralFolders_areOneLightField() {
    const auto name_of = [](int i) {
      return fmt::format("rig/{} eye/img{:02}.png", i % 2 == 0 ? "left" : "right", i / 2);
    };
    for (int i = 0; i < kGrid.count(); ++i) {
      io::write_png(folder_->place("images/" + name_of(i)), folder_->scene.views.view(view_of(i)));
    }
    write_colmap(name_of);

    const Scene scene = folder_->open();

    QVERIFY2(has_views_in_order(scene), describe(scene.convention).c_str());
    const std::string check = scene.convention.order_check;
    QVERIFY2(check.starts_with("3×5 by images.txt"), check.c_str());
  }

  void missingCamera_leavesOutItsColumn() {
    write_views("images/");
    write_nerf();
    fs::remove(folder_->path("images/img00.png"));

    const Scene scene = folder_->open();

    QCOMPARE(scene.light_field->grid(), (GridShape{3, 4}));
    const auto& views = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples());
    for (int i = 0; i < views.grid().count(); ++i) {
      const auto found = views.view(views.grid().view_at(i));
      const auto wanted = folder_->scene.views.view(views.grid().view_at(i, {0, 1}));
      QCOMPARE(std::memcmp(found.data, wanted.data, found.size()), 0);
    }
    QVERIFY(warns_of(scene, "Of a grid of 3×5 view 0,0 is missing"));
    QCOMPARE(scene.light_field->info().positions.size(), std::size_t{12});
    QVERIFY(std::abs(scene.light_field->info().positions.front().x - kStep) < 1e-5);
  }

  void missingCameraOfALine_leavesAGap() {
    std::vector<io::CameraPose> poses;
    for (const int u : {0, 1, 2, 3, 5, 6}) {
      poses.push_back(
          {.image = {},
           .center = {kStep * u * kRight[0], kStep * u * kRight[1], kStep * u * kRight[2]},
           .right = kRight,
           .down = kDown,
           .ahead = kAhead});
    }

    const io::PoseGrid found = io::find_pose_grid(poses);

    QCOMPARE(found.problem, std::string());
    QCOMPARE(found.grid, (GridShape{1, 7}));
    QCOMPARE(found.order[4], io::kNoCamera);
    QCOMPARE(found.order[5], std::size_t{4});
  }

  void trainingViewsOfAGrid_openAlone() {
    write_parts();
    const auto all_views = [](int i) { return fmt::format("train/r_{}", i); };
    for (int i = 0; i < kGrid.count(); ++i) {
      io::write_png(folder_->place(all_views(i) + ".png"), folder_->scene.views.view(view_of(i)));
    }
    write_nerf("transforms_train.json", 0, 1, all_views);

    const Scene scene = folder_->open();

    QVERIFY(has_views_in_order(scene));
    QVERIFY(scene.convention.order_check.starts_with("3×5 by transforms_train.json: "));
  }

  void partsOffThePlane_areToldWhy() {
    write_parts();
    write_nerf(
        "transforms_test.json", 2, 3, [](int i) { return fmt::format("./test/r_{}", i / 3); }, 0.5);

    try {
      (void)folder_->open();
      QFAIL("it was read");
    } catch (const IoError& error) {
      const std::string text = error.what();
      QVERIFY2(text.find("transforms_test.json, the cameras do not stand on a plane") !=
                   std::string::npos,
               text.c_str());
    }
  }

  void posesOffThePlane_areNoLightField() {
    write_views("images/");
    write_nerf(0.5);

    try {
      (void)folder_->open();
      QFAIL("it was read");
    } catch (const IoError& error) {
      const std::string text = error.what();
      QVERIFY2(
          text.find("differ by 0.5 of their step along the line of sight") != std::string::npos,
          text.c_str());
    }
  }

  void namesOfAGrid_openWithoutSuchPoses() {
    folder_->write_views(LayeredFolder::named("img{}_{}.png"));
    std::ofstream(folder_->path("transforms.json")) << "{\"frames\": [{}]}";

    const Scene scene = folder_->open();

    QVERIFY(has_views_in_order(scene));
    QVERIFY(warns_of(scene, "The poses of transforms.json are not used"));
  }

  void camerasThatAreNoGrid_areToldWhy_data() {
    QTest::addColumn<double>("turn_deg");
    QTest::addColumn<double>("off");
    QTest::addColumn<double>("stretch");
    QTest::addColumn<QString>("problem");
    QTest::newRow("grid") << 0.2 << 0.05 << 1.0 << "";
    QTest::newRow("turned") << 2.0 << 0.0 << 1.0 << "turned against each other by up to 2°";
    QTest::newRow("uneven") << 0.0 << 0.2 << 1.0 << "off a grid of equal steps by up to 0.2";
    QTest::newRow("wide") << 0.0 << 0.0 << 1.3 << "";
  }
  void camerasThatAreNoGrid_areToldWhy() {
    QFETCH(double, turn_deg);
    QFETCH(double, off);
    QFETCH(double, stretch);
    QFETCH(QString, problem);
    std::vector<io::CameraPose> poses;
    for (int i = 0; i < 25; ++i) {
      poses.push_back({.image = {},
                       .center = {stretch * (i % 5), static_cast<double>(i / 5), 0},
                       .right = {1, 0, 0},
                       .down = {0, 1, 0},
                       .ahead = {0, 0, 1}});
    }
    const double turn = turn_deg * std::acos(-1.0) / 180;
    poses[12].right = {std::cos(turn), 0, -std::sin(turn)};
    poses[12].ahead = {std::sin(turn), 0, std::cos(turn)};
    poses[12].center[1] += off;

    const std::string found = io::find_pose_grid(poses).problem;

    QVERIFY2(problem.isEmpty() == found.empty() &&
                 found.find(problem.toStdString()) != std::string::npos,
             found.c_str());
  }

  void rowsFartherApart_areAGrid() {
    std::vector<io::CameraPose> poses;
    for (int i = 0; i < 15; ++i) {
      poses.push_back({.image = {},
                       .center = {0.1 * (i % 5), 0.25 * (i / 5), 0},
                       .right = {1, 0, 0},
                       .down = {0, 1, 0},
                       .ahead = {0, 0, 1}});
    }

    const io::PoseGrid found = io::find_pose_grid(poses);

    QCOMPARE(found.problem, std::string());
    QCOMPARE(found.grid, (GridShape{3, 5}));
    QVERIFY(std::abs(found.step - 0.1) < 1e-9);
    QVERIFY(std::abs(found.positions.back().y - 0.5) < 1e-9);
  }

  void shortenedColmap_isRefused() {
    write_binary_colmap();
    const fs::path path = folder_->path("sparse/0/images.bin");
    const auto size = fs::file_size(path);
    fs::resize_file(folder_->path("sparse/0/cameras.bin"), 30);
    for (const std::uintmax_t left : {size - 1, size / 2, std::uintmax_t{20}, std::uintmax_t{3}}) {
      fs::resize_file(path, left);

      QVERIFY_THROWS_EXCEPTION(IoError, (void)io::read_binary_colmap_poses(path));
    }
  }

  void damagedColmap_namesItsLine() {
    std::ofstream(folder_->path("images.txt")) << "# images\n1 1 0 0 0 0 0 zero 1 a.png\n\n";

    try {
      (void)io::read_colmap_poses(folder_->path("images.txt"));
      QFAIL("it was read");
    } catch (const IoError& error) {
      QVERIFY2(std::string(error.what()).find("line 2") != std::string::npos, error.what());
    }
  }
};

}  // namespace episcope::in_posed_views_test

EPISCOPE_TEST(posed_views_test, PosedViewsTest)
#include "posed_views_test.moc"
