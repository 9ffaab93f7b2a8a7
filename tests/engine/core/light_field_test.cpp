// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/core/light_field.h"
#include "tests/test_main.h"

#include <algorithm>
#include <set>
#include <vector>

namespace episcope::in_light_field_test {

namespace {

constexpr GridShape kGrid{2, 3};
constexpr int kHeight = 4;
constexpr int kWidth = 5;

// Sample i of the stack is i modulo `period`.
template <class T>
LightField counting(int channels = 3, int period = 251) {
  ViewStack<T> stack(kGrid, kHeight, kWidth, channels);
  for (std::size_t i = 0; i < stack.size(); ++i) stack.data()[i] = static_cast<T>(i % period);
  return LightField(std::move(stack), {});
}

std::size_t place(ViewIndex view, int y, int x, int c) {
  return (((static_cast<std::size_t>(view.v) * kGrid.u + view.u) * kHeight + y) * kWidth + x) * 3 +
         c;
}

}  // namespace

class LightFieldTest : public QObject {
  Q_OBJECT

 private slots:
  void shape_isThatOfTheStack() {
    const LightField lf = counting<std::uint16_t>(1);

    QCOMPARE(lf.grid(), kGrid);
    QCOMPARE(lf.height(), kHeight);
    QCOMPARE(lf.width(), kWidth);
    QCOMPARE(lf.channels(), 1);
    QCOMPARE(lf.center(), (ViewIndex{1, 1}));
    QVERIFY(lf.sample_type() == SampleType::UInt16);
    QCOMPARE(lf.byte_size(), std::size_t{2 * 3 * 4 * 5 * 2});
  }

  void samples_stayInTheirType() {
    const LightField lf = counting<std::uint8_t>();

    const ImageView<const std::uint8_t> view = lf.view<std::uint8_t>({1, 2});

    QCOMPARE(static_cast<std::size_t>(view.at(3, 4, 2)), place({1, 2}, 3, 4, 2) % 251);
    QCOMPARE(view.data, std::get<ViewStack<std::uint8_t>>(lf.samples()).view({1, 2}).data);
  }

  void readRow_scalesToUnit_data() {
    QTest::addColumn<int>("type");
    QTest::addColumn<float>("scale");
    QTest::newRow("uint8") << 0 << 1.0F / 255;
    QTest::newRow("uint16") << 1 << 1.0F / 65535;
    QTest::newRow("float") << 2 << 1.0F;
  }
  void readRow_scalesToUnit() {
    QFETCH(int, type);
    QFETCH(float, scale);
    const LightField lf = type == 0   ? counting<std::uint8_t>()
                          : type == 1 ? counting<std::uint16_t>()
                                      : counting<float>();

    std::vector<float> row(3 * 3);
    lf.read_row({1, 0}, 2, 1, 4, row.data());
    std::vector<float> column(2 * 3);
    lf.read_column({0, 2}, 4, 1, 3, column.data());

    for (int i = 0; i < 9; ++i) {
      QCOMPARE(row[i], scale * static_cast<float>(place({1, 0}, 2, 1 + i / 3, i % 3) % 251));
    }
    for (int i = 0; i < 6; ++i) {
      QCOMPARE(column[i], scale * static_cast<float>(place({0, 2}, 1 + i / 3, 4, i % 3) % 251));
    }
  }

  void fullScale_isOne() {
    ViewStack<std::uint8_t> stack({1, 1}, 1, 1);
    stack.data()[0] = 255;
    const LightField lf(std::move(stack), {});

    QCOMPARE(lf.view_as_float({0, 0}).at(0, 0), 1.0F);
  }

  void viewAsFloat_isTheRowsTogether() {
    const LightField lf = counting<std::uint16_t>();

    const Image<float> view = lf.view_as_float({1, 1});

    std::vector<float> row(kWidth * 3);
    for (int y = 0; y < kHeight; ++y) {
      lf.read_row({1, 1}, y, 0, kWidth, row.data());
      QVERIFY(std::equal(row.begin(), row.end(), view.row(y)));
    }
  }

  void sampleHash_tellsLightFieldsApart() {
    std::set<std::uint64_t> hashes;
    hashes.insert(counting<std::uint8_t>().sample_hash());
    hashes.insert(counting<std::uint8_t>(3, 250).sample_hash());
    hashes.insert(counting<std::uint8_t>(1).sample_hash());
    hashes.insert(counting<std::uint16_t>().sample_hash());

    QCOMPARE(hashes.size(), std::size_t{4});
    QCOMPARE(counting<float>().sample_hash(), counting<float>().sample_hash());
  }

  void sampleHash_seesTheLastByte() {
    ViewStack<std::uint8_t> a({1, 1}, 3, 3);
    std::fill_n(a.data(), a.size(), std::uint8_t{5});
    ViewStack<std::uint8_t> b = a.clone();
    b.data()[8] = 6;

    QVERIFY(LightField(std::move(a), {}).sample_hash() !=
            LightField(std::move(b), {}).sample_hash());
  }

  void badStacks_areRefused() {
    QVERIFY_THROWS_EXCEPTION(InvalidInput, LightField(ViewStack<float>{}, {}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, LightField(ViewStack<float>({1, 1}, 2, 2, 4), {}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput,
                             LightField(ViewStack<float>({1, 1}, 2, 2, 1, {1, 0}), {}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, LightField(ViewStack<float>({1, 1}, 0, 2), {}));
  }
};

}  // namespace episcope::in_light_field_test

EPISCOPE_TEST(light_field_test, LightFieldTest)
#include "light_field_test.moc"
