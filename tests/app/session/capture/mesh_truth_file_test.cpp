// SPDX-License-Identifier: BSD-3-Clause
// Ground truth of a mesh as a reader of the archive sees it: by HDF5 alone, with the names, shapes
// and attributes of the archive, and nothing of ours.
#include "app/session/capture_work.h"
#include "engine/io/formats/write_scene.h"
#include "engine/scenes/builtin.h"
#include "tests/test_main.h"

#include <QTemporaryDir>
#include <QTest>

#include <hdf5.h>

#include <cmath>
#include <string>
#include <vector>

namespace episcope::in_mesh_truth_file_test {

namespace {

constexpr double kNear = 700, kFar = 1000;

CameraGrid camera() {
  CameraGrid grid;
  grid.baseline = 10;
  grid.focal_length = 150;
  grid.shift = 1.8;
  grid.pinhole = Pinhole{150, 31.5, 23.5};
  return grid;
}

std::shared_ptr<capture::TriangleMesh> square(float half) {
  auto mesh = std::make_shared<capture::TriangleMesh>();
  mesh->vertices = {{-half, -half, 0}, {half, -half, 0}, {-half, half, 0}, {half, half, 0}};
  mesh->faces = {{0, 2, 1}, {1, 2, 3}};
  return mesh;
}

capture::RigidPose at(double z) {
  capture::RigidPose pose;
  pose.translation[2] = z;
  return pose;
}

Scene made() {
  Scene scene =
      scenes::render_builtin("edge", {.grid = {3, 5}, .height = 48, .width = 64}, Progress());
  LightFieldInfo info = scene.light_field->info();
  info.camera = camera();
  const auto& samples = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples());
  scene.light_field = std::make_shared<LightField>(samples.clone(), info);
  scene.truth = std::make_shared<GroundTruth>();
  scene.scribbles = {};
  const std::vector<PosedMesh> meshes{{square(900), at(kFar)}, {square(50), at(kNear)}};
  return with_mesh_truth(meshes, scene, Progress(1));
}

/// A file as any program reads it.
class PlainFile {
 public:
  explicit PlainFile(const std::string& path)
      : file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {}
  ~PlainFile() { H5Fclose(file_); }
  PlainFile(const PlainFile&) = delete;
  PlainFile& operator=(const PlainFile&) = delete;

  [[nodiscard]] double number(const char* name) const {
    const hid_t id = H5Aopen(file_, name, H5P_DEFAULT);
    double value = NAN;
    if (id >= 0) H5Aread(id, H5T_NATIVE_DOUBLE, &value);
    if (id >= 0) H5Aclose(id);
    return value;
  }
  [[nodiscard]] std::vector<hsize_t> shape(const char* name) const {
    const hid_t id = H5Dopen2(file_, name, H5P_DEFAULT);
    const hid_t space = H5Dget_space(id);
    std::vector<hsize_t> shape(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, shape.data(), nullptr);
    H5Sclose(space);
    H5Dclose(id);
    return shape;
  }
  [[nodiscard]] std::vector<float> samples(const char* name) const {
    std::size_t count = 1;
    for (const hsize_t each : shape(name)) count *= each;
    std::vector<float> samples(count);
    const hid_t id = H5Dopen2(file_, name, H5P_DEFAULT);
    H5Dread(id, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, samples.data());
    H5Dclose(id);
    return samples;
  }

 private:
  hid_t file_;
};

}  // namespace

class MeshTruthFileTest : public QObject {
  Q_OBJECT

 private slots:
  void file_isOneOfTheArchive() {
    const QTemporaryDir folder;
    const Scene scene = made();
    io::write_archive(folder.filePath("lf.h5").toStdString(), scene, Progress());

    const PlainFile file(folder.filePath("lf.h5").toStdString());
    QVERIFY(file.shape("LF") == (std::vector<hsize_t>{3, 5, 48, 64, 3}));
    for (const char* name : {"GT_DEPTH", "GT_DEPTH_MASK"}) {
      QVERIFY2(file.shape(name) == (std::vector<hsize_t>{3, 5, 48, 64}), name);
    }
    QCOMPARE(file.number("vRes"), 3.0);
    QCOMPARE(file.number("hRes"), 5.0);
    QCOMPARE(file.number("yRes"), 48.0);
    QCOMPARE(file.number("xRes"), 64.0);
    QCOMPARE(file.number("channels"), 3.0);
    QVERIFY(std::isfinite(file.number("vSampling")) && std::isfinite(file.number("hSampling")));
    for (const char* name : {"dH", "dV"}) QVERIFY2(file.number(name) == 10, name);
    QCOMPARE(file.number("focalLength"), 150.0);
    QCOMPARE(file.number("shift"), 1.8);
    const PlainFile labels(folder.filePath("labels.h5").toStdString());
    QVERIFY(labels.shape("GT_LABELS") == (std::vector<hsize_t>{3, 5, 48, 64}));
  }

  // Where each of the squares is seen follows from the pinhole and eq. 1 alone.
  void depthOfEveryView_isThatOfTheSquares() {
    const QTemporaryDir folder;
    io::write_archive(folder.filePath("lf.h5").toStdString(), made(), Progress());
    const PlainFile file(folder.filePath("lf.h5").toStdString());
    const std::vector<float> depth = file.samples("GT_DEPTH");
    const std::vector<float> mask = file.samples("GT_DEPTH_MASK");
    const std::vector<float> labels =
        PlainFile(folder.filePath("labels.h5").toStdString()).samples("GT_LABELS");
    const double d = file.number("dH") * file.number("focalLength") / kNear - file.number("shift");
    const double half = 150 * 50 / kNear;
    std::size_t i = 0;
    int far = 0, near = 0;
    for (int v = -1; v <= 1; ++v) {
      for (int u = -2; u <= 2; ++u) {
        for (int y = 0; y < 48; ++y) {
          for (int x = 0; x < 64; ++x, ++i) {
            if (mask[i] == 0) continue;
            const double off = std::max(std::abs(x - 31.5 + u * d), std::abs(y - 23.5 + v * d));
            const double expected = off < half ? kNear : kFar;
            QVERIFY(std::abs(depth[i] - expected) < 1e-4 * expected);
            QCOMPARE(labels[i], off < half ? 2.0F : 1.0F);
            ++(off < half ? near : far);
          }
        }
      }
    }
    QVERIFY(near > 15 * 300 && far > 15 * 2000);
  }
};

}  // namespace episcope::in_mesh_truth_file_test

EPISCOPE_TEST(mesh_truth_file_test, MeshTruthFileTest)
#include "mesh_truth_file_test.moc"
