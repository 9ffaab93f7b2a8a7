// SPDX-License-Identifier: BSD-3-Clause
// Kills the window again and again at random instants of a working day, starts it anew, and
// compares what it takes back with what it had told before. `kill_day --kills N [--seed S]
// [FOLDER]`. Strokes must all be there but the one in hand; everything else is written in the
// background: how old the youngest change was that got lost is told, and must not be more than some
// seconds.
#include <sys/wait.h>
#include <unistd.h>

#include <poll.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using State = std::map<std::string, std::string>;

constexpr double kPatience_s = 180;
constexpr double kMostLost_s = 3;  // of what is written in the background, on a busy disk
constexpr double kLongestDay_s = 6;
constexpr int kEarlyOf = 5;  // one of so many is killed while it takes back what was left

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// What one run of the window told until it was killed.
struct Day {
  struct Told {
    State state;
    double at_s = 0;
  };
  std::vector<Told> told;  ///< The first one is what it began with.
  std::string doing;       ///< The step that was under way; empty = none.
  std::map<std::string, std::set<std::string>> strokes;  ///< What undo led to, by light field.
  std::string project = "whole";
  double killed_at_s = 0;
  int steps = 0;
};

class Child {
 public:
  Child(const fs::path& folder, unsigned seed) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    const std::string number = std::to_string(seed);
    pid_ = ::fork();
    if (pid_ == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::close(ends[0]);
      ::execl(DAY_PROGRAM, DAY_PROGRAM, folder.c_str(), number.c_str(), nullptr);
      ::_exit(127);
    }
    ::close(ends[1]);
    output_ = ends[0];
  }
  ~Child() {
    kill();
    ::close(output_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// The next line; none at the end of the time or of the output.
  std::optional<std::string> line(double timeout_s) {
    const auto begin = Clock::now();
    for (;;) {
      if (const auto end = text_.find('\n'); end != std::string::npos) {
        std::string found = text_.substr(0, end);
        text_.erase(0, end + 1);
        return found;
      }
      const double left = timeout_s - seconds_since(begin);
      pollfd wait{output_, POLLIN, 0};
      if (left <= 0 || ::poll(&wait, 1, static_cast<int>(1000 * left) + 1) <= 0)
        return std::nullopt;
      char bytes[4096];
      const ssize_t count = ::read(output_, bytes, sizeof bytes);
      if (count <= 0) return std::nullopt;
      text_.append(bytes, static_cast<std::size_t>(count));
    }
  }
  void kill() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    int status = 0;
    ::waitpid(pid_, &status, 0);
    if (!WIFSIGNALED(status)) ended_itself_ = true;
    pid_ = 0;
  }
  [[nodiscard]] bool has_ended_itself() const { return ended_itself_; }

 private:
  pid_t pid_ = 0;
  int output_ = -1;
  std::string text_;
  bool ended_itself_ = false;
};

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words(1);
  for (const char each : line)
    each == '\t' ? void(words.emplace_back()) : words.back().push_back(each);
  return words;
}

/// Takes lines of the program as they come.
class Listener {
 public:
  explicit Listener(Day& day) : day_(day) {}

  void hear(const std::string& line, double now_s) {
    const std::vector<std::string> words = split(line);
    if (words[0] == "STATE") {
      state_.emplace();
    } else if (words[0] == "END" && state_) {
      day_.told.push_back({std::move(*state_), now_s});
      state_.reset();
      day_.doing.clear();
    } else if (state_ && words.size() == 2) {
      (*state_)[words[0]] = words[1];
    } else if (words[0] == "STEP") {
      day_.doing = words.at(1);
      ++day_.steps;
    } else if (words[0] == "STROKES") {
      day_.strokes[words.at(1)].insert(words.at(2));
    } else if (words[0] == "PROJECT") {
      day_.project = words.at(1);
    }
  }

 private:
  Day& day_;
  std::optional<State> state_;
};

