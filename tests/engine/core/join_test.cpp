// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/text.h"
#include "tests/test_main.h"

#include <set>
#include <vector>

namespace episcope::in_join_test {

class JoinTest : public QObject {
  Q_OBJECT

 private slots:
  void separator_standsBetweenItems() {
    const std::vector<std::string> none;

    QCOMPARE(joined(none, ", "), std::string());
    QCOMPARE(joined(std::vector<std::string>{"a"}, ", "), std::string("a"));
    QCOMPARE(joined(std::vector<std::string>{"a", "", "b"}, ", "), std::string("a, , b"));
  }

  void items_areTurnedIntoTexts() {
    struct Item {
      std::string name;
    };
    const auto text = [](int number) { return std::to_string(number); };

    QCOMPARE(joined(std::vector<int>{9, 9, 512}, "×", text), std::string("9×9×512"));
    QCOMPARE(joined(std::vector<Item>{{"a"}, {"b"}}, "|", &Item::name), std::string("a|b"));
  }

  void takenName_getsTheFirstFreeNumber() {
    const std::set<std::string> taken{"a", "a 2"};
    const auto is_taken = [&](const std::string& name) { return taken.contains(name); };

    QCOMPARE(unique_name("b", " ", is_taken), std::string("b"));
    QCOMPARE(unique_name("a", " ", is_taken), std::string("a 3"));
    QCOMPARE(unique_name("a", "-", is_taken), std::string("a-2"));
  }
};

}  // namespace episcope::in_join_test

EPISCOPE_TEST(join_test, JoinTest)
#include "join_test.moc"
