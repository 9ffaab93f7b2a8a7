// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/document.h"
#include "engine/core/error.h"
#include "tests/annotation/random_edits.h"
#include "tests/test_main.h"

namespace episcope::in_edit_encoding_test {

namespace {

std::vector<std::uint8_t> encoded(const Edit& edit) {
  ByteWriter out;
  write_edit(edit, out);
  return out.bytes();
}

}  // namespace

class EditEncodingTest : public QObject {
  Q_OBJECT

 private slots:
  void numbers_comeBack() {
    ByteWriter out;
    const std::uint64_t numbers[] = {0, 1, 127, 128, 300, 65535, UINT64_MAX};
    for (const std::uint64_t number : numbers) out.number(number);
    out.text("grün");

    ByteReader in(out.bytes());

    for (const std::uint64_t number : numbers) QCOMPARE(in.number(), number);
    QCOMPARE(in.text(), std::string("grün"));
    QVERIFY(in.at_end());
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)in.byte());
  }

  void randomEdits_comeBack() {
    AnnotationDocument document({3, 3}, 60, 70);
    test::RandomEdits edits(9);
    for (int i = 0; i < 200; ++i) edits.make_one(document);
    QVERIFY(document.history().count() > 100);

    for (std::size_t i = 0; i < document.history().count(); ++i) {
      const auto bytes = encoded(document.history().edit(i));
      ByteReader in(bytes);

      QVERIFY(read_edit(in) == document.history().edit(i));
      QVERIFY(in.at_end());
    }
  }

  void cutBytes_areRefused() {
    AnnotationDocument document({2, 2}, 30, 30);
    document.add_label("tree");
    const auto label_bytes = encoded(document.history().edit(0));
    fill_region(document, {1, 1}, {{3, 4, 9}, {5, 1, 2}}, {});
    for (const auto& bytes : {label_bytes, encoded(document.history().edit(1))}) {
      for (std::size_t size = 0; size < bytes.size(); ++size) {
        ByteReader in({bytes.data(), size});
        QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)read_edit(in));
      }
    }
  }

  void randomBytes_areRefusedOrRead() {
    std::mt19937 random(4);
    for (int i = 0; i < 20000; ++i) {
      std::vector<std::uint8_t> bytes(random() % 60);
      for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() % 12);
      ByteReader in(bytes);
      try {
        (void)read_edit(in);
      } catch (const InvalidInput&) {
      }
    }
  }

  void stroke_takesFewBytes() {
    AnnotationDocument document({1, 1}, 512, 512);
    document.add_label();
    Stroke stroke(document, {0, 0}, {PaintTool::Brush, 1, 20, false});
    stroke.extend({100, 100});
    stroke.extend({200, 300});
    stroke.commit();

    QVERIFY(encoded(document.history().edit(1)).size() < 1000);
  }
};

}  // namespace episcope::in_edit_encoding_test

EPISCOPE_TEST(edit_encoding_test, EditEncodingTest)
#include "edit_encoding_test.moc"
