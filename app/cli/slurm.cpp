// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/slurm.h"

#include "app/session/command_line.h"
#include "engine/core/error.h"
#include "engine/core/text.h"

#include <fmt/format.h>

#include <sys/wait.h>
#include <algorithm>
#include <cstdio>
#include <memory>

namespace episcope::cli {
namespace {

constexpr std::size_t kArrayTasks = 1000;

/// The command line of this program with these words behind "benchmark -o FOLDER".
std::string benchmark_command(const std::filesystem::path& folder, const std::string& words) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  return fmt::format("exec {} benchmark -o {} --quiet --threads \"${{SLURM_CPUS_ON_NODE:-0}}\" {}",
                     shell_quoted(program), shell_quoted(folder.string()), words);
}

/// Where Slurm writes what a job prints; "%" begins a placeholder there.
std::string output_option(const std::filesystem::path& folder, const std::string& name) {
  std::string path;
  for (const char c : (folder / "tasks").string()) {
    path += c == '%' ? std::string("%%") : std::string(1, c);
  }
  return "--output=" + path + "/" + name;
}

struct ClosePipe {
  void operator()(std::FILE* pipe) const { pclose(pipe); }
};

/// What the shell prints for a command.
struct ShellAnswer {
  std::string text;
  int exit_code = 0;  ///< −1 if a signal ended it.
};
ShellAnswer answer_of_shell(const std::string& command) {
  std::unique_ptr<std::FILE, ClosePipe> pipe(popen(command.c_str(), "re"));
  if (!pipe) throw Unavailable("no more files can be opened");
  ShellAnswer answer;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get())) {
    answer.text += static_cast<char>(c);
  }
  const int status = pclose(pipe.release());
  answer.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return answer;
}

/// Returns the number of the job. Notices of sbatch may stand before it.
std::string submit(const std::vector<std::string>& words) {
  constexpr int kNotFound = 127;
  const ShellAnswer answer =
      answer_of_shell("sbatch " + joined(words, " ", shell_quoted) + " 2>&1");
  if (answer.exit_code == kNotFound) {
    throw Unavailable(
        "sbatch is not installed; submit from a machine of a Slurm cluster, or run the tasks by "
        "--plan and --point");
  }
  const std::string text(trimmed(answer.text, " \n"));
  if (answer.exit_code != 0) {
    std::string why = text;
    std::replace(why.begin(), why.end(), '\n', ' ');
    throw Error(fmt::format("sbatch refused the job (exit code {}): {}", answer.exit_code, why));
  }
  const std::string line = text.substr(text.rfind('\n') + 1);
  return line.substr(0, line.find(';'));  // "17;cluster"
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

}  // namespace episcope::cli
