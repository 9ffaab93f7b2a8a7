// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/image.h"
#include "tests/test_main.h"

#include <type_traits>
#include <utility>

namespace episcope::in_volume_test {

class VolumeTest : public QObject {
  Q_OBJECT

 private slots:
  void layersOfARow_lieTogether() {
    Volume<int> volume(2, 3, 4);
    int* first = volume.view().data;

    QCOMPARE(volume.view().size(), std::size_t{24});
    QCOMPARE(volume.view().row(0, 1) - first, std::ptrdiff_t{4});
    QCOMPARE(volume.view().row(1, 0) - first, std::ptrdiff_t{12});
    QCOMPARE(&volume.view().at(1, 2, 3) - first, std::ptrdiff_t{23});
  }

  void constView_seesTheSameValues() {
    Volume<float> volume(1, 2, 3);
    volume.view().at(0, 1, 2) = 5;

    const VolumeView<const float> seen = std::as_const(volume).view();

    QCOMPARE(seen.at(0, 1, 2), 5.0F);
  }

  void volume_movesWithoutCopying() {
    static_assert(!std::is_copy_constructible_v<Volume<float>>);
    Volume<float> volume(1, 2, 3);
    const float* samples = volume.view().data;

    const Volume<float> taken = std::move(volume);

    QCOMPARE(taken.view().data, samples);
    QCOMPARE(taken.layers(), 2);
    QVERIFY(Volume<float>().empty());
  }
};

}  // namespace episcope::in_volume_test

EPISCOPE_TEST(volume_test, VolumeTest)
#include "volume_test.moc"
