// SPDX-License-Identifier: BSD-3-Clause
// large_mesh [DETAIL]: a scan of 16·DETAIL² faces (707: 8 million) as the Capture tab takes it:
// read from binary PLY, made coarser for turning, turned with the mouse. Needs a display, such as
// that of xvfb-run.
#include "app/gui/capture/photographs.h"
#include "engine/capture/mesh_file.h"
#include "widgets/cloud/point_cloud_view.h"

#include <QApplication>
#include <QTemporaryDir>
#include <QTest>

#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace {

using namespace episcope;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// Frames that the mouse drags along, the next move as soon as one is on the screen.
double frames_per_second(PointCloudView& view, double seconds) {
  bool is_shown = false;
  const auto connection =
      QObject::connect(&view, &OffscreenGl::frameDrawn, [&] { is_shown = true; });
  const QPoint middle = view.rect().center();
  QTest::mousePress(&view, Qt::LeftButton, {}, middle);
  QTest::mouseMove(&view, middle + QPoint(10, 0));
  (void)QTest::qWaitFor([&] { return is_shown; }, 60'000);
  int frames = 0;
  const Clock::time_point begin = Clock::now();
  for (; seconds_since(begin) < seconds; ++frames) {
    is_shown = false;
    const double angle = 0.05 * frames;
    QTest::mouseMove(&view, middle + QPoint(static_cast<int>(100 * std::cos(angle)),
                                            static_cast<int>(60 * std::sin(angle))));
    while (!is_shown) QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents, 100);
  }
  const double rate = frames / seconds_since(begin);
  QTest::mouseRelease(&view, Qt::LeftButton, {}, middle);
  QObject::disconnect(connection);
  return rate;
}

double full_frame_seconds(PointCloudView& view) {
  const Clock::time_point begin = Clock::now();
  (void)view.grabFramebuffer();
  return seconds_since(begin);
}

}  // namespace

int main(int argc, char** argv) {
  const QApplication application(argc, argv);
  const int detail = argc > 1 ? std::atoi(argv[1]) : 707;
  const QTemporaryDir folder;
  const std::filesystem::path file = folder.filePath("scan.ply").toStdString();
  capture::write_mesh(file, capture::scan_mesh(detail));

  Clock::time_point begin = Clock::now();
  const capture::TriangleMesh mesh = capture::read_mesh(file, Progress());
  std::printf("%zu faces, read from PLY in %.1f s\n", mesh.faces.size(), seconds_since(begin));

  begin = Clock::now();
  const CloudPartsPtr parts = mesh_parts(mesh);
  std::printf("ready for the 3D view in %.1f s, %zu faces while it turns\n", seconds_since(begin),
              parts->front().few.triangles.size());

  PointCloudView view;
  view.resize(900, 700);
  view.show();
  if (!QTest::qWaitForWindowExposed(&view)) return 1;
  view.setParts(parts);
  view.showPreset(CloudPreset::Front);
  (void)view.grabFramebuffer();  // the buffers are filled
  std::printf("at rest: %.2f s a frame\n", full_frame_seconds(view));
  std::printf("while it turns: %.0f frames/s\n", frames_per_second(view, 5));
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("peak memory %.2f GiB\n", static_cast<double>(usage.ru_maxrss) / (1 << 20));
  return 0;
}
