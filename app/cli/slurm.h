// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace episcope::cli {

/// Splits options for sbatch, given as one text such as "--partition=gpu --time=1:00:00", at spaces
/// outside '…' and "…". Throws InvalidInput for an open quotation mark.
[[nodiscard]] std::vector<std::string> option_words(const std::string& text);

/// Options of sbatch with a GPU for each task, unless they say how many themselves.
[[nodiscard]] std::vector<std::string> with_gpu(std::vector<std::string> options);

/// Ascending numbers as ranges, "0-3,7".
[[nodiscard]] std::string ranges_text(std::span<const std::size_t> numbers);

/// An array of jobs for the tasks `SLURM_ARRAY_TASK_ID + offset`.
struct JobArray {
  std::size_t offset = 0;
  std::string indices;  ///< As sbatch takes them: "0-3,7".
};

/// Tasks of these ascending numbers as few arrays, none with an index above 999: Slurm's
/// MaxArraySize is 1001 unless configured otherwise.
[[nodiscard]] std::vector<JobArray> job_arrays(const std::vector<std::size_t>& numbers);

/// The jobs of a benchmark.
struct SubmittedJobs {
  std::vector<std::string> tasks;  ///< Ids of the arrays.
  std::string tables;              ///< Id of the job that collects.
};

/// Submits arrays that run the tasks of these numbers of the plan in `folder` (absolute) by this
/// program, and a job that collects once all have ended, however they ended. A task of a node that
/// fails is queued again. Throws Unavailable without sbatch, Error with its words if it refuses.
[[nodiscard]] SubmittedJobs submit_tasks(const std::filesystem::path& folder,
                                         const std::vector<std::size_t>& numbers,
                                         const std::vector<std::string>& options);

}  // namespace episcope::cli
