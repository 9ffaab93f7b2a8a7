// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/npy.h"
#include "engine/io/open.h"
#include "tests/engine/io/formats/array_files.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace episcope::in_luma_chroma_test {

using namespace episcope::test;

namespace fs = std::filesystem;

/// Light fields that are stored as Y, Cb, Cr.
class LumaChromaTest : public QObject {
  Q_OBJECT

 private:
  QTemporaryDir folder_;

  /// ITU-R BT.601, in bytes; `scale` and `black` of the range that Y has.
  static ViewStack<std::uint8_t> encoded(const ViewStack<std::uint8_t>& views, bool is_video) {
    const double luma_range = is_video ? 219 : 255;
    const double chroma_range = is_video ? 224 : 255;
    ViewStack<std::uint8_t> out = views.clone();
    for (std::size_t i = 0; i < out.size(); i += 3) {
      const std::uint8_t* in = views.data() + i;
      const double luma = (0.299 * in[0] + 0.587 * in[1] + 0.114 * in[2]) / 255;
      const double blue = (in[2] / 255.0 - luma) / 1.772;
      const double red = (in[0] / 255.0 - luma) / 1.402;
      const auto byte = [](double value) {
        return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
      };
      out.data()[i] = byte((is_video ? 16 : 0) + luma_range * luma);
      out.data()[i + 1] = byte(128 + chroma_range * blue);
      out.data()[i + 2] = byte(128 + chroma_range * red);
    }
    return out;
  }
  /// A plane whose channels differ, from black to white.
  static ViewStack<std::uint8_t> colourful() {
    ViewStack<std::uint8_t> views = bytes_of(plane_scene()).clone();
    for (std::size_t i = 0; i < views.size(); i += 3) {
      views.data()[i + 1] = static_cast<std::uint8_t>(views.data()[i] / 2);
      views.data()[i + 2] = static_cast<std::uint8_t>(255 - views.data()[i] / 3);
    }
    for (int i = 0; i < views.grid().count(); ++i) {
      std::fill_n(views.view(views.grid().view_at(i)).data, 3, std::uint8_t{0});
    }
    return views;
  }

 private slots:
  void samplesNamedSo_becomeColours_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<bool>("video");
    QTest::newRow("as MATLAB writes them") << "LFI_ycbcr.npy" << true;
    QTest::newRow("as JPEG has them") << "YCbCr.npy" << false;
  }
  void samplesNamedSo_becomeColours() {
    QFETCH(QString, name);
    QFETCH(bool, video);
    const ViewStack<std::uint8_t> wanted = colourful();
    const fs::path path = fs::path(folder_.path().toStdString()) / name.toStdString();
    io::write_npy<std::uint8_t>(path, lengths_of(wanted, "vuyxc"),
                                in_axes(encoded(wanted, video), "vuyxc"));

    const Scene scene = io::open_scene(path, {}, Progress(1));

    const ViewStack<std::uint8_t>& found = bytes_of(scene);
    QCOMPARE(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      QVERIFY2(std::abs(found.data()[i] - wanted.data()[i]) <= 3,
               describe(scene.convention).c_str());
    }
    QVERIFY(warns_of(scene, video ? "video (16 … 235)" : "the full range"));
  }
};

}  // namespace episcope::in_luma_chroma_test

EPISCOPE_TEST(luma_chroma_test, LumaChromaTest)
#include "luma_chroma_test.moc"