/// Starts the window and kills it `after_s` seconds after it was ready, or after its start.
Day live_a_day(const fs::path& folder, unsigned seed, double after_s, bool is_early) {
  Child child(folder, seed);
  Day day;
  Listener listener(day);
  const auto begin = Clock::now();
  double end_s = is_early ? after_s : kPatience_s;
  bool is_ready = is_early;
  while (seconds_since(begin) < end_s) {
    const auto line = child.line(end_s - seconds_since(begin));
    if (!line) break;
    listener.hear(*line, seconds_since(begin));
    if (!is_ready && !day.told.empty()) {
      is_ready = true;
      end_s = seconds_since(begin) + after_s;
    }
  }
  child.kill();
  day.killed_at_s = seconds_since(begin);
  while (const auto line = child.line(0.05)) listener.hear(*line, day.killed_at_s);
  if (child.has_ended_itself() || !is_ready) throw std::runtime_error("the window did not start");
  return day;
}

struct Losses {
  int kills = 0, steps = 0, in_a_step = 0, early = 0;
  int wrong = 0;                           ///< Lost that must not be, or never told.
  std::map<std::string, double> oldest_s;  ///< Of what was lost, by kind.
  std::map<std::string, int> lost;         ///< How often.

  void add(const std::string& kind, double age_s) {
    ++lost[kind];
    oldest_s[kind] = std::max(oldest_s[kind], age_s);
  }
};

std::string kind_of(const std::string& key) {
  return key.substr(key.find('/') + 1);
}

const std::string& told_of(const Day::Told& told, const std::string& key) {
  static const std::string nothing;
  const auto found = told.state.find(key);
  return found == told.state.end() ? nothing : found->second;
}

// A list is entries that begin with '['.
std::set<std::string> entries_of(const std::string& list) {
  std::set<std::string> entries;
  for (std::size_t begin = list.find('['); begin != std::string::npos;) {
    const std::size_t end = list.find('[', begin + 1);
    entries.insert(list.substr(begin, end - begin));
    begin = end;
  }
  return entries;
}

// For how long it had been as it was told last when the window was killed.
double age_of(const Day& day, const std::function<bool(const Day::Told&)>& is_as_last) {
  double since_s = day.killed_at_s;
  for (auto told = day.told.rbegin(); told != day.told.rend() && is_as_last(*told); ++told) {
    since_s = told->at_s;
  }
  return day.killed_at_s - since_s;
}

// Steps that take an entry away, or put another in its place.
bool replaces(const std::string& step) {
  const std::set<std::string> steps{"remove", "rename", "note", "sweep"};
  return steps.contains(step);
}

// Results and points of sweeps: the step in hand may have replaced one, or added some.
void compare_list(const Day& day, const std::string& key, const std::string& now, Losses& losses) {
  const std::set<std::string> found = entries_of(now);
  const std::set<std::string> last = entries_of(told_of(day.told.back(), key));
  for (const std::string& entry : last) {
    if (found.contains(entry) || replaces(day.doing)) continue;
    losses.add(kind_of(key), age_of(day, [&](const Day::Told& told) {
                 return entries_of(told_of(told, key)).contains(entry);
               }));
  }
  for (const std::string& entry : found) {
    const auto has = [&](const Day::Told& told) {
      return entries_of(told_of(told, key)).contains(entry);
    };
    if (last.contains(entry) || std::none_of(day.told.begin(), day.told.end(), has)) continue;
    losses.add(kind_of(key) + ", taken away",
               age_of(day, [&](const Day::Told& told) { return !has(told); }));
  }
}

void tell_wrong(const Day& day, const std::string& key, const std::string& now, Losses& losses) {
  ++losses.wrong;
  std::printf("WRONG %s during '%s'\n  told  %s\n  found %s\n", key.c_str(), day.doing.c_str(),
              told_of(day.told.back(), key).c_str(), now.c_str());
}

// The step in hand may be in the journal: one before or after it is what was told.
void compare_strokes(const Day& day, const Day& next, const std::string& key,
                     const std::string& now, Losses& losses) {
  const std::string& told = told_of(day.told.back(), key);
  if (told.empty()) return;  // the light field was not looked at
  const auto around = next.strokes.find(key.substr(0, key.find('/')));
  const bool is_one_step_off =
      !day.doing.empty() && around != next.strokes.end() && around->second.contains(told);
  if (now != told && !is_one_step_off) tell_wrong(day, key, now, losses);
}

