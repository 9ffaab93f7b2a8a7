// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/mesh_file.h"
#include "engine/core/error.h"

#include "tests/test_main.h"

#include <QTemporaryDir>

#include <sys/stat.h>
#include <algorithm>
#include <cmath>
#include <fstream>

namespace episcope::in_mesh_file_test {

using namespace capture;

namespace {

const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
    "z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";

}  // namespace

class MeshFileTest : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;

  std::filesystem::path file(const std::string& name, const std::string& text) {
    const std::filesystem::path path = folder_.filePath(QString::fromStdString(name)).toStdString();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  QString problem(const std::string& name, const std::string& text) {
    try {
      (void)read_mesh(file(name, text), Progress(1));
    } catch (const IoError& error) {
      return QString::fromUtf8(error.what());
    }
    return {};
  }

 private slots:
  void binaryPly_isReadAsWritten() {
    TriangleMesh mesh;
    mesh.vertices = {{0, 0, 1}, {1, 0, 2}, {0, 1, 3.5F}, {1, 1, -4}};
    mesh.faces = {{0, 2, 1}, {1, 2, 3}};
    const std::filesystem::path path = folder_.filePath("a.ply").toStdString();
    write_mesh(path, mesh);
    const TriangleMesh read = read_mesh(path, Progress(1));
    QVERIFY(read.vertices == mesh.vertices);
    QVERIFY(read.faces == mesh.faces);
  }

  // Opening a pipe would wait for whoever writes into it.
  void filesThatAMeshNames_areNotOpened() {
    const std::string pipe = folder_.filePath("a.mtl").toStdString();
    QCOMPARE(::mkfifo(pipe.c_str(), 0600), 0);
    const TriangleMesh mesh =
        read_mesh(file("named.obj", "mtllib a.mtl\nv 0 0 1\nv 1 0 1\nv 1 1 1\nusemtl a\nf 1 2 3\n"),
                  Progress(1));
    QCOMPARE(mesh.faces.size(), std::size_t{1});
  }

  void asciiForms_areRead() {
    const TriangleMesh ply = read_mesh(
        file("b.ply", kPly + "0 0 1\n1 0 2\n0 1 3.5\n1 1 -4\n3 0 2 1\n3 1 2 3\n"), Progress(1));
    QCOMPARE(ply.vertices.size(), std::size_t{4});
    QVERIFY(ply.faces == (std::vector<Face>{{0, 2, 1}, {1, 2, 3}}));
    const TriangleMesh obj =
        read_mesh(file("c.obj", "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 1 2 3 4\n"), Progress(1));
    QCOMPARE(obj.faces.size(), std::size_t{2});  // a square is two triangles
    const TriangleMesh stl = read_mesh(
        file("d.stl",
             "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex "
             "0 1 0\nendloop\nendfacet\nendsolid s\n"),
        Progress(1));
    QCOMPARE(stl.faces.size(), std::size_t{1});
  }

  void brokenMeshes_getASentence() {
    QVERIFY(problem("no.ply", kPly + "0 0 1\n1 0 2\n0 1 nan\n1 1 4\n3 0 2 1\n3 1 2 3\n")
                .contains("no number"));
    QVERIFY(problem("far.ply", kPly + "0 0 1\n1 0 2\n0 1 3\n1 1 4\n3 0 2 1\n3 1 2 9\n")
                .contains("far.ply"));
    QVERIFY(problem("cut.ply", kPly + "0 0 1\n1 0 2\n").contains("cut.ply"));
    QVERIFY(problem("text.ply", "no mesh at all").contains("cannot be read"));
    QVERIFY(problem("points.ply",
                    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float "
                    "y\nproperty float z\nend_header\n0 0 1\n")
                .contains("points.ply"));
    QVERIFY(problem("few.ply", kPly + "0 0 1\n1 0 2\n0 1 3\n1 1 4\n3 0 2 1\n")
                .contains("ends in the middle"));
    QVERIFY(problem("header.ply", "ply\nformat ascii 1.0\n").contains("no end"));
    QVERIFY(problem("mesh.xyz", "0 0 0").contains(".ply, .obj or .stl"));
    QVERIFY_THROWS_EXCEPTION(IoError, (void)read_mesh("/nowhere/a.ply", Progress(1)));
  }

  // assimp wrote beyond the memory that it took for the first list.
  void listsThatComeTwice_getASentence_data() {
    QTest::addColumn<QString>("first");
    QTest::addColumn<QString>("second");
    QTest::newRow("vertices") << "vertex"
                              << "vertex";
    QTest::newRow("faces") << "face"
                           << "face";
    QTest::newRow("faces and strips") << "face"
                                      << "tristrips";
    QTest::newRow("strips and faces") << "tristrips"
                                      << "face";
  }
  void listsThatComeTwice_getASentence() {
    QFETCH(QString, first);
    QFETCH(QString, second);
    const auto list = [](const QString& name, int count) {
      const QString properties = name == "vertex"
                                     ? "property float x\nproperty float y\nproperty float z\n"
                                     : "property list uchar int vertex_indices\n";
      return QString("element %1 %2\n").arg(name).arg(count) + properties;
    };
    const QString ply = "ply\nformat ascii 1.0\n" + list(first, 1) + list(second, 9) +
                        "end_header\n" + QString("3 0 0 0\n").repeated(10);
    QVERIFY(problem("twice.ply", ply.toStdString()).contains("more than one list"));
  }

  void cutBinaryPly_getsASentenceWhereverItIsCut() {
    TriangleMesh mesh;
    mesh.vertices = {{0, 0, 1}, {1, 0, 2}, {0, 1, 3.5F}, {1, 1, -4}};
    mesh.faces = {{0, 2, 1}, {1, 2, 3}};
    const std::filesystem::path path = folder_.filePath("whole.ply").toStdString();
    write_mesh(path, mesh);
    std::ifstream whole(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(whole)), {});
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      QVERIFY2(problem("cut.ply", bytes.substr(0, length)).contains("cut.ply"),
               qPrintable(QString::number(length)));
    }
  }

  void clusteredMesh_isCoarseAndNear() {
    const TriangleMesh mesh = scan_mesh(100);
    const TriangleMesh coarse = cluster_vertices(mesh, 20'000);
    QVERIFY(coarse.faces.size() <= 20'000 && coarse.faces.size() > 5'000);
    double low[2]{1e9, 1e9};
    double high[2]{-1e9, -1e9};
    const TriangleMesh* meshes[]{&mesh, &coarse};
    for (int m = 0; m < 2; ++m) {
      for (const Face& face : meshes[m]->faces) {
        for (const std::uint32_t corner : face) {
          QVERIFY(corner < meshes[m]->vertices.size());
          low[m] = std::min<double>(low[m], meshes[m]->vertices[corner][2]);
          high[m] = std::max<double>(high[m], meshes[m]->vertices[corner][2]);
        }
      }
    }
    QVERIFY(std::abs(low[0] - low[1]) < 10 && std::abs(high[0] - high[1]) < 10);
    QCOMPARE(cluster_vertices(mesh, mesh.faces.size()).faces.size(), mesh.faces.size());
  }

  void linesBetweenPolygons_areLeftOut() {
    const TriangleMesh mesh = read_mesh(
        file("lines.obj", "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 1 2 3 4\nl 1 2\n"), Progress(1));
    QCOMPARE(mesh.faces.size(), std::size_t{2});
  }
};

}  // namespace episcope::in_mesh_file_test

EPISCOPE_TEST(mesh_file_test, MeshFileTest)
#include "mesh_file_test.moc"
