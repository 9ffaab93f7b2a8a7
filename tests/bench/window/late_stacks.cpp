// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/window/late_stacks.h"

#include <cxxabi.h>
#include <dlfcn.h>
#include <execinfo.h>
#include <link.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>

namespace episcope::bench {
namespace {

constexpr int kDepth = 96;
constexpr int kNamed = 5;
constexpr std::size_t kNamedOfLibraries = 4;
constexpr std::size_t kMostStacks = 200;
constexpr auto kInterval = std::chrono::milliseconds(4);
constexpr long kLate_ns = 25'000'000;

// Written by the thread that is looked at, in its handler, and read by it alone.
struct Found {
  std::array<std::array<void*, kDepth>, kMostStacks> stacks;
  std::array<int, kMostStacks> depths;
  std::size_t count = 0;
};
Found found;

void keep_stack(int) {
  if (found.count == kMostStacks) return;
  found.depths[found.count] = backtrace(found.stacks[found.count].data(), kDepth);
  ++found.count;
}

long now_ns() {
  return std::chrono::steady_clock::now().time_since_epoch().count();
}

std::string demangled(const char* symbol) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> name(
      abi::__cxa_demangle(symbol, nullptr, nullptr, &status), std::free);
  return name ? name.get() : symbol;
}

struct Call {
  std::string name;
  bool is_own = false;  // of the program itself, not of a library
};

Call call_at(void* address) {
  Dl_info info{};
  link_map* map = nullptr;
  if (!dladdr1(address, &info, reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP) || !map) return {};
  if (map->l_name[0] != '\0') {
    const std::string name = info.dli_sname ? demangled(info.dli_sname) : "?";
    return {name.substr(0, name.find('(')), false};
  }
  char command[160];
  std::snprintf(command, sizeof command, "addr2line -fC -e /proc/%d/exe %#lx", getpid(),
                reinterpret_cast<unsigned long>(address) - map->l_addr - 1);
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command, "r"), pclose);
  char line[600] = "";
  if (!pipe || !std::fgets(line, sizeof line, pipe.get())) return {};
  std::string name(line);
  static const std::string kUnnamed = "(anonymous namespace)::";
  for (auto at = name.find(kUnnamed); at != std::string::npos; at = name.find(kUnnamed)) {
    name.erase(at, kUnnamed.size());
  }
  return {name.substr(0, name.find_first_of("(\n")), true};
}

}  // namespace

LateStacks::LateStacks() : watched_(pthread_self()) {
  void* first = nullptr;
  (void)backtrace(&first, 1);  // loads what it needs, which a handler must not
  struct sigaction action {};
  action.sa_handler = keep_stack;
  action.sa_flags = SA_RESTART;
  sigaction(SIGPROF, &action, nullptr);
  watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

LateStacks::~LateStacks() {
  watcher_.request_stop();
  watcher_.join();
  std::signal(SIGPROF, SIG_IGN);
}

void LateStacks::watch(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::this_thread::sleep_for(kInterval);
    const long begin_ns = begin_ns_;
    if (begin_ns != 0 && now_ns() - begin_ns > kLate_ns) pthread_kill(watched_, SIGPROF);
  }
}

void LateStacks::begin_work() {
  found.count = 0;
  begin_ns_ = now_ns();
}

std::vector<Stack> LateStacks::end_work() {
  begin_ns_ = 0;
  std::vector<Stack> stacks;
  for (std::size_t i = 0; i < found.count; ++i) {
    const auto& all = found.stacks[i];
    stacks.emplace_back(all.begin(), all.begin() + found.depths[i]);
  }
  return stacks;
}

std::vector<std::string> calls_of(const std::vector<Stack>& stacks) {
  static std::map<void*, Call> calls;
  std::map<std::string, int> counts;
  for (const Stack& stack : stacks) {
    std::string text;
    int own = 0;
    // The first two are of the signal.
    for (std::size_t i = 2; i < stack.size() && own < kNamed; ++i) {
      auto [call, is_new] = calls.try_emplace(stack[i]);
      if (is_new) call->second = call_at(stack[i]);
      own += call->second.is_own ? 1 : 0;
      if (call->second.is_own || i < 2 + kNamedOfLibraries) {
        text = call->second.name + (text.empty() ? "" : " > ") + text;
      }
    }
    ++counts[text];
  }
  std::vector<std::pair<int, std::string>> sorted;
  for (const auto& [text, count] : counts) sorted.emplace_back(count, text);
  std::ranges::sort(sorted, std::greater());
  std::vector<std::string> lines;
  for (const auto& [count, text] : sorted) lines.push_back(std::to_string(count) + "× " + text);
  return lines;
}

}  // namespace episcope::bench