// One value: as it was told at any time, or as the step in hand made it.
void compare_value(const Day& day, const std::string& key, const std::string& now, Losses& losses) {
  const std::string& told = told_of(day.told.back(), key);
  if (now == told) return;
  const bool was_told = std::any_of(day.told.begin(), day.told.end(), [&](const Day::Told& each) {
    return told_of(each, key) == now;
  });
  if (was_told) {
    losses.add(kind_of(key),
               age_of(day, [&](const Day::Told& each) { return told_of(each, key) != now; }));
  } else if (day.doing.empty()) {
    tell_wrong(day, key, now, losses);
  }
}

/// Compares what a day began with with what the one before had told last.
void compare(const Day& day, const Day& next, Losses& losses) {
  const State& found = next.told.front().state;
  for (const auto& [key, told] : day.told.back().state) {
    const auto now = found.find(key);
    const std::string kind = kind_of(key);
    if (now == found.end() || (kind == "scenes" && now->second != told)) {
      tell_wrong(day, key, now == found.end() ? "nothing" : now->second, losses);
    } else if (kind == "strokes") {
      compare_strokes(day, next, key, now->second, losses);
    } else if (kind == "results" || kind == "sweeps") {
      compare_list(day, key, now->second, losses);
    } else {
      compare_value(day, key, now->second, losses);
    }
  }
  if (next.project == "whole") return;
  ++losses.wrong;
  std::printf("WRONG project: %s\n", next.project.c_str());
}

Losses kill_days(const fs::path& folder, int kills, unsigned seed) {
  std::mt19937 random(seed);
  Losses losses;
  std::optional<Day> before;
  while (losses.kills < kills) {
    const bool is_early = before && random() % kEarlyOf == 0;
    std::uniform_real_distribution<double> seconds(0, is_early ? 3.0 : kLongestDay_s);
    Day day = live_a_day(folder, random(), seconds(random), is_early);
    ++losses.kills;
    losses.steps += day.steps;
    losses.in_a_step += day.doing.empty() ? 0 : 1;
    if (day.told.empty()) {
      ++losses.early;  // killed before it was ready: the next one has to have everything
    } else {
      if (before) compare(*before, day, losses);
      before = std::move(day);
    }
    std::printf("%d kills, %d steps, %d wrong\n", losses.kills, losses.steps, losses.wrong);
    std::fflush(stdout);
  }
  compare(*before, live_a_day(folder, random(), 0.1, false), losses);
  return losses;
}

int report(const Losses& losses) {
  std::printf(
      "%d kills, %d of them within a step and %d while the window took back what was left; "
      "%d steps; %d wrong\n",
      losses.kills, losses.in_a_step, losses.early, losses.steps, losses.wrong);
  bool is_old = false;
  for (const auto& [kind, count] : losses.lost) {
    std::printf("%-10s lost %d times, made %.2f s before the kill at most\n", kind.c_str(), count,
                losses.oldest_s.at(kind));
    is_old |= losses.oldest_s.at(kind) > kMostLost_s;
  }
  return losses.wrong == 0 && !is_old && losses.steps > 0 ? 0 : 1;
}

int run(const std::vector<std::string>& arguments) {
  int kills = 3;
  unsigned seed = 1;
  fs::path folder = fs::temp_directory_path() / ("kill_day_" + std::to_string(::getpid()));
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == "--kills" && i + 1 < arguments.size()) {
      kills = std::atoi(arguments[++i].c_str());
    } else if (arguments[i] == "--seed" && i + 1 < arguments.size()) {
      seed = static_cast<unsigned>(std::atoi(arguments[++i].c_str()));
    } else {
      folder = arguments[i];
    }
  }
  fs::remove_all(folder);
  const int result = report(kill_days(folder, kills, seed));
  if (result == 0) fs::remove_all(folder);
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
