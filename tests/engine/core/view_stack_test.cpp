// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/disparity_field.h"
#include "engine/core/view_stack.h"
#include "tests/test_main.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace episcope::in_view_stack_test {

class ViewStackTest : public QObject {
  Q_OBJECT

 private slots:
  void views_lieOneAfterTheOther() {
    ViewStack<int> stack({2, 3}, 4, 5, 2);

    stack.view({1, 2}).at(3, 4, 1) = 77;

    QCOMPARE(stack.view_size(), std::size_t{40});
    QCOMPARE(stack.size(), std::size_t{240});
    QCOMPARE(stack.data()[239], 77);
    QCOMPARE(stack.view({1, 0}).data - stack.data(), std::ptrdiff_t{3 * 40});
  }

  void partialStack_isAddressedInTheWholeGrid() {
    ViewStack<float> center({1, 1}, 2, 2, 1, {4, 4});

    center.view({4, 4}).at(0, 0) = 3;

    QCOMPARE(center.data()[0], 3.0F);
    QVERIFY(center.contains({4, 4}));
    QVERIFY(!center.contains({0, 0}));
    QVERIFY(!center.contains({4, 5}));
  }

  void clone_isACopyOfItsOwn() {
    ViewStack<int> stack({1, 2}, 1, 2, 1, {3, 1});
    std::fill_n(stack.data(), stack.size(), 5);

    ViewStack<int> copy = stack.clone();
    copy.data()[0] = 6;

    QCOMPARE(stack.data()[0], 5);
    QCOMPARE(copy.data()[3], 5);
    QCOMPARE(copy.first(), (ViewIndex{3, 1}));
    QVERIFY(ViewStack<int>{}.clone().empty());
  }

  void move_leavesNothingBehind() {
    ViewStack<int> stack({1, 2}, 3, 4);
    const int* samples = stack.data();

    ViewStack<int> taken = std::move(stack);

    QCOMPARE(taken.data(), samples);
    QCOMPARE(taken.grid(), (GridShape{1, 2}));
    QVERIFY(stack.empty());
    QCOMPARE(stack.size(), std::size_t{0});
  }

  void emptyStack_containsNothing() {
    QVERIFY(ViewStack<int>{}.empty());
    QVERIFY(!ViewStack<int>{}.contains({0, 0}));
    QVERIFY(!DisparityField{}.contains({0, 0}));
  }

  void disparityField_joinsMaskAndFiniteness() {
    DisparityField field;
    field.disparity = ViewStack<float>({1, 1}, 1, 3);
    field.disparity.data()[0] = 0.5F;
    field.disparity.data()[1] = 0.5F;
    field.disparity.data()[2] = std::numeric_limits<float>::quiet_NaN();
    QVERIFY(field.view({0, 0}).is_valid(0, 1));

    field.valid = ViewStack<std::uint8_t>({1, 1}, 1, 3);
    field.valid.data()[0] = 1;
    field.valid.data()[1] = 0;
    field.valid.data()[2] = 1;

    QVERIFY(field.view({0, 0}).is_valid(0, 0));
    QVERIFY(!field.view({0, 0}).is_valid(0, 1));
    QVERIFY(!field.view({0, 0}).is_valid(0, 2));
  }

  void gridCenter_isTheMiddleView() {
    QCOMPARE((GridShape{9, 9}.center()), (ViewIndex{4, 4}));
    QCOMPARE((GridShape{1, 4}.center()), (ViewIndex{0, 2}));
    QVERIFY((GridShape{2, 3}.contains({1, 2})));
    QVERIFY(!(GridShape{2, 3}.contains({2, 0})));
    QVERIFY(!(GridShape{2, 3}.contains({0, -1})));
  }
};

}  // namespace episcope::in_view_stack_test

EPISCOPE_TEST(view_stack_test, ViewStackTest)
#include "view_stack_test.moc"
