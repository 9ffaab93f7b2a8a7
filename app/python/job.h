// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <utility>

namespace episcope::python {

/// Does `work` on a thread of its own, without the lock of the interpreter, while the calling
/// thread, which must hold it, waits: it looks for signals and calls `listener(fraction, step)`,
/// None for no listener, whenever there is something new. What either of them raises, such as
/// KeyboardInterrupt on Ctrl+C, stops the work and is thrown when it has ended; else what the work
/// throws. `work` must not touch objects of Python. `threads` 0 = as many as the machine has.
void run_job(const pybind11::object& listener, int threads,
             const std::function<void(const Progress&)>& work);

/// The same for work that returns a value.
template <class Work>
[[nodiscard]] auto result_of_job(const pybind11::object& listener, int threads, const Work& work) {
  std::optional<decltype(work(std::declval<const Progress&>()))> result;
  run_job(listener, threads, [&](const Progress& progress) { result.emplace(work(progress)); });
  return std::move(*result);
}

}  // namespace episcope::python
