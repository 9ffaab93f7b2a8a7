// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/annotation_journal.h"
#include "engine/core/error.h"
#include "tests/annotation/random_edits.h"
#include "tests/patience.h"
#include "tests/test_main.h"

#include <QProcess>
#include <QTemporaryDir>

#include <csignal>
#include <fstream>

namespace episcope::in_journal_test {

using namespace episcope::test;

namespace {

constexpr GridShape kGrid{3, 3};
constexpr int kHeight = 60;
constexpr int kWidth = 70;
const JournalOwner kOwner{"scene", "demo", 42, -0.5};

bool same(const AnnotationDocument& a, const AnnotationDocument& b) {
  const History<Edit>& ours = a.history();
  const History<Edit>& theirs = b.history();
  if (!(a.labels() == b.labels()) || !(a.scribbles() == b.scribbles())) return false;
  if (a.boundary_smoothing_px() != b.boundary_smoothing_px()) return false;
  if (a.has_unsaved_changes() != b.has_unsaved_changes()) return false;
  if (ours.count() != theirs.count() || ours.applied_count() != theirs.applied_count()) {
    return false;
  }
  for (std::size_t i = 0; i < ours.count(); ++i) {
    if (!(ours.edit(i) == theirs.edit(i))) return false;
  }
  return true;
}

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A document whose journal has begun.
struct Journaled : Annotation {
  Journaled(const std::filesystem::path& folder, AnnotationDocument document,
            const JournalOwner& owner = kOwner)
      : Annotation(std::move(document), owner, folder) {
    keep_journal();
  }
  std::uintmax_t byte_size() const { return std::filesystem::file_size(journal_path()); }
};

AnnotationDocument new_document() {
  return {kGrid, kHeight, kWidth};
}

void write(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes,
           std::size_t count) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(count));
}

}  // namespace

class JournalTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> temporary_;
  std::filesystem::path folder() const { return temporary_->path().toStdString(); }

  // Journals some steps and gives back the states after each record.
  std::filesystem::path make_journal(unsigned seed, int steps,
                                     std::vector<AnnotationDocument>& states) const {
    RandomEdits edits(seed);
    Journaled journal(folder(), new_document());
    AnnotationDocument& document = journal.document();
    const auto copy = [&] { return replay(journal_records(kOwner, document)).document; };
    states.push_back(copy());
    std::uintmax_t size = journal.byte_size();
    for (int i = 0; i < steps; ++i) {
      edits.step(document);
      if (journal.byte_size() == size) continue;
      size = journal.byte_size();
      states.push_back(copy());
    }
    return journal.journal_path();
  }

 private slots:
  void init() { temporary_ = std::make_unique<QTemporaryDir>(); }

  void replay_makesTheSameDocument_data() {
    QTest::addColumn<int>("history_bytes");
    QTest::newRow("whole history") << (64 << 20);
    QTest::newRow("most of the history forgotten") << 4000;
    QTest::newRow("no history") << 0;
  }
  void replay_makesTheSameDocument() {
    QFETCH(int, history_bytes);
    AnnotationDocument begun(kGrid, kHeight, kWidth, static_cast<std::size_t>(history_bytes));
    RandomEdits edits(8);
    for (int i = 0; i < 50; ++i) edits.step(begun);
    Journaled journal(folder(), std::move(begun));
    AnnotationDocument& document = journal.document();

    for (int i = 0; i < 300; ++i) {
      edits.step(document);
      if (i % 20 != 0) continue;
      const RecoveredAnnotation found = read_journal(journal.journal_path());
      QVERIFY(same(found.document, document));
      QVERIFY(found.owner == kOwner);
      // Written anew, it is the same again.
      QVERIFY(same(replay(journal_records(kOwner, document)).document, document));
    }
  }

  void longSession_keepsTheJournalSmall() {
    Journaled journal(folder(), AnnotationDocument({1, 1}, 1500, 1500, 100000));
    AnnotationDocument& document = journal.document();
    document.add_label();
    std::uintmax_t largest = 0;
    for (int i = 0; i < 2500; ++i) {
      const double place = 10 + i % 1400;
      Stroke stroke(document, {0, 0},
                    {i % 3 == 0 ? PaintTool::Eraser : PaintTool::Brush, 1, 3, false});
      stroke.extend({0, place});
      stroke.extend({1499, 1499 - place});
      stroke.commit();
      largest = std::max(largest, journal.byte_size());
    }

    QVERIFY(largest > Annotation::kSlackBytes);  // it was written anew on the way
    QVERIFY(journal.byte_size() < largest);
    QVERIFY(same(read_journal(journal.journal_path()).document, document));
    QVERIFY(io::is_held(journal.journal_path()));
  }

  void tornJournal_losesTheTornStepOnly() {
    std::vector<AnnotationDocument> states;
    const auto whole = bytes_of(make_journal(3, 12, states));
    const auto torn = folder() / "torn.journal";
    std::size_t seen = 0;
    bool has_begun = false;

    for (std::size_t size = 0; size <= whole.size(); ++size) {
      write(torn, whole, size);
      try {
        const RecoveredAnnotation found = read_journal(torn);
        has_begun = true;
        // Never a state that was not there, never an older one than before.
        while (seen < states.size() && !same(found.document, states[seen])) ++seen;
        QVERIFY2(seen < states.size(), qPrintable(QString("%1 bytes").arg(size)));
      } catch (const IoError&) {
        QVERIFY(!has_begun);
      }
    }
    QVERIFY(same(read_journal(torn).document, states.back()));
    QVERIFY(states.size() > 8);
  }

  void flippedBits_neverMakeAnotherDocument() {
    std::vector<AnnotationDocument> states;
    const auto whole = bytes_of(make_journal(5, 15, states));
    const auto damaged = folder() / "damaged.journal";
    std::mt19937 random(1);

    for (int i = 0; i < 400; ++i) {
      auto bytes = whole;
      bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1U << random() % 8);
      write(damaged, bytes, bytes.size());
      try {
        const RecoveredAnnotation found = read_journal(damaged);
        QVERIFY(std::ranges::any_of(
            states, [&](const auto& state) { return same(found.document, state); }));
      } catch (const IoError&) {
      }
    }
  }

  // Found by a fuzzer: a head of 13 bytes asked for 4.3 GB.
  void heads_ofMoreViewsThanAnyLightFieldHas_areRefused() {
    const io::LogRecord views{1, 0, 0, 0, 0xf7, 0x7f, 0xfd, 0x7f, 0xf9, 1, 1, 0, 0};
    const io::LogRecord pixels{1, 0, 0, 0, 1, 1, 0xff, 0xff, 3, 0xff, 0xff, 3, 0};
    for (const io::LogRecord& head : {views, pixels}) {
      QString told;
      try {
        (void)replay({head, {0}});
      } catch (const InvalidInput& error) {
        told = error.what();
      }
      QVERIFY2(told.contains("than any light field"), qPrintable(told));
    }
  }

  void leftJournals_areThoseOfTheDeadWithUnsavedChanges() {
    Journaled held(folder(), new_document());
    held.document().add_label();
    AnnotationDocument lost = new_document();
    lost.add_label("lost");
    std::filesystem::path path_of_dead;
    {
      Journaled ended(folder(), new_document());
      ended.document().add_label();
      ended.finish();
      Journaled saved(folder(), new_document());
      saved.document().add_label();
      saved.document().mark_saved();
      Journaled dead(folder(), new_document(), {"other", "b.h5", 7});
      dead.document().add_label("lost");
      path_of_dead = dead.journal_path();
    }
    write(folder() / "later.journal", {1, 2, 3}, 3);  // of a later program, perhaps
    write(folder() / "empty.journal", {}, 0);

    const auto left = recoverable_journals(folder());

    QCOMPARE(left.size(), std::size_t{1});
    QCOMPARE(left[0].path, path_of_dead);
    QCOMPARE(left[0].owner.source, std::string("b.h5"));
    QVERIFY(same(read_journal(left[0].path).document, lost));
    discard_journal(left[0].path);
    QVERIFY(recoverable_journals(folder()).empty());
    QVERIFY(std::filesystem::exists(held.journal_path()));
    QVERIFY(std::filesystem::exists(folder() / "later.journal"));
    QVERIFY(!std::filesystem::exists(folder() / "empty.journal"));
    QVERIFY(recoverable_journals(folder() / "none").empty());
  }

  void recoveredDocument_goesOnWithItsHistory() {
    std::vector<AnnotationDocument> states;
    RecoveredAnnotation found = read_journal(make_journal(4, 60, states));
    Journaled journal(folder(), std::move(found.document), found.owner);
    AnnotationDocument& document = journal.document();

    while (document.history().next_undo()) document.undo();

    QVERIFY(document.labels().labels().empty());
    QVERIFY(document.scribbles().painted_views().empty());
    QVERIFY(same(read_journal(journal.journal_path()).document, document));
  }

  void folderThatCannotBeMade_isReported() {
    write(folder() / "file", {1}, 1);
    Annotation annotation(new_document(), kOwner, folder() / "file" / "x");

    QVERIFY_THROWS_EXCEPTION(IoError, annotation.keep_journal());
    annotation.document().add_label();  // nothing observes it
  }

  void killedProgram_losesAtMostTheStepInProgress() {
    for (int round = 0; round < 6; ++round) {
      const int seed = 100 + round;
      QProcess program;
      program.start(PAINTING_PROGRAM,
                    {QString::fromStdString(folder().string()), QString::number(seed)});
      QVERIFY(program.waitForStarted());
      while (program.canReadLine() ? program.readLine().toInt() < 40 * (round + 1)
                                   : program.waitForReadyRead(kPatience)) {
      }
      QVERIFY(recoverable_journals(folder()).empty());  // it is alive
      ::kill(static_cast<pid_t>(program.processId()), SIGKILL);
      QVERIFY(program.waitForFinished());
      QCOMPARE(program.exitStatus(), QProcess::CrashExit);
      const int done = last_number(program.readAllStandardOutput(), 40 * (round + 1));

      const auto left = recoverable_journals(folder());
      QCOMPARE(left.size(), std::size_t{1});
      const RecoveredAnnotation found = read_journal(left[0].path);

      AnnotationDocument document(kGrid, 200, 240);
      RandomEdits edits(static_cast<unsigned>(seed), false);  // a saved one would not be left
      for (int i = 0; i < done; ++i) edits.step(document);
      const bool is_as_told = same(found.document, document);
      edits.step(document);
      QVERIFY2(is_as_told || same(found.document, document),
               qPrintable(QString("after %1 steps").arg(done)));
      discard_journal(left[0].path);
    }
  }

 private:
  // The last whole line is what the program had told when it was killed.
  static int last_number(const QByteArray& output, int otherwise) {
    const QList<QByteArray> lines = output.left(output.lastIndexOf('\n')).split('\n');
    return lines.last().isEmpty() ? otherwise : lines.last().toInt();
  }
};

}  // namespace episcope::in_journal_test

EPISCOPE_CORE_TEST(journal_test, JournalTest)
#include "journal_test.moc"
