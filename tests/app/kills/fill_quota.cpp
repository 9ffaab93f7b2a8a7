// SPDX-License-Identifier: BSD-3-Clause
// Lets every saver run into a full quota and into the limit on the size of a file, at several
// sizes: it says so in a sentence, what was there stays, byte for byte, and nothing unfinished is
// left. `fill_quota [NAME]` tries all savers or one; `fill_quota --save NAME FOLDER QUOTA BYTES`
// saves under a quota. Needs no rights.
#include "engine/core/error.h"
#include "tests/app/kills/quota.h"
#include "tests/app/kills/saved_files.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <set>
#include <stdexcept>

namespace episcope::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kThisProgram = "/proc/self/exe";
constexpr int kRefused = 1;

const Quota& quota_named(const std::string& name) {
  static const std::vector<Quota> all = quotas();
  const auto found = std::ranges::find(all, name, &Quota::name);
  if (found == all.end()) throw std::runtime_error("there is no quota of " + name);
  return *found;
}

// The end of the child: what is refused stays so.
int save_under(const Quota& quota, std::uint64_t bytes, const Saver& saver, const fs::path& path) {
  quota.begin(bytes);
  try {
    saver.save(path, Variant::B);
    return 0;
  } catch (const IoError& error) {
    std::fputs(error.what(), stdout);
    return kRefused;
  }
}

// What a child of this program said, and its exit code; -1 for a signal.
struct Said {
  std::string text;
  int code = -1;
};

Said run(std::vector<std::string> arguments) {
  std::vector<char*> words;
  for (std::string& each : arguments) words.push_back(each.data());
  words.push_back(nullptr);
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(ends[1], STDOUT_FILENO);
    ::close(ends[0]);
    ::close(ends[1]);
    ::execv(kThisProgram, words.data());
    ::_exit(127);
  }
  ::close(ends[1]);
  Said said;
  std::array<char, 1000> part{};
  for (ssize_t count = 0; (count = ::read(ends[0], part.data(), part.size())) > 0;) {
    said.text.append(part.data(), static_cast<std::size_t>(count));
  }
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFEXITED(status)) said.code = WEXITSTATUS(status);
  return said;
}

class Filling {
 public:
  Filling(const Saver& saver, const fs::path& folder)
      : saver_(saver), folder_(empty_folder(folder)) {
    saver.save(folder_ / saver.file, Variant::B);
    for (const auto& [name, bytes] : contents_of(folder_, Unfinished::Counts)) {
      largest_ = std::max(largest_, std::uint64_t{bytes.size()});
    }
  }

  // How many ways of refusing failed; each is told.
  [[nodiscard]] int failures() const {
    int count = 0;
    for (const Quota& quota : quotas()) {
      if (quota.has_limit) {
        for (const std::uint64_t bytes : limits()) count += is_refused(quota, bytes) ? 0 : 1;
      } else {
        count += is_refused(quota, 0) ? 0 : 1;
      }
    }
    return count;
  }

 private:
  // In the middle and just before the end; none at all is like a quota of bytes.
  [[nodiscard]] std::set<std::uint64_t> limits() const { return {largest_ / 2, largest_ - 1}; }

  [[nodiscard]] bool is_refused(const Quota& quota, std::uint64_t bytes) const {
    const fs::path place = empty_folder(folder_) / saver_.file;
    if (!saver_.is_folder) saver_.save(place, Variant::A);
    const Contents before = contents_of(folder_, Unfinished::Counts);
    const Said said = run(
        {kThisProgram, "--save", saver_.name, place.string(), quota.name, std::to_string(bytes)});
    const bool is_told =
        said.code == kRefused && said.text.find(quota.sentence) != std::string::npos;
    const bool is_kept = contents_of(folder_, Unfinished::Counts) == before;
    if (is_told && is_kept) return true;
    std::printf("%s, %s, %llu bytes: %s: %d '%s'\n", saver_.name.c_str(), quota.name.c_str(),
                static_cast<unsigned long long>(bytes),
                is_kept ? "no sentence about it" : "what was there is not as it was", said.code,
                said.text.c_str());
    return false;
  }

  const Saver& saver_;
  fs::path folder_;
  std::uint64_t largest_ = 0;  // Bytes of what is saved.
};

int fill_all(const std::string& only) {
  const fs::path folder = fs::temp_directory_path() / ("fill_quota_" + std::to_string(::getpid()));
  int failures = 0, savers_tried = 0;
  for (const Saver& saver : savers()) {
    if (!only.empty() && saver.name != only) continue;
    failures += Filling(saver, folder).failures();
    ++savers_tried;
  }
  fs::remove_all(folder);
  std::printf("%d savers, %d failures\n", savers_tried, failures);
  return failures == 0 && savers_tried > 0 ? 0 : 1;
}

int run_program(const std::vector<std::string>& arguments) {
  if (arguments.size() == 5 && arguments[0] == "--save") {
    return save_under(quota_named(arguments[3]), std::stoull(arguments[4]),
                      saver_named(arguments[1]), arguments[2]);
  }
  return fill_all(arguments.empty() ? "" : arguments[0]);
}

}  // namespace
}  // namespace episcope::test

int main(int argc, char** argv) {
  try {
    return episcope::test::run_program({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
