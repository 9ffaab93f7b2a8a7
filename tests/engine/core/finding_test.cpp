// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/finding.h"
#include "tests/test_main.h"

#include <set>

namespace episcope::in_finding_test {

namespace {

/// The sentence with "1", "22", "333", … in its places, and these values.
Finding sample_of(const FindingText& text, std::string& sentence) {
  Finding finding{std::string(text.code), {}};
  sentence = numbered(text.english);
  for (int i = 1;; ++i) {
    const std::string place = '%' + std::to_string(i);
    const std::size_t at = sentence.find(place);
    if (at == std::string::npos) return finding;
    finding.values.emplace_back(static_cast<std::size_t>(i), static_cast<char>('0' + i));
    sentence.replace(at, place.size(), finding.values.back());
  }
}

}  // namespace

class FindingTest : public QObject {
  Q_OBJECT

 private slots:
  void codes_areDistinct() {
    std::set<std::string_view> codes;
    for (const FindingText& text : kFindingTexts) {
      QVERIFY2(codes.insert(text.code).second, std::string(text.code).c_str());
    }
  }

  void everySentence_givesBackWhatItTells_data() {
    QTest::addColumn<int>("index");
    for (std::size_t i = 0; i < kFindingTexts.size(); ++i) {
      QTest::newRow(std::string(kFindingTexts[i].code).c_str()) << static_cast<int>(i);
    }
  }
  void everySentence_givesBackWhatItTells() {
    QFETCH(int, index);
    std::string sentence;
    const Finding told = sample_of(kFindingTexts[static_cast<std::size_t>(index)], sentence);

    const auto read = finding_of(sentence);

    QVERIFY2(read.has_value(), sentence.c_str());
    QCOMPARE(read->code, told.code);
    QVERIFY(read->values == told.values);
  }

  void briefLines_nameValuesThatThereAre() {
    for (const FindingText& text : kFindingTexts) {
      std::string sentence;
      const std::size_t count = sample_of(text, sentence).values.size();
      QVERIFY2(text.brief.find('{') == std::string_view::npos, std::string(text.code).c_str());
      for (std::size_t i = count + 1; i <= 9; ++i) {
        QVERIFY2(text.brief.find('%' + std::to_string(i)) == std::string_view::npos,
                 std::string(text.code).c_str());
      }
    }
  }

  void values_mayHoldWordsOfTheSentence() {
    const auto read = finding_of("depth is ignored because it is ignored because of dH.");

    QVERIFY(read);
    QCOMPARE(read->code, std::string("depth.ignored"));
    QCOMPARE(read->values.front(), std::string("depth"));
    QCOMPARE(read->values.back(), std::string("it is ignored because of dH"));
  }

  void unusableViews_areFollowedByAnotherFinding() {
    const std::string next =
        "2_2.png cannot be used: this view has 8×8 px, but 1_1.png has 9×9 px. Nor can 3 other "
        "views. ";

    const auto first = finding_of("1_2.png cannot be used: it is damaged. " + next);
    const auto second = finding_of(next);

    QVERIFY(first && second);
    QCOMPARE(first->values.back(), next);
    QCOMPARE(finding_of(second->values[1])->code, std::string("views.unlike"));
    QCOMPARE(finding_of(second->values.back())->code, std::string("views.unusable_others"));
  }

  void otherSentences_areNoFindings() {
    QVERIFY(!finding_of("A sentence that nobody says."));
    QVERIFY(!finding_of(""));
    QVERIFY(!finding_of("computed"));
  }
};

}  // namespace episcope::in_finding_test

EPISCOPE_TEST(finding_test, FindingTest)
#include "finding_test.moc"
