// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/core/memory.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/mman.h>
#include <vector>

namespace episcope::in_large_memory_test {

namespace {

constexpr std::size_t kMebibyte = std::size_t{1} << 20;

// Sets a budget for a test.
class Budget {
 public:
  explicit Budget(std::size_t bytes) { set_memory_budget(bytes); }
  ~Budget() { set_memory_budget({}); }
  Budget(const Budget&) = delete;
  Budget& operator=(const Budget&) = delete;
};

}  // namespace

class LargeMemoryTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    QVERIFY(folder_.isValid());
    set_scratch_folder(path());
  }
  void cleanup() { set_scratch_folder({}); }
  void withinTheBudget_isOnTheHeap();
  void beyondTheBudget_isInAFileThatIsNotSeen();
  void releasedMemory_countsNoMore();
  void memorySetAside_isNotTaken();
  void scratchWithoutAFolder_isRefusedWithASentence();
  void zeros_areZero();
  void pagesTakenAhead_areThere_andKeepWhatTheyHold();
  void partOfAFile_isReadFromAnyOffset();
  void partOfAFile_isNeverWritten();
  void forgottenPages_areReadAgain();
  void shorterFile_isRefused();
  void truncatedFile_readsAsZeros();

 private:
  [[nodiscard]] std::filesystem::path path() const { return folder_.path().toStdString(); }
  [[nodiscard]] std::filesystem::path file_of(std::size_t bytes) const {
    const std::filesystem::path file = path() / "samples";
    std::string text(bytes, ' ');
    for (std::size_t i = 0; i < bytes; ++i) text[i] = static_cast<char>('a' + i % 26);
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

  QTemporaryDir folder_;
};

void LargeMemoryTest::withinTheBudget_isOnTheHeap() {
  const Budget budget(4 * kMebibyte);

  QVERIFY(make_large<char>(3 * kMebibyte).get_deleter().kind == LargeKind::Heap);
}

void LargeMemoryTest::beyondTheBudget_isInAFileThatIsNotSeen() {
  const Budget budget(4 * kMebibyte);

  const LargeArray<char> array = make_large<char>(5 * kMebibyte);
  std::fill_n(array.get(), 5 * kMebibyte, 'x');

  QVERIFY(array.get_deleter().kind == LargeKind::Scratch);
  QVERIFY(std::filesystem::is_empty(path()));
  QVERIFY(std::count(array.get(), array.get() + 5 * kMebibyte, 'x') ==
          std::ptrdiff_t{5 * kMebibyte});
}

void LargeMemoryTest::releasedMemory_countsNoMore() {
  const Budget budget(4 * kMebibyte);
  {
    const LargeArray<char> first = make_large<char>(3 * kMebibyte);
    QVERIFY(make_large<char>(3 * kMebibyte).get_deleter().kind == LargeKind::Scratch);
  }

  QVERIFY(make_large<char>(3 * kMebibyte).get_deleter().kind == LargeKind::Heap);
}

void LargeMemoryTest::memorySetAside_isNotTaken() {
  const Budget budget(4 * kMebibyte);
  {
    const MemorySetAside aside(2 * kMebibyte);
    QVERIFY(make_large<char>(2 * kMebibyte).get_deleter().kind == LargeKind::Heap);
    QVERIFY(make_large<char>(3 * kMebibyte).get_deleter().kind == LargeKind::Scratch);
  }

  QVERIFY(make_large<char>(3 * kMebibyte).get_deleter().kind == LargeKind::Heap);
}

void LargeMemoryTest::scratchWithoutAFolder_isRefusedWithASentence() {
  std::ofstream(path() / "file") << "no folder";
  set_scratch_folder(path() / "file");
  const Budget budget(kMebibyte);

  std::string sentence;
  try {
    static_cast<void>(make_large<char>(2 * kMebibyte));
  } catch (const IoError& error) {
    sentence = error.what();
  }

  QVERIFY2(sentence.find("do not fit into memory") != std::string::npos, sentence.c_str());
}

void LargeMemoryTest::zeros_areZero() {
  for (const std::size_t bytes : {std::size_t{100}, 9 * kMebibyte}) {
    const LargeArray<char> zeros = large_array<char>(allocate_large_zeros(bytes));

    QCOMPARE(static_cast<std::size_t>(std::count(zeros.get(), zeros.get() + bytes, 0)), bytes);
  }
}

void LargeMemoryTest::pagesTakenAhead_areThere_andKeepWhatTheyHold() {
  constexpr std::size_t kPages = 8 * kMebibyte / 4096;
  const LargeMemory memory = allocate_large_zeros(8 * kMebibyte);
  auto* const bytes = static_cast<unsigned char*>(memory.data);
  bytes[5 * kMebibyte] = 7;

  take_pages(bytes + 100, memory.bytes - 200);

  QCOMPARE(bytes[5 * kMebibyte], static_cast<unsigned char>(7));
  QCOMPARE(bytes[0], static_cast<unsigned char>(0));
  std::vector<unsigned char> is_there(kPages);
  QCOMPARE(mincore(memory.data, memory.bytes, is_there.data()), 0);
  const auto count = std::ranges::count_if(is_there, [](unsigned char page) { return page & 1; });
  release_large(memory);
  if (count < 10) QSKIP("This system gives no pages ahead.");
  QVERIFY2(count >= static_cast<std::ptrdiff_t>(kPages) - 1, qPrintable(QString::number(count)));
}

void LargeMemoryTest::partOfAFile_isReadFromAnyOffset() {
  const std::filesystem::path file = file_of(20000);

  for (const std::size_t offset : {0, 1, 4095, 4096, 9999}) {
    const LargeArray<char> part = large_array<char>(large_part_of_file(file, offset, 10000));
    QCOMPARE(part[0], static_cast<char>('a' + offset % 26));
    QCOMPARE(part[9999], static_cast<char>('a' + (offset + 9999) % 26));
  }
}

void LargeMemoryTest::partOfAFile_isNeverWritten() {
  const std::filesystem::path file = file_of(5000);

  large_array<char>(large_part_of_file(file, 0, 5000))[0] = 'X';

  QCOMPARE(std::ifstream(file).get(), int{'a'});
}

void LargeMemoryTest::forgottenPages_areReadAgain() {
  const LargeArray<char> part = large_array<char>(large_part_of_file(file_of(9000), 10, 8000));
  const std::vector<char> before(part.get(), part.get() + 8000);

  forget_pages(part.get(), 8000);

  QVERIFY(std::equal(before.begin(), before.end(), part.get()));
}

void LargeMemoryTest::shorterFile_isRefused() {
  const std::filesystem::path file = file_of(5000);

  QVERIFY_THROWS_EXCEPTION(IoError, static_cast<void>(large_part_of_file(file, 1, 5000)));
}

void LargeMemoryTest::truncatedFile_readsAsZeros() {
  const std::filesystem::path file = file_of(3 * 65536);
  const LargeArray<char> part = large_array<char>(large_part_of_file(file, 0, 3 * 65536));
  QVERIFY(!has_lost_pages());

  std::filesystem::resize_file(file, 65536);

  QCOMPARE(part[100], static_cast<char>('a' + 100 % 26));
  QCOMPARE(part[2 * 65536 + 5], '\0');
  QVERIFY(has_lost_pages());
}

}  // namespace episcope::in_large_memory_test

EPISCOPE_TEST(large_memory_test, LargeMemoryTest)
#include "large_memory_test.moc"
