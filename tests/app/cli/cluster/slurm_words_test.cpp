// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/slurm.h"
#include "engine/core/error.h"
#include "tests/test_main.h"

#include <numeric>

namespace episcope::in_slurm_words_test {

using namespace cli;

using Words = std::vector<std::string>;

class SlurmWordsTest : public QObject {
  Q_OBJECT
 private slots:
  void options_areSplitAtSpacesOutsideQuotes() {
    QCOMPARE(option_words(""), Words());
    QCOMPARE(option_words(" --partition=gpu  --time=1:00:00 "),
             (Words{"--partition=gpu", "--time=1:00:00"}));
    QCOMPARE(option_words("--comment='two words' --x=\"it's\" ''"),
             (Words{"--comment=two words", "--x=it's", ""}));
    QVERIFY_THROWS_EXCEPTION(InvalidInput, (void)option_words("--comment='a"));
  }

  void gpus_areAskedForOnce() {
    QCOMPARE(with_gpu({"--time=1:00"}), (Words{"--time=1:00", "--gres=gpu:1"}));
    QCOMPARE(with_gpu({"--gres=gpu:h200:2"}), (Words{"--gres=gpu:h200:2"}));
    QCOMPARE(with_gpu({"--gpus-per-task=1"}), (Words{"--gpus-per-task=1"}));
  }

  void ranges_joinNeighbours() {
    QCOMPARE(ranges_text(std::vector<std::size_t>{}), std::string());
    QCOMPARE(ranges_text(std::vector<std::size_t>{0, 1, 2, 5, 7, 8}), std::string("0-2,5,7-8"));
  }

  void arrays_stayBelowSlurmsLimit() {
    std::vector<std::size_t> tasks(2500);
    std::iota(tasks.begin(), tasks.end(), 0);
    tasks.erase(tasks.begin() + 1000, tasks.begin() + 1003);

    const std::vector<JobArray> arrays = job_arrays(tasks);

    QCOMPARE(arrays.size(), std::size_t{3});
    QCOMPARE(arrays[0].indices, std::string("0-999"));
    QCOMPARE(arrays[1].offset, std::size_t{1000});
    QCOMPARE(arrays[1].indices, std::string("3-999"));
    QCOMPARE(arrays[2].indices, std::string("0-499"));
    QVERIFY(job_arrays({}).empty());
  }
};

}  // namespace episcope::in_slurm_words_test

EPISCOPE_TEST(slurm_words_test, SlurmWordsTest)
#include "slurm_words_test.moc"
