// SPDX-License-Identifier: BSD-3-Clause
// Paints random strokes into a journal, and says after each step that it is done, until it is
// killed. Usage: paint_until_killed <folder> <seed>.
#include "app/session/annotation_journal.h"
#include "tests/annotation/random_edits.h"

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  episcope::AnnotationDocument document({3, 3}, 200, 240);
  const episcope::AnnotationJournal journal(argv[1], {"scene", "demo", 42}, document);
  episcope::test::RandomEdits edits(static_cast<unsigned>(std::atoi(argv[2])), false);
  for (int done = 1;; ++done) {
    edits.step(document);
    std::printf("%d\n", done);
    std::fflush(stdout);
  }
}
