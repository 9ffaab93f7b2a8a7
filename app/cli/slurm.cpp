// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/slurm.h"

#include "engine/core/error.h"
#include "engine/core/text.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <thread>

namespace episcope::cli {
namespace {

constexpr std::size_t kArrayTasks = 1000;

/// As one word of the shell.
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

/// The command line of this program with these words behind "benchmark -o FOLDER".
std::string benchmark_command(const std::filesystem::path& folder, const std::string& words) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  return fmt::format("exec {} benchmark -o {} --quiet --threads \"${{SLURM_CPUS_ON_NODE:-0}}\" {}",
                     quoted(program), quoted(folder.string()), words);
}

/// Where Slurm writes what a job prints; "%" begins a placeholder there.
std::string output_option(const std::filesystem::path& folder, const std::string& name) {
  std::string path;
  for (const char c : (folder / "tasks").string()) {
    path += c == '%' ? std::string("%%") : std::string(1, c);
  }
  return "--output=" + path + "/" + name;
}

std::string submit(const std::vector<std::string>& words) {
  ProgramAnswer answer;
  try {
    answer = run_program("sbatch", words);
  } catch (const Unavailable& error) {
    throw Unavailable(std::string(error.what()) +
                      "; submit from a machine of a Slurm cluster, or run the tasks by --plan and "
                      "--point");
  }
  if (answer.exit_code != 0) {
    std::string why = answer.err.substr(0, answer.err.find_last_not_of(" \n") + 1);
    std::replace(why.begin(), why.end(), '\n', ' ');
    throw Error(fmt::format("sbatch refused the job (exit code {}): {}", answer.exit_code, why));
  }
  return answer.out.substr(0, answer.out.find_first_of(";\n"));  // "17;cluster"
}

std::vector<std::string> with_options(std::vector<std::string> words,
                                      const std::vector<std::string>& options,
                                      const std::string& command) {
  words.insert(words.end(), options.begin(), options.end());
  words.push_back("--wrap=" + command);
  return words;
}

}  // namespace

std::vector<std::string> option_words(const std::string& text) {
  std::vector<std::string> words;
  bool is_inside = false;  // a word
  char quote = 0;          // that is open
  for (const char c : text) {
    const bool is_space = c == ' ' || c == '\t' || c == '\n';
    if (quote == 0 && is_space) {
      is_inside = false;
      continue;
    }
    if (!is_inside) words.emplace_back();
    is_inside = true;
    const bool is_mark = quote == 0 ? c == '\'' || c == '"' : c == quote;
    if (is_mark) {
      quote = quote == 0 ? c : '\0';
    } else {
      words.back() += c;
    }
  }
  if (quote != 0) throw InvalidInput(fmt::format("a {} is not closed in: {}", quote, text));
  return words;
}

std::vector<std::string> with_gpu(std::vector<std::string> options) {
  const auto names_gpus = [](const std::string& option) {
    return option.starts_with("--gres") || option.starts_with("--gpus") || option.starts_with("-G");
  };
  if (std::ranges::none_of(options, names_gpus)) options.emplace_back("--gres=gpu:1");
  return options;
}

std::string ranges_text(std::span<const std::size_t> numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i + 1;
    while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) ++end;
    if (!text.empty()) text += ",";
    text += std::to_string(numbers[i]);
    if (end > i + 1) text += "-" + std::to_string(numbers[end - 1]);
    i = end;
  }
  return text;
}

std::vector<JobArray> job_arrays(const std::vector<std::size_t>& numbers) {
  std::vector<JobArray> arrays;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t offset = numbers[i] / kArrayTasks * kArrayTasks;
    indices.push_back(numbers[i] - offset);
    if (i + 1 < numbers.size() && numbers[i + 1] < offset + kArrayTasks) continue;
    arrays.push_back({offset, ranges_text(indices)});
    indices.clear();
  }
  return arrays;
}

SubmittedJobs submit_tasks(const std::filesystem::path& folder,
                           const std::vector<std::size_t>& numbers,
                           const std::vector<std::string>& options) {
  SubmittedJobs jobs;
  for (const JobArray& array : job_arrays(numbers)) {
    const std::string point = fmt::format("--point $((SLURM_ARRAY_TASK_ID + {}))", array.offset);
    jobs.tasks.push_back(
        submit(with_options({"--parsable", "--requeue", "--job-name=episcope",
                             "--array=" + array.indices, output_option(folder, "slurm-%A_%a.txt")},
                            options, benchmark_command(folder, point))));
  }
  jobs.tables = submit(with_options(
      {"--parsable", "--requeue", "--job-name=episcope-tables",
       "--dependency=afterany:" + joined(jobs.tasks, ":"), output_option(folder, "slurm-%j.txt")},
      options, benchmark_command(folder, "--collect")));
  return jobs;
}

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
