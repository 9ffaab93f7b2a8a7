// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/write_arrays.h"
#include "engine/io/open/open.h"
#include "tests/engine/io/arrays/array_files.h"
#include "tests/engine/io/order/layered_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>

namespace episcope::in_axes_by_motion_test {

using namespace episcope::test;

class AxesByMotionTest : public QObject {
  Q_OBJECT

 private slots:
  void channelsBesideThreeRows_areToldByMotion_data() {
    QTest::addColumn<QString>("axes");
    for (const char* axes : {"vucyx", "cvuyx", "uvcyx"}) QTest::newRow(axes) << axes;
  }
  void channelsBesideThreeRows_areToldByMotion() {
    QFETCH(QString, axes);
    const QTemporaryDir folder;
    const std::filesystem::path file = folder.filePath("lf.npy").toStdString();
    const std::string letters = axes.toStdString();
    // Colours of one texture: the waves of plane_scene lie elsewhere in each channel, as if moved.
    const ViewStack<std::uint8_t> grey = layered_views({.grid = {3, 3}});
    ViewStack<std::uint8_t> three(grey.grid(), grey.height(), grey.width(), 3);
    for (std::size_t n = 0; n < three.size(); ++n) {
      three.data()[n] = static_cast<std::uint8_t>(grey.data()[n / 3] * (2 + n % 3) / 4);
    }
    io::write_npy<std::uint8_t>(file, lengths_of(three, letters), in_axes(three, letters));

    const Scene scene = io::open_scene(file, {}, Progress(1));

    QVERIFY2(scene.convention.format.find("(" + letters + ")") != std::string::npos,
             scene.convention.format.c_str());
    const auto& read = std::get<ViewStack<std::uint8_t>>(scene.light_field->samples());
    QVERIFY(std::equal(three.data(), three.data() + three.size(), read.data(),
                       read.data() + read.size()));
  }
};

}  // namespace episcope::in_axes_by_motion_test

EPISCOPE_TEST(axes_by_motion_test, AxesByMotionTest)
#include "axes_by_motion_test.moc"
