// SPDX-License-Identifier: BSD-3-Clause
// Paints random strokes into a journal, and says after each step that it is done, until it is
// killed. Usage: paint_until_killed <folder> <seed>.
#include "app/session/annotation_journal.h"
#include "tests/annotation/random_edits.h"

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  episcope::Annotation annotation({{3, 3}, 200, 240}, {"scene", "demo", 42}, argv[1]);
  annotation.keep_journal();
  episcope::test::RandomEdits edits(static_cast<unsigned>(std::atoi(argv[2])), false);
  for (int done = 1;; ++done) {
    edits.step(annotation.document());
    std::printf("%d\n", done);
    std::fflush(stdout);
  }
}
