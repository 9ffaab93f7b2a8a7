// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/cluster/run_program.h"

#include "engine/core/error.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <thread>

namespace episcope::cli {
namespace {

/// One output of a program that is being started.
struct Pipe {
  Pipe() {
    if (::pipe2(ends, O_CLOEXEC) != 0) throw Unavailable("no more files can be opened");
  }
  ~Pipe() {
    for (const int end : ends) ::close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  void close_writing() {
    ::close(ends[1]);
    ends[1] = -1;
  }
  [[nodiscard]] std::string read_to_end() const {
    std::string text;
    char part[4096];
    for (;;) {
      const ssize_t count = ::read(ends[0], part, sizeof part);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return text;
      text.append(part, static_cast<std::size_t>(count));
    }
  }

  int ends[2] = {-1, -1};
};

pid_t start(const std::string& program, std::vector<std::string> words, const Pipe& out,
            const Pipe& err) {
  words.insert(words.begin(), program);
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, out.ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.ends[1], STDERR_FILENO);
  pid_t id = 0;
  const int error =
      ::posix_spawnp(&id, program.c_str(), &actions, nullptr, pointers.data(), ::environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw Unavailable(program + " cannot be started: " + std::strerror(error));
  return id;
}

int wait_for(pid_t id) {
  int status = 0;
  while (::waitpid(id, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

ProgramAnswer run_program(const std::string& program, const std::vector<std::string>& words) {
  Pipe out, err;
  const pid_t id = start(program, words, out, err);
  out.close_writing();
  err.close_writing();
  ProgramAnswer answer;
  {
    const std::jthread reader([&] { answer.err = err.read_to_end(); });
    answer.out = out.read_to_end();
  }
  answer.exit_code = wait_for(id);
  return answer;
}

}  // namespace episcope::cli
