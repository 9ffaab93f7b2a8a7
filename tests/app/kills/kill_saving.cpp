// SPDX-License-Identifier: BSD-3-Clause
// Kills the program at random instants of saving and looks at what is there then: the old file or
// the new one, never half of either. `kill_saving [--kills N] [NAME]` does so N times for every
// saver, or for one; `kill_saving --save NAME FOLDER` saves until it is killed.
#include "tests/app/kills/saved_files.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <random>
#include <stdexcept>
#include <thread>

namespace episcope::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
constexpr const char* kThisProgram = "/proc/self/exe";

// Where the `count`-th saving goes.
fs::path place(const Saver& saver, const fs::path& folder, int count) {
  std::string name = saver.file;
  if (saver.is_folder) name.append("_").append(std::to_string(count));
  return folder / name;
}

[[noreturn]] void save_until_killed(const Saver& saver, const fs::path& folder) {
  for (int count = 0;; ++count) {
    saver.save(place(saver, folder, count), count % 2 == 0 ? Variant::A : Variant::B);
    if (::write(STDOUT_FILENO, ".", 1) != 1) std::exit(1);
  }
}

bool has_unfinished(const fs::path& folder) {
  return std::any_of(
      fs::directory_iterator(folder), fs::directory_iterator(),
      [](const auto& entry) { return entry.path().filename().string().starts_with("."); });
}

struct Kills {
  int count = 0;
  int in_the_middle = 0;  // Something unfinished was left.
  int damaged = 0;
};

class Killing {
 public:
  Killing(const Saver& saver, const fs::path& folder) : saver_(saver), folder_(folder) {
    for (const Variant variant : {Variant::A, Variant::B}) {
      const fs::path whole = empty_folder(folder / "whole");
      const auto start = Clock::now();
      saver.save(place(saver, whole, 0), variant);
      duration_ = std::chrono::duration<double>(Clock::now() - start).count();
      (variant == Variant::A ? a_ : b_) = contents_of(whole, Unfinished::IsLeftOut);
    }
    if (a_ == b_) throw std::runtime_error(saver.name + ": both variants are the same");
  }

  void kill_once(std::mt19937& random, Kills& kills) const {
    const fs::path folder = empty_folder(folder_ / "killed");
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    const pid_t child = ::fork();
    if (child == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::execl(kThisProgram, kThisProgram, "--save", saver_.name.c_str(), folder.c_str(), nullptr);
      ::_exit(1);
    }
    ::close(ends[1]);
    char saved = 0;
    const bool has_begun = ::read(ends[0], &saved, 1) == 1;
    std::uniform_real_distribution<double> seconds(0, 4 * duration_);
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds(random)));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ::close(ends[0]);
    if (!has_begun || !WIFSIGNALED(status)) throw std::runtime_error(saver_.name + ": no saving");
    ++kills.count;
    if (has_unfinished(folder)) ++kills.in_the_middle;
    if (!is_whole(folder)) ++kills.damaged;
  }

 private:
  // Whether every file of the saver is there as one of the variants has it.
  [[nodiscard]] bool is_whole(const fs::path& folder) const {
    if (!saver_.is_folder) return is_one_of_each(contents_of(folder, Unfinished::IsLeftOut));
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().filename().string().starts_with(".")) continue;
      Contents found;
      for (auto& [name, bytes] : contents_of(entry.path(), Unfinished::IsLeftOut)) {
        found[fs::path(place(saver_, {}, 0)) / name] = std::move(bytes);
      }
      if (found != a_ && found != b_) return false;
    }
    return true;
  }
  [[nodiscard]] bool is_one_of_each(const Contents& found) const {
    if (found.size() != a_.size()) return false;
    return std::ranges::all_of(found, [&](const auto& file) {
      const auto a = a_.find(file.first), b = b_.find(file.first);
      return (a != a_.end() && a->second == file.second) ||
             (b != b_.end() && b->second == file.second);
    });
  }

  const Saver& saver_;
  fs::path folder_;
  Contents a_, b_;
  double duration_ = 0;
};

int kill_all(int kill_count, const std::string& only) {
  const fs::path folder = fs::temp_directory_path() / ("kill_saving_" + std::to_string(::getpid()));
  std::mt19937 random(1);
  Kills all;
  std::printf("%-24s %6s %14s %8s\n", "saved", "kills", "in the middle", "damaged");
  for (const Saver& saver : savers()) {
    if (!only.empty() && saver.name != only) continue;
    const Killing killing(saver, folder);
    Kills kills;
    while (kills.count < kill_count) killing.kill_once(random, kills);
    std::printf("%-24s %6d %14d %8d\n", saver.name.c_str(), kills.count, kills.in_the_middle,
                kills.damaged);
    std::fflush(stdout);
    all = {all.count + kills.count, all.in_the_middle + kills.in_the_middle,
           all.damaged + kills.damaged};
  }
  std::printf("%-24s %6d %14d %8d\n", "all", all.count, all.in_the_middle, all.damaged);
  fs::remove_all(folder);
  // A test that never met a saving in progress would prove nothing.
  return all.damaged == 0 && all.in_the_middle > 0 ? 0 : 1;
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() == 3 && arguments[0] == "--save") {
    save_until_killed(saver_named(arguments[1]), arguments[2]);
  }
  const bool has_count = arguments.size() >= 2 && arguments[0] == "--kills";
  const int kill_count = has_count ? std::atoi(arguments[1].c_str()) : 3;
  const std::size_t used = has_count ? 2 : 0;
  return kill_all(kill_count, arguments.size() > used ? arguments[used] : "");
}

}  // namespace
}  // namespace episcope::test

int main(int argc, char** argv) {
  try {
    return episcope::test::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
